r"""
The pole over ten thousand years
================================

The path of the pole, and its distance from IAU 2006 and from long-term series.
"""

import erfa
import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.views.long_term import plot_pole

# %%
# The path of the pole does not close
# -----------------------------------
# The present rate and obliquity would move the pole on a circle (I.8, "Precession of the
# equinoxes"). The real pole moves around a pole of the ecliptic that itself moves, at a rate that
# changes: half a turn ahead it is some degrees from where it was half a turn ago. About 2800 BC,
# a century before the Old Kingdom of Egypt, Thuban was within a third of the Moon's diameter of
# the pole.
#
# *Next:* print ``tree["matrices"]`` of ``run_tree``, and apply it to a star with its proper
# motion.

fig, ax = plt.subplots(figsize=(6.5, 6.3))
plot_pole(earthspin.long_term("-13 kyr", "13 kyr", "1 kyr"), ax=ax)

# %%
# Distance from IAU 2006 and from long-term series
# ------------------------------------------------
# Angle between our pole and that of IAU 2006 (polynomials for some centuries), between ours and
# the long-term series of Vondrák, Capitaine & Wallace (2011), and between those two. The
# polynomials depart from both within some thousand years. The series were fitted to IAU 2006
# within a thousand years of the present, and to an older numerical solution outside: there they
# differ from ours by a few times our half-width (dashed).
#
# *Next:* switch the rate of :math:`J_2` off, ``j2_rate="0 1/s"``: which of the two is then
# closer?

of = earthspin.long_term("-10 kyr", "10 kyr", "100 yr")
years = of.epoch.values
poles = {
    "ours": of.pole.values,
    "IAU 2006": erfa.pmat06(2451545.0, 365.25 * years)[:, 2],
    "long-term series": erfa.ltpb(2000.0 + years)[:, 2],
}

fig, ax = plt.subplots(figsize=(7.0, 4.0))
pairs = (("ours", "IAU 2006"), ("ours", "long-term series"), ("IAU 2006", "long-term series"))
for one, other in pairs:
    apart = np.linalg.norm(np.cross(poles[one], poles[other]), axis=1)
    ax.plot(years / 1000, np.degrees(apart) * 3600, label=f"{one}, {other}")
ax.plot(years / 1000, of.pole_error, "k--", lw=0.9, label="our 95 % half-width")
ax.set(xlabel="time from J2000.0 (1000 years)", ylabel="angle between two poles (arcsec)")
ax.set(yscale="log", ylim=(3e-3, 1e3), xlim=(-10, 10))
ax.legend()

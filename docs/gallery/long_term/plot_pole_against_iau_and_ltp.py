r"""
The pole beside IAU 2006 and beside long-term series
====================================================

How far our pole lies from that of IAU 2006 (polynomials, made for centuries) and from the long-term
series of Vondrák, Capitaine & Wallace (2011), and how far these two lie from one another. The
polynomials leave both within some thousand years. The series were fitted to IAU 2006 within a
thousand years, and to an older numerical solution outside: there they leave us by a few times what
our own half-width (dashed) allows.

*Next:* switch the rate of :math:`J_2` off, ``j2_rate="0 1/s"``: which of the two comes nearer?
"""

import erfa
import matplotlib.pyplot as plt
import numpy as np

import earthspin

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

r"""
Nutation of a heavy top
=======================

The inclination of a heavy symmetric top moves in an effective potential, between two turning
points.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.top.height import effective_potential, nutation_of, turning_angles
from earthspin.top.start import HeavyTop

# %%
# The effective potential
# -----------------------
# Azimuth and spin are eliminated from the equations, and the inclination moves as in one
# dimension in the effective potential (I.7.18). The energy of each start is a level, and the top
# moves between the two inclinations where the level meets the potential. Both tops start at a
# turning point; the one that is released at rest traces cusps.
#
# *Next:* double the spin: the potential becomes narrower and the nutation smaller.

angle = np.radians(np.linspace(10, 120, 300))
fig, ax = plt.subplots()
for number, (name, push) in enumerate({"let go": 0.0, "pushed back": -0.6}.items()):
    top = HeavyTop(
        transverse_moment=1.0,
        axial_moment=1.2,
        weight_moment=1.5,
        theta=np.radians(40),
        spin=3.0,
        phi_rate=push,
    )
    ax.plot(np.degrees(angle), effective_potential(top, angle), color=f"C{number}", label=name)
    ends = turning_angles(nutation_of(top))
    level = effective_potential(top, ends)
    ax.plot(np.degrees(ends), level, "o--", color=f"C{number}", lw=0.9)
    print(f"{name}: between {np.degrees(ends[0]):.2f} and {np.degrees(ends[1]):.2f} deg")
ax.set(xlabel="inclination (deg)", ylabel="effective potential (rad²/s²)", ylim=(1.5, 6))
ax.legend()

# %%
# Wave, cusps and loops
# ---------------------
# One top with three starts: pushed forward, released at rest, pushed backward. Its tip, as
# azimuth against inclination, traces a wave, cusps or loops, the three patterns of figure I.7.19.
# The sign of :math:`\dot\varphi = (b - a\cos\theta)/\sin^2\theta` (I.7.9) at the turning points
# decides.
#
# *Next:* find the push for which the tip moves at constant inclination.

fig, panels = plt.subplots(3, 1, figsize=(6.4, 5.2), sharex=True, sharey=True)
for ax, scene in zip(panels, ("top-wave", "top-cusp", "top-loop"), strict=True):
    top = earthspin.run(earthspin.load_scene(scene))
    ax.plot(np.degrees(top.phi), np.degrees(top.theta))
    nods = 2 * np.pi / float(top.nutation_period)
    ax.set_title(f"{top.pattern.item()}: nods at {nods:.2f} rad/s")
    ax.set_ylabel("inclination (deg)")
ax.invert_yaxis()
ax.set_xlabel("azimuth of the axis (deg)")

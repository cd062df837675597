r"""
Torques on rings, and the field of a spheroid
=============================================

The torque of a distant mass on an oblate body comes from the difference of its moments.
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.constants import G
from earthspin.mass.figure import maccullagh_potential_axisymmetric, spheroid_moments
from earthspin.mass.rings import ellipse_positions, ellipse_torque, torque_on_masses
from earthspin.mass.spheroid import spheroid_potential

# %%
# A ring feels no torque, an ellipse does
# ---------------------------------------
# A distant mass attracts the near end of a dumbbell more than the far end, and turns it (I.8.2).
# On a circle of masses the torques cancel in pairs (I.8.3). On an ellipse they do not (I.8.5):
# the torque turns the long axis towards the mass. This is the oblate Earth in two dimensions.
#
# *Next:* bring the mass nearer: the exact torque (line) departs from the leading term (dots).

gm, distance, count = 1.0, 20.0, 12  # m3/s2, m, masses of 1 kg
tilt = np.linspace(-np.pi / 2, np.pi / 2, 91)
far = np.array([distance, 0.0, 0.0])


def torque(long_axis, short_axis):
    shapes = (ellipse_positions(count, long_axis, short_axis, tilt=t) for t in tilt)
    return [torque_on_masses(gm, far, np.ones(count), places)[2] for places in shapes]


fig, ax = plt.subplots()
ax.plot(np.degrees(tilt), np.array(torque(1.0, 1.0)) * 1e3, label="circle, exact")
ax.plot(np.degrees(tilt), np.array(torque(1.2, 0.8)) * 1e3, label="ellipse, exact")
leading = ellipse_torque(gm, distance, 1.0, 1.2, 0.8, count, tilt[::6])
ax.plot(np.degrees(tilt[::6]), leading * 1e3, "k.", ms=5, label="ellipse, leading term")
ax.set(xlabel="tilt of the long axis (deg)", ylabel="torque (10$^{-3}$ N m)")
ax.set_xticks(range(-90, 91, 30))
ax.legend()

# %%
# Exact field of a homogeneous spheroid
# -------------------------------------
# The potential of a homogeneous spheroid has a closed form (third reader exercise of I.9). The
# usual short form contains only the difference of the moments (I.9.31). It fails near a flat body
# and agrees at large distance; the flatter the body, the larger that distance.
#
# *Next:* a negative flattening gives a prolate body. Does the error change its sign?

mass, radius = 5.97e24, 6.378e6  # kg, m
distance = np.geomspace(1.02, 100, 80) * radius

fig, ax = plt.subplots()
for flattening in (1 / 298.257, 0.0649, 0.5):
    bulge = spheroid_moments(mass, radius, flattening).difference
    above = np.stack([0 * distance, 0 * distance, distance], axis=-1)  # over the pole
    exact = spheroid_potential(G.value * mass, radius, flattening, above)
    short = maccullagh_potential_axisymmetric(mass, bulge, distance, 0.0)
    ax.loglog(distance / radius, np.abs(short / exact - 1), label=f"f = {flattening:.4f}")
ax.axvline(60.3, color="0.5", lw=0.8, ls="--")
ax.annotate("the Moon's distance", (60.3, 1e-3), (-4, 0), textcoords="offset points", ha="right")
ax.set(xlabel="distance on the polar axis over equatorial radius", ylim=(1e-17, 1))
ax.set_ylabel("relative error of the short form")
ax.legend(title="flattening", loc="lower left")

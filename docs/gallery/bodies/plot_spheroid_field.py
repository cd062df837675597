r"""
Where the bulge is not all: the exact field of a spheroid
=========================================================

The potential of a homogeneous spheroid has a closed form (the third reader exercise of I.9).
Beside it stands the usual short form with the moment difference alone (I.9.31). Near a flat body
the short form fails, far away both agree; the flatter the body, the farther one has to go.

*Next:* a negative flattening makes a cigar. Does the error change its sign?
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.constants import G
from earthspin.mass.figure import spheroid_moments
from earthspin.mass.maccullagh import maccullagh_potential_axisymmetric
from earthspin.mass.spheroid import spheroid_potential

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
ax.set(xlabel="distance over the pole / equatorial radius (ratio)", ylim=(1e-17, 1))
ax.set_ylabel("relative error of the short form")
ax.legend(title="flattening", loc="lower left")

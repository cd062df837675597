r"""
Gravity of a body of any shape
==============================

The potential as a series in the inverse distance, and its first two terms.
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.constants import G
from earthspin.mass.figure import maccullagh_potential
from earthspin.mass.multipoles import inverse_distance, inverse_distance_bound
from earthspin.mass.tensor import centre_of_mass, inertia_tensor

# %%
# Series of the inverse distance
# ------------------------------
# The potential of a body rests on the series of :math:`1/R` in Legendre functions of the smaller
# and the larger radius (I.9.12). Each degree gains a factor :math:`r_</r_>`, so that the series
# converges fast at large distance and slowly near the source. The error (dots) stays below its
# bound (lines) down to rounding.
#
# *Next:* let the ratio approach one, and count the terms.

source = np.array([0.6, 0.0, 0.8])
degrees = np.arange(0, 41, 2)

fig, ax = plt.subplots()
for number, ratio in enumerate((0.1, 0.5, 0.9)):
    place = np.array([0.0, 0.6, 0.8]) / ratio
    exact = 1 / np.linalg.norm(place - source)
    off = [abs(inverse_distance(place, source, n) / exact - 1) for n in degrees]
    bound = [inverse_distance_bound(place, source, n) / exact for n in degrees]
    ax.semilogy(degrees, np.maximum(off, 1e-16), "o", ms=3.5, color=f"C{number}")
    ax.semilogy(degrees, bound, color=f"C{number}", lw=0.9, label=f"{ratio:g}")
ax.set(xlabel="last degree of the series (number)", ylabel="relative error of 1/R")
ax.set_ylim(3e-17, 30)
ax.legend(title="smaller over larger radius")

# %%
# MacCullagh's formula
# --------------------
# The potential of any body is a series in the inverse distance (I.9.21). The relative error of
# the point mass falls as the square of the distance. MacCullagh's formula (I.9.31) needs only the
# moments of inertia in addition, and its error falls faster. The body here has three unequal
# masses; the printed slopes are those of the farther half.
#
# *Next:* put an equal mass opposite to each: odd degrees vanish, and the error of MacCullagh's
# formula falls faster still.

masses, places = np.array([3.0, 1.0, 2.0]), np.array([[1.0, 0, 0], [-1, 0.5, 0], [0, -0.5, 0.7]])
places -= centre_of_mass(masses, places)
tensor = inertia_tensor(masses, places)
distance = np.geomspace(2, 200, 60)
points = distance[:, None] * np.array([0.6, 0.64, 0.48])
exact = -G.value * sum(
    m / np.linalg.norm(points - r, axis=1) for m, r in zip(masses, places, strict=True)
)
formulas = {
    "point mass": -G.value * masses.sum() / distance,
    "MacCullagh": maccullagh_potential(masses.sum(), tensor, points),
}

fig, ax = plt.subplots()
for name, found in formulas.items():
    off = np.abs(found / exact - 1)
    ax.loglog(distance, off, label=name)
    print(f"{name}: slope {np.polyfit(np.log(distance[30:]), np.log(off[30:]), 1)[0]:.2f}")
ax.set(xlabel="distance (m)", ylabel="relative error of the potential")
ax.legend()

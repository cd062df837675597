r"""
From afar every body is a point with a bulge
============================================

The field of any body is a series in the inverse distance (I.9.21). The point mass misses its
potential by something that falls as the square of the distance, MacCullagh's formula (I.9.31),
which knows the moments of inertia alone, by something that falls faster. Here for three unequal
masses; the printed slopes belong to the farther half.

*Next:* put an equal mass opposite to each: odd degrees vanish, and MacCullagh's error falls
faster still.
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.constants import G
from earthspin.mass.distribution import centre_of_mass
from earthspin.mass.maccullagh import maccullagh_potential
from earthspin.mass.tensor import inertia_tensor

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

r"""
The axes of a brick with a stone on its corner
==============================================

A brick turns steadily about three axes, its edges. Glue a stone on one corner: the tensor
:math:`I_{ij} = \sum m\,(r^2\delta_{ij} - x_i x_j)` (I.1.3) is no longer diagonal along the edges,
and the axes that make it so (I.3.1), dashed, have turned towards the stone. The printed moments
are those of least, middle and greatest resistance.

*Next:* make the stone heavier, or put a second one on the opposite corner.
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.mass.distribution import centre_of_mass, grid_masses
from earthspin.mass.principal_axes import principal_axes
from earthspin.mass.tensor import inertia_tensor

edges = 0.20, 0.10, 0.05  # m
x, y, z = (np.linspace(-edge / 2, edge / 2, 13) for edge in edges)
masses, places = grid_masses(np.full((12, 12, 12), 2000.0), x, y, z)  # kg/m3
stone = np.array([0.10, 0.05, 0.0])
masses, places = np.append(masses, 0.5), np.vstack([places, stone])
middle = centre_of_mass(masses, places)
found = principal_axes(inertia_tensor(masses, places, about=middle))
print(found.moments, "kg m²:", found.shape)

fig, ax = plt.subplots(figsize=(6.4, 3.8))
ax.add_patch(plt.Rectangle((-10, -5), 20, 10, fc="C5", ec="C0", alpha=0.3))
ax.plot(*stone[:2] * 100, "o", color="C1", ms=11, label="stone")
ax.plot(*middle[:2] * 100, "k+", ms=9, label="centre of mass")
for axis, name in zip(found.axes, "ABC", strict=True):
    ends = 100 * (middle + np.outer([-0.13, 0.13], axis))
    if abs(axis[2]) < 0.5:  # the third stands upright on the page
        ax.plot(ends[:, 0], ends[:, 1], "--", lw=1, label=f"axis of {name}")
ax.set(xlabel="x (cm)", ylabel="y (cm)", aspect="equal")
ax.legend(loc="center left", bbox_to_anchor=(1, 0.5))

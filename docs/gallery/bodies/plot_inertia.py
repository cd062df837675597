r"""
Moments of inertia and principal axes
=====================================

The inertia tensor of point masses: its value about any axis, and the axes that make it diagonal.
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.mass.rings import ring_positions
from earthspin.mass.tensor import (
    centre_of_mass,
    grid_masses,
    inertia_tensor,
    moment_about_axis,
    principal_axes,
)

# %%
# Moment of inertia about any axis
# --------------------------------
# The moment about an axis is :math:`\mathbf{n}\cdot\mathbf{I}\,\mathbf{n}` (I.1.10). For a
# rectangle of six masses it varies as the axis turns in the plane. For a regular hexagon it is
# constant to rounding, so every axis in the plane is principal; the tilted hexagon of figure
# I.6.2 is an example.
#
# *Next:* try a triangle, a square, or a hexagon with one mass left out.

hexagon = ring_positions(6, radius=1.0)
rectangle = np.array([[x, y, 0] for x in (-1, 0, 1) for y in (-0.6, 0.6)])
angle = np.linspace(0, np.pi, 181)
axes = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=-1)

fig, ax = plt.subplots()
for name, places in (("hexagon", hexagon), ("rectangle", rectangle)):
    tensor = inertia_tensor(np.ones(len(places)), places)
    moments = np.array([moment_about_axis(tensor, axis) for axis in axes])
    ax.plot(np.degrees(angle), moments, label=name)
    print(f"{name}: swings by {np.ptp(moments):.1e} kg m²")
ax.set(xlabel="direction of the axis in the plane (deg)", ylabel="moment of inertia (kg m²)")
ax.set(xticks=range(0, 181, 30), ylim=(0, None))
ax.legend()

# %%
# Principal axes of a brick with a stone on one corner
# ----------------------------------------------------
# The edges of a brick are its principal axes. With a stone on one corner the tensor :math:`I_{ij}
# = \sum m\,(r^2\delta_{ij} - x_i x_j)` (I.1.3) is no longer diagonal along the edges, and the
# axes that diagonalise it (I.3.1, dashed) turn towards the stone. The moments are printed, the
# least first.
#
# *Next:* make the stone heavier, or put a second one on the opposite corner.

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

r"""
A hexagon has no preferred axis in its plane
============================================

The moment about an axis is :math:`\mathbf{n}\cdot\mathbf{I}\,\mathbf{n}` (I.1.10). For a
rectangle of six masses it swings as the axis turns. For a regular hexagon it stays the same to
rounding, however the axis is turned; so every axis in the plane is principal, those of the tilted
hexagon of figure I.6.2 too.

*Next:* try a triangle, a square, or a hexagon with one mass left out.
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.mass.rings import ring_positions
from earthspin.mass.tensor import inertia_tensor, moment_about_axis

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

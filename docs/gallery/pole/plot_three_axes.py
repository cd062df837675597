r"""
Three axes, a few milliarcseconds apart
=======================================

The Earth has three axes: of its figure, of its rotation, of its angular momentum (they are the
three lines of I.6.31). The torque keeps them apart: the figure axis stands a little off the
angular momentum and follows the fortnight of the torque, the rotation axis stays closer by a
factor of hundreds.

*Next:* switch triaxiality on, ``effects=["triaxiality"]``.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin

path = earthspin.pole("2006-01-01", "2006-07-01", "6 h")
vectors = np.stack([path.X, path.Y, path.Z], axis=-1)  # time, axis, component
axes = dict(zip(path.axis.values, np.moveaxis(vectors, 1, 0), strict=True))

fig, ax = plt.subplots()
for name in ("figure", "rotation"):
    apart = np.linalg.norm(axes[name] - axes["angular_momentum"], axis=-1)
    ax.semilogy(path.time, np.degrees(apart) * 3.6e6, label=f"{name} axis")
ax.set_ylabel("distance from the angular momentum (mas)")
ax.set_ylim(1e-4, 100)
ax.legend()

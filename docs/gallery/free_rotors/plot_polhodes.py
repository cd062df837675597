r"""
Poinsot's polhodes
==================

The tip of the angular velocity runs where two ellipsoids meet, that of the energy and that of the
angular momentum (I.5.1). For one energy and many angular momenta these curves cover the ellipsoid
of inertia as in figure I.5.6: small loops about the stable axes, and none about the middle one,
where the two families part.

*Next:* make two moments equal: all polhodes become circles (figure I.5.5).
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.rotor.poinsot import polhode

moments = np.array([1.0, 1.7, 2.3])
across, up = np.array([-0.643, 0.766, 0.0]), np.array([-0.287, -0.241, 0.927])
towards = np.cross(across, up)  # the eye

fig, ax = plt.subplots(figsize=(5.6, 4.6))
for angle in np.radians([8, 20, 32, 40, 44.2, 50, 60, 70, 82]):
    start = np.array([np.cos(angle), 0, np.sin(angle)]) / np.sqrt(moments)  # all of one energy
    stable = np.sum(moments**2 * start**2) > moments[1]
    for side in (1, -1):
        path = polhode(moments, side * start, n=1501).omega
        for seen, alpha in ((path @ towards > 0, 1.0), (path @ towards < 0, 0.04)):
            dots = path[seen]
            colour = "C1" if stable else "C0"
            ax.plot(dots @ across, dots @ up, ".", ms=1.5, alpha=alpha, color=colour)
for axis, name in zip(np.diag(moments**-0.5), "ABC", strict=True):
    ax.annotate(f"axis of {name}", (axis @ across, axis @ up), fontsize=8)
ax.set(xlabel="across the view (rad/s)", ylabel="up the view (rad/s)", aspect="equal")

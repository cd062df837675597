r"""
Poinsot's construction
======================

The ellipsoid of inertia rolls on a fixed plane: polhodes on the body, herpolhodes on the plane.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.rotor.poinsot import polhode

# %%
# Polhodes on the ellipsoid of inertia
# ------------------------------------
# The tip of the angular velocity moves along the intersection of two ellipsoids, of constant
# energy and of constant angular momentum (I.5.1). For one energy and many angular momenta the
# curves cover the ellipsoid of inertia as in figure I.5.6: closed loops about the axes of least
# and of greatest moment, and a crossing at the middle axis.
#
# *Next:* make two moments equal: all polhodes become circles (figure I.5.5).

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
ax.set(xlabel="angular velocity, horizontal in this view (rad/s)", aspect="equal")
ax.set_ylabel("angular velocity, vertical in this view (rad/s)")

# %%
# A herpolhode does not close
# ---------------------------
# In space the tip of the angular velocity stays in a plane (I.5.7), on which the ellipsoid of
# inertia rolls. It draws the herpolhode (figure I.5.9) between two circles. Each period of the
# polhode turns it by the same angle, which need not be a rational fraction of a turn, so that the
# curve need not close.
#
# *Next:* look for a start whose advance is a third of a turn.

scene = earthspin.load_scene("poinsot", {"rotor.points": 6001})
tree = earthspin.run_tree(scene, sections=["poinsot"])
rolling = tree.earthspin.section("poinsot")
advance = float(np.degrees(rolling.herpolhode_advance))

fig, ax = plt.subplots(figsize=(4.8, 4.8))
for radius in rolling.herpolhode_radius:
    ax.add_patch(plt.Circle((0, 0), radius, fill=False, ec="0.5", ls="--", lw=0.8))
ax.plot(*rolling.herpolhode.transpose("in_plane", ...).values, color="C1", lw=1)
ax.set(xlabel="angular velocity, first axis in the plane (rad/s)", aspect="equal")
ax.set_ylabel("angular velocity, second axis in the plane (rad/s)")
ax.set_title(f"advance per period of the polhode: {advance:.2f}°")

# %%
# Period of the polhode near the separatrix
# -----------------------------------------
# The period of the polhode grows as a logarithm, without limit, towards the separatrix
# (:math:`L^2 = 2TB`; in figure I.5.6 the crossing at the middle axis). The curve is drawn for
# starts between the axes of least and of greatest moment.
#
# *Next:* let the middle moment approach the least: where does the peak go?

moments = np.array([1.0, 1.7, 2.3])
a, b, c = moments
parting = np.degrees(np.arctan(np.sqrt(a * (b - a) / (c * (c - b)))))
gaps = np.geomspace(1e-6, 1, 120)
angle = np.concatenate([parting * (1 - gaps), parting + (90 - parting) * gaps])
angle = np.sort(angle[(angle > 1) & (angle < 89)])
starts = np.stack([np.cos(np.radians(angle)), 0 * angle, np.sin(np.radians(angle))], axis=-1)
period = [polhode(moments, start).period for start in starts]

fig, ax = plt.subplots()
ax.plot(angle, period)
ax.axvline(parting, color="0.5", lw=0.8, ls="--")
ax.set_title(f"separatrix at {parting:.2f}°")
ax.set_xlabel("spin at the start, from the axis of least moment (deg)")
ax.set(ylabel="period of the polhode (s)", xticks=range(0, 91, 15))

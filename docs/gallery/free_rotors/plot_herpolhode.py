r"""
The herpolhode does not close
=============================

In space the tip of the angular velocity stays in a plane (I.5.7), on which the ellipsoid of
inertia rolls. It draws the herpolhode (figure I.5.9) between two circles. Each round of the
polhode turns it by the same angle, which need not be a rational part of a turn; so the curve need
not close.

*Next:* look for a start whose advance is a third of a turn.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin

tree = earthspin.run_tree("poinsot", sections=["poinsot"])
rolling = tree["poinsot"].to_dataset(inherit=False)
advance = float(np.degrees(rolling.herpolhode_advance))

fig, ax = plt.subplots(figsize=(4.8, 4.8))
for radius in rolling.herpolhode_radius:
    ax.add_patch(plt.Circle((0, 0), radius, fill=False, ec="0.5", ls="--", lw=0.8))
ax.plot(*rolling.herpolhode.transpose("in_plane", ...).values, color="C1", lw=1)
ax.set(xlabel="in the invariable plane (rad/s)", ylabel="in the invariable plane (rad/s)")
ax.set(aspect="equal", title=f"each round turns it by {advance:.2f}°")

r"""
Error against run time
======================

The cost of a method and its error decide which method is the default.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.work_precision_views import plot_accuracy

# %%
# Position on an elliptic orbit
# -----------------------------
# Kepler's equation gives the positions of a perturber in I.8.7, here on three ellipses, the
# longest nearly a parabola. Newton's method started at the mean anomaly fails on it. From Danby's
# start (1988) it needs a few steps, and less time than the solver of ``earthspin.Orbit``, which
# stays accurate close to a parabola too.
#
# *Next:* ``earthspin.accuracy("mean-orbit")`` compares the closed form of a mean torque with
# windows.

fig, ax = plt.subplots(figsize=(7.6, 4.0))
plot_accuracy(earthspin.accuracy("elements", quick=True), ax=ax)

# %%
# Torques at many instants
# ------------------------
# Torques of Sun and Moon (I.8.7): with nutation at each instant, with nutation interpolated
# between nodes, and with plain Skyfield calls. The error is that of the torque, the run time that
# of the whole series.
#
# *Next:* set ``accuracy`` in ``earthspin.torque_series`` and read ``ds.earthspin.plan``.

fig, ax = plt.subplots(figsize=(7.6, 4.2))
plot_accuracy(earthspin.accuracy("torque", quick=True), ax=ax)

# %%
# Path of the figure axis
# -----------------------
# Path of the figure axis under the torques of I.8.7: by Picard iteration on windows of Gauss
# nodes, the method of ``earthspin.pole``, by two independent solvers that check it, and by an
# integrator of SciPy. Down and left is better.
#
# *Next:* ``accuracy="1 mas"`` in ``earthspin.pole`` takes the cheapest setting that reaches it.

fig, ax = plt.subplots(figsize=(7.6, 4.0))
plot_accuracy(earthspin.accuracy("pole", quick=True), ax=ax)

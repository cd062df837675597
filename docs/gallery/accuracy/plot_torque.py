r"""
The price of a torque
=====================

Torques of Sun and Moon (I.8.7) at many instants: with the nutation of each instant, with one that
is interpolated between nodes, and by Skyfield as one would write it. The error is that of the
torque, the run time that of the whole series.

*Next:* set ``accuracy`` in ``earthspin.torque_series`` and read ``ds.earthspin.plan``.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.work_precision_views import plot_accuracy

fig, ax = plt.subplots(figsize=(7.6, 4.2))
plot_accuracy(earthspin.accuracy("torque", quick=True), ax=ax)

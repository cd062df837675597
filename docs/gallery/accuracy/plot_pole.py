r"""
What a microarcsecond of the pole costs
=======================================

The path of the figure axis under the torques of I.8.7: by Picard's iteration on windows of Gauss
nodes, which is what ``earthspin.pole`` does, by two independent solvers that check it, and by an
integrator of SciPy's set by hand. Down and left is better.

*Next:* ``accuracy="1 mas"`` in ``earthspin.pole`` takes the cheapest setting that keeps it.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.work_precision_views import plot_accuracy

fig, ax = plt.subplots(figsize=(7.6, 4.0))
plot_accuracy(earthspin.accuracy("pole", quick=True), ax=ax)

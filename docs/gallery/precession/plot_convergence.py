r"""
An average that converges
=========================

The torque of I.8.7 swings with the fortnight, the half year and the turn of the Moon's node. A
plain mean over any stretch misses the rate of precession by whole arcseconds a century; a taper
on a whole number of turns of the node comes down to the dashed line, the error that the answer
claims for its averaging.

*Next:* average the Sun alone; how many years does it take?
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.precession import plot_convergence

tree = earthspin.run_tree("precession", sections=["convergence"])

fig, ax = plt.subplots(figsize=(6.8, 4.0))
plot_convergence(tree, ax=ax)
ax.legend(loc="lower right", bbox_to_anchor=(1, 1), ncols=4, fontsize=7.5)
ax.set_ylabel("off by (arcsec per year)")

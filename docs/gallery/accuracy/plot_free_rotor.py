r"""
The closed form against step by step
====================================

A free rotor followed for a fixed time by Jacobi's functions (the solution that the text mentions
below I.4.4), and by integrators at many tolerances. Down and left is better; no point of the
broad grey front is beaten in both. The closed form is at the last digit for the price of a coarse
integration.

*Next:* ``earthspin.accuracy("free-rotor")`` without ``quick`` measures a longer motion.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.work_precision_views import plot_accuracy

fig, ax = plt.subplots(figsize=(7.6, 4.0))
plot_accuracy(earthspin.accuracy("free-rotor", quick=True), ax=ax)

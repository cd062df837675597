r"""
Softer and later with the period
================================

Rocks give way to a slow push by more than to a seismic wave, and late. Love numbers of tide (drawn
out) and load (dashed) over those of the elastic PREM, and by which angle they lag, with a loss that
grows with a power of the period (Smith & Dahlen 1981; Wahr & Bergen 1986). The free wobble of
14 months rests on the second mark.

*Next:* ``anelastic_exponent=0.15``.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.love_numbers import plot_by_period

tree = earthspin.run_tree("love-numbers", sections=["by_period"])
fig = plt.figure(figsize=(7.2, 5))
plot_by_period(tree, figure=fig)

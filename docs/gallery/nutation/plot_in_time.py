r"""
Residuals in time, rung by rung
===============================

The predicted pole less the IAU's. A rigid Earth is off in the terms of half a year, a month and the
Moon's node; from the fluid core on, the year is left, beside the core's resonance, until the
core is as flat as its own nutation has it (Mathews, Herring & Buffett 2002).

*Next:* ``anelastic_exponent=0.0`` makes the rocks stiffer.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.nutation import plot_rung_residuals

tree = earthspin.run_tree("nutation", sections=["residuals"])
fig = plt.figure(figsize=(6.4, 7.6), layout="constrained")
plot_rung_residuals(tree, figure=fig)

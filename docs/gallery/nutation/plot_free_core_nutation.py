r"""
The free core nutation fades
============================

Amplitude of the free core nutation in the observed celestial pole offsets, in sliding windows of
three years, with the band of its error. The period is fixed at the published one (Krásná, Böhm &
Schuh 2013). Air and sea excite the core, so that the amplitude comes and goes. Below the dashed
limit an amplitude can be noise alone.

*Next:* windows of seven years, ``earthspin.pole_offsets(window="7 yr")``, lower the limit and
smooth the changes.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.pole_offsets import plot_core_nutation

tree = earthspin.run_tree("pole-offsets", sections=["core_nutation"])

fig, ax = plt.subplots(figsize=(7, 3.8))
plot_core_nutation(tree, ax=ax)

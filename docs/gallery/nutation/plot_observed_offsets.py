r"""
Observed celestial pole offsets
===============================

What IAU 2006/2000A does not contain: the free core nutation.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.observed_pole import plot_core_nutation, plot_offsets

# %%
# Celestial pole offsets since 1984
# ---------------------------------
# Observed offsets dX, dY of the celestial pole from IAU 2006/2000A: the daily series C04 of the
# IERS, from very long baseline interferometry, with half-widths as bands. The errors have
# fallen tenfold since the first years. The oscillation with a period of fourteen months is the
# free core nutation, which the model leaves out because it cannot be predicted for long (Mathews,
# Herring & Buffett 2002).
#
# *Next:* ``earthspin.pole_offsets(file="finals")`` reads the rapid series of the IERS instead.

offsets = earthspin.pole_offsets()

fig = plt.figure(figsize=(7.0, 4.8), layout="constrained")
plot_offsets(offsets, figure=fig)

# %%
# Amplitude of the free core nutation
# -----------------------------------
# Amplitude of the free core nutation in sliding windows of three years, with its error. The
# period is fixed at the published one (Krásná, Böhm & Schuh 2013). Atmosphere and ocean excite
# the core, so that the amplitude varies. Below the dashed limit an amplitude can be noise alone.
#
# *Next:* windows of seven years, ``earthspin.pole_offsets(window="7 yr")``, have a lower limit
# and show slower changes.

tree = earthspin.run_tree("pole-offsets", sections=["core_nutation"])

fig, ax = plt.subplots(figsize=(7, 3.8))
plot_core_nutation(tree, ax=ax)

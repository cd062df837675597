r"""
The path of the pole
====================

Nutation in the path of the pole, and the difference from IAU 2000A.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.iau import plot_pole_residuals
from earthspin.views.pole import plot_pole_path

# %%
# Nutation in the path of the pole
# --------------------------------
# With the uniform precession removed, the figure axis traces large loops, one for each period of
# the Moon's node, and small ones of half a year and half a month. This is nutation, the part of
# the torque that the average of I.8 removes.
#
# *Next:* two years with a step of six hours show the half-monthly nutation.

fig, ax = plt.subplots(figsize=(6.4, 4.8))
plot_pole_path(earthspin.pole("1980-01-01", "2020-01-01", "5 d"), ax=ax)

# %%
# Difference from IAU 2000A for four models
# -----------------------------------------
# Our pole minus IAU 2000A. Better celestial mechanics of a rigid Earth does not change the
# residual; the response of the Earth's interior removes it (Mathews, Herring & Buffett 2002),
# fitted in the third panel, predicted from the Earth's layers in the last. The residual of the
# third panel contains what the series of the IAU includes and no response explains, such as an
# annual atmospheric tide.
#
# *Next:* ``effects=[...]`` in ``earthspin.compare_iau`` switches each effect separately.

sections = ["residuals_by_model", "residual_sizes"]
tree = earthspin.run_tree(earthspin.load_scene("iau"), sections=sections)

fig = plt.figure(figsize=(6.4, 8.0), layout="constrained")
plot_pole_residuals(tree, figure=fig)

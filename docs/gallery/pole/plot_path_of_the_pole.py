r"""
The path of the pole
====================

Nutation in the path of the pole, and the difference from IAU 2000A.
"""

import matplotlib.pyplot as plt

import earthspin
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
# Difference from IAU 2000A for two models
# ----------------------------------------
# Our pole minus IAU 2000A. Better celestial mechanics of a rigid Earth does not change the
# residual; the response of the Earth's interior removes it (Mathews, Herring & Buffett 2002). The
# remaining residual contains what the series of the IAU includes and no response explains, such as
# an annual atmospheric tide. A constant and a rate are removed.
#
# *Next:* ``effects=[...]`` in ``earthspin.compare_iau`` switches each effect separately.

models = {"rigid, all effects": {"effects": "rigid"}, "with the response of the interior": {}}

fig, axes = plt.subplots(2, sharex=True, figsize=(6.4, 4.6))
for ax, (words, keys) in zip(axes, models.items(), strict=True):
    tree = earthspin.run_tree(earthspin.load_scene("iau", keys), sections=["residuals"])
    residuals = tree.earthspin.section("residuals")
    ax.plot(residuals.time, residuals.dpsi_sineps, lw=0.7, label="dψ sin ε")
    ax.plot(residuals.time, residuals.deps, lw=0.7, label="dε")
    ax.set_title(words, loc="left")
    ax.set_ylabel("residual (mas)")
axes[0].legend(loc="lower right", bbox_to_anchor=(1, 1), ncols=2)
axes[1].set_xlabel("time (TDB)")

r"""
Forecast of the pole
====================

A forecast over a year with its 95 % errors.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.forecast import plot_coordinates, plot_path

# %%
# A forecast beside later observations
# ------------------------------------
# Forecast from June 2018 with its 95 % band, and the pole that was observed later. The method is
# the usual state-space form of a driven oscillator (I.6.7). The ellipses contain the pole in 95 %
# of cases after 30, 90 and 365 days.
#
# *Next:* another origin, or the newest one: ``earthspin.forecast()``.

ahead = earthspin.forecast(365, "1 d", "2018-06-01", file="c04")
seen = earthspin.polar_motion(span=("2018-06-02", "2019-06-01"))

figure = plot_coordinates(ahead)
for ax, name in zip(figure.axes, ("x", "y"), strict=True):
    ax.plot(seen.time, seen[name] * 1e3, color="black", lw=1, label="observed")
    ax.legend()

fig, ax = plt.subplots(figsize=(6, 6))
plot_path(ahead, ax=ax)
ax.plot(seen.y * 1e3, seen.x * 1e3, color="black", lw=1)

r"""
Forecast of the pole
====================

A forecast over a year with its errors, beside the pole that was observed later.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.observed_pole import (
    plot_coordinates,
    plot_direction,
    plot_path,
    plot_skill,
)

# %%
# Coordinates of the pole, with error bands
# -----------------------------------------
# Forecast from June 2018, and the pole that was observed later. The Chandler wobble is a damped
# oscillator (I.6.7) driven by noise; seasonal terms and a slow drift are added.
#
# *Next:* another origin, or the newest one: ``earthspin.forecast()``.

ahead = earthspin.forecast(365, "1 d", "2018-06-01", file="c04")
seen = earthspin.polar_motion(span=("2018-06-02", "2019-06-01"))

figure = plot_coordinates(ahead, figure=plt.figure(figsize=(7.5, 5.2)))
for ax, name in zip(figure.axes, ("x", "y"), strict=True):
    ax.plot(seen.time, seen[name] * 1e3, color="black", lw=1, label="observed")
    ax.legend()

# %%
# Path of the pole, with error ellipses
# -------------------------------------
# The same forecast as a path on the ground (figure I.6.32). Each ellipse contains the pole of its
# day with the probability of all errors of this package.
#
# *Next:* a forecast over two years, ``earthspin.forecast(730)``.

fig, ax = plt.subplots(figsize=(6, 6))
plot_path(ahead, ax=ax)
ax.plot(seen.y * 1e3, seen.x * 1e3, color="black", lw=1)

# %%
# Error by horizon
# ----------------
# Mean absolute error of forecasts of the driven oscillator (I.6.7) from many origins by horizon,
# beside least squares with autoregression, the usual method, and Bulletin A of the IERS.
#
# *Next:* ``earthspin.run_tree("forecast")["skill"]`` has the numbers.

plot_skill(ahead, figure=plt.figure(figsize=(7, 5.6)))

# %%
# Error of a direction
# --------------------
# Half-width of a direction between sky and ground, from polar motion (I.6.7) and from UT1. From C04
# UT1 is forecast from observations alone.
#
# *Next:* from the newest row of finals2000A the first seven days are those of Bulletin A:
# ``earthspin.forecast(90)``.

fig, ax = plt.subplots(figsize=(7, 3.6))
plot_direction(ahead, ax=ax)

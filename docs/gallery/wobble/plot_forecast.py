r"""
The pole a year ahead
=====================

Forecast from June 2018 with its 95 % band, and what was observed later. The path of the pole has an
ellipse that holds it in 95 % of cases after 30, 90 and 365 days. The last picture is the error by
horizon, measured with many origins, beside the usual method and Bulletin A.

*Next:* another origin, or the newest one: ``earthspin.forecast()``.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.forecast import plot_coordinates, plot_path, plot_skill

ahead = earthspin.forecast(365, "1 d", "2018-06-01", file="c04")
seen = earthspin.polar_motion(span=("2018-06-02", "2019-06-01"))

figure = plot_coordinates(ahead)
for ax, name in zip(figure.axes, ("x", "y"), strict=True):
    ax.plot(seen.time, seen[name] * 1e3, color="black", lw=1, label="observed")
    ax.legend()

fig, ax = plt.subplots(figsize=(6, 6))
plot_path(ahead, ax=ax)
ax.plot(seen.y * 1e3, seen.x * 1e3, color="black", lw=1)

plot_skill(ahead)

r"""
Standstills of the Moon
=======================

The Moon's greatest declination in a month is not the Sun's, as its orbit leans by five degrees
and the line of nodes goes once round between two major standstills (figure I.8.6 and the text
below). Months come out as a dense band; its edges breathe. The marked extremes are those found in
the series; the Sun has no such swing.

*Next:* look at a single year by giving another span, with a step of an hour.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.views.drawing import note

sky = earthspin.torque_series("1985-01-01", "2030-01-01", "12 h").declination
extremes = earthspin.run_tree("precession", sections=["standstills"])["standstills"].to_dataset()
extremes = extremes.sel(standstill=slice("1985", "2029"))

fig, ax = plt.subplots(figsize=(6.8, 4.2))
ax.plot(sky.time, sky.sel(perturber="moon"), lw=0.15, color="C0", label="Moon")
ax.plot(sky.time, sky.sel(perturber="sun"), lw=0.6, color="C4", label="Sun")
ax.plot(extremes.standstill, extremes.standstill_declination, "o", ms=4, color="C1")
for one, words in zip(extremes.standstill.values, extremes.standstill_kind.values, strict=True):
    at = float(extremes.standstill_declination.sel(standstill=one))
    away = np.sign(at) * (24 if words == "minor" else 5)  # clear of the Sun
    side = "bottom" if at > 0 else "top"
    note(ax, f"{words}\n{at:+.2f}°", (one, at), (0, away), ha="center", va=side)
ax.set(ylabel="declination (deg)", ylim=(-38, 38), yticks=range(-30, 31, 10))
for line in ax.legend(loc="upper right", bbox_to_anchor=(1, 1.1), ncols=2).get_lines():
    line.set_linewidth(1.5)

r"""
Standstills of the Moon
=======================

The Moon's extreme declinations in each month vary over nineteen years.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.views.drawing import note

# %%
# Declinations of Sun and Moon over two periods of the node
# ---------------------------------------------------------
# The Moon's orbit is inclined by five degrees to the ecliptic, and its line of nodes turns once
# between two major standstills (figure I.8.6 and the text below). The months merge into a band
# whose edges vary; the northern and southern extreme of each standstill are marked. The Sun's
# extremes do not vary.
#
# *Next:* look at a single year by another span, with a step of an hour.

sky = earthspin.torque_series("1985-01-01", "2030-01-01", "12 h").declination
extremes = earthspin.run_tree("precession", sections=["standstills"]).earthspin.section(
    "standstills"
)
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
ax.set(xlabel="time (TDB)", ylabel="declination (deg)", ylim=(-38, 38), yticks=range(-30, 31, 10))
for line in ax.legend(loc="upper right", bbox_to_anchor=(1, 1.1), ncols=2).get_lines():
    line.set_linewidth(1.5)

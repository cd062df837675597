r"""
Mars from many starts
=====================

The obliquity of Mars swings by tens of degrees, because its axis precesses nearly as slowly as its
orbit turns. Forty members of one ensemble start within a degree of where the axis is today, and are
followed side by side on one orbit. For five million years into the past they swing together, half
of the time within four degrees of one another and never more than thirteen; then they part into two
bands, and what two degrees were becomes more than thirty. The motion is chaotic, even on an orbit
that is given (Laskar & Robutel 1993): no error bar that grows evenly would tell it.

*Next:* starts that are turned about the normal of the orbit, ``longitude_shift``.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin

scene = earthspin.load_scene(
    "long-term",
    {"body": "mars", "perturbers": ["sun"], "span": ["-8 Myr", "0 kyr"], "step": "10 kyr"},
)
starts = {"obliquity_shift": {"grid": [f"{shift} deg" for shift in np.linspace(-1, 1, 40)]}}
mars = earthspin.ensemble(scene, starts)

fig, ax = plt.subplots(figsize=(7.4, 4.0), layout="constrained")
shifts = np.degrees(mars.obliquity_shift.values)
colours = plt.get_cmap("viridis")((shifts + 1) / 2)
for colour, obliquity in zip(colours, mars.obliquity.values, strict=True):
    ax.plot(mars.epoch / 1e6, obliquity, color=colour, lw=0.6)
shown = plt.cm.ScalarMappable(plt.Normalize(-1, 1), "viridis")
fig.colorbar(shown, ax=ax, label="shift of the obliquity today (deg)")
ax.set_xlabel("time from J2000.0 (million years)")
ax.set_ylabel("obliquity of Mars (deg)")
ax.margins(x=0)

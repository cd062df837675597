r"""
Earth, an Earth without Moon, and Mars
======================================

How long one turn of precession takes depends on who pulls and how fast and flat the body is
(I.8). Without the Moon the Earth needs three times as long, for its Sun alone does a third of the
work; Mars, with small moons and half again as far from the Sun, is slower still. The 95 % errors
come from the inputs and are smaller than the dots.

*Next:* give Mars the Earth's day, ``MARS.replace(spin_period=...)``.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin import EARTH, MARS
from earthspin.views.drawing import note
from earthspin.views.table import measured

worlds = {
    "Earth": earthspin.precession(body=EARTH),
    "Earth\nwithout Moon": earthspin.precession(body=EARTH, perturbers=["sun"]),
    "Mars": earthspin.precession(body=MARS, perturbers=["sun"]),
}

fig, ax = plt.subplots()
for row, found in enumerate(worlds.values()):
    all_of_it = found.isel(perturber=-1)
    period, error = all_of_it.precession_period / 1e3, all_of_it.precession_period_error / 1e3
    ax.errorbar(period, row, xerr=error, fmt="o", color=f"C{row}", capsize=3)
    words = measured(all_of_it, "precession_period") + " years"
    note(ax, words, (float(period), row), (8, 0), va="center")
ax.set_yticks(range(3), worlds)
ax.set(xlabel="one turn of precession (1000 years)", xlim=(0, 230), ylim=(2.6, -0.6))

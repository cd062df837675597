r"""
Obliquity over millions of years
================================

The obliquity of the Earth and of Mars, and what limits the solutions.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.views.long_term import plot_budget, plot_climate, plot_periods

# %%
# Obliquity of the Earth over two million years
# ---------------------------------------------
# The orbital plane moves, and the axis precesses about its normal, so that the obliquity varies
# by two degrees with a period of some forty-one thousand years (Laskar et al. 2004). The band is
# the error. Most of it comes from the mean ellipticity of the past Earth and from its tides;
# it grows with the distance from today, and is widest where the obliquity changes fastest.
#
# *Next:* leave the tides out, ``tides=0``, or change the ellipticity by a thousandth,
# ``ellipticity=1.001``.

fig, ax = plt.subplots(figsize=(7.6, 3.2))
plot_climate(earthspin.long_term("-1 Myr", "1 Myr", "1 kyr"), ax=ax)
ax.set_xlabel("time from J2000.0 (1000 years)")

# %%
# Period of precession over time
# ------------------------------
# Period at the rate of each epoch, by Sun and Moon together and by each alone. The rate varies
# with the cosine of the obliquity, and the Sun's share also with the eccentricity; over long
# times tides move the Moon outwards and slow the spin, and the period increases (Quinn, Tremaine
# & Duncan 1991). The band is the error.
#
# *Next:* Mars, whose obliquity varies far more: ``earthspin.long_term(body="mars")``.

of = earthspin.long_term("-400 kyr", "400 kyr", "1 kyr")

fig, rows = plt.subplots(3, sharex=True, figsize=(7.2, 5.4))
for row, label in zip(rows, ("total", "moon", "sun"), strict=True):
    plot_periods(of.sel(perturber=[label]), ax=row)
    row.set(xlabel="", ylabel=f"period, {label}\n(1000 years)")
rows[-1].set_xlabel("time from J2000.0 (1000 years)")
fig.align_ylabels(rows)

# %%
# Causes of the error of the longitude of perihelion
# --------------------------------------------------
# Each input of the solution is changed by its half-width, and the equation is solved again; the
# change of the longitude of perihelion is the contribution of this input. Near the present the
# orbit dominates, whose short-period part is left out; from some ten thousand years on the
# present rate of :math:`J_2`, which cannot continue; from a hundred thousand years on the
# ellipticity and the tides of the past Earth (Quinn, Tremaine & Duncan 1991). The error of the
# integration is below the frame for most of the span.
#
# *Next:* ten million years, ``earthspin.run_tree(scene)`` with ``span = ["-10 Myr", "0 kyr"]``.

tree = earthspin.run_tree(
    earthspin.load_scene("long-term", {"span": ["-2 Myr", "0 kyr"], "step": "500 yr"}), ["budget"]
)

fig, ax = plt.subplots(figsize=(7.4, 4.0))
plot_budget(tree, ax=ax)

# %%
# Mars from many starts
# ---------------------
# The obliquity of Mars varies by tens of degrees, because its axis precesses nearly as slowly as
# its orbit. Forty members of one ensemble start within a degree of the present axis and are
# integrated side by side on one orbit. For five million years into the past they stay together,
# half of the time within four degrees of one another and never more than thirteen; then they
# separate into two bands, and two degrees become more than thirty. The motion is chaotic even on
# a prescribed orbit (Laskar & Robutel 1993), so that an error that grows evenly would be wrong.
#
# *Next:* rotate the starts about the normal of the orbit, ``longitude_shift``.

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

r"""
Sunlight of the ice ages
========================

Three measures of the northern summer with errors, their difference from La2004, and the error of
the phase.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin

# %%
# June, caloric and integrated summer at 65° N
# --------------------------------------------
# The day of the June solstice follows mainly precession; the caloric half-year of Milankovitch and
# the insolation summed over days above 275 W/m² (Huybers 2006) follow mainly the obliquity. The
# bands, 95 %, are narrower than the lines for most of the time. Below each is the difference from
# La2004 over the last 200,000 years, with the same band: the two solutions agree within it.
#
# *Next:* another latitude, or ``mean="extremes"``.

past = earthspin.long_term("-1 Myr", "0 kyr", "1 kyr")
laskar = earthspin.read_solution("../../../tests/data/la2004-excerpt.txt")
measures = {
    "insolation": ({}, "June\nsolstice (W/m²)"),
    "caloric_summer": ({"mean": "caloric"}, "caloric\nsummer (W/m²)"),
    "integrated_summer": ({"mean": "above", "threshold": "275 W/m2"}, "above\n275 W/m² (GJ/m²)"),
}

fig, rows = plt.subplots(6, figsize=(7.6, 9.0), sharex=True, layout="constrained")
for (name, (keys, label)), row, below in zip(measures.items(), rows[::2], rows[1::2], strict=True):
    found = earthspin.daily_insolation(past, "65N", **keys)
    scale = found[name].attrs["solar_constant"]
    theirs = earthspin.daily_insolation(laskar, "65N", solar_constant=scale, **keys)
    kyr, value, error = found.epoch / 1000, found[name], found[f"{name}_error"]
    row.fill_between(kyr, value - error, value + error, alpha=0.4, lw=0)
    row.plot(kyr, value, lw=0.8)
    difference = (found - theirs)[name]
    recent = error.sel(epoch=difference.epoch)
    below.fill_between(recent.epoch / 1000, -recent, recent, alpha=0.4, lw=0)
    below.plot(difference.epoch / 1000, difference, color="C1", lw=0.8)
    row.set_ylabel(label)
    below.set_ylabel(f"less\nLa2004 ({label.partition(' (')[2]}")
    row.margins(x=0)
rows[-1].set_xlabel("time from J2000.0 (1000 years)")
fig.align_ylabels(rows)

# %%
# Error of the phase
# ------------------
# The error of the longitude of perihelion, divided by its rate, is the time by which the seasons of
# perihelion may be shifted. It grows about with the square of the distance from today, because
# tides and figure of the past Earth change the rate of precession. Beyond half a period of climatic
# precession, some 10,000 years, the season of perihelion is lost.
#
# *Next:* ``earthspin.run_tree(past, ["budget"])`` names the causes.

far = earthspin.long_term("-10 Myr", "0 kyr", "10 kyr")
rate = np.abs(np.gradient(far.longitude_of_perihelion.values, far.epoch.values)).mean()
shift = far.longitude_of_perihelion_error / rate / 1000

fig, ax = plt.subplots(figsize=(7.6, 3.2), layout="constrained")
ax.loglog(-far.epoch[:-1] / 1e6, shift[:-1])
ax.axhline(10, color="0.6", ls="--", lw=0.8)
ax.set_xlabel("time before J2000.0 (million years)")
ax.set_ylabel("error of the phase\nof precession (1000 years)")

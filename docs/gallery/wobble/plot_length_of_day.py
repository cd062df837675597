r"""
Length of day
=============

The tides in the length of day, and what is left of it.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.length_of_day import plot_observed_day

# %%
# A year of observed days
# -----------------------
# Excess of the length of day over 86,400 s in the series C04 of the IERS. The zonal tides of Sun
# and Moon, dashed about the mean, follow from declination and distance of the two bodies with two
# numbers, a response of 0.94 and a delay of 0.13 days (Yoder, Williams & Parke 1981). What
# remains, below, is mostly angular momentum of the winds: seasons, and swings of some weeks.
#
# *Next:* ``earthspin.observed_day(tides="taken out")`` returns the lower series.

day = earthspin.observed_day("2025-01-01", "2026-01-01")

fig = plt.figure(figsize=(7.0, 4.8), layout="constrained")
plot_observed_day(day, figure=fig)

# %%
# The tides of Sun and Moon
# -------------------------
# A body on the equator makes the Earth flatter and the day longer, one far from the equator makes
# the day shorter. The Moon crosses the equator every 13.7 days, and its distance changes in 27.6
# days; the Sun crosses it at the equinoxes.
#
# *Next:* over ``("1997-01-01", "2016-01-01")`` the fortnightly tide swells and shrinks with the
# inclination of the Moon's orbit to the equator.

tides = earthspin.length_of_day("2025-01-01", "2025-07-01", "6 h")

fig, ax = plt.subplots(figsize=(7, 3.6), layout="constrained")
tides.length_of_day.plot.line(x="time", ax=ax)
ax.set(xlabel="time (TDB)", ylabel="change of the length of day (ms)")

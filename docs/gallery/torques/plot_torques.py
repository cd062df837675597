r"""
Torques of Sun, Moon and planets
================================

The torque on the equatorial bulge as a function of time, of declination and of the perturber.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin import EARTH, MOON, SUN
from earthspin.constants import G
from earthspin.mass.figure import moment_difference
from earthspin.views.torque import plot_declination, plot_torque

# %%
# Torque through a year
# ---------------------
# Sun and Moon exert a torque on the Earth's bulge whenever they are off the equator (I.8.7). The
# component towards the equinox is nearly proportional to the square of the declination: it has
# the same sign in summer and in winter and does not average out. Its mean (dashed) causes
# precession. The Moon's torque is larger and has a period of half a month.
#
# *Next:* take a year nine years later, when the Moon's declinations are smallest.

year = earthspin.torque_series("2006-01-01", "2007-01-01", "6 h")

fig, (upper, lower) = plt.subplots(2, 1, figsize=(6.4, 4.8), sharex=True)
plot_declination(year, ax=upper)
plot_torque(year, ax=lower)
lower.set_ylabel("torque towards\nthe equinox (10²² N m)")

# %%
# Torque against declination
# --------------------------
# Each instant of nineteen years is a dot. The torque is proportional to
# :math:`\sin\delta\cos\delta` (I.8.7), nearly a straight line at these declinations. The Moon's
# dots form a band because the torque varies with the inverse cube of its distance. The dashed
# line uses the mean of the inverse cube.
#
# *Next:* colour the dots by distance.

seen = earthspin.torque_series("2000-01-01", "2019-01-01", "1 d")
bulge = moment_difference(EARTH.j2, EARTH.gm / G.value, EARTH.radius)  # C - A, kg m2
delta = np.radians(np.linspace(-29, 29, 100))

fig, ax = plt.subplots()
for body, colour in ((MOON, "C0"), (SUN, "C4")):
    of = seen.sel(perturber=body.name)
    size = of.torque_magnitude / 1e22
    ax.plot(of.declination, size, ".", ms=1.2, color=colour, label=body.name)
    law = 3 * body.gm * bulge * float((of.distance**-3.0).mean()) * np.sin(delta) * np.cos(delta)
    ax.plot(np.degrees(delta), np.abs(law) / 1e22, "k--", lw=0.8)
ax.set(xlabel="declination (deg)", ylabel="torque (10²² N m)", ylim=(0, None))
ax.legend(markerscale=8)

# %%
# Torques of the planets
# ----------------------
# The torque is proportional to mass over distance cubed (I.8.7). The Moon's is larger than the
# Sun's, and those of the planets are smaller by orders of magnitude; Venus has the largest when
# it is near. Bars: the largest torque in eight years, the shortest span after which Venus repeats
# its positions.
#
# *Next:* add the missing planets, or change the span to one approach of Mars.

pulls = ["moon", "sun", "venus", "jupiter", "mars", "saturn", "mercury", "uranus", "neptune"]
seen = earthspin.torque_series("2016-01-01", "2024-01-01", "2 d", perturbers=pulls)
largest = seen.torque_magnitude.max("time").sortby(seen.torque_magnitude.max("time"))

fig, ax = plt.subplots()
ax.barh(largest.perturber, largest, color="C0")
for row, value in enumerate(largest.values):
    ax.annotate(f"{value:.1e}", (value, row), (4, 0), textcoords="offset points", va="center")
ax.set(xscale="log", xlabel="largest torque (N m)", xlim=(1e12, 1e25))
ax.grid(axis="y", visible=False)

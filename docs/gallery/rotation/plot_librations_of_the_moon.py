r"""
Librations of the Moon
======================

The face of the Moon over a revolution of its node, and the difference from DE421, effect by effect.
"""

import matplotlib.pyplot as plt
import numpy as np
from scipy.spatial.transform import Rotation

import earthspin
from earthspin.bodies.librations import mean_earth_matrix
from earthspin.sky.ephemeris import open_ephemeris

# %%
# Librations beside DE421
# -----------------------
# The point of the Moon that has the Earth in its zenith moves by up to 8° in longitude, as the
# orbit is eccentric, and by 7° in latitude, as the equator is inclined to the orbit (lines:
# ``rotation`` with its defaults; dots: the librations of DE421). Below is the angle between both
# attitudes, with all effects and with each left out alone, from the same state in 2008. With all,
# the attitude stays within five milliarcseconds.
#
# *Next:* ``BodyFixed(model=moon, axes="mean-earth")`` gives both angles in astropy.

with open("de421_librations.txt") as table:
    names = table.readline().strip("# \n").split(", ")
    jd, *columns = np.loadtxt(table, unpack=True)
de421 = Rotation.from_euler("ZXZ", np.transpose(columns[:3]))
ephemeris = open_ephemeris("de421")


def face(attitudes, days):
    """Longitude and latitude of the Earth in the mean-Earth axes of the Moon, deg."""
    earth = ephemeris.positions({"earth": 399}, 301, days)["earth"]
    x, y, z = mean_earth_matrix() @ attitudes.inv().apply(earth).T
    return np.degrees([np.arctan2(y, x), np.arctan2(z, np.hypot(x, y))])


moon = earthspin.rotation("2008-01-01", "2026-08-14", "1 d", body="moon")
found = Rotation.from_quat(moon.attitude, scalar_first=True)
lines = face(found, jd[0] - 2451545 + np.arange(moon.time.size))
dots = face(de421, jd - 2451545)

fig, rows = plt.subplots(
    3, figsize=(7.6, 7.2), sharex=True, height_ratios=[1, 1, 1.8], layout="constrained"
)
dates = moon.time.values[::10]
for row, line, dot, name in zip(rows, lines, dots, ("long", "lat"), strict=False):
    row.plot(moon.time, line, lw=0.4, label="rotation")
    row.plot(dates[::4], dot[::4], "k.", ms=2.5, label="DE421")
    row.set_ylabel(f"{name}itude (deg)")
rows[0].legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=2)
for name, off in zip(names[4:], columns[3:], strict=True):
    rows[2].semilogy(dates, off, lw=0.9, label=name.removesuffix(" (mas)"))
off = 3.6e6 * np.degrees((de421.inv() * found[::10]).magnitude())
rows[2].semilogy(dates, off, lw=0.9, color="k", label="all effects")
rows[2].set_ylabel("difference from DE421 (mas)")
rows[2].legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=3)

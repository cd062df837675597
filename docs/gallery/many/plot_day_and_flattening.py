r"""
A map of Earths that might be
=============================

Two labelled arrays, the length of the day and the dynamical flattening, broadcast to a plane of
Earths in one call. The rate of precession goes with the flattening and against the spin (I.8), so
lines of equal period are hyperbolas. The dot is ours.

*Next:* let the flattening follow from the spin, as in a body in equilibrium.
"""

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr

import earthspin
from earthspin import EARTH

day = xr.DataArray(np.linspace(6, 36, 60), dims="day")  # hours
h = xr.DataArray(np.linspace(1e-3, 8e-3, 50), dims="h")
many = EARTH.replace(spin_period=day * 3600.0, dynamical_flattening=h, j2=0.33 * h)
period = earthspin.precession(body=many).precession_period.sel(perturber="total") / 1e3

fig, ax = plt.subplots()
levels = [5, 10, 20, 30, 50, 100, 200]
lines = ax.contour(day, h * 1e3, period.transpose("h", "day"), levels, cmap="viridis", norm="log")
ax.clabel(lines, fmt="%g", fontsize=8)
ax.plot(EARTH.spin_period / 3600, EARTH.dynamical_flattening * 1e3, "o", color="C1")
ax.set(xlabel="sidereal day (h)", ylabel="dynamical flattening (10$^{-3}$, ratio)")
ax.set_title("thousands of years for one turn")

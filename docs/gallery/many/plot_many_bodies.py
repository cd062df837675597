r"""
Many bodies in one call
=======================

Fields of a body may be arrays with named dimensions.
"""

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr

import earthspin
from earthspin import EARTH

# %%
# Period over length of day and flattening
# ----------------------------------------
# Two labelled arrays, the length of the day and the dynamical flattening, broadcast to a plane of
# Earths in one call. The rate of precession is proportional to the flattening and inversely
# proportional to the spin rate (I.8), so that lines of equal period are hyperbolas. The dot is
# the real Earth.
#
# *Next:* let the flattening follow from the spin, as for a body in hydrostatic equilibrium.

day = xr.DataArray(np.linspace(6, 36, 60), dims="day")  # hours
h = xr.DataArray(np.linspace(1e-3, 8e-3, 50), dims="h")
many = EARTH.replace(spin_period=day * 3600.0, dynamical_flattening=h, j2=0.33 * h)
period = earthspin.precession(body=many).precession_period.sel(perturber="total") / 1e3

fig, ax = plt.subplots()
levels = [5, 10, 20, 30, 50, 100, 200]
lines = ax.contour(day, h * 1e3, period.transpose("h", "day"), levels, cmap="viridis", norm="log")
ax.clabel(lines, fmt="%g", fontsize=8)
ax.plot(EARTH.spin_period / 3600, EARTH.dynamical_flattening * 1e3, "o", color="C1")
ax.set(xlabel="sidereal day (h)", ylabel="dynamical flattening (10$^{-3}$)")
ax.set_title("period of precession (1000 years)")

# %%
# Three hundred rackets
# ---------------------
# Starts may be arrays too: rackets spin about the middle axis (I.5, the book with a rubber band),
# each with another small random tilt. They flip together at first, and at different times later;
# the mean of all (black) decays, although no racket loses energy.
#
# *Next:* take the axis of the greatest moment: all stay together.

rng = np.random.default_rng(4)
starts = np.column_stack([rng.normal(0, 0.02, 300), np.ones(300), rng.normal(0, 0.02, 300)])
rackets = earthspin.free_rotor([1, 2, 2.8], starts, np.linspace(0, 120, 601))
spin = rackets.omega_body.sel(component="y").transpose("time", ...)

fig, ax = plt.subplots()
ax.plot(rackets.time, spin, color="C0", lw=0.3, alpha=0.12)
ax.plot(rackets.time, spin.mean(spin.dims[1]), "k", label="mean of all")
ax.set(xlabel="time (s)", ylabel="spin about the middle axis (rad/s)")
ax.legend(loc="lower right", bbox_to_anchor=(1, 1))

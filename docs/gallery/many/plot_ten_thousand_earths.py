r"""
Ten thousand Earths
===================

The dynamical flattening of the Earth is known within an uncertainty (Mathews, Herring & Buffett
2002). Ten thousand Earths are drawn from it and handed to one call; the histogram is how
uncertain the period of precession (I.8) is for that reason alone. The curve is the error that a
single answer claims, as a normal law: a little wider, for it counts the averaging too.

*Next:* draw the masses of Sun and Moon as well.
"""

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr

import earthspin
from earthspin import EARTH

h, u = EARTH.dynamical_flattening, EARTH.relative_uncertainty["dynamical_flattening"]
draws = xr.DataArray(np.random.default_rng(1).normal(h, u * h, 10_000), dims="earth")
periods = earthspin.precession(body=EARTH.replace(dynamical_flattening=draws)).precession_period
periods = periods.sel(perturber="total")
one = earthspin.precession().sel(perturber="total")
middle, claimed = float(one.precession_period), float(one.precession_period_error) / 1.96

fig, ax = plt.subplots()
ax.hist(periods - middle, bins=60, density=True, color="C0", alpha=0.6, label="10 000 Earths")
off = np.linspace(-4, 4, 201) * claimed
law = np.exp(-((off / claimed) ** 2) / 2) / (claimed * np.sqrt(2 * np.pi))
ax.plot(off, law, "C1", label="claimed by one answer")
ax.set_xlabel(f"period of precession less {middle:.3f} years (years)")
ax.set_ylabel("density (1/year)")
ax.set_title(f"scatter {float(periods.std()):.4f}, claimed {claimed:.4f} years")
ax.legend()

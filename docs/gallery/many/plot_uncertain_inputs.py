r"""
Uncertain inputs
================

Ten thousand Earths with inputs drawn from their published uncertainties.
"""

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr

import earthspin
from earthspin import EARTH

# %%
# Uncertainty of the period from the dynamical flattening
# -------------------------------------------------------
# The dynamical flattening is known with an uncertainty (Mathews, Herring & Buffett 2002). Ten
# thousand values are drawn from it and passed to one call; the histogram is the resulting
# uncertainty of the period of precession (I.8). The curve is the error that a single answer
# claims, as a normal distribution: slightly wider, because it includes the error of the average.
#
# *Next:* draw the masses of Sun and Moon too.

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
ax.set_xlabel(f"period of precession minus {middle:.3f} years (years)")
ax.set_ylabel("density (1/year)")
ax.set_title(f"scatter {float(periods.std()):.4f}, claimed {claimed:.4f} years")
ax.legend()

# %%
# Which input causes the spread
# -----------------------------
# Ten thousand Earths within the published uncertainties of :math:`H`, :math:`J_2`, radius and
# masses. The rate of precession depends almost entirely on :math:`H`, the torque on :math:`J_2`
# and the radius (I.8): the rate is the ratio of torque to angular momentum, and :math:`C` is a
# factor of both.
#
# *Next:* draw :math:`J_2` and :math:`H` with a correlation, and look at the sum of the shares.

earths = earthspin.ensemble("precession", 10_000).sel(perturber="total")
shares = earths.earthspin.sensitivity()

fig, (left, right) = plt.subplots(1, 2, figsize=(8, 4), layout="constrained")
for ax, name, given, symbol in (
    (left, "precession_rate", "body_dynamical_flattening", "$H$"),
    (right, "mean_torque", "body_j2", "$J_2$"),
):
    x, y = earths[given], earths[name]
    ax.plot((x / x.mean() - 1) * 1e6, (y / y.mean() - 1) * 1e6, ".", ms=1, alpha=0.3)
    share = float(shares[f"{name}_share"].sel(input=x.attrs["input"]))
    ax.set_title(f"{name.replace('_', ' ')}: {100 * share:.1f} % of\nthe variance from {symbol}")
    ax.set_ylabel(f"relative change of the {name.replace('_', ' ')} (10$^{{-6}}$)")
    ax.set_xlabel(f"relative change of {symbol} (10$^{{-6}}$)")

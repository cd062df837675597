r"""
Twenty-six thousand years, more or less
=======================================

One turn of precession at the rate of each epoch, by Sun and Moon together, and by each alone. The
rate goes as the cosine of the obliquity, and the Sun's share with the eccentricity, too; slowly,
tides take the Moon away and slow the spin, and turns grow longer (Quinn, Tremaine & Duncan 1991).
The band is the half-width of all that is not known.

*Next:* Mars, whose obliquity swings far more: ``earthspin.long_term(body="mars")``.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.long_term import plot_periods

of = earthspin.long_term("-400 kyr", "400 kyr", "1 kyr")

fig, rows = plt.subplots(3, sharex=True, figsize=(7.2, 5.4))
for row, label in zip(rows, ("total", "moon", "sun"), strict=True):
    plot_periods(of.sel(perturber=[label]), ax=row)
    row.set(xlabel="", ylabel=f"{label} (1000 years)")
rows[-1].set_xlabel("time from J2000.0 (1000 years)")
fig.align_ylabels(rows)

r"""
Three rulers for one stretch of time
====================================

Answers count Julian years from ``J2000.0``, negative before. Palaeoclimate writes years "before
present", where the present is 1950: a table counted from the one and read as the other is fifty
years off. Dates such as ``"-3000-01-01"`` are of the proleptic Gregorian calendar with a year 0, so
that 3001 BC is the year -3000. In it the equinox drifts by a day in three thousand years; in the
Julian calendar, which historians use for antiquity, by three weeks (Meeus 1998).

*Next:* ``earthspin.long_term(times=["-3000-01-01"])``, and see its ``epoch``.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.stars import year_words

of = earthspin.long_term("-7 kyr", "1 kyr", "50 yr")

fig, ax = plt.subplots(figsize=(7.0, 4.2))
ax.plot(of.epoch, of.obliquity)
ax.set(xlabel="Julian years from J2000.0 (years)", ylabel="obliquity (deg)", xlim=(-7000, 1000))
before = ax.secondary_xaxis(-0.24, functions=(lambda t: -50 - t, lambda bp: -50 - bp))
before.set_xlabel("years before 1950, BP (years)")
calendar = [-4999, -3999, -2999, -1999, -999, 1, 1000, 2000, 3000]
years = ax.secondary_xaxis("top", functions=(lambda t: t + 2000, lambda year: year - 2000))
years.set_xticks(calendar, [year_words(year) for year in calendar])

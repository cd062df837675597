r"""
What IAU 2006/2000A lacks
=========================

Observed offsets dX, dY of the celestial pole from IAU 2006/2000A: the daily series C04 of the IERS,
from very long baseline interferometry, with its half-widths in grey. The errors fell tenfold since
the first years. The wave of fourteen months is the free core nutation, which is no part of the
model (Mathews, Herring & Buffett 2002), because nobody can predict it for long.

*Next:* ``earthspin.pole_offsets(file="finals")`` reads the rapid series of the IERS instead.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.pole_offsets import plot_offsets

offsets = earthspin.pole_offsets()

fig = plt.figure(figsize=(7.0, 4.8), layout="constrained")
plot_offsets(offsets, figure=fig)

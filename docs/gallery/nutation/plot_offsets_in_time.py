r"""
What IAU 2006/2000A lacks
=========================

Observed offsets dX, dY of the celestial pole from IAU 2006/2000A: the daily series C04 of the IERS,
from very long baseline interferometry, with its 95 % half-widths in grey. The errors fell from half
a milliarcsecond in 1985 to a twentieth of one. The wave of about 430 days is the free core
nutation, which no model predicts.

*Next:* ``earthspin.pole_offsets(file="finals")`` reads the rapid series of the IERS instead.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.pole_offsets import plot_offsets

offsets = earthspin.pole_offsets()

fig = plt.figure(figsize=(7.0, 4.8), layout="constrained")
plot_offsets(offsets, figure=fig)

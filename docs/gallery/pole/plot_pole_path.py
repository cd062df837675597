r"""
The pole nods while it precesses
================================

With the steady precession removed, the figure axis runs through large loops, one for each turn of
the Moon's node, and small ones of half a year and a fortnight: nutation, the answer of the axis
to all that the average of I.8 leaves out.

*Next:* two years with a step of six hours show the fortnight.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.pole import plot_pole_path

fig, ax = plt.subplots(figsize=(6.4, 4.8))
plot_pole_path(earthspin.pole("1980-01-01", "2020-01-01", "5 d"), ax=ax)

r"""
The obliquity over two million years
====================================

The plane of the orbit nods, and the axis, which precesses about it, follows at a distance that
swings by two degrees in some forty-one thousand years (Laskar et al. 2004). The band is what is not
known: mostly how round the Earth was on average, and how fast its tides were. It grows with the
distance from today, and is widest where the obliquity changes fastest.

*Next:* leave the tides out, ``tides=0``, or take the Earth a thousandth flatter,
``ellipticity=1.001``.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.long_term import plot_climate

fig, ax = plt.subplots(figsize=(7.6, 3.2))
plot_climate(earthspin.long_term("-1 Myr", "1 Myr", "1 kyr"), ax=ax)
ax.set_xlabel("time from J2000.0 (1000 years)")

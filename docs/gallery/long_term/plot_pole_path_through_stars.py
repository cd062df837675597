r"""
The path of the pole does not close
===================================

Today's rate and obliquity would carry the pole round a circle (I.8, "Precession of the
equinoxes"). The real pole goes round a pole of the ecliptic that moves, at a rate that changes:
half a turn ahead it lies some degrees from where it was half a turn ago. About 2800 BC, a
century before the Old Kingdom of Egypt, Thuban was within a third of the Moon's width of the pole.

*Next:* print ``tree["matrices"]`` of ``run_tree`` and turn a star with its proper motion.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.long_term import plot_pole

fig, ax = plt.subplots(figsize=(6.5, 6.3))
plot_pole(earthspin.long_term("-13 kyr", "13 kyr", "1 kyr"), ax=ax)
ax.set(xlim=(-33.5, 31), ylim=(-32, 30))

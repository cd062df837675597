r"""
The round that takes for ever
=============================

A round of the polhode takes longer the nearer it comes to the curve that parts the two families
(:math:`L^2 = 2TB`, in figure I.5.6 the crossing through the middle axis). There the period grows
without limit, as a logarithm. The curve is drawn for starts between the axes of least and of
greatest moment.

*Next:* let the middle moment approach the least: where does the peak go?
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.rotor.poinsot import polhode

moments = np.array([1.0, 1.7, 2.3])
a, b, c = moments
parting = np.degrees(np.arctan(np.sqrt(a * (b - a) / (c * (c - b)))))
gaps = np.geomspace(1e-6, 1, 120)
angle = np.concatenate([parting * (1 - gaps), parting + (90 - parting) * gaps])
angle = np.sort(angle[(angle > 1) & (angle < 89)])
starts = np.stack([np.cos(np.radians(angle)), 0 * angle, np.sin(np.radians(angle))], axis=-1)
period = [polhode(moments, start).period for start in starts]

fig, ax = plt.subplots()
ax.plot(angle, period)
ax.axvline(parting, color="0.5", lw=0.8, ls="--")
ax.set_title(f"the families part at {parting:.2f}°")
ax.set_xlabel("spin at the start, from the axis of least moment (deg)")
ax.set(ylabel="period of the polhode (s)", xticks=range(0, 91, 15))

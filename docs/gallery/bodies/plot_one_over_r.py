r"""
One over the distance, term by term
===================================

All of potential theory here stands on one series: :math:`1/R` as a sum over Legendre functions of
the smaller and the larger radius (I.9.12). Each degree gains a factor :math:`r_</r_>`, so that it
converges fast from far away and slowly near the source. The error (dots) stays under its bound
(lines) to the last digit of a float.

*Next:* let the ratio approach one, and count the terms.
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.mass.multipoles import inverse_distance, inverse_distance_bound

source = np.array([0.6, 0.0, 0.8])
degrees = np.arange(0, 41, 2)

fig, ax = plt.subplots()
for number, ratio in enumerate((0.1, 0.5, 0.9)):
    place = np.array([0.0, 0.6, 0.8]) / ratio
    exact = 1 / np.linalg.norm(place - source)
    off = [abs(inverse_distance(place, source, n) / exact - 1) for n in degrees]
    bound = [inverse_distance_bound(place, source, n) / exact for n in degrees]
    ax.semilogy(degrees, np.maximum(off, 1e-16), "o", ms=3.5, color=f"C{number}")
    ax.semilogy(degrees, bound, color=f"C{number}", lw=0.9, label=f"{ratio:g}")
ax.set(xlabel="last degree of the series (number)", ylabel="relative error of 1/R")
ax.set_ylim(3e-17, 30)
ax.legend(title="smaller over larger radius")

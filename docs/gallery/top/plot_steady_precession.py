r"""
Two ways to go round steadily
=============================

At a given inclination a spinning top can circle without nodding in two ways, slowly and fast (end
of I.7). The slow one is the textbook's: weight over spin. The fast one hardly knows the weight.
Below a least spin, where both meet, there is none.

*Next:* tilt the axis below the horizontal: the least spin is gone.
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.top.start import HeavyTop
from earthspin.top.steady import minimum_spin, steady_precession

shape = {"transverse_moment": 1.0, "axial_moment": 1.2, "weight_moment": 1.5}
least = float(minimum_spin(HeavyTop(**shape, theta=np.radians(40), spin=1.0)))
spin = least * np.geomspace(1, 6, 200)
rates = steady_precession(HeavyTop(**shape, theta=np.radians(40), spin=spin))

fig, ax = plt.subplots()
ax.loglog(spin, rates.fast, label="fast")
ax.loglog(spin, rates.slow, label="slow")
ax.loglog(spin, 1.5 / (1.2 * spin), "k--", lw=0.8, label="weight over spin")
ax.axvline(least, color="0.5", lw=0.8)
ax.set(xlabel="spin (rad/s)", ylabel="steady precession (rad/s)")
ax.set_xticks(ticks := [2, 3, 5, 10], [f"{tick}" for tick in ticks])
ax.minorticks_off()
ax.set_title(f"none below {least:.3f} rad/s")
ax.legend()

r"""
A top wakes up
==============

A fast top stands upright and sleeps. Below a critical spin, :math:`\omega_3^2 = 4\,I_1 mgr/I_3^2`
(from I.7.16 with a double root at the vertical), the least push makes it fall to an angle and
rise again, for ever. Friction slows a real top down this curve.

*Next:* move the weight lower and see the critical spin fall.
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.top.start import HeavyTop
from earthspin.top.steady import sleeping_top

spin = np.linspace(0.5, 7, 400)
fig, ax = plt.subplots()
for weight in (0.5, 1.0, 2.0):
    top = HeavyTop(
        transverse_moment=1.0, axial_moment=0.5, weight_moment=weight, theta=0.0, spin=spin
    )
    fate = sleeping_top(top)
    critical = fate.critical_spin[0]
    ax.plot(spin, np.degrees(fate.fall_angle), label=f"{weight:g} N m: {critical:.2f} rad/s")
ax.set(xlabel="spin (rad/s)", ylabel="greatest inclination after the least push (deg)")
ax.legend(title="weight × distance: critical spin")

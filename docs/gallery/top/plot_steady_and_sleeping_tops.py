r"""
Steady precession and the sleeping top
======================================

Two rates of steady precession at each inclination, and the spin below which an upright top falls.
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.top.patterns import minimum_spin, sleeping_top, steady_precession
from earthspin.top.start import HeavyTop

# %%
# Two rates of steady precession
# ------------------------------
# At a given inclination a top can precess without nutation at two rates (end of I.7). The slow
# rate is the one of textbooks: torque over angular momentum. The fast rate hardly depends on the
# weight. Below a least spin, where both rates coincide, there is no steady precession.
#
# *Next:* tilt the axis below the horizontal: steady precession then exists at every spin.

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
ax.set_title(f"no steady precession below {least:.3f} rad/s")
ax.legend()

# %%
# The critical spin of a sleeping top
# -----------------------------------
# A fast top is stable in the upright position. Below the critical spin, :math:`\omega_3^2 =
# 4\,I_1 mgr/I_3^2` (from I.7.16 with a double root at the vertical), the smallest deviation makes
# it fall to a finite inclination and rise again, periodically. Friction slows a real top along
# this curve.
#
# *Next:* move the centre of mass lower: the critical spin falls.

spin = np.linspace(0.5, 7, 400)
fig, ax = plt.subplots()
for weight in (0.5, 1.0, 2.0):
    top = HeavyTop(
        transverse_moment=1.0, axial_moment=0.5, weight_moment=weight, theta=0.0, spin=spin
    )
    fate = sleeping_top(top)
    critical = fate.critical_spin[0]
    ax.plot(spin, np.degrees(fate.fall_angle), label=f"{weight:g} N m: {critical:.2f} rad/s")
ax.set(xlabel="spin (rad/s)", ylabel="largest inclination after a tiny push (deg)")
ax.legend(title="weight × distance: critical spin")

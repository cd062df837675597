r"""
How fast the middle axis fails
==============================

Near the middle axis a disturbance grows as :math:`e^{\gamma t}` with :math:`\gamma =
\omega\sqrt{(C-B)(B-A)/(AC)}`, which follows from Euler's equations (I.4.4). Starts a thousand
times closer to the axis buy the same stretch of time each; none buys for ever. The dashed lines
are the linear growth, the solid ones the exact motion until the flip.

*Next:* compare with a body whose middle moment is closer to the least.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.rotor.euler import axis_stability

moments, times = [1.0, 2.0, 2.8], np.linspace(0, 45, 451)
rate = float(axis_stability(moments, 1.0).growth_rate[1])

fig, ax = plt.subplots()
for number, push in enumerate((1e-2, 1e-5, 1e-8)):
    racket = earthspin.free_rotor(moments, [push, 1.0, 0.0], times)
    ax.semilogy(
        times, racket.omega_body.sel(component="x"), color=f"C{number}", label=f"{push:g} rad/s"
    )
    early = times < np.log(0.5 / push) / rate
    ax.semilogy(times[early], push * np.cosh(rate * times[early]), "k--", lw=0.8)
ax.set(xlabel="time (s)", ylabel="spin about the axis of least moment (rad/s)")
ax.set_title(f"growth rate {rate:.3f} per second")
ax.legend(title="at the start", loc="lower right")

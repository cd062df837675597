r"""
An integrator forgets, a closed form does not
=============================================

A tumbling body for ever longer times. The error of an integrator grows with the time, at each of
three tolerances; its energy and angular momentum, constant by I.5.1, drift. The closed form of
Euler's equations (I.4.4) keeps both to rounding and is the reference here.

*Next:* try ``method="LSODA"``, which changes its order as it goes.
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.rotor.euler import integrate_rotation
from earthspin.rotor.triaxial import free_rotation

moments, omega = [1.0, 1.6, 2.0], [0.5, 0.2, 1.0]
times = np.linspace(0, 1000, 501)
exact = free_rotation(moments, omega, times).omega_body

fig, ax = plt.subplots()
for rtol in (1e-6, 1e-9, 1e-12):
    found = integrate_rotation(moments, omega, times, rtol=rtol, atol=rtol).omega_body
    off = np.linalg.norm(found - exact, axis=-1)
    ax.loglog(times[1:], np.maximum.accumulate(off)[1:], label=f"rtol {rtol:g}")
ax.set(xlabel="time (s)", ylabel="largest error so far (rad/s)")
ax.legend(title="DOP853")

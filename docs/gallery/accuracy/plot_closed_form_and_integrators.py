r"""
Closed form and integrators for a free rotor
============================================

A closed form has rounding errors only, at any time.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.rotor.euler import integrate_rotation
from earthspin.rotor.triaxial import free_rotation
from earthspin.views.work_precision_views import plot_accuracy

# %%
# Closed form against integrators
# -------------------------------
# Motion of a free rotor over a fixed time by Jacobi's functions (the solution mentioned below
# I.4.4), and by integrators at many tolerances. Down and left is better; no other point is better
# in both directions than a point on the broad grey line. The closed form is accurate to rounding
# at the cost of a coarse integration.
#
# *Next:* ``earthspin.accuracy("free-rotor")`` without ``quick`` measures a longer motion.

fig, ax = plt.subplots(figsize=(7.6, 4.0))
plot_accuracy(earthspin.accuracy("free-rotor", quick=True), ax=ax)

# %%
# Growth of errors over long times
# --------------------------------
# A tumbling body over increasing times. The error of an integrator grows with time at each of
# three tolerances; its energy and angular momentum, constant by I.5.1, drift. The closed form of
# Euler's equations (I.4.4) conserves both to rounding and is the reference.
#
# *Next:* try ``method="LSODA"``, which adapts its order.

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

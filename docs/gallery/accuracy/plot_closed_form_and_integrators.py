r"""
Closed form and integrators for a free rotor
============================================

A closed form has rounding errors only, at any time.
"""

from time import perf_counter

import matplotlib.pyplot as plt
import numpy as np

from earthspin.rotor.euler import integrate_rotation
from earthspin.rotor.triaxial import free_rotation

# %%
# Closed form against integrators
# -------------------------------
# Motion of a free rotor over a fixed time by Jacobi's functions (the solution mentioned below
# I.4.4), and by integrators at many tolerances. Down and left is better. The closed form is
# accurate to rounding, and takes less time than a coarse integration.
#
# *Next:* a longer motion, ``np.linspace(0, 1000, 501)``.

moments, omega = [1.0, 1.6, 2.0], [0.5, 0.2, 1.0]
times = np.linspace(0, 100, 51)
exact = free_rotation(moments, omega, times).omega_body


def measure(method):
    """Run time, and largest distance from the closed form."""
    start = perf_counter()
    omega_body = method().omega_body
    elapsed = perf_counter() - start
    return elapsed, max(np.abs(omega_body - exact).max(), 1e-16)


fig, ax = plt.subplots(figsize=(7.6, 4.0))
for name in ("RK45", "DOP853", "LSODA"):
    runs = [measure(lambda rtol=rtol, name=name: integrate_rotation(
                moments, omega, times, method=name, rtol=rtol, atol=rtol))
            for rtol in np.geomspace(1e-4, 1e-13, 10)]  # fmt: skip
    ax.loglog(*np.transpose(runs), "o-", label=name)
closed = measure(lambda: free_rotation(moments, omega, times))
ax.loglog(*closed, "s", color="black", label="closed form (rounding)")
ax.set(xlabel="run time (s)", ylabel="largest error (rad/s)")
ax.legend()

# %%
# Growth of errors over long times
# --------------------------------
# A tumbling body over increasing times. The error of an integrator grows with time at each of
# three tolerances; its energy and angular momentum, constant by I.5.1, drift. The closed form of
# Euler's equations (I.4.4) conserves both to rounding and is the reference.
#
# *Next:* try ``method="LSODA"``, which adapts its order.

times = np.linspace(0, 1000, 501)
exact = free_rotation(moments, omega, times).omega_body

fig, ax = plt.subplots()
for rtol in (1e-6, 1e-9, 1e-12):
    found = integrate_rotation(moments, omega, times, rtol=rtol, atol=rtol).omega_body
    off = np.linalg.norm(found - exact, axis=-1)
    ax.loglog(times[1:], np.maximum.accumulate(off)[1:], label=f"rtol {rtol:g}")
ax.set(xlabel="time (s)", ylabel="largest error so far (rad/s)")
ax.legend(title="DOP853")

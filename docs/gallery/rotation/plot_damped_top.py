r"""
A custom torque: a top with friction
====================================

Gravity and friction as a torque that the user writes, along the axes of the body.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.numerics.quaternion import conjugate, rotate

# %%
# A top slows down and sinks
# --------------------------
# The top nutates (I.7) and sinks while friction reduces its spin. Below: the spin, with the law
# for an upright top (dashed).
#
# *Next:* leave friction out, and compare with ``earthspin.heavy_top``.

MASS, RADIUS, FLAT, BULGE = 0.2, 0.03, 0.3, 0.15
C = BULGE / FLAT * MASS * RADIUS**2


def gravity_and_friction(t: np.ndarray, q: np.ndarray, omega: np.ndarray) -> np.ndarray:
    up = rotate(conjugate(q), np.array([0.0, 0.0, 1.0]))
    weight = np.stack([up[:, 1], -up[:, 0], 0 * t], axis=-1)  # up x C
    return 2e-2 * weight - 2e-5 * omega


top = earthspin.Body(name="top", gm=6.6743e-11 * MASS, radius=RADIUS, j2=BULGE,
                     dynamical_flattening=FLAT)  # fmt: skip
turned = earthspin.rotation("2000-01-01T00:00:00", "2000-01-01T00:00:03", "2 ms", body=top,
                            perturbers=[], torque=gravity_and_friction,
                            start_attitude=[np.cos(0.15), np.sin(0.15), 0, 0],
                            start_omega=[0, 0, 150])  # fmt: skip
seconds = (turned.time - turned.time[0]).values / np.timedelta64(1, "s")
axis = rotate(turned.attitude.values, np.array([0.0, 0.0, 1.0]))
fig, (upper, lower) = plt.subplots(2, sharex=True)
upper.plot(seconds, np.degrees(np.arccos(axis[:, 2])), lw=0.7)
upper.set_ylabel("inclination (deg)")
lower.plot(seconds, turned.omega.sel(component="z"))
lower.plot(seconds, 150 * np.exp(-2e-5 / C * seconds), "k--", lw=0.8)
lower.set(xlabel="time (s)", ylabel="spin (rad/s)")

r"""
A ring feels no torque, an ellipse does
=======================================

A distant mass pulls the near end of a dumbbell more than the far one and turns it (I.8.2). Masses
on a circle come in pairs that cancel (I.8.3). On an ellipse they do not (I.8.5), and the torque
wants to turn the long axis towards the mass: the oblate Earth in two dimensions.

*Next:* bring the mass nearer; the exact torque (line) leaves the leading term (dots).
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.mass.rings import ellipse_positions, ellipse_torque, torque_on_masses

gm, distance, count = 1.0, 20.0, 12  # m3/s2, m, masses of 1 kg
tilt = np.linspace(-np.pi / 2, np.pi / 2, 91)
far = np.array([distance, 0.0, 0.0])


def torque(long_axis, short_axis):
    shapes = (ellipse_positions(count, long_axis, short_axis, tilt=t) for t in tilt)
    return [torque_on_masses(gm, far, np.ones(count), places)[2] for places in shapes]


fig, ax = plt.subplots()
ax.plot(np.degrees(tilt), np.array(torque(1.0, 1.0)) * 1e3, label="circle, exact")
ax.plot(np.degrees(tilt), np.array(torque(1.2, 0.8)) * 1e3, label="ellipse, exact")
leading = ellipse_torque(gm, distance, 1.0, 1.2, 0.8, count, tilt[::6])
ax.plot(np.degrees(tilt[::6]), leading * 1e3, "k.", ms=5, label="ellipse, leading term")
ax.set(xlabel="tilt of the long axis (deg)", ylabel="torque (10$^{-3}$ N m)")
ax.set_xticks(range(-90, 91, 30))
ax.legend()

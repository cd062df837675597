r"""
Phobos swings by a degree
=========================

Phobos turns once in each orbit, but evenly, while Mars is seen from an ellipse: the torque on its
long axis makes it librate, by :math:`2e/(1 - 1/3\sigma)` with :math:`\sigma = (B - A)/C` (Rambaux
et al. 2012). An ellipsoid of its size swings as far as was seen (dashed; Willner et al. 2014).

*Next:* start it a degree aside, and see its free libration beside the forced one.
"""

import matplotlib.pyplot as plt
import numpy as np
from scipy.spatial.transform import Rotation

import earthspin
from earthspin.bodies import PHOBOS

E, RATE = 0.0151, 2 * np.pi / PHOBOS.spin_period
orbit = earthspin.Orbit(a="9376 km", period=PHOBOS.spin_period, e=E, plane="icrf")

a, b, c = PHOBOS.moments  # semi-axes 13, 11.4 and 9.1 km, the same density throughout
spin = RATE * (1 - 2 * E / (1 / (3 * (b - a) / c) - 1))
turned = earthspin.rotation(
    "2000-01-01T12:00", "2000-01-03", "5 min", body=PHOBOS.replace(orbit=orbit),
    perturbers="mars", start_attitude=[1, 0, 0, 0], start_omega=[0, 0, spin],
)  # fmt: skip
hours = (turned.time - turned.time[0]).values / np.timedelta64(1, "h")
mean = Rotation.from_rotvec(np.outer(3600 * RATE * hours, [0, 0, 1]))
ahead = mean.inv() * Rotation.from_quat(turned.attitude, scalar_first=True)
plt.plot(hours, np.degrees(ahead.as_rotvec()[:, 2]))
plt.hlines([-1.14, 1.14], 0, 36, colors="0.4", ls="--", lw=0.8)
plt.gca().set(xlabel="time (h)", ylabel="long axis ahead of its mean (deg)")

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

E, PERIOD = 0.0151, 0.31891 * 86400
orbit = earthspin.Orbit(a="9376 km", period=PERIOD, e=E, plane="icrf")

# semi-axes 13, 11.4 and 9.1 km, the same density throughout
b2, c2 = (11.4 / 13) ** 2, (9.1 / 13) ** 2
j2, sigma = (1 + b2 - 2 * c2) / 10, (1 - b2) / (1 + b2)
figure = {"j2": j2, "dynamical_flattening": 5 * j2 / (1 + b2), "triaxiality": (1 - b2) / 5}
phobos = earthspin.Body(name="phobos", gm=7.1e5, radius=1.3e4, orbit=orbit, **figure)
rate = 2 * np.pi / PERIOD * (1 - 2 * E / (1 / (3 * sigma) - 1))
start = {"body": phobos, "start_attitude": [1, 0, 0, 0], "start_omega": [0, 0, rate]}
turned = earthspin.rotation("2000-01-01T12:00", "2000-01-03", "5 min", perturbers="mars", **start)
hours = (turned.time - turned.time[0]).values / np.timedelta64(1, "h")
mean = Rotation.from_rotvec(np.outer(2 * np.pi * 3600 / PERIOD * hours, [0, 0, 1]))
ahead = mean.inv() * Rotation.from_quat(turned.attitude, scalar_first=True)
plt.plot(hours, np.degrees(ahead.as_rotvec()[:, 2]))
plt.hlines([-1.14, 1.14], 0, 36, colors="0.4", ls="--", lw=0.8)
plt.gca().set(xlabel="time (h)", ylabel="long axis ahead of its mean (deg)")

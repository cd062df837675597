r"""
Rotation of two moons
=====================

Regular libration of Phobos and chaotic rotation of Hyperion, integrated without averaging.
"""

import matplotlib.pyplot as plt
import numpy as np
from scipy.spatial.transform import Rotation

import earthspin
from earthspin.bodies import PHOBOS
from earthspin.mass.figure import homogeneous_ellipsoid

# %%
# Libration of Phobos
# -------------------
# Phobos rotates once per orbit, but uniformly, while its direction to Mars varies on an eccentric
# orbit: the torque on its long axis causes a libration of :math:`2e/(1 - 1/3\sigma)` with
# :math:`\sigma = (B - A)/C` (Rambaux et al. 2012). An ellipsoid of its size librates as far as
# observed (dashed; Willner et al. 2014).
#
# *Next:* start it one degree aside: the free libration is added to the forced one.

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

# %%
# Chaotic rotation of Hyperion
# ----------------------------
# Saturn exerts a torque on an ellipsoid of Hyperion's size on an orbit of its eccentricity
# (Wisdom, Peale & Mignard 1984). Started with a tilt it tumbles: two motions that differ by
# rounding separate by a factor :math:`e` within some weeks, and after a few years the attitude
# cannot be predicted. The same body in fast rotation about its long axis, as it was observed
# (Goldberg & Batygin 2024), is regular.
#
# *Next:* make the orbit a circle: does it still tumble?

PERIOD = 21.28 * 86400
orbit = earthspin.Orbit(period=PERIOD, e=0.1, plane="icrf")

# semi-axes 180, 133 and 102.5 km, the same density throughout
j2, h, triaxiality = homogeneous_ellipsoid(180, 133, 102.5)
hyperion = earthspin.Body(
    name="hyperion", gm=3.7e8, radius=1.8e5, orbit=orbit,
    j2=j2, dynamical_flattening=h, triaxiality=triaxiality,
)  # fmt: skip
same = {"body": hyperion, "perturbers": "saturn", "start_attitude": [1, 0, 0, 0]}
for name, start in {"aslant": [0.5, 0.3, 1.5], "about the long axis": [4, 0.1, 0.8]}.items():
    omega = 2 * np.pi / PERIOD * np.array(start)
    turned = earthspin.rotation("2000-01-01T12:00", "2003-06-01", "4 d", start_omega=omega, **same)
    years = (turned.time - turned.time[0]) / np.timedelta64(31557600, "s")
    plt.semilogy(years, turned.attitude_error_method, label=name)
plt.gca().set(xlabel="time (years)", ylabel="error of the attitude (deg)")
plt.legend()

r"""
Hyperion tumbles, and nobody knows how for long
===============================================

Saturn pulls on a potato: an ellipsoid of Hyperion's size on an ellipse of its eccentricity
(Wisdom, Peale & Mignard 1984). Started aslant it tumbles: two motions that differ by rounding part
:math:`e` times as far within some weeks, and a few years on the attitude is anybody's guess. The
same body turning fast about its long axis, as it was seen to (Goldberg & Batygin 2024), is regular.

*Next:* make the orbit a circle, and see whether it still tumbles.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.mass.inertia import homogeneous_ellipsoid

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

"""Skies and equators of the references: the kernel's tide, a model Moon, IAU in long double."""

import erfa
import numpy as np

from earthspin.bodies import SUN
from earthspin.constants import DAY, JULIAN_YEAR
from earthspin.torque.average import precessing_torque
from earthspin.torque.gravity import tidal_tensor, torque_from_position
from tests.reference import model_sky
from tests.reference.equator import true_equator
from tests.reference.sky import GM, Tide, positions


def test_the_tide_is_that_of_the_kernel_between_its_nodes() -> None:
    tide = Tide(30 * DAY)
    for day in (0.0, 1e-6, 0.37, 1.999, 2.0, 17.3, 30.0):
        place = positions(np.array([day]))
        xx, yy, zz, xy, xz, yz = tidal_tensor([(GM[name], r[0]) for name, r in place.items()])
        true = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        # 7e-16 measured
        assert np.max(np.abs(tide(day * DAY) - true)) < 5e-15 * np.max(np.abs(true)), day
    assert tide.calls == 7


def test_equator_in_long_double_is_that_of_erfa() -> None:
    days = np.linspace(-9000, 9000, 60)
    # 2.4e-16 measured over a year, 9e-16 over fifty: the rounding of ERFA's arguments
    assert np.max(np.abs(true_equator(days) - erfa.pnm06a(2451545.0, days))) < 9e-15


def test_model_moon_is_the_real_one_except_for_small_terms() -> None:
    times = np.linspace(-20, 20, 1001) * JULIAN_YEAR
    angles = model_sky.arguments(times)
    longitude, latitude, distance = model_sky.moon(angles)
    days = times / DAY
    place = erfa.moon98(2451545.0, days)["p"] * 149597870700.0
    x, y, z = np.einsum("tij,tj->it", erfa.ecm06(2451545.0, days), place)
    # The Moon's mean longitude of date replaces that on the fixed ellipse.
    mean = np.radians(218.3164477 + 481267.88123421 * days / 36525)
    own = angles[0] + angles[1] + np.radians(model_sky.PERIGEE)
    off = np.angle(np.exp(1j * (longitude - own + mean - np.arctan2(y, x))))
    # 0.029 deg, 0.026 deg and 79 km measured; the largest terms have 6.3 deg, 5.1 deg, 20905 km
    assert np.max(np.abs(np.degrees(off))) < 0.05
    assert np.max(np.abs(np.degrees(latitude - np.arctan2(z, np.hypot(x, y))))) < 0.05
    assert np.max(np.abs(distance - np.sqrt(x * x + y * y + z * z))) < 150e3


def test_torus_mean_has_converged_and_the_share_of_the_sun_is_right() -> None:
    fine, coarse = model_sky.torus_mean((24, 16, 24, 16)), model_sky.torus_mean((16, 12, 16, 12))
    assert abs(coarse / fine - 1) < 1e-13  # 1.0e-14 measured
    # share of the Sun in closed form: 3/2 GM/a3 (1 - e2)^(-3/2) cos(obliquity)
    sun = 1.5 * SUN.gm / model_sky.SEMI_MAJOR_AXIS**3 * np.cos(model_sky.OBLIQUITY)
    sun *= (1 - model_sky.ECCENTRICITY**2) ** -1.5
    anomaly = 2 * np.pi * np.arange(32) / 32
    place = model_sky.positions(np.stack([0 * anomaly, anomaly, 0 * anomaly, 0 * anomaly]))["sun"]
    torque = torque_from_position(SUN.gm, 1.0, place, model_sky.AXIS)
    precessing = precessing_torque(torque, model_sky.AXIS, model_sky.NORMAL)
    # the mean of cos(2 true anomaly)/r3 is zero on any ellipse
    assert abs(np.mean(precessing) / sun - 1) < 2e-15  # 2.2e-16 measured

"""Model sky with a known mean torque: Sun on an ellipse, Moon by the main terms of ELP2000-82.

All positions depend on four angles that change linearly with time: the Moon's elongation D, the
mean anomalies of Sun (l') and Moon (l), and the Moon's argument of latitude (F). The mean over
infinite time is then the mean over the torus of the four angles, for which the trapezoid rule
converges faster than any power of its step. The main terms of longitude, latitude and distance
follow ELP2000-82 (Chapront-Touze & Chapront 1983, Astron. Astrophys. 124, 50), as in Meeus (1998,
Astronomical Algorithms, tables 47.A and 47.B). The Sun's perigee and the equator are fixed.
"""

import numpy as np

from earthspin.constants import DAY, DAYS_PER_CENTURY
from earthspin.torque.average import precessing_torque
from earthspin.torque.gravity import torque_from_position
from tests.reference.sky import GM, FloatArray, eccentric_anomaly, unit_vectors
from tests.reference.stored import FOLDER

#: D, l', l, F at J2000.0 (deg) and their rates (deg per Julian century).
ARGUMENTS = np.array([297.8501921, 357.5291092, 134.9633964, 93.2720950])
RATES = np.array([445267.1114034, 35999.0502909, 477198.8675055, 483202.0175233])
#: Orbit of the Sun at J2000.0 (Meeus 1998, ch. 25): longitude of the perigee (deg), eccentricity,
#: semi-major axis (m); and the obliquity (ch. 22). A model sky need not be more exact.
PERIGEE, ECCENTRICITY, SEMI_MAJOR_AXIS = 282.93735, 0.016708634, 1.495978707e11
OBLIQUITY = np.radians(23.4392911)

#: Columns: multiples of D, l', l, F; longitude (1e-6 deg, sine), distance (m, cosine).
LONGITUDE_AND_DISTANCE = np.loadtxt(FOLDER / "moon-longitude-distance.txt")
#: Columns: multiples of D, l', l, F; latitude (1e-6 deg, sine).
LATITUDE = np.loadtxt(FOLDER / "moon-latitude.txt")
MEAN_DISTANCE = 385000560.0  # m

#: Pole of the equator and normal of the ecliptic, in axes of ecliptic and equinox.
AXIS = np.array([0.0, -np.sin(OBLIQUITY), np.cos(OBLIQUITY)])
NORMAL = np.array([0.0, 0.0, 1.0])


def arguments(times: FloatArray) -> FloatArray:
    """Delaunay arguments D, l', l and F at times in s from J2000.0, rad, shape (4, n)."""
    centuries = times / (DAYS_PER_CENTURY * DAY)
    return np.asarray(np.radians(ARGUMENTS[:, np.newaxis] + RATES[:, np.newaxis] * centuries))


def node_period() -> float:
    """Period of the Moon's node on the ecliptic, s."""
    node_rate = RATES[3] - RATES[0] - RATES[1]  # F - (D + l'): rate of the node's regression
    return float(360.0 / node_rate * DAYS_PER_CENTURY * DAY)


def moon(angles: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Ecliptic longitude (rad), latitude (rad) and distance (m) of the Moon in the model sky.

    Parameters
    ----------
    angles : ndarray, shape (4, n)
        D, l', l, F, rad.
    """
    micro = np.radians(1e-6)
    table = LONGITUDE_AND_DISTANCE
    phase = table[:, :4] @ angles
    longitude = angles[0] + angles[1] + np.radians(PERIGEE)
    longitude = longitude + micro * (table[:, 4] @ np.sin(phase))
    distance = MEAN_DISTANCE + table[:, 5] @ np.cos(phase)
    latitude = micro * (LATITUDE[:, 4] @ np.sin(LATITUDE[:, :4] @ angles))
    return longitude, latitude, distance


def sun(anomaly: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Ecliptic longitude (rad) and distance (m) of the Sun from its mean anomaly (rad)."""
    e, eccentric = ECCENTRICITY, eccentric_anomaly(anomaly, ECCENTRICITY, steps=8)
    true = 2 * np.arctan2(
        np.sqrt(1 + e) * np.sin(eccentric / 2), np.sqrt(1 - e) * np.cos(eccentric / 2)
    )
    return true + np.radians(PERIGEE), SEMI_MAJOR_AXIS * (1 - e * np.cos(eccentric))


def positions(angles: FloatArray) -> dict[str, FloatArray]:
    """Positions of Sun and Moon in ecliptic axes, m, shape (n, 3) each."""
    longitude, distance = sun(angles[1])
    sun_position = distance[:, np.newaxis] * unit_vectors(longitude, 0 * longitude)
    longitude, latitude, distance = moon(angles)
    return {
        "sun": sun_position,
        "moon": distance[:, np.newaxis] * unit_vectors(longitude, latitude),
    }


def precessing(angles: FloatArray) -> FloatArray:
    """Torque component of Sun and Moon that causes precession, per C - A, s-2, shape (n,).

    It is the torque per unit of C - A.
    """
    position = positions(angles)
    torque = sum(torque_from_position(GM[name], 1.0, position[name], AXIS) for name in GM)
    return precessing_torque(np.asarray(torque), AXIS, NORMAL)


def precessing_at(times: FloatArray) -> FloatArray:
    """Torque component that causes precession, per C - A, at times in s from J2000.0, s-2."""
    return precessing(arguments(times))


def torus_mean(counts: tuple[int, int, int, int]) -> float:
    """Mean of the torque of `precessing` over all values of the Delaunay arguments, s-2.

    Parameters
    ----------
    counts : tuple of int
        Number of points along each angle.
    """
    grids = [2 * np.pi * np.arange(count) / count for count in counts]
    rest = np.stack(np.meshgrid(*grids[1:], indexing="ij")).reshape(3, -1)
    means = []
    for elongation in grids[0]:  # slice by slice, to save memory
        angles = np.concatenate([np.full((1, rest.shape[1]), elongation), rest])
        means.append(float(np.mean(precessing(angles))))
    return float(np.mean(means))

"""The equator of date of any body: the axes in which declination is measured.

The third axis is the spin axis, the first points to the body's equinox: where the Sun, on
its apparent orbit, crosses the equator northward.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from earthspin.errors import UndefinedError
from earthspin.sky import iau

FloatArray = NDArray[np.float64]


def direction(right_ascension: float, declination: float) -> FloatArray:
    """Unit vector of a direction given in radians, shape (3,)."""
    return np.array(
        [
            math.cos(declination) * math.cos(right_ascension),
            math.cos(declination) * math.sin(right_ascension),
            math.sin(declination),
        ]
    )


def orbit_normal(pole: str | tuple[float, float], orbit: tuple[float, float] | None) -> FloatArray:
    """Unit normal of the plane on which precession is counted, in the ICRF.

    Parameters
    ----------
    pole : str or tuple
        The body's pole; the word ``"iau2006"`` brings the ecliptic of J2000.0 with it.
    orbit : tuple or None
        Right ascension and declination of the orbit's normal, rad.

    Raises
    ------
    UndefinedError
        If there is no orbit to refer to.
    """
    if isinstance(pole, str):
        return iau.ecliptic_pole()
    if orbit is None:
        raise UndefinedError("precession is counted along the orbit; set the body's orbit_pole")
    return direction(*orbit)


def equator_of_date(
    pole: str | tuple[float, float],
    orbit: tuple[float, float] | None,
    days: FloatArray,
    nutation: iau.Nutation | None = None,
) -> FloatArray:
    """Matrices from the ICRF to equator and equinox of date.

    Parameters
    ----------
    pole : str or tuple
        ``"iau2006"``, or a fixed direction (right ascension, declination, rad).
    orbit : tuple or None
        Normal of the orbit, for a fixed pole.
    days : ndarray, shape (n,)
        Days from J2000.0 TDB.
    nutation : Nutation, optional
        With it the equator is the true one, without it the mean one. A fixed pole has none.

    Returns
    -------
    ndarray, shape (n, 3, 3), or (3, 3) for a fixed pole
    """
    if not isinstance(pole, str):
        return fixed_equator(direction(*pole), orbit_normal(pole, orbit))
    if nutation is None:
        return iau.mean_equator(days)
    return nutation.true_equator(days)


def pole_at(pole: str | tuple[float, float], day: float) -> FloatArray:
    """Pole at a day from J2000.0 TDB, frame bias and nutation included, shape (3,)."""
    if isinstance(pole, str):
        return np.asarray(iau.true_pole(np.array([day]))[0])
    return direction(*pole)


def mean_pole(pole: str | tuple[float, float], days: FloatArray) -> FloatArray:
    """Pole without nutation, shape (n, 3); a fixed pole does not move."""
    if isinstance(pole, str):
        return np.asarray(iau.mean_equator(days)[..., 2, :])
    return np.broadcast_to(direction(*pole), (days.size, 3))


def ecliptic_axes(pole: str | tuple[float, float], orbit: tuple[float, float] | None) -> FloatArray:
    """Matrix from the ICRF to the plane of the orbit and the equinox of J2000.0, shape (3, 3).

    Raises
    ------
    UndefinedError
        If there is no orbit to refer to.
    """
    normal = orbit_normal(pole, orbit)
    if isinstance(pole, str):
        return iau.fixed_ecliptic()
    equinox = fixed_equator(direction(*pole), normal)[0]
    return np.stack([equinox, np.cross(normal, equinox), normal])


def fixed_equator(axis: FloatArray, normal: FloatArray) -> FloatArray:
    """Matrix from the ICRF to the equator of a spin axis that does not move, shape (3, 3).

    An axis along the orbit's normal has no equinox; right ascension then counts from an
    arbitrary point of the equator.
    """
    node = np.cross(axis, normal)
    if np.linalg.norm(node) < 1e-12:
        node = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    x = node / np.linalg.norm(node)
    return np.stack([x, np.cross(axis, x), axis])


def rotate(matrix: FloatArray, vectors: FloatArray) -> FloatArray:
    """Turn vectors, shape (n, 3), by one matrix or by one matrix each."""
    if matrix.ndim == 2:
        return vectors @ matrix.T
    return np.asarray((matrix @ vectors[:, :, np.newaxis])[:, :, 0])


def angle(a: FloatArray, b: FloatArray) -> float:
    """Angle between two vectors, rad; exact for small angles and for nearly opposite ones."""
    return math.atan2(float(np.linalg.norm(np.cross(a, b))), float(np.dot(a, b)))


def spherical(vectors: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Right ascension (0 to 2 pi), declination and length of vectors, shape (n, 3).

    By arctan2 throughout: arcsin and arccos lose half the digits near the poles.
    """
    x, y, z = vectors.T
    in_plane = np.hypot(x, y)
    return np.arctan2(y, x) % (2 * np.pi), np.arctan2(z, in_plane), np.hypot(in_plane, z)

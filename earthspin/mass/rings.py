"""Torque of a distant mass on dumbbells, rings and ellipses of point masses (I.8.1 to I.8.5).

A dumbbell experiences a torque towards the distant mass. The torques on the dumbbells of a ring
cancel to leading order; those on an ellipse do not. A ring of N masses has a residual torque,
smaller by N - 2 powers of (radius/distance); only a continuous circle has none. Angles are
counter-clockwise from the line to the distant mass to the dumbbell (or first mass, or long axis);
torques are about the centre, counter-clockwise positive.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from earthspin.errors import UndefinedError
from earthspin.mass.tensor import centre_of_mass, degree, point_masses, positive, vectors
from earthspin.numerics.arrays import FloatArray


def torque_on_masses(
    gm: float, position: ArrayLike, masses: ArrayLike, positions: ArrayLike
) -> FloatArray:
    """Exact torque by a distant mass on rigidly connected masses, about their mass centre, N m.

    With s from the centre of mass to a mass m, and d to the distant mass,
    N = sum of GM m (s x d)/|d - s|^3. As the sum of m s is zero, 1/|d - s|^3 may be replaced by its
    excess over 1/d3, which avoids cancellation if d is larger than the body.

    Parameters
    ----------
    gm : float
        Gravitational parameter of the distant mass, m3 s-2.
    position : array_like, shape (..., 3)
        Position of the distant mass, m.
    masses : array_like, shape (k,)
        kg.
    positions : array_like, shape (k, 3)
        m.

    Returns
    -------
    ndarray, shape (..., 3)
        N m.

    Raises
    ------
    UndefinedError
        If the distant mass coincides with one of the others.
    """
    mu = float(positive("point mass", "gm", gm))
    m, r = point_masses(masses, positions)
    centre = centre_of_mass(m, r)
    s, d = r - centre, (vectors("position", position) - centre)[..., np.newaxis, :]
    separation = np.sqrt(np.sum((d - s) ** 2, axis=-1))
    distance = np.sqrt(np.sum(d * d, axis=-1))
    if np.any(separation == 0):
        raise UndefinedError("the distant mass coincides with one of the masses; move it away")
    exterior = distance > np.max(np.sqrt(np.sum(s * s, axis=-1)))
    inverse_cubes = np.where(exterior, _inverse_cube_excess(s, d, separation), separation**-3.0)
    weighted = (m * inverse_cubes)[..., np.newaxis] * np.cross(s, d)
    return np.asarray(mu * np.sum(weighted, axis=-2))


def ring_positions(count: int, radius: float, angle: float = 0.0) -> FloatArray:
    """Positions of equal masses, evenly spaced on a circle in the xy plane (I.8.1), m.

    The shape is (count, 3).

    Parameters
    ----------
    count : int
        Number of masses, at least 2 (a dumbbell).
    radius : float
        m.
    angle : float
        Angle of the first mass from x, rad.
    """
    return ellipse_positions(count, radius, radius, tilt=angle)


def ellipse_positions(
    count: int, long_axis: float, short_axis: float, tilt: float = 0.0, start: float = 0.0
) -> FloatArray:
    """Positions of masses on an ellipse in the xy plane, even in eccentric angle (I.8.4), m.

    Parameters
    ----------
    count : int
        Number of masses, at least 2.
    long_axis, short_axis : float
        Semi-axes, m.
    tilt : float
        Angle of the first semi-axis from x, rad.
    start : float
        Eccentric angle of the first mass, rad.

    Returns
    -------
    ndarray, shape (count, 3)
        m.
    """
    _check_count(count, 2)
    p = positive("ellipse", "semi-axis", long_axis)
    q = positive("ellipse", "semi-axis", short_axis)
    eccentric = start + 2 * np.pi * np.arange(count) / count
    along, across = p * np.cos(eccentric), q * np.sin(eccentric)
    x = along * np.cos(tilt) - across * np.sin(tilt)
    y = along * np.sin(tilt) + across * np.cos(tilt)
    return np.stack([x, y, np.zeros(count)], axis=-1)


def ring_torque(
    gm: ArrayLike,
    distance: ArrayLike,
    mass: ArrayLike,
    radius: ArrayLike,
    count: int,
    angle: ArrayLike,
) -> FloatArray:
    """Torque by a distant mass on N equal masses on a circle, to leading order (I.8.2, I.8.3), N m.

    The leading torque comes from the potential of degree N, P_N(cos x) = 2 (2N)!/(2^N N!)^2 cos N x
    + ..., and is

        -2 N^2 (2N)!/(2^N N!)^2 GM m r^N/b^(N+1) sin(N angle)

    For N = 2, a dumbbell, it is -6 GM m r2/b3 sin(angle) cos(angle). The torques on two dumbbells
    that are mirror images in the line to the distant mass cancel if their radii are equal (I.8.3),
    so that the torque on more than two masses is zero to this order; otherwise their sum is
    6 GM m (r2^2 - r1^2)/b3 sin(angle) cos(angle) (I.8.5).

    Parameters
    ----------
    gm : float
        Gravitational parameter of the distant mass, m3 s-2.
    distance : float
        Distance b of the distant mass, m.
    mass : float
        Mass of each of the N, kg.
    radius : float
        Distance of each from the centre, m.
    count : int
        N, at least 2.
    angle : float
        From the line to the distant mass to any of the masses, rad.
    """
    _check_count(count, 2)
    b = positive("point mass", "distance", distance)
    ratio = positive("point masses", "radius", radius) / b
    coefficient = 2 * math.comb(2 * count, count) / 4**count
    size = coefficient * count**2 * _pull(gm, mass) / b * ratio**count
    return np.asarray(-size * np.sin(count * np.asarray(angle)))


def ellipse_torque(
    gm: ArrayLike,
    distance: ArrayLike,
    mass: ArrayLike,
    long_axis: ArrayLike,
    short_axis: ArrayLike,
    count: int,
    tilt: ArrayLike,
) -> FloatArray:
    """Torque by a distant mass on N equal masses on an ellipse, to leading order, N m.

    The sum over the dumbbells of (I.8.5) is -(3/2) N GM m (p2 - q2)/b3 sin(tilt) cos(tilt), for
    semi-axes p and q. It turns the long axis towards the distant mass.

    Parameters
    ----------
    gm, distance, mass
        As for `ring_torque`.
    long_axis, short_axis : float
        Semi-axes p and q, m.
    count : int
        N, at least 3, so that the position of the first mass does not matter.
    tilt : float
        From the line to the distant mass to the first semi-axis, rad.
    """
    _check_count(count, 3)
    b = positive("point mass", "distance", distance)
    p = positive("ellipse", "semi-axis", long_axis)
    q = positive("ellipse", "semi-axis", short_axis)
    size = 1.5 * count * _pull(gm, mass) / b * ((p - q) / b) * ((p + q) / b)
    return np.asarray(-size * np.sin(tilt) * np.cos(tilt))


def _pull(gm: ArrayLike, mass: ArrayLike) -> FloatArray:
    """Product GM m of the distant mass's GM and the mass m of one ring point, N m2."""
    mu = positive("point mass", "gm", gm)
    return np.asarray(mu * positive("point masses", "mass", mass))


def _inverse_cube_excess(s: FloatArray, d: FloatArray, separation: FloatArray) -> FloatArray:
    """Difference 1/|d - s|^3 - 1/|d|^3 for vectors d and s, without cancellation for small s.

    The result is zero where d is zero.
    """
    square = np.sum(d * d, axis=-1)
    inverse = np.divide(1.0, square, out=np.zeros_like(square), where=square > 0)
    q = np.sum(s * (s - 2 * d), axis=-1) * inverse
    small = np.abs(q) < 0.5
    excess = np.expm1(-1.5 * np.log1p(np.where(small, q, 0.0)))
    excess = np.where(small, excess, (np.sqrt(square) / separation) ** 3 - 1)
    return np.asarray(excess * inverse**1.5)


def _check_count(count: int, least: int) -> None:
    """Raise an error if the number of masses is below the minimum."""
    if degree("count", count) < least:
        raise UndefinedError(f"count = {count} masses are too few; give {least} or more")

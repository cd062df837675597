"""Instantaneous torque of a distant mass on an oblate body (I.8.7, I.9.34).

The torque in two coordinate systems is

    N = -3 GM (C - A)/b3 sin(delta) cos(delta) (-sin(alpha), cos(alpha), 0)
    N =  3 GM (C - A)/r5 (r . k) (r x k)

with r from the body to the mass and k the unit vector of the figure axis. The torque acts to tilt
the equator towards the mass.
"""

from __future__ import annotations

import numpy as np

from earthspin.constants import NORMAL_95
from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import FloatArray


def torque_from_declination(
    gm: float,
    moment_difference: float,
    right_ascension: FloatArray,
    declination: FloatArray,
    distance: FloatArray,
) -> FloatArray:
    """Torque of a mass on the bulge, from its right ascension, declination, distance (I.8.7), N m.

    Parameters
    ----------
    gm : float
        Gravitational parameter of the mass, m3 s-2.
    moment_difference : float
        C - A of the body, kg m2.
    right_ascension, declination : ndarray, shape (n,)
        Direction of the mass, referred to the body's equator, rad.
    distance : ndarray, shape (n,)
        Distance between the centres, m.

    Returns
    -------
    ndarray, shape (n, 3)
        N m, in the frame of right ascension and declination.

    Raises
    ------
    UndefinedError
        For a mass in the centre of the body.
    """
    _refuse_centre(distance)
    size = -3 * gm * moment_difference / distance**3 * np.sin(declination) * np.cos(declination)
    zero = np.zeros_like(size)
    return np.stack([-size * np.sin(right_ascension), size * np.cos(right_ascension), zero], -1)


def torque_from_position(
    gm: float, moment_difference: float, position: FloatArray, axis: FloatArray
) -> FloatArray:
    """Torque of a mass on the bulge, from its position and the figure axis (I.9.32), N m.

    Parameters
    ----------
    gm : float
        Gravitational parameter of the mass, m3 s-2.
    moment_difference : float
        C - A of the body, kg m2; 1 gives the torque per unit of C - A, s-2.
    position : ndarray, shape (n, 3)
        From the body to the mass, m, in any frame.
    axis : ndarray, shape (3,) or (n, 3)
        Unit vector of the figure axis, in the same frame.

    Returns
    -------
    ndarray, shape (n, 3)
        N m, in the same frame.

    Raises
    ------
    UndefinedError
        For a mass in the centre of the body.
    """
    direction, distance = _direction(position)
    size = 3 * gm * moment_difference / distance**3 * np.sum(direction * axis, axis=-1)
    return np.asarray(size[..., np.newaxis] * np.cross(direction, axis))


def torque_error(
    gm: float,
    moment_difference: float,
    declination: FloatArray,
    distance: FloatArray,
    angle_error: float,
    distance_error: float,
    u_product: float,
) -> FloatArray:
    """95 % half-width of a torque due to errors of GM (C - A) and of the mass's position, N m.

    Parameters
    ----------
    gm, moment_difference, declination, distance
        As for `torque_from_declination`.
    angle_error, distance_error : float
        Bounds on the mass's direction (rad) and distance (m).
    u_product : float
        Relative standard uncertainty of GM (C - A).

    Returns
    -------
    ndarray, shape (n,)
        N m.
    """
    scale = 3 * gm * abs(moment_difference) / distance**3
    size = scale * np.abs(np.sin(declination) * np.cos(declination))
    from_direction = scale * np.abs(np.cos(2 * declination)) * angle_error
    from_distance = size * 3 * distance_error / distance
    return np.asarray(
        np.sqrt((NORMAL_95 * size * u_product) ** 2 + from_direction**2 + from_distance**2)
    )


def _direction(position: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Unit vectors and lengths of position vectors, without overflow of powers."""
    distance = np.sqrt(np.sum(position * position, axis=-1))
    _refuse_centre(distance)
    return position / distance[..., np.newaxis], distance


def _refuse_centre(distance: FloatArray) -> None:
    """Raise an error if a distance is zero or negative; accept NaN."""
    away = np.asarray(distance) > 0
    if not np.all(away):
        wrong = float(np.asarray(distance)[~away].flat[0])
        raise UndefinedError(
            f"the direction of a mass at a distance of {wrong!r} m is not defined; "
            f"give positions away from the centre of the body"
        )

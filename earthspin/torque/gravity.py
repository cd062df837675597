"""Torque of a distant mass on an oblate body, at an instant (I.8.7, I.9.34).

Two forms of the same thing, in different coordinates:

    N = -3 GM (C - A)/b3 sin(delta) cos(delta) (-sin(alpha), cos(alpha), 0)
    N =  3 GM (C - A)/r5 (r . k) (r x k)

with r from the body to the mass and k the unit vector of the figure axis. The torque tries
to bring the mass into the plane of the equator.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import NORMAL_95
from earthspin.errors import UndefinedError

FloatArray = NDArray[np.float64]


def torque_from_declination(
    gm: float,
    moment_difference: float,
    right_ascension: FloatArray,
    declination: FloatArray,
    distance: FloatArray,
) -> FloatArray:
    """Torque on the bulge from where the mass stands in the sky (I.8.7).

    Parameters
    ----------
    gm : float
        Of the mass that pulls, m3 s-2.
    moment_difference : float
        C - A of the body, kg m2.
    right_ascension, declination : ndarray, shape (n,)
        Of the mass, referred to the body's equator, rad.
    distance : ndarray, shape (n,)
        Between the centres, m.

    Returns
    -------
    ndarray, shape (n, 3)
        N m, along the axes that right ascension and declination refer to.

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
    """Torque on the bulge from the position of the mass and the figure axis (I.9.32).

    Parameters
    ----------
    gm : float
        Of the mass that pulls, m3 s-2.
    moment_difference : float
        C - A of the body, kg m2. Give 1 for the torque per unit of it, in s-2.
    position : ndarray, shape (n, 3)
        From the body to the mass, m, in any axes.
    axis : ndarray, shape (3,) or (n, 3)
        Unit vector of the figure axis, in the same axes.

    Returns
    -------
    ndarray, shape (n, 3)
        N m, in the same axes.

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
    """95 % half-width of a torque from the body's numbers and from where the mass stands.

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
    """Unit vectors and lengths; never r5, which overflows at 10^61 m."""
    distance = np.sqrt(np.sum(position * position, axis=-1))
    _refuse_centre(distance)
    return position / distance[..., np.newaxis], distance


def _refuse_centre(distance: FloatArray) -> None:
    """Refuse distances that are not above zero; NaN is not."""
    away = np.asarray(distance) > 0
    if not np.all(away):
        wrong = float(np.asarray(distance)[~away].flat[0])
        raise UndefinedError(
            f"a mass at a distance of {wrong!r} m has no direction to pull in; "
            f"give places away from the centre of the body"
        )

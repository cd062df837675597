"""Instantaneous torque of distant masses on an oblate body (I.8.7, I.9.34).

Holds the torque of one mass, the tidal tensor of all of them, the torques on J3 and J4, and bounds
on the torques that a model with only J2 neglects. Torques act to tilt the equator towards the mass.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

import numpy as np
from numpy.polynomial import legendre

from earthspin.constants import NORMAL_95
from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import FloatArray

# --- a distant mass -------------------------------------------------------------------------------
# The torque in two coordinate systems is
#
#     N = -3 GM (C - A)/b3 sin(delta) cos(delta) (-sin(alpha), cos(alpha), 0)
#     N =  3 GM (C - A)/r5 (r . k) (r x k)
#
# with r from the body to the mass and k the unit vector of the figure axis.


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
    distance = np.sqrt(np.sum(position * position, axis=-1))
    _refuse_centre(distance)
    direction = position / distance[..., np.newaxis]
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


def _refuse_centre(distance: FloatArray) -> None:
    """Raise an error if a distance is zero, negative or not a number."""
    positive = np.asarray(distance) > 0
    if not np.all(positive):
        wrong = float(np.asarray(distance)[~positive].flat[0])
        raise UndefinedError(
            f"the direction of a mass at a distance of {wrong!r} m is not defined; "
            f"give positions away from the centre of the body"
        )


# --- tidal tensor ---------------------------------------------------------------------------------
# With Q = sum of GM r r^T / r^5 over all perturbers, the torque per unit of C on a body with the
# figure axis F is exactly
#
#     N / C = 3 H (Q F) x F
#
# to the leading order in the size of the body over the distance. Q depends only on the positions of
# the perturbers, so it is computed once for any H, spin, or direction of the axis. Vectors have the
# component axis first, shape (3, ...), because numpy is fast on long rows.


def tidal_tensor(perturbers: Iterable[tuple[float, FloatArray]]) -> FloatArray:
    """Tidal tensor: sum of GM r r^T / r^5 over all perturbing masses, s-2.

    Parameters
    ----------
    perturbers : iterable of (float, ndarray of shape (3, ...))
        GM (m3 s-2) and position from the body (m) of each.

    Returns
    -------
    ndarray, shape (6, ...)
        xx, yy, zz, xy, xz, yz; s-2.
    """
    total: FloatArray | None = None
    for gm, position in perturbers:
        square = dot(position, position)
        scale = gm / (square * square * np.sqrt(square))
        x, y, z = position
        sx, sy, sz = scale * x, scale * y, scale * z
        if total is None:
            total = np.zeros((6, *square.shape))
        products = zip((sx, sy, sz, sx, sx, sy), (x, y, z, y, z, z), strict=True)
        for row, (a, b) in enumerate(products):
            total[row] += a * b
    if total is None:
        raise ValueError("a tide needs a mass")
    return total


def apply(tensor: FloatArray, vector: FloatArray) -> FloatArray:
    """Product of a symmetric tensor (six components, shape (6, ...)) and a vector (3, ...)."""
    xx, yy, zz, xy, xz, yz = tensor
    x, y, z = vector
    result = np.empty(np.broadcast_shapes((3, *np.shape(xx)), np.shape(vector)))
    rows = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
    for component, (from_x, from_y, from_z) in zip(result, rows, strict=True):
        np.multiply(from_x, x, out=component)  # in place, because allocation is slower
        component += from_y * y
        component += from_z * z
    return result


#: Vector products of all pairs of unit vectors, shape (3, 9).
_CROSS = np.cross(np.eye(3)[:, np.newaxis], np.eye(3)).reshape(9, 3).T.copy()


def cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Vector products of two arrays of vectors, each of shape (3, ...)."""
    # Up to this size a matrix product is faster; the results are equal if all products are finite.
    if np.ndim(a) == np.ndim(b) and np.size(a) + np.size(b) < 3000:
        products = np.asarray(a)[:, np.newaxis] * b
        return (_CROSS @ products.reshape(9, -1)).reshape(3, *products.shape[2:])
    (ax, ay, az), (bx, by, bz) = a, b
    result = np.empty(np.broadcast_shapes(np.shape(a), np.shape(b)))
    for row, a1, b2, a2, b1 in zip(
        result, (ay, az, ax), (bz, bx, by), (az, ax, ay), (by, bz, bx), strict=True
    ):
        np.multiply(a1, b2, out=row)
        row -= a2 * b1
    return result


def dot(a: FloatArray, b: FloatArray) -> FloatArray:
    """Scalar products of two arrays of vectors, each of shape (3, ...)."""
    (ax, ay, az), (bx, by, bz) = a, b
    result: FloatArray = ax * bx
    result += ay * by
    result += az * bz
    return result


def quadrupole_torque(tensor: FloatArray, axis: FloatArray) -> FloatArray:
    """Torque on the equatorial bulge from the tidal tensor and figure axis, per C - A, s-2.

    Parameters
    ----------
    tensor : ndarray, shape (6, ...)
        Output of `tidal_tensor`.
    axis : ndarray, shape (3, ...)
        Unit vectors.
    """
    return 3 * cross(apply(tensor, axis), axis)


# --- zonal harmonics ------------------------------------------------------------------------------
# A mass m at r has the energy + (G M m / r) J_n (a/r)^n P_n(u) in the field of J_n, where u is the
# cosine of its angle from the figure axis F. A rotation of the body by dtheta changes F by dtheta x
# F, so the torque on the body is
#
#     N_n = (G M m / r) J_n (a/r)^n P_n'(u) (r/r) x F
#
# which for n = 2 is (I.9.34). Per unit of C it is proportional to M a2/C = H/J2.


def zonal_law(
    coefficients: Mapping[int, float], radius: float, gm: float | FloatArray, position: FloatArray
) -> Callable[[FloatArray], FloatArray]:
    """Return a function of the figure axis: torque on the harmonics J_n, divided by M a2, s-2.

    Parameters
    ----------
    coefficients : mapping of int to float
        J_n by degree n of 2 or more, in the convention of geodesy (unnormalised, J2 of an oblate
        body positive).
    radius : float
        Equatorial reference radius a, m.
    gm : float or ndarray
        Gravitational parameter of the mass, m3 s-2.
    position : ndarray, shape (3, ...)
        From the body to the mass, m.

    Returns
    -------
    callable
        Function of unit vectors of the figure axis, shape (3, ...), that returns the torque per
        unit of M a2, s-2.
    """
    distance = np.sqrt(dot(position, position))
    direction = position / distance
    series = np.zeros((max(coefficients, default=1), *distance.shape))
    for degree, coefficient in coefficients.items():
        torque_scale = gm / distance**3 * coefficient * (radius / distance) ** (degree - 2)
        for k in range(degree - 1, -1, -2):  # P_n' = sum of (2k + 1) P_k
            series[k] += (2 * k + 1) * torque_scale

    def torque(axis: FloatArray) -> FloatArray:
        size = legendre.legval(dot(direction, axis), series, tensor=False)
        return np.asarray(size * cross(direction, axis))

    return torque


# --- bounds on neglected torques ------------------------------------------------------------------
# The torque on J_n is (G M m / r) J_n (a/r)^n P_n'(u) times the sine of the angle from the axis
# (`zonal_law`); the torque on the equatorial ellipticity is at most 3/2 G m (B - A) / r3,
# about the axis.

#: Largest |P_n'(u)| sqrt(1 - u2): for n = 3 at u2 = 11/15, for n = 4 at u2 = (27 + sqrt(393))/56.
_STEEPEST = {3: 2.065591117977289, 4: 2.6400655581640695}


def largest_torque_on_figure(
    masses: Sequence[tuple[float, float]],
    mass: float,
    radius: float,
    zonal: Mapping[int, float],
    triaxiality: float,
) -> dict[str, float]:
    """Largest torques on J3, J4 and triaxiality (N m), which a model with only J2 neglects.

    Parameters
    ----------
    masses : sequence of (gm, distance)
        GM of each perturber, m3 s-2, and its smallest distance, m.
    mass, radius : float
        Mass and equatorial radius of the body, kg and m.
    zonal : mapping of int to float
        J3 and J4.
    triaxiality : float
        (B - A) / (M a2).

    Returns
    -------
    dict of str to float
        By effect, N m; effects of size zero are omitted.
    """
    moment = mass * radius * radius
    torques = {
        f"j{n}": sum(
            gm / r**3 * moment * abs(j) * (radius / r) ** (n - 2) * _STEEPEST[n] for gm, r in masses
        )
        for n, j in zonal.items()
    }
    torques["triaxiality"] = sum(1.5 * gm / r**3 * moment * triaxiality for gm, r in masses)
    return {effect: size for effect, size in torques.items() if size}

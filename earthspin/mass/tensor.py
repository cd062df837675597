"""Inertia tensor: construction, change of origin and frame, and derived quantities (I.1, I.3).

    I = sum of m (r2 1 - r r)        (I.1.3, I.1.5)

For a density on a grid, first compute point masses with `earthspin.mass.distribution`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from earthspin.errors import BodyError, UndefinedError
from earthspin.mass._checks import positive, vectors
from earthspin.mass.distribution import point_masses
from earthspin.mass.figure import spheroid_moments
from earthspin.numerics.arrays import FloatArray

#: Tolerance for rounding errors in a tensor, as a fraction of its largest component.
ROUNDING = 1e-12

_BODY = "rigid body"


def inertia_tensor(
    masses: ArrayLike, positions: ArrayLike, about: ArrayLike | None = None
) -> FloatArray:
    """Inertia tensor of point masses about a given point (I.1.3), kg m2.

    Parameters
    ----------
    masses : array_like, shape (..., k)
        kg.
    positions : array_like, shape (..., k, 3)
        m.
    about : array_like, shape (3,), optional
        Reference point, m; the origin by default.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        kg m2, along the axes of the positions.
    """
    m, r = point_masses(masses, positions)
    if about is not None:
        r = r - vectors("about", about)
    return tensor_of_second_moments(np.einsum("...k,...ki,...kj->...ij", m, r, r))


def spheroid_tensor(
    mass: ArrayLike,
    radius: ArrayLike,
    flattening: ArrayLike,
    about: ArrayLike = (0.0, 0.0, 0.0),
) -> FloatArray:
    """Exact inertia tensor of a homogeneous spheroid with its axis along z.

    Parameters
    ----------
    mass, radius, flattening
        As for `earthspin.mass.figure.spheroid_moments`.
    about : array_like, shape (..., 3)
        Reference point, from the centre of the spheroid, m.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        kg m2.
    """
    moments = spheroid_moments(mass, radius, flattening)
    equatorial, polar = np.broadcast_arrays(moments.equatorial, moments.polar)
    diagonal = np.stack([equatorial, equatorial, polar], axis=-1)
    return tensor_about_point(diagonal[..., np.newaxis] * np.eye(3), mass, about)


def tensor_about_point(tensor: ArrayLike, mass: ArrayLike, offset: ArrayLike) -> FloatArray:
    """Inertia tensor about a point, from that about the centre of mass (parallel axis theorem).

    Parameters
    ----------
    tensor : array_like, shape (..., 3, 3)
        About the centre of mass, kg m2.
    mass : array_like
        kg.
    offset : array_like, shape (..., 3)
        From the centre of mass to the point, m.
    """
    return np.asarray(np.asarray(tensor, dtype=float) + _offset_tensor(mass, offset))


def tensor_about_centre(tensor: ArrayLike, mass: ArrayLike, offset: ArrayLike) -> FloatArray:
    """Inertia tensor about the centre of mass, from that about another point.

    The result is a difference and loses more digits the farther the point is from the body.
    """
    return np.asarray(np.asarray(tensor, dtype=float) - _offset_tensor(mass, offset))


def angular_momentum(tensor: ArrayLike, omega: ArrayLike) -> FloatArray:
    """Angular momentum L = I omega from inertia tensor and angular velocity (I.1.4).

    Parameters
    ----------
    tensor : array_like, shape (..., 3, 3)
        kg m2.
    omega : array_like, shape (..., 3)
        Angular velocity along the same axes, rad/s.

    Returns
    -------
    ndarray, shape (..., 3)
        kg m2/s.
    """
    return np.asarray(np.einsum("...ij,...j->...i", np.asarray(tensor), np.asarray(omega)))


def kinetic_energy(tensor: ArrayLike, omega: ArrayLike) -> FloatArray:
    """Kinetic energy of rotation T = omega . I omega/2, from inertia tensor (I.1.7), J."""
    w = np.asarray(omega, dtype=float)
    return np.asarray(np.sum(w * angular_momentum(tensor, w), axis=-1) / 2)


def moment_about_axis(tensor: ArrayLike, axis: ArrayLike) -> FloatArray:
    """Moment of inertia about a given axis, from the inertia tensor (I.1.10).

    Parameters
    ----------
    tensor : array_like, shape (..., 3, 3)
        About a point on the axis, kg m2.
    axis : array_like, shape (..., 3)
        Direction of the axis, of any nonzero length.

    Returns
    -------
    ndarray, shape (...)
        kg m2.
    """
    direction = vectors("axis", axis)
    length = np.sqrt(np.sum(direction**2, axis=-1))
    if np.any(length == 0):
        raise UndefinedError("axis = [0, 0, 0] has no direction; give a vector along the axis")
    n = direction / length[..., np.newaxis]
    return np.asarray(np.einsum("...i,...ij,...j->...", n, np.asarray(tensor), n))


def change_frame(tensor: ArrayLike, rotation: ArrayLike) -> FloatArray:
    """Components of an inertia tensor in a rotated frame, I' = R I R^T (below I.1.6).

    Parameters
    ----------
    tensor : array_like, shape (..., 3, 3)
        kg m2.
    rotation : array_like, shape (..., 3, 3)
        R, which gives the components of a vector in the new frame, v' = R v.

    Raises
    ------
    UndefinedError
        If R is not orthogonal.
    """
    r = np.asarray(rotation, dtype=float)
    departure = float(np.max(np.abs(r @ np.swapaxes(r, -1, -2) - np.eye(3))))
    if not departure <= ROUNDING:
        raise UndefinedError(
            f"rotation differs from an orthogonal matrix by {departure:.3g}; "
            f"at most {ROUNDING:g} is allowed"
        )
    turned = r @ np.asarray(tensor, dtype=float) @ np.swapaxes(r, -1, -2)
    return np.asarray((turned + np.swapaxes(turned, -1, -2)) / 2)


def check_inertia_tensor(tensor: ArrayLike) -> FloatArray:
    """Return an inertia tensor as an array; raise an error if no body can have it.

    One moment may be zero, for masses on a straight line.

    Parameters
    ----------
    tensor : array_like, shape (..., 3, 3)
        kg m2.

    Raises
    ------
    BodyError
        If it is not symmetric, if a moment is negative or all are zero, or if one moment exceeds
        the sum of the other two, beyond a tolerance of 10^-12 of the largest component.
    """
    values = np.asarray(tensor, dtype=float)
    if values.shape[-2:] != (3, 3) or not np.all(np.isfinite(values)):
        raise BodyError(_BODY, "inertia tensor", values.tolist(), "give 3 x 3 finite numbers")
    scale = np.max(np.abs(values), axis=(-1, -2))
    _refuse(
        np.max(np.abs(values - np.swapaxes(values, -1, -2)), axis=(-1, -2)) > ROUNDING * scale,
        "inertia tensor",
        values,
        "it must be symmetric",
    )
    moments = np.linalg.eigvalsh(values)
    least, middle, greatest = np.moveaxis(moments, -1, 0)
    _refuse(
        (least < -ROUNDING * scale) | (middle <= ROUNDING * scale),
        "principal moments",
        moments,
        "they must be above zero (one may be zero, for masses on a line)",
    )
    _refuse(
        greatest - middle > least + ROUNDING * scale,
        "principal moments",
        moments,
        "none may exceed the sum of the other two",
    )
    return values


def _refuse(wrong: FloatArray, field: str, value: FloatArray, allowed: str) -> None:
    """Raise an error that shows the first value marked in `wrong`, if any is marked."""
    if np.any(wrong):
        raise BodyError(_BODY, field, value[wrong][0].tolist(), allowed)


def _offset_tensor(mass: ArrayLike, offset: ArrayLike) -> FloatArray:
    """Inertia tensor of a point mass about a point at the vector `offset` from the mass."""
    m, d = positive(_BODY, "mass", mass), vectors("offset", offset)
    outer = np.asarray(d[..., :, np.newaxis] * d[..., np.newaxis, :])
    return tensor_of_second_moments(m[..., np.newaxis, np.newaxis] * outer)


def tensor_of_second_moments(second: FloatArray) -> FloatArray:
    """Inertia tensor from the second moments of mass (sum of m r r), kg m2.

    Each diagonal element is a sum of two squares, without cancellation.

    Parameters
    ----------
    second : ndarray, shape (..., 3, 3)
        Sum of m r r, kg m2.
    """
    tensor = -second
    xx, yy, zz = (second[..., i, i] for i in range(3))
    for i, moment in enumerate((yy + zz, zz + xx, xx + yy)):
        tensor[..., i, i] = moment
    return tensor

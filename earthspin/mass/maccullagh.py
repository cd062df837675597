"""MacCullagh's potential of a body at a distant point, and torque of a distant mass on the body.

    V = -GM/r - G/(2 r3) (A + B + C - 3 I)      I = n . I n, about the line to the point
    N = 3 GM/r3 n x (I n)

to order 1/r3, for any distribution of mass about its centre of mass. The quadrupole and the torque
do not change if a multiple of the unit matrix is subtracted from the tensor. For a nearly spherical
body pass the differences, np.diag([0, B - A, C - A]), to avoid cancellation.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from earthspin.constants import G
from earthspin.errors import UndefinedError
from earthspin.mass._checks import positive, vectors
from earthspin.numerics.arrays import FloatArray


def maccullagh_potential(mass: ArrayLike, tensor: ArrayLike, position: ArrayLike) -> FloatArray:
    """Gravitational potential far from a body of any shape, to order 1/r3, m2 s-2.

    Parameters
    ----------
    mass : array_like
        kg.
    tensor : array_like, shape (..., 3, 3)
        Inertia about the centre of mass, or its differences as above, kg m2.
    position : array_like, shape (..., 3)
        From the centre of mass, outside the body, along the axes of the tensor, m.
    """
    m = positive("rigid body", "mass", mass)
    n, r = _direction(position)
    # A + B + C - 3 I, as one contraction.
    shape = np.eye(3) - 3 * n[..., :, np.newaxis] * n[..., np.newaxis, :]
    quadrupole = np.sum(_less_sphere(tensor) * shape, axis=(-1, -2))
    return np.asarray(-G.value * (m / r + quadrupole / (2 * r**3)))


def maccullagh_potential_axisymmetric(
    mass: ArrayLike, moment_difference: ArrayLike, distance: ArrayLike, colatitude: ArrayLike
) -> FloatArray:
    """Gravitational potential far from a body of revolution, to order 1/r3 (I.9.31), m2 s-2.

    Parameters
    ----------
    mass : array_like
        kg.
    moment_difference : array_like
        C - A, kg m2.
    distance : array_like
        From the centre of mass, m.
    colatitude : array_like
        From the axis of symmetry, rad.
    """
    m = positive("rigid body", "mass", mass)
    r = positive("point", "distance", distance)
    p2 = 1.5 * np.cos(colatitude) ** 2 - 0.5
    return np.asarray(-G.value * (m / r - np.asarray(moment_difference) * p2 / r**3))


def maccullagh_torque(gm: ArrayLike, tensor: ArrayLike, position: ArrayLike) -> FloatArray:
    """Torque of a distant mass on a body of any shape, to order 1/r3 (I.9.32), N m.

    Parameters
    ----------
    gm : array_like
        Gravitational parameter of the distant mass, m3 s-2.
    tensor : array_like, shape (..., 3, 3)
        Inertia of the body about its centre of mass, or its differences as above, kg m2.
    position : array_like, shape (..., 3)
        From the body to the mass, along the axes of the tensor, m.

    Returns
    -------
    ndarray, shape (..., 3)
        Torque; for a body of revolution it is 3 GM (C - A)/r5 (r . k) (r x k).
    """
    mu = positive("point mass", "gm", gm)
    n, r = _direction(position)
    moment = np.einsum("...ij,...j->...i", _less_sphere(tensor), n)
    return np.asarray(3 * (mu / r**3)[..., np.newaxis] * np.cross(n, moment))


def _less_sphere(tensor: ArrayLike) -> FloatArray:
    """Inertia tensor minus its first diagonal element times the unit matrix.

    The torque is unchanged, but has no cancellation.
    """
    values = np.asarray(tensor, dtype=float)
    return np.asarray(values - values[..., :1, :1] * np.eye(3))


def _direction(position: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Unit vectors and lengths of position vectors; raise an error if a length is zero."""
    r = vectors("position", position)
    distance = np.asarray(np.sqrt(np.sum(r * r, axis=-1)))
    if np.any(distance == 0):
        raise UndefinedError(
            "position = [0, 0, 0] is the centre of the body; MacCullagh's formula holds outside it"
        )
    return r / distance[..., np.newaxis], distance

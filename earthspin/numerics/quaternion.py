"""Unit quaternions (w, x, y, z) as attitudes, from body axes to inertial axes."""

from __future__ import annotations

import numpy as np

from earthspin.numerics import rotations
from earthspin.numerics.arrays import FloatArray


def multiply(p: FloatArray, q: FloatArray) -> FloatArray:
    """Hamilton's product p q of unit quaternions: rotation by q, then rotation by p.

    Parameters
    ----------
    p, q : ndarray, shape (..., 4)

    Returns
    -------
    ndarray, shape (..., 4)
    """
    product = rotations.times(np.moveaxis(p, -1, 0), np.moveaxis(q, -1, 0))
    return np.stack(list(product), axis=-1)


def conjugate(q: FloatArray) -> FloatArray:
    """Conjugate of a unit quaternion, which is its inverse.

    Parameters
    ----------
    q : ndarray, shape (..., 4)
    """
    return np.asarray(q * np.array([1.0, -1.0, -1.0, -1.0]))


def rotate(q: FloatArray, v: FloatArray) -> FloatArray:
    """Rotate vectors by unit quaternions; attitudes rotate from body axes to inertial axes.

    Parameters
    ----------
    q : ndarray, shape (..., 4)
        Unit quaternions.
    v : ndarray, shape (..., 3)

    Returns
    -------
    ndarray, shape (..., 3)
    """
    rotated = rotations.rotated(np.moveaxis(q, -1, 0), np.moveaxis(v, -1, 0))
    return np.stack(list(rotated), axis=-1)


def rotation_about_z(half_angle: FloatArray) -> FloatArray:
    """Quaternion of a rotation about the z axis, from half the angle of rotation.

    Parameters
    ----------
    half_angle : ndarray
        Half the angle of the rotation, rad.

    Returns
    -------
    ndarray, shape (..., 4)
    """
    zero = np.zeros_like(half_angle)
    return np.stack([np.cos(half_angle), zero, zero, np.sin(half_angle)], axis=-1)

"""Unit quaternions (w, x, y, z) with components along the first array axis, for short arrays.

`earthspin.numerics.quaternion` has the component on the last axis. A step-by-step solver uses
arrays of sixteen quaternions, for which the number of numpy calls determines the run time.
"""

from __future__ import annotations

import numpy as np

from earthspin.numerics.arrays import FloatArray


def _structure() -> FloatArray:
    """Table of coefficients of Hamilton's product of two quaternions, shape (4, 4, 4).

    Component c of p q is the sum of table[c, a, b] p_a q_b.
    """
    table = np.zeros((4, 4, 4))
    table[0] = np.diag([1.0, -1.0, -1.0, -1.0])
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        table[i + 1, 0, i + 1] = table[i + 1, i + 1, 0] = 1.0
        table[i + 1, j + 1, k + 1], table[i + 1, k + 1, j + 1] = 1.0, -1.0
    return table


_PRODUCT = _structure()
_CONJUGATE = np.array([1.0, -1.0, -1.0, -1.0])
#: Products of a quaternion and the quaternion of a vector, from twelve products of components.
_WITH_VECTOR = np.ascontiguousarray(_PRODUCT[:, :, 1:]).reshape(4, 12)
_VECTOR_WITH = np.ascontiguousarray(_PRODUCT[:, 1:]).reshape(4, 12)
#: q v q* for each unit vector v, from the sixteen products of the components of q.
_MATRIX = np.ascontiguousarray(
    np.einsum("cdb,dav,b->cvab", _PRODUCT, _PRODUCT, _CONJUGATE)[1:, 1:]
).reshape(9, 16)


def matrices(q: FloatArray) -> FloatArray:
    """Rotation matrices from quaternions; an attitude gives a matrix from body to sky axes.

    Parameters
    ----------
    q : ndarray, shape (4, m)

    Returns
    -------
    ndarray, shape (3, 3, m)
    """
    m = q.shape[-1]
    return np.asarray(_MATRIX @ (q[:, np.newaxis] * q).reshape(16, m)).reshape(3, 3, m)


def times(p: FloatArray, q: FloatArray) -> FloatArray:
    """Hamilton's product p q of quaternions, shape (4, m): rotation by q, then rotation by p.

    It is computed element by element, so that the bits of a result do not depend on m.
    """
    pw, px, py, pz = p
    qw, qx, qy, qz = q
    return np.stack(
        [
            pw * qw - px * qx - py * qy - pz * qz,
            pw * qx + px * qw + py * qz - pz * qy,
            pw * qy - px * qz + py * qw + pz * qx,
            pw * qz + px * qy - py * qx + pz * qw,
        ]
    )


def times_vector(p: FloatArray, v: FloatArray) -> FloatArray:
    """Product of a quaternion (4, m) with the quaternion of a vector (3, m)."""
    m = p.shape[-1]
    return np.asarray(_WITH_VECTOR @ (p[:, np.newaxis] * v).reshape(12, m))


def vector_times(v: FloatArray, p: FloatArray) -> FloatArray:
    """Product of the quaternion of a vector (3, m) with a quaternion (4, m)."""
    m = p.shape[-1]
    return np.asarray(_VECTOR_WITH @ (v[:, np.newaxis] * p).reshape(12, m))


def conjugate(q: FloatArray) -> FloatArray:
    """Conjugates of unit quaternions, which are their inverses, shape (4, m)."""
    return np.asarray(q * _CONJUGATE[:, np.newaxis])


def rotation_about(omega: FloatArray, time: FloatArray) -> FloatArray:
    """Quaternions of rotations with constant angular velocities over given times.

    Parameters
    ----------
    omega : ndarray, shape (3, m)
        rad/s.
    time : ndarray, shape (m,)
        s.

    Returns
    -------
    ndarray, shape (4, m)
    """
    speed = np.sqrt(np.sum(omega * omega, axis=0))
    half = 0.5 * speed * time
    # numpy's sinc gives sin(x)/x with the correct limit at 0.
    along = 0.5 * time * np.sinc(half / np.pi)
    return np.concatenate([np.cos(half)[np.newaxis], omega * along])


def angle_between(p: FloatArray, q: FloatArray) -> FloatArray:
    """Angle of the rotation from one attitude to another, rad, 0 to pi; shape (m,)."""
    r = times(conjugate(p), q)
    return np.asarray(2 * np.arctan2(np.sqrt(np.sum(r[1:] ** 2, axis=0)), np.abs(r[0])))


def right(q: FloatArray) -> FloatArray:
    """Matrices right(q) for multiplication by q from the right: p q = right(q) p.

    Parameters
    ----------
    q : ndarray, shape (4, m)

    Returns
    -------
    ndarray, shape (4, 4, m)
    """
    return np.asarray(np.einsum("cab,bm->cam", _PRODUCT, q))


def left(q: FloatArray) -> FloatArray:
    """Matrices left(q) for multiplication by q from the left: q p = left(q) p.

    The shape is (4, 4, m).
    """
    return np.asarray(np.einsum("cab,am->cbm", _PRODUCT, q))


def rotated(q: FloatArray, v: FloatArray) -> FloatArray:
    """Rotate vectors (3, m) from body axes to sky axes, by attitude quaternions (4, m).

    It is computed element by element, like `times`.
    """
    w, x, y, z = q
    vx, vy, vz = v
    # v + 2 w (u x v) + 2 u x (u x v), with u the vector part of q.
    tx, ty, tz = 2 * (y * vz - z * vy), 2 * (z * vx - x * vz), 2 * (x * vy - y * vx)
    return np.stack(
        [
            vx + w * tx + y * tz - z * ty,
            vy + w * ty + z * tx - x * tz,
            vz + w * tz + x * ty - y * tx,
        ]
    )

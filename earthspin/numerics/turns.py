"""Turns as unit quaternions (w, x, y, z), component first: few calls for short rows.

`earthspin.numerics.quaternion` has the same component last. A solver that steps asks for sixteen
at a time, and then the number of calls of numpy is what it costs.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def _structure() -> FloatArray:
    """Hamilton's product as a table: component c of p q is the sum of [c, a, b] p_a q_b."""
    table = np.zeros((4, 4, 4))
    table[0] = np.diag([1.0, -1.0, -1.0, -1.0])
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        table[i + 1, 0, i + 1] = table[i + 1, i + 1, 0] = 1.0
        table[i + 1, j + 1, k + 1], table[i + 1, k + 1, j + 1] = 1.0, -1.0
    return table


_PRODUCT = _structure()
_CONJUGATE = np.array([1.0, -1.0, -1.0, -1.0])
#: Quaternion times the quaternion of a vector, from their sixteen less four products.
_WITH_VECTOR = np.ascontiguousarray(_PRODUCT[:, :, 1:]).reshape(4, 12)
_VECTOR_WITH = np.ascontiguousarray(_PRODUCT[:, 1:]).reshape(4, 12)
#: q v q* for each unit vector v, from the sixteen products of the components of q.
_MATRIX = np.ascontiguousarray(
    np.einsum("cdb,dav,b->cvab", _PRODUCT, _PRODUCT, _CONJUGATE)[1:, 1:]
).reshape(9, 16)
_CROSS = np.ascontiguousarray(_PRODUCT[1:, 1:, 1:]).reshape(3, 9)


def matrices(q: FloatArray) -> FloatArray:
    """Matrices of turns: body to sky, if q are attitudes; by one product of matrices.

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
    """Hamilton's product: the turn q first, then p; shapes (4, m).

    Element by element, so that what comes out does not depend on how many go in.
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
    """Quaternion times the quaternion of a vector; shapes (4, m) and (3, m)."""
    m = p.shape[-1]
    return np.asarray(_WITH_VECTOR @ (p[:, np.newaxis] * v).reshape(12, m))


def vector_times(v: FloatArray, p: FloatArray) -> FloatArray:
    """Quaternion of a vector times a quaternion; shapes (3, m) and (4, m)."""
    m = p.shape[-1]
    return np.asarray(_VECTOR_WITH @ (v[:, np.newaxis] * p).reshape(12, m))


def cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Vector product; shapes (3, m)."""
    m = a.shape[-1]
    return np.asarray(_CROSS @ (a[:, np.newaxis] * b).reshape(9, m))


def conjugate(q: FloatArray) -> FloatArray:
    """The inverse turns; shape (4, m)."""
    return np.asarray(q * _CONJUGATE[:, np.newaxis])


def turned_about(omega: FloatArray, time: FloatArray) -> FloatArray:
    """Turns at a steady angular velocity.

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
    # sin(x)/x by numpy's sinc, which knows its limit
    along = 0.5 * time * np.sinc(half / np.pi)
    return np.concatenate([np.cos(half)[np.newaxis], omega * along])


def angle_between(p: FloatArray, q: FloatArray) -> FloatArray:
    """Angle of the turn from one attitude to another, rad, 0 to pi; shape (m,)."""
    turn = times(conjugate(p), q)
    return np.asarray(2 * np.arctan2(np.sqrt(np.sum(turn[1:] ** 2, axis=0)), np.abs(turn[0])))


def right(q: FloatArray) -> FloatArray:
    """Matrices that multiply by turns from the right: p q = right(q) p.

    Parameters
    ----------
    q : ndarray, shape (4, m)

    Returns
    -------
    ndarray, shape (4, 4, m)
    """
    return np.asarray(np.einsum("cab,bm->cam", _PRODUCT, q))


def left(q: FloatArray) -> FloatArray:
    """Matrices that multiply by turns from the left: q p = left(q) p; shape (4, 4, m)."""
    return np.asarray(np.einsum("cab,am->cbm", _PRODUCT, q))


def rotated(q: FloatArray, v: FloatArray) -> FloatArray:
    """Components of vectors after turns, shapes (4, m) and (3, m): body to sky.

    Element by element, as `times`.
    """
    w, x, y, z = q
    vx, vy, vz = v
    tx, ty, tz = 2 * (y * vz - z * vy), 2 * (z * vx - x * vz), 2 * (x * vy - y * vx)
    return np.stack(
        [
            vx + w * tx + y * tz - z * ty,
            vy + w * ty + z * tx - x * tz,
            vz + w * tz + x * ty - y * tx,
        ]
    )

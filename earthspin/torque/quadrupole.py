"""Tidal tensor of all perturbers, and its torque on an equatorial bulge (I.9.34).

With Q = sum of GM r r^T / r^5 over all perturbers, the torque per unit of C on a body with the
figure axis F is exactly

    N / C = 3 H (Q F) x F

to the leading order in the size of the body over the distance. Q depends only on the positions of
the perturbers, so it is computed once for any H, spin, or direction of the axis. Vectors have the
component axis first, shape (3, ...), because numpy is fast on long rows.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from earthspin.numerics.arrays import FloatArray


def tidal_tensor(pulls: Iterable[tuple[float, FloatArray]]) -> FloatArray:
    """Tidal tensor: sum of GM r r^T / r^5 over all perturbing masses, s-2.

    Parameters
    ----------
    pulls : iterable of (float, ndarray of shape (3, ...))
        GM (m3 s-2) and position from the body (m) of each.

    Returns
    -------
    ndarray, shape (6, ...)
        xx, yy, zz, xy, xz, yz; s-2.
    """
    total: FloatArray | None = None
    for gm, position in pulls:
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
    for row, first, second, third in zip(
        result, (xx, xy, xz), (xy, yy, yz), (xz, yz, zz), strict=True
    ):
        np.multiply(first, x, out=row)  # in place, because allocation is slower
        row += second * y
        row += third * z
    return result


def cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Vector product of two arrays of vectors, shape (3, ...)."""
    (ax, ay, az), (bx, by, bz) = a, b
    result = np.empty(np.broadcast_shapes(np.shape(a), np.shape(b)))
    for row, a1, b2, a2, b1 in zip(
        result, (ay, az, ax), (bz, bx, by), (az, ax, ay), (by, bz, bx), strict=True
    ):
        np.multiply(a1, b2, out=row)
        row -= a2 * b1
    return result


def dot(a: FloatArray, b: FloatArray) -> FloatArray:
    """Scalar product of two arrays of vectors, shape (3, ...)."""
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

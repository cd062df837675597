"""The equator of date of any body: the axes in which declination is measured.

The third axis is the spin axis, the first points to the body's equinox: where the Sun, on
its apparent orbit, crosses the equator northward.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def direction(right_ascension: float, declination: float) -> FloatArray:
    """Unit vector of a direction given in radians, shape (3,)."""
    return np.array(
        [
            math.cos(declination) * math.cos(right_ascension),
            math.cos(declination) * math.sin(right_ascension),
            math.sin(declination),
        ]
    )


def fixed_equator(axis: FloatArray, normal: FloatArray) -> FloatArray:
    """Matrix from the ICRF to the equator of a spin axis that does not move, shape (3, 3).

    An axis along the orbit's normal has no equinox; right ascension then counts from an
    arbitrary point of the equator.
    """
    node = np.cross(axis, normal)
    if np.linalg.norm(node) < 1e-12:
        node = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    x = node / np.linalg.norm(node)
    return np.stack([x, np.cross(axis, x), axis])


def rotate(matrix: FloatArray, vectors: FloatArray) -> FloatArray:
    """Turn vectors, shape (n, 3), by one matrix or by one matrix each."""
    if matrix.ndim == 2:
        return vectors @ matrix.T
    return np.asarray((matrix @ vectors[:, :, np.newaxis])[:, :, 0])


def angle(a: FloatArray, b: FloatArray) -> float:
    """Angle between two vectors, rad; exact for small angles and for nearly opposite ones."""
    return math.atan2(float(np.linalg.norm(np.cross(a, b))), float(np.dot(a, b)))


def spherical(vectors: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Right ascension (0 to 2 pi), declination and length of vectors, shape (n, 3).

    By arctan2 throughout: arcsin and arccos lose half the digits near the poles.
    """
    x, y, z = vectors.T
    in_plane = np.hypot(x, y)
    return np.arctan2(y, x) % (2 * np.pi), np.arctan2(z, in_plane), np.hypot(in_plane, z)

"""Equator of date of any body, from which declinations are measured.

The third axis is the spin axis, the first points to the body's equinox, where the Sun on its
apparent orbit crosses the equator northward.
"""

from __future__ import annotations

import math

import numpy as np

from earthspin.numerics.arrays import FloatArray


def direction(right_ascension: float, declination: float) -> FloatArray:
    """Unit vector from right ascension and declination in radians, shape (3,)."""
    return np.array(
        [
            math.cos(declination) * math.cos(right_ascension),
            math.cos(declination) * math.sin(right_ascension),
            math.sin(declination),
        ]
    )


def fixed_equator(axis: FloatArray, normal: FloatArray) -> FloatArray:
    """Matrix from the ICRF to the equator of a fixed spin axis, shape (3, 3).

    If the axis is along the orbit's normal there is no equinox; right ascension is then measured
    from an arbitrary point of the equator.
    """
    node = np.cross(axis, normal)
    if np.linalg.norm(node) < 1e-12:
        node = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    x = node / np.linalg.norm(node)
    return np.stack([x, np.cross(axis, x), axis])


def rotate(matrix: FloatArray, vectors: FloatArray) -> FloatArray:
    """Rotate vectors, shape (n, 3), by one matrix, or each vector by its own matrix."""
    if matrix.ndim == 2:
        return vectors @ matrix.T
    return np.asarray((matrix @ vectors[:, :, np.newaxis])[:, :, 0])


def angle(a: FloatArray, b: FloatArray) -> float:
    """Angle between two vectors, rad; accurate for small angles and for nearly opposite vectors."""
    return math.atan2(float(np.linalg.norm(np.cross(a, b))), float(np.dot(a, b)))


def spherical(vectors: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Right ascension (0 to 2 pi), declination and length of vectors, shape (n, 3).

    Uses arctan2, because arcsin and arccos lose half the digits near the poles.
    """
    x, y, z = vectors.T
    in_plane = np.hypot(x, y)
    return np.arctan2(y, x) % (2 * np.pi), np.arctan2(z, in_plane), np.hypot(in_plane, z)

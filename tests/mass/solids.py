"""Meshes of solids whose moments are known in closed form."""

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from earthspin.numerics.arrays import FloatArray

Mesh = tuple[FloatArray, NDArray[np.int64]]


def hull(points: FloatArray) -> Mesh:
    """The convex hull of points, its triangles counter-clockwise from outside."""
    found = ConvexHull(points)
    faces = found.simplices.astype(np.int64)
    inwards = np.linalg.det(points[faces] - points.mean(axis=0)) < 0
    faces[inwards] = faces[inwards, ::-1]
    used = np.unique(faces)
    return points[used], np.searchsorted(used, faces)


def brick(x: float, y: float, z: float) -> Mesh:
    """A brick with one corner at the origin."""
    return hull(np.array([[a, b, c] for a in (0, x) for b in (0, y) for c in (0, z)], dtype=float))


def ball(count: int, axes: tuple[float, float, float] = (1.0, 1.0, 1.0)) -> Mesh:
    """An ellipsoid, its vertices on a spiral (Fibonacci lattice)."""
    k = np.arange(count) + 0.5
    z, turn = 1 - 2 * k / count, np.pi * (1 + np.sqrt(5)) * k
    across = np.sqrt(1 - z * z)
    vertices, faces = hull(np.stack([across * np.cos(turn), across * np.sin(turn), z], axis=-1))
    return vertices * axes, faces

r"""Weighted points in a solid bounded by triangles, which integrate polynomials exactly.

A closed mesh is the sum of the signed tetrahedra from one point to each triangle. With r = u (p + v
(q - p) + v w (s - q)) for the corners p, q, s,

    integral of f over a tetrahedron = det(p, q, s) x integral of f u^2 v du dv dw from 0 to 1,

Gauss-Jacobi quadrature with k points along each of u, v and w, with weights u^2 and v, is exact for
polynomials up to degree 2k - 1: one point for the volume and centroid, two for the inertia, three
for multipoles up to degree 5.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import roots_jacobi

from earthspin.errors import BodyError
from earthspin.mass._checks import vectors
from earthspin.numerics.arrays import FloatArray

#: Number of triangles processed per block, to limit memory.
AT_ONCE = 1 << 14
_BODY = "mesh"


def closed_mesh(vertices: ArrayLike, faces: ArrayLike) -> tuple[FloatArray, NDArray[np.int64]]:
    """Return vertices and faces of a mesh; refuse it unless it is closed and oriented outwards.

    Parameters
    ----------
    vertices : array_like, shape (k, 3)
        m.
    faces : array_like of int, shape (n, 3)
        Indices of each triangle's corners in `vertices`.

    Raises
    ------
    BodyError
        If an index is out of range, the mesh is open, adjacent triangles have opposite orientation,
        all triangles are inside out, or two shells coincide.
    UndefinedError
        If the vertices are not finite vectors.
    """
    places, corners = vectors("vertices", vertices), np.asarray(faces)
    if corners.ndim != 2 or corners.shape[-1] != 3 or corners.dtype.kind not in "iu":
        raise BodyError(
            _BODY, "faces", f"shape {corners.shape}", "give three whole numbers for each triangle"
        )
    if corners.size == 0 or corners.min() < 0 or corners.max() >= len(places):
        raise BodyError(
            _BODY, "faces", f"{len(corners)} triangles",
            f"each corner is one of the {len(places)} vertices, counted from 0",
        )  # fmt: skip
    _refuse_open(corners)
    _refuse_coincident(places, corners)
    volume = sum(float(np.sum(weights)) for weights, _ in solid_points(places, corners, 1))
    if not volume > 0:
        raise BodyError(
            _BODY, "faces", f"a volume of {volume:.3g} m3",
            "the mesh is inside out: give the corners of each triangle counter-clockwise as seen "
            "from outside, like faces[:, ::-1]",
        )  # fmt: skip
    return places, corners.astype(np.int64)


def _refuse_open(faces: NDArray[np.integer]) -> None:
    """Raise an error if a mesh is open: each edge must occur once in each direction."""
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64)
    size = int(faces.max()) + 1
    forward, backward = np.sort(edges @ [size, 1]), np.sort(edges @ [1, size])
    if np.array_equal(forward, backward) and np.all(np.diff(forward) > 0):
        return
    single = np.setxor1d(edges @ [size, 1], edges @ [1, size])
    if single.size:
        raise BodyError(
            _BODY, "faces",
            f"{single.size // 2} edges with one triangle, or two of opposite orientation",
            "close the mesh, and orient all triangles the same way",
        )  # fmt: skip
    raise BodyError(_BODY, "faces", "an edge of more than two triangles", "give each triangle once")


def _refuse_coincident(places: FloatArray, faces: NDArray[np.integer]) -> None:
    """Raise an error if two equally oriented triangles coincide and would count twice."""
    _, same = np.unique(places, axis=0, return_inverse=True)
    corners = same.reshape(-1)[faces]
    first = np.argmin(corners, axis=1)[:, np.newaxis]
    turned = np.take_along_axis(corners, (first + np.arange(3)) % 3, axis=1)
    twice = len(turned) - len(np.unique(turned, axis=0))
    if twice:
        raise BodyError(
            _BODY, "faces", f"{twice} triangles that coincide with others",
            "two shells at the same place count their mass twice; give each shell once",
        )  # fmt: skip


@cache
def _cone(degree: int) -> tuple[FloatArray, FloatArray]:
    """Quadrature points in a tetrahedron, in barycentric coordinates (k, 3), and weights (k,)."""

    def rule(power: int) -> tuple[FloatArray, FloatArray]:
        """Nodes and weights of Gauss quadrature on [0, 1] with the weight function x^power."""
        nodes, weights = roots_jacobi(degree // 2 + 1, 0.0, float(power))
        return (nodes + 1) / 2, weights / 2.0 ** (power + 1)

    (u, wu), (v, wv), (w, ww) = rule(2), rule(1), rule(0)
    u, v, w = (grid.ravel() for grid in np.meshgrid(u, v, w, indexing="ij"))
    weights = np.einsum("i,j,k->ijk", wu, wv, ww).ravel()
    return np.stack([u * (1 - v), u * v * (1 - w), u * v * w], axis=-1), weights


def solid_points(
    vertices: FloatArray, faces: NDArray[np.int64], degree: int
) -> Iterator[tuple[FloatArray, FloatArray]]:
    """Yield quadrature points of a solid in batches: signed volumes (m3) and positions (m).

    Parameters
    ----------
    vertices : ndarray, shape (k, 3)
        Relative to a point near the centre; a distant origin causes cancellation.
    faces : ndarray, shape (n, 3)
    degree : int
        Degree of the polynomials to integrate exactly.
    """
    factors, weights = _cone(degree)
    for first in range(0, len(faces), AT_ONCE):
        corners = vertices[faces[first : first + AT_ONCE]]
        places = factors @ corners  # (n, k, 3)
        first_corner, second, third = np.moveaxis(corners, 1, 0)
        six_volumes = np.sum(first_corner * np.cross(second, third), axis=-1)
        yield (six_volumes[:, np.newaxis] * weights).ravel(), places.reshape(-1, 3)

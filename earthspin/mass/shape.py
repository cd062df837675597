"""Moments, principal axes, J2 to J4 and triaxiality of a body from its mass distribution.

The distribution is given by point masses, a density on a grid, or a closed mesh.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import roots_jacobi

from earthspin.errors import BodyError, UndefinedError
from earthspin.mass import tensor
from earthspin.numerics.arrays import FloatArray

# --- meshes ---------------------------------------------------------------------------------------
# A closed mesh is the sum of the signed tetrahedra from one point to each triangle. With r = u (p +
# v (q - p) + v w (s - q)) for the corners p, q, s,
#
#     integral of f over a tetrahedron = det(p, q, s) x integral of f u^2 v du dv dw from 0 to 1,
#
# Gauss-Jacobi quadrature with k points along each of u, v and w, with weights u^2 and v, is exact
# for polynomials up to degree 2k - 1: one point for the volume and centroid, two for the inertia,
# three for multipoles up to degree 5.

#: Number of triangles processed per block, to limit memory.
AT_ONCE = 1 << 14
_BODY = "mesh"


def closed_mesh(vertices: ArrayLike, faces: ArrayLike) -> tuple[FloatArray, NDArray[np.int64]]:
    """Check that a mesh is closed and oriented outwards; return vertices (m) and faces as arrays.

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
    places, corners = tensor.vectors("vertices", vertices), np.asarray(faces)
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
    _, number = np.unique(places, axis=0, return_inverse=True)
    corners = number.reshape(-1)[faces]
    smallest = np.argmin(corners, axis=1)[:, np.newaxis]
    rotated = np.take_along_axis(corners, (smallest + np.arange(3)) % 3, axis=1)
    duplicates = len(rotated) - len(np.unique(rotated, axis=0))
    if duplicates:
        raise BodyError(
            _BODY, "faces", f"{duplicates} triangles that coincide with others",
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
    for begin in range(0, len(faces), AT_ONCE):
        corners = vertices[faces[begin : begin + AT_ONCE]]
        places = factors @ corners  # (n, k, 3)
        p, q, s = np.moveaxis(corners, 1, 0)
        six_volumes = np.sum(p * np.cross(q, s), axis=-1)
        yield (six_volumes[:, np.newaxis] * weights).ravel(), places.reshape(-1, 3)


# --- shapes ---------------------------------------------------------------------------------------
# Every distribution is represented by points: point masses, or Gauss points in the cells of a grid
# or the tetrahedra of a mesh. About the centre of mass, along the principal axes, with C the polar
# moment,
#
#     J_n = -(1/(M a^n)) sum of m r^n P_n(cos theta),    J2 = (C - (A + B)/2)/(M a^2).

#: Function from the degree of the polynomials to integrate, to blocks of masses and positions.
Pieces = Callable[[int], Iterable[tuple[FloatArray, FloatArray]]]
#: Gauss points along each edge of a cell: exact up to degree 5.
POINTS = 3


@dataclass(frozen=True)
class Shape:
    """Mass, centre of mass, principal axes, and J2 to J4 of a solid.

    Attributes
    ----------
    mass : float
        kg.
    centre : ndarray, shape (3,)
        Centre of mass, in the frame of the input, m.
    principal : PrincipalAxes
        Moments A <= B <= C about the centre, kg m2, and their axes.
    radius : float
        Reference radius of J2, J3 and J4, m.
    j2, j3, j4 : float
        Zonal coefficients about the axis of C, unnormalised.
    """

    mass: float
    centre: FloatArray
    principal: tensor.PrincipalAxes
    radius: float
    j2: float
    j3: float
    j4: float

    @property
    def dynamical_flattening(self) -> float:
        """Dynamical flattening H = (C - (A + B)/2)/C of the body."""
        principal = self.principal
        return float((principal.c_minus_a + principal.c_minus_b) / 2 / principal.moments[2])

    @property
    def triaxiality(self) -> float:
        """Triaxiality (B - A)/(M a2) of the equatorial moments A and B."""
        return self.principal.b_minus_a / (self.mass * self.radius**2)

    @classmethod
    def of_masses(
        cls, masses: ArrayLike, positions: ArrayLike, radius: float | None = None
    ) -> Self:
        """Compute mass, centre of mass and figure of a body that consists of point masses.

        Parameters
        ----------
        masses : array_like, shape (k,)
            kg.
        positions : array_like, shape (k, 3)
            m.
        radius : float, optional
            Reference radius of the coefficients, m. Default: the distance of the farthest mass from
            the centre.

        Raises
        ------
        BodyError, UndefinedError
            If a mass is not positive, the shapes do not match, or all masses are at one point.
        """
        m, r = tensor.point_masses(masses, positions)
        if r.ndim != 2:
            raise BodyError("point masses", "positions", f"shape {r.shape}", "give (k, 3)")
        return cls._of(lambda degree: [(m, r)], r, radius)

    @classmethod
    def of_density(
        cls,
        density: ArrayLike,
        x: ArrayLike,
        y: ArrayLike,
        z: ArrayLike,
        radius: float | None = None,
    ) -> Self:
        """Compute mass, centre of mass and figure of a body from its density in grid cells.

        The result is exact for a density that is constant in each cell.

        Parameters
        ----------
        density : array_like, shape (nx, ny, nz)
            kg m-3; zero in empty cells.
        x, y, z : array_like
            Edges of the cells in increasing order, m.
        radius : float, optional
            As for `of_masses`. Default: the distance of the farthest corner of a cell with mass.
        """
        m, r = tensor.grid_masses(density, x, y, z, points=POINTS)
        edges = (np.asarray(edge, dtype=float) for edge in (x, y, z))
        full = np.argwhere(np.asarray(density) > 0)
        ends = np.stack(
            [edge[full[:, axis, np.newaxis] + [0, 1]] for axis, edge in enumerate(edges)], axis=1
        )
        corners = np.stack(
            [ends[:, (0, 1, 2), list(which)] for which in np.ndindex(2, 2, 2)], axis=1
        )
        return cls._of(lambda degree: [(m, r)], corners.reshape(-1, 3), radius)

    @classmethod
    def of_mesh(
        cls,
        vertices: ArrayLike,
        faces: ArrayLike,
        density: float | None = None,
        mass: float | None = None,
        radius: float | None = None,
    ) -> Self:
        """Compute mass, centre of mass and figure of a homogeneous solid bounded by triangles.

        The result is exact for flat faces.

        Parameters
        ----------
        vertices, faces
            As for `closed_mesh`.
        density, mass : float
            Exactly one of the two, kg m-3 or kg.
        radius : float, optional
            As for `of_masses`. Default: the distance of the farthest vertex.

        Raises
        ------
        BodyError
            If the mesh is open or inside out, or not exactly one of density and mass is given.
        """
        if (density is None) == (mass is None):
            raise BodyError("mesh", "density", density, "give either density or mass")
        places, corners = closed_mesh(vertices, faces)
        middle = places.mean(axis=0)

        def pieces(degree: int, scale: float = 1.0) -> Iterable[tuple[FloatArray, FloatArray]]:
            for volumes, points in solid_points(places - middle, corners, degree):
                yield scale * volumes, points + middle

        if mass is None:
            scale = float(tensor.positive("mesh", "density", density or 0.0))
        else:
            volume = sum(float(np.sum(volumes)) for volumes, _ in pieces(0))
            scale = float(tensor.positive("mesh", "mass", mass)) / volume
        return cls._of(lambda degree: pieces(degree, scale), places, radius)

    @classmethod
    def _of(cls, pieces: Pieces, outline: FloatArray, radius: float | None) -> Self:
        """Make a `Shape` from masses and positions of points; raise an error if numbers overflow.

        `outline` holds the points among which the farthest from the centre is found.
        """
        try:
            with np.errstate(over="raise", divide="raise", invalid="raise"):
                return cls._summed(pieces, outline, radius)
        except FloatingPointError as error:
            words = f"masses or lengths are out of a float's range ({error}); check their sizes"
            raise UndefinedError(words) from None

    @classmethod
    def _summed(cls, pieces: Pieces, outline: FloatArray, radius: float | None) -> Self:
        """Make a `Shape` by summation over masses and positions of points."""
        mass = sum(float(np.sum(m)) for m, _ in pieces(0))
        centre = np.sum([m @ r for m, r in pieces(1)], axis=0) / mass
        second = np.zeros((3, 3))
        for m, r in pieces(2):
            second += np.einsum("k,ki,kj->ij", m, r - centre, r - centre)
        principal = tensor.principal_axes(tensor.tensor_of_second_moments(second))
        farthest = float(np.max(np.linalg.norm(outline - centre, axis=1)))
        a = farthest if radius is None else float(tensor.positive("shape", "radius", radius))
        j3 = j4 = 0.0
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            for m, r in pieces(4):
                place = (r - centre) / a
                z, r2 = place @ principal.axes[2], np.einsum("ki,ki->k", place, place)
                z2 = z * z
                j3 -= float(m @ (z * (5 * z2 - 3 * r2))) / (2 * mass)
                j4 -= float(m @ ((35 * z2 - 30 * r2) * z2 + 3 * r2 * r2)) / (8 * mass)
            bulge = (principal.c_minus_a + principal.c_minus_b) / 2
            j2 = float(np.divide(bulge, mass * (a * a)))
        if not (np.isfinite([j2, j3, j4]).all() and 0 < mass * (a * a) < np.inf):
            raise BodyError("shape", "radius", a, "M a2 or a coefficient is out of a float's range")
        return cls(mass, centre, principal, a, j2, j3, j4)

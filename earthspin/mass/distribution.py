"""Mass distributions: checked point masses, and point masses that represent a gridded density.

A density that is constant in each cell is replaced by Gauss points inside the cells. With k
points along each edge every polynomial up to degree 2k - 1 is integrated exactly: two points
give the exact inertia tensor of the cells, and exterior multipoles up to degree 3.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from earthspin.errors import BodyError, UndefinedError
from earthspin.mass._checks import first, positive, vectors
from earthspin.numerics.arrays import FloatArray


def point_masses(masses: ArrayLike, positions: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Check point masses and positions, and return them as arrays of matching shapes.

    Parameters
    ----------
    masses : array_like, shape (..., k)
        Positive, kg; a single mass applies to all positions.
    positions : array_like, shape (..., k, 3)
        m.

    Raises
    ------
    BodyError
        If a mass is not positive.
    UndefinedError
        If the shapes do not match.
    """
    places = vectors("positions", positions)
    if places.ndim < 2 or places.shape[-2] == 0:
        raise UndefinedError(f"positions have the shape {places.shape}; give (k, 3), k at least 1")
    weights = positive("point masses", "mass", masses)
    try:
        return np.broadcast_to(weights, places.shape[:-1]), places
    except ValueError:
        raise UndefinedError(
            f"masses have the shape {weights.shape}, positions {places.shape}; "
            f"give one mass for each position"
        ) from None


def centre_of_mass(masses: ArrayLike, positions: ArrayLike) -> FloatArray:
    """Centre of mass of point masses.

    Parameters
    ----------
    masses : array_like, shape (..., k)
        kg.
    positions : array_like, shape (..., k, 3)
        m.

    Returns
    -------
    ndarray, shape (..., 3)
        m.
    """
    m, r = point_masses(masses, positions)
    return np.asarray(np.einsum("...k,...ki->...i", m, r) / np.sum(m, axis=-1)[..., np.newaxis])


def grid_masses(
    density: ArrayLike, x: ArrayLike, y: ArrayLike, z: ArrayLike, points: int = 2
) -> tuple[FloatArray, FloatArray]:
    """Point masses, with positions, that represent a density on a Cartesian grid.

    Parameters
    ----------
    density : array_like, shape (nx, ny, nz)
        Density of each cell, kg m-3; zero in empty cells.
    x, y, z : array_like, shapes (nx + 1,), (ny + 1,), (nz + 1,)
        Edges of the cells in increasing order, m.
    points : int
        Gauss points along each edge of a cell.

    Returns
    -------
    masses : ndarray, shape (k,)
        kg; empty cells are omitted.
    positions : ndarray, shape (k, 3)
        m.

    Raises
    ------
    BodyError
        If a density is negative, or all are zero.
    UndefinedError
        If the edges do not increase or do not match the density.
    """
    rho = np.asarray(density, dtype=float)
    edges = [np.asarray(edge, dtype=float) for edge in (x, y, z)]
    _check_grid(rho, edges)
    if points < 1:
        raise UndefinedError(f"points = {points} is not possible; give 1 or more per cell")
    node, weight = np.polynomial.legendre.leggauss(points)
    places = [(e[:-1] + e[1:])[:, None] / 2 + np.diff(e)[:, None] / 2 * node for e in edges]
    lengths = [np.diff(e)[:, None] / 2 * weight for e in edges]
    # Axes: cell along x, point along x, cell along y, ...
    mass = np.einsum("xyz,xa,yb,zc->xaybzc", rho, *lengths)
    grid = np.stack(np.meshgrid(*[p.ravel() for p in places], indexing="ij"), axis=-1)
    full = mass.ravel() > 0
    return mass.ravel()[full], grid.reshape(-1, 3)[full]


def _check_grid(rho: FloatArray, edges: list[FloatArray]) -> None:
    """Raise an error if cell densities or cell edges are invalid, or their sizes do not match."""
    cells = tuple(e.size - 1 for e in edges)
    if rho.shape != cells:
        raise UndefinedError(
            f"density has the shape {rho.shape}, the edges make {cells} cells; "
            f"give one more edge than cells along each axis"
        )
    for name, edge in zip("xyz", edges, strict=True):
        if edge.ndim != 1 or not np.all(np.isfinite(edge)) or np.any(np.diff(edge) <= 0):
            raise UndefinedError(
                f"the edges along {name} do not increase; sort them, without repeats"
            )
    wrong = ~(np.isfinite(rho) & (rho >= 0))
    if np.any(wrong):
        raise BodyError("grid", "density", first(rho, wrong), "it must be finite and not negative")
    if not np.any(rho):
        raise BodyError("grid", "density", 0.0, "at least one cell must hold mass")

"""Integrate linear equations dy/dr = M(r) y from one radius to another by Gauss collocation.

The interval is divided into panels. On each panel the solution is the polynomial that satisfies the
equation at the Gauss-Legendre nodes (Hairer & Wanner 1996, Solving Ordinary Differential Equations
II, sect. IV.5). This gives a small linear system for each panel; all systems are solved in one
call. Solutions, not products of panel matrices, are then propagated from panel to panel. The
matrices also contain solutions that decrease by many powers of the radius from a centre, whose
rounding errors would exceed the other solutions.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.polynomial import legendre

from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import Array

#: Number of nodes of a panel; the order of the method is twice this number.
NODES = 8
#: Largest initial ratio of the ends of a panel; M grows as 1/r towards a centre.
FIRST_RATIO = 1.5
#: Convergence tolerance: largest change of a solution when panels are halved, relative to its
#: largest element; and the limit below which stagnation from rounding is accepted, as in very soft
#: layers.
SETTLED, ROUNDED = 1e-13, 1e-8
MOST_HALVINGS = 6


def _rule(order: int) -> tuple[Array, Array, Array]:
    """Gauss nodes and weights on [0, 1], and the matrix that integrates from 0 to each node."""
    x, weights = legendre.leggauss(order)
    project = (legendre.legvander(x, order - 1) * weights[:, None]) * (np.arange(order) + 0.5)
    integrals = legendre.legval(x, legendre.legint(np.eye(order), lbnd=-1))
    return (x + 1) / 2, weights / 2, (project @ integrals).T / 2


_NODES, _WEIGHTS, _INTEGRATE = _rule(NODES)


def carry(
    matrix: Callable[[Array], Array],
    start: float,
    stop: float,
    y: Array,
    settled: float = SETTLED,
    together: bool = False,
) -> Array:
    """Integrate solutions of dy/dr = M(r) y from one radius to another by Gauss collocation.

    Parameters
    ----------
    matrix : callable
        Function of radii, shape (r,), that returns M, shape (..., r, n, n).
    start, stop : float
        Positive radii in any unit.
    y : ndarray, shape (..., n, k)
        k solutions at the start.
    settled : float
        Convergence tolerance: largest change of a solution when panels are halved, relative to its
        largest element.
    together : bool
        True if only the space of all combinations of the solutions matters. Changes within this
        space, such as rounding errors near a centre that mix solutions, are then ignored.

    Returns
    -------
    ndarray, shape (..., n, k)

    Raises
    ------
    UndefinedError
        If the solutions do not converge because a layer is too soft to be a solid.
    """
    count = max(1, int(np.ceil(np.log(stop / start) / np.log(FIRST_RATIO))))
    coarse, last = _through(matrix, start, stop, y, count), np.inf
    for _ in range(MOST_HALVINGS):
        count *= 2
        fine = _through(matrix, start, stop, y, count)
        size = np.max(abs(fine), axis=-2, keepdims=True)
        size = np.where(size > 0, size, 1.0)
        change = _largest((fine - coarse) / size, fine / size if together else None)
        if change <= settled or last / 4 < change <= ROUNDED:
            return fine
        coarse, last = fine, change
    raise UndefinedError(
        f"the solution between radii {start:.4g} and {stop:.4g} does not converge: a layer there "
        "is too soft to be a solid; make it a liquid, without vs, or stiffer"
    )


def _largest(change: Array, space: Array | None) -> float:
    """Largest absolute change of solutions, apart from recombinations of the columns of `space`."""
    if space is not None:
        change = change - space @ (np.linalg.pinv(space) @ change)
    return float(np.max(abs(change)))


def _through(
    matrix: Callable[[Array], Array], start: float, stop: float, y: Array, count: int
) -> Array:
    """Integrate the solutions y from `start` to `stop` in a given number of panels.

    The edges of the panels are in geometric progression.
    """
    edges = np.geomspace(start, stop, count + 1)
    width = np.diff(edges)
    radii = edges[:-1, None] + width[:, None] * _NODES
    m = matrix(radii.ravel())
    n = m.shape[-1]
    m = m.reshape(*m.shape[:-3], count, NODES, n, n) * width[:, None, None, None]
    # y at the nodes from y at the start: (1 - I M) Y = 1, for all panels at once.
    system = -np.einsum("jk,...kab->...jakb", _INTEGRATE, m)
    system = system.reshape(*system.shape[:-4], NODES * n, NODES * n) + np.eye(NODES * n)
    ones = np.broadcast_to(np.tile(np.eye(n), (NODES, 1)), (*system.shape[:-2], NODES * n, n))
    at_nodes = np.linalg.solve(system, ones).reshape(*system.shape[:-2], NODES, n, n)
    panels = np.eye(n) + np.einsum("k,...kab,...kbc->...ac", _WEIGHTS, m, at_nodes)
    for panel in range(count):
        y = panels[..., panel, :, :] @ y
    return np.asarray(y)

"""Polynomials on Gauss-Legendre nodes: integration in windows, collocation, interpolation.

A window is a time interval. Inside it, a function is the polynomial through its values at the
nodes.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property, lru_cache
from typing import Any, TypeVar

import numpy as np
from numpy.polynomial import legendre

from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import Array, ComplexArray, FloatArray

# --- windows --------------------------------------------------------------------------------------
# Integrals, derivatives and interpolated values of all windows are products with small constant
# matrices. Vectors have the component first, shape (3, window, node), so that numpy uses long
# contiguous rows.

#: Real values, or complex values for vectors in a plane.
_AnyArray = TypeVar("_AnyArray", FloatArray, ComplexArray)

_CHUNK = 1 << 14  # values evaluated in one call, so that the terms take a few megabytes


class Windows:
    """Consecutive time windows with the same number of Gauss-Legendre nodes in each.

    Parameters
    ----------
    edges : ndarray, shape (w + 1,)
        Ascending ends of the windows, s.
    order : int
        Number of nodes in each window.

    Attributes
    ----------
    times : ndarray, shape (w, n)
        Nodes, s.
    half : ndarray, shape (w, 1)
        Half the length of each window, s.
    """

    def __init__(self, edges: FloatArray, order: int) -> None:
        self.edges, self.order = edges, order
        self.half = np.diff(edges)[:, np.newaxis] / 2
        self.middle = (edges[:-1] + edges[1:])[:, np.newaxis] / 2
        self.times = self.middle + self.half * rule(order).nodes

    def coefficients(self, values: _AnyArray) -> _AnyArray:
        """Legendre coefficients of the polynomials through values at the nodes, (..., w, n)."""
        result: _AnyArray = _apply(values, rule(self.order).project)
        return result

    def derivative(self, values: _AnyArray) -> _AnyArray:
        """Derivative (per s) at the nodes of the polynomial through values at the nodes."""
        result: _AnyArray = _apply(values, rule(self.order).differentiate) / self.half
        return result

    def integral(self, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Integrals of a function from the start of each window to its nodes and to its end.

        Returns
        -------
        to_nodes : ndarray, shape (..., w, n)
            Integrals to the nodes.
        whole : ndarray, shape (..., w)
            Integrals over whole windows.
        """
        gauss = rule(self.order)
        to_nodes = (values @ gauss.integrate) * self.half
        return to_nodes, (values @ gauss.weights) * self.half[:, 0]

    def evaluate(self, coefficients: _AnyArray, times: FloatArray) -> _AnyArray:
        """Evaluate Legendre series of the windows at any times within the windows.

        Parameters
        ----------
        coefficients : ndarray, shape (k, w, m)
        times : ndarray, shape (t,)
            Times in any order, s.

        Returns
        -------
        ndarray, shape (k, t)
        """
        values: Any = np.empty((len(coefficients), times.size), dtype=coefficients.dtype)
        chunk = _CHUNK // len(coefficients) + 1
        for first in range(0, times.size, chunk):
            chunk_times = times[first : first + chunk]
            window = np.clip(np.searchsorted(self.edges, chunk_times) - 1, 0, len(self.half) - 1)
            x = (chunk_times - self.middle[window, 0]) / self.half[window, 0]
            basis = legendre.legvander(x, coefficients.shape[-1] - 1)
            values[:, first : first + chunk] = np.einsum(
                "ktm,tm->kt", coefficients[:, window, :], basis
            )
        result: _AnyArray = values
        return result


def _apply(values: Any, matrix: FloatArray) -> Any:
    """Multiply the last axis of real or complex values by a real matrix.

    For complex values, separate products of the real and imaginary parts halve the cost.
    """
    if np.iscomplexobj(values):
        product = np.empty((*values.shape[:-1], matrix.shape[1]), dtype=complex)
        product.real = np.ascontiguousarray(values.real) @ matrix
        product.imag = np.ascontiguousarray(values.imag) @ matrix
        return product
    return values @ matrix


class Rule:
    """Gauss-Legendre nodes on [-1, 1], with matrices that integrate and differentiate values."""

    def __init__(self, order: int) -> None:
        self.nodes, self.weights = legendre.leggauss(order)
        vander = legendre.legvander(self.nodes, order - 1)
        # Exact, because Gauss-Legendre integrates products of degree 2n - 1 exactly.
        self.project = (vander * self.weights[:, np.newaxis]) * (np.arange(order) + 0.5)
        self._basis = np.eye(order)

    @cached_property
    def integrate(self) -> FloatArray:
        """Matrix that converts values at the nodes to integrals from -1 to the nodes."""
        integrals = legendre.legint(self._basis, lbnd=-1)
        return np.asarray(self.project @ legendre.legval(self.nodes, integrals, tensor=True))

    @cached_property
    def antiderivative(self) -> FloatArray:
        """Matrix that converts Legendre coefficients of a function to those of its integral."""
        return np.asarray(legendre.legint(self._basis, lbnd=-1, axis=-1))

    @cached_property
    def differentiate(self) -> FloatArray:
        """Matrix that converts values at the nodes to derivatives at the nodes."""
        return np.asarray(
            self.project @ legendre.legval(self.nodes, legendre.legder(self._basis), tensor=True)
        )


@lru_cache
def rule(order: int) -> Rule:
    """Return the `Rule` (Gauss-Legendre nodes and matrices) of a given order, computed once."""
    return Rule(order)


def integrated(coefficients: FloatArray, half: FloatArray, start: FloatArray) -> FloatArray:
    """Legendre coefficients of a quantity in each window, from its rate and initial values.

    Parameters
    ----------
    coefficients : ndarray, shape (k, w, n)
        Legendre coefficients of the function.
    half : ndarray, shape (w, 1)
        Half lengths, s.
    start : ndarray, shape (k, w)
        Value at the start of each window.

    Returns
    -------
    ndarray, shape (k, w, n + 1)
    """
    series = (coefficients @ rule(coefficients.shape[-1]).antiderivative) * half
    series[..., 0] += start
    return series


# --- collocation ----------------------------------------------------------------------------------
# The interval is divided into panels. On each panel the solution is the polynomial that satisfies
# the equation at the Gauss-Legendre nodes (Hairer & Wanner 1996, Solving Ordinary Differential
# Equations II, sect. IV.5). This gives a small linear system for each panel; all systems are solved
# in one call. Solutions, not products of panel matrices, are then propagated from panel to panel.
# The matrices also contain solutions that decrease by many powers of the radius from a centre,
# whose rounding errors would exceed the other solutions.

#: Number of nodes of a panel; the order of the method is twice this number.
NODES = 8
#: Largest initial ratio of the ends of a panel; M grows as 1/r towards a centre.
FIRST_RATIO = 1.5
#: Convergence tolerance: largest change of a solution when panels are halved, relative to its
#: largest element; and the limit below which stagnation from rounding is accepted, as in very soft
#: layers.
SETTLED, ROUNDED = 1e-13, 1e-8
MOST_HALVINGS = 6

#: Gauss nodes and weights on [0, 1], and the matrix that integrates from 0 to each node.
_NODES, _WEIGHTS = (rule(NODES).nodes + 1) / 2, rule(NODES).weights / 2
_INTEGRATE = rule(NODES).integrate.T / 2


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
    """Largest absolute change, after components along the columns of `space` are removed."""
    if space is not None:
        change = change - space @ (np.linalg.pinv(space) @ change)
    return float(np.max(abs(change)))


def _through(
    matrix: Callable[[Array], Array], start: float, stop: float, y: Array, count: int
) -> Array:
    """Integrate solutions of dy/dr = M(r) y from `start` to `stop` in a given number of panels.

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


# --- interpolation --------------------------------------------------------------------------------


def lagrange(nodes: Array, at: Array) -> Array:
    """Values at given points of the Lagrange polynomials of given nodes, shape (nodes, points)."""
    rows = []
    for i, node in enumerate(nodes):
        others = np.delete(nodes, i)
        rows.append(np.prod((at[:, None] - others) / (node - others), axis=-1))
    return np.array(rows)

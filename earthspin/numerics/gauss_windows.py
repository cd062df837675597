"""Gauss-Legendre windows: consecutive time intervals, each with the same number of nodes.

Inside a window a function is the polynomial through its values at the nodes. Integrals,
derivatives and interpolated values of all windows are products with small constant matrices.
Vectors have the component first, shape (3, window, node), so that numpy uses long contiguous rows.
"""

from __future__ import annotations

from functools import cached_property, lru_cache
from typing import Any, TypeVar

import numpy as np
from numpy.polynomial import legendre

from earthspin.numerics.arrays import ComplexArray, FloatArray

#: Real values, or complex values for vectors in a plane.
_AnyArray = TypeVar("_AnyArray", FloatArray, ComplexArray)

_CHUNK = 1 << 15  # times evaluated in one call, so that the basis stays in the processor's cache


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
        """Derivative, per s, at the nodes, of the polynomial through values at the nodes."""
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
        for first in range(0, times.size, _CHUNK):
            part = times[first : first + _CHUNK]
            window = np.clip(np.searchsorted(self.edges, part) - 1, 0, len(self.half) - 1)
            x = (part - self.middle[window, 0]) / self.half[window, 0]
            basis = legendre.legvander(x, coefficients.shape[-1] - 1)
            values[:, first : first + _CHUNK] = np.einsum(
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
    """Return the `Rule` with a given number of nodes; it is computed once and stored."""
    return Rule(order)


def integrated(coefficients: FloatArray, half: FloatArray, start: FloatArray) -> FloatArray:
    """Legendre coefficients of a start value plus the integral of a rate, in each window.

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

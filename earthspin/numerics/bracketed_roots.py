"""Roots of many functions at once, each between two points at which it has opposite signs."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from earthspin.numerics.arrays import Array, FloatArray

#: Most steps, and every how many of them a bisection, which bounds their number.
STEPS, BISECT = 80, 4


def bracketed_roots(
    function: Callable[[FloatArray, Array], FloatArray],
    low: FloatArray,
    high: FloatArray,
    tolerance: float = 1e-14,
) -> FloatArray:
    """Find one root per bracket, by the rule of false position with Illinois weights.

    Parameters
    ----------
    function : callable
        Values at points, of the functions with the given indices.
    low, high : ndarray
        Ends of the brackets.
    tolerance : float
        Largest distance of a root from the end of its bracket.
    """
    low, high = low.copy(), high.copy()
    todo = np.arange(low.size)
    at_low, at_high, moved = function(low, todo), function(high, todo), np.zeros(low.size)
    for step in range(STEPS):
        if not todo.size:
            break
        a, b, at_a, at_b = low[todo], high[todo], at_low[todo], at_high[todo]
        with np.errstate(divide="ignore", invalid="ignore"):
            x = (a * at_b - b * at_a) / (at_b - at_a)
        x = np.where((x > a) & (x < b) & (step % BISECT != BISECT - 1), x, (a + b) / 2)
        value = function(x, todo)
        right = np.sign(value) == np.sign(at_a)  # the root lies to the right of x
        low[todo], high[todo] = np.where(right, x, a), np.where(right, b, x)
        # an end that stays twice in a row counts half
        at_low[todo] = np.where(right, value, np.where(moved[todo] < 0, at_a / 2, at_a))
        at_high[todo] = np.where(right, np.where(moved[todo] > 0, at_b / 2, at_b), value)
        moved[todo] = np.where(right, 1, -1)
        found = (value == 0) | (np.minimum(x - a, b - x) < tolerance)
        low[todo[found]] = high[todo[found]] = x[found]
        todo = todo[~found & (b - a > tolerance)]
    return (low + high) / 2

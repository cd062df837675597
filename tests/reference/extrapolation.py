"""Integration in long double: the modified midpoint rule with Richardson's extrapolation.

See Gragg 1965, and Hairer, Norsett & Wanner 1993, sect. II.9. Only increments are extrapolated, so
that rounding does not grow.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

LongArray = NDArray[np.longdouble]
LONG = np.longdouble
Slope = Callable[[LongArray], LongArray]

#: Columns of the extrapolation: order 20.
COLUMNS = 10


def extrapolated(state: LongArray, length: Any, rules: Iterable[Sequence[Slope]]) -> LongArray:
    """Return what a step adds, by midpoint rules of 2, 4, 6 ... parts.

    Parameters
    ----------
    state : ndarray
    length : float
        Length of the step.
    rules : iterable of sequences of callable
        For each rule, the slopes at its nodes.
    """
    table: list[LongArray] = []
    for column, slopes in enumerate(rules):
        h = length / (len(slopes) - 1)
        before, here = np.zeros_like(state), h * slopes[0](state)
        for slope in slopes[1:-1]:
            before, here = here, before + 2 * h * slope(state + here)
        row = [(before + here + h * slopes[-1](state + here)) / 2]
        for k in range(column):
            ratio = LONG((column + 1) ** 2) / LONG((column - k) ** 2)
            row.append(row[-1] + (row[-1] - table[k]) / (ratio - 1))
        table = row
    return table[-1]


def increment(state: LongArray, length: Any, slope: Slope) -> LongArray:
    """Return what a step adds if the slope depends on the state alone."""
    return extrapolated(state, length, [[slope] * (2 * n + 1) for n in range(1, COLUMNS + 1)])


def states(
    state: LongArray, increments: Iterable[Callable[[LongArray], LongArray]]
) -> Iterator[LongArray]:
    """Yield the start and the state after each step, by compensated sums (Kahan 1965)."""
    carry: Any = np.zeros_like(state)  # lost by rounding of the sums
    yield state
    for step in increments:
        grown = step(state) + carry
        after = state + grown
        carry = grown - (after - state)
        state = after
        yield state

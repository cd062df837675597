"""A tumbling moon in long double: orbit, angular momentum and quaternion, by extrapolation.

    r'' = -r/r3,    l' = R n,    q' = (1/2) q omega,    n = 3/r5 r x I r along the body's axes

by the modified midpoint rule and Richardson's extrapolation (Gragg 1965; Hairer, Norsett & Wanner
1993, sect. II.9). The orbit is integrated, too, so that no Kepler equation is solved. It shares
with `earthspin.motion.march` the equations, and neither method nor code.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from itertools import repeat
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin.checks.ladders import of_rotation

LongArray = NDArray[np.longdouble]
LONG = np.longdouble

#: Steps in each unit of time, 1/n; and columns of the extrapolation: order 20.
STEPS, COLUMNS = 32, 10


def tumbling() -> tuple[LongArray, LongArray]:
    """Angular velocity along the body's axes and attitude at the times of `of_rotation`."""
    path = integrate(STEPS)
    finer = integrate(2 * STEPS)[::2]
    places = np.rint(of_rotation.times() * STEPS).astype(int)
    change = np.max(np.abs(finer[places] - path[places]))
    print(f"rotation: steps of half the length change the state by {float(change):.1g}")
    state = finer[places]
    q = state[:, 9:] / np.sqrt(np.sum(state[:, 9:] ** 2, axis=1))[:, np.newaxis]
    omega = [_spin(row[6:9], turn) for row, turn in zip(state, q, strict=True)]
    return np.stack(omega), q


def _moments() -> LongArray:
    h, triaxiality = LONG(of_rotation.H), LONG(of_rotation.TRIAXIALITY)
    return np.array([1 - h - triaxiality / 2, 1 - h + triaxiality / 2, LONG(1)])


def _matrix(q: LongArray) -> LongArray:
    w, x, y, z = q
    return np.array(
        [
            [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ]
    )


def _spin(momentum: LongArray, q: LongArray) -> LongArray:
    return np.asarray((momentum @ _matrix(q)) / _moments())


def _slope(state: LongArray) -> LongArray:
    r, velocity, momentum, q = state[:3], state[3:6], state[6:9], state[9:]
    square = r @ r
    turn, (a, b, c) = _matrix(q), _moments()
    x, y, z = r @ turn
    pull = 3 / (square * square * np.sqrt(square))
    torque = pull * np.array([(c - b) * y * z, (a - c) * x * z, (b - a) * x * y])
    (w, i, j, k), (p, s, t) = q, _spin(momentum, q)
    turning = [-i * p - j * s - k * t, w * p + j * t - k * s, w * s + k * p - i * t]
    turning.append(w * t + i * s - j * p)
    return np.concatenate(
        [velocity, -r / (square * np.sqrt(square)), turn @ torque, np.array(turning) / 2]
    )


def integrate(steps: int) -> LongArray:
    """States at the ends of so many steps in each unit of time, shape (n + 1, 13)."""
    e = LONG(of_rotation.ECCENTRICITY)
    omega = np.array(of_rotation.OMEGA, dtype=LONG)
    place = [1 - e, 0, 0, 0, np.sqrt((1 + e) / (1 - e)), 0]
    start = np.array([*place, *(_moments() * omega), 1, 0, 0, 0], dtype=LONG)
    step = partial(increment, length=LONG(1) / steps)
    return np.stack(list(states(start, repeat(step, round(of_rotation.SPAN * steps)))))


def increment(
    state: LongArray, length: Any, slope: Callable[[LongArray], LongArray] = _slope
) -> LongArray:
    """Return what a step adds if the slope depends on the state alone."""
    return extrapolated(state, length, [[slope] * (2 * n + 1) for n in range(1, COLUMNS + 1)])


def extrapolated(
    state: LongArray, length: Any, rules: Iterable[Sequence[Callable[[LongArray], LongArray]]]
) -> LongArray:
    """Return what a step adds, by midpoint rules of 2, 4, 6 ... parts, extrapolated to none.

    Parameters
    ----------
    state : ndarray
    length : float
        Of the step.
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


def states(
    state: LongArray, increments: Iterable[Callable[[LongArray], LongArray]]
) -> Iterator[LongArray]:
    """Yield the start and the state after each step, by compensated sums (Kahan 1965)."""
    carry: Any = np.zeros_like(state)  # what additions round away
    yield state
    for step in increments:
        grown = step(state) + carry
        after = state + grown
        carry = grown - (after - state)
        state = after
        yield state

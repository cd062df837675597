"""The answers of PREM to potentials in its parts, in long double, by another path.

Hooke's law, the balance of forces and Poisson's equation as they stand, in the logarithm of the
radius, by the modified midpoint rule and Richardson's extrapolation, from a tenth of the radius at
which `earthspin.interior.equations` starts. It shares neither equations nor method nor code with
`earthspin.interior.love`.
"""

from __future__ import annotations

from functools import partial
from itertools import repeat
from typing import Any

import numpy as np
from numpy.typing import NDArray

from data_tools.rotation_reference import increment, states
from earthspin.interior.prem import PREM
from tests.interior.another_integration import START, Slope, other_answers

LongArray = NDArray[np.longdouble]
LONG = np.longdouble

#: Largest step of the logarithm of the radius.
STEP = 0.1


def answers() -> LongArray:
    """Answers [i, j] of whole body, fluid and inner core, as `Yielding.answers`."""
    coarse, fine = (
        other_answers(PREM, partial(carry, step), LONG, START / 10) for step in (STEP, STEP / 2)
    )
    change = np.max(abs(coarse / fine - 1))
    print(f"compliances: steps of half the length change them by {float(change):.1g}")
    return fine


def carry(longest: float, slope: Slope, y: LongArray, start: Any, stop: Any) -> LongArray:
    """Carry columns from one radius to another in steps of the logarithm."""
    length = np.log(stop / start)
    count = int(np.ceil(float(length) / longest))
    state = np.concatenate([y, np.full((1, y.shape[1]), np.log(start), dtype=LONG)])

    def log_slope(now: LongArray) -> LongArray:
        r = np.exp(now[-1, 0])
        return np.concatenate([r * slope(r, now[:-1]), np.ones_like(now[-1:])])

    step = partial(increment, length=length / count, slope=log_slope)
    *_, end = states(state, repeat(step, count))
    return end[:-1]

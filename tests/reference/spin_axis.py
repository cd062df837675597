"""Spin axis over millions of years in long double, by extrapolation of order 14.

It shares the torque with `earthspin.secular.trajectory`, and neither method nor variables.
"""

from functools import partial

import numpy as np

from earthspin.constants import JULIAN_YEAR
from earthspin.numerics.arrays import FloatArray
from earthspin.secular.averaged_torque import ChangingOrbit, PrecessionConstant, mean_torque
from tests.reference.extrapolation import LONG, LongArray, extrapolated, states


def spin_axis(
    strength: PrecessionConstant,
    orbit: ChangingOrbit,
    start: FloatArray,
    end: float,
    step: float = 2000 * JULIAN_YEAR,
) -> FloatArray:
    """Unit vectors of the axis at the ends of equal steps from J2000.0 to `end`, shape (3, n + 1).

    Each step lies in one window of the orbit, which is evaluated at the nodes of all steps at once.
    """
    count, parts = round(abs(end) / step), 2 * np.arange(1, 8)
    length = end / count
    shares = np.unique(np.concatenate([np.arange(n + 1) / n for n in parts]))
    # a hair inside, so that both ends of a step belong to its window
    nodes = length * (np.arange(count)[:, np.newaxis] + 1e-12 + (1 - 2e-12) * shares)
    torque = mean_torque(strength, orbit.at(nodes.ravel()), nodes.ravel())
    root = (np.sqrt(torque.constant) * torque.axis).reshape(3, count, -1)
    geodesic = torque.geodesic.reshape(3, count, -1)

    def slope(number: int, node: int, s: LongArray) -> LongArray:
        x, y, z = s
        a, b, c = m = root[:, number, node]
        p, q, r = geodesic[:, number, node] - (a * x + b * y + c * z) * m
        return np.array([q * z - r * y, r * x - p * z, p * y - q * x])

    places = [np.searchsorted(shares, np.arange(n + 1) / n - 1e-12) for n in parts]
    steps = (
        partial(
            extrapolated,
            length=LONG(length),
            rules=[[partial(slope, number, node) for node in rule] for rule in places],
        )
        for number in range(count)
    )
    return np.stack(list(states(start.astype(LONG), steps))).T.astype(np.float64)

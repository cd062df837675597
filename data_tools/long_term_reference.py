"""The spin axis over a million years, by Gragg's midpoint rule, extrapolated.

The rule is that of Hairer, Norsett & Wanner (1993, sect. II.9), of order 14.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from earthspin.checks.ladders.of_long_term import KYR, STRENGTH, orbit
from earthspin.secular.orbit import pull

FloatArray = NDArray[np.float64]

#: Length of a step, s, and how often each is divided.
REFERENCE_STEP, DIVIDED = 2 * KYR, (2, 4, 6, 8, 10, 12, 14)


def reference(start: FloatArray, times: FloatArray, step: float = REFERENCE_STEP) -> FloatArray:
    """Axis at the times, shape (3, n), by the extrapolated midpoint rule.

    Each step lies in one window of the orbit; what the orbit gives is asked for all at once.
    """
    each = max(round(-times[0] / (times.size - 1) / step), 1)
    h = times[0] / (times.size - 1) / each
    shares = np.unique(np.concatenate([np.arange(n + 1) / n for n in DIVIDED]))
    count = (times.size - 1) * each
    # a hair inside, so that both ends of a step belong to the window it lies in
    inside = 1e-12 + (1 - 2e-12) * shares
    nodes = (h * (np.arange(count)[:, np.newaxis] + inside)).ravel()
    on = pull(STRENGTH, orbit().at(nodes), nodes)
    root = (np.sqrt(on.constant) * on.axis).reshape(3, count, -1)
    geodesic = on.geodesic.reshape(3, count, -1)
    places = [np.searchsorted(shares, np.arange(n + 1) / n - 1e-12) for n in DIVIDED]
    s, result = start, [start]
    for number in range(count):
        m, g = root[:, number].T, geodesic[:, number].T
        s = _extrapolated(s, h, m, g, places)
        if (number + 1) % each == 0:
            result.append(s)
    return np.array(result[::-1]).T


def _extrapolated(
    s: FloatArray, h: float, m: FloatArray, g: FloatArray, places: list[NDArray[np.int_]]
) -> FloatArray:
    """One step: the midpoint rule with each division, extrapolated to none."""
    table: list[FloatArray] = []
    for n, at in zip(DIVIDED, places, strict=True):

        def slope(k: int, u: FloatArray, at: NDArray[np.int_] = at) -> FloatArray:
            a, b, c = m[at[k]].tolist()
            p, q, r = g[at[k]].tolist()
            x, y, z = u.tolist()
            lift = a * x + b * y + c * z
            p, q, r = p - lift * a, q - lift * b, r - lift * c
            return np.array([q * z - r * y, r * x - p * z, p * y - q * x])

        before, now = s, s + h / n * slope(0, s)
        for k in range(1, n):
            before, now = now, before + 2 * h / n * slope(k, now)
        row = [(before + now + h / n * slope(n, now)) / 2]
        for other, above in zip(DIVIDED[len(table) - 1 :: -1] if table else (), table, strict=True):
            row.append(row[-1] + (row[-1] - above) / ((n / other) ** 2 - 1))
        table = row
    return table[-1]

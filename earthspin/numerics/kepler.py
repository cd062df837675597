r"""Kepler's equation, M = E - e sin(E), and the three anomalies of an ellipse.

On 0 to pi the right side is convex in E, so Newton's method from above the root goes down to it and
never past it. Four numbers bound E from above there: pi; M + e; M/(1 - e); and (pi^2 M/e)^(1/3),
since E - sin(E) >= E^3/pi^2. The least of them is near enough everywhere, next to a parabola too.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

#: Newton steps: after these no M moves further, at any e up to 1 - 1e-12. What E - sin(E) loses to
#: cancellation does not matter before the last two.
STEPS, LAST_STEPS = 6, 2

_TURN = 2 * np.pi


def eccentric_anomaly(mean: FloatArray, e: FloatArray) -> FloatArray:
    """Solve Kepler's equation, rad, in the same turn.

    Parameters
    ----------
    mean : ndarray
        Mean anomaly, rad.
    e : ndarray
        Eccentricity, 0 to less than 1; it broadcasts against the anomaly.
    """
    turns = _TURN * np.rint(mean / _TURN)
    half = np.abs(mean - turns)  # 0 to pi; the rest of the orbit is its mirror image
    with np.errstate(over="ignore"):
        circle = np.minimum(half + e, half / (1 - e))
        parabola = np.cbrt(np.pi**2 * half / np.maximum(e, np.finfo(float).tiny))
    found = np.minimum(np.minimum(circle, np.pi), parabola)
    for step in range(STEPS):
        less_sine = found - np.sin(found) if step < STEPS - LAST_STEPS else _less_sine(found)
        # (1 - e) stands apart, so that nothing cancels next to a parabola
        off = (1 - e) * found + e * less_sine - half
        found = found - off / ((1 - e) + 2 * e * np.sin(found / 2) ** 2)
    return np.asarray(turns + np.copysign(found, mean - turns))


def true_anomaly(mean: FloatArray, e: FloatArray) -> FloatArray:
    """True anomaly from a mean one, rad, in the same turn."""
    eccentric = eccentric_anomaly(mean, e)
    # v - E, by the form that has no jump
    ahead = np.arctan2(e * np.sin(eccentric), 1 + np.sqrt(1 - e * e) - e * np.cos(eccentric))
    return np.asarray(eccentric + 2 * ahead)


def mean_anomaly(true: FloatArray, e: FloatArray) -> FloatArray:
    """Mean anomaly from a true one, rad, in the same turn."""
    behind = np.arctan2(e * np.sin(true), 1 + np.sqrt(1 - e * e) + e * np.cos(true))
    eccentric = true - 2 * behind
    turns = _TURN * np.rint(eccentric / _TURN)
    return np.asarray(turns + (1 - e) * (eccentric - turns) + e * _less_sine(eccentric - turns))


def _less_sine(angle: FloatArray) -> FloatArray:
    """An angle less its sine; by its series where the two cancel."""
    square = np.minimum(angle * angle, 1.0)
    series = np.ones_like(square)
    for n in range(18, 2, -2):
        series = 1 - square / (n * (n + 1)) * series
    return np.asarray(np.where(np.abs(angle) < 1, angle**3 / 6 * series, angle - np.sin(angle)))

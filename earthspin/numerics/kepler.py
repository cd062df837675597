r"""Kepler's equation, M = E - e sin(E), and the three anomalies of an ellipse.

From 0 to pi the right side is convex in E, so Newton's method from above converges monotonically.
Four numbers are upper bounds of E: pi; M + e; M/(1 - e); and (pi^2 M/e)^(1/3), since
E - sin(E) >= E^3/pi^2. The smallest of them is a sufficient first estimate for every e below 1.
"""

from __future__ import annotations

import numpy as np

from earthspin.numerics.arrays import FloatArray

#: Number of Newton steps, sufficient for every M and e up to 1 - 1e-12, and number of last steps in
#: which E - sin(E) is computed without cancellation.
STEPS, LAST_STEPS = 6, 2

_TURN = 2 * np.pi


def eccentric_anomaly(mean: FloatArray, e: FloatArray) -> FloatArray:
    """Eccentric anomaly, rad, from the mean anomaly, in the same revolution.

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
    angle = np.minimum(np.minimum(circle, np.pi), parabola)
    for step in range(STEPS):
        less_sine = angle - np.sin(angle) if step < STEPS - LAST_STEPS else _less_sine(angle)
        # The separate factor (1 - e) avoids cancellation for e close to 1.
        residual = (1 - e) * angle + e * less_sine - half
        angle = angle - residual / ((1 - e) + 2 * e * np.sin(angle / 2) ** 2)
    return np.asarray(turns + np.copysign(angle, mean - turns))


def true_anomaly(mean: FloatArray, e: FloatArray) -> FloatArray:
    """True anomaly, rad, from the mean anomaly, in the same revolution."""
    eccentric = eccentric_anomaly(mean, e)
    # v - E, by a form without discontinuity
    ahead = np.arctan2(e * np.sin(eccentric), 1 + np.sqrt(1 - e * e) - e * np.cos(eccentric))
    return np.asarray(eccentric + 2 * ahead)


def mean_anomaly(true: FloatArray, e: FloatArray) -> FloatArray:
    """Mean anomaly, rad, from the true anomaly, in the same revolution."""
    behind = np.arctan2(e * np.sin(true), 1 + np.sqrt(1 - e * e) + e * np.cos(true))
    eccentric = true - 2 * behind
    turns = _TURN * np.rint(eccentric / _TURN)
    return np.asarray(turns + (1 - e) * (eccentric - turns) + e * _less_sine(eccentric - turns))


def _less_sine(angle: FloatArray) -> FloatArray:
    """Difference x - sin(x) of an angle and its sine, by a series for small angles."""
    square = np.minimum(angle * angle, 1.0)
    series = np.ones_like(square)
    for n in range(18, 2, -2):
        series = 1 - square / (n * (n + 1)) * series
    return np.asarray(np.where(np.abs(angle) < 1, angle**3 / 6 * series, angle - np.sin(angle)))

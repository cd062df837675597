"""Patterns that the tip of a top's axis traces: waves, cusps or loops (I.7.19).

The precession phi' is proportional to b - a u, and vanishes at u = b/a. The cubic there is
(1 - u^2)(alpha - beta b/a), so that the tip reverses, and traces loops, if |b| < |a| and

    a (a alpha - b beta) = a [a (theta'^2 + phi'^2 sin^2(theta)) - beta phi' sin^2(theta)] > 0.

If this is zero the tip comes to rest in a cusp, always at the upper turning point. All terms follow
from the start, so the patterns can be distinguished without the roots.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import BoolArray, FloatArray
from earthspin.top.cubic import AxisStart, axis_start
from earthspin.top.start import HeavyTop, axis_heights, top_constants

#: Sums smaller than this fraction of their terms count as zero, as rounding errors.
_ROUNDING = 16 * float(np.finfo(float).eps)


def nutation_pattern(top: HeavyTop) -> NDArray[np.str_]:
    """Name of the pattern that the tip of a top's axis traces, such as a wave or loop (I.7.19).

    Returns
    -------
    ndarray of str, shape of the tops
        ``sleeping``: vertical and at rest (for its stability see `sleeping_top`).
        ``steady``: theta is constant. ``cusp``: the tip comes to rest at each upper turning
        point. ``loop``: phi' changes sign. ``wave``: phi' does not change sign; this includes a
        plane pendulum, and an axis that passes exactly over a pole.
        Steady motion and cusps are recognised to within rounding of the start.
    """
    start = axis_start(top)
    turning = start.b_minus_a * start.b_plus_a < 0  # |b| < |a|
    drive, size = _loop_drive(start)
    conditions = [
        start.asleep,
        _is_steady(start),
        turning & (np.abs(drive) <= _ROUNDING * size),
        turning & (start.a * drive > 0),
    ]
    names = ["sleeping", "steady", "cusp", "loop"]
    return np.select(conditions, names, default="wave").reshape(top.shape)


class PatternLimits(NamedTuple):
    """Initial precession rates phi' at which the tip's pattern changes, as waves to loops, rad/s.

    Attributes
    ----------
    cusp : ndarray, shape (..., 2)
        Limits between waves (inside) and loops (outside), with cusps at the limits. For a start at
        a turning point they are zero (start at the upper one) and 2 m g r/(I3 omega3), twice the
        slow precession of a fast top (start at the lower one).
    over_pole : ndarray, shape (..., 2)
        Rates for which the axis passes exactly over the upper and the lower pole; loops end there,
        and beyond phi' does not change sign.
    """

    cusp: FloatArray
    over_pole: FloatArray


def pattern_limits(top: HeavyTop) -> PatternLimits:
    """Initial precession rates phi' at which waves change to loops and back (I.7.19), rad/s.

    Parameters
    ----------
    top : HeavyTop
        Its own phi_rate is ignored.

    Raises
    ------
    UndefinedError
        If the top has no spin or is vertical, or theta' is so fast that no phi' gives a cusp.
    """
    a, _, _, beta = top_constants(top)
    below, above, _ = axis_heights(top.theta)
    sine2 = below * above
    if np.any((a == 0) | (sine2 == 0)):
        raise UndefinedError(
            "a top without spin or on the vertical draws neither cusps nor loops; "
            "give a spin other than 0 and theta between 0 and pi"
        )
    # a sin^2 phi'^2 - beta sin^2 phi' + a theta'^2 = 0
    inside = beta**2 * sine2 - 4 * (a * top.theta_rate) ** 2
    if np.any(inside < 0):
        bound = np.sqrt(beta**2 * sine2) / (2 * np.abs(a))
        fast = np.abs(top.theta_rate) > bound
        raise UndefinedError(
            f"with theta_rate = {float(top.theta_rate[fast].flat[0])!r} rad/s no phi_rate gives "
            f"a cusp; |theta_rate| up to {float(bound[fast].flat[0]):.6g} rad/s allows it"
        )
    sine = np.sqrt(sine2)
    sense = np.where(beta < 0, -1.0, 1.0)
    larger = (beta * sine + sense * np.sqrt(inside)) / (2 * a * sine)
    filled = np.where(larger == 0, 1.0, larger)
    smaller = np.where(larger == 0, 0.0, top.theta_rate**2 / sine2 / filled)
    cusp = np.sort(np.stack([smaller, larger], axis=-1), axis=-1)
    return PatternLimits(cusp, np.stack([a / above, -a / below], axis=-1))


def _is_steady(start: AxisStart) -> BoolArray:
    """Return True if theta' = theta'' = 0 at the start, so that the inclination is constant."""
    phi_rate = start.phi_rate
    gyroscopic, centrifugal = 2 * phi_rate * start.a, 2 * phi_rate**2 * start.cosine
    size = np.abs(gyroscopic) + np.abs(centrifugal) + start.beta
    balanced = np.abs(gyroscopic - centrifugal - start.beta) <= _ROUNDING * size
    return np.asarray((start.theta_rate == 0) & (start.sine2 > 0) & balanced)


def _loop_drive(start: AxisStart) -> tuple[FloatArray, FloatArray]:
    """Difference whose sign separates waves from loops, and the size of its two terms.

    The terms are a alpha and b beta (I.7.7) at the start of the top's motion.
    """
    inertia, weight = start.a * start.rate2, start.beta * start.phi_rate * start.sine2
    return inertia - weight, np.abs(inertia) + np.abs(weight)

"""Patterns that the tip of a top's axis traces, steady precession, and sleeping tops (I.7.19).

The precession phi' is proportional to b - a u, and vanishes at u = b/a. The cubic there is (1 -
u^2)(alpha - beta b/a), so that the tip reverses, and traces loops, if |b| < |a| and

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
from earthspin.top.start import AxisStart, HeavyTop, top_constants

# --- patterns -------------------------------------------------------------------------------------

#: Sums smaller than this fraction of their terms count as zero, as rounding errors.
_ROUNDING = 16 * float(np.finfo(float).eps)


def nutation_pattern(start: AxisStart) -> NDArray[np.str_]:
    """Name of the pattern that the tip of a top's axis traces, such as a wave or loop (I.7.19).

    Returns
    -------
    ndarray of str, shape of the tops
        ``sleeping``: vertical and at rest, and stable there. ``steady``: theta is constant, also
        if the axis is vertical and not stable. ``cusp``: the tip comes to rest at each upper
        turning point. ``loop``: phi' changes sign. ``wave``: phi' does not change sign; this
        includes a plane pendulum, and an axis that passes exactly over a pole.
        Steady motion and cusps are recognised to within rounding of the start.
    """
    turning = start.b_minus_a * start.b_plus_a < 0  # |b| < |a|
    # a alpha and b beta (I.7.7), whose difference separates waves from loops
    inertia, weight = start.a * start.rate2, start.beta * start.phi_rate * start.sine2
    drive, size = inertia - weight, np.abs(inertia) + np.abs(weight)
    conditions = [
        start.asleep & (stability_margin(start) >= -_ROUNDING),
        start.asleep | _is_steady(start),
        turning & (np.abs(drive) <= _ROUNDING * size),
        turning & (start.a * drive > 0),
    ]
    names = ["sleeping", "steady", "cusp", "loop"]
    return np.select(conditions, names, default="wave").reshape(np.shape(start.below))


def stability_margin(start: AxisStart) -> FloatArray:
    """Stability margin of a vertical top, (omega3/critical spin)^2 - 1, negative if it falls.

    It is infinite if the top hangs or has no weight. That of an inclined top is of the vertical
    position with the centre of mass above the pivot.
    """
    falls = (start.beta > 0) & ((start.sine2 > 0) | (start.cosine > 0))
    with np.errstate(over="ignore"):
        margin = start.stability / np.where(falls, 2 * start.beta, 1.0)
    return np.where(falls, margin, np.inf)


def stability_of(margin: FloatArray) -> NDArray[np.str_]:
    """Stability that a margin means: "unstable", "critical" to within rounding, or "stable"."""
    return np.select([margin < -_ROUNDING, margin <= _ROUNDING], ["unstable", "critical"], "stable")


def _is_steady(start: AxisStart) -> BoolArray:
    """Return True if theta' = theta'' = 0 at the start, so that the inclination is constant."""
    phi_rate = start.phi_rate
    gyroscopic, centrifugal = 2 * phi_rate * start.a, 2 * phi_rate**2 * start.cosine
    size = np.abs(gyroscopic) + np.abs(centrifugal) + start.beta
    balanced = np.abs(gyroscopic - centrifugal - start.beta) <= _ROUNDING * size
    return np.asarray((start.theta_rate == 0) & (start.sine2 > 0) & balanced)


# --- steady precession and sleeping tops ----------------------------------------------------------
# For constant u = cos(theta) the precession rate satisfies u phi'^2 - a phi' + beta/2 = 0.

_STEADY_ROUNDING = 8 * float(np.finfo(float).eps)


class SteadyPrecession(NamedTuple):
    """Slow and fast rate at which a top precesses without nutation, rad/s.

    Attributes
    ----------
    slow : ndarray
        Tends to m g r/(I3 omega3) for a fast spin.
    fast : ndarray
        Tends to I3 omega3/(I1 cos(theta)) for a fast spin, as without weight; infinite for a
        horizontal axis, which has only the slow one.
    """

    slow: FloatArray
    fast: FloatArray


class SleepingTop(NamedTuple):
    """Stability of a top in the upright position, theta = 0.

    Attributes
    ----------
    critical_spin : ndarray
        Smallest |omega3| of a stable upright top, rad/s; zero for a hanging or weightless top.
    stable : ndarray of bool
        Whether the upright position is stable at the top's spin.
    growth_rate : ndarray
        Growth rate of a small inclination below the critical spin, 1/s; zero if stable.
    fall_angle : ndarray
        Largest inclination after an infinitesimal disturbance, rad; zero if stable.
    rates : ndarray, shape (..., 2)
        Rates of the two small circular motions about the vertical, slow and fast, rad/s; below the
        critical spin both are the rate of the outward spiral.
    nutation_rate : ndarray
        Rate of small nutations, the difference of `rates`, rad/s; zero if not stable.
    """

    critical_spin: FloatArray
    stable: BoolArray
    growth_rate: FloatArray
    fall_angle: FloatArray
    rates: FloatArray
    nutation_rate: FloatArray


def minimum_spin(top: HeavyTop) -> FloatArray:
    """Smallest |omega3| that allows steady precession of a top at its inclination, rad/s.

    omega3^2 = 4 I1 m g r cos(theta)/I3^2; zero if the centre of mass is not above the pivot.
    """
    lifted = np.maximum(top.weight_moment * np.cos(top.theta), 0.0)
    minimum: FloatArray = 2 * np.sqrt(top.transverse_moment * lifted) / top.axial_moment
    return minimum


def steady_precession(top: HeavyTop) -> SteadyPrecession:
    """Compute the slow and fast steady precession rates of a top for its inclination and spin.

    Parameters
    ----------
    top : HeavyTop
        Its own phi_rate and theta_rate are ignored. Without spin the two rates are those of the
        conical pendulum, in opposite directions.

    Raises
    ------
    UndefinedError
        If the spin is below the minimum.
    """
    a, _, _, beta = top_constants(top)
    cosine = np.cos(top.theta)
    square = a**2 - 2 * beta * cosine
    # At exactly the minimum spin, rounding may make the difference slightly negative.
    square = np.where(np.abs(square) <= _STEADY_ROUNDING * a**2, np.maximum(square, 0.0), square)
    _refuse_slow_spin(top, square < 0)
    larger = (a + np.where(a < 0, -1.0, 1.0) * np.sqrt(square)) / 2  # cos(theta) phi', fast
    still, level = larger == 0, cosine == 0
    slow = np.where(still, 0.0, beta / 2 / np.where(still, 1.0, larger))
    infinite = np.where(still, 0.0, np.copysign(np.inf, larger))
    fast = np.where(level, infinite, larger / np.where(level, 1.0, cosine))
    return SteadyPrecession(slow, fast)


def _refuse_slow_spin(top: HeavyTop, slow: BoolArray) -> None:
    """Raise an error if a top spins too slowly for steady precession at its inclination."""
    if np.any(slow):
        spin, theta, minimum = (
            float(x[slow].flat[0]) for x in (top.spin, top.theta, minimum_spin(top))
        )
        raise UndefinedError(
            f"a spin of {spin!r} rad/s is too slow for steady precession at theta = {theta!r} "
            f"rad; give at least {minimum:.6g} rad/s in either direction"
        )


def sleeping_top(top: HeavyTop) -> SleepingTop:
    """Compute the critical spin of an upright top, omega3^2 = 4 I1 m g r/I3^2, and stability.

    A small inclination xi = theta e^(i phi) obeys xi'' - i a xi' - (beta/2) xi = 0.

    Parameters
    ----------
    top : HeavyTop
        Only its moments, weight and spin matter.
    """
    lifted = np.maximum(top.weight_moment, 0.0)
    critical = 2 * np.sqrt(top.transverse_moment * lifted) / top.axial_moment
    a, _, _, beta = top_constants(top)
    spin = np.abs(top.spin)
    stable = spin >= critical
    # a^2 - 2 beta, factored to stay accurate near the critical spin
    scale = top.axial_moment / top.transverse_moment
    from_critical = scale**2 * (spin - critical) * (spin + critical)
    excess = np.where(lifted > 0, from_critical, a**2 - 2 * beta)
    nutation = np.sqrt(np.maximum(excess, 0.0))
    fast = (a + np.where(a < 0, -1.0, 1.0) * nutation) / 2
    moves = fast != 0
    slow = np.where(stable, np.where(moves, beta / 2 / np.where(moves, fast, 1.0), 0.0), fast)
    short = np.sqrt(np.maximum((critical - spin) * (critical + spin), 0.0))
    return SleepingTop(
        critical_spin=critical,
        stable=stable,
        growth_rate=np.sqrt(np.maximum(-excess, 0.0)) / 2,
        fall_angle=np.where(stable, 0.0, 2 * np.arctan2(short, spin)),
        rates=np.stack([slow, fast], axis=-1),
        nutation_rate=nutation,
    )

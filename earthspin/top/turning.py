"""Turning points of the inclination theta of a top, and its effective potential (I.7.16)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from earthspin.errors import BodyError
from earthspin.numerics.arrays import FloatArray
from earthspin.top.azimuth import mean_precession
from earthspin.top.cubic import axis_start, cubic_gaps
from earthspin.top.height import nutation_of
from earthspin.top.start import HeavyTop, axis_heights, top_constants


def cubic_roots(top: HeavyTop) -> FloatArray:
    """Roots of the cubic in u = cos(theta) that determines the nutation of a top (I.7.16).

    Returns
    -------
    ndarray, shape (..., 3)
        Roots in ascending order. The axis moves between the two roots in -1 to 1; the third is 1 or
        more (-1 or less for a negative weight moment), and infinite without weight.
    """
    start = axis_start(top)
    gaps = cubic_gaps(start)
    weight = start.beta > 0
    beyond = np.where(weight, gaps.outer / np.where(weight, start.beta, 1.0), np.inf)
    roots = np.stack(
        [
            _cosine(start.below + gaps.lower, gaps.lower_pole),
            _cosine(gaps.upper_pole, start.above + gaps.upper),
            1 + beyond,
        ],
        axis=-1,
    )
    return np.where(start.turned[..., np.newaxis], -roots[..., ::-1], roots)


def turning_angles(top: HeavyTop) -> FloatArray:
    """Smallest and largest inclination of a top's axis, rad, accurate also near the poles.

    Returns
    -------
    ndarray, shape (..., 2)
        rad; equal for steady motion.
    """
    nutation = nutation_of(top)
    gaps = nutation.gaps
    below = np.sqrt(np.stack([gaps.upper_pole, nutation.depth], axis=-1))
    above = np.sqrt(np.stack([nutation.height, gaps.lower_pole], axis=-1))
    turned = nutation.start.turned[..., np.newaxis]
    other_end = 2 * np.arctan2(above, below)[..., ::-1]
    return np.where(turned, other_end, 2 * np.arctan2(below, above))


def nutation_period(top: HeavyTop) -> FloatArray:
    """Period of the nutation (oscillation of the inclination theta) of a top, s.

    For steady motion it is the period of a small nutation; infinite if theta approaches the upright
    position asymptotically, or never turns.
    """
    nutation = nutation_of(top)
    never = (nutation.stiffness == 0) | (nutation.complement == 0)
    half_period = np.where(never, 1.0, nutation.half_period)
    return np.where(never, np.inf, 2 * half_period / nutation.start.rate_unit)


def mean_precession_rate(top: HeavyTop) -> FloatArray:
    """Mean precession rate phi' of a top over one nutation period, rad/s.

    For a top that passes exactly over a pole it is the mean of the limits from both sides, for a
    sleeping top its initial phi', and for a top that approaches the upright position asymptotically
    the limit b/2.
    """
    nutation = nutation_of(top)
    start = nutation.start
    mean = np.where(nutation.complement > 0, mean_precession(nutation), start.b / 2)
    still = start.asleep | (nutation.stiffness == 0)
    return np.where(still, top.phi_rate, mean * start.rate_unit)


def effective_potential(top: HeavyTop, theta: ArrayLike) -> FloatArray:
    """Effective potential V(theta) of a top, for which theta'^2 + V is constant, rad2/s2 (I.7.18).

    V = (b - a cos(theta))^2/sin^2(theta) + beta cos(theta); I1 V/2 is an energy in J.

    Parameters
    ----------
    top : HeavyTop
    theta : float or ndarray
        Inclination from 0 to pi, rad; its axes follow those of the tops.

    Returns
    -------
    ndarray
        rad2/s2; infinite on a pole that the axis cannot reach.
    """
    theta = np.asarray(theta, dtype=np.float64)
    outside = ~((theta >= 0) & (theta <= np.pi))
    if np.any(outside):
        bad = float(theta[outside].flat[0])
        raise BodyError("heavy top", "theta", bad, "give an angle from 0 to pi rad")
    heights = axis_heights(top.theta)
    a, _, _, beta = top_constants(top)
    to_upper = heights.below * (top.phi_rate * heights.above - a)  # b - a
    to_lower = heights.above * (top.phi_rate * heights.below + a)  # b + a
    shape = top.shape + (1,) * theta.ndim
    a, beta, to_upper, to_lower = (np.reshape(x, shape) for x in (a, beta, to_upper, to_lower))
    below, above, cosine = axis_heights(theta)
    # (b - a u)/sin(theta)
    rate = (
        _over_root(to_lower * below, below * above) + _over_root(to_upper * above, below * above)
    ) / 2
    return rate**2 + beta * cosine


def _over_root(numerator: FloatArray, radicand: FloatArray) -> FloatArray:
    """Quotient numerator/sqrt(radicand); 0 or infinite where the radicand is 0.

    If the radicand is 0, the result is 0 for a zero numerator and otherwise infinite.
    """
    open_ = radicand > 0
    limit = np.where(numerator == 0, 0.0, np.copysign(np.inf, numerator))
    return np.where(open_, numerator / np.sqrt(np.where(open_, radicand, 1.0)), limit)


def _cosine(below: FloatArray, above: FloatArray) -> FloatArray:
    """Cosine u of theta from 1 - u and 1 + u, without cancellation."""
    return np.where(below < above, 1 - below, above - 1)

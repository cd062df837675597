"""Nutation of a top: oscillation of its axis between two inclinations (I.7.16 to I.7.18).

    u = cos(theta) = u1 + (u2 - u1) sn^2(Omega t, m),
    4 Omega^2 = beta (u3 - u1),    m = (u2 - u1)/(u3 - u1)

with t from the lower turning point. From the upper turning point, a quarter period K later,

    u2 - u = (u2 - u1)(1 - m) sn^2/dn^2.

Each time is measured from the nearest turning point, so that the distance from that point has full
relative accuracy and no argument exceeds K/2.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ellipkm1, elliprf

from earthspin.errors import BodyError
from earthspin.numerics.arrays import BoolArray, FloatArray
from earthspin.numerics.elliptic import jacobi_sncndn
from earthspin.top.start import (
    AxisStart,
    Gaps,
    HeavyTop,
    axis_heights,
    axis_start,
    cubic_gaps,
    top_constants,
)

# --- nutation -------------------------------------------------------------------------------------

#: Half period assigned to motion on the separatrix: longer than any time in the rate unit.
_NEVER = 1e290
#: Time step that only determines the side of the pole, in the rate unit.
_MOMENT = 1e-120


class TopNutation(NamedTuple):
    """Constants of a top's nutation, the oscillation of its axis between two inclinations.

    Rates are in the rate unit of the start.

    Attributes
    ----------
    start : AxisStart
    gaps : Gaps
    swing : ndarray
        u2 - u1.
    stiffness : ndarray
        beta (u3 - u1) = 4 Omega^2; for a small swing, the nutation's frequency squared.
    stiffness_above : ndarray
        beta (u3 - u2).
    complement : ndarray
        1 - m.
    half_period : ndarray
        Time from one turning point to the next; `_NEVER` on the separatrix.
    at_upper : ndarray of bool
        Whether the phase of the start is measured from the upper turning point.
    phase : ndarray
        Time since that turning point, negative before it.
    """

    start: AxisStart
    gaps: Gaps
    swing: FloatArray
    stiffness: FloatArray
    stiffness_above: FloatArray
    complement: FloatArray
    half_period: FloatArray
    at_upper: BoolArray
    phase: FloatArray

    @property
    def rate(self) -> FloatArray:
        """Rate Omega of the argument of the elliptic functions, in the top's unit of rates.

        It is 1 for a steady motion, to allow division.
        """
        return np.sqrt(np.where(self.stiffness > 0, self.stiffness, 4.0)) / 2

    @property
    def crosses_lower_pole(self) -> BoolArray:
        """Return True if the top's axis passes exactly through the downward vertical."""
        return np.asarray((self.gaps.lower_pole == 0) & (self.swing > 0))

    @property
    def crosses_upper_pole(self) -> BoolArray:
        """Return True if the top's axis passes exactly through the upward vertical."""
        return np.asarray((self.gaps.upper_pole == 0) & (self.swing > 0))

    @property
    def depth(self) -> FloatArray:
        """Distance 1 - u1, along u = cos(theta), from the upper pole to the lower turning point."""
        return self.start.below + self.gaps.lower

    @property
    def height(self) -> FloatArray:
        """Distance 1 + u2, along u = cos(theta), from the lower pole to the upper turning point."""
        return self.start.above + self.gaps.upper


class Place(NamedTuple):
    """Phase of a top's axis in its nutation cycle, measured from the nearest turning point.

    Attributes
    ----------
    halves : ndarray
        Number of half periods from the first lower turning point to the nearest turning point: even
        at lower ones, odd at upper ones.
    upper : ndarray of bool
        Whether the nearest turning point is an upper one.
    phase : ndarray
        Omega times the time since that turning point, from -K/2 to K/2.
    sn, cn, dn : ndarray
        Jacobi's functions of the phase.
    """

    halves: FloatArray
    upper: BoolArray
    phase: FloatArray
    sn: FloatArray
    cn: FloatArray
    dn: FloatArray


class AxisHeight(NamedTuple):
    """Height u = cos(theta) of a top's axis in time: 1 - u, 1 + u, u - u(0), and the rate u'.

    Attributes
    ----------
    below, above : ndarray
        1 - u and 1 + u.
    climb : ndarray
        u - u(0).
    u_rate : ndarray
        u', in the rate unit.
    """

    below: FloatArray
    above: FloatArray
    climb: FloatArray
    u_rate: FloatArray


def nutation_of(top: HeavyTop) -> TopNutation:
    """Compute the constants of the nutation of one or more tops from the initial states."""
    start = axis_start(top)
    gaps = cubic_gaps(start)
    gaps = gaps._replace(
        lower=np.where(start.asleep, 0.0, gaps.lower),
        lower_pole=np.where(start.asleep, start.above, gaps.lower_pole),
    )
    swing = gaps.lower + gaps.upper
    stiffness = gaps.outer + start.beta * (start.below + gaps.lower)
    above = gaps.outer + start.beta * gaps.upper_pole
    moving = stiffness > 0
    complement = np.where(moving, above / np.where(moving, stiffness, 1.0), 1.0)
    returns = moving & (complement > 0)
    quarter = ellipkm1(np.where(returns, complement, 1.0))
    rate = np.sqrt(np.where(moving, stiffness, 1.0)) / 2
    half_period = np.where(returns, quarter / rate, _NEVER)
    nutation = TopNutation(
        start=start,
        gaps=gaps,
        swing=swing,
        stiffness=stiffness,
        stiffness_above=above,
        complement=complement,
        half_period=half_period,
        at_upper=(gaps.upper < gaps.lower) & returns,
        phase=np.zeros_like(swing),
    )
    return nutation._replace(phase=_phase_of_start(nutation))


def _phase_of_start(nutation: TopNutation) -> FloatArray:
    """Signed time from the nearest turning point to the initial state, in scaled units."""
    start, gaps = nutation.start, nutation.gaps
    third = start.beta * start.below + gaps.outer  # beta (u3 - u(0))
    moves = (nutation.swing > 0) & (third > 0)
    scale = np.where(moves, nutation.swing * third, 1.0)
    stiffness, above = nutation.stiffness, nutation.stiffness_above
    upper = nutation.at_upper
    sn2 = np.where(upper, gaps.upper * stiffness, gaps.lower * third) / scale
    cn2 = np.where(upper, gaps.lower * above, gaps.upper * third) / scale
    dn2 = np.where(upper, above * nutation.swing / scale, third / np.where(moves, stiffness, 1.0))
    integral = np.sqrt(sn2) * elliprf(np.where(moves, cn2, 1), np.where(moves, dn2, 1), 1.0)
    elapsed = np.where(moves, integral / nutation.rate, 0.0)
    # A start on a pole lies just after the passage, or just before it if theta_rate is negative.
    elapsed = np.where(moves & (start.sine2 == 0), _MOMENT, elapsed)
    leaving = np.where(start.theta_rate < 0, -1.0, 1.0)
    return elapsed * np.where(upper, leaving, -leaving)


def place_at(nutation: TopNutation, elapsed: FloatArray) -> Place:
    """Find the phase of a top's axis in its nutation cycle at given times.

    Parameters
    ----------
    nutation : TopNutation
    elapsed : ndarray
        Time since the start, in the rate unit; broadcasts with the tops.
    """
    half_period = nutation.half_period
    # fmod is exact, so the error of a long time comes only from that of the period.
    remainder = np.fmod(elapsed, half_period)
    halves = np.rint((elapsed - remainder) / half_period) + nutation.at_upper
    remainder = remainder + nutation.phase
    shift = np.rint(remainder / half_period)
    halves, from_start = halves + shift, remainder - shift * half_period
    upper = np.fmod(halves, 2) != 0
    on_pole = np.where(upper, nutation.crosses_upper_pole, nutation.crosses_lower_pole)
    from_start = np.where(on_pole & (from_start == 0), _MOMENT, from_start)
    phase = nutation.rate * from_start
    return Place(halves, upper, phase, *jacobi_sncndn(phase, nutation.complement))


def height_at(nutation: TopNutation, place: Place) -> AxisHeight:
    """Compute the height u = cos(theta) of a top's axis at given times, and the rate u'.

    The height is given as distances from the poles and the start. Those from the poles are sums of
    positive terms.
    """
    gaps, swing, complement = nutation.gaps, nutation.swing, nutation.complement
    upper, sn, cn, dn = place.upper, place.sn, place.cn, place.dn
    climbed = swing * np.where(upper, cn / dn, sn) ** 2  # u - u1
    descent = swing * np.where(upper, complement * (sn / dn) ** 2, cn**2)  # u2 - u
    rate = 2 * nutation.rate * swing * sn * cn * np.where(upper, -complement / dn**3, dn)
    return AxisHeight(
        gaps.upper_pole + descent,
        gaps.lower_pole + climbed,
        np.where(
            gaps.upper + descent < climbed + gaps.lower, gaps.upper - descent, climbed - gaps.lower
        ),
        rate,
    )


# --- turning points -------------------------------------------------------------------------------


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
    lower = _cosine(start.below + gaps.lower, gaps.lower_pole)
    upper = _cosine(gaps.upper_pole, start.above + gaps.upper)
    roots = np.stack([lower, upper, 1 + beyond], axis=-1)
    return np.where(start.turned[..., np.newaxis], -roots[..., ::-1], roots)


def turning_angles(nutation: TopNutation) -> FloatArray:
    """Smallest and largest inclination of a top's axis, rad, accurate also near the poles.

    Returns
    -------
    ndarray, shape (..., 2)
        rad; equal for steady motion.
    """
    gaps = nutation.gaps
    below = np.sqrt(np.stack([gaps.upper_pole, nutation.depth], axis=-1))
    above = np.sqrt(np.stack([nutation.height, gaps.lower_pole], axis=-1))
    turned = nutation.start.turned[..., np.newaxis]
    other_end = 2 * np.arctan2(above, below)[..., ::-1]
    return np.where(turned, other_end, 2 * np.arctan2(below, above))


def nutation_period(nutation: TopNutation) -> FloatArray:
    """Period of the nutation (oscillation of the inclination theta) of a top, s.

    For steady motion it is the period of a small nutation; infinite if theta approaches the upright
    position asymptotically, or never turns.
    """
    never = (nutation.stiffness == 0) | (nutation.complement == 0)
    half_period = np.where(never, 1.0, nutation.half_period)
    return np.where(never, np.inf, 2 * half_period / nutation.start.rate_unit)


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

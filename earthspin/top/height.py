"""Nutation of a top: oscillation of its axis between two inclinations (I.7.16, I.7.17).

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
from scipy.special import ellipkm1, elliprf

from earthspin.numerics.arrays import BoolArray, FloatArray
from earthspin.numerics.elliptic import jacobi_sncndn
from earthspin.top.cubic import AxisStart, Gaps, axis_start, cubic_gaps
from earthspin.top.start import HeavyTop

#: Half period assigned to motion on the separatrix: longer than any time in the rate unit.
_NEVER = 1e290
#: Time step that only determines the side of the pole, in the rate unit.
_MOMENT = 1e-120


class Nutation(NamedTuple):
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
    """Position of a top's axis in its nutation cycle, from the nearest turning point.

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
    """Height u = cos(theta) of a top's axis in time, as distances, and its rate u'.

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


def nutation_of(top: HeavyTop) -> Nutation:
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
    nutation = Nutation(
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


def _phase_of_start(nutation: Nutation) -> FloatArray:
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
    since = np.where(moves, integral / nutation.rate, 0.0)
    # A start on a pole lies just after the passage, or just before it if theta_rate is negative.
    since = np.where(moves & (start.sine2 == 0), _MOMENT, since)
    leaving = np.where(start.theta_rate < 0, -1.0, 1.0)
    return since * np.where(upper, leaving, -leaving)


def place_at(nutation: Nutation, elapsed: FloatArray) -> Place:
    """Find the position of a top's axis in its nutation cycle at given times.

    Parameters
    ----------
    nutation : Nutation
    elapsed : ndarray
        Time since the start, in the rate unit; broadcasts with the tops.
    """
    half_period = nutation.half_period
    # fmod is exact, so the error of a long time comes only from that of the period.
    rest = np.fmod(elapsed, half_period)
    halves = np.rint((elapsed - rest) / half_period) + nutation.at_upper
    rest = rest + nutation.phase
    shift = np.rint(rest / half_period)
    halves, since = halves + shift, rest - shift * half_period
    upper = np.fmod(halves, 2) != 0
    on_pole = np.where(upper, nutation.crosses_upper_pole, nutation.crosses_lower_pole)
    since = np.where(on_pole & (since == 0), _MOMENT, since)
    phase = nutation.rate * since
    return Place(halves, upper, phase, *jacobi_sncndn(phase, nutation.complement))


def height_at(nutation: Nutation, place: Place) -> AxisHeight:
    """Compute the height u = cos(theta) of a top's axis at given times, and its rate.

    It is given as distances from the poles and the start.

    The distances from the poles are sums of positive terms.
    """
    gaps, swing, complement = nutation.gaps, nutation.swing, nutation.complement
    upper, sn, cn, dn = place.upper, place.sn, place.cn, place.dn
    climbed = swing * np.where(upper, cn / dn, sn) ** 2  # u - u1
    descent = swing * np.where(upper, complement * (sn / dn) ** 2, cn**2)  # u2 - u
    rate = 2 * nutation.rate * swing * sn * cn * np.where(upper, -complement / dn**3, dn)
    return AxisHeight(
        gaps.upper_pole + descent,
        gaps.lower_pole + climbed,
        np.where(upper, gaps.upper - descent, climbed - gaps.lower),
        rate,
    )

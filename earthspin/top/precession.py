"""How phi and psi advance: integrals of the third kind that stay regular over the poles (I.7.9).

Half the sum and half the difference of phi and psi (for I1 = I3),

    sigma' = (a + b)/(2 (1 + u)),    delta' = (b - a)/(2 (1 - u)),

are the phases of the Cayley-Klein parameters cos(theta/2) e^(i sigma), sin(theta/2) e^(i delta).
Reckoned from a turning point ur, with us the other one, each is an arc tangent and a regular
integral:

    sigma = arctan[(a + b)(u - ur)/((1 + ur) u')] + int (a + b)/2 w(1 + ur) dt
    delta = arctan[(b - a)(u - ur)/((1 - ur) u')] - int (b - a)/2 w(ur - 1) dt
    w(x)  = (u - ur)/((ur - us)(ur - u3) + x (u - ur))

The arc tangent takes up the quick half turn that a passage near a pole brings. The integral is
in proportion to the weight, so that a free rotor has the arc tangents alone; and as a function
of the phase it is the same from either turning point,

    int w dt = beta/(4 Omega^3) sn^3/3 RJ(cn^2, dn^2, 1, 1 + (1 + u1)/(u3 - u1) sn^2)

for sigma, and 1 - (1 - u1)/(u3 - u1) sn^2 for delta. For |b| < |a|, as in a fast top, the arc
tangents wind in opposite senses and cancel, while the integrals add up: the slow precession
keeps its digits. Where b is close to a though the axis stays away from the upper pole, delta
hardly moves, its two parts would cancel, and Legendre's own form is taken.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import ellipkm1, elliprf, elliprj

from earthspin.top.nutation import Nutation, Place

FloatArray = NDArray[np.float64]

# cos and sin of a whole number of quarter turns
_COSINE = np.array([1.0, 0.0, -1.0, 0.0])
_SINE = np.array([0.0, 1.0, 0.0, -1.0])


class Turned(NamedTuple):
    """Angles by which phi and psi have turned; psi as if I1 were I3.

    Attributes
    ----------
    phi, psi : ndarray
        rad.
    """

    phi: FloatArray
    psi: FloatArray


def turned_at(nutation: Nutation, place: Place) -> tuple[Turned, Turned]:
    """Angles phi and psi reckoned from the first lower turning point.

    Returns
    -------
    quarters : Turned
        Whole quarter turns: kept apart, since they lose nothing in a long time.
    rest : Turned
        rad.
    """
    full, part = _complete_integrals(nutation), _partial_integrals(nutation, place)
    arc = _arc_tangents(nutation, place)
    rest = Turned(
        arc.phi + (place.count * full.phi + part.phi),
        arc.psi + (place.count * full.psi + part.psi),
    )
    return _windings(nutation, place.count), rest


def mean_precession(nutation: Nutation) -> FloatArray:
    """Mean of phi' over a nutation, in the rate unit.

    A top that passes exactly over a pole is given the mean of the two limits from either side.
    """
    start, full = nutation.start, _complete_integrals(nutation)
    sigma = np.where(nutation.crosses_lower_pole, 0.0, np.sign(start.b_plus_a))
    delta = np.where(nutation.crosses_upper_pole, 0.0, _upper_winding(nutation))
    return (np.pi / 2 * (sigma + delta) + full.phi) / nutation.half_period


def _windings(nutation: Nutation, count: FloatArray) -> Turned:
    """Quarter turns of phi and psi at a turning point, from the arc tangents.

    Exactly over a pole the half turn has no sense; it is taken to and fro by turns.
    """
    start, quarter = nutation.start, np.mod(count, 4).astype(int)
    sigma = np.where(nutation.crosses_lower_pole, _SINE[quarter], count * np.sign(start.b_plus_a))
    delta = np.where(
        nutation.crosses_upper_pole, -_COSINE[quarter], count * _upper_winding(nutation)
    )
    return Turned(sigma + delta, sigma - delta)


def _upper_winding(nutation: Nutation) -> FloatArray:
    """Quarter turns of delta in half a period, from the arc tangent."""
    return np.where(_has_upper_arc(nutation), np.sign(nutation.start.b_minus_a), 0.0)


def _has_upper_arc(nutation: Nutation) -> NDArray[np.bool_]:
    """Whether delta is an arc tangent and a regular integral: unless u3 is closer to 1 than u2."""
    return np.asarray(nutation.gaps.outer >= nutation.start.beta * nutation.gaps.upper_pole)


def _arc_tangents(nutation: Nutation, place: Place) -> Turned:
    """Arc tangents of sigma and delta, added and subtracted as angles without cancellation.

    With tan sigma = (l/h) t and tan delta = (k/g) t, h and g the distances of the turning
    point from the two poles, the sum is arctan2(t (l g + k h), g h - k l t^2). The pole that
    can be met here has distance h and l = pole_rate sqrt(h).
    """
    start, gaps, upper = nutation.start, nutation.gaps, place.upper
    meets = np.where(upper, gaps.upper_pole, gaps.lower_pole)
    away = np.where(upper, nutation.height, nutation.depth)
    pole_rate = np.where(upper, _upper_pole_rate(nutation), _lower_pole_rate(nutation))
    other = np.where(upper, start.b_plus_a, start.b_minus_a)
    climb = np.where(upper, gaps.upper, -gaps.lower)  # ur - u(0)
    root = np.sqrt(meets)

    b_minus_au = _sum_or(
        pole_rate * away, other * root, start.phi_rate * start.sine2, -start.a * climb, root
    )
    a_minus_bu = _sum_or(
        np.where(upper, -1, 1) * pole_rate * away,
        np.where(upper, 1, -1) * other * root,
        start.sine2 * (start.a - start.phi_rate * start.cosine),
        -start.b * climb,
        root,
    )
    y = place.sn * np.where(upper, place.dn, 1.0)
    x = 2 * nutation.rate * place.cn * np.where(upper, 1.0, place.dn)
    straight, crossed = away * root * x**2, pole_rate * other * y**2
    side = _side_of_pole(nutation, place)
    both = _has_upper_arc(nutation)
    sigma_y = np.where(upper, other, side * pole_rate) * y
    sigma = np.arctan2(sigma_y, np.where(upper, away, side * root) * x)
    return Turned(
        np.where(both, np.arctan2(side * b_minus_au * x * y, side * (straight - crossed)), sigma),
        np.where(both, np.arctan2(side * a_minus_bu * x * y, side * (straight + crossed)), sigma),
    )


def _sum_or(
    one: FloatArray, two: FloatArray, three: FloatArray, four: FloatArray, root: FloatArray
) -> FloatArray:
    """Sum one + two, or 2 (three + four)/root, equal to it: whichever cancels less."""
    open_ = root > 0
    factor = 2 / np.where(open_, root, 1.0)
    better = factor * (np.abs(three) + np.abs(four)) < np.abs(one) + np.abs(two)
    return np.where(open_ & better, factor * (three + four), one + two)


def _lower_pole_rate(nutation: Nutation) -> FloatArray:
    """(a + b)/sqrt(1 + u1), which stays finite as the axis comes to pass the lower pole."""
    start, gaps = nutation.start, nutation.gaps
    size = np.sqrt(nutation.height * (2 * start.beta + gaps.outer))
    return size * np.where(nutation.crosses_lower_pole, 1.0, np.sign(start.b_plus_a))


def _upper_pole_rate(nutation: Nutation) -> FloatArray:
    """(b - a)/sqrt(1 - u2), which stays finite as the axis comes to pass the upper pole."""
    size = np.sqrt(nutation.depth * nutation.gaps.outer)
    sense = np.sign(nutation.start.b_minus_a)
    return size * np.where(nutation.crosses_upper_pole, 1.0, sense)


def _side_of_pole(nutation: Nutation, place: Place) -> FloatArray:
    """Sense of the half turn at this passage over a pole; 1 for those that miss it."""
    quarter = np.mod(place.count, 4).astype(int)
    lower = np.where(nutation.crosses_lower_pole, _COSINE[quarter], 1.0)
    upper = np.where(nutation.crosses_upper_pole, _SINE[quarter], 1.0)
    return np.where(place.upper, upper, lower)


class _Third(NamedTuple):
    """The integral (first sn RF + third sn^3 RJ) of cn^2, dn^2, 1, with cn^2 + shape sn^2."""

    first: FloatArray
    third: FloatArray
    shape: FloatArray


def _sigma_integral(nutation: Nutation) -> _Third:
    """The regular integral of sigma, the same from either turning point."""
    start = nutation.start
    third = start.b_plus_a * start.beta / (24 * nutation.rate**3)
    stiffness = 4 * nutation.rate**2
    return _Third(0.0 * third, third, 1 + start.beta * nutation.gaps.lower_pole / stiffness)


def _delta_integral(nutation: Nutation, upper: NDArray[np.bool_]) -> _Third:
    """The regular integral of delta; without an arc tangent, all of delta by Legendre's form."""
    start, gaps, rate = nutation.start, nutation.gaps, nutation.rate
    arc = _has_upper_arc(nutation)
    high, low = np.where(arc, 1.0, gaps.upper_pole), np.where(arc, 1.0, nutation.depth)
    drop = np.where(upper, high, low)  # 1 - u at the turning point
    pace = start.b_minus_a / (2 * rate)
    slope = nutation.swing * np.where(upper, -nutation.complement, 1.0) / drop
    shape = np.where(upper, nutation.complement * low, high) / drop
    return _Third(
        np.where(arc, 0.0, pace / drop),
        np.where(arc, -pace * start.beta / (12 * rate**2), pace * slope / (3 * drop)),
        np.where(arc, gaps.outer / (4 * rate**2), shape),
    )


def _partial_integrals(nutation: Nutation, place: Place) -> Turned:
    """Integrals of phi and psi since the turning point."""
    sn, cn2, dn2 = place.sn, place.cn**2, place.dn**2
    first_kind = sn * elliprf(cn2, dn2, 1.0)
    sigma, delta = (
        x.first * first_kind + x.third * sn**3 * elliprj(cn2, dn2, 1.0, cn2 + x.shape * sn**2)
        for x in (_sigma_integral(nutation), _delta_integral(nutation, place.upper))
    )
    return Turned(sigma + delta, sigma - delta)


def _complete_integrals(nutation: Nutation) -> Turned:
    """Integrals of phi and psi from one turning point to the next."""
    returns = nutation.complement > 0
    complement = np.where(returns, nutation.complement, 1.0)
    first_kind = ellipkm1(complement)
    sigma, delta = (
        np.where(returns, x.first * first_kind + x.third * elliprj(0.0, complement, 1.0, shape), 0)
        for x in (_sigma_integral(nutation), _delta_integral(nutation, np.asarray(False)))
        for shape in (np.where(x.shape > 0, x.shape, 1.0),)  # 0 where nothing moves
    )
    return Turned(sigma + delta, sigma - delta)

"""Heavy symmetric top, its initial state, and the cubic of its nutation (I.7.1 to I.7.16).

The pivot is the origin. The Euler angles are those of I.7.1: rotations by psi about the body's
axis, by theta about the line of nodes, and by phi about the vertical,

    R = Rz(phi) Rx(theta) Rz(psi),    body to inertial.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, NamedTuple

import numpy as np

from earthspin.errors import BodyError
from earthspin.numerics.arrays import BoolArray, FloatArray
from earthspin.numerics.double_double import as_double_double, where

_NAME = "heavy top"
#: Largest rate, rad/s; larger ones would overflow.
_FASTEST = 1e100
#: Inclinations below this count as zero; their fourth powers would underflow.
_UPRIGHT = 1e-60


@dataclass(frozen=True, eq=False, kw_only=True)
class HeavyTop:
    """A symmetric top: its moments of inertia, its weight moment, and its motion at t = 0.

    Each field is a number or an array; the fields broadcast together. A top with arrays is a batch
    of tops.

    Attributes
    ----------
    transverse_moment : ndarray
        I1 = I2, moment about an axis through the pivot perpendicular to the figure axis, kg m2.
    axial_moment : ndarray
        I3, about the figure axis, kg m2; at most 2 I1.
    weight_moment : ndarray
        m g r, weight times the distance from pivot to centre of mass along the figure axis,
        N m. Zero for a free rotor; negative if the centre of mass is below the pivot at theta = 0.
    theta : ndarray
        Angle from the vertical to the figure axis, from 0 to pi, rad. The float nearest to pi
        counts as pi, and values below 1e-60 as zero.
    theta_rate, phi_rate : ndarray
        rad/s. For a vertical axis phi_rate does not affect the motion of the body; it only divides
        the rotation between phi and psi.
    spin : ndarray
        omega3, component of the angular velocity along the figure axis, rad/s; constant.
    phi, psi : ndarray
        rad.
    """

    transverse_moment: Any
    axial_moment: Any
    weight_moment: Any
    theta: Any
    spin: Any
    phi_rate: Any = 0.0
    theta_rate: Any = 0.0
    phi: Any = 0.0
    psi: Any = 0.0

    def __post_init__(self) -> None:
        names = [field.name for field in fields(self)]
        arrays = [np.asarray(getattr(self, name), dtype=np.float64) for name in names]
        for name, value in zip(names, arrays, strict=True):
            _require(np.isfinite(value), name, value, "give a finite number")
        for name, value in zip(names, _broadcast(names, arrays), strict=True):
            array = value.copy()
            array.flags.writeable = False
            object.__setattr__(self, name, array)
        self._check()

    @property
    def shape(self) -> tuple[int, ...]:
        """Array shape of the fields (one element per top); empty for one top."""
        return np.shape(self.theta)

    def _check(self) -> None:
        i1, i3 = self.transverse_moment, self.axial_moment
        _require(i1 > 0, "transverse_moment", i1, "give a positive number of kg m2")
        _require(i3 > 0, "axial_moment", i3, "give a positive number of kg m2")
        most = "no body has more than twice its transverse moment about the pivot"
        _require(i3 / 2 * (1 - 1e-14) <= i1, "axial_moment", i3, most)
        for name in ("theta_rate", "phi_rate", "spin"):
            rate = getattr(self, name)
            _require(np.abs(rate) <= _FASTEST, name, rate, f"give at most {_FASTEST:g} rad/s")
        weight = self.weight_moment
        slow = np.abs(weight) / _FASTEST / _FASTEST <= i1  # in this order nothing overflows
        _require(slow, "weight_moment", weight, "its transverse moment is too small for it")
        upright_to_hanging = (self.theta >= 0) & (self.theta <= np.pi)
        _require(upright_to_hanging, "theta", self.theta, "give an angle from 0 to pi rad")


class TopConstants(NamedTuple):
    """Constants a, b, alpha and beta of a top's motion, as in I.7.7 and I.7.14.

    Attributes
    ----------
    a : ndarray
        (L . z')/I1 = I3 omega3/I1, along the figure axis, rad/s.
    b : ndarray
        (L . z)/I1, along the vertical, rad/s.
    alpha : ndarray
        2 E'/I1, where E' is the energy less that of the spin, rad2/s2.
    beta : ndarray
        2 m g r/I1, rad2/s2.
    """

    a: FloatArray
    b: FloatArray
    alpha: FloatArray
    beta: FloatArray


def top_constants(top: HeavyTop) -> TopConstants:
    """Compute the constants of a top's motion: a, b, alpha and beta of I.7.7 and I.7.14.

    The last rows of the source's table I.7.20 have a and b exchanged: the vertical component
    of the angular momentum is b I1, the axial one a I1.
    """
    heights = axis_heights(top.theta)
    sine2 = heights.below * heights.above
    a = top.axial_moment * top.spin / top.transverse_moment
    beta = 2 * top.weight_moment / top.transverse_moment
    b = top.phi_rate * sine2 + a * heights.cosine
    alpha = top.theta_rate**2 + top.phi_rate**2 * sine2 + beta * heights.cosine
    return TopConstants(a, b, alpha, beta)


class AxisHeights(NamedTuple):
    """Height cos(theta) of the axis, and its distances 1 - cos and 1 + cos from the poles.

    Attributes
    ----------
    below : ndarray
        1 - cos(theta), depth below the upper pole, to full relative accuracy.
    above : ndarray
        1 + cos(theta), height above the lower pole, to full relative accuracy.
    cosine : ndarray
        cos(theta).
    """

    below: FloatArray
    above: FloatArray
    cosine: FloatArray


def axis_heights(theta: FloatArray) -> AxisHeights:
    """Compute cos(theta), 1 - cos(theta) and 1 + cos(theta) without cancellation."""
    below = np.where(theta < _UPRIGHT, 0.0, 2 * np.sin(theta / 2) ** 2)
    # No float equals pi; the nearest one denotes a hanging top.
    above = np.where(theta == np.pi, 0.0, 2 * np.cos(theta / 2) ** 2)
    return AxisHeights(below, above, np.cos(theta))


def _over_power_of_two(first: FloatArray, *others: FloatArray) -> list[FloatArray]:
    """Numbers over the power of two that takes the first to 0.5 to 1, without rounding."""
    exponent = -np.frexp(first)[1]
    return [np.ldexp(number, exponent) for number in (first, *others)]


def _broadcast(names: list[str], values: list[FloatArray]) -> list[FloatArray]:
    """Broadcast all fields of a top to one array shape; raise an error if they do not fit."""
    try:
        return list(np.broadcast_arrays(*values))
    except ValueError:
        shapes = ", ".join(f"{n} {v.shape}" for n, v in zip(names, values, strict=True) if v.ndim)
        raise BodyError(_NAME, "shapes", shapes, "give arrays that broadcast together") from None


def _require(holds: Any, field: str, value: Any, allowed: str) -> None:
    """Raise an error if `holds` is False for any value of a field."""
    holds, value = np.broadcast_arrays(holds, value)
    if not np.all(holds):
        raise BodyError(_NAME, field, float(value[~holds].flat[0]), allowed)


# --- cubic of the nutation ------------------------------------------------------------------------
# In u = cos(theta),
#
#     u'^2 = (1 - u^2)(alpha - beta u) - (b - a u)^2 = beta (u - u1)(u - u2)(u - u3)
#
# For slow nutation, a sleeping top and a fast top, two or three roots are nearly equal, and a
# general root finder loses half or two thirds of the digits. But the signs are known: the cubic is
# not positive at either pole and not negative at the start,
#
#     -1 <= u1 <= u(0) <= u2 <= 1 <= u3        (beta >= 0),
#
# so that every difference of roots is a sum of non-negative gaps between these six points, and the
# gaps are computed. One root is well separated from the other two. After it is divided out, the
# pair straddles either the start or the upper pole, and the quadratic for the two gaps on either
# side has a discriminant that is a sum of squares.

#: A top slower than the first number (rad/s) is at rest; theta' or a pendulum's rate below the
#: second number times the fastest rate counts as zero, to avoid underflow.
_SLOWEST, _NEGLIGIBLE = 1e-100, 1e-60


class AxisStart(NamedTuple):
    """Initial state of a top's axis, or of the opposite end for a negative weight moment.

    A top with a negative weight moment is described by the opposite end of its axis: theta is
    replaced by pi - theta, and spin and weight change sign. Rates are in units of `rate_unit`.

    Attributes
    ----------
    turned : ndarray of bool
        Whether the opposite end is used.
    rate_unit : ndarray
        A power of two near the fastest rate, rad/s, to avoid overflow.
    below, above, cosine : ndarray
        1 - u, 1 + u and u at the start.
    theta_rate, phi_rate, a, beta : ndarray
        In units of `rate_unit`, or its square.
    lag, stability : ndarray
        a - 2 phi' and a^2 - 2 beta, without cancellation; both are nearly zero near the critical
        spin of a sleeping top, which is stable for a^2 > 2 beta.
    """

    turned: BoolArray
    rate_unit: FloatArray
    below: FloatArray
    above: FloatArray
    cosine: FloatArray
    theta_rate: FloatArray
    phi_rate: FloatArray
    a: FloatArray
    beta: FloatArray
    lag: FloatArray
    stability: FloatArray

    @property
    def sine2(self) -> FloatArray:
        """Squared sine of the initial inclination, sin^2(theta)."""
        return self.below * self.above

    @property
    def rate2(self) -> FloatArray:
        """Squared initial speed of the tip of the axis, theta'^2 + phi'^2 sin^2(theta)."""
        return self.theta_rate**2 + self.phi_rate**2 * self.sine2

    @property
    def asleep(self) -> BoolArray:
        """Return True if the axis is vertical and not moving, whether stable or not."""
        return np.asarray((self.sine2 == 0) & (self.theta_rate == 0))

    @property
    def b_minus_a(self) -> FloatArray:
        """Difference b - a of vertical and axial angular momentum, divided by I1."""
        upright = -self.lag - self.phi_rate * self.below
        return self.below * np.where(self.below < 1, upright, self.phi_rate * self.above - self.a)

    @property
    def b_plus_a(self) -> FloatArray:
        """Sum b + a of vertical and axial angular momentum, divided by I1."""
        return self.above * (self.phi_rate * self.below + self.a)

    @property
    def b(self) -> FloatArray:
        """Vertical component of the angular momentum, divided by I1."""
        return self.phi_rate * self.sine2 + self.a * self.cosine


class Gaps(NamedTuple):
    """Distances along u = cos(theta) between the poles, the cubic's roots and the start.

    No distance is negative.

    Attributes
    ----------
    lower_pole : ndarray
        1 + u1.
    lower : ndarray
        u(0) - u1.
    upper : ndarray
        u2 - u(0).
    upper_pole : ndarray
        1 - u2.
    outer : ndarray
        beta (u3 - 1); finite even without weight, for which u3 is infinite.
    """

    lower_pole: FloatArray
    lower: FloatArray
    upper: FloatArray
    upper_pole: FloatArray
    outer: FloatArray


def axis_start(top: HeavyTop) -> AxisStart:
    """Compute the initial state of a top's axis; its opposite end if weight moment < 0."""
    below, above, cosine = axis_heights(top.theta)
    # the same power of two for all moments, so that no product overflows
    one, axial, weight = _over_power_of_two(
        top.transverse_moment, top.axial_moment, 2 * top.weight_moment
    )
    rates = [top.theta_rate, top.phi_rate * np.sqrt(below * above), axial / one * top.spin]
    fastest = np.max(np.abs([*rates, np.sqrt(np.abs(weight / one))]), axis=0)
    still = fastest < _SLOWEST
    unit = np.ldexp(1.0, np.frexp(np.where(still, 1.0, fastest))[1])
    theta_rate, phi_rate = top.theta_rate / unit, np.where(still, 0.0, top.phi_rate / unit)
    inverted = np.asarray(weight < 0)
    sign = np.where(inverted, -1.0, 1.0)
    a = as_double_double(np.where(still, 0.0, sign * top.spin / unit)) * axial / one
    beta = as_double_double(np.abs(weight) / unit / unit) / one
    beta = where(still | (beta.hi < _NEGLIGIBLE**2), 0.0, beta)
    return AxisStart(
        turned=inverted,
        rate_unit=unit,
        below=np.where(inverted, above, below),
        above=np.where(inverted, below, above),
        cosine=sign * cosine,
        theta_rate=np.where(np.abs(theta_rate) < _NEGLIGIBLE, 0.0, sign * theta_rate),
        phi_rate=phi_rate,
        a=np.asarray(a.hi),
        beta=np.asarray(beta.hi),
        lag=np.asarray((a - 2 * phi_rate).hi),
        stability=np.asarray((a * a - beta.scaled(2.0)).hi),
    )


def cubic_gaps(start: AxisStart) -> Gaps:
    """Compute distances between the cubic's roots, the poles and the start (I.7.16)."""
    # Expanded about the start, u = u(0) + x, and times beta^2 with X = beta x:
    # X^3 + c2 X^2 + beta c1 X + beta^2 c0.
    beta = start.beta
    c2 = -(start.rate2 + start.stability + 2 * beta * start.below)
    # Near the critical spin, with a^2 = 2 beta and phi' = a/2, the first form would cancel.
    pull = _smaller_terms(
        (2 * start.phi_rate * (start.a - start.cosine * start.phi_rate), -beta),
        (start.stability / 2, -(start.lag**2) / 2, 2 * start.phi_rate**2 * start.below),
    )
    c1 = start.sine2 * pull - 2 * start.cosine * start.theta_rate**2
    c0 = start.sine2 * start.theta_rate**2
    centre = -c2 / 3
    # At the mean of the roots the cubic is negative if the lower two are closer together.
    outer_apart = ((centre + c2) * centre + beta * c1) * centre + beta**2 * c0 <= 0
    from_start = _pair_about_start(start, c0, c1, c2, outer_apart)
    from_pole = _pair_about_pole(start, c0, ~outer_apart)
    lower, upper, upper_pole, outer = (
        np.where(outer_apart, x, y) for x, y in zip(from_start, from_pole, strict=True)
    )
    # The cubic at the lower pole is -(b + a)^2: the product of the gaps there.
    near_pole = _ratio(start.b_plus_a**2, (start.above + upper) * (2 * beta + outer))
    lower_pole = np.where(lower <= 0.75 * start.above, start.above - lower, near_pole)
    return Gaps(lower_pole, lower, upper, upper_pole, outer)


def _pair_about_start(
    start: AxisStart, c0: FloatArray, c1: FloatArray, c2: FloatArray, wanted: BoolArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Distances between roots, start and poles, if the two lower roots are close together.

    The start lies between u1 and u2.
    """
    beta, below = start.beta, start.below
    scaled_root = _largest_root(c2, beta * c1, beta**2 * c0, wanted)  # beta (u3 - u(0))
    product = _ratio(c0, scaled_root)
    lower, upper = _straddling(-_ratio(c1 + beta * product, scaled_root), product)
    # The cubic at the upper pole is -(b - a)^2, the product of the gaps there. It gives the gap
    # that is inaccurate from the start; the two are never both small compared with 1 - u(0).
    accurate = upper <= 0.75 * below
    at_pole = _ratio(start.b_minus_a**2, below + lower)
    closely = accurate & (scaled_root < 2 * beta * below)
    outer = np.where(closely, _ratio(at_pole, below - upper), scaled_root - beta * below)
    upper_pole = np.where(accurate, below - upper, _ratio(at_pole, outer))
    return lower, upper, upper_pole, outer


def _pair_about_pole(
    start: AxisStart, c0: FloatArray, wanted: BoolArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Distances between roots, start and poles, if the two upper roots are close together.

    The upper pole lies between u2 and u3.
    """
    beta, below = start.beta, start.below
    # Expanded about the pole, u = 1 - p, and times beta^2 with P = beta p:
    # P^3 - d2 P^2 - 2 beta d1 P + beta^2 (b - a)^2.
    d2 = beta * below - start.stability - start.rate2
    pace = start.phi_rate * (start.a - start.phi_rate)
    tilt = _smaller_terms(
        (-start.above * pace, start.a**2 - beta),
        (start.stability / 2, start.lag**2 / 2, below * pace),
    )
    d1 = start.theta_rate**2 + below * tilt
    d0 = start.b_minus_a**2
    scaled_root = _largest_root(-d2, -2 * beta * d1, beta**2 * d0, wanted)  # beta (1 - u1)
    depth = _ratio(scaled_root, beta)
    product = _ratio(d0, scaled_root)
    outer, upper_pole = _straddling(_ratio(2 * d1 - beta * product, scaled_root), product)
    outer = beta * outer
    # The cubic at the start is sin^2 theta'^2: the product of the gaps there.
    third = beta * below + outer
    lower = np.where(depth >= 1.5 * below, depth - below, 0.0)
    upper = np.where(upper_pole <= 0.75 * below, below - upper_pole, _ratio(c0, lower * third))
    lower = np.where(depth >= 1.5 * below, lower, _ratio(c0, upper * third))
    return lower, upper, upper_pole, outer


def _smaller_terms(*sums: tuple[FloatArray, ...]) -> FloatArray:
    """Return that of two equal sums which has the smaller terms, and so the smaller rounding."""
    first, second = (np.sum(np.abs(terms), axis=0) for terms in sums)
    return np.asarray(np.where(first < second, np.sum(sums[0], axis=0), np.sum(sums[1], axis=0)))


def _largest_root(c2: FloatArray, c1: FloatArray, c0: FloatArray, wanted: BoolArray) -> FloatArray:
    """Return the largest root of x^3 + c2 x^2 + c1 x + c0 by Newton's method; 0 if not `wanted`.

    Newton's method converges monotonically from above.
    """
    centre = -c2 / 3
    spread = np.sqrt(np.maximum(centre**2 - c1 / 3, 0.0))
    x = centre + 2 * spread
    wanted = wanted & (x > 0)
    x = np.where(wanted, x, 0.0)
    for _ in range(6):  # from at most 16 % above, quadratically
        slope = (3 * x + 2 * c2) * x + c1
        value = ((x + c2) * x + c1) * x + c0
        x = x - np.where(wanted, _ratio(value, slope), 0.0)
    return x


def _straddling(middle: FloatArray, product: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the non-negative g and h for which g - h = middle and g h = product."""
    larger = (np.hypot(middle, 2 * np.sqrt(product)) + np.abs(middle)) / 2
    smaller = _ratio(product, larger)
    return np.where(middle > 0, larger, smaller), np.where(middle > 0, smaller, larger)


def _ratio(numerator: FloatArray, denominator: FloatArray) -> FloatArray:
    """Quotient of two arrays; 0 where the denominator is 0."""
    empty = denominator == 0
    return np.where(empty, 0.0, numerator / np.where(empty, 1.0, denominator))

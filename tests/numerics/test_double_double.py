"""Double-double numbers against exact fractions and against mpmath."""

from fractions import Fraction

import mpmath as mp
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from earthspin.numerics.double_double import (
    TWO_PI,
    DoubleDouble,
    as_double_double,
    stack,
    two_product,
    two_sum,
    where,
)

#: Relative error of one operation; the bounds of Joldes et al. 2017 are 3 to 10 times 2^-106.
ONE_OPERATION = Fraction(12, 2**106)

numbers = st.floats(1e-60, 1e60) | st.floats(-1e60, -1e-60)


def exact(number: DoubleDouble) -> Fraction:
    return Fraction(float(number.hi)) + Fraction(float(number.lo))


@st.composite
def double_doubles(draw: st.DrawFn) -> DoubleDouble:
    high = draw(numbers)
    return DoubleDouble(*two_sum(high, high * draw(st.floats(-1e-16, 1e-16))))


@given(numbers, numbers)
def test_the_rest_of_a_sum_and_of_a_product_is_exact(a: float, b: float) -> None:
    total, rest = two_sum(a, b)
    assert Fraction(total) + Fraction(rest) == Fraction(a) + Fraction(b)
    product, rest = two_product(a, b)
    assert Fraction(product) + Fraction(rest) == Fraction(a) * Fraction(b)


@given(double_doubles(), double_doubles())
def test_each_operation_is_good_to_32_digits(x: DoubleDouble, y: DoubleDouble) -> None:
    a, b = exact(x), exact(y)
    for found, wanted in ((x * y, a * b), (x / y, a / b)):
        assert abs(exact(found) - wanted) <= ONE_OPERATION * abs(wanted)
        assert found.hi == float(wanted) or abs(found.lo) <= np.spacing(abs(found.hi))
    for found, wanted in ((x + y, a + b), (x - y, a - b)):
        # A sum of opposite numbers is as good as its terms, not as itself.
        assert abs(exact(found) - wanted) <= ONE_OPERATION * max(abs(a), abs(b))


@given(double_doubles())
def test_square_root(x: DoubleDouble) -> None:
    assume(x.hi > 0)
    root = exact(x.sqrt())
    assert abs(root * root - exact(x)) <= 2 * ONE_OPERATION * exact(x)


def test_square_root_of_zero_is_zero() -> None:
    root = as_double_double(np.array([0.0, 4.0])).sqrt()
    assert root.hi.tolist() == [0.0, 2.0]
    assert root.lo.tolist() == [0.0, 0.0]


def test_arrays_and_floats_mix_from_either_side() -> None:
    x, array = as_double_double(np.array([1.0, 2.0])), np.array([3.0, 5.0])
    for found, wanted in (
        (array + x, [4.0, 7.0]),
        (array - x, [2.0, 3.0]),
        (array * x, [3.0, 10.0]),
        (1.0 - x, [0.0, -1.0]),
        (x.scaled(0.5), [0.5, 1.0]),
        (-x, [-1.0, -2.0]),
        (where(array > 4, x, 7.0), [7.0, 2.0]),
        (stack(x[..., 0], x[..., 1]), [1.0, 2.0]),
    ):
        assert isinstance(found, DoubleDouble)
        assert found.hi.tolist() == wanted


def test_two_pi_has_32_digits() -> None:
    with mp.workdps(50):
        assert abs(mp.mpf(TWO_PI.hi) + mp.mpf(TWO_PI.lo) - 2 * mp.pi) < mp.mpf(10) ** -31


def test_it_cannot_be_changed() -> None:
    with pytest.raises(AttributeError):
        TWO_PI.hi = 6.0  # type: ignore[misc]

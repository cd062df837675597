"""Principal moments: digits kept, impossible bodies refused."""

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from earthspin.errors import BodyError
from earthspin.rotor.euler import principal_moments


def exact(number: Any) -> list[Fraction]:
    return [
        Fraction(float(h)) + Fraction(float(low))
        for h, low in zip(number.hi, number.lo, strict=True)
    ]


@given(st.floats(0.6, 1.0), st.floats(0.6, 1.0), st.floats(0.6, 1.0))
def test_three_numbers_keep_every_digit_of_their_differences(a: float, b: float, c: float) -> None:
    body = principal_moments([a, b, c])
    a_, b_, c_ = map(Fraction, (a, b, c))
    assert exact(body.moment) == [a_, b_, c_]
    assert exact(body.difference) == [c_ - b_, a_ - c_, b_ - a_]


@given(st.floats(-1e-3, 1e-3), st.floats(-1e-3, 1e-3))
def test_differences_are_kept_as_given(b_a: float, c_a: float) -> None:
    body = principal_moments({"A": 8.0101e37, "B-A": b_a * 8e37, "C-A": c_a * 8e37})
    c_b = float(Fraction(c_a * 8e37) - Fraction(b_a * 8e37))
    assert body.difference.hi.tolist() == [c_b, -c_a * 8e37, b_a * 8e37]
    # C itself to 32 digits: A and C - A are both whole in it.
    wanted = Fraction(8.0101e37) + Fraction(c_a * 8e37)
    assert abs(exact(body.moment)[2] - wanted) <= wanted / 2**104
    assert body.values[1] == float(Fraction(8.0101e37) + Fraction(b_a * 8e37))


def test_what_was_read_is_not_read_again() -> None:
    body = principal_moments([1.0, 2.0, 2.5])
    assert principal_moments(body) is body
    assert body.values.tolist() == [1.0, 2.0, 2.5]


def test_many_bodies() -> None:
    body = principal_moments({"A": 1.0, "B-A": np.array([0.0, 0.1]), "C-A": 0.5})
    assert body.values.tolist() == [[1.0, 1.0, 1.5], [1.0, 1.1, 1.5]]
    assert principal_moments(np.ones((4, 5, 3))).values.shape == (4, 5, 3)


def test_a_leaf_is_a_body_in_spite_of_rounding() -> None:
    third = 0.1 + 0.2  # one unit in the last place above 0.3
    assert third == principal_moments([0.1, 0.2, third]).values[2]
    assert principal_moments({"A": 1.0, "B-A": 0.0, "C-A": 1.0}).values[2] == 2.0


@pytest.mark.parametrize(
    ("given_moments", "words"),
    [
        ([1.0, 2.0, 3.1], ["C = 3.1", "1 + 2"]),
        ([3.1, 2.0, 1.0], ["A = 3.1", "2 + 1"]),
        ([[1.0, 1.0, 1.0], [1.0, 5.0, 1.0]], ["B = 5.0", "1 + 1"]),
        ([1.0, 2.0, -1.0], ["C = -1.0", "must be positive"]),
        ([0.0, 1.0, 1.0], ["A = 0.0", "must be positive"]),
        ({"A": 1.0, "B-A": -2.0, "C-A": 0.0}, ["B = -1.0", "must be positive"]),
        ({"A": 1.0, "B-A": 0.0, "C-A": 1.1}, ["C = 2.1", "1 + 1"]),
        ([1.0, 1.0, np.nan], ["moments = nan", "finite"]),
        ({"A": 1.0, "B-A": np.inf, "C-A": 0.0}, ["B-A = inf", "finite"]),
        ({"A": 1.0, "B": 1.0}, ["['A', 'B']", "A, B-A, C-A"]),
        ([1.0, 2.0], ["shape of moments = (2,)", "three numbers"]),
        (1.0, ["shape of moments = ()", "three numbers"]),
        (["1", "2", "x"], ["'x'", "give numbers"]),
        ({"A": np.ones(2), "B-A": np.zeros(3), "C-A": 0.0}, ["(2,), (3,)", "broadcast together"]),
    ],
)
def test_an_impossible_body_is_named(given_moments: Any, words: list[str]) -> None:
    with pytest.raises(BodyError) as caught:
        principal_moments(given_moments)
    message = str(caught.value)
    assert "\n" not in message
    for word in words:
        assert word in message

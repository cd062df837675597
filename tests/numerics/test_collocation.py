"""Linear equations carried by collocation, beside closed forms."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm
from scipy.special import iv, kv

from earthspin import UndefinedError
from earthspin.numerics.polynomials import carry


@given(st.floats(0.1, 3.0), st.integers(0, 50))
def test_constant_coefficients(length: float, seed: int) -> None:
    matrix = np.random.default_rng(seed).standard_normal((3, 3))
    found = carry(lambda r: np.broadcast_to(matrix, (r.size, 3, 3)), 1.0, 1.0 + length, np.eye(3))
    expected = expm(matrix * length)
    assert np.allclose(found, expected, rtol=0, atol=2e-12 * np.max(abs(expected)))


@given(st.floats(1e-3, 0.3))
def test_towards_a_centre(start: float) -> None:
    """r2 y'' + r y' - (r2 + 4) y = 0: modified Bessel functions of order two."""

    def matrix(r: np.ndarray) -> np.ndarray:
        zero, one = np.zeros_like(r), np.ones_like(r)
        return np.moveaxis(np.array([[zero, one], [1 + 4 / r**2, -1 / r]]), -1, 0)

    def basis(r: float) -> np.ndarray:
        slopes = [(f(1, r) + s * f(3, r)) / 2 * s for f, s in ((iv, 1.0),)]
        slopes.append(-(kv(1, r) + kv(3, r)) / 2)
        return np.array([[iv(2, r), kv(2, r)], slopes])

    found = carry(matrix, start, 1.0, np.eye(2))
    expected = basis(1.0) @ np.linalg.inv(basis(start))
    assert np.allclose(found, expected, rtol=2e-10, atol=1e-12 * np.max(abs(expected)))
    regular = carry(matrix, start, 1.0, basis(start)[:, :1])
    # the other solution falls off by up to eleven powers of ten, and takes no digits with it
    assert np.allclose(regular, basis(1.0)[:, :1], rtol=5e-14, atol=0)


def test_many_at_once() -> None:
    rates = np.array([1.0, 2.0 + 1j])
    found = carry(
        lambda r: rates[:, None, None, None] * np.ones((1, r.size, 1, 1)), 1.0, 2.0, np.eye(1)
    )
    assert np.allclose(found[:, 0, 0], np.exp(rates), rtol=1e-13, atol=0)


def test_what_never_settles_is_refused() -> None:
    with pytest.raises(UndefinedError, match="too soft"):
        carry(lambda r: 1e5 * np.sin(1e5 * r)[:, None, None], 1.0, 2.0, np.eye(1))


def test_solutions_that_stand_for_their_combinations() -> None:
    """Rounding adds of the one that grows by seven powers to the one that grows by one."""
    mix = np.array([[2.0, 1.0, 0.5], [1.0, 3.0, 1.0], [0.3, -1.0, 1.0]])
    law = mix @ np.diag([1.0, 7.0, -3.0]) @ np.linalg.inv(mix)

    def matrix(r: np.ndarray) -> np.ndarray:
        return law / r[:, None, None]

    two = mix[:, :2]
    with pytest.raises(UndefinedError, match="does not converge"):
        carry(matrix, 1e-3, 1.0, two)
    found = carry(matrix, 1e-3, 1.0, two, together=True)
    found = found / np.linalg.norm(found, axis=0)
    left = two - found @ np.linalg.lstsq(found, two, rcond=None)[0]
    assert np.max(abs(left)) < 1e-11

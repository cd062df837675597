"""Quantiles and shares of variance, against numpy and against what is known in closed form."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from earthspin.numerics.sampling import quantiles, shares_of_variance


@given(
    st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=30),
    st.lists(st.floats(0, 1), min_size=1, max_size=4),
)
def test_quantiles_are_numpys(samples: list[float], shares: list[float]) -> None:
    values = np.array(samples)
    found = quantiles(np.stack([values, -values], axis=1), np.array(shares))
    expected = np.quantile(np.stack([values, -values], axis=1), shares, axis=0)
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-9)


def test_infinite_samples_stay_what_they_are() -> None:
    both = np.array([[np.inf, 1.0], [np.inf, 2.0], [np.inf, np.inf]])
    found = quantiles(both, np.array([0.0, 0.5, 1.0]))
    assert np.array_equal(found, [[np.inf, 1.0], [np.inf, 2.0], [np.inf, np.inf]])


def test_shares_of_a_line_are_its_slopes_squared() -> None:
    rng = np.random.default_rng(5)
    x = rng.standard_normal((20_000, 3)) * [1.0, 2.0, 1e-9]
    y = 5 + 3 * x[:, 0] - 0.5 * x[:, 1]
    told = shares_of_variance(x, np.stack([y, np.full(len(y), 7.0)], axis=1))
    np.testing.assert_allclose(told.slope[:, 0], [3, -0.5, 0], rtol=1e-9, atol=1e-4)
    np.testing.assert_allclose(told.share[:, 0], [0.9, 0.1, 0], rtol=0.06, atol=1e-3)
    assert told.unexplained[0] == pytest.approx(0, abs=1e-12)
    assert np.array_equal(told.share[:, 1], [0, 0, 0])  # what does not vary
    assert told.unexplained[1] == 0


def test_what_lines_do_not_explain_is_the_rest() -> None:
    x = np.random.default_rng(6).uniform(-1, 1, (20_000, 1))
    told = shares_of_variance(x, x[:, 0] + x[:, 0] ** 2)
    # variances 1/3 and 1/5 - 1/9
    assert float(told.share[0]) == pytest.approx((1 / 3) / (1 / 3 + 4 / 45), abs=0.01)
    assert float(told.share.sum() + told.unexplained) == pytest.approx(1, abs=1e-12)


def test_shares_of_correlated_inputs_add_up() -> None:
    a, b = np.random.default_rng(7).standard_normal((2, 5000))
    x = np.stack([a, 0.8 * a + 0.6 * b, np.zeros(5000)], axis=1)
    told = shares_of_variance(x, x[:, 0] + x[:, 1])
    assert float(told.share.sum()) == pytest.approx(1, abs=1e-12)
    assert told.slope[2] == 0
    np.testing.assert_allclose(told.slope[:2], 1, rtol=1e-12, atol=0)

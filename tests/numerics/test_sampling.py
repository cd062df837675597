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


def test_the_share_of_a_class_is_eta_squared() -> None:
    """Variance between the means of the classes over the whole variance, whatever their order."""
    rng = np.random.default_rng(8)
    labels = rng.choice(["b", "a", "c"], 500)
    y = np.select([labels == "a", labels == "b"], [5.0, -1.0], 2.0) + rng.standard_normal(500)
    between = sum((labels == o).mean() * (y[labels == o].mean() - y.mean()) ** 2 for o in "abc")
    told = shares_of_variance(np.empty((500, 0)), y, [labels])
    assert float(told.share[0]) == pytest.approx(between / y.var(), rel=1e-12, abs=0)
    assert float(told.share.sum() + told.unexplained) == pytest.approx(1, abs=1e-12)
    assert np.isnan(told.slope[0])


def test_numbers_and_classes_share_what_a_balanced_grid_gives_each() -> None:
    """Three numbers by two classes: variances 6 of 3 x and 4 of the class, which do not mix."""
    x, labels = np.repeat([-1.0, 0.0, 1.0], 2), np.array(["here", "there"] * 3)
    y = 3 * x + np.where(labels == "here", 2.0, -2.0)
    told = shares_of_variance(x[:, np.newaxis], np.stack([y, np.full(6, 1.0)], axis=1), [labels])
    np.testing.assert_allclose(told.share[:, 0], [0.6, 0.4], rtol=1e-12, atol=0)
    assert told.slope[0, 0] == pytest.approx(3, rel=1e-12, abs=0)
    np.testing.assert_allclose(told.unexplained, 0, rtol=0, atol=1e-12)
    assert np.array_equal(told.share[:, 1], [0, 0])  # what does not vary


def test_one_class_alone_explains_nothing() -> None:
    told = shares_of_variance(np.empty((4, 0)), np.arange(4.0), [np.array(["a"] * 4)])
    assert (float(told.share[0]), float(told.unexplained)) == (0, 1)


@pytest.mark.parametrize("noise", [0.0, 1.0])
def test_a_share_is_within_its_error_of_the_truth(noise: float) -> None:
    """Shares of a known line, from 300 samples of a thousand members."""
    slopes = np.array([1.0, 0.3, 0.02, 0.0])
    truth = slopes**2 / (slopes @ slopes + noise**2)
    inside = []
    for seed in range(300):
        rng = np.random.default_rng(seed)
        x = rng.standard_normal((1000, 4)) * [1e-9, 1.0, 1e6, 1.0]
        x[:, 1] = rng.uniform(-np.sqrt(3), np.sqrt(3), 1000)
        told = shares_of_variance(
            x, x @ (slopes / [1e-9, 1, 1e6, 1]) + noise * rng.normal(size=1000)
        )
        assert np.all(told.share >= 0)
        assert float(told.share.sum() + told.unexplained) == pytest.approx(1, abs=1e-12)
        # rounding errors, where there is no noise
        inside.append(np.abs(told.share - truth) <= told.error + 1e-12)
    coverage = np.mean(inside, axis=0)
    assert np.all(coverage > 0.91), coverage  # 0.95 less three standard errors


def test_the_error_of_a_negligible_share_is_small() -> None:
    """3.7e-4 of the variance, from 1,000 members: chance correlations do not matter."""
    x = np.random.default_rng(9).standard_normal((1000, 2))
    told = shares_of_variance(x, x @ [1.0, np.sqrt(3.7e-4)])
    assert float(told.share[1]) == pytest.approx(3.7e-4, rel=0.2, abs=0)
    assert 3e-5 < float(told.error[1]) < 8e-5


def test_errors_of_the_shares_of_correlated_inputs_and_classes() -> None:
    """Population shares: 1 + 0.6 * 0.5 of x, 0.25 + 0.6 * 0.5 of z, and 1 of the class."""
    inside = []
    for seed in range(200):
        rng = np.random.default_rng(seed)
        a, b = rng.standard_normal((2, 1000))
        x = np.stack([a, 0.6 * a + 0.8 * b], axis=1)
        labels = rng.choice(["u", "v"], 1000)
        told = shares_of_variance(x, x @ [1.0, 0.5] + np.where(labels == "u", 1.0, -1.0), [labels])
        inside.append(np.abs(told.share - np.array([1.3, 0.55, 1.0]) / 2.85) <= told.error)
    assert np.all(np.mean(inside, axis=0) > 0.90)

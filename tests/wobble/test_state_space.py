"""Filter and likelihood against the covariance of all observations, and forecasts against draws."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import binomtest, multivariate_normal

from earthspin.constants import MAS, NORMAL_95
from earthspin.numerics.arrays import FloatArray
from earthspin.sky import eop
from earthspin.wobble import forecast
from earthspin.wobble.forecast import FastExcitation
from earthspin.wobble.state_space import Filter, StateSpace

COUNT = 40


def small() -> StateSpace:
    """A damped rotation and a random walk, with noise unequal in both coordinates."""
    rates = np.diag(np.array([0.3j - 0.05, 0], dtype=complex))
    density = np.diag([1.0, 0.2, 0.5, 0.1])
    density[0, 2] = density[2, 0] = -0.3
    observed = np.array([[1, 1]], dtype=complex)
    return StateSpace.sampled(rates, density, observed, 0.04 * np.eye(2), np.eye(4))


def joint(model: StateSpace, count: int) -> FloatArray:
    """Covariance of so many observations, written out without a filter."""
    states = [model.start]
    for _ in range(count - 1):
        states.append(model.propagated(states[-1]))
    size = len(model.error)
    whole = np.empty((count * size, count * size))
    for i, covariance in enumerate(states):
        for j in range(i, count):
            power = np.linalg.matrix_power(model.transition, j - i)
            block = model.observed @ covariance @ power.T @ model.observed.T
            block = block + (model.error if i == j else 0)
            whole[i * size : (i + 1) * size, j * size : (j + 1) * size] = block
            whole[j * size : (j + 1) * size, i * size : (i + 1) * size] = block.T
    return whole


def draw(model: StateSpace, count: int, seed: int) -> FloatArray:
    """Observations drawn step by step."""
    generator = np.random.default_rng(seed)
    state = generator.multivariate_normal(np.zeros(len(model.start)), model.start)
    rows = []
    for _ in range(count):
        error = generator.multivariate_normal(np.zeros(2), model.error)
        rows.append(model.observed @ state + error)
        noise = generator.multivariate_normal(np.zeros(len(state)), model.noise)
        state = model.transition @ state + noise
    return np.array(rows)


def test_noise_of_a_step_against_its_integral() -> None:
    model = small()
    rate, size = 0.3j - 0.05, 4000
    grid = (np.arange(size) + 0.5) / size
    turned = np.exp(rate * grid)
    density = np.array([[1.0, -0.3], [-0.3, 0.5]])
    turns = np.array([[turned.real, -turned.imag], [turned.imag, turned.real]])
    expected = np.einsum("ijt,jk,lkt->il", turns, density, turns) / size
    assert np.allclose(model.noise[np.ix_([0, 2], [0, 2])], expected, rtol=0, atol=1e-8)


def test_likelihood_against_the_joint_density() -> None:
    model = small()
    data = draw(model, COUNT, 1)
    kalman = Filter.of(model, COUNT)
    found = kalman.minus_twice_log(kalman.run(data)[1])
    expected = -2 * multivariate_normal(cov=joint(model, COUNT)).logpdf(data.ravel())
    assert abs(found - expected) < 1e-8


def test_forecast_against_the_conditional_distribution() -> None:
    model, ahead = small(), 7
    data = draw(model, COUNT, 2)
    kalman = Filter.of(model, COUNT)
    state, covariance = kalman.run(data)[0], kalman.covariance
    for _ in range(ahead):
        state, covariance = model.transition @ state, model.propagated(covariance)
    whole = joint(model, COUNT + ahead)
    past, last = slice(0, 2 * COUNT), slice(-2, None)
    weights = np.linalg.solve(whole[past, past], whole[past, last]).T
    assert np.allclose(model.observed @ state, weights @ data.ravel(), rtol=0, atol=1e-10)
    expected = whole[last, last] - weights @ whole[past, last]
    assert np.allclose(model.of_observation(covariance), expected, rtol=0, atol=1e-10)


def test_every_tenth_step_has_the_noise_of_ten() -> None:
    model = small()
    covariance = model.start
    for _ in range(10):
        covariance = model.propagated(covariance)
    assert np.allclose(model.every(10).propagated(model.start), covariance, rtol=0, atol=1e-12)


def test_forecast_covariance_against_draws() -> None:
    """Errors of forecasts of drawn poles are as large and as correlated as claimed."""
    model, days, draws = forecast.model(), 120, 300
    kalman = Filter.of(model, 2000)
    generator = np.random.default_rng(4)
    root = np.linalg.cholesky(model.noise + 1e-18 * np.eye(20))
    truth = np.linalg.cholesky(model.start) @ generator.standard_normal((20, draws))
    estimate, error = np.zeros((20, draws)), np.sqrt(model.error[0, 0])
    for gain in kalman.gains:
        data = model.observed @ truth + error * generator.standard_normal((2, draws))
        after = estimate + gain @ (data - model.observed @ estimate)
        truth_before = truth
        truth = model.transition @ truth + root @ generator.standard_normal((20, draws))
        estimate = model.transition @ after
    state, covariance, truth = after, kalman.covariance, truth_before
    for _ in range(days):
        state, covariance = model.transition @ state, model.propagated(covariance)
        truth = model.transition @ truth + root @ generator.standard_normal((20, draws))
    scatter = np.cov(model.observed @ (truth - state))
    claimed = model.observed @ covariance @ model.observed.T
    ratio = np.sqrt(np.diag(scatter) / np.diag(claimed))
    assert np.all(abs(ratio - 1) < 4 / np.sqrt(2 * draws))
    correlations = [c[0, 1] / np.sqrt(c[0, 0] * c[1, 1]) for c in (scatter, claimed)]
    assert abs(correlations[0] - correlations[1]) < 4 / np.sqrt(draws)


def test_free_numbers_of_the_fast_excitation_go_both_ways() -> None:
    fast = replace(forecast.SHIPPED, white=7.0)
    again = FastExcitation.from_free(fast.free)
    assert np.allclose(list(vars(again).values()), list(vars(fast).values()), rtol=1e-12, atol=0)


@pytest.mark.slow
def test_correlation_and_coverage_of_errors_by_horizon() -> None:
    """190 origins of C04 from 2005 on; 2.5 standard errors of a correlation are 0.18."""
    table = eop.read_polar_motion("c04")
    p = (table.x - 1j * table.y) / MAS
    days = np.array([3, 5, 10, 30, 90])
    errors, covariances = [], []
    for end in np.arange(p.size - 7600, p.size - 90, 40):
        ahead = forecast.forecast(p[:end], 90)
        error = ahead.pole[days - 1] - p[end + days - 1]
        errors.append(np.column_stack([error.real, -error.imag]))
        covariances.append(ahead.covariance[days - 1])
    error, covariance = np.array(errors), np.array(covariances)
    deviation = np.sqrt(np.diagonal(covariance, axis1=-2, axis2=-1))
    claimed = (covariance[..., 0, 1] / deviation.prod(axis=-1)).mean(axis=0)
    seen = np.mean(error.prod(axis=-1), axis=0) / np.sqrt(np.mean(error**2, axis=0).prod(axis=-1))
    assert np.all(abs(seen - claimed) < 2.5 / np.sqrt(len(error)))
    assert claimed[4] < -0.1  # x and y, not x and -y
    inside = abs(error) <= NORMAL_95 * deviation
    for count in inside[:, :4].sum(axis=0).ravel():
        interval = binomtest(int(count), len(error)).proportion_ci(0.95)
        assert interval.low <= 0.95 <= interval.high

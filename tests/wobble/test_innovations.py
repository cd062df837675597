"""Covariance of forecasts from innovations, against the model's own and against draws."""

import numpy as np

from earthspin.wobble import forecast
from earthspin.wobble.forecast import ORDER, Autoregression, forecast_covariance
from earthspin.wobble.state_space import Filter

NONE = np.zeros((2, 2))


def steady() -> Filter:
    return Filter.of(forecast.model(), 4000)


def test_white_innovations_give_the_covariance_of_the_model() -> None:
    """Gains of a filter of 11 years still change by parts in a million."""
    kalman, days = steady(), 60
    white = Autoregression(np.zeros(ORDER, dtype=complex), 0, kalman.innovation[-1])
    claimed = forecast_covariance(kalman, white, NONE, days)
    covariance = kalman.covariance
    for day in range(days):
        covariance = kalman.model.propagated(covariance)
        expected = kalman.model.of_observation(covariance)
        assert np.allclose(claimed[day], expected, rtol=1e-4, atol=0)


def test_covariance_of_correlated_innovations_against_draws() -> None:
    kalman, days, draws = steady(), 12, 20000
    coefficients = np.zeros(ORDER, dtype=complex)
    coefficients[:2] = [-0.5 + 0.2j, 0.3]
    residual = np.array([[0.03, 0.012], [0.012, 0.02]])
    last = np.array([[0.004, 0.001], [0.001, 0.003]])
    generator = np.random.default_rng(1)
    noise = generator.multivariate_normal([0, 0], residual, (days + 1, draws))
    noise[0] = generator.multivariate_normal([0, 0], last, draws)
    complex_noise = noise @ [1, 1j]
    series = np.zeros((days + 1, draws), dtype=complex)
    state = np.zeros((len(kalman.model.transition), draws))
    for day in range(days + 1):
        series[day] = complex_noise[day]
        for lag in range(1, min(day, 2) + 1):
            series[day] -= coefficients[lag - 1] * series[day - lag]
        innovation = np.array([series[day].real, series[day].imag])
        error = kalman.model.observed @ state + innovation
        state = kalman.model.transition @ (state + kalman.gains[-1] @ innovation)
    autoregression = Autoregression(coefficients, 0, residual)
    claimed = forecast_covariance(kalman, autoregression, last, days)[-1]
    assert np.allclose(np.cov(error), claimed, rtol=0, atol=6 * claimed.max() / np.sqrt(draws))


def test_autoregression_of_drawn_innovations() -> None:
    """Of 730 draws: standard errors 0.04 of a coefficient, 5 % of a variance."""
    generator = np.random.default_rng(2)
    noise = generator.multivariate_normal([0, 0], [[4, 1], [1, 2]], 900) @ [1, 1j]
    series = noise.copy()
    for k in range(1, series.size):
        series[k] += (0.6 - 0.3j) * series[k - 1]
    fitted = Autoregression.fitted(series)
    assert abs(fitted.coefficients[0] + 0.6 - 0.3j) < 0.16
    assert np.allclose(fitted.covariance, [[4, 1], [1, 2]], rtol=0, atol=0.8)
    follows = fitted.extended(series, 1)[0]
    assert abs(follows - (0.6 - 0.3j) * series[-1]) < 1.5


def test_error_of_the_last_observation_by_the_product_of_two_densities() -> None:
    """Two normal densities of variances s and v have the product of variance s v / (s + v)."""
    fitted = Autoregression(np.zeros(ORDER, dtype=complex), 0.3 - 0.2j, np.diag([4.0, 1.0]))
    residual, left = fitted.without_error(1.0)
    assert np.allclose([residual.real, residual.imag], [0.24, -0.1], rtol=0, atol=1e-14)
    assert np.allclose(left, np.diag([0.8, 0.5]), rtol=0, atol=1e-14)

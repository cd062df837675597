"""Windows: integrals, derivatives and values in between of functions that are known."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from earthspin.numerics.polynomials import Windows, integrated

EDGES = np.array([-1.0, 0.5, 2.0, 2.75, 5.0])


@given(st.integers(0, 9))
def test_polynomials_are_exact(degree: int) -> None:
    windows = Windows(EDGES, 10)
    values = windows.times**degree
    to_nodes, whole = windows.integral(values)
    start = EDGES[:-1, np.newaxis] ** (degree + 1) / (degree + 1)
    # Measured beside the largest value in a window: 2e-15, and 2e-13 for the slope.
    primitive = EDGES ** (degree + 1) / (degree + 1)
    size = np.maximum(abs(primitive[:-1]), abs(primitive[1:]))
    found = to_nodes + start - windows.times ** (degree + 1) / (degree + 1)
    assert np.all(abs(found) <= 1e-14 * size[:, np.newaxis])
    assert np.all(abs(whole - np.diff(primitive)) <= 1e-14 * size)
    slope = degree * windows.times ** max(degree - 1, 0)
    steepest = 1 + np.max(abs(slope), axis=1, keepdims=True)
    assert np.all(abs(windows.derivative(values) - slope) <= 1e-12 * steepest)


def test_values_in_between_and_at_the_edges() -> None:
    windows = Windows(EDGES, 18)
    series = windows.coefficients(np.stack([np.sin(windows.times), np.cos(windows.times)]))
    times = np.concatenate([EDGES, np.random.default_rng(2).uniform(-1, 5, 100)])
    found = windows.evaluate(series, times)
    assert (
        np.max(np.abs(found - [np.sin(times), np.cos(times)])) < 5e-13
    )  # 1e-13 measured, at an edge


def test_integrated_series_starts_where_it_is_told() -> None:
    windows = Windows(EDGES, 16)
    series = windows.coefficients(np.cos(windows.times)[np.newaxis])
    whole = integrated(series, windows.half, np.sin(EDGES[np.newaxis, :-1]))
    times = np.linspace(-1, 5, 77)
    assert np.max(np.abs(windows.evaluate(whole, times)[0] - np.sin(times))) < 1e-13


def test_complex_values_in_two_parts() -> None:
    windows = Windows(EDGES, 16)
    wave = np.exp(1j * windows.times)
    assert np.max(np.abs(windows.derivative(wave) - 1j * wave)) < 1e-11


@pytest.mark.parametrize("order", [6, 10, 14])
def test_error_falls_with_the_order(order: int) -> None:
    windows = Windows(np.array([0.0, 6.0]), order)
    _, whole = windows.integral(np.exp(np.sin(windows.times)))
    from scipy.integrate import quad

    exact = quad(lambda t: np.exp(np.sin(t)), 0, 6, epsabs=1e-13)[0]
    assert abs(whole[0] - exact) < {6: 3e-2, 10: 3e-4, 14: 3e-6}[order]

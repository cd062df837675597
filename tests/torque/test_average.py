"""Averages: what the tapers remove, what the error claims, and how often it is right."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.signal.windows import general_cosine

from earthspin import UndefinedError
from earthspin.bodies import EARTH, MOON, SUN
from earthspin.constants import ARCSEC_PER_YEAR, DAY, JULIAN_YEAR
from earthspin.sky.ephemeris import Ephemeris
from earthspin.sky.poles import IAU_2006
from earthspin.torque.average import (
    FEWEST_CYCLES,
    TAPERS,
    Window,
    best_window,
    convergence_curve,
    precessing_torque,
    window_mean_and_error,
    with_total,
)
from earthspin.torque.gravity import torque_from_position
from earthspin.torque.rates import precession_rate

CYCLE = 18.6 * JULIAN_YEAR


@pytest.mark.parametrize("taper", TAPERS)
def test_a_constant_is_its_own_mean_and_a_drift_does_not_move_the_middle(taper: str) -> None:
    window = Window(5.0, 4, 100.0, taper)
    times = window.sample_times(1.0)
    assert np.isclose(window.mean(times, np.full(times.size, 7.0)), 7.0, rtol=1e-15, atol=0)
    assert np.isclose(window.mean(times, 2.0 * times), 10.0, rtol=2e-15, atol=0)


@pytest.mark.parametrize(("taper", "power"), [("plain", 0), ("hann", 2), ("sin4", 4)])
def test_tapers_are_powers_of_a_cosine(taper: str, power: int) -> None:
    window = Window(3.0, 4, 100.0, taper)
    times = 3.0 + 0.5 * np.arange(-399, 400)  # both ends left out
    shape = np.cos(np.pi * (times - 3.0) / 400.0) ** power
    # 2e-17 measured, of weights up to 7e-3
    np.testing.assert_allclose(window.weights(times), shape / shape.sum(), rtol=0, atol=1e-16)


def test_blackman_harris_is_scipys() -> None:
    window = Window(0.0, 4, 100.0, "blackman-harris")
    times = 0.5 * np.arange(-399, 400)
    shape = general_cosine(801, [0.35875, 0.48829, 0.14128, 0.01168])[1:-1]
    np.testing.assert_allclose(window.weights(times), shape / shape.sum(), rtol=0, atol=1e-16)


@given(
    cycles=st.integers(3, 8),
    harmonic=st.integers(1, 5),
    phase=st.floats(0, 2 * np.pi),
    centre=st.floats(-1e3, 1e3),
)
def test_sin4_removes_the_cycle_and_its_harmonics_exactly(
    cycles: int, harmonic: int, phase: float, centre: float
) -> None:
    window = Window(centre, cycles, 100.0, "sin4")
    times = window.sample_times(1.0)
    wave = np.cos(2 * np.pi * harmonic * (times - centre) / 100.0 + phase)
    assert abs(window.mean(times, wave)) < 1e-14  # measured: 2e-16


def test_hann_needs_two_turns_and_sin4_three() -> None:
    for taper, turns in (("plain", 1), ("hann", 2), ("sin4", 3), ("blackman-harris", 4)):
        for cycles in range(1, 6):
            window = Window(0.0, cycles, 100.0, taper)
            times = window.sample_times(0.5)
            left = abs(window.mean(times, np.cos(2 * np.pi * times / 100.0)))
            # Blackman-Harris gives up exact zeros for low side lobes: 3e-5.
            assert (left < 1e-4) == (cycles >= turns), (taper, cycles, left)


def test_the_window_stays_inside_the_span() -> None:
    window = best_window(-50 * JULIAN_YEAR, 53.8 * JULIAN_YEAR, CYCLE)
    assert window.centre == 0.0
    assert window.cycles == 5
    assert window.taper == "sin4"
    assert window.length / 2 <= 50 * JULIAN_YEAR


def test_a_window_is_centred_and_no_longer_than_the_drift_allows() -> None:
    centred = best_window(10 * JULIAN_YEAR, 110 * JULIAN_YEAR, CYCLE)
    assert centred.centre == 60 * JULIAN_YEAR
    longest = best_window(-500 * JULIAN_YEAR, 500 * JULIAN_YEAR, CYCLE)
    assert longest.length <= 150 * JULIAN_YEAR


def test_two_turns_are_refused() -> None:
    with pytest.raises(UndefinedError, match="three turns"):
        best_window(0.0, 50 * JULIAN_YEAR, CYCLE)


@given(phases=st.lists(st.floats(0, 2 * np.pi), min_size=4, max_size=4), turns=st.integers(3, 8))
def test_the_error_covers_incommensurable_waves(phases: list[float], turns: int) -> None:
    """Four waves like those of the Moon's torque: half-month, month, year, node."""
    window = Window(0.0, turns, 6798.38, "sin4")
    times = window.sample_times(1.0)
    periods, sizes = (13.66, 27.55, 365.25, 6798.38), (1.0, 0.1, 0.1, 0.2)
    signal = 1.0 + sum(
        size * np.cos(2 * np.pi * times / period + phase)
        for size, period, phase in zip(sizes, periods, phases, strict=True)
    )
    mean, error = window_mean_and_error(window, times, signal[:, np.newaxis], np.zeros(1))
    assert abs(mean[0] - 1.0) <= error[0] + 1e-15
    assert error[0] < 1e-3


def test_the_error_is_the_largest_difference_from_the_neighbours() -> None:
    """Of one fast wave that the tapers leave a little of; each mean is formed by hand."""
    window = Window(0.0, 4, 100.0, "sin4")
    times = window.sample_times(1.0)
    values = 1 + np.cos(2 * np.pi * times / 73.0)

    def mean(turns: int, power: int, every: int = 1) -> float:
        t, v = times[::every], values[::every]
        weight = np.where(abs(t) < 50.0 * turns, np.cos(np.pi * t / (100.0 * turns)) ** power, 0.0)
        return float(np.average(v, weights=weight))

    others = [mean(4, 2), mean(3, 2), mean(3, 4), mean(4, 4, every=2)]
    found, error = window_mean_and_error(window, times, values[:, np.newaxis], np.zeros(1))
    assert found[0] == pytest.approx(mean(4, 4), rel=1e-15, abs=0)
    # measured: 1e-15, of means near 1
    assert error[0] == pytest.approx(max(abs(other - found[0]) for other in others), abs=5e-15)


def test_convergence_ends_where_the_window_does() -> None:
    window = Window(0.0, 4, 100.0, "sin4")
    times = window.sample_times(1.0)
    values = 1 + np.cos(2 * np.pi * times / 37.0)
    curves = convergence_curve(window, times, values, np.array([1.0, 2.5, 4.0]))
    assert set(curves) == set(TAPERS)
    assert curves["sin4"][-1] == window.mean(times, values)


def test_a_slow_swing_counts_even_where_the_mean_vanishes() -> None:
    window = Window(0.0, 3, 100.0, "sin4")
    times = window.sample_times(1.0)
    waves = np.stack([np.cos(2 * np.pi * times / 10), np.cos(2 * np.pi * times / 20)], axis=1)
    mean, error = window_mean_and_error(window, times, waves, np.array([1e-3, 2e-3]))
    assert np.all(np.abs(mean) < 7e-16)  # measured: 7e-17
    # the mean of |cos| is 2/pi; the total has the sum of both
    assert np.allclose(error, np.array([1e-3, 2e-3, 3e-3]) * 2 / np.pi, rtol=0.05, atol=0)


def test_the_total_is_the_sum_of_all() -> None:
    values = np.arange(12.0).reshape(3, 2, 2)
    assert np.array_equal(with_total(values)[:, 2], values.sum(axis=1))
    assert np.array_equal(with_total(values[:, :1])[:, 1], values[:, 0])


@given(st.floats(0.05, np.pi - 0.05), st.floats(0, 2 * np.pi), st.floats(1e-9, 1e-5))
def test_precessing_torque_against_a_small_turn(tilt: float, node: float, turn: float) -> None:
    """Turn an axis about the normal by a known angle and ask for it back."""
    normal = np.array([0.0, 0.0, 1.0])

    def axis(longitude: float) -> np.ndarray:
        return np.array(
            [np.sin(tilt) * np.cos(longitude), np.sin(tilt) * np.sin(longitude), np.cos(tilt)]
        )

    # westward: longitude falls
    change = axis(node - turn / 2) - axis(node + turn / 2)
    rate = precessing_torque(change[np.newaxis], axis(node), normal)[0]
    assert np.isclose(rate, turn, rtol=1e-6, atol=0)


def test_an_upright_axis_has_no_longitude() -> None:
    up = np.array([0.0, 0.0, 1.0])
    for axis in (up, -up):
        with pytest.raises(UndefinedError, match="normal to the orbit"):
            precessing_torque(np.ones((1, 3)), axis, up)


@pytest.mark.parametrize(("taper", "turns"), [("hann", 3), ("sin4", 3)])
def test_the_claimed_error_holds_in_the_last_century(
    de421: Ephemeris, taper: str, turns: float
) -> None:
    """Rates by Sun and Moon in windows about many epochs, against a smooth curve through them."""
    days = np.arange(-19_000.0, 19_001.0)
    axis, normal = IAU_2006.equator(None, days)[:, 2], IAU_2006.orbit_normal(None)
    place = de421.positions({"sun": 10, "moon": 301}, 399, days)
    torques = [torque_from_position(b.gm, 1.0, place[b.name], axis) for b in (SUN, MOON)]
    precessing = np.stack([precessing_torque(t, axis, normal) for t in torques], axis=1)
    rate = precession_rate(precessing, EARTH.dynamical_flattening, EARTH.spin_rate)
    swing = np.array([SUN.slow_swing, MOON.slow_swing])
    centres, means, errors = np.arange(-8000, 8000, 700) * DAY, [], []
    for centre in centres:
        window = Window(float(centre), turns, MOON.cycle, taper)
        inside = np.abs(days * DAY - centre) <= window.length / 2
        mean, error = window_mean_and_error(window, days[inside] * DAY, rate[inside], swing)
        means.append(mean[-1] / ARCSEC_PER_YEAR * 1e5)  # mas per century
        errors.append(error[-1] / ARCSEC_PER_YEAR * 1e5)
    apart = np.abs(means - np.polynomial.Chebyshev.fit(centres, means, 6)(centres))
    assert np.mean(apart <= errors) >= 0.95
    # the smooth curve takes part of the swing here
    assert 0.05 < np.sqrt(np.mean(apart**2)) < 1.5
    assert apart.max() < 5


def test_a_slow_cycle_fits_three_times_into_a_long_span() -> None:
    """Three times a cycle, divided by the cycle, may be less than three by rounding."""
    for cycle in np.random.default_rng(5).uniform(2e9, 1e11, 200):
        assert best_window(-5 * cycle, 5 * cycle, cycle).cycles == FEWEST_CYCLES

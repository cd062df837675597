"""Spins that are locked to an orbit are told from those that are not."""

import math

import numpy as np
import pytest

from earthspin.torque.cassini import locked_ratio, locked_turns

UP = np.array([0.0, 0.0, 1.0])


def kepler_orbit(e: float, orbits: int = 20) -> tuple[np.ndarray, np.ndarray]:
    """Times and places on an ellipse whose mean motion is 1, by Newton on Kepler's equation."""
    mean = np.linspace(0.0, 2 * np.pi * (orbits + 0.3), 200 * orbits)
    anomaly = mean.copy()
    for _ in range(50):
        anomaly -= (anomaly - e * np.sin(anomaly) - mean) / (1 - e * np.cos(anomaly))
    x, y = np.cos(anomaly) - e, np.sqrt(1 - e * e) * np.sin(anomaly)
    return mean, np.stack([x, y, np.zeros_like(x)], axis=-1)


@pytest.mark.parametrize("eccentricity", [0.0, 0.0549, 0.2056, 0.3])
@pytest.mark.parametrize("turns", [0.5, 1.0, 1.5, 2.0, 2.5, 3.0])
def test_every_lock_is_seen(turns: float, eccentricity: float) -> None:
    times, place = kepler_orbit(eccentricity)
    assert locked_ratio(times, place, UP, turns) == turns
    assert locked_ratio(times, place, UP, 1.004 * turns) == turns


@pytest.mark.parametrize("turns", [0.924, 1.08, 1.3, 3.5, 366.24])
def test_what_is_not_locked_is_let_go(turns: float) -> None:
    times, place = kepler_orbit(0.1)
    assert locked_ratio(times, place, UP, turns) is None
    assert locked_ratio(times, place, -UP, 1.0) is None  # retrograde


@pytest.mark.parametrize("turns", [0.5, 1.5, 3.0])
def test_a_lock_is_closer_than_one_percent(turns: float) -> None:
    assert [locked_turns(ratio * turns, 1.0) for ratio in (0.9901, 1.0099)] == [turns, turns]
    assert [locked_turns(ratio * turns, 1.0) for ratio in (0.9899, 1.0101)] == [None, None]


@pytest.mark.parametrize("e", [0.0, 0.1, 0.2])
@pytest.mark.parametrize("start", [0.0, 2.0, 4.0])
def test_an_eccentric_orbit_moves_the_mean_ratio_by_less_than_half_of_that(
    e: float, start: float
) -> None:
    """The true anomaly is ahead of the mean one by up to 2 e; over 20 orbits that is 0.3 %."""
    times, place = kepler_orbit(e, orbits=22)
    some = slice(round(200 * start / math.tau), round(200 * start / math.tau) + 4001)
    for spin in (0.9951, 1.0049):
        assert locked_ratio(times[some], place[some], UP, spin) == 1.0

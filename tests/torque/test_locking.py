"""Spins that are locked to an orbit are told from those that are not."""

import numpy as np
import pytest

from earthspin.torque.cassini import locked_ratio

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

"""Spins that are locked to an orbit are told from those that are not."""

import numpy as np
import pytest

import earthspin
from earthspin import Body, UndefinedError
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


def mercury(spin_period: str) -> Body:
    table = {
        "from": "mercury",
        "radius": "2439.7 km",
        "j2": 5.03e-5,
        "dynamical_flattening": 1.45e-4,
        "spin_period": spin_period,
        "pole": ["281.01 deg", "61.414 deg"],
        "orbit_pole": ["280.99 deg", "61.447 deg"],
    }
    question = earthspin.Scene(compute="precession", body=table, perturbers=["sun"])
    return question.body  # type: ignore[attr-defined, no-any-return]


def test_mercury_is_refused_and_a_freely_turning_one_is_not() -> None:
    """58.646 d in a year of 87.969 d: three turns in two orbits."""
    with pytest.raises(UndefinedError, match=r"Mercury is locked .*1.5 rotations per orbit"):
        earthspin.precession(body=mercury("58.646 d"), perturbers=["sun"])
    free = earthspin.precession(body=mercury("50 d"), perturbers=["sun"])
    assert np.isfinite(free.precession_period).all()

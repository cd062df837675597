"""The free core nutation: known ones recovered within their errors, and none seen in noise."""

from functools import cache

import numpy as np
import pytest

from earthspin import UndefinedError
from earthspin.nutation import core_nutation
from earthspin.nutation.core_nutation import PERIOD
from tests.nutation.simulated_offsets import NOISES, noise

DAYS = np.arange(1100.0) - 549.5
DRAWS = 400


@cache
def simulated(
    name: str, amplitude: float, period: float = PERIOD
) -> list[core_nutation.CoreNutationAmplitudes]:
    """One window of each of many series with a core nutation of phase 1 rad."""
    rng = np.random.default_rng(3)
    core = amplitude * np.exp(2j * np.pi * DAYS / PERIOD + 1j)
    return [
        core_nutation.fit(DAYS, core + noise(rng, DAYS.size, NOISES[name]), window=1090)
        for _ in range(DRAWS)
    ]


@pytest.mark.parametrize("name", NOISES)
@pytest.mark.parametrize("amplitude", [0.0, 0.05, 0.2])
def test_intervals_hold_the_truth(name: str, amplitude: float) -> None:
    """95 % of the cases, less two standard deviations of 400 draws, whatever the noise.

    The half-widths are 0.96 to 1.21 times those that 95 % of the cases need.
    """
    fits = simulated(name, amplitude)
    ratios = [abs(abs(fit.amplitude[0]) - amplitude) / fit.error[0] for fit in fits]
    assert np.mean(np.array(ratios) <= 1) > 0.95 - 2 * np.sqrt(0.95 * 0.05 / DRAWS)
    assert np.quantile(ratios, 0.95) > 1 / 1.3
    off = [abs(np.angle(fit.amplitude[0] * np.exp(-1j))) <= fit.phase_error[0] for fit in fits]
    assert np.mean(off) > 0.95 - 2 * np.sqrt(0.95 * 0.05 / DRAWS)


@pytest.mark.parametrize("name", NOISES)
def test_noise_alone_is_seen_once_in_a_hundred(name: str) -> None:
    seen = np.mean([fit.detected[0] for fit in simulated(name, 0.0)])
    assert seen < 0.01 + 3 * np.sqrt(0.01 * 0.99 / DRAWS)


def test_a_large_one_is_always_seen() -> None:
    assert all(fit.detected[0] for fit in simulated("memory of 20 d", 0.3))


def test_a_circle_without_noise_in_every_window() -> None:
    """Amplitude and phase are exact, block means included, beside a constant and a line."""
    days = np.arange(4000.0)
    eta = 0.2 * np.exp(2j * np.pi * days / PERIOD + 0.7j) + (0.1 - 0.3j) + 1e-4 * days
    fit = core_nutation.fit(days, eta)
    assert np.allclose(fit.amplitude, 0.2 * np.exp(0.7j), rtol=0, atol=1e-12)
    wave = 0.2 * np.exp(2j * np.pi * days / PERIOD + 0.7j)
    assert np.allclose(fit.at(days), wave, rtol=0, atol=1e-12)


def test_a_prograde_circle_is_no_core_nutation() -> None:
    """The sense decides: the same circle the other way is noise to the fit."""
    days = np.arange(1100.0) - 549.5
    eta = 0.2 * np.exp(-2j * np.pi * days / PERIOD)
    fit = core_nutation.fit(days, eta, window=1090)
    assert abs(fit.amplitude[0]) < 0.02
    assert not fit.detected[0]


def test_against_least_squares_by_numpy() -> None:
    """Daily values of one window, fitted by numpy without block means: 0.03 mas apart at most."""
    from earthspin.constants import MAS
    from earthspin.sky.eop import read_pole_offsets

    table = read_pole_offsets()
    time, eta = table.mjd - 51544.5, table.offsets / MAS
    fit = core_nutation.fit(time, eta)
    for window in (0, 200, 400):
        inside = abs(time - fit.time[window]) <= core_nutation.WINDOW / 2
        t = time[inside]
        columns = np.column_stack([np.ones(t.size), t, np.exp(2j * np.pi * t / PERIOD)])
        by_numpy = np.linalg.lstsq(columns, eta[inside], rcond=None)[0][2]
        assert abs(fit.amplitude[window] - by_numpy) < 0.003 + 0.02 * abs(by_numpy)


@pytest.mark.parametrize("window", [800.0, 4100.0])
def test_windows_that_cannot_be(window: float) -> None:
    with pytest.raises(UndefinedError, match=r"860 d.*4000 d"):
        core_nutation.fit(np.arange(4000.0), np.ones(4000, dtype=complex), window)


def test_the_published_period_in_days() -> None:
    """-431.18 sidereal days of 86164.0905 s."""
    assert pytest.approx(-431.18 * 86164.0905 / 86400, abs=1e-5) == PERIOD

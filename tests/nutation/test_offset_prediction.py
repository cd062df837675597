"""Predictions of celestial pole offsets: exact where they can be, honest elsewhere."""

import numpy as np
import pytest

from data_tools.pole_offsets import mjd_of, scores
from earthspin import UndefinedError
from earthspin.constants import MAS
from earthspin.nutation.core_nutation import (
    FLOOR,
    HALF_LIFE,
    LONGEST,
    PERIOD,
    fit_each_day,
    predict,
)
from earthspin.sky.eop import read_pole_offsets
from tests.nutation.simulated_offsets import noise

MJD = 50000.0 + np.arange(3000)
ERRORS = np.full(MJD.size, 0.1 * MAS)


def predicted(eta: np.ndarray, ahead: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return predict(MJD, eta.real, eta.imag, ERRORS, ERRORS, MJD[-1] + ahead)


def test_a_core_nutation_without_noise() -> None:
    ahead = np.array([1.0, 10.0, 30.5, 365.0])
    eta = MAS * (0.2 * np.exp(2j * np.pi * MJD / PERIOD + 1j) + 0.1 - 0.2j)
    values, half_widths = predicted(eta, ahead)
    wave = 0.2 * np.exp(2j * np.pi * (MJD[-1] + ahead) / PERIOD + 1j) + 0.1 - 0.2j
    assert np.allclose(values / MAS, np.stack([wave.real, wave.imag], 1), rtol=0, atol=1e-9)
    assert np.max(half_widths) < 1e-9 * MAS


def test_the_fit_against_least_squares_by_numpy() -> None:
    rng = np.random.default_rng(1)
    eta = noise(rng, MJD.size, ((0.1, 30.0),)) * MAS
    weight = 1 / (rng.uniform(0.1, 1.0, MJD.size) * MAS) ** 2
    fits = fit_each_day(MJD, eta, weight)
    for day in (900, 2999):
        age = MJD[day] - MJD[: day + 1]
        root = np.sqrt(weight[: day + 1] * 0.5 ** (age / HALF_LIFE))
        columns = np.column_stack([np.ones(day + 1), np.exp(2j * np.pi * MJD[: day + 1] / PERIOD)])
        scaled = columns * root[:, None], eta[: day + 1] * root
        constant, amplitude = np.linalg.lstsq(*scaled, rcond=None)[0]
        assert abs(fits.constant[day] - constant) < 1e-9 * MAS
        assert abs(fits.amplitude[day] - amplitude) < 1e-9 * MAS


def test_nothing_after_the_origin_is_used() -> None:
    """The prediction from a day is the same whatever the table holds later."""
    table = read_pole_offsets()
    end = int(np.searchsorted(table.mjd, mjd_of(2015)))
    rows = slice(None, end)
    names = ("mjd", "x", "y", "x_error", "y_error")
    target = table.mjd[end - 1] + np.array([10.0, 90.0])
    known = [getattr(table, name)[rows] for name in names]
    values, half_widths = predict(*known, target)  # type: ignore[arg-type]
    weight = 1 / (table.x_error**2 + table.y_error**2 + 2 * FLOOR)
    whole = fit_each_day(table.mjd, table.offsets, weight)
    for row, ahead in enumerate((10.0, 90.0)):
        eta = whole.ahead(ahead, end - 1)[0]
        assert np.allclose(values[row], [eta.real, eta.imag], rtol=0, atol=1e-12 * MAS)
    assert np.all(half_widths > 0.05 * MAS)


def test_targets_on_c04_since_2015() -> None:
    """75, 75, 85 uas at 10, 30, 90 d; better than the last offset; intervals of 93 to 99 %."""
    sizes, inside = scores(read_pole_offsets(), (2015, 2026))
    assert np.all(sizes[1:4, 0] < [75, 75, 85])
    assert np.all(sizes[3:5, 0] < 0.95 * sizes[3:5, 1])
    assert np.all(sizes[:, 0] < sizes[:, 2])
    assert np.all((inside > 0.93) & (inside < 0.99))


def test_intervals_on_simulated_offsets() -> None:
    """Stationary noise about a core nutation: 95 % of the errors are inside."""
    rng = np.random.default_rng(2)
    ahead = np.array([10.0, 90.0])
    held = []
    for _ in range(60):
        days = np.arange(MJD.size + 90)
        eta = MAS * (
            0.2 * np.exp(2j * np.pi * days / PERIOD) + noise(rng, days.size, ((0.1, 20.0),))
        )
        values, half_widths = predict(
            MJD, eta.real[: MJD.size], eta.imag[: MJD.size], ERRORS, ERRORS, MJD[-1] + ahead
        )
        truth = eta[MJD.size - 1 + ahead.astype(int)]
        held.append(abs(values - np.stack([truth.real, truth.imag], 1)) <= half_widths)
    # 240 errors, those of one series not independent
    assert 0.90 < np.mean(held) <= 1.0


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"target": [0.0]}, f"dates from 1 to {LONGEST} d"),
        ({"target": [LONGEST + 1.0]}, f"{LONGEST + 1} d after the last offset cannot be predicted"),
        ({"rows": 1000}, r"1000 days of offsets are too few for 10 d ahead; give 1470"),
        ({"gap": True}, "days are missing between the offsets"),
        ({"nan": True}, "offsets or errors are not finite"),
    ],
)
def test_what_is_refused(change: dict[str, object], words: str) -> None:
    rows = int(change.get("rows", MJD.size))  # type: ignore[call-overload]
    mjd, dx = MJD[:rows].copy(), np.zeros(rows)
    if "gap" in change:
        mjd[-1] += 1
    if "nan" in change:
        dx[5] = np.nan
    target = mjd[-1] + np.array(change.get("target", [10.0]))
    with pytest.raises(UndefinedError, match=words):
        predict(mjd, dx, dx, ERRORS[:rows], ERRORS[:rows], target)

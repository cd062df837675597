"""Compare error and run time of methods for the period of the free wobble.

Methods: fits to polar motion, and the peak of a spectrum.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tests.reference.simulation import simulate
from earthspin.checks.work_precision import FloatArray, Ladder, Method, Setting
from earthspin.constants import DAY
from earthspin.errors import UndefinedError
from earthspin.wobble.observed import METHODS, fit
from earthspin.wobble.record import BAND

Record = tuple[FloatArray, NDArray[np.complex128]]

#: Period (d) and quality factor of the simulated records.
PERIOD, QUALITY = 433.0, 100.0
YEARS, QUICK_YEARS = (15.0, 30.0, 65.0, 130.0), (20.0, 40.0)
RECORDS, FEW_RECORDS = 32, 4
#: Error assigned to a record in which a method finds no wobble: half of the search band, d.
NOTHING_FOUND = 35.0
#: Allowed scatter of each method of this package, relative to the best possible scatter.
EXCESS = {"burg": 1.6, "likelihood": 1.6, "least-squares": 3.6}
QUICK_EXCESS = 2.0  # a few records determine a scatter to one third


def ladder(quick: bool) -> Ladder:
    """Return the comparison (`Ladder`) of methods for the period of the free wobble."""
    years, records = (QUICK_YEARS, FEW_RECORDS) if quick else (YEARS, RECORDS)
    excess, scatter = QUICK_EXCESS if quick else 1.0, best_scatter(years[-1])
    bounds = {name: EXCESS[name] * excess * scatter * DAY for name in METHODS}

    def method(name: str, estimate: Callable[[Record], float]) -> Method:
        settings = [_setting(estimate, length, records) for length in years]
        return Method(name, settings, bounds.get(name, np.inf))

    return Ladder(
        quantity="chandler",
        unit="d",
        problem=f"period of a randomly driven wobble ({PERIOD:g} d, Q = {QUALITY:g}) from a "
        "record with seasons, drift and background, one value in 10 d; the error is the rms over "
        f"{records} simulated records, known to {100 / np.sqrt(2 * records):.0f} per cent",
        subject="the period of the free wobble from one record",
        reference="the period of the simulated records",
        reference_error=1e-9 * DAY,
        methods=[
            *(method(name, partial(_period_by_fit, name)) for name in METHODS),
            method("peak of the FFT", _peak),
        ],
        useful=10 * DAY,
        error=lambda periods: float(np.sqrt(np.mean((periods - PERIOD) ** 2))) * DAY,
    )


def best_scatter(years: float) -> float:
    """Theoretical lower limit of the scatter of a wobble period from some years of data, d.

    It is T sqrt(T/(4 pi Q L)) for the period T, the quality factor Q and the length L.
    """
    return float(PERIOD * np.sqrt(PERIOD / (4 * np.pi * QUALITY * years * 365.25)))


@cache
def record(years: float, seed: int) -> Record:
    """Simulate polar motion with a known free wobble; return the times (d) and the pole (mas)."""
    return simulate(years, PERIOD, QUALITY, seed=seed)


def _setting(estimate: Callable[[Record], float], years: float, records: int) -> Setting:
    first = record(years, 0)
    return Setting(
        f"{years:g} years",
        lambda: (estimate(first), first[0].size),
        error_values=lambda: np.array([estimate(record(years, seed)) for seed in range(records)]),
    )


def _period_by_fit(name: str, record: Record) -> float:
    try:
        return fit(*record, name).period
    except UndefinedError:
        return PERIOD + NOTHING_FOUND


def _peak(record: Record) -> Any:
    """Period of the highest peak in the spectrum of simulated polar motion, near the wobble, d."""
    time, p = record
    p = p - np.polyval(np.polyfit(time, p, 1), time)
    frequency = np.fft.fftfreq(time.size, time[1] - time[0])
    inside = (frequency > 1 / BAND[1]) & (frequency < 1 / BAND[0])
    if not np.any(inside):
        return PERIOD + NOTHING_FOUND
    return 1 / frequency[inside][np.argmax(np.abs(np.fft.fft(p))[inside])]

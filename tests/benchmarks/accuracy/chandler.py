"""Period of the free wobble: fits to polar motion, and the peak of a spectrum."""

from collections.abc import Callable
from functools import cache, partial

import numpy as np

from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.wobble.observed import fit
from earthspin.wobble.record import BAND
from tests.benchmarks.accuracy.ladder import Ladder, settings
from tests.reference.simulation import simulate

#: Period (d) and quality factor of the simulated records; their lengths (years) and number.
PERIOD, QUALITY = 433.0, 100.0
YEARS, RECORDS = (15.0, 30.0, 65.0, 130.0), 32
#: Error assigned to a record in which a method finds no wobble: half of the search band, d.
NOTHING_FOUND = 35.0
#: Allowed scatter of each method of the package, relative to the best possible scatter.
EXCESS = {"burg": 1.6, "likelihood": 1.6}


def ladder() -> Ladder:
    """Methods for the period of the free wobble."""
    return Ladder(
        title="Period of the free wobble",
        problem=f"period of a randomly driven wobble ({PERIOD:g} d, Q = {QUALITY:g}) from a "
        "record with seasons, drift and background, one value in 10 d; the error is the rms over "
        f"{RECORDS} simulated records, known to {100 / np.sqrt(2 * RECORDS):.0f} per cent",
        reference="the period of the simulated records",
        unit="d",
        floor=1e-9,
        error=lambda periods: np.sqrt(np.mean((np.array(periods) - PERIOD) ** 2)),
        runs={
            **{
                name: settings("{} years", _period(partial(_by_fit, name)), YEARS)
                for name in EXCESS
            },
            "peak of the FFT": settings("{} years", _period(_peak), YEARS),
        },
        bounds={name: excess * best_scatter(YEARS[-1]) for name, excess in EXCESS.items()},
        cases=RECORDS,
    )


def best_scatter(years: float) -> float:
    """Theoretical lower limit of the scatter of a wobble period from some years of data, d.

    It is T sqrt(T/(4 pi Q L)) for the period T, the quality factor Q and the length L.
    """
    return float(PERIOD * np.sqrt(PERIOD / (4 * np.pi * QUALITY * years * 365.25)))


@cache
def record(years: float, seed: int) -> tuple[FloatArray, ComplexArray]:
    """Simulate polar motion with a known free wobble; return the times (d) and the pole (mas)."""
    return simulate(years, PERIOD, QUALITY, seed=seed)


def _period(
    estimate: Callable[[FloatArray, ComplexArray], float],
) -> Callable[..., tuple[float, int]]:
    def run(years: float, case: int = 0) -> tuple[float, int]:
        time, p = record(years, case)
        return estimate(time, p), time.size

    return run


def _by_fit(name: str, time: FloatArray, p: ComplexArray) -> float:
    try:
        return fit(time, p, name).period
    except UndefinedError:
        return PERIOD + NOTHING_FOUND


def _peak(time: FloatArray, p: ComplexArray) -> float:
    """Period of the highest peak in the spectrum of polar motion, near the wobble, d."""
    p = p - np.polyval(np.polyfit(time, p, 1), time)
    frequency = np.fft.fftfreq(time.size, time[1] - time[0])
    inside = (frequency > 1 / BAND[1]) & (frequency < 1 / BAND[0])
    if not np.any(inside):
        return PERIOD + NOTHING_FOUND
    return float(1 / frequency[inside][np.argmax(np.abs(np.fft.fft(p))[inside])])

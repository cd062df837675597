"""Measure predictions of celestial pole offsets and errors of the free core nutation.

For docs/pole_offsets.md: predictions from past origins compared with C04, and how often the 95 %
intervals of amplitude and period contain the truth in simulated series.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

from earthspin.constants import MAS
from earthspin.errors import UndefinedError
from earthspin.nutation import core_nutation
from earthspin.nutation.offset_prediction import predict
from earthspin.sky.eop import PoleSeries, read_pole_offsets
from earthspin.wobble.observed import fit

PAGE = Path(__file__).parent.parent / "docs" / "measured" / "pole-offsets.inc"
#: Days ahead.
HORIZONS = np.array([1, 10, 30, 90, 180, 365, 730])
#: Years of the targets: those in which the constants were chosen, and those that are scored.
CHOSEN, SCORED = (2003, 2015), (2015, 2026)
#: Days between origins.
EVERY = 10
#: Noise of simulated series: name, size in mas and memory in days of each part of it.
NOISES = {
    "white": ((0.1, 0.0),),
    "memory of 20 d": ((0.12, 20.0),),
    "memory of 60 d": ((0.12, 60.0),),
    "memory of 200 d": ((0.12, 200.0),),
    "memories of 60 and 3 d": ((0.08, 60.0), (0.08, 3.0)),
}
AMPLITUDES = (0.0, 0.05, 0.2)  # mas
#: Simulated windows of each kind, and simulated series for the period.
WINDOWS, SERIES = 2000, 100


def mjd_of(year: float) -> float:
    """Modified Julian date of the start of a year."""
    return 51544.0 + (year - 2000) * 365.25


def scores(
    table: PoleSeries, years: tuple[int, int]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return mean absolute errors of three predictions, half-width and coverage by horizon.

    Parameters
    ----------
    table : PoleSeries
    years : pair of int
        All targets lie in these.

    Returns
    -------
    sizes : ndarray, shape (horizon, 4)
        Mean absolute error per coordinate of the prediction, of the last offset and of zero, and
        mean half-width, uas.
    inside : ndarray, shape (horizon,)
        Share of errors inside the half-widths.
    """
    first, last = (mjd_of(year) for year in years)
    eta = np.stack([table.x, table.y], axis=1)
    origins = [
        i
        for i, mjd in enumerate(table.mjd)
        if first <= mjd < last - HORIZONS[-1] and i % EVERY == 0
    ]
    errors, widths, last_ones, zeros = [], [], [], []
    for i in origins:
        known = slice(None, i + 1)
        values, half_widths = predict(
            table.mjd[known],
            table.x[known],
            table.y[known],
            table.x_error[known],
            table.y_error[known],
            table.mjd[i] + HORIZONS,
        )
        truth = eta[i + HORIZONS]
        errors.append(values - truth)
        widths.append(half_widths)
        last_ones.append(eta[i] - truth)
        zeros.append(truth)
    absolute = [np.abs(e).mean(axis=(0, 2)) for e in (errors, last_ones, zeros)]
    inside = (np.abs(errors) <= np.array(widths)).mean(axis=(0, 2))
    uas = MAS / 1000
    return np.stack([*absolute, np.mean(widths, axis=(0, 2))], axis=1) / uas, inside


def noise(
    rng: np.random.Generator, count: int, parts: tuple[tuple[float, float], ...]
) -> NDArray[np.complex128]:
    """Complex noise of given sizes and memories."""
    total = np.zeros(count, dtype=complex)
    for size, memory in parts:
        fall = np.exp(-1 / memory) if memory else 0.0
        start = round(10 * memory)
        drive = rng.standard_normal((count + start, 2)) @ [1, 1j] * np.sqrt((1 - fall**2) / 2)
        total += size * lfilter([1.0], [1.0, -fall], drive)[start:]
    return total


def windows(parts: tuple[tuple[float, float], ...], amplitude: float) -> tuple[float, float]:
    """Return how often the interval of the amplitude holds the truth, and how often it is seen."""
    rng = np.random.default_rng(0)
    days = np.arange(1100, dtype=np.float64) - 549.5
    core = amplitude * core_nutation.circle(days)
    inside = detected = 0
    for _ in range(WINDOWS):
        fits = core_nutation.fit(days, core + noise(rng, days.size, parts), window=1090)
        inside += int(abs(abs(fits.amplitude[0]) - amplitude) <= fits.error[0])
        detected += int(fits.detected[0])
    return inside / WINDOWS, detected / WINDOWS


def excited(seed: int, years: float = 42.0) -> tuple[NDArray[np.float64], NDArray[np.complex128]]:
    """Simulate offsets in mas with a core nutation that random excitation changes.

    The complex amplitude starts at 0.2 mas and walks by 0.05 mas in a year in either coordinate,
    about as observed.
    """
    rng = np.random.default_rng(seed)
    days = np.arange(round(years * 365.25)).astype(float)
    walk = rng.standard_normal((days.size, 2)) @ [1, 1j] * 0.05 / np.sqrt(365.25)
    core = (0.2 + np.cumsum(walk)) * core_nutation.circle(days)
    year = 0.03 * np.exp(2j * np.pi * days / 365.25)
    return days, core + year + noise(rng, days.size, ((0.1, 40.0), (0.08, 3.0)))


def periods() -> tuple[float, float, float, int]:
    """Return share of periods inside their intervals, their bias, half-width, and the refused."""
    off, widths = [], []
    for seed in range(SERIES):
        days, eta = excited(seed)
        try:
            mode = fit(days, np.conj(eta), "likelihood")
        except UndefinedError:
            continue
        off.append(-mode.period - core_nutation.PERIOD)
        widths.append(mode.period_error)
    inside = float(np.mean(np.abs(off) <= np.array(widths)))
    return inside, float(np.mean(off)), float(np.median(widths)), SERIES - len(off)


def page() -> str:
    """The tables in Markdown."""
    table, lines = read_pole_offsets(), []
    for years in (SCORED, CHOSEN):
        sizes, inside = scores(table, years)
        lines += [
            f"Targets in C04, {years[0]} to {years[1] - 1}; origins every {EVERY} d:",
            "",
            "| days ahead | predicted, µas | last offset, µas | zero, µas | half-width, µas "
            "| inside, % |",
            "|---:|---:|---:|---:|---:|---:|",
        ]
        for horizon, row, share in zip(HORIZONS, sizes, inside, strict=True):
            cells = " | ".join(f"{value:.0f}" for value in row)
            lines.append(f"| {horizon} | {cells} | {100 * share:.0f} |")
        lines.append("")
    lines += [
        f"Simulated windows of three years, {WINDOWS} of each kind:",
        "",
        "| noise | amplitude, µas | inside, % | detected, % |",
        "|---|---:|---:|---:|",
    ]
    for name, parts in NOISES.items():
        for amplitude in AMPLITUDES:
            held, seen = windows(parts, amplitude)
            lines.append(
                f"| {name} | {1000 * amplitude:.0f} | {100 * held:.1f} | {100 * seen:.1f} |"
            )
    held, bias, width, refused = periods()
    lines += [
        "",
        f"Simulated series of 42 years, {SERIES} of them, with a core nutation that random "
        f"excitation changes: the interval of the period contains the truth in {100 * held:.0f} % "
        f"(median half-width {width:.1f} d, bias {bias:+.1f} d, {refused} refused).",
    ]
    return "\n".join(lines) + "\n"


def main(arguments: argparse.Namespace) -> int:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8")
    print(f"wrote {PAGE.name}")
    return 0

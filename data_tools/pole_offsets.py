"""Measure predictions of celestial pole offsets and errors of the free core nutation.

For docs/pole_offsets.md: predictions from past origins compared with C04, and how often the 95 %
intervals of amplitude and period contain the truth in simulated series.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from earthspin.constants import DAYS_PER_YEAR, UAS
from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import FloatArray
from earthspin.nutation import core_nutation
from earthspin.nutation.core_nutation import predict
from earthspin.sky.eop import PoleSeries, read_pole_offsets
from earthspin.wobble.observed import fit
from tests.nutation.simulated_offsets import NOISES, excited, noise

PAGE = Path(__file__).parent.parent / "docs" / "measured" / "pole-offsets.inc"
#: Days ahead.
HORIZONS = np.array([1, 10, 30, 90, 180, 365, 730])
#: Years of the targets: those in which the constants were chosen, and those that are scored.
CHOSEN, SCORED = (2003, 2015), (2015, 2026)
#: Days between origins.
EVERY = 10
AMPLITUDES = (0.0, 0.05, 0.2)  # mas
#: Simulated windows of each kind, and simulated series for the period.
WINDOWS, SERIES = 2000, 100


def mjd_of(year: float) -> float:
    """Modified Julian date of the start of a year."""
    return 51544.0 + (year - 2000) * DAYS_PER_YEAR


def scores(table: PoleSeries, years: tuple[int, int]) -> tuple[FloatArray, FloatArray]:
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
    inside = (table.mjd >= first) & (table.mjd < last - HORIZONS[-1])
    series = (table.mjd, table.x, table.y, table.x_error, table.y_error)
    errors, widths, last_ones, zeros = [], [], [], []
    for i in np.flatnonzero(inside & (np.arange(inside.size) % EVERY == 0)):
        known = [*(column[: i + 1] for column in series), table.mjd[i] + HORIZONS]
        values, half_widths = predict(*known)
        truth = eta[i + HORIZONS]
        errors.append(values - truth)
        widths.append(half_widths)
        last_ones.append(eta[i] - truth)
        zeros.append(truth)
    absolute = [np.abs(e).mean(axis=(0, 2)) for e in (errors, last_ones, zeros)]
    share = (np.abs(errors) <= np.array(widths)).mean(axis=(0, 2))
    return np.stack([*absolute, np.mean(widths, axis=(0, 2))], axis=1) / UAS, share


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


def main() -> int:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8")
    return 0

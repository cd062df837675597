"""Skill of the forecast of UT1 and of the length of day, and errors of rows of Bulletin A.

Releases of finals2000A are scored with the newest one. Their first seven days are those of
Bulletin A, so that only later days compare both forecasts. Hindcasts on C04 have no Bulletin A;
they are compared with least squares over ten years and autoregression.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from earthspin.numerics.arrays import FloatArray
from earthspin.questions.rotation_ahead import rotation_ahead
from earthspin.questions.zonal_tides import days_tdb, without_kernel
from earthspin.sky.universal_time import UniversalTime, read_universal_time
from earthspin.wobble.record import YEAR
from earthspin.wobble.state_space import burg
from earthspin.wobble.ut1_forecast import DAYS, NEWEST, SKILL

HORIZONS = (1, 2, 3, 4, 5, 6, 7, 10, 20, 30, 60, 90, 180, 365)
#: Years and order of least squares with autoregression.
YEARS, ORDER = 10, 40
#: Releases whose forecasts are compared, and the same without Bulletin A.
RELEASED, ALONE = "releases", "releases, observations alone"
#: Number of resamplings for the interval of a ratio.
DRAWS = 2000


@dataclass(frozen=True)
class Scores:
    """Errors by origin and horizon, ms; NaN where nothing was observed later.

    Attributes
    ----------
    ut1, half_width, other : array, shape (n, h)
        Error of UT1, its 95 % half-width, and error of the other forecast.
    day, day_half_width : array, shape (n, h)
        The same of the length of day.
    """

    ut1: FloatArray
    half_width: FloatArray
    other: FloatArray
    day: FloatArray
    day_half_width: FloatArray


def _column(table: UniversalTime, values: FloatArray, mjd: FloatArray) -> FloatArray:
    """Values of a daily table on modified Julian dates, ms; NaN after its end."""
    places = np.round(mjd - table.mjd[0]).astype(int)
    inside = np.minimum(places, values.size - 1)
    return 1e3 * np.where(places < values.size, values[inside], np.nan)


def score(
    table: UniversalTime, truth: UniversalTime, last: float, bulletin_a: bool, usual: bool
) -> list[FloatArray]:
    """Score one forecast: the rows of `Scores`."""
    ahead = rotation_ahead(table, last, last + HORIZONS[-1], bulletin_a)
    rows = np.array(HORIZONS) - 1
    mjd = ahead.mjd[rows]
    true = _column(truth, truth.ut1_minus_tai, mjd)
    if usual:
        other = least_squares(ahead.observed, HORIZONS[-1])[rows]
    else:
        other = _column(table, table.ut1_minus_tai, mjd)
    return [
        1e3 * ahead.ut1_minus_tai[0, rows] - true,
        1e3 * ahead.ut1_minus_tai[1, rows],
        other - true,
        1e3 * ahead.length_of_day[0, rows] - _column(truth, truth.length_of_day, mjd),
        1e3 * ahead.length_of_day[1, rows],
    ]


def least_squares(observed: UniversalTime, days: int) -> FloatArray:
    """Forecast UT1 - TAI by a line, circles of a year and parts, and an autoregression, ms."""
    count = round(YEARS * YEAR)
    mjd = observed.mjd[-1] + np.arange(1.0 - count, days + 1)
    days_of = days_tdb(mjd)
    tide = 1e3 * without_kernel(days_of[0], days_of[-1]).ut1(days_of)[0][:, 0]
    time = (mjd - observed.mjd[-1]) / YEAR
    turns = 2 * np.pi * np.outer(time, [1, 2, 3])
    design = np.column_stack([np.ones_like(time), time, np.cos(turns), np.sin(turns)])
    u = 1e3 * observed.ut1_minus_tai[-count:] - tide[:count]
    fitted = design @ np.linalg.lstsq(design[:count], u, rcond=None)[0]
    coefficients = burg(residual := u - fitted[:count], ORDER)[1:].real
    values = list(residual[-ORDER:])
    for _ in range(days):
        values.append(-np.dot(coefficients, values[: -ORDER - 1 : -1]))
    return np.asarray(fitted[count:] + tide[count:] + values[ORDER:])


def of_c04(origins: FloatArray) -> Scores:
    """Scores of hindcasts on C04."""
    table = read_universal_time("c04")
    rows = [score(table, table, origin, bulletin_a=False, usual=True) for origin in origins]
    return Scores(*np.swapaxes(rows, 0, 1))


def tables_of(files: Iterable[Path]) -> tuple[list[UniversalTime], UniversalTime]:
    """Tables of releases with different newest rows, and the newest one, observed rows alone."""
    tables: dict[float, UniversalTime] = {}
    for file in files:
        table = read_universal_time(file)
        tables.setdefault(float(table.mjd[~table.predicted][-1]), table)
    ordered = [tables[last] for last in sorted(tables)]
    newest = ordered.pop()
    return ordered, newest.only(~newest.predicted)


def of_releases(tables: list[UniversalTime], truth: UniversalTime, bulletin_a: bool) -> Scores:
    """Scores of releases, the other forecast being that of Bulletin A."""
    rows = [
        score(table, truth, table.mjd[~table.predicted][-1], bulletin_a, usual=False)
        for table in tables
    ]
    return Scores(*np.swapaxes(rows, 0, 1))


def numbers(name: str, scores: Scores) -> list[dict[str, Any]]:
    """Skill by horizon, ms."""
    rows = []
    for k, horizon in enumerate(HORIZONS):
        known = np.isfinite(scores.ut1[:, k] + scores.other[:, k])
        both = np.isfinite(scores.day[:, k])
        error, day = scores.ut1[known, k], scores.day[both, k]
        cells = {
            "mae": abs(error).mean(),
            "rms": np.sqrt((error**2).mean()),
            "coverage": np.mean(abs(error) <= scores.half_width[known, k]),
            "half_width": scores.half_width[known, k].mean(),
            "other_mae": abs(scores.other[known, k]).mean(),
            "other_rms": np.sqrt((scores.other[known, k] ** 2).mean()),
            "day_mae": abs(day).mean(),
            "day_coverage": np.mean(abs(day) <= scores.day_half_width[both, k]),
        }
        rounded = {column: round(float(value), 3) for column, value in cells.items()}
        rows.append({"set": name, "horizon": horizon, "origins": int(known.sum())} | rounded)
    return rows


def table_of(name: str, rows: list[dict[str, Any]]) -> str:
    """Table of the page."""
    other = "Bulletin A" if name.startswith(RELEASED) else "least squares + AR"
    lines = [
        f"**{name}**",
        "",
        f"| days | origins | UT1: MAE (ms) | {other} MAE | ratio | RMS | {other} RMS | coverage "
        "| half-width | length of day: MAE (ms) | coverage |",
        "|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|",
    ]
    for row in rows:
        cells = [row["mae"], row["other_mae"], row["mae"] / row["other_mae"], row["rms"]]
        cells += [row["other_rms"], row["coverage"], row["half_width"]]
        cells += [row["day_mae"], row["day_coverage"]]
        shown = " | ".join(f"{value:.3g}" for value in cells)
        lines.append(f"| {row['horizon']} | {row['origins']} | {shown} |")
    return "\n".join([*lines, ""])


def ratios(scores: Scores, origins: FloatArray) -> str:
    """Table of the ratio to Bulletin A by year of origin, with an interval by resampled blocks.

    Forecasts h days ahead from origins less than h days apart share most of their error, so that
    blocks of h days are resampled together.
    """
    years = 1 + ((origins - origins[0]) // YEAR).astype(int)
    names = [f"year {year}" for year in range(1, years.max() + 1)]
    lines = ["| days | ratio | 95 % interval | correlation of errors | " + " | ".join(names) + " |"]
    lines.append("|---:|---:|---:|---:|" + "---:|" * len(names))
    generator = np.random.default_rng(1)
    for k, horizon in enumerate(HORIZONS):
        if horizon <= DAYS:
            continue
        known = np.isfinite(scores.ut1[:, k] + scores.other[:, k])
        pair = np.array([scores.ut1[known, k], scores.other[known, k]])
        count, size = pair.shape[1], np.diff(origins[known]).mean()
        length = min(max(1, round(horizon / size)), count)
        starts = generator.integers(count, size=(DRAWS, -(-count // length)))
        rows = (starts[..., None] + np.arange(length)).reshape(DRAWS, -1)[:, :count] % count
        drawn = abs(pair[:, rows]).mean(axis=2)
        low, high = np.quantile(drawn[0] / drawn[1], (0.025, 0.975))
        mean = abs(pair).mean(axis=1)
        cells = [f"{mean[0] / mean[1]:.2f}", f"{low:.2f} to {high:.2f}"]
        cells.append(f"{np.corrcoef(pair)[0, 1]:.2f}")
        for year in range(1, years.max() + 1):
            part = abs(pair[:, years[known] == year]).mean(axis=1) if year in years[known] else None
            cells.append("" if part is None else f"{part[0] / part[1]:.2f}")
        lines.append(f"| {horizon} | {' | '.join(cells)} |")
    return "\n".join([*lines, ""])


def bulletin_a(tables: list[UniversalTime], truth: UniversalTime) -> str:
    """Table of root mean square errors of Bulletin A by day, and of the newest observed rows."""
    errors, days, revised = [], [], []
    for table in tables:
        last = int(np.flatnonzero(~table.predicted)[-1])
        rows = slice(last - NEWEST.size + 1, last + DAYS + 2)
        mjd, ut1 = table.mjd[rows], 1e3 * table.ut1_minus_tai[rows]
        error = ut1 - _column(truth, truth.ut1_minus_tai, mjd)
        revised.append(error[: NEWEST.size])
        errors.append(error[NEWEST.size : -1])
        day = (ut1[NEWEST.size - 1 : -2] - ut1[NEWEST.size + 1 :]) / 2
        days.append(day - _column(truth, truth.length_of_day, mjd[NEWEST.size : -1]))
    known = np.isfinite(np.sum(errors, axis=1) + np.sum(days, axis=1))
    error, day = np.array(errors)[known], np.array(days)[known]
    change = error[:, -1] - error[:, -2]
    rms = [np.sqrt((values**2).mean(axis=0)) for values in (error, day, np.array(revised))]
    words = ["UT1 (ms)", "length of day (ms)"]
    lines = [f"| root mean square | {' | '.join(f'day {k + 1}' for k in range(DAYS))} |"]
    lines.append("|---|" + "---:|" * DAYS)
    for word, values in zip(words, rms, strict=False):
        lines.append(f"| {word} | {' | '.join(f'{value:.3f}' for value in values)} |")
    power = np.sqrt((change**2).mean())
    correlation = (error[:, -1] * change).mean() / power / rms[0][-1]
    newest = ", ".join(f"{value:.3f}" for value in rms[2][::-1])
    lines += [
        "",
        f"{known.sum()} releases. UT1 of day 7 minus that of day 6: {power:.3f} ms, with the "
        f"correlation {correlation:.2f} with UT1 of day 7. Observed rows, the newest first, minus "
        f"the values to which they are revised: {newest} ms.",
        "",
    ]
    return "\n".join(lines)


def measure(files: Iterable[Path], origins: FloatArray, middle: float, pages: Path) -> None:
    """Measure, and write the table that the package ships and those of the page."""
    tables, truth = tables_of(files)
    last = np.array([table.mjd[~table.predicted][-1] for table in tables])
    (pages / "forecast-bulletin-a.inc").write_text(bulletin_a(tables, truth), encoding="utf-8")
    released = of_releases(tables, truth, bulletin_a=True)
    (pages / "forecast-ut1-ratio.inc").write_text(ratios(released, last), encoding="utf-8")
    sets = {
        "C04 2005-2013": of_c04(origins[origins < middle]),
        "C04 2014-2025": of_c04(origins[origins >= middle]),
        RELEASED: released,
        ALONE: of_releases(tables, truth, bulletin_a=False),
    }
    rows = {name: numbers(name, scores) for name, scores in sets.items()}
    text = ",\n".join(json.dumps(row) for name in rows for row in rows[name])
    SKILL.write_text(f"[\n{text}\n]\n", encoding="utf-8")
    page = "\n".join(table_of(name, rows_of) for name, rows_of in rows.items())
    (pages / "forecast-ut1-skill.inc").write_text(page, encoding="utf-8")

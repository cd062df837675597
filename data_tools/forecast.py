"""Skill of the forecast of pole and UT1: hindcasts, and releases of the tables with Bulletin A.

Hindcasts use C04 with origins from 2005 to 2025, beside least squares with autoregression. Releases
of astropy-iers-data, about one a week, hold what Bulletin A predicted at the time; pip downloads
them, one after the other, into a folder that later runs use again. If a folder is given, the files
finals2000A-*.all in it are used, and nothing is downloaded.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import time
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from data_tools import ut1_forecast
from earthspin.constants import MAS, NORMAL_95
from earthspin.errors import SceneError
from earthspin.numerics.arrays import FloatArray
from earthspin.sky.eop import PoleSeries, read_bulletin_a, read_polar_motion
from earthspin.wobble.forecast import SKILL, forecast
from tests.benchmarks.accuracy.forecast import usual

HORIZONS = (1, 2, 3, 5, 10, 30, 90, 180, 365, 730)
#: Horizon up to which coverage is also counted over all horizons together, d.
SHORT = 30
#: Modified Julian dates of 2005-01-01, 2014-01-01 and 2026-01-01, and days between origins.
FIRST, MIDDLE, LAST, EVERY = 53371, 56658, 61041, 30
ORIGINS = np.arange(float(FIRST), LAST, EVERY)
#: Years of the least squares of the usual way.
USUAL_YEARS = 8.0
#: Modified Julian date of 2024-01-01. The bias of the newest row and the treatment of innovations
#: were chosen on releases before it; names of both sets of releases.
CHOSEN, CHOSEN_ON, RELEASED = 60310, "releases of 2023", "releases"
PACKAGE = "astropy-iers-data"
RELEASES = Path.home() / ".cache" / "earthspin" / PACKAGE
PAGES = Path(__file__).parent.parent / "docs" / "measured"
SKILL_PAGE = PAGES / "forecast-skill.inc"
CORRELATION_PAGE = PAGES / "forecast-correlation.inc"
NEWEST_PAGE = PAGES / "forecast-newest.inc"
#: Squared radius of an ellipse of 95 %.
ELLIPSE = -2 * np.log(0.05)


def pole(table: PoleSeries) -> Any:
    """Return x - i y in mas."""
    return (table.x - 1j * table.y) / MAS


def at_horizons(values: Any) -> FloatArray:
    """Coordinates x and y at the horizons, NaN beyond the last day."""
    rows = np.full((len(HORIZONS), 2), np.nan)
    for row, day in zip(rows, HORIZONS, strict=True):
        if day <= len(values):
            row[:] = values[day - 1].real, -values[day - 1].imag
    return rows


def hindcasts() -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Origins, errors, covariances, and errors of least squares + AR, from C04."""
    table = read_polar_motion("c04")
    p = pole(table)
    origins = np.arange(FIRST, min(LAST, int(table.mjd[-1]) - 1), EVERY)
    errors, spread, others = [], [], []
    for origin in origins:
        after = int(np.searchsorted(table.mjd, origin)) + 1
        truth = at_horizons(p[after:])
        ahead = forecast(p[:after], HORIZONS[-1])
        errors.append(at_horizons(ahead.pole) - truth)
        spread.append(ahead.covariance[np.array(HORIZONS) - 1])
        others.append(at_horizons(usual(p[:after], HORIZONS[-1], USUAL_YEARS)) - truth)
    return origins.astype(float), np.array(errors), np.array(spread), np.array(others)


def versions() -> list[str]:
    """Versions of astropy-iers-data, the oldest first, from pip."""
    words = [sys.executable, "-m", "pip", "index", "versions", PACKAGE]
    text = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    (line,) = re.findall(r"Available versions: (.*)", text)
    return list(reversed(line.split(", ")))


def downloaded(folder: Path) -> list[Path]:
    """Files finals2000A.all of the releases, the newest last."""
    folder.mkdir(parents=True, exist_ok=True)
    files = [folder / f"finals2000A-{version}.all" for version in versions()]
    for file in files:
        if file.exists():
            continue
        version = file.stem.removeprefix("finals2000A-")
        with TemporaryDirectory() as place:
            words = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps"]
            subprocess.run([*words, "--dest", place, f"{PACKAGE}=={version}"], check=True)
            (wheel,) = Path(place).glob("*.whl")
            with zipfile.ZipFile(wheel) as content:
                file.write_bytes(content.read("astropy_iers_data/data/finals2000A.all"))
        time.sleep(1)
    return files


@dataclass(frozen=True)
class Release:
    """Observed and predicted polar motion of one release, and what was observed later.

    Attributes
    ----------
    origin : float
        Modified Julian date of the newest observed row.
    p, bulletin : complex array, shapes (n,) and (m,)
        Observed pole, and the one that Bulletin A predicts, mas.
    revised, later : complex array, shapes (n,) and (k,)
        Pole on the days of `p` and after them in the newest release.
    """

    origin: float
    p: Any
    bulletin: Any
    revised: Any
    later: Any


def of_folder(folder: Path) -> list[Path]:
    """Files finals2000A-VERSION.all of a folder, the newest last."""
    files = folder.glob("finals2000A-*.all")
    return sorted(files, key=lambda file: [int(part) for part in re.findall(r"\d+", file.stem)])


def releases(files: list[Path]) -> Iterator[Release]:
    """Releases with different newest rows, the oldest first."""
    observed = read_polar_motion(files[-1])
    truth, known = pole(observed), -np.inf
    for file in files:
        table, bulletin = read_polar_motion(file), read_bulletin_a(file)
        origin = float(table.mjd[-1])
        after = int(np.searchsorted(observed.mjd, origin)) + 1
        if bulletin is None or after >= truth.size or origin <= known:
            continue
        known, p = origin, pole(table)
        yield Release(origin, p, pole(bulletin), truth[after - p.size : after], truth[after:])


def of_releases(every: list[Release]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Errors and covariances on the releases, and errors of Bulletin A."""
    errors, spread, others = [], [], []
    for release in every:
        ahead, later = forecast(release.p, HORIZONS[-1], newest=True), at_horizons(release.later)
        errors.append(at_horizons(ahead.pole) - later)
        spread.append(ahead.covariance[np.array(HORIZONS) - 1])
        others.append(at_horizons(release.bulletin) - later)
    return np.array(errors), np.array(spread), np.array(others)


def newest_rows(sets: dict[str, list[Release]]) -> str:
    """Table of the last rows of releases, minus the values to which they were revised."""
    lines = ["| set | releases | row | x (mas) | y (mas) |", "|---|---:|---|---:|---:|"]
    for name, every in sets.items():
        for back, row in ((1, "newest"), (2, "one day earlier"), (6, "five days earlier")):
            change = np.array([release.p[-back] - release.revised[-back] for release in every])
            cells = [
                f"{values.mean():+.3f} ± {values.std() / np.sqrt(values.size):.3f}, "
                f"s.d. {values.std():.3f}".replace("-", "−")
                for values in (change.real, -change.imag)
            ]
            lines.append(f"| {name} | {change.size} | {row} | {' | '.join(cells)} |")
    return "\n".join([*lines, ""])


def inside_ellipse(errors: FloatArray, spread: FloatArray) -> Any:
    """Return True for each error inside the 95 % ellipse of its covariance."""
    return np.einsum("ni,nij,nj->n", errors, np.linalg.inv(spread), errors) <= ELLIPSE


def numbers(
    name: str, errors: FloatArray, spread: FloatArray, others: FloatArray
) -> list[dict[str, Any]]:
    """Skill by horizon, a row for each at which both forecasts can be compared."""
    rows, widths = [], NORMAL_95 * np.sqrt(np.diagonal(spread, axis1=-2, axis2=-1))
    for k, day in enumerate(HORIZONS):
        known = np.isfinite(errors[:, k] + others[:, k]).all(axis=1)
        if not known.any():
            continue
        error = errors[known, k]
        columns = {
            "mae": abs(error).mean(axis=0),
            "rms": np.sqrt((error**2).mean(axis=0)),
            "coverage": (abs(error) <= widths[known, k]).mean(axis=0),
            "other_mae": abs(others[known, k]).mean(axis=0),
            "half_width": widths[known, k].mean(axis=0),
        }
        rounded = {column: [round(float(v), 3) for v in pair] for column, pair in columns.items()}
        ellipse = round(float(inside_ellipse(error, spread[known, k]).mean()), 3)
        cells = {"set": name, "horizon": day, "origins": int(known.sum()), "ellipse": ellipse}
        rows.append(cells | rounded)
    return rows


def table(name: str, rows: list[dict[str, Any]]) -> str:
    """Table of the page."""
    other = "Bulletin A" if name.startswith(RELEASED) else "least squares + AR"
    lines = [f"**{name}**", ""]
    lines.append(
        "| days | origins | MAE x, y (mas) | RMS x, y | coverage x, y, ellipse "
        f"| half-width x, y | {other} MAE x, y |"
    )
    lines.append("|---|---|---|---|---|---|---|")
    for row in rows:
        cells = [str(row["horizon"]), str(row["origins"])]
        row = row | {"coverage": [*row["coverage"], row["ellipse"]]}
        for column in ("mae", "rms", "coverage", "half_width", "other_mae"):
            cells.append(", ".join(f"{value:.2f}" for value in row[column]))
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join([*lines, ""])


def correlations(scores: dict[str, tuple[FloatArray, FloatArray]]) -> str:
    """Table of the correlation of the errors of x and y, claimed and measured."""
    lines = [
        "| days ahead | "
        + " | ".join(f"{name}: claimed | measured | standard error" for name in scores)
        + " |",
        "|---:|" + "---:|" * 3 * len(scores),
    ]
    for k, day in enumerate(HORIZONS):
        cells = [str(day)]
        for errors, spread in scores.values():
            known = np.isfinite(errors[:, k]).all(axis=1)
            if not known.any():
                cells += ["", "", ""]
                continue
            error, covariance = errors[known, k], spread[known, k]
            claimed = covariance[:, 0, 1] / np.sqrt(covariance[:, 0, 0] * covariance[:, 1, 1])
            measured = np.mean(error[:, 0] * error[:, 1]) / np.sqrt(
                np.prod((error**2).mean(axis=0))
            )
            cells += [f"{claimed.mean():.2f}", f"{measured:.2f}", f"{1 / np.sqrt(len(error)):.2f}"]
        lines.append(f"| {' | '.join(cells)} |".replace("-", "−"))
    return "\n".join([*lines, ""])


def pooled(name: str, errors: FloatArray, spread: FloatArray) -> str:
    """Sentence on the coverage of all horizons up to 30 d together."""
    short = [k for k, day in enumerate(HORIZONS) if day <= SHORT]
    error, covariance = errors[:, short].reshape(-1, 2), spread[:, short].reshape(-1, 2, 2)
    known = np.isfinite(error).all(axis=1)
    error, covariance = error[known], covariance[known]
    half_width = NORMAL_95 * np.sqrt(np.diagonal(covariance, axis1=1, axis2=2))
    x, y = 100 * (abs(error) <= half_width).mean(axis=0)
    ellipse = 100 * inside_ellipse(error, covariance).mean()
    return (
        f"From 1 to {SHORT} days together, {name}: x {x:.1f} %, y {y:.1f} %, ellipse "
        f"{ellipse:.1f} % of {len(error)}.\n"
    )


def main(folder: str | None = None) -> int:
    """Measure, and write the tables that the package ships and those of the page."""
    files = downloaded(RELEASES) if folder is None else of_folder(Path(folder))
    if len(files) < 2:
        raise SceneError("folder", folder, "it holds no two files finals2000A-VERSION.all")
    ut1_forecast.measure(files, ORIGINS, MIDDLE, PAGES)
    every = list(releases(files))
    sets_of_releases = {
        CHOSEN_ON: [release for release in every if release.origin < CHOSEN],
        RELEASED: [release for release in every if release.origin >= CHOSEN],
    }
    NEWEST_PAGE.write_text(newest_rows(sets_of_releases), encoding="utf-8")
    origins, *scores = hindcasts()
    early = origins < MIDDLE
    scored = {
        "C04 2005-2013": [score[early] for score in scores],
        "C04 2014-2025": [score[~early] for score in scores],
        "C04 2005-2025": scores,
        **{name: list(of_releases(every)) for name, every in sets_of_releases.items()},
    }
    sets = {name: numbers(name, *values) for name, values in scored.items()}
    rows = [json.dumps(row) for name in sets for row in sets[name]]
    SKILL.write_text("[\n" + ",\n".join(rows) + "\n]\n", encoding="utf-8")
    page = "\n".join(table(name, rows_of) for name, rows_of in sets.items())
    together = [pooled(name, *scored[name][:2]) for name in ("C04 2014-2025", CHOSEN_ON, RELEASED)]
    SKILL_PAGE.write_text("\n".join([page, *together]), encoding="utf-8")
    columns = {"hindcasts": "C04 2005-2025", "releases": RELEASED}
    correlated = {word: (scored[name][0], scored[name][1]) for word, name in columns.items()}
    CORRELATION_PAGE.write_text(correlations(correlated), encoding="utf-8")
    return 0

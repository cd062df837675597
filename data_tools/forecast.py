"""Skill of the forecast of the pole: hindcasts, and releases of the tables with Bulletin A.

Hindcasts use C04 with origins from 2005 to 2025, beside least squares with autoregression. Monthly
releases of astropy-iers-data hold what Bulletin A predicted at the time; pip downloads them, one
after the other, into a folder that later runs use again.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import time
import zipfile
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import MAS, NORMAL_95
from earthspin.sky.eop import PoleSeries, read_bulletin_a, read_polar_motion
from earthspin.wobble.forecast import SKILL, forecast
from tests.benchmarks.accuracy.forecast import usual

Array = NDArray[np.float64]
HORIZONS = (1, 3, 5, 10, 30, 90, 180, 365, 730)
#: Modified Julian dates of 2005-01-01, 2014-01-01 and 2026-01-01, and days between origins.
FIRST, MIDDLE, LAST, EVERY = 53371, 56658, 61041, 30
#: Years of the least squares of the usual way.
USUAL_YEARS = 8.0
#: Name of the set of releases.
RELEASED = "releases"
PACKAGE = "astropy-iers-data"
RELEASES = Path.home() / ".cache" / "earthspin" / PACKAGE
PAGES = Path(__file__).parent.parent / "docs" / "measured"
SKILL_PAGE = PAGES / "forecast-skill.inc"
CORRELATION_PAGE = PAGES / "forecast-correlation.inc"
#: Horizons of the table of correlations, and squared radius of an ellipse of 95 %.
CORRELATED, ELLIPSE = (5, 10, 30, 90, 365), -2 * np.log(0.05)


def pole(table: PoleSeries) -> Any:
    """Return x - i y in mas."""
    return (table.x - 1j * table.y) / MAS


def at_horizons(values: Any) -> Array:
    """Coordinates x and y at the horizons, NaN beyond the last day."""
    rows = np.full((len(HORIZONS), 2), np.nan)
    for row, day in zip(rows, HORIZONS, strict=True):
        if day <= len(values):
            row[:] = values[day - 1].real, -values[day - 1].imag
    return rows


def hindcasts() -> tuple[Array, Array, Array, Array]:
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


def monthly() -> list[str]:
    """Versions of the first release of each month, from pip."""
    words = [sys.executable, "-m", "pip", "index", "versions", PACKAGE]
    text = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    (line,) = re.findall(r"Available versions: (.*)", text)
    versions = line.split(", ")
    by_month = {tuple(version.split(".")[1:3]): version for version in versions}
    return list(by_month.values())


def releases(folder: Path) -> Iterator[Path]:
    """Files finals2000A.all of the monthly releases, the newest last."""
    folder.mkdir(parents=True, exist_ok=True)
    for version in reversed(monthly()):
        name = f"{PACKAGE.replace('-', '_')}-{version}-py3-none-any.whl"
        if not (folder / name).exists():
            words = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps"]
            subprocess.run([*words, "--dest", str(folder), f"{PACKAGE}=={version}"], check=True)
            time.sleep(1)
        with zipfile.ZipFile(folder / name) as wheel, TemporaryDirectory() as place:
            yield Path(wheel.extract("astropy_iers_data/data/finals2000A.all", place))


def of_releases(folder: Path) -> tuple[Array, Array, Array]:
    """Errors and covariances on the releases, and errors of Bulletin A."""
    observed = read_polar_motion("finals")
    truth = pole(observed)
    errors, spread, others = [], [], []
    for file in releases(folder):
        table, bulletin = read_polar_motion(file), read_bulletin_a(file)
        after = int(np.searchsorted(observed.mjd, table.mjd[-1])) + 1
        if bulletin is None or after >= truth.size:
            continue
        ahead = forecast(pole(table), HORIZONS[-1])
        later = at_horizons(truth[after:])
        errors.append(at_horizons(ahead.pole) - later)
        spread.append(ahead.covariance[np.array(HORIZONS) - 1])
        others.append(at_horizons(pole(bulletin)) - later)
    return np.array(errors), np.array(spread), np.array(others)


def numbers(name: str, errors: Array, spread: Array, others: Array) -> list[dict[str, Any]]:
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
        }
        rounded = {column: [round(float(v), 3) for v in pair] for column, pair in columns.items()}
        rows.append({"set": name, "horizon": day, "origins": int(known.sum())} | rounded)
    return rows


def table(name: str, rows: list[dict[str, Any]]) -> str:
    """Table of the page."""
    other = "Bulletin A" if name == RELEASED else "least squares + AR"
    lines = [f"**{name}**", ""]
    lines.append(f"| days | origins | MAE x, y (mas) | RMS x, y | coverage x, y | {other} x, y |")
    lines.append("|---|---|---|---|---|---|")
    for row in rows:
        cells = [str(row["horizon"]), str(row["origins"])]
        for column in ("mae", "rms", "coverage", "other_mae"):
            cells.append(", ".join(f"{value:.2f}" for value in row[column]))
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join([*lines, ""])


def correlations(errors: Array, spread: Array) -> str:
    """Table of the correlation of the errors of x and y, claimed and measured."""
    lines = [
        f"| days ahead | claimed | measured (± {1 / np.sqrt(len(errors)):.2f}) "
        "| observed pole inside the 95 % ellipse |",
        "|---:|---:|---:|---:|",
    ]
    for day in CORRELATED:
        k = HORIZONS.index(day)
        known = np.isfinite(errors[:, k]).all(axis=1)
        error, covariance = errors[known, k], spread[known, k]
        claimed = covariance[:, 0, 1] / np.sqrt(covariance[:, 0, 0] * covariance[:, 1, 1])
        measured = np.mean(error[:, 0] * error[:, 1]) / np.sqrt(np.prod((error**2).mean(axis=0)))
        inside = np.einsum("ni,nij,nj->n", error, np.linalg.inv(covariance), error) <= ELLIPSE
        cells = f"{day} | {claimed.mean():.2f} | {measured:.2f} | {100 * inside.mean():.0f} %"
        lines.append(f"| {cells.replace('-', '−')} |")
    return "\n".join([*lines, ""])


def main() -> int:
    """Measure, and write the table that the package ships and those of the page."""
    origins, *scores = hindcasts()
    early = origins < MIDDLE
    scored = {
        "C04 2005-2013": [score[early] for score in scores],
        "C04 2014-2025": [score[~early] for score in scores],
        "C04 2005-2025": scores,
        RELEASED: list(of_releases(RELEASES)),
    }
    sets = {name: numbers(name, *values) for name, values in scored.items()}
    rows = [json.dumps(row) for name in sets for row in sets[name]]
    SKILL.write_text("[\n" + ",\n".join(rows) + "\n]\n", encoding="utf-8")
    page = "\n".join(table(name, rows_of) for name, rows_of in sets.items())
    SKILL_PAGE.write_text(page, encoding="utf-8")
    CORRELATION_PAGE.write_text(correlations(scores[0], scores[1]), encoding="utf-8")
    return 0

"""Observed polar motion, read from files.

Known tables of the IERS: C04 (daily, from 1962), C01 (from 1846, ten rows per year, twenty since
1890) and finals2000A (daily, with predictions, which are ignored). C04 is included in astropy;
nothing is downloaded. Invalid rows raise an error that gives the line; defects with an unambiguous
correction are repaired and reported.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import ARCSEC
from earthspin.errors import SeriesError
from earthspin.sky.columns import (
    check_calendar,
    checksum,
    is_number,
    lines_of,
    numbers,
    rows_of,
    starts_with_number,
    text_between,
)

Array = NDArray[np.float64]

#: Largest valid polar motion, arcsec; it has never exceeded 0.7, so larger values have another unit
#: or are from another column.
LARGEST = 2.0
#: Smallest valid maximum of polar motion, arcsec; smaller values have another unit.
SMALLEST = 1e-3
#: Largest motion of the pole in a day, arcsec, and additional tolerance for a jump, arcsec.
FASTEST, JUMP = 0.01, 0.1
#: Longest gap that is interpolated linearly, in steps and in days; the oldest tables have ten rows
#: per year.
LONGEST_BRIDGE, LONGEST_DAYS = 10, 37.0
#: Largest fraction of rows without numbers that is ignored; one such row is always ignored.
LOST = 0.01
#: Tolerance of evenly spaced dates, as a fraction of a step.
DATE_ROUNDING = 1e-3
#: Period of the free wobble, used to report the error of interpolation, d.
FREE_WOBBLE = 433.0
#: By number of columns: index of the MJD, which x and y follow, and index of the error of x.
_C04_LAYOUTS = {16: (3, 10), 21: (4, 13)}
#: Number of columns of the table by date.
_C01_COLUMNS = 29
_ERRORS = ("x_error", "y_error")


@dataclass(frozen=True)
class PoleSeries:
    """Observed polar motion.

    Attributes
    ----------
    mjd : array, shape (n,)
        Modified Julian dates, evenly spaced; 0h UTC in daily tables.
    x, y : array, shape (n,)
        Coordinates of the pole, rad; x along the Greenwich meridian, y along 90 degrees west.
    x_error, y_error : array, shape (n,)
        Standard deviations from the file, rad.
    name : str
        Kind of table.
    repairs : str
        Description of repairs; empty if there are none.
    sha256 : str
        SHA-256 of the file.
    """

    mjd: Array
    x: Array
    y: Array
    x_error: Array
    y_error: Array
    name: str
    repairs: str = ""
    sha256: str = ""

    @property
    def provenance(self) -> dict[str, str]:
        """Checksum of the file, for the attributes of an answer."""
        return {"table_sha256": self.sha256}

    @property
    def step(self) -> float:
        """Spacing of the dates, d."""
        return float((self.mjd[-1] - self.mjd[0]) / (self.mjd.size - 1))

    def between(self, first: float, last: float) -> PoleSeries:
        """Part of the series between two dates, both included.

        Raises
        ------
        SeriesError
            If fewer than two rows are in between.
        """
        inside = (self.mjd >= first) & (self.mjd <= last)
        if np.count_nonzero(inside) < 2:
            start, end, *asked = (day_of(mjd) for mjd in (*self.mjd[[0, -1]], first, last))
            problem = f"it covers {start} to {end}; {asked[0]} to {asked[1]} was asked for"
            raise SeriesError(self.name, problem, "choose a span inside it")
        return replace(
            self, **{name: getattr(self, name)[inside] for name in ("mjd", "x", "y", *_ERRORS)}
        )


@dataclass(frozen=True)
class _Row:
    """One row of a file: date, x, y and their errors in arcseconds."""

    line: int
    mjd: float
    values: tuple[float, float, float, float]


def c04_path() -> Path:
    """Path of the C04 file included in astropy."""
    from astropy_iers_data import IERS_B_FILE

    return Path(IERS_B_FILE)


def read_polar_motion(path: str | Path = "c04", kind: str | None = None) -> PoleSeries:
    """Read polar motion from a file.

    Parameters
    ----------
    path : str or Path
        A file, or ``"c04"`` for the one included in astropy.
    kind : str, optional
        ``"c04"``, ``"c01"`` or ``"finals2000A"``; detected from the file by default.

    Raises
    ------
    SeriesError
        If the file is invalid; the message gives the line.
    """
    file = c04_path() if str(path) == "c04" else Path(path)
    lines = lines_of(file)
    kind = kind or _kind(file, lines)
    if kind not in _READERS:
        raise SeriesError(file, f"kind {kind!r} is unknown", f"allowed: {', '.join(_READERS)}")
    rows = list(_READERS[kind](file, lines))
    repairs: list[str] = []
    _check_dates(file, rows)
    rows = _drop_missing(file, rows, text_between(lines, _IS_ROW[kind]), repairs)
    if len(rows) < 2:
        raise SeriesError(file, f"it holds {len(rows)} rows of polar motion", "is it complete?")
    _check_size(file, rows)
    rows = _in_order(file, rows, repairs)
    _check_jumps(file, rows)
    return replace(_even(file, rows, kind, repairs), sha256=checksum(file))


# --- the kinds of table --------------------------------------------------------------------------


def _c04(file: Path, lines: list[str]) -> Iterator[_Row]:
    """Rows of C04: date, with hour (20 C04) or without (14 C04 and earlier), then MJD, x, y."""
    columns = 0
    for number, words in rows_of(lines):
        columns = columns or len(words)
        if len(words) != columns or columns not in _C04_LAYOUTS:
            allowed = " or ".join(map(str, _C04_LAYOUTS))
            remedy = (
                f"{allowed} are expected, as many in each row; is it cut off, or a column lost?"
            )
            raise SeriesError(file, f"{len(words)} columns", remedy, number)
        first, errors = _C04_LAYOUTS[columns]
        *calendar, mjd, x, y = numbers(file, number, words[: first + 3])
        check_calendar(file, number, [*calendar, 0.0][:4], mjd)
        x_error, y_error = numbers(file, number, words[errors : errors + 2])
        yield _Row(number, mjd, (x, y, x_error, y_error))


def _c01(file: Path, lines: list[str]) -> Iterator[_Row]:
    """Rows of C01, in the present format by MJD or the former format by Besselian years.

    By date: MJD, x, y, UT1-TAI, dX, dY, then their errors and 18 more columns. By year: decimal
    year, x, its error, y, its error.
    """
    columns = 0
    for number, words in rows_of(lines):
        columns = columns or len(words)
        if len(words) != columns or columns < 5:
            problem = f"{len(words)} columns"
            raise SeriesError(file, problem, "5 or more are expected, as many in each row", number)
        if columns == _C01_COLUMNS:
            mjd, x, y = numbers(file, number, words[:3])
            x_error, y_error = numbers(file, number, words[6:8])
        else:
            year, x, x_error, y, y_error = numbers(file, number, words[:5])
            if not 1800 <= year <= 2200:
                remedy = f"it lies in 1800 to 2200; a table by MJD has {_C01_COLUMNS} columns"
                raise SeriesError(file, f"the year is {year:g}", remedy, number)
            # Besselian years, accurate to the 1 mas resolution of this table.
            mjd = 15019.81352 + (year - 1900.0) * 365.242198781
        yield _Row(number, mjd, (x, y, x_error, y_error))


def _finals(file: Path, lines: list[str]) -> Iterator[_Row]:
    """Rows of finals2000A, with fixed columns; predictions ("P") and empty rows are ignored."""
    for number, line in enumerate(lines, start=1):
        if not line.strip() or line[16:17] != "I":
            continue
        if len(line.rstrip("\n")) < 55:
            raise SeriesError(file, "it ends early", "is the file cut off?", number)
        cells = (line[7:15], line[18:27], line[37:46], line[27:36], line[46:55])
        mjd, x, y, x_error, y_error = numbers(file, number, list(cells))
        year, month, day = numbers(file, number, [line[0:2], line[2:4], line[4:6]])
        # Two-digit years: 73 is 1973, and 72 is 2072.
        century = 1900 if year >= 73 else 2000
        check_calendar(file, number, [century + year, month, day, mjd % 1 * 24], mjd)
        yield _Row(number, mjd, (x, y, x_error, y_error))


_READERS: dict[str, Callable[[Path, list[str]], Iterator[_Row]]] = {
    "c04": _c04,
    "c01": _c01,
    "finals2000A": _finals,
}


def _is_row_of_finals(line: str) -> bool:
    """Whether a line has a flag and a date; beyond the predictions there is only the date."""
    return line[16:17] in ("I", "P") or (is_number(line[7:15]) and not line[15:].strip())


#: Test for rows, by kind of table.
_IS_ROW: dict[str, Callable[[str], bool]] = {
    "c04": starts_with_number,
    "c01": starts_with_number,
    "finals2000A": _is_row_of_finals,
}


def _kind(file: Path, lines: list[str]) -> str:
    """Detect the kind of table from the first row of numbers."""
    for line in lines:
        words = line.split()
        if not words or not is_number(words[0]):
            continue
        if len(line) > 60 and line[16:17] in ("I", "P"):
            return "finals2000A"
        if words[0].isdigit() and 1800 <= int(words[0]) <= 2200 and len(words) >= 6:
            return "c04"
        by_date = len(words) == _C01_COLUMNS
        if by_date or ("." in words[0] and 1800 <= float(words[0]) <= 2200):
            return "c01"
        break
    problem = "it is none of the known tables"
    raise SeriesError(file, problem, f"name its kind: {', '.join(_READERS)}")


# --- what can be wrong ---------------------------------------------------------------------------


def _drop_missing(file: Path, rows: list[_Row], text: list[int], repairs: list[str]) -> list[_Row]:
    """Remove lines of text between rows, and rows without a position; these become gaps."""
    complete = [row for row in rows if all(map(math.isfinite, (row.mjd, *row.values[:2])))]
    lost = sorted([*text, *({row.line for row in rows} - {row.line for row in complete})])
    if lost:
        if len(lost) > max(1, LOST * (len(complete) + len(lost))):
            problem = f"{len(lost)} of {len(complete) + len(lost)} rows hold no numbers"
            remedy = f"at most {LOST:.0%} are left out; is the file damaged?"
            raise SeriesError(file, problem, remedy, lost[0])
        repairs.append(f"{len(lost)} rows without numbers left out, the first in line {lost[0]}")
    return complete


def _check_dates(file: Path, rows: list[_Row]) -> None:
    for row in rows:
        if not math.isfinite(row.mjd):
            raise SeriesError(file, f"the date is {row.mjd}", "give each row a date", row.line)


def _check_size(file: Path, rows: list[_Row]) -> None:
    for row in rows:
        x, y, *errors = row.values
        if max(abs(x), abs(y)) > LARGEST:
            remedy = "polar motion stays below one; is it in milliarcseconds?"
            raise SeriesError(file, f"x, y = {x:g}, {y:g} arcsec", remedy, row.line)
        if min(errors) < 0:
            problem = f"errors of x, y = {errors[0]:g}, {errors[1]:g} arcsec"
            raise SeriesError(file, problem, "errors are not negative; is a column lost?", row.line)
    farthest = max(rows, key=lambda row: math.hypot(*row.values[:2]))
    if 0 < math.hypot(*farthest.values[:2]) < SMALLEST:
        problem = (
            f"x, y = {farthest.values[0]:g}, {farthest.values[1]:g} arcsec, and no more elsewhere"
        )
        remedy = f"the pole moves farther than {SMALLEST:g} arcsec; is it in radians?"
        raise SeriesError(file, problem, remedy, farthest.line)


def _check_jumps(file: Path, rows: list[_Row]) -> None:
    """Refuse a step larger than the motion of the pole and the stated errors allow."""
    for last, row in pairwise(rows):
        x, y = (abs(a - b) for a, b in zip(row.values[:2], last.values[:2], strict=True))
        days = row.mjd - last.mjd
        scatter = sum(error for error in (*last.values[2:], *row.values[2:]) if error > 0)
        if max(x, y) > JUMP + FASTEST * days + 3 * scatter:
            problem = f"the pole jumps by {x:.3g}, {y:.3g} arcsec in {days:.4g} d"
            remedy = f"it moves by less than {FASTEST:g} arcsec a day; is a digit wrong?"
            raise SeriesError(file, problem, remedy, row.line)


def _in_order(file: Path, rows: list[_Row], repairs: list[str]) -> list[_Row]:
    """Sort rows by date; remove equal rows of a date, and refuse different ones."""
    ordered = sorted(rows, key=lambda row: row.mjd)
    if ordered != rows:
        repairs.append("rows sorted by date")
    unique = ordered[:1]
    for row in ordered[1:]:
        if row.mjd > unique[-1].mjd + 1e-6:
            unique.append(row)
        elif row.values != unique[-1].values:
            problem = (
                f"MJD {row.mjd:.2f} stands twice, in line {unique[-1].line} with other numbers"
            )
            raise SeriesError(file, problem, "keep one of them", row.line)
    if len(unique) < len(ordered):
        repairs.append(f"{len(ordered) - len(unique)} repeated rows left out")
    return unique


def _even(file: Path, rows: list[_Row], kind: str, repairs: list[str]) -> PoleSeries:
    """Interpolate short gaps, refuse long ones, and halve the steps of older, coarser rows."""
    mjd = np.array([row.mjd for row in rows])
    values = np.array([row.values for row in rows]) * ARCSEC
    steps = np.diff(mjd)
    usual = float(np.median(steps))
    longest = int(np.argmax(steps))
    bridge = min(LONGEST_BRIDGE * usual, max(LONGEST_DAYS, usual)) * (1 + DATE_ROUNDING)
    if steps[longest] > bridge:
        problem = f"a gap of {steps[longest]:.1f} d follows MJD {mjd[longest]:.2f}"
        remedy = f"gaps up to {bridge:.0f} d are bridged; take a span on one side of it"
        raise SeriesError(file, problem, remedy, rows[longest].line)
    # Dates are rounded: the mean of all steps is more accurate than a single step.
    count = round((mjd[-1] - mjd[0]) / usual)
    whole = int(np.sum(np.round(steps / usual)))
    count = whole if abs(whole - count) <= DATE_ROUNDING * count else count
    even = np.linspace(mjd[0], mjd[-1], count + 1)
    step = float(even[1] - even[0])
    if even.size != mjd.size or np.max(abs(even - mjd)) > DATE_ROUNDING * step:
        cut = (math.pi * steps[longest] / FREE_WOBBLE) ** 2 / 2
        repairs.append(
            f"{max(even.size - mjd.size, 0)} missing steps bridged by straight lines, which cut "
            f"a wobble of {FREE_WOBBLE:g} d by up to {cut:.1%}"
        )
        values = np.column_stack([np.interp(even, mjd, column) for column in values.T])
    x, y, x_error, y_error = values.T
    return PoleSeries(even, x, y, x_error, y_error, kind, "; ".join(repairs))


def day_of(mjd: float) -> str:
    """Date of a modified Julian date, like ``"1962-01-01"``."""
    return str(np.datetime64("1858-11-17") + np.timedelta64(int(mjd // 1), "D"))

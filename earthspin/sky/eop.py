"""Observed polar motion and observed celestial pole offsets, read from files.

Known tables of the IERS: C04 (daily, from 1962), C01 (from 1846, ten rows per year, twenty since
1890) and finals2000A (daily, with predictions, which are ignored). C04 and finals2000A are included
in astropy; nothing is downloaded. Invalid rows raise an error that gives the line; defects with an
unambiguous correction are repaired and reported.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from pathlib import Path

import numpy as np

from earthspin.constants import ARCSEC
from earthspin.errors import SeriesError
from earthspin.numerics.arrays import ComplexArray, FloatArray
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

#: Longest gap that is interpolated linearly, in steps and in days; the oldest tables have ten rows
#: per year.
LONGEST_BRIDGE, LONGEST_DAYS = 10, 37.0
#: Largest fraction of rows without numbers that is ignored; one such row is always ignored.
LOST = 0.01
#: Tolerance of evenly spaced dates, as a fraction of a step.
DATE_ROUNDING = 1e-3
#: Period of the free wobble, used to report the error of interpolation, d.
FREE_WOBBLE = 433.0
#: Number of columns of the table C01 by date, and of that by year with celestial pole offsets.
_C01_COLUMNS, _C01_YEAR_COLUMNS = 29, 11
#: First day after the optical observations of the table C01, MJD of 1962-01-01.
_AFTER_OPTICAL = 37665.0
#: Offsets whose median distance from those of finals2000A is larger are from IAU 1980, arcsec: in
#: C04 it is 0.1 mas, and in each year of offsets from IAU 1980 at least 3.5 mas. It is taken over
#: days from 1984 on, MJD, since which C04 and finals2000A agree.
_ANOTHER_MODEL, _TWO_TABLES = 0.002, 45700.0
#: Largest offset that finals2000A does not confirm, arcsec.
_LARGEST_ELSEWHERE = 0.005
_ERRORS = ("x_error", "y_error")


@dataclass(frozen=True)
class _Coordinates:
    """Columns, unit and limits of polar motion or of celestial pole offsets in the IERS tables.

    Attributes
    ----------
    name, words : str
        Name of the two together, and of each, in messages.
    columns : dict of int to tuple of int
        By number of columns of a row: the columns of the MJD, of the first coordinate, which the
        second follows, and of the error of the first.
    flag : int
        Column of finals2000A that holds "I" if the row was observed and "P" if it was predicted.
    cells : tuple of slice
        First coordinate, second coordinate and their errors in a row of finals2000A.
    unit : float
        Unit of these cells, arcsec.
    largest, smallest : float
        Larger values, and tables whose largest value is smaller, are in another unit, arcsec.
    fastest, jump : float
        Largest motion in a day, and what is no jump yet beside it, arcsec.
    """

    name: str
    words: str
    columns: dict[int, tuple[int, int, int]]
    flag: int
    cells: tuple[slice, slice, slice, slice]
    unit: float
    largest: float
    smallest: float
    fastest: float
    jump: float


#: Polar motion has never passed 0.7 arcsec, and never stayed within a milliarcsecond of the origin.
_POLAR_MOTION = _Coordinates(
    "polar motion",
    "x, y",
    {16: (3, 4, 10), 21: (4, 5, 13), _C01_COLUMNS: (0, 1, 6)},
    flag=16,
    cells=(slice(18, 27), slice(37, 46), slice(27, 36), slice(46, 55)),
    unit=1.0,
    largest=2.0,
    smallest=1e-3,
    fastest=0.01,
    jump=0.1,
)
#: Offsets from IAU 2006/2000A have never passed 9 mas; those from IAU 1980 pass 20 mas since 1991.
_POLE_OFFSETS = _Coordinates(
    "celestial pole offsets",
    "dX, dY",
    {16: (3, 8, 14), 21: (4, 8, 16), _C01_COLUMNS: (0, 4, 9)},
    flag=95,
    cells=(slice(97, 106), slice(116, 125), slice(106, 115), slice(125, 134)),
    unit=1e-3,
    largest=0.02,
    smallest=1e-5,
    fastest=1e-4,
    jump=5e-3,
)
_NO_OPTICAL = "before 1962 they are optical; give a span that begins in 1962 or later"
_NOT_IAU_1980 = "offsets from IAU 2006/2000A are needed; are they from IAU 1980?"


@dataclass(frozen=True)
class PoleSeries:
    """Time series of observed polar motion, or of observed celestial pole offsets.

    Attributes
    ----------
    mjd : array, shape (n,)
        Modified Julian dates, evenly spaced; 0h UTC in daily tables.
    x, y : array, shape (n,)
        Coordinates of the pole, rad: x along the Greenwich meridian, y along 90 degrees west; or
        the celestial pole offsets dX, dY, added to X, Y of IAU 2006/2000A.
    x_error, y_error : array, shape (n,)
        Standard deviations from the file, rad.
    name : str
        Kind of table.
    repairs : str
        Description of repairs; empty if there are none.
    sha256 : str
        SHA-256 of the file.
    """

    mjd: FloatArray
    x: FloatArray
    y: FloatArray
    x_error: FloatArray
    y_error: FloatArray
    name: str
    repairs: str = ""
    sha256: str = ""

    @property
    def provenance(self) -> dict[str, str]:
        """SHA-256 hash of the file of the series, for the attributes of a result."""
        return {"table_sha256": self.sha256}

    @property
    def step(self) -> float:
        """Time between two successive dates of the series, d."""
        return float((self.mjd[-1] - self.mjd[0]) / (self.mjd.size - 1))

    @property
    def offsets(self) -> ComplexArray:
        """Celestial pole offsets as dX + i dY, rad, shape (n,)."""
        return np.asarray(self.x + 1j * self.y)

    def between(self, first: float, last: float) -> PoleSeries:
        """Select the part of the series from one date to another, both dates included.

        Raises
        ------
        SeriesError
            If fewer than two rows are in between.
        """
        inside = (self.mjd >= first) & (self.mjd <= last)
        if np.count_nonzero(inside) < 2:
            start, end, from_day, to_day = map(day_of, (*self.mjd[[0, -1]], first, last))
            problem = f"it covers {start} to {end}; {from_day} to {to_day} was asked for"
            raise SeriesError(self.name, problem, "choose a span inside it")
        return replace(
            self, **{name: getattr(self, name)[inside] for name in ("mjd", "x", "y", *_ERRORS)}
        )


@dataclass(frozen=True)
class _Row:
    """Date, two pole coordinates and their errors from one row of a file, arcsec."""

    line: int
    mjd: float
    values: tuple[float, float, float, float]


def c04_path() -> Path:
    """Path of the C04 file (IERS Earth orientation series) that is included in astropy."""
    from astropy_iers_data import IERS_B_FILE

    return Path(IERS_B_FILE)


def finals_path() -> Path:
    """Path of the finals2000A file (IERS rapid series) that is included in astropy."""
    from astropy_iers_data import IERS_A_FILE

    return Path(IERS_A_FILE)


#: Files that astropy carries, by name.
CARRIED = {"c04": c04_path, "finals": finals_path}


def file_of(path: str | Path) -> Path:
    """Return the path of a file; a short name such as "c04" gives the file included in astropy."""
    return CARRIED[str(path)]() if str(path) in CARRIED else Path(path)


def read_polar_motion(path: str | Path = "c04", kind: str | None = None) -> PoleSeries:
    """Read a time series of observed polar motion from a file.

    Parameters
    ----------
    path : str or Path
        A file, or ``"c04"`` or ``"finals"`` for those included in astropy.
    kind : str, optional
        ``"c04"``, ``"c01"`` or ``"finals2000A"``; detected from the file by default.

    Raises
    ------
    SeriesError
        If the file is invalid; the message gives the line.
    """
    return _read(path, kind, _POLAR_MOTION)


def read_pole_offsets(
    path: str | Path = "c04", kind: str | None = None, first: float = -math.inf
) -> PoleSeries:
    """Read a time series of observed celestial pole offsets dX, dY from a file.

    Rows that finals2000A flags as predicted in column 96, and the zeros with which C04 and C01
    begin, before there were observations, are left out.

    Parameters
    ----------
    path, kind
        As of `read_polar_motion`.
    first : float
        Modified Julian date before which no row of a C01 table is used: before 1962 it holds
        offsets of optical observations, of up to 0.1 arcsec.

    Raises
    ------
    SeriesError
        If the file cannot be used; it names the line.
    """
    return _read(path, kind, _POLE_OFFSETS, first)


def _read(
    path: str | Path, kind: str | None, pair: _Coordinates, first: float = -math.inf
) -> PoleSeries:
    """Read polar motion or celestial pole offsets from a file; unchanged files are read once."""
    file = file_of(path)
    lines_of(file)  # refuses what cannot be read
    return _parsed(file, checksum(file), kind, pair.name, first)


@lru_cache(maxsize=8)
def _parsed(file: Path, sha256: str, kind: str | None, name: str, first: float) -> PoleSeries:
    """Convert the text of a file to a pole series; repair small defects and refuse large ones."""
    pair = _POLE_OFFSETS if name == _POLE_OFFSETS.name else _POLAR_MOTION
    lines = lines_of(file)
    kind = kind or _kind(file, lines)
    if kind not in _READERS:
        raise SeriesError(file, f"kind {kind!r} is unknown", f"allowed: {', '.join(_READERS)}")
    rows = list(_READERS[kind](file, lines, pair))
    repairs: list[str] = []
    _check_dates(file, rows)
    if kind == "c01":
        rows = [row for row in rows if row.mjd >= first]
    rows = _drop_missing(file, rows, text_between(lines, _IS_ROW[kind]), repairs)
    if pair is _POLE_OFFSETS:
        rows = _drop_zeros(rows, repairs)
    if len(rows) < 2:
        raise SeriesError(file, f"it holds {len(rows)} rows of {pair.name}", "is it complete?")
    _check_size(file, rows, pair, kind)
    if pair is _POLE_OFFSETS and file not in (path() for path in CARRIED.values()):
        _check_model(file, rows)
    rows = _in_order(file, rows, repairs)
    _check_jumps(file, rows, pair)
    series = replace(_even(file, rows, kind, repairs), sha256=sha256)
    for column in ("mjd", "x", "y", *_ERRORS):
        getattr(series, column).setflags(write=False)
    return series


# --- the kinds of table --------------------------------------------------------------------------


def _c04(file: Path, lines: list[str], pair: _Coordinates) -> Iterator[_Row]:
    """Yield the rows of a C04 table, in the layout of 20 C04 or of older series."""
    columns = 0
    layouts = {count: layout for count, layout in pair.columns.items() if count != _C01_COLUMNS}
    for number, words in rows_of(lines):
        columns = columns or len(words)
        if len(words) != columns or columns not in layouts:
            allowed = " or ".join(map(str, layouts))
            remedy = (
                f"{allowed} are expected, as many in each row; is it cut off, or a column lost?"
            )
            raise SeriesError(file, f"{len(words)} columns", remedy, number)
        date, value, error = layouts[columns]
        *calendar, mjd = numbers(file, number, words[: date + 1])
        check_calendar(file, number, [*calendar, 0.0][:4], mjd)
        x, y, x_error, y_error = numbers(
            file, number, words[value : value + 2] + words[error : error + 2]
        )
        yield _Row(number, mjd, (x, y, x_error, y_error))


def _c01(file: Path, lines: list[str], pair: _Coordinates) -> Iterator[_Row]:
    """Yield the rows of a C01 table, dated by MJD (new layout) or Besselian year (old layout).

    By date: MJD, x, y, UT1-TAI, dX, dY, then their errors and 18 more columns. By year: decimal
    year, x, its error, y, its error, and in the longer layout UT1-TAI, its error, dX, its error,
    dY, its error.
    """
    columns = 0
    for number, words in rows_of(lines):
        columns = columns or len(words)
        if len(words) != columns or columns < 5:
            problem = f"{len(words)} columns"
            raise SeriesError(file, problem, "5 or more are expected, as many in each row", number)
        if columns == _C01_COLUMNS:
            date, value, error = pair.columns[columns]
            (mjd,) = numbers(file, number, words[date : date + 1])
            x, y = numbers(file, number, words[value : value + 2])
            x_error, y_error = numbers(file, number, words[error : error + 2])
        elif pair is _POLE_OFFSETS and columns != _C01_YEAR_COLUMNS:
            problem = f"a table C01 by year of {columns} columns holds no dX, dY"
            remedy = f"take one of {_C01_YEAR_COLUMNS} columns, or by MJD, of {_C01_COLUMNS}"
            raise SeriesError(file, problem, remedy, number)
        else:
            value = 7 if pair is _POLE_OFFSETS else 1
            (year,) = numbers(file, number, words[:1])
            x, x_error, y, y_error = numbers(file, number, words[value : value + 4])
            if not 1800 <= year <= 2200:
                remedy = f"it lies in 1800 to 2200; a table by MJD has {_C01_COLUMNS} columns"
                raise SeriesError(file, f"the year is {year:g}", remedy, number)
            # Besselian years, accurate to the 1 mas resolution of this table.
            mjd = 15019.81352 + (year - 1900.0) * 365.242198781
        yield _Row(number, mjd, (x, y, x_error, y_error))


def read_bulletin_a(path: str | Path = "finals") -> PoleSeries | None:
    """Read the polar motion predicted by Bulletin A, from the last rows of a finals2000A table.

    Parameters
    ----------
    path : str or Path
        A file or a word, as for `read_polar_motion`.

    Returns
    -------
    PoleSeries or None
        None if the table has no predictions.
    """
    file = file_of(path)
    lines = lines_of(file)
    if _kind(file, lines) != "finals2000A":
        return None
    rows = list(_finals(file, lines, _POLAR_MOTION, "P"))
    if len(rows) < 2:
        return None
    _check_dates(file, rows)
    _check_size(file, rows, _POLAR_MOTION, "finals2000A")
    return replace(_even(file, rows, "Bulletin A", []), sha256=checksum(file))


def _finals(file: Path, lines: list[str], pair: _Coordinates, flag: str = "I") -> Iterator[_Row]:
    """Yield the rows of a finals2000A table that are observed ("I") or predicted ("P")."""
    for number, line in enumerate(lines, start=1):
        if not line.strip() or line[pair.flag : pair.flag + 1] != flag:
            continue
        if len(line.rstrip("\n")) < pair.cells[-1].stop:
            raise SeriesError(file, "it ends early", "is the file cut off?", number)
        (mjd,) = numbers(file, number, [line[7:15]])
        x, y, x_error, y_error = numbers(file, number, [line[cell] for cell in pair.cells])
        year, month, day = numbers(file, number, [line[0:2], line[2:4], line[4:6]])
        # Two-digit years: 73 is 1973, and 72 is 2072.
        century = 1900 if year >= 73 else 2000
        check_calendar(file, number, [century + year, month, day, mjd % 1 * 24], mjd)
        u = pair.unit
        yield _Row(number, mjd, (u * x, u * y, u * x_error, u * y_error))


_READERS: dict[str, Callable[[Path, list[str], _Coordinates], Iterator[_Row]]] = {
    "c04": _c04,
    "c01": _c01,
    "finals2000A": _finals,
}


def _is_row_of_finals(line: str) -> bool:
    """Return True if a line of finals2000A is a data row: with flag "I" or "P", or only a date."""
    return line[16:17] in ("I", "P") or (is_number(line[7:15]) and not line[15:].strip())


#: Test for rows, by kind of table.
_IS_ROW: dict[str, Callable[[str], bool]] = {
    "c04": starts_with_number,
    "c01": starts_with_number,
    "finals2000A": _is_row_of_finals,
}


def _kind(file: Path, lines: list[str]) -> str:
    """Detect the kind of IERS table (C01, C04 or finals2000A) from its first row of numbers."""
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
    """Remove rows without pole coordinates, and add a note of their number to the repairs.

    Lines of text between rows count as such rows.
    """
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


def _drop_zeros(rows: list[_Row], repairs: list[str]) -> list[_Row]:
    """Remove the rows of zeros that a table holds before its first observation."""
    first = next((i for i, row in enumerate(rows) if any(row.values[:2])), len(rows))
    if first:
        repairs.append(f"{first} rows of zeros at the start, before observations, left out")
    return rows[first:]


def _check_model(file: Path, rows: list[_Row]) -> None:
    """Refuse offsets that differ from those of finals2000A, which astropy carries.

    The size alone tells no model: offsets from IAU 1980 stay below 20 mas until 1991, and the
    oldest of the others reach 9 mas.
    """
    known = read_pole_offsets("finals")
    days, *values = np.array([(row.mjd, *row.values[:2]) for row in rows]).T
    there = [np.interp(days, known.mjd, c / ARCSEC, np.nan, np.nan) for c in (known.x, known.y)]
    distance = np.max(np.abs(np.subtract(values, there)), axis=0)
    for row, apart in zip(rows, distance, strict=True):
        if max(map(abs, row.values[:2])) > _LARGEST_ELSEWHERE and not apart <= _ANOTHER_MODEL:
            problem = f"dX, dY = {row.values[0]:g}, {row.values[1]:g} arcsec"
            raise SeriesError(file, problem, _NOT_IAU_1980, row.line)
    common = distance[(days >= _TWO_TABLES) & np.isfinite(distance)]
    if common.size and np.median(common) > _ANOTHER_MODEL:
        problem = f"dX, dY differ by {1000 * np.median(common):.1f} mas from finals2000A (median)"
        raise SeriesError(file, problem, _NOT_IAU_1980)


def _check_size(file: Path, rows: list[_Row], pair: _Coordinates, kind: str) -> None:
    for row in rows:
        x, y, *errors = row.values
        if max(abs(x), abs(y)) > pair.largest:
            remedy = f"{pair.name} stays below {pair.largest / 2:g}; is it in milliarcseconds?"
            if pair is _POLE_OFFSETS:
                is_optical = kind == "c01" and row.mjd < _AFTER_OPTICAL
                remedy = _NO_OPTICAL if is_optical else _NOT_IAU_1980
            raise SeriesError(file, f"{pair.words} = {x:g}, {y:g} arcsec", remedy, row.line)
        if min(errors) < 0:
            problem = f"errors of {pair.words} = {errors[0]:g}, {errors[1]:g} arcsec"
            raise SeriesError(file, problem, "errors are not negative; is a column lost?", row.line)
    farthest = max(rows, key=lambda row: math.hypot(*row.values[:2]))
    if 0 < math.hypot(*farthest.values[:2]) < pair.smallest:
        x, y, *_ = farthest.values
        problem = f"{pair.words} = {x:g}, {y:g} arcsec, and no more elsewhere"
        remedy = f"the pole moves farther than {pair.smallest:g} arcsec; is it in radians?"
        raise SeriesError(file, problem, remedy, farthest.line)


def _check_jumps(file: Path, rows: list[_Row], pair: _Coordinates) -> None:
    """Refuse a jump of the pole that is too large for its usual motion and the stated errors."""
    for last, row in pairwise(rows):
        x, y = (abs(a - b) for a, b in zip(row.values[:2], last.values[:2], strict=True))
        days = row.mjd - last.mjd
        scatter = sum(error for error in (*last.values[2:], *row.values[2:]) if error > 0)
        if max(x, y) > pair.jump + pair.fastest * days + 3 * scatter:
            problem = f"the pole jumps by {x:.3g}, {y:.3g} arcsec in {days:.4g} d"
            remedy = f"it moves by less than {pair.fastest:g} arcsec a day; is a digit wrong?"
            raise SeriesError(file, problem, remedy, row.line)


def _in_order(file: Path, rows: list[_Row], repairs: list[str]) -> list[_Row]:
    """Sort rows by date; remove repeated rows, and refuse different rows with the same date."""
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
    """Interpolate the rows to an even time step, the median of the steps; refuse long gaps."""
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
    """Calendar date, as text like ``"1962-01-01"``, of a modified Julian date."""
    return str(np.datetime64("1858-11-17") + np.timedelta64(int(mjd // 1), "D"))

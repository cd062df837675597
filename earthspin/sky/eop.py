"""Observed polar motion and observed celestial pole offsets, read from files and tables.

Known tables: C04 (daily, from 1962), C01 (from 1846, ten rows per year, twenty since 1890) and
finals2000A (daily) of the IERS, also as CSV of its data centre; EOP-All.csv of CelesTrak; EOP2 of
the JPL; each also compressed by gzip. Predictions are ignored. Columns are found by name: in the
header of a CSV, and else among the names that belong to the number of columns. C04 and finals2000A
are included in astropy; nothing is downloaded. Invalid rows raise an error that gives the line;
defects with an unambiguous correction are repaired and reported.
"""

from __future__ import annotations

import datetime
import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from operator import itemgetter
from pathlib import Path
from typing import NamedTuple

import numpy as np

from earthspin.constants import ARCSEC, J2000_JD, MAS, NORMAL_95
from earthspin.errors import SeriesError
from earthspin.numerics.arrays import BoolArray, ComplexArray, FloatArray
from earthspin.sky import columns

#: First of the modified Julian dates, and J2000.0 in them.
_MJD_0 = np.datetime64("1858-11-17")
MJD = J2000_JD - 2400000.5
#: Longest gap that is interpolated linearly, in steps and in days; the oldest tables have ten rows
#: per year.
LONGEST_BRIDGE, LONGEST_DAYS = 10, 37.0
#: Largest fraction of rows without numbers that is ignored; one such row is always ignored.
LOST = 0.01
#: Tolerance of evenly spaced dates, as a fraction of a step.
DATE_ROUNDING = 1e-3
#: Period of the free wobble, used to report the error of interpolation, d.
FREE_WOBBLE = 433.0
#: First day after the optical observations of the table C01, MJD of 1962-01-01.
_AFTER_OPTICAL = 37665.0
#: Offsets whose median distance from those of finals2000A is larger are from IAU 1980, arcsec: in
#: C04 it is 0.1 mas, and in each year of offsets from IAU 1980 at least 3.5 mas. It is taken over
#: days from 1984 on, MJD, since which C04 and finals2000A agree.
_ANOTHER_MODEL, _TWO_TABLES = 0.002, 45700.0
#: Larger offsets must agree with those of finals2000A, arcsec.
_LARGEST_ELSEWHERE = 0.005
#: Columns of the dates, and of the rows of a table.
_DATE = ("year", "month", "day", "hour", "mjd")
_COLUMNS = ("line", "mjd", "x", "y", "x_error", "y_error")

#: Names of the columns of C04 and of C01, by their number, as far as they are used.
_C04 = {
    16: "year month day mjd x y ut1 lod dx dy e_x e_y e_ut1 e_lod e_dx e_dy",
    21: "year month day hour mjd x y ut1 dx dy x_rate y_rate lod e_x e_y e_ut1 e_dx e_dy",
}
_C01_YEAR = "year x e_x y e_y"
_C01 = {
    11: f"{_C01_YEAR} ut1 e_ut1 dx e_dx dy e_dy",
    29: "mjd x y ut1 dx dy e_x e_y e_ut1 e_dx e_dy",
}
_EOP2 = "mjd x y ut1 e_x e_y e_ut1 xy x_ut1 y_ut1 dx dy e_dx e_dy dxdy date"
#: Names of the columns of finals2000A, and where they begin and end. Of the columns "type", which
#: are "I" if observed and "P" if predicted, the third belongs to dX, dY, here as in the CSV.
_FINALS = "year month day mjd type x e_x y e_y type type dx e_dx dy e_dy"
_BEGINS = (0, 2, 4, 7, 16, 18, 27, 37, 46, 57, 95, 97, 106, 116, 125)
_ENDS = (2, 4, 6, 15, 17, 27, 36, 46, 55, 58, 96, 106, 115, 125, 134)
_CELLS = itemgetter(*map(slice, _BEGINS, _ENDS))
#: Layouts that can be named, and number of lines in which a header is looked for.
KINDS, _HEAD = ("c04", "c01", "finals2000A"), 60
#: How any other table is used.
_AS_PANDAS = "give a pandas table with x, y, dates as index and attrs['units'] = 'arcsec' or 'mas'"
#: Publishers of tables that are not those of the IERS.
_PUBLISHERS = {"EOP-All.csv": "CelesTrak ", "EOP2": "JPL ", "given table": ""}


@dataclass(frozen=True)
class _Coordinates:
    """Names and plausibility limits (arcsec) of polar motion, or of celestial pole offsets.

    Attributes
    ----------
    name, words : str
        Name of the two together, and of each, in messages.
    flag : int
        Number of the column "type" that marks rows as observed or predicted, if there are several.
    datum : str
        Their name in the header of EOP2.
    largest, smallest : float
        Larger values, and tables whose largest value is smaller, are in another unit, arcsec.
    fastest, jump : float
        Largest motion in a day, and largest further change that is not a jump, arcsec.
    """

    name: str
    words: str
    flag: int
    datum: str
    largest: float
    smallest: float
    fastest: float
    jump: float


#: Polar motion has never passed 0.7 arcsec, and never stayed within a milliarcsecond of the origin.
_POLAR_MOTION = _Coordinates(
    "polar motion", "x, y", 0, "UTPM", largest=2.0, smallest=1e-3, fastest=0.01, jump=0.1
)
#: Offsets from IAU 2006/2000A have never passed 9 mas; those from IAU 1980 pass 20 mas since 1991.
_POLE_OFFSETS = _Coordinates(
    "celestial pole offsets", "dX, dY", 2, "DX,DY", 0.02, smallest=1e-5, fastest=1e-4, jump=5e-3
)
_NO_OPTICAL = "before 1962 they are optical; give a span that begins in 1962 or later"
_NOT_IAU_1980 = "offsets from IAU 2006/2000A are needed; are they from IAU 1980?"


@dataclass(frozen=True, eq=False)
class GivenSeries:
    """Polar motion, celestial pole offsets or excitation that the user gives as a labelled table.

    Attributes
    ----------
    rows : array, shape (3, n) or (5, n)
        Days from J2000.0, both values in mas, and their 95 % half-widths in mas if they are known.
    """

    rows: FloatArray


#: Table of the pole: a file, the short name of one that astropy carries, or a table of the caller.
PoleTable = str | Path | GivenSeries


@dataclass(frozen=True)
class PoleSeries:
    """Time series of polar motion or of celestial pole offsets, observed or predicted.

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
        SHA-256 of the file; empty for a table of the caller.
    newest : bool
        Whether the last row is the newest observed one of finals2000A.
    """

    mjd: FloatArray
    x: FloatArray
    y: FloatArray
    x_error: FloatArray
    y_error: FloatArray
    name: str
    repairs: str = ""
    sha256: str = ""
    newest: bool = False

    @property
    def provenance(self) -> dict[str, str]:
        """SHA-256 hash of the series file, as an attribute for results; empty without a file."""
        return {"table_sha256": self.sha256} if self.sha256 else {}

    @property
    def source(self) -> str:
        """Publisher and name of the table that holds the series, such as "IERS c04"."""
        return _PUBLISHERS.get(self.name, "IERS ") + self.name

    @property
    def step(self) -> float:
        """Time between two successive dates of the series, d."""
        return float((self.mjd[-1] - self.mjd[0]) / (self.mjd.size - 1))

    @property
    def pole(self) -> ComplexArray:
        """Polar motion as x - i y, mas, shape (n,)."""
        return np.asarray((self.x - 1j * self.y) / MAS)

    @property
    def offsets(self) -> ComplexArray:
        """Celestial pole offsets as dX + i dY, rad, shape (n,)."""
        return np.asarray(self.x + 1j * self.y)

    def between(self, first: float, last: float) -> PoleSeries:
        """Select the rows of the series between two modified Julian dates, both included.

        Raises
        ------
        SeriesError
            If fewer than two rows are in between.
        """
        selected = (self.mjd >= first) & (self.mjd <= last)
        if np.count_nonzero(selected) < 2:
            start, end, from_day, to_day = map(day_of, (*self.mjd[[0, -1]], first, last))
            problem = f"it covers {start} to {end}; {from_day} to {to_day} was asked for"
            raise SeriesError(self.name, problem, "choose a span inside it")
        rows = {name: getattr(self, name)[selected] for name in _COLUMNS[1:]}
        return replace(self, **rows, newest=self.newest and bool(selected[-1]))


#: Files that astropy carries, by the short names that stand for them.
CARRIED = {"c04": "IERS_B_FILE", "finals": "IERS_A_FILE"}


def file_of(path: str | Path) -> Path:
    """Return the path of a file; a short name such as "c04" gives the file included in astropy."""
    import astropy_iers_data

    return Path(getattr(astropy_iers_data, CARRIED.get(str(path), ""), path))


def read_polar_motion(path: PoleTable = "c04", kind: str | None = None) -> PoleSeries:
    """Read a time series of observed polar motion.

    Parameters
    ----------
    path : str, Path or GivenSeries
        A file, ``"c04"`` or ``"finals"`` for those included in astropy, or a table of the caller.
    kind : str, optional
        ``"c04"``, ``"c01"`` or ``"finals2000A"``; detected from the file by default.

    Raises
    ------
    SeriesError
        If the file is invalid; the message gives the line.
    """
    return _read(path, kind, _POLAR_MOTION)


def read_pole_offsets(
    path: PoleTable = "c04", kind: str | None = None, first: float = -math.inf
) -> PoleSeries:
    """Read a time series of observed celestial pole offsets dX, dY.

    Rows that are flagged as predicted, and the zeros with which C04 and C01 begin, before there
    were observations, are left out.

    Parameters
    ----------
    path, kind
        See `read_polar_motion`.
    first : float
        Modified Julian date before which no row of a C01 table is used: before 1962 it holds
        offsets of optical observations, of up to 0.1 arcsec.

    Raises
    ------
    SeriesError
        If the file is invalid; the message gives the line.
    """
    return _read(path, kind, _POLE_OFFSETS, first)


def read_bulletin_a(path: PoleTable = "finals") -> PoleSeries | None:
    """Read the polar motion predicted by Bulletin A, from the last rows of a finals2000A table.

    Parameters
    ----------
    path : str, Path or GivenSeries
        See `read_polar_motion`.

    Returns
    -------
    PoleSeries or None
        None if the table has no predictions.
    """
    if isinstance(path, GivenSeries):
        return None
    file = file_of(path)
    layout = _layout(file, columns.lines_of(file), None)
    if not layout.name.startswith("finals2000A"):
        return None
    rows = _rows(file, layout, _POLAR_MOTION, predicted=True)
    if len(rows) < 2:
        return None
    _check_size(file, rows, _POLAR_MOTION, layout.name)
    return replace(_even(file, rows, "Bulletin A", []), sha256=columns.checksum(file))


def _read(
    path: PoleTable, kind: str | None, pair: _Coordinates, first: float = -math.inf
) -> PoleSeries:
    """Read polar motion or celestial pole offsets; unchanged files are not parsed again."""
    if isinstance(path, GivenSeries):
        days, *values = path.rows
        rows = np.full((days.size, len(_COLUMNS)), np.nan)
        rows[:, 0], rows[:, 1] = np.arange(1, days.size + 1), days + MJD
        rows[:, 2 : 2 + len(values)] = np.transpose(values) / 1e3
        rows[:, 4:] /= NORMAL_95
        return _checked("given table", rows, "given table", pair, [])
    file = file_of(path)
    columns.lines_of(file)  # refuses what cannot be read
    return _parsed(file, columns.checksum(file), kind, pair, first)


@lru_cache(maxsize=8)
def _parsed(
    file: Path, sha256: str, kind: str | None, pair: _Coordinates, first: float
) -> PoleSeries:
    """Parse and check a file of polar motion or celestial pole offsets; results are cached."""
    layout = _layout(file, columns.lines_of(file), kind)
    rows = _rows(file, layout, pair)
    if layout.name == "c01":
        rows = rows[~(rows[:, 1] < first)]
    text = columns.text_between(layout.lines, layout.is_row)
    return replace(_checked(file, rows, layout.name, pair, text), sha256=sha256)


def _checked(
    file: object, rows: FloatArray, name: str, pair: _Coordinates, text: list[int]
) -> PoleSeries:
    """Convert the rows of a table to a series; repair small defects and refuse large ones.

    Parameters
    ----------
    file : str or Path
    rows : array, shape (n, 6)
        Line of the file, mjd, x, y, x_error and y_error (d, arcsec).
    name : str
        Name of the table.
    pair : _Coordinates
    text : list of int
        Lines of text between the rows.
    """
    repairs: list[str] = []
    rows = _complete(file, rows, text, repairs)
    if pair is _POLE_OFFSETS:
        rows = _drop_zeros(rows, repairs)
    if len(rows) < 2:
        remedy = "is it complete?" if pair is _POLAR_MOTION else _NOT_IAU_1980
        raise SeriesError(file, f"it holds {len(rows)} rows of {pair.name}", remedy)
    _check_size(file, rows, pair, name)
    if pair is _POLE_OFFSETS and file not in [file_of(name) for name in CARRIED]:
        _check_model(file, rows)
    rows = _in_order(file, rows, repairs)
    _check_jumps(file, rows, pair)
    series = replace(_even(file, rows, name, repairs), newest=name.startswith("finals2000A"))
    for column in _COLUMNS[1:]:
        getattr(series, column).setflags(write=False)
    return series


# --- layouts of tables ---------------------------------------------------------------------------


class _Layout(NamedTuple):
    """Lines of a table, and how its rows are split into named columns.

    Attributes
    ----------
    lines : list of str
    name : str
        Name of the table.
    names : list of str
        Names of its columns; empty if no such table has as many.
    allowed : str
        Allowed numbers of columns, in words.
    is_row : callable
        Test for lines that are rows.
    split : callable
        Function that splits a row into the words of its columns.
    """

    lines: list[str]
    name: str
    names: list[str]
    allowed: str
    is_row: Callable[[str], bool] = columns.starts_with_number
    split: Callable[[str], Sequence[str]] = str.split


def _layout(file: Path, lines: list[str], kind: str | None) -> _Layout:
    """Detect the layout of a table from its header or from its first row of numbers."""
    if kind not in (None, *KINDS):
        raise SeriesError(file, f"kind {kind!r} is unknown", f"allowed: {', '.join(KINDS)}")
    head = lines[:_HEAD]
    if any(line.lstrip().startswith("EOP2") for line in head):
        return _Layout(lines, "EOP2", _EOP2.split(), "16", split=_cells)
    if header := next((line for line in head if "mjd" in _cells(line.lower())), ""):
        names = [re.sub(r"_pole|data_|\.\d+$", "", cell) for cell in _cells(header.lower())]
        names = [name.replace("sigma_", "e_") for name in names]
        final = re.search("[;,] *final *[;,]", "\n".join(lines))
        name = "finals2000A.csv" if final else "c04.csv"
        name = "EOP-All.csv" if "dat" in names else name
        return _Layout(lines, name, names, str(len(names)), _begins_with_digit, _cells)
    number, words = next(columns.rows_of(lines), (0, ["0"]))
    year = 1800 <= float(words[0]) <= 2200
    if kind is None and number and lines[number - 1][16:17] in ("I", "P"):
        kind = "finals2000A"
    elif kind is None and year and words[0].isdigit() and len(words) >= 6:
        kind = "c04"
    elif kind is None and (len(words) == max(_C01) or (year and "." in words[0])):
        kind = "c01"
    if kind == "finals2000A":
        return _Layout(lines, kind, _FINALS.split(), "15", _is_row_of_finals, _CELLS)
    if kind == "c04":
        return _Layout(lines, kind, _C04.get(len(words), "").split(), "16 or 21")
    if kind == "c01":
        c01_columns = _C01.get(len(words), _C01_YEAR if len(words) >= 5 else "")
        return _Layout(lines, kind, c01_columns.split(), "5 or more")
    if "bulletin" in "".join(head).lower().replace(" ", ""):
        remedy = "take finals2000A.all, or its CSV, which have the same rows"
        raise SeriesError(file, "it is the text of a bulletin", remedy)
    remedy = f"name its kind: {', '.join(KINDS)}; or {_AS_PANDAS}" if len(words) > 4 else _AS_PANDAS
    raise SeriesError(file, "it is none of the known tables", remedy)


def _cells(line: str) -> list[str]:
    """Split a line into cells at commas and semicolons."""
    return [cell.strip() for cell in re.split("[,;]", line)]


def _begins_with_digit(line: str) -> bool:
    """Return True if a line begins with a number or a date."""
    return line.strip().lstrip("+-")[:1].isdigit()


def _is_row_of_finals(line: str) -> bool:
    """Return True if a line of finals2000A is a data row: with flag "I" or "P", or only a date."""
    return line[16:17] in ("I", "P") or (columns.is_number(line[7:15]) and not line[15:].strip())


# --- rows ----------------------------------------------------------------------------------------


def _rows(file: Path, layout: _Layout, pair: _Coordinates, predicted: bool = False) -> FloatArray:
    """Observed or predicted rows of a table, (n, 6): line, MJD, x, y, x_error, y_error (arcsec)."""
    names, lines = layout.names, enumerate(layout.lines, start=1)
    table = [(number, layout.split(line)) for number, line in lines if layout.is_row(line)]
    if not table:
        raise SeriesError(file, "it holds no rows of numbers", "is it complete?")
    count = int(layout.allowed) if layout.allowed.isdigit() else len(table[0][1])
    for number, words in table:
        if len(words) != count or not names:
            remedy = f"{layout.allowed} are expected, as many in each row"
            remedy += "; is it cut off, or a column lost?"
            raise SeriesError(file, f"{len(words)} columns", remedy, number)
    x, y = pair.words.lower().split(", ")
    coordinates = [x, y, f"e_{x}", f"e_{y}"]
    if not {x, y} <= {*names}:
        problem = f"a table {layout.name} of {count} columns holds no {pair.words}"
        remedy = "take one of 11 columns, or by MJD, of 29" if layout.name == "c01" else _AS_PANDAS
        raise SeriesError(file, problem, remedy)
    if flags := [place for place, name in enumerate(names) if name == "type"]:
        flag = flags[pair.flag % len(flags)]
        if any(words[flag].strip() for _, words in table):
            letters = ("P", "p") if predicted else ("I", "f", "O")  # prediction; final
            table = [row for row in table if row[1][flag].startswith(letters)]
    if layout.split is _cells:  # dates without values
        table = [row for row in table if row[1][names.index(x)] or row[1][names.index(y)]]
    wanted = [name for name in (*_DATE, *coordinates) if name in names]
    places, values = [names.index(name) for name in wanted], []
    for number, words in table:
        if layout.split is _CELLS and len(words[places[-1]]) < _ENDS[-1] - _BEGINS[-1]:
            raise SeriesError(file, "it ends early", "is the file cut off?", number)
        texts = [words[place].strip() or "nan" for place in places]
        values.append((number, *columns.numbers(file, number, texts)))
    cells = dict(zip(["line", *wanted], np.reshape(values, (-1, len(wanted) + 1)).T, strict=True))
    in_mas = layout.name == "EOP2" or (pair is _POLE_OFFSETS and "finals" in layout.name)
    unit = 1e-3 if in_mas else 1.0
    line, mjd, missing = cells["line"], _dates(file, cells), np.full(len(table), np.nan)
    rows = np.array([line, mjd, *(unit * cells.get(name, missing) for name in coordinates)]).T
    if layout.name != "EOP2":
        return rows
    datum = re.search(rf"last {pair.datum}\D+([\d-]+)", " ".join(layout.lines[:_HEAD]), re.I)
    try:
        last = np.datetime64(datetime.date.fromisoformat(datum[1] if datum else ""))
    except ValueError:
        problem = f"its header gives no date of the last observed {pair.words}"
        raise SeriesError(file, problem, "take a file with its header") from None
    return rows[~(mjd > (last - _MJD_0) / np.timedelta64(1, "D"))]


def _dates(file: Path, cells: dict[str, FloatArray]) -> FloatArray:
    """Modified Julian dates of rows; refuse a row whose calendar date differs."""
    line, year = cells["line"].astype(int), cells.get("year")
    if "mjd" not in cells and year is not None:
        odd = (year < 1800) | (year > 2200)
        if odd.any():
            remedy = "it lies in 1800 to 2200; a table by MJD has 29 columns"
            raise SeriesError(file, f"the year is {year[odd][0]:g}", remedy, line[odd][0])
        # Besselian years, accurate to the 1 mas resolution of this table.
        return np.asarray(15019.81352 + (year - 1900.0) * 365.242198781)
    mjd = cells["mjd"]
    if year is not None and {"month", "day"} <= {*cells}:
        # Two-digit years: 73 is 1973, and 72 is 2072.
        year = np.where(year < 100, year + 1900 + 100 * (year < 73), year)
        date = (year, cells["month"], cells["day"], cells.get("hour", 24 * np.modf(mjd)[0]))
        for number, day, *calendar in zip(line, mjd, *date, strict=True):
            columns.check_calendar(file, number, calendar, day)
    return mjd


# --- what can be wrong ---------------------------------------------------------------------------


def _refuse(file: object, rows: FloatArray, wrong: BoolArray, problem: str, remedy: str) -> None:
    """Raise an error for the first wrong row, if any; the message contains the row's values."""
    if wrong.any():
        row = dict(zip(_COLUMNS, rows[np.argmax(wrong)], strict=False))
        raise SeriesError(file, problem.format(**row), remedy, int(row["line"]))


def _complete(file: object, rows: FloatArray, text: list[int], repairs: list[str]) -> FloatArray:
    """Remove rows without pole coordinates, and note how many; refuse a table with too many.

    Lines of text between rows count as such rows.
    """
    _refuse(file, rows, ~np.isfinite(rows[:, 1]), "the date is {mjd}", "give each row a date")
    complete = rows[np.isfinite(rows[:, 2:4]).all(axis=1)]
    gaps = sorted([*text, *np.setdiff1d(rows[:, 0], complete[:, 0]).astype(int).tolist()])
    if gaps:
        if len(gaps) > max(1, LOST * (len(complete) + len(gaps))):
            problem = f"{len(gaps)} of {len(complete) + len(gaps)} rows hold no numbers"
            remedy = f"at most {LOST:.0%} are left out; is the file damaged?"
            raise SeriesError(file, problem, remedy, gaps[0])
        repairs.append(f"{len(gaps)} rows without numbers left out, the first in line {gaps[0]}")
    return complete


def _drop_zeros(rows: FloatArray, repairs: list[str]) -> FloatArray:
    """Remove the rows of zeros that some tables have before the first observation."""
    observed = np.logical_or.accumulate(np.any(rows[:, 2:4] != 0, axis=1))
    if not observed.all():
        count = np.count_nonzero(~observed)
        repairs.append(f"{count} rows of zeros at the start, before observations, left out")
    return rows[observed]


def _check_model(file: object, rows: FloatArray) -> None:
    """Refuse celestial pole offsets far from those of finals2000A, which astropy includes.

    The size alone does not show the model: offsets from IAU 1980 stay below 20 mas until 1991, and
    the oldest of those from IAU 2006/2000A reach 9 mas.
    """
    finals = read_pole_offsets("finals")
    neighbours = [
        np.interp(rows[:, 1], finals.mjd, values / ARCSEC, np.nan, np.nan)
        for values in (finals.x, finals.y)
    ]
    distance = np.max(abs(rows[:, 2:4].T - neighbours), axis=0)
    suspect = np.max(abs(rows[:, 2:4]), axis=1) > _LARGEST_ELSEWHERE
    wrong = suspect & ~(distance <= _ANOTHER_MODEL)
    _refuse(file, rows, wrong, "dX, dY = {x:g}, {y:g} arcsec", _NOT_IAU_1980)
    common = distance[(rows[:, 1] >= _TWO_TABLES) & np.isfinite(distance)]
    if common.size and np.median(common) > _ANOTHER_MODEL:
        problem = f"dX, dY differ by {1000 * np.median(common):.1f} mas from finals2000A (median)"
        raise SeriesError(file, problem, _NOT_IAU_1980)


def _check_size(file: object, rows: FloatArray, pair: _Coordinates, name: str) -> None:
    """Refuse pole coordinates of implausible size (wrong unit or model), and negative errors."""
    values, size = f"{pair.words} = {{x:g}}, {{y:g}} arcsec", np.hypot(rows[:, 2], rows[:, 3])
    suspect = np.max(abs(rows[:, 2:4]), axis=1) > pair.largest
    remedy = f"{pair.name} stays below {pair.largest / 2:g}; is it in milliarcseconds?"
    if pair is _POLE_OFFSETS and suspect.any():
        optical = name == "c01" and rows[suspect][0, 1] < _AFTER_OPTICAL
        remedy = _NO_OPTICAL if optical else _NOT_IAU_1980
    _refuse(file, rows, suspect, values, remedy)
    problem = f"errors of {pair.words} = {{x_error:g}}, {{y_error:g}} arcsec"
    remedy = "errors are not negative; is a column lost?"
    _refuse(file, rows, np.any(rows[:, 4:] < 0, axis=1), problem, remedy)
    if 0 < size.max() < pair.smallest:
        remedy = f"the pole moves farther than {pair.smallest:g} arcsec; is it in radians?"
        _refuse(file, rows, size == size.max(), f"{values}, and no more elsewhere", remedy)


def _check_jumps(file: object, rows: FloatArray, pair: _Coordinates) -> None:
    """Refuse a jump of the pole that is too large for its usual motion and the stated errors."""
    step, error = abs(np.diff(rows, axis=0)), np.nansum(rows[:, 4:], axis=1)
    limit = pair.jump + pair.fastest * step[:, 1] + 3 * (error[1:] + error[:-1])
    wrong = np.max(step[:, 2:4], axis=1) > limit
    step[:, 0] = rows[1:, 0]
    problem = "the pole jumps by {x:.3g}, {y:.3g} arcsec in {mjd:.4g} d"
    remedy = f"it moves by less than {pair.fastest:g} arcsec a day; is a digit wrong?"
    _refuse(file, step, wrong, problem, remedy)


def _in_order(file: object, rows: FloatArray, repairs: list[str]) -> FloatArray:
    """Sort rows by date; remove repeated rows, and refuse different rows with the same date."""
    order = np.argsort(rows[:, 1], kind="stable")
    if np.any(np.diff(order) < 0):
        repairs.append("rows sorted by date")
    ordered = rows[order]
    step = np.diff(ordered, axis=0)
    repeated = step[:, 1] <= 1e-6
    other = repeated & np.any(np.nan_to_num(step[:, 2:]) != 0, axis=1)
    problem = "MJD {mjd:.2f} stands twice, with different numbers"
    _refuse(file, ordered[1:], other, problem, "keep one of the two rows")
    if repeated.any():
        repairs.append(f"{np.count_nonzero(repeated)} repeated rows left out")
    return np.asarray(ordered[np.append(True, ~repeated)])


def _even(file: object, rows: FloatArray, name: str, repairs: list[str]) -> PoleSeries:
    """Interpolate rows to evenly spaced dates, about the median step apart; refuse long gaps."""
    mjd, values = rows[:, 1], rows[:, 2:] * ARCSEC
    steps = np.diff(mjd)
    usual = float(np.median(steps))
    longest = int(np.argmax(steps))
    bridge = min(LONGEST_BRIDGE * usual, max(LONGEST_DAYS, usual)) * (1 + DATE_ROUNDING)
    if steps[longest] > bridge:
        problem = f"a gap of {steps[longest]:.1f} d follows MJD {mjd[longest]:.2f}"
        remedy = f"gaps up to {bridge:.0f} d are bridged; take a span on one side of it"
        raise SeriesError(file, problem, remedy, int(rows[longest, 0]))
    # Dates are rounded: the mean of all steps is more accurate than a single step.
    count = round((mjd[-1] - mjd[0]) / usual)
    days = int(np.sum(np.round(steps / usual)))
    count = days if abs(days - count) <= DATE_ROUNDING * count else count
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
    return PoleSeries(even, x, y, x_error, y_error, name, "; ".join(repairs))


def day_of(mjd: float) -> str:
    """Calendar date, as text like ``"1962-01-01"``, of a modified Julian date."""
    return str(_MJD_0 + np.timedelta64(int(mjd // 1), "D"))

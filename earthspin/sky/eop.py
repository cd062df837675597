"""Observed polar motion and observed celestial pole offsets, read from files and tables.

Known tables: C04 (daily, from 1962), C01 (from 1846, ten rows per year, twenty since 1890),
finals2000A (daily) and Bulletin B of the IERS, also as CSV of its data centre; EOP-All of
CelesTrak, text and CSV; EOP2 of the JPL; ERP of the IGS and CODE; eoxy and eops of the IVS. C04 and
finals2000A are included in astropy; nothing is downloaded. Predictions are ignored. Invalid rows
raise an error that gives the line; defects with an unambiguous correction are repaired and
reported.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cache, lru_cache, partial
from pathlib import Path

import numpy as np

from earthspin import tables
from earthspin.constants import ARCSEC, J2000_JD, MAS, NORMAL_95
from earthspin.errors import SeriesError
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.sky import pole_rows as checks
from earthspin.sky import pole_tables
from earthspin.sky.pole_rows import (
    COLUMNS,
    NOT_IAU_1980,
    POLAR_MOTION,
    POLE_OFFSETS,
    Coordinates,
    day_of,
)
from earthspin.tables import Meaning, Sheet

#: J2000.0 as a modified Julian date.
MJD = J2000_JD - 2400000.5
#: First and last modified Julian date, and those of a whole table.
_Interval = tuple[float, float]
ALL: _Interval = (-math.inf, math.inf)
#: Offsets whose median distance from those of finals2000A is larger are from IAU 1980, arcsec: in
#: C04 it is 0.1 mas, and in each year of offsets from IAU 1980 at least 3.5 mas. It is taken over
#: days from 1984 on, MJD, since which C04 and finals2000A agree.
_ANOTHER_MODEL, _TWO_TABLES = 0.002, 45700.0
#: Larger offsets must agree with those of finals2000A, arcsec.
_LARGEST_ELSEWHERE = 0.005
#: Name of a table of the caller.
_GIVEN = "given table"
#: Publishers of tables that are not those of the IERS.
_PUBLISHERS = dict.fromkeys(("EOP-All.csv", "EOP-All.txt"), "CelesTrak ") | {"EOP2": "JPL "}
_PUBLISHERS |= dict.fromkeys(
    (_GIVEN, pole_tables.NAMED, "EOP-MOD", "IGS ERP", "IVS eoxy", "IVS eops"), ""
)


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
        return source_of(self.name)

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
        rows = {name: getattr(self, name)[selected] for name in COLUMNS[1:]}
        return replace(self, **rows, newest=self.newest and bool(selected[-1]))


def source_of(name: str) -> str:
    """Publisher and name of a table, such as "IERS c04"."""
    return _PUBLISHERS.get(name, "IERS ") + name


#: Files that astropy carries, by the short names that stand for them.
CARRIED = {"c04": "IERS_B_FILE", "finals": "IERS_A_FILE"}


def file_of(path: str | Path) -> Path:
    """Return the path of a file; a short name such as "c04" gives the file included in astropy."""
    import astropy_iers_data

    return Path(getattr(astropy_iers_data, CARRIED.get(str(path), ""), path))


def read_polar_motion(
    path: PoleTable = "c04",
    kind: str | None = None,
    columns: str | None = None,
    span: _Interval = ALL,
) -> PoleSeries:
    """Read a time series of observed polar motion.

    Parameters
    ----------
    path : str, Path or GivenSeries
        A file, ``"c04"`` or ``"finals"`` for those included in astropy, or a table of the caller.
    kind : str, optional
        ``"c04"``, ``"c01"`` or ``"finals2000A"``; detected from the file by default.
    columns : str, optional
        Declaration of its columns, like ``"mjd, x (mas), y (mas), ..."``.
    span : tuple of float
        First and last modified Julian date that the caller needs: of a table with gaps, the part
        that holds them is read.

    Raises
    ------
    SeriesError
        If the file is invalid; the message gives the line.
    """
    return _read(path, POLAR_MOTION, kind, columns, span)


def read_pole_offsets(
    path: PoleTable = "c04",
    kind: str | None = None,
    columns: str | None = None,
    span: _Interval = ALL,
) -> PoleSeries:
    """Read a time series of observed celestial pole offsets dX, dY.

    Rows that are flagged as predicted, and the zeros with which C04 and C01 begin, before there
    were observations, are left out.

    Parameters
    ----------
    path, kind, columns
        See `read_polar_motion`.
    span : tuple of float
        See `read_polar_motion`. No earlier row of a C01 table is used: before 1962 it holds offsets
        of optical observations, of up to 0.1 arcsec.

    Raises
    ------
    SeriesError
        If the file is invalid; the message gives the line.
    """
    return _read(path, POLE_OFFSETS, kind, columns, span)


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
    sheet, table = pole_tables.split(file, None, None, partial(observed, POLAR_MOTION))
    if not table.name.startswith("finals2000A"):
        return None
    sheet = pole_tables.observed(sheet, table, POLAR_MOTION, predicted=True)
    if len(sheet.lines) < 2:
        return None
    rows = pole_tables.rows_of(sheet, table, POLAR_MOTION)
    checks.check_size(file, rows, POLAR_MOTION, table.name)
    even = checks.evenly_spaced(file, rows, [])
    return replace(_series(even, "Bulletin A", []), sha256=tables.checksum(file))


#: Name of a table, its observed rows, and their repairs.
_Parsed = tuple[str, FloatArray, tuple[str, ...]]


def _read(
    path: PoleTable, pair: Coordinates, kind: str | None, columns: str | None, span: _Interval
) -> PoleSeries:
    """Read polar motion or celestial pole offsets; unchanged files are not parsed again."""
    file: Path | str = _GIVEN
    if isinstance(path, GivenSeries):
        if columns:
            problem = f"columns='{columns}' are those of a file"
            raise SeriesError(_GIVEN, problem, "rename the columns of the table instead")
        sha256, parsed = "", _of_given(path, pair)
    else:
        file = file_of(path)
        if kind and columns:
            raise SeriesError(file, "kind and columns are both given", "leave out one of them")
        sha256 = tables.checksum(file)
        parsed = _of_file(file, sha256, kind, columns, pair)
    return replace(_checked(file, parsed, pair, span), sha256=sha256)


def _of_given(given: GivenSeries, pair: Coordinates) -> _Parsed:
    """Rows of a table of the caller."""
    days, *values = given.rows
    rows = np.full((days.size, len(COLUMNS)), np.nan)
    rows[:, 0], rows[:, 1] = np.arange(1, days.size + 1), days + MJD
    rows[:, 2 : 2 + len(values)] = np.transpose(values) / 1e3
    rows[:, 4:] /= NORMAL_95
    repairs: list[str] = []
    rows = checks.complete(_GIVEN, rows, [], repairs)
    if pair is POLAR_MOTION:
        sheet = Sheet(tables.FRAME, "", ["x", "y"], [1e3 * rows[:, 2], 1e3 * rows[:, 3]])
        meaning = pole_tables.PoleColumns(_GIVEN, [Meaning("x", "mas"), Meaning("y", "mas")])
        pole_tables.check(sheet, meaning, rows[:, 1], observed(pair))
    return _GIVEN, rows, tuple(repairs)


@lru_cache(maxsize=8)
def _of_file(
    file: Path, sha256: str, kind: str | None, columns: str | None, pair: Coordinates
) -> _Parsed:
    """Rows of a file with a checksum; results are cached."""
    sheet, table = pole_tables.split(file, kind, columns, partial(observed, POLAR_MOTION))
    rows = pole_tables.rows_of(sheet := pole_tables.observed(sheet, table, pair), table, pair)
    repairs: list[str] = []
    complete = checks.complete(file, rows, sheet.text, repairs)
    if pair is POLAR_MOTION and not is_carried(file):
        pole_tables.check(sheet, table, rows[:, 1], observed(pair))
    return table.name, complete, tuple(repairs)


def _checked(file: Path | str, parsed: _Parsed, pair: Coordinates, span: _Interval) -> PoleSeries:
    """Convert the rows of a table to a series; repair small defects and refuse large ones."""
    name, rows, (*repairs,) = parsed
    if pair is POLE_OFFSETS and name == "c01":
        rows = rows[~(rows[:, 1] < span[0])]
    observed = checks.without_fillers(rows, pair, repairs)
    if len(observed) < 2:
        remedy = "is it complete?" if pair is POLAR_MOTION else NOT_IAU_1980
        raise SeriesError(file, f"it holds {len(observed)} rows of {pair.name}", remedy)
    checks.check_size(file, observed, pair, name)
    if pair is POLE_OFFSETS and not is_carried(file):
        _check_model(file, observed)
    ordered = checks.in_order(file, observed, repairs)
    filled = len(observed) < int(np.sum(rows[:, 1] >= ordered[0, 1]))
    part = checks.without_gaps(ordered, span, filled, repairs)
    checks.check_jumps(file, part, pair)
    return _series(checks.evenly_spaced(file, part, repairs), name, repairs)


def _series(even: FloatArray, name: str, repairs: list[str]) -> PoleSeries:
    """Series of evenly spaced rows, which cannot be changed."""
    columns = dict(zip(COLUMNS[1:], (column.copy() for column in even.T), strict=True))
    for column in columns.values():
        column.setflags(write=False)
    newest = name.startswith("finals2000A")
    return PoleSeries(**columns, name=name, repairs="; ".join(repairs), newest=newest)


# --- comparison with finals2000A ------------------------------------------------------------------


def is_carried(file: object) -> bool:
    """Return True if a file is one that astropy includes."""
    return file in [file_of(name) for name in CARRIED]


@cache
def observed(pair: Coordinates) -> FloatArray:
    """Modified Julian dates, and both coordinates of finals2000A, arcsec, shape (3, n)."""
    finals = _read("finals", pair, None, None, ALL)
    return np.array([finals.mjd, finals.x / ARCSEC, finals.y / ARCSEC])


def _check_model(file: object, rows: FloatArray) -> None:
    """Refuse celestial pole offsets far from those of finals2000A, which astropy includes.

    The size alone does not show the model: offsets from IAU 1980 stay below 20 mas until 1991, and
    the oldest of those from IAU 2006/2000A reach 9 mas.
    """
    off = pole_tables.differences(rows[:, 1], rows[:, 2:4].T, observed(POLE_OFFSETS))
    distance = np.max(abs(off), axis=0)
    suspect = np.max(abs(rows[:, 2:4]), axis=1) > _LARGEST_ELSEWHERE
    wrong = suspect & ~(distance <= _ANOTHER_MODEL)
    checks.refuse(file, rows, wrong, "dX, dY = {x:g}, {y:g} arcsec", NOT_IAU_1980)
    common = distance[(rows[:, 1] >= _TWO_TABLES) & np.isfinite(distance)]
    if common.size and np.median(common) > _ANOTHER_MODEL:
        problem = f"dX, dY differ by {1000 * np.median(common):.1f} mas from finals2000A (median)"
        raise SeriesError(file, problem, NOT_IAU_1980)

"""Observed UT1 and length of day, read from the tables that hold the pole.

C04 and finals2000A of the IERS, also as CSV of its data centre, EOP-All.csv of CelesTrak, and
tables whose columns the user names. UT1 is returned relative to TAI, which has no leap seconds.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, fields, replace
from functools import cache, lru_cache, partial
from pathlib import Path

import numpy as np

from earthspin import tables
from earthspin._lazy import erfa
from earthspin.errors import SeriesError
from earthspin.numerics.arrays import BoolArray, FloatArray
from earthspin.sky import eop, pole_tables
from earthspin.sky import pole_rows as checks
from earthspin.sky.pole_rows import day_of

_MJD_OF_JD0 = 2400000.5
#: Number of the column "type" that marks predicted rows of UT1, if there are several.
_FLAG = 1
#: First day of UTC, MJD of 1960-01-01.
_FIRST_UTC = 36934.0
#: Larger values of UT1 - UTC are in another unit or relative to another scale, s: UTC is kept
#: within 0.9 s of UT1.
_LARGEST = 1.0
#: Largest change of UT1 - TAI in a day, s: the longest observed day has 4.4 ms more than 86400 s.
_FASTEST = 0.01
#: Median distances of UT1 and of the length of day from those of finals2000A up to which they
#: agree, s: those of C04 are 1.4e-5 and 1.1e-5. UT1R, without the tides of less than 35 days, is
#: 6e-4 and 2e-4 off. They are taken over days from 1984 on, MJD, if there are at least so many.
_SAME_DAY, _TWO_TABLES, _FEWEST = (2e-4, 1e-4), 45700.0, 5


@dataclass(frozen=True)
class UniversalTime:
    """Time series of UT1 and of the length of day, which include the zonal tides.

    Attributes
    ----------
    mjd : array, shape (n,)
        Modified Julian dates (UTC), evenly spaced; 0h in daily tables.
    ut1_minus_tai, ut1_error : array, shape (n,)
        UT1 - TAI and its standard deviation from the file, s.
    length_of_day, length_of_day_error : array, shape (n,)
        Excess of the length of day over 86400 s and its standard deviation, s; NaN where the file
        has none.
    predicted : bool array, shape (n,)
        True for rows that the table marks as predicted.
    name, repairs, sha256 : str
        Kind of table, description of repairs, and SHA-256 of the file.
    """

    mjd: FloatArray
    ut1_minus_tai: FloatArray
    ut1_error: FloatArray
    length_of_day: FloatArray
    length_of_day_error: FloatArray
    predicted: BoolArray
    name: str
    repairs: str = ""
    sha256: str = ""

    @property
    def source(self) -> str:
        """Publisher and name of the table, such as "IERS c04"."""
        return eop.source_of(self.name)

    @property
    def provenance(self) -> dict[str, str]:
        """SHA-256 hash of the file, as an attribute for results."""
        return {"table_sha256": self.sha256}

    @property
    def ut1_minus_utc(self) -> FloatArray:
        """UT1 - UTC, s; after the last announced leap second, if none follows."""
        return np.asarray(self.ut1_minus_tai + tai_minus_utc(self.mjd))

    def only(self, rows: BoolArray) -> UniversalTime:
        """Select rows of the series."""
        names = (field.name for field in fields(self)[:6])
        return replace(self, **{name: getattr(self, name)[rows] for name in names})


@cache
def leap_seconds() -> tuple[FloatArray, str]:
    """Modified Julian dates of leap seconds and TAI - UTC after them, s, and the end of the list.

    The list is the one that astropy includes; it begins in 1972.
    """
    import astropy_iers_data

    text = Path(astropy_iers_data.IERS_LEAP_SECOND_FILE).read_text("ascii")
    rows = [line.split() for line in text.splitlines() if line[:1] != "#" and line.strip()]
    end = re.findall(r"expires on (.*)", text)
    return np.array([(row[0], row[-1]) for row in rows], dtype=float).T, end[0] if end else ""


def tai_minus_utc(mjd: FloatArray) -> FloatArray:
    """TAI - UTC at modified Julian dates (UTC) from 1960 on, s, with all known leap seconds."""
    (days, seconds), _ = leap_seconds()
    mjd = np.asarray(mjd, dtype=float)
    late = seconds[np.searchsorted(days, mjd, side="right") - 1]
    if np.any(early := mjd < days[0]):  # UTC was steered by rates, which ERFA has
        late[early] = erfa.dat(*erfa.jd2cal(_MJD_OF_JD0, mjd[early]))
    return np.asarray(late)


def read_universal_time(
    path: str | Path = "c04", columns: str | None = None, span: tuple[float, float] = eop.ALL
) -> UniversalTime:
    """Read a time series of UT1 and the length of day, with the rows that are predicted.

    Parameters
    ----------
    path : str or Path
        A file, or ``"c04"`` or ``"finals"`` for those included in astropy.
    columns : str, optional
        Declaration of its columns, like ``"mjd, ut1 (s), lod (ms), e_ut1 (s), e_lod (ms)"``, where
        `ut1` is UT1 - UTC.
    span : tuple of float
        First and last modified Julian date of the rows that are returned.

    Raises
    ------
    SeriesError
        If the file is invalid, or has no two rows in the span; the message gives the line.
    """
    file = eop.file_of(path)
    series = _of_file(file, tables.checksum(file), columns)
    rows = (series.mjd >= span[0]) & (series.mjd <= span[1])
    if np.count_nonzero(rows) < 2:
        problem = f"it covers {day_of(series.mjd[0])} to {day_of(series.mjd[-1])}"
        raise SeriesError(file, problem, "choose a span inside it")
    return series.only(rows)


@lru_cache(maxsize=8)
def _of_file(file: Path, sha256: str, columns: str | None) -> UniversalTime:
    """Series of a file with a checksum; results are cached."""
    known = partial(eop.observed, checks.POLAR_MOTION)
    sheet, table = pole_tables.split(file, None, columns, known)
    names = [column.quantity for column in table.columns]
    if "ut1" not in names:
        problem = f"a table {table.name} of {sheet.width} columns holds no UT1 - UTC"
        raise sheet.error(problem, "take C04 or finals2000A, or name it in columns='mjd, ut1 (s)'")
    cells = sheet.cells[names.index("ut1")]
    sheet = sheet.only(bool(cell.strip()) for cell in cells)  # dates alone are no rows
    pole_tables.refuse_cut_off(sheet, names, "e_ut1")
    quantities = ("ut1", "lod", "e_ut1", "e_lod")
    ut1, *others = (sheet.values(table.columns, name, "s") for name in quantities)
    mjd = tables.dates_of(sheet, table.columns)
    sheet.refuse(~(mjd >= _FIRST_UTC), "MJD {mjd:g} is before UTC", "begin in 1960", mjd=mjd)
    remedy = "UT1 - UTC stays below 0.9; is it in s, and relative to UTC?"
    sheet.refuse(~(abs(ut1) <= _LARGEST), "UT1 - UTC = {ut1:g} s", remedy, ut1=ut1)
    flags = pole_tables.flags_of(sheet, table, _FLAG)
    predicted = [flag.startswith(("P", "p")) for flag in flags] or 0 * mjd
    repairs: list[str] = []
    late = ut1 - tai_minus_utc(mjd)
    rows = np.array([np.array(sheet.lines, dtype=float), mjd, late, predicted, *others]).T
    rows = checks.in_order(file, checks.complete(file, rows, sheet.text, repairs), repairs)
    _check(file, rows)
    if not eop.is_carried(file):
        _compare(sheet.file, rows)
    _, mjd, late, predicted, lod, e_ut1, e_lod = rows.T
    return UniversalTime(
        mjd, late, e_ut1, lod, e_lod, predicted > 0, table.name, "; ".join(repairs), sha256
    )


def _check(file: Path, rows: FloatArray) -> None:
    """Refuse too few rows, uneven steps, and jumps of UT1 - TAI."""
    if len(rows) < 2:
        raise SeriesError(file, f"it holds {len(rows)} rows of UT1", "is it complete?")
    step = np.diff(rows, axis=0)
    step[:, 0] = rows[1:, 0]
    uneven = abs(step[:, 1] - np.median(step[:, 1])) > checks.DATE_ROUNDING
    remedy = "even steps are needed; name the file of one span"
    checks.refuse(file, step, uneven, "the step before it is {mjd:g} d", remedy)
    jumps = abs(step[:, 2]) > _FASTEST * step[:, 1] + 3 * np.nan_to_num(rows[1:, 5] + rows[:-1, 5])
    remedy = "it changes by less than 0.01 s a day; is a digit wrong, or a leap second missing?"
    checks.refuse(file, step, jumps, "UT1 - TAI jumps by {x:g} s in {mjd:g} d", remedy)


def _compare(file: object, rows: FloatArray) -> None:
    """Refuse UT1 and lengths of day that are not those of finals2000A."""
    recent = rows[(rows[:, 1] >= _TWO_TABLES) & (rows[:, 3] == 0)]
    off = pole_tables.differences(recent[:, 1], recent[:, [2, 4]].T, _known())
    for name, distance, limit in zip(("UT1", "length of day"), abs(off), _SAME_DAY, strict=True):
        distance = distance[np.isfinite(distance)]
        if distance.size >= _FEWEST and np.median(distance) > limit:
            problem = f"its {name} is {np.median(distance):.2g} s off finals2000A (median)"
            remedy = "UT1 - UTC and length of day in s, with all tides, are needed"
            raise SeriesError(file, problem, remedy)


@cache
def _known() -> FloatArray:
    """Modified Julian dates, UT1 - TAI and length of day of finals2000A, s, shape (3, n)."""
    finals = read_universal_time("finals")
    return np.array([finals.mjd, finals.ut1_minus_tai, finals.length_of_day])

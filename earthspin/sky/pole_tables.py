"""Columns of tables of the pole: by layout, by the names in the header, or as the user declares.

What x and y mean is compared with the observed pole of finals2000A, which astropy includes.
"""

from __future__ import annotations

import datetime
import itertools
import math
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from earthspin import tables
from earthspin.errors import SeriesError
from earthspin.numerics.arrays import FloatArray
from earthspin.sky.pole_rows import Coordinates
from earthspin.tables import BLANK, Meaning, Sheet
from earthspin.tables import layouts as published

#: Names of columns in headers, in lower case.
NAMES: dict[str, tuple[str, ...]] = {
    "x": ("x", "x_pole", "pm_x", "xp", "xpole", "pm-x", "polar_motion_x"),
    "y": ("y", "y_pole", "pm_y", "yp", "ypole", "pm-y", "polar_motion_y"),
    "dx": ("dx", "dx_2000a"), "dy": ("dy", "dy_2000a"),
    "e_x": ("sigma_x", "sigma_x_pole", "e_x", "x_error", "e_pm_x", "x-err", "x_er", "xsig"),
    "e_y": ("sigma_y", "sigma_y_pole", "e_y", "y_error", "e_pm_y", "y-err", "y_er", "ysig"),
    "e_dx": ("sigma_dx", "e_dx", "dx_error", "dx_er", "e_dx_2000a"),
    "e_dy": ("sigma_dy", "e_dy", "dy_error", "dy_er", "e_dy_2000a"),
    "ut1": ("ut1-utc", "ut1_utc"), "e_ut1": ("sigma_ut1-utc", "e_ut1_utc"),
    "lod": ("lod",), "e_lod": ("sigma_lod", "e_lod"),
}  # fmt: skip
#: Name of a table whose columns are named by the user or by a header that nobody publishes.
NAMED = "named columns"
#: How any other table is used.
AS_PANDAS = "give a pandas table with x, y, dates as index and attrs['units'] = 'arcsec' or 'mas'"
#: Median distance of x, y from finals2000A up to which they agree, arcsec, and its multiple from
#: which they do not: C01 differs by up to 0.005, and x, y exchanged or of another sign by more than
#: 0.3. At least so many days must be common.
SAME_POLE, OTHER_POLE, FEWEST = 0.01, 3.0, 5
#: Units in which tables hold the pole.
_UNITS = ("arcsec", "mas", "uas", "0.1 arcsec", "deg", "rad")


class PoleColumns(NamedTuple):
    """Name of a table and the meaning of its columns.

    Attributes
    ----------
    name : str
    columns : list of Meaning
    declared : bool
        Whether the user, a header or a known layout declares them, and not their number. Decimal
        years are declared by the user, or by the header of C01.
    """

    name: str
    columns: list[Meaning]
    declared: bool = True


def split(
    file: Path, kind: str | None, columns: str | None, known: Callable[[], FloatArray]
) -> tuple[Sheet, PoleColumns]:
    """Split a table of the pole into rows, and find what its columns mean.

    Parameters
    ----------
    file : Path
    kind : str or None
        Name of its layout.
    columns : str or None
        Declaration of its columns.
    known : callable
        Function that returns modified Julian dates, x and y of finals2000A, arcsec, shape (3, m).

    Raises
    ------
    SeriesError
        If the table is of no known layout; the message has the key to give.
    """
    sheet = tables.split(file, () if columns else published.POLE_BY_HEAD)
    if columns:
        allowed = (*tables.DATES, *NAMES, "type")
        return sheet, PoleColumns(NAMED, sheet.as_declared(columns, allowed))
    if layout := sheet.layout:
        meaning = tables.declared(layout.columns)
        if not tables.fits(layout.columns, sheet.width):
            problem = f"{sheet.width} columns; {layout.name} has {len(meaning)}"
            raise sheet.error(problem, "is a column lost?", 0)
        return sheet, PoleColumns(layout.name, meaning)
    if by_names := _by_names(sheet, kind):
        return sheet, by_names
    for layout in _without_header(sheet, kind):
        if tables.fits(layout.columns, sheet.width):
            meaning = tables.declared(layout.columns)
            declared = kind is not None or layout is published.C01_BY_MJD
            return sheet, PoleColumns(layout.name, meaning, declared)
    raise _unknown(sheet, kind, known)


def _by_names(sheet: Sheet, kind: str | None) -> PoleColumns | None:
    """Columns by the names in the header; None if these have no date or no coordinates."""
    places = tables.places(sheet.file, sheet.names, NAMES)
    dates = tables.places(sheet.file, sheet.names, tables.DATES)
    dated = {"mjd", "jd", "date", "year"} & {*dates}
    if not (dated and {"x", "y", "dx", "dy", "ut1"} & {*places}):
        return None
    columns = [Meaning("type") if "type" in n.lower() else BLANK for n in sheet.names]
    final = any("final" in column for column in sheet.cells)
    for quantity, place in places.items():
        unit = ("s", "ms") if "ut1" in quantity or "lod" in quantity else ("arcsec", "mas")
        thousandths = final and quantity.removeprefix("e_") in ("dx", "dy", "lod")
        own = tables.column_of(sheet.names[place]).unit
        columns[place] = Meaning(quantity, own or unit[thousandths])
    for quantity, place in dates.items():
        columns[place] = Meaning(quantity)
    names = {NAMED: True, "c04.csv": "x_pole" in sheet.names, "EOP-All.csv": "DAT" in sheet.names}
    by_year = {"year"} == {*dates}
    names |= {"finals2000A.csv": final, "c01": by_year}
    name = next(n for n in reversed(names) if names[n])
    published_c01 = "x_er" in sheet.names
    return PoleColumns(name, columns, declared=bool(kind) or published_c01 or not by_year)


def _without_header(sheet: Sheet, kind: str | None) -> Sequence[published.TableLayout]:
    """Layouts without a header that are possible by the first cell of a table, or of a kind."""
    if sheet.names or kind:
        return published.POLE_BY_KIND.get(kind or "", ())
    first = sheet.cells[0][0]
    if not (tables.is_number(first) and 1800 <= float(first.replace(",", ".")) <= 2200):
        return (published.C01_BY_MJD,)
    return published.C01_BY_YEAR if "." in first else published.C04


def _unknown(sheet: Sheet, kind: str | None, known: Callable[[], FloatArray]) -> SeriesError:
    """Build an error for a table of no known layout, with the columns to type."""
    if kind:
        return sheet.error(f"its {sheet.width} columns are not those of {kind}", "another kind?", 0)
    guess = guessed(sheet, known())
    if sheet.names:
        words = [BLANK] * sheet.width
        for name, place in tables.places(sheet.file, sheet.names, tables.DATES | NAMES).items():
            words[place] = Meaning(name, "arcsec" if name in NAMES else "")
        more = "" if guess else f"(x and y are needed), or {AS_PANDAS}"
        return sheet.not_understood(guess or words, more)
    example = [Meaning("mjd"), Meaning("x", "arcsec"), Meaning("y", "arcsec")]
    key = tables.typed(guess or example, more=not guess and sheet.width > len(example))
    remedy = f"{key} agrees with finals2000A" if guess else f"such as {key}; or {AS_PANDAS}"
    return sheet.error("it is none of the known tables", f"name its columns: {remedy}")


# --- rows -----------------------------------------------------------------------------------------


def observed(sheet: Sheet, table: PoleColumns, pair: Coordinates, predicted: bool = False) -> Sheet:
    """Rows of a table that are observed, or else those that are predicted, and have values.

    Raises
    ------
    SeriesError
        If the table does not hold the two coordinates, or a row of fixed columns ends early.
    """
    names = [column.quantity for column in table.columns]
    x, y = pair.words.lower().split(", ")
    if not {x, y} <= {*names}:
        problem = f"a table {table.name} of {sheet.width} columns holds no {pair.words}"
        by_year = "take one of 11 columns, or by MJD, of 29"
        raise sheet.error(problem, by_year if table.name == "c01" else AS_PANDAS)
    if flags := flags_of(sheet, table, pair.flag):
        kept = ("P", "p") if predicted else ("I", "f", "O")  # "P", "prediction"; "I", "final"
        sheet = sheet.only(cell.startswith(kept) for cell in flags)
    both = zip(sheet.cells[names.index(x)], sheet.cells[names.index(y)], strict=True)
    sheet = sheet.only(any(map(str.strip, pair)) for pair in both)  # dates alone are no rows
    refuse_cut_off(sheet, names, f"e_{y}")
    if table.name == "EOP2":
        late = tables.dates_of(sheet, table.columns) > _last_observed(sheet, pair)
        sheet = sheet.only(~late)
    return sheet


def flags_of(sheet: Sheet, table: PoleColumns, number: int) -> Sequence[str]:
    """Cells of the column "type" of that number, or of the last; empty if none marks rows."""
    flags = [place for place, column in enumerate(table.columns) if column.quantity == "type"]
    cells = sheet.cells[flags[number % len(flags)]] if flags else ()
    return cells if any(map(str.strip, cells)) else ()


def refuse_cut_off(sheet: Sheet, names: Sequence[str], last: str) -> None:
    """Refuse a row of fixed columns that ends before the end of the last one that is needed."""
    if sheet.layout and sheet.layout.edges:
        place = names.index(last)
        begin, end = sheet.layout.edges[place]
        short = [len(cell) < end - begin for cell in sheet.cells[place]]
        if any(short):
            raise sheet.error("it ends early", "is the file cut off?", short.index(True))


def _last_observed(sheet: Sheet, pair: Coordinates) -> float:
    """Modified Julian date of the last observed row of EOP2, from its header."""
    datum = re.search(rf"last {pair.datum}\D+([\d-]+)", sheet.words, re.IGNORECASE)
    try:
        last = datetime.date.fromisoformat(datum[1] if datum else "")
    except ValueError:
        problem = f"its header gives no date of the last observed {pair.words}"
        raise sheet.error(problem, "take a file with its header") from None
    return float((np.datetime64(last) - tables.MJD_0) / np.timedelta64(1, "D"))


def rows_of(sheet: Sheet, table: PoleColumns, pair: Coordinates) -> FloatArray:
    """Rows of a table, (n, 6): line, MJD, x, y, x_error, y_error (arcsec)."""
    x, y = pair.words.lower().split(", ")
    names = (x, y, f"e_{x}", f"e_{y}")
    values = [sheet.values(table.columns, name, "arcsec") for name in names]
    mjd = tables.dates_of(sheet, table.columns)
    return np.array([np.array(sheet.lines, dtype=float), mjd, *values]).T


# --- comparison with finals2000A ------------------------------------------------------------------


def check(sheet: Sheet, table: PoleColumns, mjd: FloatArray, known: FloatArray) -> None:
    """Refuse x, y that agree with the observed pole only in another meaning.

    Columns that only their number tells must agree with it as they are, and so must decimal years.

    Parameters
    ----------
    sheet : Sheet
    table : PoleColumns
    mjd : array, shape (n,)
        Modified Julian dates of the rows.
    known : array, shape (3, m)
        Modified Julian dates, x and y of finals2000A, arcsec.

    Raises
    ------
    SeriesError
        The message has the other meaning.
    """

    def misfit(columns: Sequence[Meaning]) -> float:
        return _misfit(sheet, mjd, columns, known)

    tables.refuse_other_meaning(sheet, table.columns, _others(table.columns), misfit)
    distance = misfit(table.columns)
    dated = "mjd" in [column.quantity for column in table.columns]
    if table.declared or distance <= OTHER_POLE or (math.isnan(distance) and dated):
        return
    problem = f"as a table {table.name} its x, y are {distance * SAME_POLE:.2g} arcsec from"
    if math.isnan(distance):
        problem = f"as a table {table.name} by years it has fewer than {FEWEST} days of"
    remedy = f"give kind='{table.name}' if that is right, or columns='mjd, ...'"
    raise sheet.error(f"{problem} finals2000A", remedy)


def _misfit(sheet: Sheet, mjd: FloatArray, columns: Sequence[Meaning], known: FloatArray) -> float:
    """Median distance of x and y, or of one of them, from the observed pole over its bound.

    It is nan without common days.
    """
    named = [name in {column.quantity for column in columns} for name in "xy"]
    values = [sheet.values(columns, name, "arcsec") for name in "xy"]
    distance = np.hypot.reduce(differences(mjd, values, known)[named])
    if np.count_nonzero(np.isfinite(distance)) < FEWEST:
        return math.nan
    return float(np.nanmedian(distance)) / SAME_POLE


def differences(mjd: FloatArray, values: Iterable[FloatArray], known: FloatArray) -> FloatArray:
    """Two coordinates minus those of a known series; nan on dates outside it."""
    return np.array(
        [
            value - np.interp(mjd, known[0], expected, np.nan, np.nan)
            for value, expected in zip(values, known[1:], strict=True)
        ]
    )


def _others(columns: Sequence[Meaning]) -> Iterator[list[Meaning]]:
    """Other meanings of x and y: exchanged, of the other sign, in other units."""
    exchange = {"x": "y", "y": "x", "e_x": "e_y", "e_y": "e_x"}
    angles = [column.unit for column in columns if column.quantity == "x"]
    for words in ({}, exchange):
        for unit in (*angles, *_UNITS):
            new = tables.with_words(columns, words | dict.fromkeys(angles, unit))
            for signs in itertools.product((1.0, -1.0), repeat=2):
                sign = dict(zip(("x", "y"), signs, strict=True))
                yield [c._replace(sign=c.sign * sign.get(c.quantity, 1.0)) for c in new]


def guessed(sheet: Sheet, known: FloatArray) -> list[Meaning] | None:
    """Meaning of columns by which x and y agree with the observed pole; None if none does."""
    blank = [BLANK] * sheet.width
    options = [Meaning(*one) for one in itertools.product(("x", "y"), _UNITS, (1.0, -1.0))]
    for names in (("mjd",), ("jd",), ("date",), ("year", "month", "day"), ("year",)):
        time = [*map(Meaning, names), *blank][: sheet.width]
        try:
            mjd = tables.dates_of(sheet, time)
        except (SeriesError, IndexError):
            continue

        def misfit(columns: Sequence[Meaning], mjd: FloatArray = mjd) -> float:
            try:
                return _misfit(sheet, mjd, columns, known)
            except SeriesError:  # text
                return math.nan

        _, meaning = tables.guessed(range(sheet.width), [time], options, misfit)
        if {"x", "y"} <= {column.quantity for column in meaning}:
            return meaning
    return None

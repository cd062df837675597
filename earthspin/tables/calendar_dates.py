"""Modified Julian dates of the rows of a table, from dates in any of their columns."""

from __future__ import annotations

import datetime
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from earthspin.numerics.arrays import FloatArray
from earthspin.tables.columns import Meaning
from earthspin.tables.sheet import Sheet

#: Columns of dates, and their names in headers, in lower case.
DATES: dict[str, tuple[str, ...]] = {
    "year": ("year", "yr", "yyyy", "an"), "month": ("month", "mon", "mm"), "day": ("day", "dd"),
    "hour": ("hour", "hr", "hh"), "mjd": ("mjd", "modified_julian_date"),
    "jd": ("jd", "julian_date"), "date": ("date", "time", "epoch", "datetime"),
}  # fmt: skip
#: Date of the modified Julian date 0.
MJD_0 = np.datetime64("1858-11-17")
_MJD_OF_JD0 = 2400000.5
#: Tolerance between a modified Julian date and the calendar date in its row, for rounding, d.
_SAME_DATE = 2e-3
#: Besselian years that are dates of observations of the pole.
_FIRST_YEAR, _LAST_YEAR = 1800, 2200


def dates_of(sheet: Sheet, columns: Sequence[Meaning]) -> FloatArray:
    """Modified Julian dates of rows; refuse a row whose calendar date differs from its MJD.

    Raises
    ------
    SeriesError
        If there is no date, or if two dates in a row differ.
    """
    places = {c.quantity: place for place, c in enumerate(columns) if c.quantity in DATES}
    values = {name: sheet.column(place) for name, place in places.items() if name != "date"}
    if "jd" in values:
        values.setdefault("mjd", values["jd"] - _MJD_OF_JD0)
    if {"year", "month", "day"} <= {*values}:
        return _from_calendar(sheet, values)
    if "mjd" in values:
        return values["mjd"]
    if "year" in values:
        return _from_besselian_years(sheet, values["year"])
    if "date" in places:
        return _from_text(sheet, sheet.cells[places["date"]])
    raise sheet.error("it has no column of dates", f"name one of {', '.join(DATES)}")


def _from_calendar(sheet: Sheet, values: dict[str, FloatArray]) -> FloatArray:
    """Dates of calendar days, or the modified Julian dates beside them, which must be the same.

    Of years with two digits, 73 is 1973, and 72 is 2072.
    """
    year, mjd = values["year"], values.get("mjd")
    year = np.where(year < 100, year + 1900 + 100 * (year < 73), year)
    days = []
    for row, date in enumerate(zip(year, values["month"], values["day"], strict=True)):
        try:
            days.append(datetime.date(*map(int, date)))
        except (ValueError, OverflowError):
            problem = "there is no day {:g}-{:g}-{:g}".format(*date)
            raise sheet.error(problem, "is a column lost?", row) from None
    hours = values.get("hour", 0.0 if mjd is None else 24 * np.modf(mjd)[0])
    expected = np.asarray(_since_mjd_0(np.array(days, dtype="M8[D]")) + hours / 24)
    if mjd is None:
        return expected
    problem = "MJD {mjd:.2f} differs from the calendar date, MJD {expected:.2f}"
    remedy = "the two must agree; is a column lost?"
    differs = ~(abs(mjd - expected) <= _SAME_DATE)
    sheet.refuse(differs, problem, remedy, mjd=mjd, expected=expected)
    return mjd


def _from_besselian_years(sheet: Sheet, year: FloatArray) -> FloatArray:
    """Dates of Besselian years, accurate to the 1 mas resolution of tables of the pole."""
    remedy = f"it lies in {_FIRST_YEAR} to {_LAST_YEAR}; a table by MJD has 29 columns"
    outside = (year < _FIRST_YEAR) | (year > _LAST_YEAR)
    sheet.refuse(outside, "the year is {year:g}", remedy, year=year)
    return np.asarray(15019.81352 + (year - 1900.0) * 365.242198781)


def _from_text(sheet: Sheet, cells: Sequence[str]) -> FloatArray:
    """Dates written as text, like 2020-01-31."""
    dates = [cell.strip().removesuffix("Z").replace(" ", "T") for cell in cells]
    try:
        return _since_mjd_0(np.array(dates, dtype="M8[ms]"))
    except ValueError:
        raise sheet.error("its dates are not understood", "write them like 2020-01-31") from None


def _since_mjd_0(dates: NDArray[np.datetime64]) -> FloatArray:
    return np.asarray((dates - MJD_0) / np.timedelta64(1, "D"))

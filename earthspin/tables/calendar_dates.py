"""Modified Julian dates of the rows of a table, from dates in any of their columns."""

from __future__ import annotations

import datetime
from collections.abc import Sequence

import numpy as np

from earthspin.numerics.arrays import FloatArray
from earthspin.tables.columns import Column
from earthspin.tables.sheet import Sheet

#: Columns of dates, and their names in headers, in lower case.
DATES: dict[str, tuple[str, ...]] = {
    "year": ("year", "yr", "yyyy", "an"), "month": ("month", "mon", "mm"), "day": ("day", "dd"),
    "hour": ("hour", "hr", "hh"), "mjd": ("mjd", "modified_julian_date"),
    "jd": ("jd", "julian_date"), "date": ("date", "time", "epoch", "datetime"),
}  # fmt: skip
#: Proleptic day number of the modified Julian date 0, 1858 November 17, and the same as a date.
_FIRST_DAY = datetime.date(1858, 11, 17).toordinal()
MJD_0 = np.datetime64("1858-11-17")
_MJD_OF_JD0 = 2400000.5
#: Tolerance between a modified Julian date and the calendar date in its row, for rounding, d.
_SAME_DATE = 2e-3
#: Besselian years that are dates of observations of the pole.
_FIRST_YEAR, _LAST_YEAR = 1800, 2200


def dates_of(sheet: Sheet, columns: Sequence[Column]) -> FloatArray:
    """Modified Julian dates of rows; refuse a row whose calendar date differs from its MJD.

    Raises
    ------
    SeriesError
        If there is no date, or if two dates in a row differ.
    """
    cells = {c.quantity: place for place, c in enumerate(columns) if c.quantity in DATES}
    values = {name: sheet.column(place) for name, place in cells.items() if name != "date"}
    if "jd" in values and "mjd" not in values:
        values["mjd"] = values["jd"] - _MJD_OF_JD0
    if "mjd" not in values and {"year", "month", "day"} <= {*values}:
        return _from_calendar(sheet, values)
    if "mjd" not in values and "year" in values:
        return _from_besselian_years(sheet, values["year"])
    if "mjd" not in values and "date" in cells:
        return _from_text(sheet, cells["date"])
    mjd = values["mjd"]
    if {"year", "month", "day"} <= {*values}:
        _check_calendar(sheet, values, mjd)
    return mjd


def _from_besselian_years(sheet: Sheet, year: FloatArray) -> FloatArray:
    """Dates of Besselian years, accurate to the 1 mas resolution of tables of the pole."""
    outside = (year < _FIRST_YEAR) | (year > _LAST_YEAR)
    if outside.any():
        remedy = f"it lies in {_FIRST_YEAR} to {_LAST_YEAR}; a table by MJD has 29 columns"
        raise sheet.error(f"the year is {year[outside][0]:g}", remedy, int(np.argmax(outside)))
    return np.asarray(15019.81352 + (year - 1900.0) * 365.242198781)


def _from_calendar(sheet: Sheet, values: dict[str, FloatArray]) -> FloatArray:
    """Dates of calendar days, at the hour of the row."""
    days = [_day(sheet, row, *date) for row, date in enumerate(_calendars(values))]
    return np.array(days) + values.get("hour", 0.0) / 24


def _from_text(sheet: Sheet, place: int) -> FloatArray:
    """Dates written as text, like 2020-01-31."""
    cells = [row[place].strip().removesuffix("Z").replace(" ", "T") for row in sheet.rows]
    try:
        return np.asarray((np.array(cells, dtype="M8[ms]") - MJD_0) / np.timedelta64(1, "D"))
    except ValueError:
        raise sheet.error("its dates are not understood", "write them like 2020-01-31") from None


def _check_calendar(sheet: Sheet, values: dict[str, FloatArray], mjd: FloatArray) -> None:
    """Refuse a modified Julian date that differs from the calendar date in its row."""
    hours = values.get("hour", 24 * np.modf(mjd)[0])
    for row, (date, hour, day) in enumerate(zip(_calendars(values), hours, mjd, strict=True)):
        expected = _day(sheet, row, *date) + hour / 24
        if not abs(day - expected) <= _SAME_DATE:
            problem = f"MJD {day:.2f} differs from the calendar date, MJD {expected:.2f}"
            raise sheet.error(problem, "the two must agree; is a column lost?", row)


def _calendars(values: dict[str, FloatArray]) -> list[tuple[float, float, float]]:
    """Year, month and day of each row. Of years with two digits, 73 is 1973, and 72 is 2072."""
    year = values["year"]
    year = np.where(year < 100, year + 1900 + 100 * (year < 73), year)
    return [*zip(year, values["month"], values["day"], strict=True)]


def _day(sheet: Sheet, row: int, year: float, month: float, day: float) -> int:
    """Modified Julian date of the beginning of a calendar day."""
    try:
        return datetime.date(int(year), int(month), int(day)).toordinal() - _FIRST_DAY
    except (ValueError, OverflowError):
        problem = f"there is no day {year:g}-{month:g}-{day:g}"
        raise sheet.error(problem, "is a column lost?", row) from None

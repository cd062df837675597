"""Stiff and extreme cases of dates, calendars and units."""

from __future__ import annotations

import datetime as dt
from fractions import Fraction

import numpy as np

from earthspin import units
from earthspin.checks.case import Cases
from earthspin.constants import DAY
from earthspin.scene.spec import Scene

CASES = Cases("units")


def _time(values: object, scale: str) -> object:
    from astropy.time import Time

    return Time(values, scale=scale)


@CASES.hold(
    "through the leap second of 2016-12-31",
    because="a minute of 61 seconds: 23:59:60 is a time, and the day is longer than 86400 s",
    against="one second of TDB from each second of UTC to the next",
    unit="s",
    bound=2e-8,
)
def _leap_second() -> float:
    stamps = [f"2016-12-31T23:59:{s}" for s in ("58", "59", "60")] + ["2017-01-01T00:00:00"]
    found = units.days(_time(stamps, "utc"))
    return float(np.max(np.abs(np.diff(found) * DAY - 1)))


@CASES.hold(
    "every leap second since 1972",
    because="UTC jumps 27 times against TDB, which must not",
    against="TDB less UTC: 32.184 s and the leap seconds so far; TDB swings by 1.7 ms",
    unit="s",
    bound=2e-3,
)
def _all_leap_seconds() -> float:
    years = np.arange(1973, 2018)
    steps = {1973: 12, 1974: 13, 1975: 14, 1976: 15, 1977: 16, 1978: 17, 1979: 18, 1980: 19}
    steps |= {1985: 22, 1990: 25, 1995: 29, 2000: 32, 2005: 32, 2006: 33, 2010: 34, 2017: 37}
    worst = 0.0
    for year in (int(y) for y in years if int(y) in steps):
        stamp = f"{year}-01-01T00:00:00"
        utc = float(units.days(_time(stamp, "utc"))[0])
        tdb = float(units.days([stamp])[0])
        worst = max(worst, abs((utc - tdb) * DAY - 32.184 - steps[year]))
    return worst


@CASES.hold(
    "the Gregorian reform, 4 and 15 October 1582",
    because="calendars skip ten days there; a count of days may not",
    against="Python's own proleptic ordinals, years 1 to 9999",
    unit="d",
    bound=0.0,
)
def _reform() -> float:
    dates = ["1582-10-04", "1582-10-15", "0001-01-01", "1600-02-29", "1900-03-01", "9999-12-31"]
    found = units.days(dates)
    exact = [dt.date.fromisoformat(d).toordinal() - dt.date(2000, 1, 1).toordinal() for d in dates]
    return float(np.max(np.abs(found - (np.array(exact) - 0.5))))


@CASES.hold(
    "29 February of 1600, 2000 and 2400",
    because="centuries that are leap years, unlike 1900 and 2100",
    against="the day between 28 February and 1 March",
    unit="d",
    bound=0.0,
)
def _leap_day() -> float:
    worst = 0.0
    for year in (1600, 2000, 2400):
        around = units.days([f"{year}-02-28", f"{year}-02-29", f"{year}-03-01"])
        worst = max(worst, float(np.max(np.abs(np.diff(around) - 1))))
    return worst


@CASES.refuse(
    "29 February 1900",
    because="no such day; arithmetic would make it 1 March",
    saying="there is no such date",
)
def _no_leap_day() -> None:
    units.days(["1900-02-29"])


@CASES.refuse(
    "year 0",
    because="astronomers have it, calendars do not; files cannot hold it",
    saying="years run from 1 to 9999",
)
def _year_zero() -> None:
    units.days(["0000-06-01"])


@CASES.refuse(
    "a year before the first",
    because="a minus sign in a date is read in three ways",
    saying="write a date like",
)
def _negative_year() -> None:
    units.days(["-0044-03-15"])


@CASES.refuse(
    "the year 10000",
    because="dates of five digits sort as text before the others",
    saying="years run from 1 to 9999",
)
def _year_ten_thousand() -> None:
    units.days(np.array(["10000-01-01"], dtype="M8[us]"))


@CASES.refuse(
    "a date that is no date",
    because="NaT compares false with everything",
    saying="NaT is no date",
)
def _nat() -> None:
    units.days(np.array(["2000-01-01", "NaT"], dtype="M8[us]"))


@CASES.hold(
    "microseconds from 1550 to 2650",
    because="a float of days keeps 5 us at the ends; nanoseconds would have wrapped to 2134",
    against="the date that went in",
    unit="us",
    bound=3.0,
)
def _microseconds() -> float:
    dates = np.array(["1550-01-01T00:00:00.000001", "2650-12-31T23:59:59.999999"], dtype="M8[us]")
    back = units.datetime64(units.days(dates))
    return float(np.max(np.abs((back - dates).astype(np.int64))))


@CASES.hold(
    "a grid of a third of a second through a century",
    because="ten billion steps of a length that no float holds",
    against="the last time in whole microseconds, exactly",
    unit="us",
    bound=0.5,
)
def _grid() -> float:
    grid = units.time_grid("1950-01-01", "2050-01-01", 0.333333)
    last = Fraction(grid.start + grid.step * (grid.size - 1), units.MICROSECONDS_PER_DAY)
    found = Fraction(float(grid.days(grid.size - 1)[0]))
    return float(abs(found - last) * units.MICROSECONDS_PER_DAY)


@CASES.hold(
    "a span of nothing, and a step longer than the span",
    because="the number of steps is zero",
    against="one time, the first",
    bound=0.0,
)
def _one_time() -> float:
    grids = [
        units.time_grid("2000-01-01", "2000-01-01", "1 h"),
        units.time_grid("2000-01-01", "2000-01-02", "9999 yr"),
    ]
    return float(sum(abs(grid.size - 1) + abs(grid.days()[0] + 0.5) for grid in grids))


@CASES.refuse(
    "a step that is not a number",
    because="NaN passes every comparison that is written the wrong way round",
    saying="greater than zero",
)
def _nan_step() -> None:
    units.time_grid("2000-01-01", "2001-01-01", float("nan"))


@CASES.refuse(
    "a span that ends before it starts",
    because="a grid of a negative number of times",
    saying="ends before it starts",
)
def _backward_span() -> None:
    units.time_grid("2001-01-01", "2000-01-01", "1 d")


@CASES.refuse(
    "a step in kilograms",
    because="the number is fine",
    saying="is not a value in units of s",
)
def _wrong_unit() -> None:
    Scene(compute="torque", step="6 kg")


@CASES.refuse(
    "a step of a billionth of a second",
    because="it rounds to no microsecond at all: a grid without end",
    saying="a microsecond or more",
)
def _no_step() -> None:
    units.time_grid("2000-01-01", "2001-01-01", 1e-9)

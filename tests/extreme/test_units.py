"""Dates, calendars and units."""

from __future__ import annotations

import datetime as dt

import numpy as np
from astropy.time import Time

from earthspin import dates
from earthspin.constants import DAY
from earthspin.errors import Where
from earthspin.numerics.arrays import FloatArray
from tests.extreme import Distances, holds


def _days(times: object) -> FloatArray:
    """Convert a list of times in any form to days from J2000.0 TDB."""
    return dates.days(times, Where("times"))


def _grid(first: object, last: object, step: object) -> dates.TimeGrid:
    """Make evenly spaced times between two dates, from values as a user would type them."""
    span = dates.Span.read([first, last], Where("span"))
    return dates.TimeGrid.over(span, dates.SPACING.read(step, Where("step")))


@holds(bound=2e-8, unit="s")
def test_leap_second() -> Distances:
    """through the leap second of 2016-12-31

    Hard because: 23:59:60 is a valid time, and the day is longer than 86400 s
    Compared with: one second of TDB for each second of UTC
    """
    stamps = [f"2016-12-31T23:59:{s}" for s in ("58", "59", "60")] + ["2017-01-01T00:00:00"]
    result = _days(Time(stamps, scale="utc"))
    yield np.diff(result) * DAY - 1


@holds(bound=2e-3, unit="s")
def test_all_leap_seconds() -> Distances:
    """every leap second since 1972

    Hard because: UTC has 27 discontinuities with respect to TDB, which must have none
    Compared with: TDB - UTC: 32.184 s plus the leap seconds so far; TDB varies by 1.7 ms
    """
    steps = {1973: 12, 1974: 13, 1975: 14, 1976: 15, 1977: 16, 1978: 17, 1979: 18, 1980: 19}
    steps |= {1985: 22, 1990: 25, 1995: 29, 2000: 32, 2005: 32, 2006: 33, 2010: 34, 2017: 37}
    for year, so_far in steps.items():
        stamp = f"{year}-01-01T00:00:00"
        utc, tdb = _days(Time(stamp, scale="utc")), _days([stamp])
        yield (utc - tdb) * DAY - 32.184 - so_far


@holds(bound=0.0, unit="d")
def test_reform() -> Distances:
    """day count across the Gregorian calendar reform, 4 and 15 October 1582

    Hard because: the civil calendar omits ten days there, but a count of days must not
    Compared with: Python's proleptic ordinals, years 1 to 9999
    """
    known = ["1582-10-04", "1582-10-15", "0001-01-01", "1600-02-29", "1900-03-01", "9999-12-31"]
    result = _days(known)
    exact = [dt.date.fromisoformat(d).toordinal() - dt.date(2000, 1, 1).toordinal() for d in known]
    yield result - (np.array(exact) - 0.5)


@holds(bound=0.0, unit="d")
def test_leap_day() -> Distances:
    """day count at 29 February of 1600, 2000 and 2400

    Hard because: these centuries are leap years, unlike 1900 and 2100
    Compared with: the day between 28 February and 1 March
    """
    for year in (1600, 2000, 2400):
        around = _days([f"{year}-02-28", f"{year}-02-29", f"{year}-03-01"])
        yield np.diff(around) - 1


@holds(bound=0.0)
def test_one_time() -> Distances:
    """evenly spaced times over a span of zero length, or with a step longer than the span

    Hard because: the number of steps is zero
    Compared with: a single time, the first
    """
    for end, step in (("2000-01-01", "1 h"), ("2000-01-02", "9999 yr")):
        grid = _grid("2000-01-01", end, step)
        yield grid.size - 1
        yield grid.days()[0] + 0.5

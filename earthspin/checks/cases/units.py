"""Stiff and extreme cases of dates, calendars and units."""

from __future__ import annotations

import datetime as dt

import astropy.units as u
import numpy as np
import xarray as xr
from astropy.time import Time

from earthspin import dates
from earthspin.checks.case import Distances, FloatArray, holds, refused
from earthspin.checks.sky import BODY
from earthspin.constants import DAY
from earthspin.errors import Where
from earthspin.questions.free_rotor import free_rotor
from earthspin.questions.polar_motion import excitation, polar_motion, polar_motion_from
from earthspin.scenes import Scene


def _days(times: object) -> FloatArray:
    """Days from J2000.0 TDB of a list of times in any form."""
    return dates.days(times, Where("times"))


def _grid(first: object, last: object, step: object) -> dates.TimeGrid:
    """Evenly spaced times between two dates, both as they would be typed."""
    span = dates.Span.read([first, last], Where("span"))
    return dates.TimeGrid.over(span, dates.Spacing().read(step, Where("step")))


@holds(bound=2e-8, unit="s")
def _leap_second() -> Distances:
    """through the leap second of 2016-12-31

    Hard because: a minute of 61 seconds: 23:59:60 is a time, and the day is longer than 86400 s
    Held against: one second of TDB from each second of UTC to the next
    """
    stamps = [f"2016-12-31T23:59:{s}" for s in ("58", "59", "60")] + ["2017-01-01T00:00:00"]
    result = _days(Time(stamps, scale="utc"))
    yield np.diff(result) * DAY - 1


@holds(bound=2e-3, unit="s")
def _all_leap_seconds() -> Distances:
    """every leap second since 1972

    Hard because: UTC jumps 27 times against TDB, which must not
    Held against: TDB less UTC: 32.184 s and the leap seconds so far; TDB swings by 1.7 ms
    """
    steps = {1973: 12, 1974: 13, 1975: 14, 1976: 15, 1977: 16, 1978: 17, 1979: 18, 1980: 19}
    steps |= {1985: 22, 1990: 25, 1995: 29, 2000: 32, 2005: 32, 2006: 33, 2010: 34, 2017: 37}
    for year, so_far in steps.items():
        stamp = f"{year}-01-01T00:00:00"
        utc, tdb = _days(Time(stamp, scale="utc")), _days([stamp])
        yield (utc - tdb) * DAY - 32.184 - so_far


@holds(bound=0.0, unit="d")
def _reform() -> Distances:
    """the Gregorian reform, 4 and 15 October 1582

    Hard because: calendars skip ten days there; a count of days may not
    Held against: Python's own proleptic ordinals, years 1 to 9999
    """
    known = ["1582-10-04", "1582-10-15", "0001-01-01", "1600-02-29", "1900-03-01", "9999-12-31"]
    result = _days(known)
    exact = [dt.date.fromisoformat(d).toordinal() - dt.date(2000, 1, 1).toordinal() for d in known]
    yield result - (np.array(exact) - 0.5)


@holds(bound=0.0, unit="d")
def _leap_day() -> Distances:
    """29 February of 1600, 2000 and 2400

    Hard because: centuries that are leap years, unlike 1900 and 2100
    Held against: the day between 28 February and 1 March
    """
    for year in (1600, 2000, 2400):
        around = _days([f"{year}-02-28", f"{year}-02-29", f"{year}-03-01"])
        yield np.diff(around) - 1


@refused("there is no such date")
def _no_leap_day() -> None:
    """29 February 1900

    Hard because: no such day; arithmetic would make it 1 March
    """
    _days(["1900-02-29"])


@refused("years run from 1 to 9999")
def _year_zero() -> None:
    """year 0

    Hard because: astronomers have it, calendars do not; files cannot hold it
    """
    _days(["0000-06-01"])


@holds(bound=0.0)
def _one_time() -> Distances:
    """a span of nothing, and a step longer than the span

    Hard because: the number of steps is zero
    Held against: one time, the first
    """
    for end, step in (("2000-01-01", "1 h"), ("2000-01-02", "9999 yr")):
        grid = _grid("2000-01-01", end, step)
        yield grid.size - 1
        yield grid.days()[0] + 0.5


# --- times and numbers of a motion ---------------------------------------------------------------

_RACKET = {"moments": [1.0, 2.0, 2.5], "omega": [0.1, 1.0, 0.1]}


@holds(bound=0.0)
def _hours() -> Distances:
    """times of a free rotor in hours

    Hard because: an array with a unit is an array, and 1 h would be taken for 1 s
    Held against: the same times in seconds, bit for bit
    """
    hours, seconds = (
        free_rotor(**_RACKET, times=times) for times in ([0.0, 1.0] * u.hour, [0.0, 3600.0])
    )
    for name in (*seconds.data_vars, "time"):
        yield hours[name].values - seconds[name].values


@holds(bound=0.0, unit="arcsec")
def _years() -> Distances:
    """a wobble of 1.2 years

    Hard because: the number is fine, and days are what a number would mean
    Held against: a wobble of 438.3 d over five years, bit for bit
    """
    chi = excitation(polar_motion(span=("1990-01-01", "1995-01-01")))
    result, same = (polar_motion_from(chi, period=period) for period in (1.2 * u.yr, 438.3))
    for name in ("x", "y"):
        yield result[name].values - same[name].values


@refused("give it")
def _no_top() -> None:
    """a top without numbers

    Hard because: a default would be answered as if it had been asked
    """
    Scene(compute="top", top={"times": [0.0, 1.0]})


@refused("they differ from those of j2")
def _not_aligned() -> None:
    """members whose labels do not align

    Hard because: arrays that share no label multiply to nothing, after every check
    """
    j2 = xr.DataArray([1.0e-3, 1.1e-3], {"member": ["a", "b"]}, ("member",))
    h = xr.DataArray([3.0e-3, 3.1e-3], {"member": ["b", "c"]}, ("member",))
    BODY.replace(j2=j2, dynamical_flattening=h)

"""Dates, calendars and units."""

from __future__ import annotations

import datetime as dt

import astropy.units as u
import numpy as np
import xarray as xr
from astropy.time import Time

from earthspin import dates
from earthspin.constants import DAY
from earthspin.errors import Where
from earthspin.numerics.arrays import FloatArray
from earthspin.questions.free_rotor import free_rotor
from earthspin.questions.polar_motion import excitation, polar_motion, polar_motion_from
from earthspin.scenes import Scene
from tests.extreme import Distances, holds, refused
from tests.reference.sky import BODY


def _days(times: object) -> FloatArray:
    """Convert a list of times in any form to days from J2000.0 TDB."""
    return dates.days(times, Where("times"))


def _grid(first: object, last: object, step: object) -> dates.TimeGrid:
    """Make evenly spaced times between two dates, from values as a user would type them."""
    span = dates.Span.read([first, last], Where("span"))
    return dates.TimeGrid.over(span, dates.Spacing().read(step, Where("step")))


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


@refused("there is no such date")
def test_no_leap_day() -> None:
    """refusal of the date 29 February 1900

    Hard because: the day does not exist; date arithmetic would make it 1 March
    """
    _days(["1900-02-29"])


@refused("years run from 1 to 9999")
def test_year_zero() -> None:
    """refusal of a date in the year 0

    Hard because: astronomers use the year 0, but calendars do not have it and files cannot hold it
    """
    _days(["0000-06-01"])


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


# --- times and numbers of a motion ---------------------------------------------------------------

_RACKET = {"moments": [1.0, 2.0, 2.5], "omega": [0.1, 1.0, 0.1]}


@holds(bound=0.0)
def test_hours() -> Distances:
    """times of a free rotor given in hours

    Hard because: an array with a unit is also an array, so 1 h might be read as 1 s
    Compared with: the same times in seconds, bit for bit
    """
    hours, seconds = (
        free_rotor(**_RACKET, times=times) for times in ([0.0, 1.0] * u.hour, [0.0, 3600.0])
    )
    for name in (*seconds.data_vars, "time"):
        yield hours[name].values - seconds[name].values


@holds(bound=0.0, unit="arcsec")
def test_years() -> Distances:
    """wobble period given as 1.2 years

    Hard because: the value is plausible, but a number without unit means days
    Compared with: wobble of 438.3 d over five years, bit for bit
    """
    chi = excitation(polar_motion(span=("1990-01-01", "1995-01-01")))
    result, same = (polar_motion_from(chi, period=period) for period in (1.2 * u.yr, 438.3))
    for name in ("x", "y"):
        yield result[name].values - same[name].values


@refused("required: ")
def test_no_top() -> None:
    """refusal of a heavy top without its required numbers

    Hard because: a default value would give an answer to a different question
    """
    Scene(compute="top", top={"times": [0.0, 1.0]})


@refused("they differ from those of j2")
def test_not_aligned() -> None:
    """refusal of body fields whose labels along `member` differ

    Hard because: arrays without a common label multiply to an empty array, after all checks
    """
    j2 = xr.DataArray([1.0e-3, 1.1e-3], {"member": ["a", "b"]}, ("member",))
    h = xr.DataArray([3.0e-3, 3.1e-3], {"member": ["b", "c"]}, ("member",))
    BODY.replace(j2=j2, dynamical_flattening=h)

"""Stiff and extreme cases of dates, calendars and units."""

from __future__ import annotations

import datetime as dt
from fractions import Fraction

import numpy as np
import xarray as xr

from earthspin import dates
from earthspin.checks.case import Distances, holds, refused
from earthspin.checks.sky import BODY
from earthspin.constants import DAY
from earthspin.errors import Where
from earthspin.questions.free_rotor import free_rotor
from earthspin.questions.polar_motion import excitation, polar_motion, polar_motion_from
from earthspin.scenes import Scene
from earthspin.units import FloatArray


def _days(times: object) -> FloatArray:
    """Days from J2000.0 TDB of a list of times in any form."""
    return dates.days(times, Where("times"))


def _grid(first: object, last: object, step: object) -> dates.TimeGrid:
    """Evenly spaced times between two dates, both as they would be typed."""
    span = dates.Span.read([first, last], Where("span"))
    return dates.TimeGrid.over(span, dates.Spacing().read(step, Where("step")))


def _time(values: object, scale: str) -> object:
    from astropy.time import Time

    return Time(values, scale=scale)


@holds(bound=2e-8, unit="s")
def _leap_second() -> Distances:
    """through the leap second of 2016-12-31

    Hard because: a minute of 61 seconds: 23:59:60 is a time, and the day is longer than 86400 s
    Held against: one second of TDB from each second of UTC to the next
    """
    stamps = [f"2016-12-31T23:59:{s}" for s in ("58", "59", "60")] + ["2017-01-01T00:00:00"]
    found = _days(_time(stamps, "utc"))
    yield np.diff(found) * DAY - 1


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
        utc, tdb = _days(_time(stamp, "utc")), _days([stamp])
        yield (utc - tdb) * DAY - 32.184 - so_far


@holds(bound=0.0, unit="d")
def _reform() -> Distances:
    """the Gregorian reform, 4 and 15 October 1582

    Hard because: calendars skip ten days there; a count of days may not
    Held against: Python's own proleptic ordinals, years 1 to 9999
    """
    known = ["1582-10-04", "1582-10-15", "0001-01-01", "1600-02-29", "1900-03-01", "9999-12-31"]
    found = _days(known)
    exact = [dt.date.fromisoformat(d).toordinal() - dt.date(2000, 1, 1).toordinal() for d in known]
    yield found - (np.array(exact) - 0.5)


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


@refused("write a date like")
def _negative_year() -> None:
    """a year before the first

    Hard because: a minus sign in a date is read in three ways
    """
    _days(["-0044-03-15"])


@refused("years run from 1 to 9999")
def _year_ten_thousand() -> None:
    """the year 10000

    Hard because: dates of five digits sort as text before the others
    """
    _days(np.array(["10000-01-01"], dtype="M8[us]"))


@refused("NaT is no date")
def _nat() -> None:
    """a date that is no date

    Hard because: NaT compares false with everything
    """
    _days(np.array(["2000-01-01", "NaT"], dtype="M8[us]"))


@holds(bound=3.0, unit="us")
def _microseconds() -> Distances:
    """microseconds from 1550 to 2650

    Hard because: a float of days keeps 5 us at the ends; nanoseconds would have wrapped to 2134
    Held against: the date that went in
    """
    known = np.array(["1550-01-01T00:00:00.000001", "2650-12-31T23:59:59.999999"], dtype="M8[us]")
    back = dates.datetime64(_days(known))
    yield (back - known).astype(np.int64)


@holds(bound=0.5, unit="us")
def _thirds() -> Distances:
    """a grid of a third of a second through a century

    Hard because: ten billion steps of a length that no float holds
    Held against: the last time in whole microseconds, exactly
    """
    grid = _grid("1950-01-01", "2050-01-01", 0.333333)
    last = Fraction(grid.start + grid.step * (grid.size - 1), dates.MICROSECONDS_PER_DAY)
    found = Fraction(float(grid.days(grid.size - 1)[0]))
    yield float((found - last) * dates.MICROSECONDS_PER_DAY)


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


@refused("greater than zero")
def _nan_step() -> None:
    """a step that is not a number

    Hard because: NaN passes every comparison that is written the wrong way round
    """
    _grid("2000-01-01", "2001-01-01", float("nan"))


@refused("ends before it starts")
def _backward_span() -> None:
    """a span that ends before it starts

    Hard because: a grid of a negative number of times
    """
    _grid("2001-01-01", "2000-01-01", "1 d")


@refused("is not a value in units of s")
def _wrong_unit() -> None:
    """a step in kilograms

    Hard because: the number is fine
    """
    Scene(compute="torque", step="6 kg")


@refused("a microsecond or more")
def _no_step() -> None:
    """a step of a billionth of a second

    Hard because: it rounds to no microsecond at all: a grid without end
    """
    _grid("2000-01-01", "2001-01-01", 1e-9)


@holds(bound=1.0, unit="us")
def _index_in_utc() -> Distances:
    """an index of dates that says UTC, over New Year 2017

    Hard because: an index that says its zone looks like one that means TDB, 69 s away
    Held against: the same times as a Time in UTC
    """
    import pandas as pd

    index = pd.date_range("2016-12-31T22:00", "2017-01-01T02:00", freq="37min", tz="UTC")
    plain = index.tz_localize(None).to_numpy().astype("datetime64[us]").astype(str)
    yield (_days(index) - _days(_time(list(plain), "utc"))) * dates.MICROSECONDS_PER_DAY


# --- times and numbers of a motion ---------------------------------------------------------------

_RACKET = {"moments": [1.0, 2.0, 2.5], "omega": [0.1, 1.0, 0.1]}


@holds(bound=0.0)
def _hours() -> Distances:
    """times of a free rotor in hours

    Hard because: an array with a unit is an array, and 1 h would be taken for 1 s
    Held against: the same times in seconds, bit for bit
    """
    import astropy.units as u

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
    import astropy.units as u

    chi = excitation(polar_motion(span=("1990-01-01", "1995-01-01")))
    found, same = (polar_motion_from(chi, period=period) for period in (1.2 * u.yr, 438.3))
    for name in ("x", "y"):
        yield found[name].values - same[name].values


@refused("is not a value in units of s")
def _kilograms() -> None:
    """times in kilograms

    Hard because: the number is fine
    """
    import astropy.units as u

    free_rotor(**_RACKET, times=[0.0, 1.0] * u.kg)


@refused("is not a value in units of s")
def _lapse_of_nothing() -> None:
    """a lapse of time that is none

    Hard because: NaT is a whole number inside, -292 billion years in microseconds
    """
    free_rotor(**_RACKET, times=np.array([0, "NaT"], dtype="m8[us]"))


@refused("give numbers that are all known")
def _masked_number() -> None:
    """a masked number among good ones

    Hard because: what is under the mask is a number, too
    """
    free_rotor(**_RACKET, times=np.ma.masked_array([0.0, 1.0], [False, True]))


@refused("give times that are all known")
def _masked_date() -> None:
    """a masked date among good ones

    Hard because: what is under the mask is a date, too
    """
    listed = np.array(["2000-01-01", "2000-01-02"], dtype="M8[us]")
    _days(np.ma.masked_array(listed, [False, True]))


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


@refused("has no such key")
def _key_of_another() -> None:
    """a key of another question

    Hard because: a step means nothing to an average, and would change nothing
    """
    Scene(compute="precession", step="1 h")

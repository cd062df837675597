"""Stiff and extreme cases of dates, calendars and units."""

from __future__ import annotations

import datetime as dt
from fractions import Fraction

import numpy as np
import xarray as xr

from earthspin import dates
from earthspin.checks.case import Cases
from earthspin.checks.default_body import default_body
from earthspin.constants import DAY
from earthspin.errors import Where
from earthspin.questions.free_rotor import free_rotor
from earthspin.questions.polar_motion import excitation, polar_motion, polar_motion_from
from earthspin.scenes import Scene
from earthspin.units import FloatArray

CASES = Cases("units")


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


@CASES.hold(
    "through the leap second of 2016-12-31",
    because="a minute of 61 seconds: 23:59:60 is a time, and the day is longer than 86400 s",
    against="one second of TDB from each second of UTC to the next",
    unit="s",
    bound=2e-8,
)
def _leap_second() -> float:
    stamps = [f"2016-12-31T23:59:{s}" for s in ("58", "59", "60")] + ["2017-01-01T00:00:00"]
    found = _days(_time(stamps, "utc"))
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
        utc = float(_days(_time(stamp, "utc"))[0])
        tdb = float(_days([stamp])[0])
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
    known = ["1582-10-04", "1582-10-15", "0001-01-01", "1600-02-29", "1900-03-01", "9999-12-31"]
    found = _days(known)
    exact = [dt.date.fromisoformat(d).toordinal() - dt.date(2000, 1, 1).toordinal() for d in known]
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
        around = _days([f"{year}-02-28", f"{year}-02-29", f"{year}-03-01"])
        worst = max(worst, float(np.max(np.abs(np.diff(around) - 1))))
    return worst


@CASES.refuse(
    "29 February 1900",
    because="no such day; arithmetic would make it 1 March",
    saying="there is no such date",
)
def _no_leap_day() -> None:
    _days(["1900-02-29"])


@CASES.refuse(
    "year 0",
    because="astronomers have it, calendars do not; files cannot hold it",
    saying="years run from 1 to 9999",
)
def _year_zero() -> None:
    _days(["0000-06-01"])


@CASES.refuse(
    "a year before the first",
    because="a minus sign in a date is read in three ways",
    saying="write a date like",
)
def _negative_year() -> None:
    _days(["-0044-03-15"])


@CASES.refuse(
    "the year 10000",
    because="dates of five digits sort as text before the others",
    saying="years run from 1 to 9999",
)
def _year_ten_thousand() -> None:
    _days(np.array(["10000-01-01"], dtype="M8[us]"))


@CASES.refuse(
    "a date that is no date",
    because="NaT compares false with everything",
    saying="NaT is no date",
)
def _nat() -> None:
    _days(np.array(["2000-01-01", "NaT"], dtype="M8[us]"))


@CASES.hold(
    "microseconds from 1550 to 2650",
    because="a float of days keeps 5 us at the ends; nanoseconds would have wrapped to 2134",
    against="the date that went in",
    unit="us",
    bound=3.0,
)
def _microseconds() -> float:
    known = np.array(["1550-01-01T00:00:00.000001", "2650-12-31T23:59:59.999999"], dtype="M8[us]")
    back = dates.datetime64(_days(known))
    return float(np.max(np.abs((back - known).astype(np.int64))))


@CASES.hold(
    "a grid of a third of a second through a century",
    because="ten billion steps of a length that no float holds",
    against="the last time in whole microseconds, exactly",
    unit="us",
    bound=0.5,
)
def _thirds() -> float:
    grid = _grid("1950-01-01", "2050-01-01", 0.333333)
    last = Fraction(grid.start + grid.step * (grid.size - 1), dates.MICROSECONDS_PER_DAY)
    found = Fraction(float(grid.days(grid.size - 1)[0]))
    return float(abs(found - last) * dates.MICROSECONDS_PER_DAY)


@CASES.hold(
    "a span of nothing, and a step longer than the span",
    because="the number of steps is zero",
    against="one time, the first",
    bound=0.0,
)
def _one_time() -> float:
    grids = [
        _grid("2000-01-01", "2000-01-01", "1 h"),
        _grid("2000-01-01", "2000-01-02", "9999 yr"),
    ]
    return float(sum(abs(grid.size - 1) + abs(grid.days()[0] + 0.5) for grid in grids))


@CASES.refuse(
    "a step that is not a number",
    because="NaN passes every comparison that is written the wrong way round",
    saying="greater than zero",
)
def _nan_step() -> None:
    _grid("2000-01-01", "2001-01-01", float("nan"))


@CASES.refuse(
    "a span that ends before it starts",
    because="a grid of a negative number of times",
    saying="ends before it starts",
)
def _backward_span() -> None:
    _grid("2001-01-01", "2000-01-01", "1 d")


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
    _grid("2000-01-01", "2001-01-01", 1e-9)


@CASES.hold(
    "an index of dates that says UTC, over New Year 2017",
    because="an index that says its zone looks like one that means TDB, 69 s away",
    against="the same times as a Time in UTC",
    unit="us",
    bound=1.0,
)
def _index_in_utc() -> float:
    import pandas as pd

    index = pd.date_range("2016-12-31T22:00", "2017-01-01T02:00", freq="37min", tz="UTC")
    plain = index.tz_localize(None).to_numpy().astype("datetime64[us]").astype(str)
    off = _days(index) - _days(_time(list(plain), "utc"))
    return float(np.max(np.abs(off)) * dates.MICROSECONDS_PER_DAY)


# --- times and numbers of a motion ---------------------------------------------------------------

_RACKET = {"moments": [1.0, 2.0, 2.5], "omega": [0.1, 1.0, 0.1]}


@CASES.hold(
    "times of a free rotor in hours",
    because="an array with a unit is an array, and 1 h would be taken for 1 s",
    against="the same times in seconds, bit for bit",
    bound=0.0,
)
def _hours() -> float:
    import astropy.units as u

    hours, seconds = (
        free_rotor(**_RACKET, times=times) for times in ([0.0, 1.0] * u.hour, [0.0, 3600.0])
    )
    off = [abs(hours[name].values - seconds[name].values).max() for name in seconds.data_vars]
    return float(max(off) + abs(hours.time.values - seconds.time.values).max())


@CASES.hold(
    "a wobble of 1.2 years",
    because="the number is fine, and days are what a number would mean",
    against="a wobble of 438.3 d over five years, bit for bit",
    unit="arcsec",
    bound=0.0,
)
def _years() -> float:
    import astropy.units as u

    chi = excitation(polar_motion(span=("1990-01-01", "1995-01-01")))
    found, same = (polar_motion_from(chi, period=period) for period in (1.2 * u.yr, 438.3))
    return float(max(abs(found[name].values - same[name].values).max() for name in ("x", "y")))


@CASES.refuse(
    "times in kilograms",
    because="the number is fine",
    saying="is not a value in units of s",
)
def _kilograms() -> None:
    import astropy.units as u

    free_rotor(**_RACKET, times=[0.0, 1.0] * u.kg)


@CASES.refuse(
    "a lapse of time that is none",
    because="NaT is a whole number inside, -292 billion years in microseconds",
    saying="is not a value in units of s",
)
def _lapse_of_nothing() -> None:
    free_rotor(**_RACKET, times=np.array([0, "NaT"], dtype="m8[us]"))


@CASES.refuse(
    "a masked number among good ones",
    because="what is under the mask is a number, too",
    saying="give numbers that are all known",
)
def _masked_number() -> None:
    free_rotor(**_RACKET, times=np.ma.masked_array([0.0, 1.0], [False, True]))


@CASES.refuse(
    "a masked date among good ones",
    because="what is under the mask is a date, too",
    saying="give times that are all known",
)
def _masked_date() -> None:
    listed = np.array(["2000-01-01", "2000-01-02"], dtype="M8[us]")
    _days(np.ma.masked_array(listed, [False, True]))


@CASES.refuse(
    "a top without numbers",
    because="a default would be answered as if it had been asked",
    saying="give it",
)
def _no_top() -> None:
    Scene(compute="top", top={"times": [0.0, 1.0]})


@CASES.refuse(
    "members whose labels do not align",
    because="arrays that share no label multiply to nothing, after every check",
    saying="they differ from those of j2",
)
def _not_aligned() -> None:
    numbers = {"j2": ("ab", [1.0e-3, 1.1e-3]), "dynamical_flattening": ("bc", [3.0e-3, 3.1e-3])}
    default_body().replace(
        **{
            name: xr.DataArray(values, {"member": list(labels)}, ("member",))
            for name, (labels, values) in numbers.items()
        }
    )


@CASES.refuse(
    "a key of another question",
    because="a step means nothing to an average, and would change nothing",
    saying="has no such key",
)
def _key_of_another() -> None:
    Scene(compute="precession", step="1 h")

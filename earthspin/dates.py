"""Read dates ("3000 BC"), and times far from J2000.0 ("-65 kyr"), in all accepted forms.

A date is read as days from J2000.0 TDB in two parts. Their sum is exact to a third of a microsecond
over a century; a single Julian date is exact to 40 microseconds. Regular grids are counted in whole
microseconds and are exact. A plain date is TDB in the proleptic Gregorian calendar with a year 0; a
date with another scale (a time zone, a Time in UTC) is converted. Each question limits its dates by
its ephemeris, table or model.
"""

from __future__ import annotations

import datetime as dt
import math
import re
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from typing import Annotated, Any, ClassVar, Literal, Self

import numpy as np
from numpy.typing import NDArray

from earthspin._lazy import erfa
from earthspin.constants import DAY, J2000_JD, JULIAN_YEAR
from earthspin.errors import SceneError, UnitsError, Where
from earthspin.numerics.arrays import FloatArray
from earthspin.units import Number, Plain, has_unit, is_bare, is_masked, pack, quantity, unpack

J2000 = np.datetime64("2000-01-01T12:00:00", "us")
MICROSECONDS_PER_DAY = 86_400_000_000
FIRST_UTC = 2436934.5  # Julian date of 1960-01-01
TABLES = "astropy-iers-data"  # the package that brings leap seconds and UT1
#: Start of the year 1 and end of the year 9999, days from J2000.0.
FIRST_DAY, END_DAY = -730_119.5, 2_921_939.5
#: How far from J2000.0 a date may lie that is counted in microseconds, d.
FARTHEST_DATE = 250_000 * JULIAN_YEAR / DAY
#: How far from J2000.0 a time over millennia may lie, s.
FARTHEST = 1e9 * JULIAN_YEAR
MOST_TIMES = 10_000_000
DURATION = "-65 kyr"
EXAMPLES = "'2000-01-01T12:00' or '3000 BC'"
_SECONDS = ("s", "ms", "us", "ns", "ps", "fs", "as")
_DATE = re.compile(
    r"""(?P<year>[-+]?\d{1,7})-(?P<day>\d\d-\d\d)
        (?:[T ](?P<clock>\d\d(?::\d\d)?)(?::(?P<second>(?:[0-5]\d|60)(?:\.\d*)?))?
           \s?(?P<zone>Z|UTC|[-+]\d\d:?[0-5]\d)?)?
      | (?P<ad>A\.?D\.?\s?)?(?P<counted>\d{1,3}(?:[,\s]\d{3})+|\d{1,7})
        (?(ad)|\s?(?:(?P<bc>B\.?C\.?(?:E\.?)?)|A\.?D\.?|C\.?E\.?))
      | (?P<modified>M)?JD\s?(?P<julian>\d{1,12})(?P<fraction>\.\d+)?""",
    re.IGNORECASE | re.VERBOSE,
)


def two_parts(value: Any, where: Where) -> tuple[Any, Any]:
    """Read one or more dates as days from J2000.0 TDB, split into two floats to keep all digits.

    Parameters
    ----------
    value : str, date, datetime64, Time, or array of them
        Text is ISO 8601 with any year, a year with its era (1 January), or a Julian date
        ("JD 2451545.0", "MJD 51544.5"). Dates of pandas, cftime, astropy and Skyfield are read,
        too, as are labelled arrays.
    where : Where

    Returns
    -------
    whole, rest : float or ndarray
        With the shape of the input.

    Raises
    ------
    SceneError
        If one of them is no date.
    """
    if is_masked(value):
        raise where.error("a masked time", "give times that are all known")
    if is_time(value):
        return _from_astropy(value, where, value)
    if is_skyfield_time(value):
        if not np.all(np.isfinite(value.tdb_fraction)):
            raise where.error("NaN", "NaN is no date")
        return value.whole - J2000_JD, value.tdb_fraction
    if isinstance(value, str):
        return _from_text(value, where)
    if type(value).__module__.startswith("cftime") and hasattr(value, "calendar"):
        return _from_cftime(value, where)
    if isinstance(value, (list, tuple)):
        return _from_list(value, (len(value),), where)
    stamps, series = value, getattr(value, "dt", value)
    zone = getattr(series, "tz", None) or getattr(getattr(value, "dtype", None), "time_zone", None)
    if zone is not None and hasattr(series, "tz_convert"):
        stamps = series.tz_convert(None)  # pandas and polars store UTC
    if hasattr(stamps, "to_numpy"):
        stamps = stamps.to_numpy()
    elif isinstance(stamps, dt.datetime):
        zone = stamps.utcoffset()
        stamps = np.datetime64(stamps.replace(tzinfo=None)) - np.timedelta64(zone or 0, "us")
    elif isinstance(stamps, dt.date):
        stamps = np.datetime64(stamps)
    try:
        stamps = np.asarray(stamps)
    except Exception:  # objects may raise any error when converted to an array
        raise where.error(value, f"write a date like {EXAMPLES}") from None
    if stamps.dtype.kind == "M":
        if np.isnat(stamps).any():
            raise where.error("NaT", "NaT is no date")
        if zone is not None:
            return _from_astropy(stamps, where, value)
        return _from_datetime64(stamps, where)
    elements = stamps.ravel().tolist()
    if stamps.dtype.kind not in "OU" or (not stamps.ndim and elements[0] is value):
        raise where.error(value, f"write a date like {EXAMPLES}")
    return _from_list(elements, stamps.shape, where)


def _from_list(values: Sequence[Any], shape: tuple[int, ...], where: Where) -> tuple[Any, Any]:
    if any(isinstance(value, (list, tuple)) or getattr(value, "shape", ()) for value in values):
        raise where.error("lists of lists", "give one or more times in one list")
    parts = [two_parts(value, where) for value in values]
    return tuple(np.moveaxis(np.reshape(parts, (*shape, 2)).astype(float), -1, 0))


def _from_text(text: str, where: Where) -> tuple[Any, Any]:
    date = _DATE.fullmatch(text.strip())
    if date is None:
        raise where.error(text, f"write a date like {EXAMPLES}")
    if date["julian"]:
        whole = int(date["julian"]) + (2400000.5 if date["modified"] else 0.0)
        return whole - J2000_JD, float(date["fraction"] or 0)
    year = int(date["year"] or re.sub(r"\D", "", date["counted"]))
    if date["counted"] and year == 0:
        raise where.error(text, "there is no year 0 with an era; 1 BC precedes AD 1")
    if date["bc"]:
        year = 1 - year
    day, clock, second = date["day"] or "01-01", date["clock"] or "00:00", date["second"] or "00"
    try:
        minute = np.datetime64(f"{year:0{4 + (year < 0)}}-{day}T{clock}", "m")
        zone = dt.time.fromisoformat("00:00" + (date["zone"] or "").upper().replace("UTC", "Z"))
    except ValueError:
        raise where.error(text, "there is no such date") from None
    if zone.tzinfo is not None:
        utc = minute - np.timedelta64(zone.utcoffset(), "m")
        return _from_astropy(f"{utc}:{second}", where, text)
    if second.startswith("60"):
        raise where.error(text, "there is no such date; a leap second is UTC, so end it with Z")
    whole, rest = _from_datetime64(minute, where)
    return whole, rest + float(second) / DAY


def _from_datetime64(stamps: Any, where: Where) -> tuple[Any, Any]:
    unit, part = np.datetime_data(stamps.dtype)[0], 0.0
    if unit in _SECONDS:  # NumPy itself does not round down near the first nanosecond
        size = 1000 ** _SECONDS.index(unit)
        count, part = np.divmod(stamps.astype(f"M8[{unit}]").astype(np.int64), size)
        stamps, part = count.astype("M8[s]"), part / size
    if np.any(np.abs(stamps.astype("M8[Y]").astype(np.int64)) > FARTHEST / JULIAN_YEAR):
        raise where.error(stamps, "give at most 1 Gyr from J2000.0")
    second = stamps.astype("M8[s]")
    midnight = second.astype("M8[D]")
    days = (midnight - J2000.astype("M8[D]")).astype(float)
    return days - 0.5, ((second - midnight).astype(float) + part) / DAY


def _from_cftime(date: Any, where: Where) -> tuple[float, float]:
    """Convert a cftime date to days from J2000.0 TDB: last midnight, and fraction of the day.

    The integer `toordinal` of cftime is the Julian date of noon.
    """
    if date.calendar not in ("standard", "gregorian", "proleptic_gregorian"):
        problem = f"its calendar '{date.calendar}' is neither 'standard' nor 'proleptic_gregorian'"
        raise where.error(str(date), f"{problem}; convert it to one of them")
    second = 3600 * date.hour + 60 * date.minute + date.second + date.microsecond * 1e-6
    return date.toordinal() - J2000_JD - 0.5, second / DAY


def _from_astropy(value: Any, where: Where, given: object) -> tuple[Any, Any]:
    """Convert an astropy Time, or UTC as text or datetime64, to days from J2000.0 TDB in two parts.

    UTC and UT1 are known from 1960 to a few years from now; outside they are refused.
    """
    from astropy.time import Time
    from astropy.utils import iers

    with (
        iers.conf.set_temp("auto_download", False),
        iers.conf.set_temp("auto_max_age", None),
        warnings.catch_warnings(),
    ):
        warnings.simplefilter("ignore")  # such as that of a missing folder for downloads
        warnings.simplefilter("error", erfa.ErfaWarning)  # UTC of a dubious year
        try:
            time = value if is_time(value) else Time(value, scale="utc")
            tdb = _with_tdb_minus_tt(time).tdb
            # of the last day before it, the library does not warn
            if time.scale in ("utc", "ut1") and np.min(time.jd, initial=np.inf) < FIRST_UTC:
                raise ValueError("not known")
            return tdb.jd1 - J2000_JD, tdb.jd2
        except Exception as error:  # kinds of the library and of ERFA, warnings among them
            if "end of day" in str(error):
                raise where.error(given, "there is no such date: it has no leap second") from None
            scale = getattr(value, "scale", "utc").upper()
            newer = f"install a newer {TABLES} if it lies after the end of its tables"
            problem = f"{scale} is not known at this date; give TDB, or {newer}"
            raise where.error(given, problem) from None


def _with_tdb_minus_tt(time: Any) -> Any:
    """Convert TT, TAI or TCG to TT, and set TDB - TT at the geocentre; leave other times unchanged.

    astropy computes TDB - TT by way of UTC, and refuses or warns where UTC is not known.
    """
    if time.scale not in ("tt", "tai", "tcg") or time.location is not None:
        return time
    tt = time.tt.replicate()
    # the series is for some thousand years; the difference never exceeds 2 ms
    tt.delta_tdb_tt = np.clip(erfa.dtdb(tt.jd1, tt.jd2, 0.0, 0.0, 0.0, 0.0), -2e-3, 2e-3)
    return tt


def is_skyfield_time(value: object) -> bool:
    """Return True for a Skyfield Time, without importing Skyfield."""
    return type(value).__module__ == "skyfield.timelib" and hasattr(value, "tdb_fraction")


def is_time(value: object) -> bool:
    """Return True for an astropy Time, without importing astropy."""
    return type(value).__module__.startswith("astropy.time") and hasattr(value, "sidereal_time")


def datetime64(days_tdb: FloatArray) -> NDArray[np.datetime64]:
    """Convert days from J2000.0 TDB to ``datetime64[us]``, the type of times in results.

    Dates that were given to the millisecond are returned exactly.

    Raises
    ------
    SceneError
        If a year is not from 1 to 9999, which files and plots of results need.
    """
    outside = (days_tdb < FIRST_DAY) | (days_tdb >= END_DAY)
    if np.any(outside):
        problem = "the time axis of an answer holds the years 1 to 9999; choose dates within them"
        raise SceneError("time", date_text(days_tdb[outside][0], "s"), problem)
    counts: NDArray[np.int64] = np.rint(days_tdb * MICROSECONDS_PER_DAY).astype(np.int64)
    # far from J2000.0 a float stands for the whole millisecond that it cannot be told from
    rounded = (counts + 500) // 1000 * 1000
    close = np.abs(rounded - counts) <= np.spacing(np.abs(days_tdb)) * MICROSECONDS_PER_DAY
    return J2000 + np.where(close, rounded, counts).astype("timedelta64[us]")


def date_text(day: float, unit: Literal["D", "s", "us"] = "D") -> str:
    """Convert days from J2000.0 TDB to a date as text, truncated to the given unit."""
    if not abs(day) <= FARTHEST_DATE:
        return f"{day:g} d from J2000.0"
    count = np.timedelta64(round(float(day) * MICROSECONDS_PER_DAY), "us")
    return str((J2000 + count).astype(f"M8[{unit}]"))


def days(times: object, where: Where) -> FloatArray:
    """Convert dates in any form that `two_parts` reads to days from J2000.0 TDB, shape (n,)."""
    return np.atleast_1d(np.add(*two_parts(times, where)))


def microseconds(value: Any, where: Where) -> int:
    """Convert one date to the whole number of microseconds from J2000.0 TDB."""
    whole, rest = two_parts(value, where)
    if np.ndim(whole):
        raise where.error(f"{np.size(whole)} times", "give one date")
    _check_reach(whole, value, where)
    day, part = divmod(float(whole), 1.0)
    return int(day) * MICROSECONDS_PER_DAY + round((part + float(rest)) * MICROSECONDS_PER_DAY)


def _check_reach(days: Any, given: object, where: Where) -> None:
    if np.max(np.abs(days), initial=0.0) > FARTHEST_DATE:
        raise where.error(given, "give a date at most 250,000 years from J2000.0")


def _epochs(value: Any, where: Where) -> Any:
    """Convert one or more times (durations from J2000.0, or dates) to seconds from J2000.0 TDB.

    Raises
    ------
    SceneError
        If one of them is neither.
    """
    if _type_of(value) in ("O", "U") and np.ndim(value) == 1:
        value = np.asarray(value).tolist()
    if isinstance(value, (list, tuple)):
        times = np.array([seconds(time, where) for time in value], dtype=float)
    elif _is_duration(value):
        try:
            times = np.asarray(quantity(value, "s", where, DURATION, epoch=True))
        except UnitsError:
            problem = f"give a time from J2000.0 like '{DURATION}', or a date like {EXAMPLES}"
            raise where.error(value, problem) from None
    else:
        times = DAY * np.add(*two_parts(value, where))
    if np.max(np.abs(times), initial=0.0) > FARTHEST:
        raise where.error(value, "give at most 1 Gyr from J2000.0")
    return times


def seconds(value: Any, where: Where) -> float:
    """Convert one time (a duration from J2000.0, or a date) to seconds from J2000.0 TDB."""
    if isinstance(value, (list, tuple)) or is_bare(value):
        raise where.error(value, f"give it with its unit, like '{DURATION}', or a date")
    time = _epochs(value, where)
    if np.ndim(time):
        raise where.error(value, f"give one time, like '{DURATION}'")
    return float(time)


def _is_duration(value: Any) -> bool:
    if isinstance(value, str):
        return not _DATE.fullmatch(value.strip())
    kind = _type_of(value)
    is_date = is_time(value) or isinstance(value, dt.date) or kind == "M"
    # numbers with a unit are also labelled arrays, such as the epochs of an answer
    return not is_date and (has_unit(value) or kind == "m")


def _type_of(value: Any) -> str:
    """Letter for the type of the elements of an array of NumPy, xarray or pandas."""
    return str(getattr(getattr(value, "dtype", None), "kind", ""))


@dataclass(frozen=True)
class Ends:
    """Base class of time spans, from a first to a last time.

    Attributes
    ----------
    first, last : float
        Time in the unit that `time` returns.
    """

    first: float
    last: float

    time: ClassVar[Any]
    allowed: ClassVar[str]

    @classmethod
    def read(cls, value: Any, where: Where) -> Self:
        """Make a time span from a pair of times; refuse a span that ends before it starts.

        Raises
        ------
        SceneError
            If there are not two times, or the second is before the first.
        """
        if isinstance(value, cls):
            return value
        try:
            ends = tuple(() if isinstance(value, (str, Mapping, set)) else value)
        except TypeError:  # one time
            ends = ()
        if len(ends) != 2:
            raise where.error(value, f"give {cls.allowed}")
        first, last = (cls.time(end, where) for end in ends)
        if last < first:
            problem = "it ends before it starts; put the earlier first"
            raise where.error([str(end) for end in ends], problem)
        return cls(first, last)


@dataclass(frozen=True)
class Span(Ends):
    """Time span from a first to a last date.

    Attributes
    ----------
    first, last : int
        Microseconds from J2000.0 TDB.
    """

    first: int
    last: int

    time = staticmethod(microseconds)
    allowed = "two dates, like ['2000-01-01', '2001-01-01']"
    words, hint = "two dates", "tuple[Date, Date] | SkyfieldTime"

    def write(self) -> Plain:
        """Return both dates as text, to the microsecond, for a scene file."""
        return [str(J2000 + np.timedelta64(count, "us")) for count in (self.first, self.last)]

    @property
    def days(self) -> tuple[float, float]:
        """First and last date of the span, days from J2000.0 TDB."""
        return self.first / MICROSECONDS_PER_DAY, self.last / MICROSECONDS_PER_DAY


@dataclass(frozen=True)
class YearSpan(Ends):
    """Time span over millennia, in seconds from J2000.0 TDB."""

    time = staticmethod(seconds)
    allowed = "two times, like ['-1 Myr', '0 kyr']"
    words, hint = "two times from J2000.0, or two dates", "tuple[Epoch, Epoch]"

    def write(self) -> Plain:
        """Return both times as text, in seconds with all digits, for a scene file."""
        return [f"{self.first!r} s", f"{self.last!r} s"]


@dataclass(frozen=True)
class TimeGrid:
    """Evenly spaced times, exact to the microsecond, which are computed only when needed.

    Attributes
    ----------
    start : int
        First time, microseconds from J2000.0 TDB.
    step : int
        Spacing, microseconds.
    size : int
        Number of times; the last one does not pass the end of the span.
    """

    start: int
    step: int
    size: int

    @classmethod
    def over(cls, span: Span, step: float) -> TimeGrid:
        """Make a grid of times within a span, from its start and `step` seconds apart.

        The last time is the end, or the last step before it.
        """
        spacing = round(step * 1e6)
        return cls(span.first, spacing, (span.last - span.first) // spacing + 1)

    def span(self) -> tuple[float, float]:
        """First and last time of the grid, days from J2000.0 TDB."""
        return float(self.days(0, 1)[0]), float(self.days(self.size - 1)[0])

    def days(self, first: int = 0, last: int | None = None, every: int = 1) -> FloatArray:
        """Times of the grid with indices range(first, last, every), days from J2000.0 TDB."""
        index = np.arange(first, self.size if last is None else last, every, dtype=np.int64)
        whole, rest = np.divmod(self.start + self.step * index, MICROSECONDS_PER_DAY)
        return np.asarray(whole + rest / MICROSECONDS_PER_DAY)


@dataclass(frozen=True, eq=False)
class ListedTimes:
    """Base class of lists of times in any order.

    Attributes
    ----------
    listed : ndarray, shape (n,)
        Days or seconds from J2000.0 TDB.
    """

    listed: FloatArray

    @classmethod
    def times(cls, value: Any, where: Where) -> FloatArray:
        """Convert a list of dates, in any form that `days` reads, to days from J2000.0 TDB."""
        listed = days(value, where)
        _check_reach(listed, value, where)
        return listed

    @classmethod
    def read(cls, value: Any, where: Where) -> Self:
        """Read a list of times, or restore it from the table that `write` returns."""
        if isinstance(value, cls):
            return value
        listed = unpack(value, where) if isinstance(value, Mapping) else cls.times(value, where)
        if listed.ndim != 1 or listed.size == 0:
            raise where.error(f"shape {listed.shape}", "give one or more times in one list")
        return cls(listed)

    def write(self) -> Plain:
        """Return the times in the form stored in scene files: a table of bytes."""
        return pack(self.listed)


class TimeList(ListedTimes):
    """List of times in any order, stored as days from J2000.0 TDB."""

    words, hint = "a list of times", "Dates"

    @property
    def size(self) -> int:
        """Number of times in the list."""
        return int(self.listed.size)

    def span(self) -> tuple[float, float]:
        """Earliest and latest time of the list, days from J2000.0 TDB."""
        return float(self.listed.min()), float(self.listed.max())

    def days(self, first: int = 0, last: int | None = None, every: int = 1) -> FloatArray:
        """Times of the list with indices range(first, last, every), days from J2000.0 TDB."""
        return self.listed[first:last:every]


class YearList(ListedTimes):
    """List of times over millennia, stored in seconds from J2000.0 TDB."""

    words, hint = "a list of times from J2000.0, or of dates", "Epochs"

    @classmethod
    def times(cls, value: Any, where: Where) -> FloatArray:
        """Convert durations from J2000.0, or dates, to seconds from J2000.0 TDB, shape (n,)."""
        return np.atleast_1d(_epochs(value, where))


#: The times of a series.
Epochs = TimeGrid | TimeList


#: Kind of input: a time step, in s.
SPACING = Number(
    "s", "6 h", low=1e-6, high=1e4 * JULIAN_YEAR, limits="give 1 microsecond to 10,000 years"
)
Step = Annotated[float, SPACING]
#: A step between times over millennia, s.
YearStep = Annotated[
    float,
    Number("s", "1 kyr", low=DAY, high=FARTHEST, plain=False, limits="give 1 day to 1 Gyr"),
]


def grid(span: YearSpan, step: float, where: Where) -> FloatArray:
    """Evenly spaced times within a span, from its start, in seconds from J2000.0 TDB.

    Raises
    ------
    SceneError
        If there would be more than `MOST_TIMES`.
    """
    count = math.floor((span.last - span.first) / step * (1 + 1e-12)) + 1
    if count > MOST_TIMES:
        raise where.error(f"{step / JULIAN_YEAR:g} yr", f"{count} times; give a longer step")
    places = max(-int(Decimal(repr(time)).as_tuple().exponent) for time in (span.first, step))
    return np.round(span.first + step * np.arange(count), max(places, 0))

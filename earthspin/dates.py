"""Conversion of dates (text, datetime, astropy and Skyfield times) to days of TDB.

Inside, a time is a count of days from J2000.0 TDB: a float64 keeps it to a third of a microsecond
over a century, where one Julian date keeps 40 microseconds. Regular grids are counted in whole
microseconds and are exact. Plain dates mean TDB; whatever says that it is another scale (a time
zone, a Time in UTC) is converted.
"""

from __future__ import annotations

import datetime as dt
import math
import re
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Annotated, Any, Self, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import J2000_JD, JULIAN_YEAR
from earthspin.errors import SceneError, Where
from earthspin.numerics.arrays import FloatArray
from earthspin.units import Number, Plain, is_masked, pack, unpack

J2000 = np.datetime64("2000-01-01T12:00:00", "us")
MICROSECONDS_PER_DAY = 86_400_000_000
FIRST_UTC = 2436934.5  # Julian date of 1960-01-01
LAST_UTC = 2488069.5  # Julian date of 2100-01-01; later times need more than newer tables
TABLES = "astropy-iers-data"  # the package that brings leap seconds and UT1
LONGEST_STEP = 10_000 * JULIAN_YEAR  # s
_Time = TypeVar("_Time", int, float)
_ISO_DATE = re.compile(r"\d{4}-\d\d-\d\d([T ]\d\d(:\d\d(:\d\d(\.\d{1,6})?)?)?)?(Z|[-+]\d\d:?\d\d)?")


def microseconds(value: Any, where: Where) -> int:
    """Convert one date to the whole number of microseconds from J2000.0 TDB.

    Parameters
    ----------
    value : str, date, datetime, datetime64 or Time
        Plain dates mean TDB. A Time of astropy is converted from its own scale, one of Skyfield
        gives its TDB; a date with a time zone is UTC, and is converted, too.
    where : Where
        What is being read.

    Raises
    ------
    SceneError
        If it is no date.
    """
    if isinstance(value, str):
        value = value.strip()
        if not _ISO_DATE.fullmatch(value):
            raise where.error(value, "write a date like '2000-01-01T12:00'")
        if value[10:].endswith("Z") or re.search(r"[-+]\d\d:?\d\d$", value[10:]):
            try:
                value = dt.datetime.fromisoformat(value)
            except ValueError:
                raise where.error(value, "there is no such date") from None
    if getattr(value, "shape", None) == () and hasattr(value, "dims"):
        value = value.values[()]  # one time of a labelled series
    if isinstance(value, dt.datetime) and value.tzinfo is not None:
        try:
            value = value.astimezone(dt.UTC).replace(tzinfo=None)
        except OverflowError:
            raise where.error(value, "there is no such date in UTC") from None
        return int(_from_utc(value, where))
    if is_time(value) or is_skyfield_time(value):
        if value.shape != ():
            raise where.error(f"{math.prod(value.shape)} times", "give one date")
        return round(float(_days_of(value, where)) * MICROSECONDS_PER_DAY)
    if not isinstance(value, (str, dt.date, np.datetime64)):
        raise where.error(value, "write a date like '2000-01-01T12:00'")
    try:
        stamp = np.datetime64(cast(Any, value), "us")
        year = int(np.datetime64(cast(Any, value), "Y").astype(np.int64)) + 1970
    except (TypeError, ValueError):
        raise where.error(value, "there is no such date") from None
    if np.isnat(stamp):
        raise where.error("NaT", "NaT is no date")
    if not 1 <= year <= 9999:
        raise where.error(value, "years run from 1 to 9999")
    return int(np.asarray(stamp - J2000).astype(np.int64))


def _from_utc(value: Any, where: Where) -> NDArray[np.int64]:
    """Convert UTC, given as a datetime or an array of datetime64, to microseconds of TDB."""
    from astropy.time import Time

    with _tables_at_hand(), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what is wrong shows when it is brought to TDB
        utc = Time(value, scale="utc")
    days_tdb = _days_from_time(utc, where, str(value).splitlines()[0])
    return np.asarray(np.rint(days_tdb * MICROSECONDS_PER_DAY), dtype=np.int64)


def days(times: object, where: Where) -> FloatArray:
    """Convert a list of times to days from J2000.0 TDB.

    Parameters
    ----------
    times : Time (astropy's or Skyfield's), DataArray, pandas index, datetime64, or list of dates
    where : Where

    Returns
    -------
    ndarray, shape (n,)

    Raises
    ------
    SceneError
        If one of them is no date, or there are none.
    """
    if is_time(times) or is_skyfield_time(times):
        days_tdb = np.atleast_1d(_days_of(times, where))
    else:
        counts = _counts(times, where)
        whole, rest = np.divmod(counts, MICROSECONDS_PER_DAY)
        days_tdb = whole + rest / MICROSECONDS_PER_DAY
    if days_tdb.ndim != 1 or days_tdb.size == 0:
        raise where.error(f"shape {days_tdb.shape}", "give one or more times in one list")
    return np.asarray(days_tdb, dtype=np.float64)


def _counts(times: Any, where: Where) -> NDArray[np.int64]:
    """Convert a list of dates to whole microseconds from J2000.0 TDB.

    An astropy Time is not accepted.
    """
    if is_masked(times):
        raise where.error("a masked time", "give times that are all known")
    zone = getattr(times, "tz", None) or getattr(getattr(times, "dt", None), "tz", None)
    if zone is not None:  # an index or series of pandas that says its zone
        times = np.asarray(times, dtype="datetime64[us]")  # in UTC, as pandas keeps it
        _check_years(times, where)
        return np.atleast_1d(_from_utc(times, where))
    try:
        values = np.atleast_1d(np.asarray(getattr(times, "values", times)))
    except ValueError:
        raise where.error("uneven lists", "give one or more times in one list") from None
    if values.dtype.kind != "M":
        listed = [microseconds(t, where) for t in values.ravel().tolist()]
        return np.array(listed, dtype=np.int64).reshape(values.shape)
    _check_years(values, where)
    return (values.astype("datetime64[us]") - J2000).astype(np.int64)


def _check_years(values: NDArray[np.datetime64], where: Where) -> None:
    if np.isnat(values).any():
        raise where.error("NaT", "NaT is no date")
    for extreme in (values.min(), values.max()) if values.size else ():
        microseconds(extreme, where)


def _days_from_time(time: Any, where: Where, shown: str = "") -> Any:
    """Convert an astropy Time to days from J2000.0 TDB without loss of digits.

    UTC and UT1 are known from 1960 to a few years from now; outside they are refused.
    """
    if is_masked(time):
        raise where.error("a masked time", "give times that are all known")
    try:
        with _tables_at_hand(), warnings.catch_warnings():
            warnings.simplefilter("error")
            tdb = _with_tdb_minus_tt(time).tdb
            days_tdb = (tdb.jd1 - J2000_JD) + tdb.jd2
        # of the last day before it, the library does not warn
        is_known = time.scale not in ("utc", "ut1") or np.min(time.jd) >= FIRST_UTC
    except Exception:  # the library and ERFA have kinds of their own, warnings among them
        is_known = False
    if not is_known:
        problem = f"{time.scale.upper()} is not known then; give TDB"
        if FIRST_UTC < np.max(time.jd) < LAST_UTC:
            problem += f", or install newer tables ({TABLES})"
        raise where.error(shown or _as_given(time), problem) from None
    return days_tdb


def _as_given(time: Any) -> str:
    """First time of an astropy Time as text, in its own format."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # "dubious year" of ERFA
        return str(np.ravel(time.value)[0])


def _with_tdb_minus_tt(time: Any) -> Any:
    """Return a time in TT with TDB - TT at the centre of the Earth, if its scale is uniform.

    astropy computes TDB - TT by way of UTC, and refuses or warns where UTC is not known.
    """
    if time.scale not in ("tt", "tai", "tcg") or time.location is not None:
        return time
    import erfa

    tt = time.tt.replicate()
    # the series is for some thousand years; the difference never exceeds 2 ms
    tt.delta_tdb_tt = np.clip(erfa.dtdb(tt.jd1, tt.jd2, 0.0, 0.0, 0.0, 0.0), -2e-3, 2e-3)
    return tt


def _days_of(time: Any, where: Where) -> Any:
    """Convert a time of astropy or Skyfield to days from J2000.0 TDB."""
    if not is_skyfield_time(time):
        return _days_from_time(time, where)
    days_tdb = (time.whole - J2000_JD) + time.tdb_fraction
    if not np.all(np.isfinite(days_tdb)):
        raise where.error("NaN", "NaN is no date")
    return days_tdb


def is_skyfield_time(value: object) -> bool:
    """Return True for a Skyfield Time, without importing Skyfield."""
    return type(value).__module__ == "skyfield.timelib" and hasattr(value, "tdb_fraction")


@contextmanager
def _tables_at_hand() -> Iterator[None]:
    """Make astropy use its installed tables of leap seconds and UT1, without a download.

    The age of these tables is not checked.
    """
    from astropy.utils import iers

    with iers.conf.set_temp("auto_download", False), iers.conf.set_temp("auto_max_age", None):
        yield


def is_time(value: object) -> bool:
    """Return True for an astropy Time, without importing astropy."""
    return type(value).__module__.startswith("astropy.time") and hasattr(value, "scale")


def datetime64(days_tdb: FloatArray) -> NDArray[np.datetime64]:
    """Convert days from J2000.0 TDB to ``datetime64[us]``, the type of times in results."""
    counts: NDArray[np.int64] = np.rint(days_tdb * MICROSECONDS_PER_DAY).astype(np.int64)
    return J2000 + counts.astype("timedelta64[us]")


def first_and_last(
    value: Any, where: Where, read: Callable[[Any, Where], _Time], allowed: str
) -> tuple[_Time, _Time]:
    """Read the first and the last time of a span; refuse a last time before the first.

    Raises
    ------
    SceneError
        If there are not two times, or the second is before the first.
    """
    if is_skyfield_time(value) and value.shape:
        value = list(value)
    pair = (
        not is_skyfield_time(value)
        and not isinstance(value, (str, Mapping, set))
        and hasattr(value, "__len__")
    )
    if not pair or getattr(value, "ndim", 1) != 1 or len(value) != 2:
        raise where.error(value, f"give {allowed}")
    first, last = (read(time, where) for time in value)
    if last < first:
        problem = "it ends before it starts; put the earlier first"
        raise where.error([str(time) for time in value], problem)
    return first, last


@dataclass(frozen=True)
class Span:
    """Time span from a first to a last date.

    Attributes
    ----------
    first, last : int
        Microseconds from J2000.0 TDB.
    """

    first: int
    last: int

    words, hint = "two dates", "tuple[Date, Date] | SkyfieldTime"

    @classmethod
    def read(cls, value: Any, where: Where) -> Span:
        """Read the first and the last date of a span; refuse a last date before the first."""
        if isinstance(value, Span):
            return value
        allowed = "two dates, like ['2000-01-01', '2001-01-01']"
        return cls(*first_and_last(value, where, microseconds, allowed))

    def write(self) -> Plain:
        """Form stored in scene files: both dates as text, to the microsecond."""
        return [str(J2000 + np.timedelta64(count, "us")) for count in (self.first, self.last)]

    @property
    def days(self) -> tuple[float, float]:
        """First and last date of the span, days from J2000.0 TDB."""
        return self.first / MICROSECONDS_PER_DAY, self.last / MICROSECONDS_PER_DAY


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
        """Make times from the start of a span to at most its end, `step` seconds apart.

        The last time is the end, or the last step before it.
        """
        spacing = round(step * 1e6)
        return cls(span.first, spacing, (span.last - span.first) // spacing + 1)

    def span(self) -> tuple[float, float]:
        """First and last time of the grid, days from J2000.0 TDB."""
        return float(self.days(0, 1)[0]), float(self.days(self.size - 1)[0])

    def days(self, first: int = 0, last: int | None = None, every: int = 1) -> FloatArray:
        """Days from J2000.0 TDB of every n-th time of the grid, from `first` to `last` - 1."""
        index = np.arange(first, self.size if last is None else last, every, dtype=np.int64)
        whole, rest = np.divmod(self.start + self.step * index, MICROSECONDS_PER_DAY)
        return np.asarray(whole + rest / MICROSECONDS_PER_DAY)


@dataclass(frozen=True, eq=False)
class Listed:
    """List of times in any order.

    Attributes
    ----------
    listed : ndarray, shape (n,)
        Days or seconds from J2000.0 TDB.
    """

    listed: FloatArray

    @classmethod
    def times(cls, value: Any, where: Where) -> FloatArray:
        """Read a list of times in any form that the function `days` takes."""
        return days(value, where).copy()

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


class TimeList(Listed):
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
        """Days from J2000.0 TDB of every n-th time of the list, from `first` to `last` - 1."""
        return self.listed[first:last:every]


#: The times of a series.
Epochs = TimeGrid | TimeList


@dataclass(frozen=True)
class Spacing(Number):
    """Kind of input: a time step of at least a microsecond and less than 10,000 years."""

    unit: str = "s"
    example: str = "6 h"

    def read(self, value: object, where: Where) -> float:
        """Convert a time step to seconds, and refuse a step outside the allowed range."""
        try:
            step = super().read(value, where)
        except SceneError as error:
            if "finite" not in str(error):
                raise
            step = float("nan")
        if not 1e-6 <= step < LONGEST_STEP:
            problem = "a step is greater than zero: a microsecond or more, less than 10000 years"
            raise where.error(value, problem)
        return step


#: A step between times, s.
Step = Annotated[float, Spacing()]

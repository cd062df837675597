"""The border: quantities, times and strings become SI floats and days of TDB.

Inside, a time is a count of days from J2000.0 TDB: a float64 keeps it to a third of a
microsecond over a century, where one Julian date keeps 40 microseconds. Regular grids are
counted in whole microseconds and are exact.
"""

from __future__ import annotations

import datetime as dt
import re
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin.errors import SceneError, UnitsError

J2000 = np.datetime64("2000-01-01T12:00:00", "us")
MICROSECONDS_PER_DAY = 86_400_000_000
LONGEST_STEP = 10_000 * 365.25 * 86_400.0  # s
_ISO_DATE = re.compile(r"\d{4}-\d\d-\d\d([T ]\d\d(:\d\d(:\d\d(\.\d{1,6})?)?)?)?")

FloatArray = NDArray[np.float64]


def quantity(value: Any, unit: str, what: str, example: str) -> Any:
    """Convert a value with a unit to a float in `unit`.

    Parameters
    ----------
    value : str, Quantity, number or array
        ``"6 h"``, a Quantity, or a plain number that is in `unit` already.
    unit : str
        The unit wanted, as astropy writes it.
    what, example : str
        What is being read, and how it should look, for the message.

    Returns
    -------
    float or array
        The value in `unit`; labelled arrays pass through.

    Raises
    ------
    UnitsError
        If a string has no unit or one of another kind.
    """
    if isinstance(value, bool):
        raise UnitsError(what, value, unit, example)
    is_quantity = hasattr(value, "to_value")  # a Quantity is an ndarray too
    if not is_quantity and (isinstance(value, (int, float, np.ndarray)) or hasattr(value, "dims")):
        return value
    import astropy.units as u

    try:
        read = u.Quantity(value)
        if isinstance(value, str) and read.unit == u.dimensionless_unscaled and unit:
            raise ValueError("no unit")
        # Angles may become pure numbers of radians, nothing else changes kind.
        converted = read.to_value(u.Unit(unit))
    except (TypeError, ValueError, u.UnitConversionError):
        raise UnitsError(what, value, unit or "a pure number", example) from None
    return float(converted) if np.ndim(converted) == 0 else converted


def number(value: Any, unit: str, what: str, example: str) -> float:
    """Convert one value with a unit to a float in `unit`, as `quantity` does.

    Raises
    ------
    UnitsError
        If it is not one value.
    """
    converted = quantity(value, unit, what, example)
    if np.ndim(converted) != 0:
        raise UnitsError(what, value, unit or "a pure number", example)
    return float(converted)


def seconds(value: Any, what: str = "duration") -> float:
    """Convert a duration (``"6 h"``, Quantity, timedelta, seconds) to seconds.

    Raises
    ------
    UnitsError
        If it is not a duration.
    """
    if isinstance(value, dt.timedelta):
        return value.total_seconds()
    if isinstance(value, np.timedelta64):
        return float(value / np.timedelta64(1, "us")) * 1e-6
    return number(value, "s", what, "6 h")


def microseconds(value: Any, key: str = "date", source: str = "scene") -> int:
    """Convert one date to whole microseconds from J2000.0 TDB.

    Parameters
    ----------
    value : str, date, datetime, datetime64 or Time
        Plain dates mean TDB. A Time is converted to TDB from its own scale.
    key, source : str
        What is being read, for the message.

    Raises
    ------
    SceneError
        If it is no date.
    """
    if isinstance(value, str):
        if not _ISO_DATE.fullmatch(value.strip()):
            raise SceneError(key, value, "write a date like '2000-01-01T12:00'", source=source)
        value = value.strip()
    elif isinstance(value, dt.datetime) and value.tzinfo is not None:
        raise SceneError(key, value, "dates mean TDB; leave the time zone out", source=source)
    elif _is_astropy_time(value):
        return round(float(days_from_time(value)) * MICROSECONDS_PER_DAY)
    elif not isinstance(value, (dt.date, np.datetime64)):
        raise SceneError(key, value, "write a date like '2000-01-01T12:00'", source=source)
    try:
        stamp = np.datetime64(value, "us")
        year = int(np.datetime64(value, "Y").astype(np.int64)) + 1970
    except ValueError:
        raise SceneError(key, value, "there is no such date", source=source) from None
    if not np.isnat(stamp) and not 1 <= year <= 9999:
        raise SceneError(key, value, "years run from 1 to 9999", source=source)
    if np.isnat(stamp):
        raise SceneError(key, value, "NaT is no date", source=source)
    return int((stamp - J2000) / np.timedelta64(1, "us"))


def span_days(span: tuple[Any, Any], source: str = "scene") -> FloatArray:
    """First and last day of a span, from J2000.0 TDB, shape (2,)."""
    return np.array([microseconds(date, "span", source) for date in span]) / MICROSECONDS_PER_DAY


def days(times: Any) -> FloatArray:
    """Convert a list of times to days from J2000.0 TDB.

    Parameters
    ----------
    times : Time, DataArray, array of datetime64, or sequence of dates

    Returns
    -------
    ndarray, shape (n,)

    Raises
    ------
    SceneError
        If one of them is no date, or there are none.
    """
    if _is_astropy_time(times):
        found = np.atleast_1d(days_from_time(times))
    else:
        values = np.atleast_1d(np.asarray(getattr(times, "values", times)))
        if values.dtype.kind == "M":
            if np.isnat(values).any():
                raise SceneError("times", "NaT", "NaT is no date")
            for extreme in (values.min(), values.max()):
                microseconds(extreme, "times")
            counts = (values.astype("datetime64[us]") - J2000).astype(np.int64)
        else:
            counts = np.array([microseconds(t, "times") for t in values.ravel().tolist()])
        whole, rest = np.divmod(counts.reshape(values.shape), MICROSECONDS_PER_DAY)
        found = whole + rest / MICROSECONDS_PER_DAY
    if found.ndim != 1 or found.size == 0:
        raise SceneError("times", f"shape {found.shape}", "give one or more times in one list")
    return np.asarray(found, dtype=np.float64)


def days_from_time(time: Any) -> Any:
    """Days from J2000.0 TDB of an astropy Time, keeping both parts of it."""
    if np.any(time.mask):
        raise SceneError("times", "a masked time", "give times that are all known")
    tdb = time.tdb
    return (tdb.jd1 - 2451545.0) + tdb.jd2


def datetime64(days_tdb: FloatArray) -> NDArray[np.datetime64]:
    """Days from J2000.0 TDB as ``datetime64[us]``, the time coordinate of every dataset."""
    counts: NDArray[np.int64] = np.rint(days_tdb * MICROSECONDS_PER_DAY).astype(np.int64)
    return J2000 + counts.astype("timedelta64[us]")


@dataclass(frozen=True)
class TimeGrid:
    """Evenly spaced times, exact to the microsecond, made only as they are needed.

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

    def span(self) -> tuple[float, float]:
        """Earliest and latest, days from J2000.0 TDB."""
        return float(self.days(0, 1)[0]), float(self.days(self.size - 1)[0])

    def days(self, first: int = 0, last: int | None = None) -> FloatArray:
        """Days from J2000.0 TDB of the times from `first` up to `last`."""
        index = np.arange(first, self.size if last is None else last, dtype=np.int64)
        whole, rest = np.divmod(self.start + self.step * index, MICROSECONDS_PER_DAY)
        return np.asarray(whole + rest / MICROSECONDS_PER_DAY)


@dataclass(frozen=True, eq=False)
class TimeList:
    """Times as they were listed, in any order.

    Attributes
    ----------
    listed : ndarray, shape (n,)
        Days from J2000.0 TDB.
    """

    listed: FloatArray

    @property
    def size(self) -> int:
        """How many there are."""
        return int(self.listed.size)

    def span(self) -> tuple[float, float]:
        """Earliest and latest, days from J2000.0 TDB."""
        return float(self.listed.min()), float(self.listed.max())

    def days(self, first: int = 0, last: int | None = None) -> FloatArray:
        """Days from J2000.0 TDB of the times from `first` up to `last`."""
        return self.listed[first:last]


def time_grid(start: Any, stop: Any, step: Any, source: str = "scene") -> TimeGrid:
    """Times from `start` to `stop` inclusive, `step` apart.

    Parameters
    ----------
    start, stop : date
        As `microseconds` takes them.
    step : duration
        As `seconds` takes it; at least a microsecond.
    source : str
        The file, for messages.

    Raises
    ------
    SceneError
        If the span ends before it starts, or the step is not greater than zero.
    """
    first, last = microseconds(start, "span", source), microseconds(stop, "span", source)
    if last < first:
        raise SceneError(
            "span",
            [str(start), str(stop)],
            "it ends before it starts; put the earlier date first",
            source=source,
        )
    length = seconds(step, f"{source}: step")
    if not 1e-6 <= length < LONGEST_STEP:
        raise SceneError(
            "step",
            step,
            "a step is greater than zero: a microsecond or more, less than 10000 years",
            source=source,
        )
    spacing = round(length * 1e6)
    return TimeGrid(first, spacing, (last - first) // spacing + 1)


def _is_astropy_time(value: Any) -> bool:
    """Recognise an astropy Time without importing astropy for those who use none."""
    return type(value).__module__.startswith("astropy.time") and hasattr(value, "tdb")

"""Read times over millennia: seconds of TDB from J2000.0, from durations or dates.

They are given as durations from J2000.0 (``"-65 kyr"``, ``"1 Myr"``) or as dates of the proleptic
Gregorian calendar with astronomical years (``"-3000-01-01"``: the year 0 stands before the year 1).
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np

from earthspin.constants import DAY, JULIAN_YEAR
from earthspin.dates import J2000, Listed, days, first_and_last, microseconds
from earthspin.errors import UnitsError, Where
from earthspin.numerics.arrays import FloatArray
from earthspin.units import Number, Plain, quantity

#: How far from J2000.0 a time may lie, and how short a step may be, s.
FARTHEST, SHORTEST = 1e9 * JULIAN_YEAR, DAY
MOST_TIMES = 10_000_000
_FAR_DATE = re.compile(r"([-+]?\d{1,7})-(\d\d)-(\d\d)")
#: A year with its era; the year may have commas, as in "10,000 BC".
_YEAR = re.compile(r"(\d{1,3}(?:,\d{3})+|\d{1,7}) ?(BCE?|AD|CE)", re.IGNORECASE)
EXAMPLE = "-65 kyr"


def seconds(value: Any, where: Where) -> float:
    """Read one time, given as a duration from J2000.0 or as a date; return s from J2000.0 TDB.

    Parameters
    ----------
    value : str, Quantity, timedelta, date, datetime64, Time
    where : Where

    Raises
    ------
    SceneError
        If it is neither.
    """
    if isinstance(value, str):
        date = _FAR_DATE.fullmatch(value.strip())
        if date is None and re.match(r"\d{4}-\d\d", value.strip()):
            return microseconds(value, where) * 1e-6
        if date is not None:
            year, month, day = map(int, date.groups())
            return DAY * _days_of_date(year, month, day, where)
        if with_era := _YEAR.fullmatch(value.strip()):
            year, era = int(with_era[1].replace(",", "")), with_era[2].upper()
            if year == 0:
                raise where.error(value, "there is no year 0 with an era; 1 BC precedes AD 1")
            return DAY * _days_of_date(1 - year if era.startswith("BC") else year, 1, 1, where)
    elif isinstance(value, (int, float)) and not hasattr(value, "to_value"):
        raise where.error(value, f"give it with its unit, like '{EXAMPLE}', or a date")
    elif not (
        (hasattr(value, "to_value") and not hasattr(value, "jd1"))
        or hasattr(value, "total_seconds")
        or isinstance(value, np.timedelta64)
    ):
        return microseconds(value, where) * 1e-6
    try:
        duration = quantity(value, "s", where, EXAMPLE)
    except UnitsError:
        problem = (
            f"give a time from J2000.0 like '{EXAMPLE}', or a date like '-3000-01-01' or '3001 BC'"
        )
        raise where.error(value, problem) from None
    if np.ndim(duration) != 0:
        raise where.error(value, f"give one time, like '{EXAMPLE}'")
    if abs(duration) > FARTHEST:
        raise where.error(value, "give at most 1 Gyr from J2000.0")
    return float(duration)


def _days_of_date(year: int, month: int, day: int, where: Where) -> float:
    """Days from J2000.0 to 0h of a date in the proleptic Gregorian calendar."""
    try:
        date = np.datetime64(f"{'-' * (year < 0)}{abs(year):04}-{month:02}-{day:02}", "D")
    except ValueError:
        raise where.error(f"{year}-{month:02}-{day:02}", "there is no such date") from None
    return int((date - J2000.astype("datetime64[D]")).astype(int)) - 0.5


@dataclass(frozen=True)
class YearSpan:
    """Time span over millennia, from a first to a last time.

    Attributes
    ----------
    first, last : float
        s from J2000.0 TDB.
    """

    first: float
    last: float

    words, hint = "two times from J2000.0, or two dates", "tuple[Epoch, Epoch]"

    @classmethod
    def read(cls, value: Any, where: Where) -> YearSpan:
        """Read the first and the last time of a span; refuse a last time before the first."""
        if isinstance(value, YearSpan):
            return value
        allowed = "two times, like ['-1 Myr', '0 kyr']"
        return cls(*first_and_last(value, where, seconds, allowed))

    def write(self) -> Plain:
        """Form stored in scene files: both times in seconds, with all digits."""
        return [f"{self.first!r} s", f"{self.last!r} s"]


class YearList(Listed):
    """List of times over millennia, stored in seconds from J2000.0 TDB."""

    words, hint = "a list of times from J2000.0, or of dates", "Epochs"

    @classmethod
    def times(cls, value: Any, where: Where) -> FloatArray:
        """Read a list of durations from J2000.0 or of dates; return seconds from J2000.0 TDB."""
        if isinstance(value, str):
            value = [value]
        if hasattr(value, "to_value") and not hasattr(value, "jd1"):
            listed = np.atleast_1d(quantity(value, "s", where, EXAMPLE))
        elif isinstance(value, (list, tuple)):
            listed = np.array([seconds(time, where) for time in value], dtype=float)
        else:
            listed = DAY * days(value, where)
        if np.max(np.abs(listed), initial=0.0) > FARTHEST:
            raise where.error("a time", "give at most 1 Gyr from J2000.0")
        return np.asarray(listed, dtype=float)


#: A step between times over millennia, s.
YearStep = Annotated[float, Number("s", "1 kyr", low=SHORTEST, high=FARTHEST, plain=False)]


def grid(span: YearSpan, step: float, where: Where) -> FloatArray:
    """Evenly spaced times that start at the beginning of a span and end within it.

    Raises
    ------
    SceneError
        If there would be more than `MOST_TIMES`.
    """
    count = math.floor((span.last - span.first) / step * (1 + 1e-12)) + 1
    if count > MOST_TIMES:
        raise where.error(f"{step / JULIAN_YEAR:g} yr", f"{count} times; give a longer step")
    return np.asarray(span.first + step * np.arange(count))

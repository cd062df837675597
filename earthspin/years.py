"""Times over millennia: seconds of TDB from J2000.0, told in Julian years.

They are given as durations from J2000.0 (``"-65 kyr"``, ``"1 Myr"``) or as dates of the proleptic
Gregorian calendar with astronomical years (``"-3000-01-01"``: the year 0 stands before the year 1).
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np

from earthspin.constants import DAY, J2000_JD, JULIAN_YEAR
from earthspin.dates import days, microseconds
from earthspin.errors import Where
from earthspin.units import FloatArray, Number, Plain, pack, quantity, unpack

#: How far from J2000.0 a time may lie, and how short a step may be, s.
FARTHEST, SHORTEST = 1e9 * JULIAN_YEAR, DAY
MOST_TIMES = 10_000_000
_FAR_DATE = re.compile(r"([-+]?\d{1,7})-(\d\d)-(\d\d)")
EXAMPLE = "-65 kyr"


def seconds(given: Any, where: Where) -> float:
    """Read one time: a duration from J2000.0 TDB, or a date.

    Parameters
    ----------
    given : str, Quantity, timedelta, date, datetime64, Time
    where : Where

    Raises
    ------
    SceneError, UnitsError
        If it is neither.
    """
    if isinstance(given, str):
        date = _FAR_DATE.fullmatch(given.strip())
        if date is None and re.match(r"\d{4}-\d\d", given.strip()):
            return microseconds(given, where) * 1e-6
        if date is not None:
            year, month, day = map(int, date.groups())
            return DAY * (_julian_day(year, month, day, where) - J2000_JD)
    elif isinstance(given, (int, float)) and not hasattr(given, "to_value"):
        raise where.error(given, f"give it with its unit, like '{EXAMPLE}', or as a date")
    elif not (
        (hasattr(given, "to_value") and not hasattr(given, "jd1"))
        or hasattr(given, "total_seconds")
        or isinstance(given, np.timedelta64)
    ):
        return microseconds(given, where) * 1e-6
    value = quantity(given, "s", where, EXAMPLE)
    if np.ndim(value) != 0:
        raise where.error(given, f"give one time, like '{EXAMPLE}'")
    if abs(value) > FARTHEST:
        raise where.error(given, "give at most 1 Gyr from J2000.0")
    return float(value)


def _julian_day(year: int, month: int, day: int, where: Where) -> float:
    """Julian day number at midnight of a proleptic Gregorian date (Fliegel & Van Flandern 1968)."""
    leap = year % 4 == 0 and (year % 100 != 0 or year % 400 == 0)
    lengths = (31, 29 if leap else 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31)
    if not (1 <= month <= 12 and 1 <= day <= lengths[month - 1]):
        raise where.error(f"{year}-{month:02}-{day:02}", "there is no such date")
    a = (14 - month) // 12
    y, m = year + 4800 - a, month + 12 * a - 3
    number = day + (153 * m + 2) // 5 + 365 * y + y // 4 - y // 100 + y // 400 - 32045
    return number - 0.5


def _written(time: float) -> str:
    """A time as `seconds` reads it back to the same bits."""
    return f"{time!r} s"


@dataclass(frozen=True)
class YearSpan:
    """A stretch of time over millennia.

    Attributes
    ----------
    first, last : float
        s from J2000.0 TDB.
    """

    first: float
    last: float

    words, hint = "two times from J2000.0, or two dates", "tuple[Epoch, Epoch]"

    @classmethod
    def read(cls, given: Any, where: Where) -> YearSpan:
        """Read two times; the earlier comes first."""
        if isinstance(given, YearSpan):
            return given
        if isinstance(given, (str, Mapping, set)) or not hasattr(given, "__len__"):
            raise where.error(given, "give two times, like ['-1 Myr', '0 kyr']")
        if len(given) != 2:
            raise where.error(given, "give two times, like ['-1 Myr', '0 kyr']")
        first, last = (seconds(time, where) for time in given)
        if last < first:
            raise where.error(
                [str(time) for time in given], "it ends before it starts; put the earlier first"
            )
        return cls(first, last)

    def write(self) -> Plain:
        """Give the two times in seconds, to the last bit."""
        return [_written(self.first), _written(self.last)]


@dataclass(frozen=True, eq=False)
class YearList:
    """Times over millennia as they were listed, in any order.

    Attributes
    ----------
    listed : ndarray, shape (n,)
        s from J2000.0 TDB.
    """

    listed: FloatArray

    words, hint = "a list of times from J2000.0, or of dates", "Epochs"

    @classmethod
    def read(cls, given: Any, where: Where) -> YearList:
        """Read durations in one Quantity or a list, or dates in any form that `dates` reads."""
        if isinstance(given, YearList):
            return given
        if isinstance(given, Mapping):
            return cls(unpack(given, where))
        if isinstance(given, str):
            given = [given]
        if hasattr(given, "to_value") and not hasattr(given, "jd1"):
            listed = np.atleast_1d(quantity(given, "s", where, EXAMPLE))
        elif isinstance(given, (list, tuple)):
            listed = np.array([seconds(time, where) for time in given], dtype=float)
        else:
            listed = DAY * days(given, where)
        if listed.ndim != 1 or listed.size == 0:
            raise where.error(f"shape {listed.shape}", "give one or more times in one list")
        if np.max(np.abs(listed)) > FARTHEST:
            raise where.error("a time", "give at most 1 Gyr from J2000.0")
        return cls(np.asarray(listed, dtype=float))

    def write(self) -> Plain:
        """Give the seconds as bytes."""
        return pack(self.listed)


#: A step between times over millennia, s.
YearStep = Annotated[float, Number("s", "1 kyr", low=SHORTEST, high=FARTHEST, plain=False)]


def grid(span: YearSpan, step: float, where: Where) -> FloatArray:
    """Evenly spaced times from the start of a span; its end is among them if the step meets it.

    Raises
    ------
    SceneError
        If there would be more than `MOST_TIMES`.
    """
    count = math.floor((span.last - span.first) / step * (1 + 1e-12)) + 1
    if count > MOST_TIMES:
        raise where.error(f"{step / JULIAN_YEAR:g} yr", f"{count} times; give a longer step")
    return np.asarray(span.first + step * np.arange(count))

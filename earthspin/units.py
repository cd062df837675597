"""Types of input (numbers with units, words, lists, ...), which check and convert values.

A kind knows how one sort of value is read (`read`, which checks dimension, shape, length and
finiteness) and written (`write`, whose text or numbers `read` turns into the same bits). Inside
there are SI floats, radians and arrays.
"""

from __future__ import annotations

import base64
import datetime as dt
import math
import os
import re
import typing
import warnings
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from types import NoneType
from typing import Annotated, Any, ClassVar, Literal, Protocol, TypeGuard, TypeVar

import numpy as np

from earthspin.errors import (
    EarthspinError,
    SceneError,
    UnitsError,
    Where,
    is_one_line,
    nearest,
    one_line,
)
from earthspin.numerics.arrays import Array, FloatArray

#: What a scene file can hold: text, numbers, truth, lists and tables of them.
Plain = Any
T = TypeVar("T")

#: More times than this are never held whole (0.5 GB in memory).
LONGEST_IN_MEMORY = 4_000_000

#: Longest text of a number with its unit; parsers of longer ones take minutes.
LONGEST_QUANTITY = 200

#: Lists longer than this are written as bytes; shorter ones as numbers that people can read.
LONGEST_LIST = 32

_DEGREE, _ARCSEC = math.pi / 180, math.pi / 180 * (1 / 3600)
#: Units that are read without loading a library, with what they measure and their size in SI.
#: Every other unit is read by astropy; a test holds these to it, bit for bit.
COMMON: dict[str, tuple[str, float]] = {
    "s": ("s", 1.0), "min": ("s", 60.0), "h": ("s", 3600.0), "d": ("s", 86400.0),
    "yr": ("s", 31557600.0), "kyr": ("s", 31557600e3), "Myr": ("s", 31557600e6),
    "m": ("m", 1.0), "km": ("m", 1000.0), "kg": ("kg", 1.0),
    "kg m2": ("kg m2", 1.0), "N m": ("N m", 1.0), "rad": ("rad", 1.0), "deg": ("rad", _DEGREE),
    "rad/s": ("rad/s", 1.0), "m3/s2": ("m3/s2", 1.0), "1/s": ("1/s", 1.0),
    "arcsec": ("rad", _ARCSEC), "mas": ("rad", _ARCSEC * 0.001),
}  # fmt: skip
#: Symbols of the units of time that are written as words, in singular or plural.
_SYMBOLS = {
    "second": "s", "minute": "min", "hour": "h", "day": "d", "week": "wk", "year": "yr",
    "decade": "dayr", "century": "hyr", "centurie": "hyr", "millennium": "kyr", "millennia": "kyr",
}  # fmt: skip
_WORD = re.compile(rf"(?<![a-z])(?:julian )?({'|'.join(_SYMBOLS)})s?(?![a-z])", re.IGNORECASE)
_SPACE = "[ \u00a0\u2009\u202f]"
#: A number, whose digits may stand in groups of three as in "6 378.137", and its unit.
_NUMBER_AND_UNIT = re.compile(
    rf"""\s*(?P<number>[-+]?
          (?:[1-9]\d{{0,2}}(?:{_SPACE}\d{{3}})+(?!\d)|\d+|(?=\.\d)|nan|inf)
          (?:\.\d{{3}}(?:{_SPACE}\d{{3}})+(?!\d)|\.\d*)?
          (?:[eE][-+]?\d+)?)
        \s*(?P<unit>.*?)\s*""",
    re.VERBOSE | re.IGNORECASE,
)
_TIMES = {unit for unit, (measures, _) in COMMON.items() if measures == "s"}
#: Units of which no fraction is meant, the smallest prefix of others, and what is meant instead.
_LONG, _SMALLEST = ("yr", "a", "d", "h", "min", "wk", "fortnight"), 1e-14
_MEANT = {"myr": "Myr", "ma": "Myr", "as": "arcsec"}
TURN = 2 * math.pi

#: Units of time as they are written, days in each, and -1 if it counts into the past. A small m is
#: never "million": thousandths of a year (myr, ma) are no unit here.
_UNITS_OF_TIME = (
    ("d", 1.0, 1),
    ("(?i:a|y|yrs?)", 365.25, 1),
    ("hyr", 36525.0, 1),
    ("(?i:ky|kyrs?|thousand yr)", 365.25e3, 1),
    ("M(?i:y|yrs?)|(?i:million yr)", 365.25e6, 1),
    ("(?i:gy|gyrs?|billion yr)", 365.25e9, 1),
    ("(?i:ka|kya)", 365.25e3, -1),
    ("M(?i:a)|(?i:mya)", 365.25e6, -1),
    ("(?i:ga|gya|bya)", 365.25e9, -1),
)
#: Words after the unit, the sign of such times, and their origin in Julian years from J2000.0.
_SENSES_OF_TIME = (
    (r"(from|after|since) j?2000(\.0)?", 1, 0.0),
    (r"ago|b2k|before j?2000(\.0)?", -1, 0.0),
    ("(from|after|since) 1950", 1, -50.0),
    ("bp|before present|before 1950", -1, -50.0),
)


def time_scale(words: str) -> tuple[float, float] | None:
    """Return the Julian years in a unit of time, and the origin in Julian years from J2000.0.

    Parameters
    ----------
    words : str
        Unit with its sense: ``"kyr"`` gives (1000, 0), ``"ka"`` and ``"kyr ago"`` (-1000, 0),
        ``"kyr BP"`` (-1000, -50), ``"kyr from 1950"`` (1000, -50).

    Returns
    -------
    tuple of float, or None
        The years are negative if the numbers are ages, which are not negative themselves. None if
        the words are no unit of time, or if an age would count into the future.
    """
    days, direction, words = _unit_of_time(words)
    if days and not words:
        return direction * days / 365.25, 0.0
    for sense, sign, origin in _SENSES_OF_TIME:
        if days and sign <= direction and re.fullmatch(sense, words, re.IGNORECASE):
            return sign * days / 365.25, origin
    return None


def _unit_of_time(words: str) -> tuple[float, int, str]:
    """Days in a unit of time, -1 if it counts into the past, and the words that follow it."""
    words = _in_symbols(" ".join(words.replace("_", " ").split()))
    for unit, days, direction in _UNITS_OF_TIME:
        if match := re.fullmatch(f"(?:{unit})(?: (.*))?", words):
            return days, direction, match[1] or ""
    return 0.0, 0, ""


class Kind(Protocol[T]):
    """Protocol of an input type, which checks, converts and describes the values of an input."""

    @property
    def words(self) -> str:
        """Description of the allowed input, for error messages."""

    @property
    def hint(self) -> str:
        """Type hint of the allowed input, shown by code editors and used by type checkers."""

    def read(self, given: object, where: Where) -> T:
        """Check an input and convert it to the value that the program uses."""

    def write(self, value: T) -> Plain:
        """Return the value in the form stored in scene files; `read` restores it exactly."""


def by_name(kind: object) -> bool:
    """Return True if an input type takes words, names or paths instead of numbers.

    Parameters
    ----------
    kind : Kind
        The kind; its attribute `by_name`, if any, gives the result.
    """
    return bool(getattr(kind, "by_name", False))


# --- values with units -------------------------------------------------------------------------


def quantity(value: Any, unit: str, where: Where, example: str, *, epoch: bool = False) -> Any:
    """Convert a value with a unit to floats in the unit that the program uses.

    Parameters
    ----------
    value : str, Quantity, timedelta, number, array, DataArray, or list of them
        ``"6 h"``, a Quantity of astropy, pint or unyt, a DataArray that says its units, or plain
        numbers, which are in `unit` already.
    unit : str
        The unit wanted, as astropy writes it.
    where : Where
        Name of the input.
    example : str
        Example for the message.
    epoch : bool
        Whether it is a time from J2000.0, of which ``"20 ka"`` and ``"20 kyr BP"`` are in the past.

    Returns
    -------
    float, ndarray or DataArray
        Lists become arrays; a labelled array keeps its labels.

    Raises
    ------
    UnitsError
        If the unit is missing or unknown or has the wrong dimension, or the value is not a number.
    SceneError
        If a number is masked, missing or not finite, or there is none or more than one in a text,
        an age has a sign, or an angle without a unit is more than a turn.
    """
    if is_si(value, unit) and math.isfinite(value) and not (unit and where.typed):
        return value
    if unit and where.typed and is_bare(value):
        raise where.error(value, f"give it with its unit, like '{example}'")
    converted = _converted(value, _Target(unit, where, example, epoch))
    plain = getattr(converted, "values", converted)
    if np.size(plain) == 0:
        raise where.error(f"shape {np.shape(plain)}", "give one number or more")
    if not np.all(np.isfinite(plain)):
        raise where.error(value, "give finite numbers")
    if hasattr(converted, "dims"):
        return converted.copy(deep=True, data=frozen(plain))
    return frozen(converted) if np.ndim(converted) else float(converted)


def is_si(value: object, unit: str) -> TypeGuard[float]:
    """Return True for a float that can be in `unit` already: an angle is at most a turn."""
    return type(value) is float and not (unit == "rad" and abs(value) > TURN)


def vectors(value: Any, unit: str, where: Where, example: str) -> FloatArray:
    """Convert vectors that a user's function returns to floats, x, y and z along the last axis.

    They may be plain numbers in `unit`, or have a unit and labels. NaN and infinity are allowed.

    Raises
    ------
    UnitsError, SceneError
        If their unit has another dimension, they are no numbers, or have other labels.
    """
    return np.asarray(_converted(in_order(value, where), _Target(unit, where, example)))


def frozen(array: Array) -> Array:
    """Copy an array so that neither its owner nor a user of the copy can change it."""
    copy = np.array(array)
    copy.flags.writeable = False
    return copy


@dataclass(frozen=True)
class _Target:
    """Unit that an input must have, with the input's name and an example for error messages."""

    unit: str
    where: Where
    example: str
    epoch: bool = False

    def wrong(self, value: object) -> UnitsError:
        return UnitsError(str(self.where), value, self.unit or "a pure number", self.example)

    def refuse_mixed(self, values: Sequence[object]) -> None:
        """Refuse numbers without a unit, but zero, in a list of others that have one."""
        if self.unit and _needs_unit(values):
            problem = f"numbers with and without a unit; give each its unit, like '{self.example}'"
            raise self.where.error(values, problem)

    def converted(self, numbers: FloatArray, unit: Any, value: object) -> Any:
        """Convert the numbers of a value from its unit, None if it has none."""
        if unit is None:
            largest = float(np.ravel(numbers)[np.argmax(np.abs(numbers))]) if numbers.size else 0.0
            if self.unit == "rad" and abs(largest) > TURN:
                problem = "plain numbers are radians, and this is more than a turn; write"
                raise self.where.error(largest, f"{problem} '{largest!r} deg'")
            return numbers
        if self.unit in _TIMES:
            return as_written(numbers, *self._time(numbers, unit, value))
        return numbers * self.factor(value, unit)

    def _time(self, numbers: FloatArray, unit: Any, value: object) -> tuple[float, float]:
        """Factor from a unit of time to that of this input, and origin of times from J2000.0."""
        day = COMMON["d"][1] / COMMON[self.unit][1]
        scale = time_scale(str(unit)) if self.epoch else None
        if scale is None:
            days, direction, sense = _unit_of_time(str(unit))
            return days * day if direction > 0 and not sense else self.factor(value, unit), 0.0
        if scale[0] < 0 and np.any(numbers < 0):
            problem = f"'{unit}' counts into the past already; leave out the sign"
            raise self.where.error(value, problem)
        return scale[0] * 365.25 * day, scale[1] * 365.25 * day

    def factor(self, value: object, unit: Any) -> float:
        """Factor from a given unit to the unit of this input; refuse units of other dimensions."""
        measures, size = COMMON.get(str(unit), (None, 1.0))
        if measures == self.unit:
            return size
        import astropy.units as u

        with warnings.catch_warnings():  # several slashes, which are read from left to right
            warnings.simplefilter("ignore", u.UnitsWarning)
            try:
                unit = u.Unit(unit if hasattr(unit, "to_string") else _in_symbols(str(unit)))
                for base in unit.bases:
                    self._refuse_fraction(value, base)
                return float((1.0 * unit).to_value(u.Unit(self.unit)))
            except (TypeError, ValueError, AttributeError) as error:
                raise error if isinstance(error, SceneError) else self.wrong(value) from None

    def _refuse_fraction(self, value: object, unit: Any) -> None:
        """Raise an error for a unit like the thousandth of a year, which nobody means."""
        from astropy.units import PrefixUnit

        if isinstance(unit, PrefixUnit):
            scale, root = unit.represents.scale, str(unit.represents.bases[0])
            if scale < (1.0 if root in _LONG else _SMALLEST):
                meant = _MEANT.get(str(unit), root)
                raise self.where.error(value, f"'{unit}' is {scale:g} {root}; write '{meant}'")


def in_unit(numbers: FloatArray, unit: str, target: str, where: Where, example: str) -> FloatArray:
    """Convert numbers from `unit` to `target`.

    Raises
    ------
    UnitsError
        If the unit is unknown or has the wrong dimension.
    """
    return np.asarray(_Target(target, where, example).converted(numbers, unit, unit))


def _in_symbols(text: str) -> str:
    """Replace units of time by symbols ("12 hours" by "12 h"), and degrees_north by degrees."""
    text = re.sub("degrees?_(?:north|east)", "deg", text).replace("dimensionless", "")
    return _WORD.sub(lambda match: _SYMBOLS[match[1].lower()], text)


def _converted(value: Any, target: _Target) -> Any:
    try:
        return _convert(value, target)
    except EarthspinError:
        raise
    except Exception:  # whatever somebody's class says of being no array; lists in lists in lists
        raise target.wrong(value) from None


def _convert(value: Any, target: _Target) -> Any:
    if isinstance(value, str):
        return _from_text(value, target)
    if isinstance(value, dt.timedelta):
        return target.converted(np.asarray(value.total_seconds()), "s", value)
    if is_masked(value):
        raise target.where.error("a masked value", "give numbers that are all known")
    if hasattr(value, "jd1"):  # a TimeDelta of astropy
        value = value.to("s")
    numbers, unit = numbers_and_unit(value)
    if isinstance(numbers, (list, tuple)) and any(map(has_unit, numbers)):
        target.refuse_mixed(numbers)
        return np.stack([_convert(inner, target) for inner in numbers])
    array = np.asarray(numbers)
    if array.dtype.kind == "m":
        array, unit = array / np.timedelta64(1, "us") / 1e6, "s"  # a month has no length in seconds
    if target.unit and array.dtype.kind in "OU" and any(map(has_unit, array.flat)):
        target.refuse_mixed(array.ravel().tolist())
        converted = np.reshape([_convert(inner, target) for inner in array.flat], array.shape)
    else:
        converted = target.converted(real_numbers(array), unit, value)
    if not (hasattr(value, "dims") and hasattr(value, "dtype")):
        return converted
    labelled = value.copy(data=converted)
    if "units" in value.attrs:
        labelled.attrs["units"] = target.unit or "1"
    return labelled


def _from_text(text: str, target: _Target) -> Any:
    match = None if len(text) > LONGEST_QUANTITY else _NUMBER_AND_UNIT.fullmatch(text)
    if match is None or (target.unit and not match["unit"]):
        raise target.wrong(text)
    if re.match(r"[-+(]?[.,\d]", match["unit"]) and not re.match(r"1\s*/", match["unit"]):
        problem = f"there is more than one number; write one, like '{target.example}'"
        raise target.where.error(text, problem)
    number = float(re.sub(_SPACE, "", match["number"]))
    return target.converted(np.asarray(number), match["unit"], text)


def is_bare(value: object) -> bool:
    """Return True for a number without a unit, or for a list that contains such a number."""
    if isinstance(value, (list, tuple)):
        return any(map(is_bare, value))
    return isinstance(value, (int, float)) and not isinstance(value, bool) and not has_unit(value)


def _needs_unit(value: object) -> bool:
    """Return True for a bare number other than zero, or for a list that contains one."""
    if isinstance(value, (list, tuple)):
        return any(map(_needs_unit, value))
    return is_bare(value) and value != 0


def is_masked(value: object) -> bool:
    """Return True if an array, a list of arrays or an astropy Time has masked elements."""
    if isinstance(value, (list, tuple)):
        try:
            return any(map(is_masked, value))
        except RecursionError:  # lists in lists without end, which are no array either
            return False
    mask = getattr(value, "mask", False)
    return not callable(mask) and bool(np.any(mask))


def numbers_and_unit(value: Any) -> tuple[Any, Any]:
    """Split an object into its numbers and its unit, which is None if it has none.

    A unit is an attribute `unit` or `units`, as in astropy, pint, unyt and columns of tables, or
    stands in the attributes of a labelled array.
    """
    if isinstance(getattr(value, "attrs", None), Mapping):  # of xarray or pandas
        numbers, unit = numbers_and_unit(value.data) if hasattr(value, "dims") else (value, None)
        return numbers, value.attrs.get("units", unit)
    unit = getattr(value, "unit", getattr(value, "units", None))
    if unit is None:
        return value, None
    return getattr(value, "value", getattr(value, "magnitude", value)), unit


def has_unit(value: object) -> bool:
    """Return True if a value has a unit, or any element of nested lists has one."""
    if isinstance(value, (list, tuple)):
        return any(map(has_unit, value))
    if type(value) in (float, int):
        return False
    return isinstance(value, (str, dt.timedelta)) or numbers_and_unit(value)[1] is not None


def real_numbers(value: Any) -> FloatArray:
    """Convert an array or a list of numbers to floats; NaN and infinity are allowed.

    Raises
    ------
    ValueError
        If a number is masked, complex, a truth value, text or beyond a float, or lists are uneven.
    """
    if is_masked(value):
        raise ValueError("a masked value; give numbers that are all known")
    try:
        array = np.asarray(value)
    except Exception as error:  # uneven lists, and whatever somebody's class says
        raise ValueError(one_line(error)) from None
    if array.dtype.kind == "O":  # whole numbers that are too long for 64 bits, None
        if any(isinstance(element, (str, bytes, bool, np.bool_)) for element in array.flat):
            raise ValueError("text or truth values; give numbers")
        try:
            return array.astype(np.float64)
        except Exception as error:
            raise ValueError(one_line(error)) from None
    if array.dtype.kind not in "fiu":
        raise ValueError(f"an array of {array.dtype}; give real numbers")
    return array.astype(np.float64, copy=False)


def as_written(numbers: Any, factor: float, origin: float = 0.0) -> Any:
    """Compute numbers * factor + origin for the decimal numbers that the floats stand for.

    The float that is written "-17.4" is not -17.4, so that its product by 1000 may differ from
    -17400. Here each result is the float nearest to that of the decimal number with at most 15
    places, and equal times are equal, in whatever unit they are given.
    """
    numbers = np.asarray(numbers, dtype=np.float64)
    result = np.asarray(numbers * factor + origin if origin else numbers * factor)
    ratio = Fraction(factor).limit_denominator(10**6)  # 1/24 is no float, either
    rest = (numbers != 0) & (np.abs(numbers) < 2**53) & (float(ratio) == factor)
    numbers = np.where(rest, numbers, 0.0)
    for places in range(16):
        if not rest.any():
            break
        whole = np.rint(numbers * 10.0**places)
        written = rest & (np.abs(whole) < 2**53) & (whole / 10.0**places == numbers)
        scale = ratio / 10**places
        products = whole[written] * scale.numerator + origin * scale.denominator
        result[written] = products / scale.denominator
        rest &= ~written
    return result[()]


# --- kinds -------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Number:
    """Input type: one finite number, converted to a float in the unit `unit`.

    Attributes
    ----------
    unit : str
        Unit of the stored number; empty for pure numbers.
    example : str
    low, high : float
        Smallest and largest allowed.
    above : float
        Bound that the number must exceed.
    plain : bool
        Whether a number without a unit is accepted and taken to be in `unit`.
    limits : str
        Text of the limits in messages, if numbers in `unit` are hard to read.
    """

    unit: str
    example: str
    low: float = -math.inf
    high: float = math.inf
    above: float = -math.inf
    plain: bool = True
    limits: str = ""

    hint = "Value"

    @property
    def words(self) -> str:
        """Text for error messages: an example of the allowed number."""
        return f'like "{self.example}"' if self.unit else f"like {self.example}"

    def read(self, value: object, where: Where) -> float:
        """Check a number, given with or without a unit, and convert it to a float in `unit`."""
        if is_bare(value) and not self.plain:
            raise where.error(value, f"give it with its unit, like '{self.example}'")
        number = quantity(value, self.unit, where, self.example)
        if np.ndim(number) != 0:
            raise where.error(value, f"give one number, {self.words}")
        if not (self.low <= number <= self.high and number > self.above):
            raise where.error(value, self.limits or self._range())
        return float(number)

    def _range(self) -> str:
        unit = f" {self.unit}" if self.unit else ""
        if self.above > -math.inf:
            return f"it is greater than {f'{self.above:g}{unit}' if self.above else 'zero'}"
        if self.high < math.inf:
            return f"it lies between {self.low:g} and {self.high:g}{unit}"
        return f"it is at least {self.low:g}{unit}"

    def write(self, value: float) -> Plain:
        """Return the number as scene files store it: as text with the unit, if there is a unit."""
        return f"{float(value)!r} {self.unit}" if self.unit else float(value)


@dataclass(frozen=True)
class Numbers:
    """Input type: an array of finite numbers, converted to floats in the unit `unit`.

    Attributes
    ----------
    unit, example : str
    shape : tuple
        Length along each dimension, None if any length is allowed; a leading dimension of length 1
        may be omitted and is then added.
    optional_row : bool
        Whether an omitted leading dimension is not added.
    """

    unit: str
    example: str
    shape: tuple[int | None, ...]
    optional_row: bool = False

    hint = "Values"

    @property
    def words(self) -> str:
        """Text for error messages: shape of the allowed array, and an example of an element."""
        size = " x ".join("n" if n is None else str(n) for n in self.shape)
        size = f"one or {size}" if self.optional_row and len(self.shape) == 1 else size
        return f'{size} values like "{self.example}"' if self.unit else f"{size} numbers"

    def read(self, value: object, where: Where) -> FloatArray:
        """Check an array of numbers, convert it to floats, and return a read-only copy."""
        if isinstance(value, Mapping):
            unit = str(value.get("unit", self.unit))
            value = in_unit(unpack(value, where), unit, self.unit, where, self.example)
        value = in_order(value, where) if self.shape[-1] else value
        converted = quantity(value, self.unit, where, self.example)
        values = np.array(getattr(converted, "values", converted), dtype=np.float64)
        if values.ndim == len(self.shape) - 1 and not self.optional_row:
            values = values[np.newaxis]
        shape = self.shape[len(self.shape) - values.ndim :] if self.optional_row else self.shape
        fits = len(shape) == values.ndim and all(
            size in (None, n) and n > 0 for size, n in zip(shape, values.shape, strict=True)
        )
        if not fits or values.ndim < len(self.shape) - self.optional_row:
            raise where.error(f"shape {values.shape}", f"give {self.words}")
        values.flags.writeable = False
        return values

    def write(self, value: FloatArray) -> Plain:
        """Return the array as scene files store it: as a list, or as bytes if the array is long."""
        if value.size > LONGEST_LIST:
            return pack(value) | {"unit": self.unit}
        return _with_unit(value.tolist(), self.unit) if self.unit else value.tolist()


def _with_unit(values: Any, unit: str) -> Any:
    if isinstance(values, list):
        return [_with_unit(value, unit) for value in values]
    return f"{values!r} {unit}"


#: Labels of vectors and of quaternions, by the name of their dimension.
_COMPONENTS = {"component": ["x", "y", "z"], "quaternion": ["w", "x", "y", "z"]}


def in_order(value: Any, where: Where) -> Any:
    """Order labelled components as x, y, z or w, x, y, z on the last axis; refuse other labels.

    Labels are those of a dimension of xarray. Tables and Series must have them in this order.
    """
    if hasattr(value, "dims"):
        texts = (dim for dim in value.dims if value[dim].dtype.kind in "OU")
        dim = next((dim for dim in value.dims if dim in _COMPONENTS), next(texts, None))
        value = value if dim is None else value.transpose(..., dim)
        labels = value.coords.get(dim)
    else:
        dim, labels = "", getattr(value, "columns", getattr(value, "index", None))
    if labels is None or callable(labels) or np.asarray(labels).dtype.kind in "iu":
        return value
    words = np.asarray(labels).astype(str).tolist()
    orders = [_COMPONENTS[dim]] if dim in _COMPONENTS else _COMPONENTS.values()
    order = next((names for names in orders if sorted(names) == sorted(words)), None)
    if order is None or not (dim or words == order):
        problem = "give the components x, y and z (of quaternions w, x, y and z), or bare numbers"
        raise where.error(words, problem)
    return value.sel({dim: order}) if dim else value


def pack(values: FloatArray) -> dict[str, Plain]:
    """Convert an array to a dict of its shape and its bytes as text, for scene files."""
    data = np.ascontiguousarray(values, dtype="<f8").tobytes()
    return {"shape": list(values.shape), "float64": base64.b64encode(data).decode("ascii")}


def unpack(table: Mapping[str, Any], where: Where) -> FloatArray:
    """Restore an array from the dict that `pack` returned.

    Raises
    ------
    SceneError
        If it is not one.
    """
    try:
        data = np.frombuffer(base64.b64decode(table["float64"], validate=True), dtype="<f8")
        values: FloatArray = data.reshape(table["shape"]).astype(np.float64)
        if values.size == 0 or not np.isfinite(values).all():
            raise ValueError
        return values
    except (KeyError, TypeError, ValueError):
        raise where.error("a table", "give a list of numbers") from None


class _AsItIs:
    """Base class of input types whose values are stored in scene files without conversion."""

    def write(self, value: Any) -> Plain:
        """Return the value unchanged, as it is stored in scene files."""
        return value


def is_whole(value: object) -> TypeGuard[int | np.integer[Any]]:
    """Return True for an integer of Python or NumPy, but not for a Boolean or a timedelta64."""
    return isinstance(value, (int, np.integer)) and not isinstance(value, (bool, np.timedelta64))


@dataclass(frozen=True)
class Whole(_AsItIs):
    """Input type: a whole number from `low` to `high`; `others` names other allowed values."""

    low: int = 1
    high: int = LONGEST_IN_MEMORY
    others: str = ""

    hint = "int"

    @property
    def words(self) -> str:
        """Allowed whole numbers in words, for error messages."""
        return f"a whole number, {self.low} or more{self.others}"

    def read(self, value: object, where: Where) -> int:
        """Return a value as an int; refuse all but whole numbers from `low` to `high`."""
        if not is_whole(value) or value < self.low:
            raise where.error(value, f"give {self.words}")
        if value > self.high:
            raise where.error(value, f"give a whole number from {self.low} to {self.high}")
        return int(value)


@dataclass(frozen=True)
class Word(_AsItIs):
    """Input type: one word from a list of allowed words.

    Attributes
    ----------
    allowed : collection of str
        A mapping to which words are added later is read when it is needed.
    """

    allowed: Collection[str]

    by_name: ClassVar[bool] = True

    @property
    def hint(self) -> str:
        """Type hint of the allowed words, as code editors show it."""
        return f"Literal[{', '.join(map(repr, self.allowed))}]"

    @property
    def words(self) -> str:
        """Text for error messages: the list of the allowed words."""
        return " or ".join(f'"{word}"' for word in self.allowed)

    def read(self, value: object, where: Where) -> str:
        """Return the value if it is one of the allowed words; refuse all other values."""
        if value is True:  # TOML, and a shell that takes the quotes away
            value = "true"
        if not isinstance(value, str) or value not in self.allowed:
            raise where.error(value, nearest(value, self.allowed))
        return value


class YesNo(_AsItIs):
    """Input type: true or false."""

    words, hint = "true or false", "bool"
    by_name: ClassVar[bool] = True

    def read(self, value: object, where: Where) -> bool:
        """Return true or false, of Python or as a word; refuse all other values."""
        word = str(value).lower()
        if not isinstance(value, (str, bool)) or word not in ("true", "false"):
            raise where.error(value, f"give {self.words}")
        return word == "true"


@dataclass(frozen=True)
class Text(_AsItIs):
    """Input type: one line of text."""

    words, hint = "a line of text", "str"

    def read(self, value: object, where: Where) -> str:
        """Return a text unchanged; refuse all but text on a single line."""
        if not isinstance(value, str) or not is_one_line(value):
            raise where.error(value, f"it is {self.words}")
        return value


@dataclass(frozen=True)
class FileName(_AsItIs):
    """Input type: the path of a file or folder, or a short name that stands for a file.

    Attributes
    ----------
    expected : str
        What a message asks for; `words` if empty.
    known : collection of str
        Words that stand for something else than a file of this name.
    content : str
        Content of such a file.
    """

    words = "the path of a file"
    hint = "str | PathLike[str]"
    by_name: ClassVar[bool] = True
    expected: ClassVar[str] = ""
    known: ClassVar[Collection[str]] = ()
    content: ClassVar[str] = "text"

    def read(self, value: object, where: Where) -> Any:
        """Return a path or short name as text; refuse all else. The file is not opened here."""
        if not isinstance(value, (str, os.PathLike)) or not os.fspath(value).strip():
            raise where.error(value, f"it is {self.expected or self.words}")
        return os.fspath(value)

    def is_path(self, value: object) -> bool:
        """Return True if a value is a path, and False if it is a known short name."""
        return isinstance(value, str) and value not in self.known

    def begins(self, head: bytes) -> bool:
        """Return True if a file with these first bytes can have the type that the input needs."""
        return True


@dataclass(frozen=True)
class Several:
    """Input type: a list of values that all have the input type `of`, or a single such value.

    Attributes
    ----------
    of : Kind
    """

    of: Kind[Any]

    @property
    def hint(self) -> str:
        """Type hint for code editors: one value of the kind `of`, or a sequence of such values."""
        return f"{self.of.hint} | Sequence[{self.of.hint}]"

    @property
    def words(self) -> str:
        """Text for error messages that describes one allowed value, and that lists are allowed."""
        return f"{self.of.words}; one or a list"

    def read(self, value: object, where: Where) -> tuple[Any, ...]:
        """Check each value of a list, or a single value, and return them as a tuple."""
        if isinstance(value, (set, frozenset)):
            raise where.error(value, "a set has no order; give a list")
        if isinstance(value, np.ndarray) and value.ndim:
            value = list(value)
        if not isinstance(value, (list, tuple)):
            value = (value,)
        return tuple(self.of.read(element, where) for element in value)

    def write(self, value: tuple[Any, ...]) -> Plain:
        """Return the values in the form stored in scene files, as a list."""
        return [self.of.write(element) for element in value]


def kind_of(annotation: Any) -> Kind[Any]:
    """Return the input type, such as `Number`, for a type annotation; None as an option is ignored.

    Parameters
    ----------
    annotation
        A type that reads itself, an Annotated with a kind, Literal words, or a tuple of them.
    """
    origin, options = typing.get_origin(annotation), typing.get_args(annotation)
    if origin is Annotated:
        return next(extra for extra in annotation.__metadata__ if hasattr(extra, "read"))
    if NoneType in options:
        (inner,) = (option for option in options if option is not NoneType)
        return kind_of(inner)
    if origin is Literal:
        return Word(options)
    if origin is tuple:
        return Several(kind_of(options[0]))
    if hasattr(annotation, "read"):
        return annotation  # type: ignore[no-any-return]
    plain: dict[Any, Kind[Any]] = {str: Text(), int: Whole(), bool: YesNo()}
    return plain[annotation]


#: A length of time, s.
Duration = Annotated[float, Number("s", "6 h")]
#: A length of time in days, for the equations of the wobble, which count in them.
Days = Annotated[float, Number("d", "433 d", above=0.0)]

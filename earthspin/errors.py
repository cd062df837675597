"""Exceptions of this package, each with the data that describe the error.

A message is one line: what was given, what is allowed, what to do. Each class
keeps the same facts as attributes, so that a program can act on them.
"""

from __future__ import annotations

import difflib
import functools
import inspect
import os
import re
import stat
import traceback
import unicodedata
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, ParamSpec, TypeVar

#: What was given is repeated in a message up to this many characters.
LONGEST_ECHO = 100
#: A path is repeated up to the length of a name on most disks.
LONGEST_PATH = 255
LONGEST_MESSAGE = 1000

_P = ParamSpec("_P")
_T = TypeVar("_T")
#: First and last date.
_Dates = tuple[str, str]


class EarthspinError(Exception):
    """Base class of errors that the user can correct; the command line then exits with status 2.

    The message is always one line.

    Examples
    --------
    >>> import earthspin
    >>> try:
    ...     earthspin.precession(body="pluto")
    ... except earthspin.EarthspinError as error:
    ...     print(type(error).__name__, "on", len(str(error).splitlines()), "line")
    SceneError on 1 line
    """

    def __init__(self, message: str = "") -> None:
        words = printable(" ".join(message.split()))
        cut = len(words) > LONGEST_MESSAGE
        super().__init__(f"{words[:LONGEST_MESSAGE]}..." if cut else words)

    def __reduce__(self) -> tuple[Any, ...]:
        # Each class takes its facts, not the message, so pickle must not call it again.
        return _rebuild, (type(self), self.args, self.__dict__)

    def _render_traceback_(self) -> list[str]:
        """Return the traceback without lines of this package, and the message, for IPython."""
        frames = traceback.extract_tb(self.__traceback__)[1:]  # the first is that of IPython
        inside = [frame.filename.startswith(os.path.dirname(__file__)) for frame in frames]
        end = inside.index(True) if True in inside else len(frames)
        return [*traceback.format_list(frames[:end]), f"{type(self).__name__}: {self}"]


class ArgumentError(EarthspinError, TypeError):
    """Error raised if a call lacks an argument, or has one that the function does not take.

    Examples
    --------
    >>> import earthspin
    >>> try:
    ...     earthspin.precession("mars")
    ... except earthspin.ArgumentError as error:
    ...     print(error)
    precession() too many positional arguments; write precession(body='mars')
    """


class SceneError(EarthspinError, ValueError):
    """Error raised if a key or a value of a scene is not allowed.

    Attributes
    ----------
    source : str
        The file or command; empty for what was given in Python.
    key : str
        Name of the wrong key.
    given : object
        Value that was given.

    Examples
    --------
    >>> import earthspin
    >>> try:
    ...     earthspin.load_scene("precession", {"perturber": "sun"})
    ... except earthspin.SceneError as error:
    ...     print(error.key, error.given)
    perturber sun
    """

    def __init__(self, key: str, given: Any, problem: str, *, source: str = "") -> None:
        self.source, self.key, self.given, self.problem = source, key, given, problem
        place = f"{_named(source)}: {_brief(key)}" if source else _brief(key)
        super().__init__(f"{place} = {_shown(given)}: {problem}")


@dataclass(frozen=True)
class Where:
    """Location of a value in the user's input, such as key and file, for error messages.

    Attributes
    ----------
    key : str
        Key as a user would write it, ``"body.j2"``.
    source : str
        The file or call; empty if there is nothing to name.
    typed : bool
        Whether it is text that a person typed, where numbers carry their units; in Python, in
        answers and in tables of columns plain numbers are in SI units.
    """

    key: str
    source: str = ""
    typed: bool = False

    def __str__(self) -> str:
        return f"{self.source}: {self.key}" if self.source else self.key

    def error(self, given: object, problem: str) -> SceneError:
        """Build the error for a wrong value at this location of the input."""
        return SceneError(self.key, given, problem, source=self.source)

    def at(self, inner: str) -> Where:
        """Return the location of an element of this value, such as `body.j2` inside `body`."""
        return Where(f"{self.key}.{inner}", self.source, self.typed)

    def refuse_unknown(self, table: Mapping[str, Any], names: Collection[str]) -> None:
        """Raise an error for the first key of a table that is not among the allowed names."""
        for name in table:
            if name not in names:
                raise self.at(name).error(table[name], nearest(name, names))


class BodyError(EarthspinError, ValueError):
    """Error raised for a body whose properties are physically impossible or incomplete.

    Attributes
    ----------
    body : str
        Its name.
    field : str
        The field that is wrong.
    given : object
        The value of that field.

    Examples
    --------
    >>> import earthspin
    >>> try:
    ...     earthspin.EARTH.replace(dynamical_flattening=0.6)
    ... except earthspin.BodyError as error:
    ...     print(error.field, error.given, error.allowed)
    dynamical_flattening 0.6 C cannot exceed A + B, so H = (C - A)/C is at most 0.5 (the thin disc)
    """

    def __init__(self, body: str, field: str, given: Any, allowed: str) -> None:
        self.body, self.field, self.given, self.allowed = body, field, given, allowed
        words = f"{field} = {_shown(given)} is not possible; {allowed}"
        super().__init__(f"body '{_brief(body)}': {words}")

    @classmethod
    def lacking(cls, body: str, forms: Mapping[str, str]) -> BodyError:
        """Build the error for properties that a computation needs, but that the body does not have.

        Parameters
        ----------
        body : str
            Its name.
        forms : mapping of str to str
            Example, unit or definition of a missing property, by field.
        """
        names, last = listed(forms), [*forms][-1]
        given = ", ".join(f"{name} = {form}" for name, form in forms.items())
        error = cls(body, last, None, f"this question needs {names}")
        words = f"has no {names}, which this question needs; give {given}"
        error.args = (f"body '{_brief(body)}' {words}",)
        return error


class UnitsError(EarthspinError, ValueError):
    """Error raised for a value whose unit is missing, unknown, or of the wrong dimension.

    Attributes
    ----------
    given : object
        The value as it was read.
    wanted : str
        The unit that it must convert to.

    Examples
    --------
    >>> import earthspin
    >>> try:
    ...     earthspin.EARTH.replace(spin_period="12 km")
    ... except earthspin.UnitsError as error:
    ...     print(error.given, "is not in", error.wanted)
    12 km is not in s
    """

    def __init__(self, what: str, given: Any, wanted: str, example: str) -> None:
        self.what, self.given, self.wanted = what, given, wanted
        words = f"is not a value in units of {wanted}; write it like {example!r}"
        super().__init__(f"{what} = {_shown(given)} {words}")


class KernelError(EarthspinError, OSError):
    """Error raised if an ephemeris kernel cannot be used.

    Attributes
    ----------
    path : str
        Name or path of the kernel, as given.

    Examples
    --------
    >>> import earthspin
    >>> try:
    ...     earthspin.precession(ephemeris="nowhere.bsp")
    ... except earthspin.KernelError as error:
    ...     print(error.path)
    nowhere.bsp
    """

    def __init__(self, path: Any, problem: str, remedy: str = "") -> None:
        self.path = str(path)
        super().__init__(_sentence(f"kernel '{_named(path)}'", problem, remedy))


class CoverageError(EarthspinError, ValueError):
    """Error raised for times outside the range of a kernel or a table.

    Attributes
    ----------
    kernel : str
        Name of the kernel or table.
    asked, coverage : tuple of str
        First and last date: requested, and covered; TDB.

    Examples
    --------
    >>> import earthspin
    >>> try:
    ...     earthspin.torque_series("1800-01-01", "1801-01-01", "1 d")
    ... except earthspin.CoverageError as error:
    ...     print(error.kernel, *error.coverage)
    de421 1899-07-29T00:00:00 2053-10-09T00:00:00
    """

    def __init__(
        self, kernel: str, asked: _Dates, coverage: _Dates, what: str = "kernel", remedy: str = ""
    ) -> None:
        self.kernel, self.asked, self.coverage = kernel, asked, coverage
        is_single = asked[0] == asked[1]
        times = asked[0] if is_single else f"span {asked[0]} to {asked[1]}"
        super().__init__(
            f"{times} is outside {what} '{kernel}', which covers {coverage[0]} to {coverage[1]} "
            f"(TDB); choose dates inside it or {remedy or f'a longer {what}'}"
        )


class UndefinedError(EarthspinError, ValueError):
    """Error raised if a quantity is not defined for the given inputs.

    Examples
    --------
    >>> import earthspin
    >>> mars = earthspin.MARS.replace(orbit_pole=None)
    >>> try:
    ...     earthspin.precession(body=mars, perturbers="sun")
    ... except earthspin.UndefinedError as error:
    ...     print(str(error).partition(";")[0])
    the equinox of a body is the node of its orbit, which is not known
    """


class ApartError(UndefinedError):
    """Error raised if several bodies cannot be computed together; one body at a time may work.

    Examples
    --------
    >>> import earthspin, xarray
    >>> h = xarray.DataArray([0.0033, 0.026], dims="case")
    >>> body = earthspin.EARTH.replace(dynamical_flattening=h)
    >>> try:
    ...     earthspin.long_term("-1 Myr", "0 kyr", "1 kyr", body=body)
    ... except earthspin.ApartError as error:
    ...     print(error)
    Newton's method in time does not converge for all axes; ask for each alone, or in an ensemble
    """

    def __init__(self, why: str) -> None:
        super().__init__(f"{why}; ask for each alone, or in an ensemble")


class SeriesError(EarthspinError, ValueError):
    """Error raised if a file of observations, of a published solution or of an orbit is not usable.

    Attributes
    ----------
    path : str
        The file, as named.
    line : int or None
        The first offending line, counted from 1.

    Examples
    --------
    >>> from pathlib import Path
    >>> import earthspin
    >>> _ = Path("pole.txt").write_text("no table of the pole")
    >>> try:
    ...     earthspin.polar_motion(file="pole.txt")
    ... except earthspin.SeriesError as error:
    ...     print(str(error).split(";")[0])
    file 'pole.txt': it holds no rows of numbers
    """

    def __init__(self, path: Any, problem: str, remedy: str = "", line: int | None = None) -> None:
        self.path, self.line = str(path), line
        where = f"file '{_named(path)}'" + (f", line {line}" if line else "")
        super().__init__(_sentence(where, problem, remedy))


class AccuracyError(EarthspinError, ValueError):
    """Error raised if a quadrature cannot reach the requested accuracy.

    Attributes
    ----------
    asked, best : float
        Half-widths: requested, and best possible; in the same unit.

    Examples
    --------
    >>> import earthspin
    >>> from earthspin.mass.multipoles import moments_of_density
    >>> try:
    ...     moments_of_density(lambda r, theta: r % 0.1, lambda theta: 1.0 + 0 * theta)
    ... except earthspin.AccuracyError as error:
    ...     print(error.best > error.asked)
    True
    """

    def __init__(self, asked: float, best: float, unit: str, remedy: str) -> None:
        self.asked, self.best, self.unit = asked, best, unit
        limit = f"the best there is here is {_rounded_up(best)} {unit}"
        super().__init__(f"accuracy of {asked:.3g} {unit} was asked for, {limit}; {remedy}")


class OutputError(EarthspinError, OSError):
    """Error raised if a file cannot be written, or if a result file cannot be read.

    Attributes
    ----------
    path : str
        Path of the result.

    Examples
    --------
    >>> import earthspin
    >>> try:
    ...     earthspin.open("nowhere.nc")
    ... except earthspin.OutputError as error:
    ...     print(error.path)
    nowhere.nc
    """

    def __init__(self, path: Any, problem: str, remedy: str = "") -> None:
        self.path = str(path)
        super().__init__(_sentence(f"output '{_named(path)}'", problem, remedy))


class MissingExtraError(EarthspinError, ImportError):
    """Error raised if a task needs an optional package that is not installed.

    Examples
    --------
    >>> import earthspin
    >>> print(earthspin.MissingExtraError("zarr", "zarr", "writing a Zarr store"))
    writing a Zarr store needs the package 'zarr'; install it with pip install 'earthspin[zarr]'
    """

    def __init__(self, package: str, extra: str | None, purpose: str) -> None:
        self.package, self.extra = package, extra
        what = f"'earthspin[{extra}]'" if extra else package
        remedy = f"install it with pip install {what}"
        super().__init__(f"{purpose} needs the package '{package}'; {remedy}")


def _rebuild(
    kind: type[EarthspinError], args: tuple[Any, ...], facts: dict[str, Any]
) -> EarthspinError:
    """Restore an error from its class, message and data, as pickle requires."""
    error = kind.__new__(kind)
    error.args = args  # OSError takes them in __init__ alone if a class has one of its own
    error.__dict__.update(facts)
    return error


def listed(names: Iterable[str]) -> str:
    """Join names in a sentence: ``"Io, Europa and Callisto"``."""
    *others, last = names
    return f"{', '.join(others)} and {last}" if others else last


def nearest(word: object, allowed: Iterable[str]) -> str:
    """List the allowed words for a message, starting with the one most similar to a wrong word.

    Parameters
    ----------
    word : object
        Value that was given.
    allowed : iterable of str
        The valid words.

    Returns
    -------
    str
        ``"did you mean 'torque'? allowed: precession, torque, wobble"``.
    """
    words, text = sorted(allowed), _brief(word)
    table = text[: text.rfind(".") + 1]  # a table that two names share makes them no more similar
    names = {name.removeprefix(table): name for name in words if name.startswith(table)}
    close = difflib.get_close_matches(text.removeprefix(table), names, n=1, cutoff=0.6)
    hint = f"did you mean '{names[close[0]]}'? " if close else ""
    return f"{hint}allowed: {', '.join(words)}"


def checked(
    function: Callable[_P, _T], hint: Callable[[str, list[str]], str] = nearest
) -> Callable[_P, _T]:
    """Decorate a function: wrong arguments raise an `ArgumentError` that shows a corrected call.

    `hint` makes the advice for an unknown argument, from its name and the allowed names.
    """
    signature = inspect.signature(function)
    name = function.__qualname__.removesuffix(".__init__").rpartition(".")[2]

    def problem(error: TypeError, args: tuple[Any, ...], keywords: Mapping[str, Any]) -> str:
        parameters = [p for p in signature.parameters.values() if p.name not in ("cls", "self")]
        args = args[len(signature.parameters) - len(parameters) :]
        free = [p.name for p in parameters if p.kind is p.POSITIONAL_OR_KEYWORD]
        named = [p.name for p in parameters if p.kind is p.KEYWORD_ONLY and p.name not in keywords]
        unknown = [word for word in keywords if word not in signature.parameters]
        if unknown:
            return f"has no argument '{unknown[0]}'; {hint(unknown[0], [*free, *named])}"
        if len(args) > len(free) and named:
            if os.path.splitext(str(args[len(free)]))[1]:  # a file
                named.sort(key=lambda name: name != "file")
            pairs = zip(named, args[len(free) :], strict=False)
            words = [*map(_shown, args[: len(free)]), *(f"{n}={_shown(v)}" for n, v in pairs)]
            return f"{error}; write {name}({', '.join(words)})"
        example = _example(function)
        return f"{error}; {f'write {example}' if example else hint('', named)}"

    @functools.wraps(function)
    def call(*args: _P.args, **keywords: _P.kwargs) -> _T:
        try:
            return function(*args, **keywords)
        except ArgumentError:
            raise
        except TypeError:
            try:
                signature.bind(*args, **keywords)
            except TypeError as error:
                raise ArgumentError(f"{name}() {problem(error, args, keywords)}") from None
            raise

    return call


def _example(function: Callable[..., Any]) -> str:
    """Return the example code in a function's docstring, up to the call, on one line."""
    lines = re.findall(r">>> (.*(?:\n *\.\.\. .*)*)", function.__doc__ or "")
    end = next((n for n, line in enumerate(lines) if f"{function.__name__}(" in line), 0) + 1
    return re.sub(r"\s*\n *\.\.\. *", " ", "; ".join(n for n in lines[:end] if "import " not in n))


def _rounded_up(value: float) -> str:
    """Format an accuracy with three digits, rounded up so that the printed value is attainable."""
    digits = f"{value:.3g}"
    return digits if float(digits) >= value else f"{value * (1 + 5e-3):.3g}"


def one_line(error: BaseException) -> str:
    """Return the message of an exception as one line."""
    return " ".join(str(getattr(error, "strerror", None) or error).split())


def in_bytes(count: float) -> str:
    """Format a number of bytes as a size with a unit, as in ``"1.5 GB"``."""
    units = ("B", "kB", "MB", "GB", "TB", "PB", "EB")
    power = 0
    while count >= 999.5 and power < len(units) - 1:
        count, power = count / 1000, power + 1
    return f"{count:.3g} {units[power]}"


def no_plain_file(path: object) -> str:
    """Reason (text) why a path is not a regular file, such as a folder; empty if there is none.

    It is also empty if nothing exists at the path.

    Parameters
    ----------
    path : Path or str
    """
    try:
        mode = os.stat(str(path)).st_mode
    except OSError:
        return ""  # whoever opens it says what is wrong
    except ValueError as error:
        return one_line(error)
    if stat.S_ISDIR(mode):
        return "it is a folder, not a file"
    return "" if stat.S_ISREG(mode) else "it is a device or a pipe, not a file"


def _shown(given: object) -> str:
    """Convert any input to one short line of text for a message, without raising an error.

    A long list is cut before it is converted to text. An object that cannot be converted is shown
    as its type.
    """
    if isinstance(given, (str, bytes, list, tuple)) and type(given).__module__ == "builtins":
        given = given[: LONGEST_ECHO + 1]
    try:
        words = repr(given)
    except Exception:  # a number of 5000 digits, lists in lists in lists, someone else's class
        words = f"<{type(given).__name__}>"
    return _cut(printable(" ".join(words.split())))


def _brief(word: object) -> str:
    """Convert a word of the user's input to short text for a message, without quotes."""
    return _cut(printable(word)) if isinstance(word, str) else _shown(word)


def _cut(text: str) -> str:
    return text if len(text) <= LONGEST_ECHO else f"{text[:LONGEST_ECHO]}..."


def _named(path: object) -> str:
    """Convert a file path to text for a message; only the end of a very long path remains."""
    text = printable(str(path))
    return text if len(text) <= LONGEST_PATH else f"...{text[-LONGEST_PATH:]}"


def is_one_line(text: str) -> bool:
    """Return True if a text is a single line without control characters.

    Parameters
    ----------
    text : str
    """
    orders = ("Cc", "Cf", "Cs", "Zl", "Zp")
    return text.isprintable() or not any(unicodedata.category(c) in orders for c in text)


def printable(text: str) -> str:
    """Replace control characters and newlines in a text by escape sequences."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text)


def _sentence(subject: str, problem: str, remedy: str) -> str:
    """Join subject, problem and remedy of an error message; an empty remedy is left out."""
    return f"{subject}: {problem}" + (f"; {remedy}" if remedy else "")

"""Observed polar motion, and the excitation that models of air and water give, from files.

Known tables of the IERS: C04 (daily, from 1962), C01 (from 1846, twenty to the year) and
finals2000A (daily, with predictions, which are left out). astropy carries C04; nothing is
ever fetched. What is wrong in a file is an error that names its line; what can be put
right without guessing is put right, and said.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import ARCSEC
from earthspin.errors import SeriesError

Array = NDArray[np.float64]

#: Polar motion has never passed 0.7 arcsec; more is another unit, or another column.
LARGEST = 2.0
#: Gaps up to this many steps are bridged by straight lines.
LONGEST_BRIDGE = 10
_ERRORS = ("x_error", "y_error")


@dataclass(frozen=True)
class PoleSeries:
    """Polar motion as observed.

    Attributes
    ----------
    mjd : array, shape (n,)
        Modified Julian dates, evenly spaced; 0h UTC in daily tables.
    x, y : array, shape (n,)
        Coordinates of the pole, rad; x along the Greenwich meridian, y along 90 degrees west.
    x_error, y_error : array, shape (n,)
        One standard deviation as the file gives it, rad.
    name : str
        Kind of table.
    repairs : str
        What was put right; empty if nothing.
    """

    mjd: Array
    x: Array
    y: Array
    x_error: Array
    y_error: Array
    name: str
    repairs: str = ""

    @property
    def step(self) -> float:
        """Spacing, d."""
        return float((self.mjd[-1] - self.mjd[0]) / (self.mjd.size - 1))

    def between(self, first: float, last: float) -> PoleSeries:
        """Part of it, both dates included.

        Raises
        ------
        SeriesError
            If less than two rows lie between.
        """
        inside = (self.mjd >= first) & (self.mjd <= last)
        if np.count_nonzero(inside) < 2:
            raise SeriesError(
                self.name,
                f"it covers MJD {self.mjd[0]:.2f} to {self.mjd[-1]:.2f}, not {first:.2f} to "
                f"{last:.2f}",
                "choose a span inside it",
            )
        return replace(
            self,
            **{name: getattr(self, name)[inside] for name in ("mjd", "x", "y", *_ERRORS)},
        )


@dataclass(frozen=True)
class AngularMomentum:
    """Effective angular momentum functions.

    Attributes
    ----------
    mjd : array, shape (n,)
    chi : complex array, shape (n,)
        chi1 + i chi2, mass and motion terms together, rad.
    """

    mjd: Array
    chi: NDArray[np.complex128]


@dataclass(frozen=True)
class _Row:
    """A line as read: date, x, y and their errors in arcseconds."""

    line: int
    mjd: float
    values: tuple[float, float, float, float]


def c04_path() -> Path:
    """The C04 file that astropy carries."""
    from astropy_iers_data import IERS_B_FILE

    return Path(IERS_B_FILE)


def read_polar_motion(path: str | Path = "c04", kind: str | None = None) -> PoleSeries:
    """Read polar motion.

    Parameters
    ----------
    path : str or Path
        A file, or ``"c04"`` for the one that astropy carries.
    kind : str, optional
        ``"c04"``, ``"c01"`` or ``"finals2000A"``; told from the file by default.

    Raises
    ------
    SeriesError
        If the file cannot be used; it names the line.
    """
    file = c04_path() if str(path) == "c04" else Path(path)
    lines = _lines(file)
    kind = kind or _kind(file, lines)
    if kind not in _READERS:
        raise SeriesError(file, f"kind {kind!r} is unknown", f"allowed: {', '.join(_READERS)}")
    rows = list(_READERS[kind](file, lines))
    repairs: list[str] = []
    rows = _drop_missing(rows, repairs)
    if len(rows) < 2:
        raise SeriesError(file, f"it holds {len(rows)} rows of polar motion", "is it complete?")
    _check_size(file, rows)
    rows = _in_order(file, rows, repairs)
    return _even(file, rows, kind, repairs)


def read_angular_momentum(path: str | Path) -> AngularMomentum:
    """Read effective angular momentum functions in the common ASCII layout.

    Year, month, day, hour, MJD, then chi1, chi2, chi3 of the mass term and, if there is
    one, of the motion term, as pure numbers (Dobslaw & Dill 2018, GFZ, user's guide);
    lines that do not start with a number are comments.

    Raises
    ------
    SeriesError
        If the file cannot be used; it names the line.
    """
    file = Path(path)
    dates, chi = [], []
    for number, line in enumerate(_lines(file), start=1):
        words = line.split()
        if not words or not _is_number(words[0]):
            continue
        if len(words) not in (8, 11):
            raise SeriesError(
                file, f"{len(words)} columns", "8 or 11 are expected; is it cut off?", line=number
            )
        values = _floats(file, number, words[4:])
        terms = values[1:]
        one = sum(terms[0::3]) + 1j * sum(terms[1::3])
        if not math.isfinite(abs(one)) or abs(one) > 1e-4:
            raise SeriesError(
                file, f"excitation {one:.3g} is no such number", "radians are wanted", line=number
            )
        dates.append(values[0])
        chi.append(one)
    if len(dates) < 2:
        raise SeriesError(file, f"it holds {len(dates)} rows of excitation")
    mjd = np.array(dates)
    steps = np.diff(mjd)
    if np.any(abs(steps - steps[0]) > 1e-6) or steps[0] <= 0:
        bad = int(np.argmax(abs(steps - steps[0]) > 1e-6))
        raise SeriesError(
            file, f"the step changes after MJD {mjd[bad]:.3f}", "even steps are needed"
        )
    return AngularMomentum(mjd, np.array(chi))


# --- the kinds of table --------------------------------------------------------------------------


def _c04(file: Path, lines: list[str]) -> Iterator[_Row]:
    """C04 of any solution: the date, with or without the hour, then MJD, x, y."""
    errors = None
    for number, line in enumerate(lines, start=1):
        words = line.split()
        if not words or not words[0].isdigit():
            continue
        if len(words) < 12:
            raise SeriesError(
                file, f"{len(words)} columns", "12 or more are expected; is it cut off?", number
            )
        first = 4 if float(words[3]) < 1000 else 3
        errors = errors or (len(words) - first - 1) // 2 + first + 1
        if len(words) <= errors + 1:
            raise SeriesError(file, "it ends early", "is the file cut off?", number)
        values = _floats(file, number, [words[i] for i in (first, first + 1, first + 2)])
        spread = _floats(file, number, words[errors : errors + 2])
        yield _Row(number, values[0], (values[1], values[2], spread[0], spread[1]))


def _c01(file: Path, lines: list[str]) -> Iterator[_Row]:
    """C01: the year with decimals, then x, its error, y, its error."""
    for number, line in enumerate(lines, start=1):
        words = line.split()
        if not words or not _is_number(words[0]):
            continue
        if len(words) < 5:
            raise SeriesError(file, f"{len(words)} columns", "5 or more are expected", number)
        year, x, x_error, y, y_error = _floats(file, number, words[:5])
        # Besselian years, to the millisecond of arc that this table has.
        mjd = 15019.81352 + (year - 1900.0) * 365.242198781
        yield _Row(number, mjd, (x, y, x_error, y_error))


def _finals(file: Path, lines: list[str]) -> Iterator[_Row]:
    """finals2000A: fixed columns; predictions ("P") and empty rows are left out."""
    for number, line in enumerate(lines, start=1):
        if not line.strip() or line[16:17] != "I":
            continue
        if len(line.rstrip("\n")) < 55:
            raise SeriesError(file, "it ends early", "is the file cut off?", number)
        cells = (line[7:15], line[18:27], line[37:46], line[27:36], line[46:55])
        mjd, x, y, x_error, y_error = _floats(file, number, list(cells))
        yield _Row(number, mjd, (x, y, x_error, y_error))


_READERS: dict[str, Callable[[Path, list[str]], Iterator[_Row]]] = {
    "c04": _c04,
    "c01": _c01,
    "finals2000A": _finals,
}


def _kind(file: Path, lines: list[str]) -> str:
    """Tell the kind of table from the first row of numbers."""
    for line in lines:
        words = line.split()
        if not words or not _is_number(words[0]):
            continue
        if len(line) > 60 and line[16:17] in ("I", "P"):
            return "finals2000A"
        if words[0].isdigit() and 1800 <= int(words[0]) <= 2200 and len(words) >= 6:
            return "c04"
        if "." in words[0] and 1800 <= float(words[0]) <= 2200:
            return "c01"
        break
    raise SeriesError(
        file, "it is none of the known tables", f"name its kind: {', '.join(_READERS)}"
    )


# --- what can be wrong ---------------------------------------------------------------------------


def _lines(file: Path) -> list[str]:
    try:
        return file.read_text(encoding="ascii", errors="replace").splitlines()
    except OSError as error:
        raise SeriesError(file, f"it cannot be read: {error.strerror}") from None


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _floats(file: Path, number: int, words: list[str]) -> list[float]:
    try:
        return [float(word) for word in words]
    except ValueError as error:
        raise SeriesError(file, str(error), "a number is expected", number) from None


def _drop_missing(rows: list[_Row], repairs: list[str]) -> list[_Row]:
    """Rows without a position become gaps."""
    kept = [row for row in rows if all(map(math.isfinite, (row.mjd, *row.values[:2])))]
    if len(kept) < len(rows):
        repairs.append(f"{len(rows) - len(kept)} rows without numbers left out")
    return kept


def _check_size(file: Path, rows: list[_Row]) -> None:
    for row in rows:
        if max(abs(row.values[0]), abs(row.values[1])) > LARGEST:
            raise SeriesError(
                file,
                f"x, y = {row.values[0]:g}, {row.values[1]:g} arcsec",
                "polar motion stays below one; is it in milliarcseconds?",
                row.line,
            )


def _in_order(file: Path, rows: list[_Row], repairs: list[str]) -> list[_Row]:
    """Sort by date; drop equal copies of a day, refuse different ones."""
    ordered = sorted(rows, key=lambda row: row.mjd)
    if ordered != rows:
        repairs.append("rows sorted by date")
    kept = ordered[:1]
    for row in ordered[1:]:
        if row.mjd > kept[-1].mjd + 1e-6:
            kept.append(row)
        elif row.values != kept[-1].values:
            raise SeriesError(
                file,
                f"MJD {row.mjd:.2f} stands twice, in line {kept[-1].line} with other numbers",
                "keep one of them",
                row.line,
            )
    if len(kept) < len(ordered):
        repairs.append(f"{len(ordered) - len(kept)} repeated rows left out")
    return kept


def _even(file: Path, rows: list[_Row], kind: str, repairs: list[str]) -> PoleSeries:
    """Bridge short gaps, refuse long ones; halve the steps of a table that once had wider ones."""
    mjd = np.array([row.mjd for row in rows])
    values = np.array([row.values for row in rows]) * ARCSEC
    steps = np.diff(mjd)
    step = float(np.median(steps))
    longest = int(np.argmax(steps))
    if steps[longest] > LONGEST_BRIDGE * step * (1 + 1e-6):
        raise SeriesError(
            file,
            f"a gap of {steps[longest]:.1f} d follows MJD {mjd[longest]:.2f}",
            f"gaps up to {LONGEST_BRIDGE} steps are bridged; take a span on one side of it",
            rows[longest].line,
        )
    even = mjd[0] + step * np.arange(round((mjd[-1] - mjd[0]) / step) + 1)
    if even.size != mjd.size or np.max(abs(even - mjd)) > 1e-3 * step:
        repairs.append(f"{max(even.size - mjd.size, 0)} missing steps bridged by straight lines")
        values = np.column_stack([np.interp(even, mjd, column) for column in values.T])
        mjd = even
    x, y, x_error, y_error = values.T
    return PoleSeries(mjd, x, y, x_error, y_error, kind, "; ".join(repairs))

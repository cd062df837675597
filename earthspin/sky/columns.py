"""Lines and numbers of tables in text, refused by line where they are wrong."""

from __future__ import annotations

import datetime
import hashlib
import re
from pathlib import Path

from earthspin.errors import SeriesError, no_plain_file

#: Proleptic day number of the modified Julian date 0, 1858 November 17.
_FIRST_DAY = datetime.date(1858, 11, 17).toordinal()
#: How far a modified Julian date may be from the calendar's beside it: what rounding does, d.
_SAME_DATE = 2e-3


def lines_of(file: Path) -> list[str]:
    """All lines.

    Raises
    ------
    SeriesError
        If the file cannot be read.
    """
    if problem := no_plain_file(file):
        raise SeriesError(file, problem)
    try:
        return file.read_text(encoding="ascii", errors="replace").splitlines()
    except OSError as error:
        raise SeriesError(file, f"it cannot be read: {error.strerror}") from None


def is_table(head: bytes) -> bool:
    """Whether a file can be a table: it begins with text, and a line of that with a number.

    Parameters
    ----------
    head : bytes
        First bytes of the file.
    """
    rows = (re.split(rb"[\s,;]", line.strip(b" \t,;"), maxsplit=1) for line in head.splitlines())
    return b"\0" not in head and any(is_number(row[0].decode("latin-1")) for row in rows)


def checksum(file: Path) -> str:
    """SHA-256 of a file that was read, by which an answer knows it again."""
    return hashlib.sha256(file.read_bytes()).hexdigest()


def is_number(word: str) -> bool:
    """Whether a word is a number."""
    try:
        float(word)
    except ValueError:
        return False
    return True


def numbers(file: Path, line: int, words: list[str]) -> list[float]:
    """Numbers of a line.

    Raises
    ------
    SeriesError
        If a word is none.
    """
    try:
        return [float(word) for word in words]
    except ValueError as error:
        raise SeriesError(file, str(error), "a number is expected", line) from None


def check_calendar(file: Path, line: int, calendar: list[float], mjd: float) -> None:
    """Refuse a modified Julian date that is not the day of the calendar beside it.

    Parameters
    ----------
    file : Path
    line : int
    calendar : list of float
        Year, month, day and hour.
    mjd : float

    Raises
    ------
    SeriesError
        If they differ, or there is no such day.
    """
    year, month, day, hour = calendar
    try:
        first = datetime.date(int(year), int(month), int(day)).toordinal() - _FIRST_DAY
    except (ValueError, OverflowError):
        raise SeriesError(
            file, f"there is no day {year:g}-{month:g}-{day:g}", "is a column lost?", line
        ) from None
    expected = first + hour / 24
    if not abs(mjd - expected) <= _SAME_DATE:
        raise SeriesError(
            file,
            f"MJD {mjd:.2f} stands beside the calendar's date of MJD {expected:.2f}",
            "the two must agree; is a column lost?",
            line,
        )

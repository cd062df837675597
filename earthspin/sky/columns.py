"""Read rows of numbers from text tables, with error messages that name the line."""

from __future__ import annotations

import codecs
import datetime
import gzip
import hashlib
import re
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path

from earthspin.errors import SeriesError, no_plain_file

#: First bytes of a file compressed by gzip.
GZIP = b"\x1f\x8b"
#: Exponent letter of Fortran: 1.5D-03.
FORTRAN = re.compile(r"(?<=\d)[dD](?=[-+]?\d)")
#: First characters of comment lines.
COMMENTS = "#%!*$"
#: Proleptic day number of the modified Julian date 0, 1858 November 17.
_FIRST_DAY = datetime.date(1858, 11, 17).toordinal()
#: Tolerance between a modified Julian date and the calendar date in its row, for rounding, d.
_SAME_DATE = 2e-3


def lines_of(file: Path) -> list[str]:
    """Read the lines of a text file, which may be compressed by gzip.

    Raises
    ------
    SeriesError
        If the file cannot be read.
    """
    if problem := no_plain_file(file):
        raise SeriesError(file, problem)
    try:
        data = file.read_bytes()
        data = gzip.decompress(data) if data.startswith(GZIP) else data
    except (OSError, EOFError, zlib.error) as error:
        reason = getattr(error, "strerror", None) or error
        raise SeriesError(file, f"it cannot be read: {reason}") from None
    return data.removeprefix(codecs.BOM_UTF8).decode("ascii", errors="replace").splitlines()


def is_table(head: bytes) -> bool:
    """Return True if a file may be a table: text with a line that starts with a number, or gzip.

    Parameters
    ----------
    head : bytes
        First bytes of the file.
    """
    row = re.search(rb"(?m)^[\s,;]*[-+]?\.?\d", head)
    return head.startswith(GZIP) or (b"\0" not in head and row is not None)


def checksum(file: Path) -> str:
    """SHA-256 hash of an input file, stored in results to identify the file."""
    return hashlib.sha256(file.read_bytes()).hexdigest()


def is_number(word: str) -> bool:
    """Return True if a word of text can be read as a number."""
    try:
        float(word)
    except ValueError:
        return False
    return True


def rows_of(lines: list[str]) -> Iterator[tuple[int, list[str]]]:
    """For each line that begins with a number, yield its line number (from 1) and its words."""
    for number, line in enumerate(lines, start=1):
        words = line.split()
        if words and is_number(words[0]):
            yield number, words


def text_between(lines: list[str], is_row: Callable[[str], bool]) -> list[int]:
    """Line numbers of text below a table's first row: neither rows, comments nor blank lines.

    Parameters
    ----------
    lines : list of str
    is_row : callable
        Function that tests whether a line is a row of the table.
    """
    below, text = False, []
    for number, line in enumerate(lines, start=1):
        if is_row(line):
            below = True
        elif below and line.strip() and line.lstrip()[0] not in COMMENTS:
            text.append(number)
    return text


def starts_with_number(line: str) -> bool:
    """Return True if the first word of a line is a number; words end at spaces or commas."""
    word = re.split(r"[\s,;]", line.strip(" \t,;"), maxsplit=1)[0]
    return is_number(word) or is_number(FORTRAN.sub("e", word))


def refuse_text_between(file: Path, lines: list[str]) -> None:
    """Refuse a file that contains lines of text below the first row of numbers.

    Raises
    ------
    SeriesError
        If there are any; the message gives their count and the first one.
    """
    text = text_between(lines, starts_with_number)
    if text:
        count = f"{len(text)} line{'s' * (len(text) > 1)}"
        problem = f"{count} among the rows does not begin with a number"
        raise SeriesError(file, problem, "correct it, or begin a comment with #", text[0])


def numbers(file: Path, line: int, words: list[str]) -> list[float]:
    """Convert the words of a text line to numbers.

    Raises
    ------
    SeriesError
        If a word is not a number.
    """
    try:
        return [float(word) for word in words]
    except ValueError as error:
        raise SeriesError(file, str(error), "a number is expected", line) from None


def table_of(file: Path) -> tuple[str, list[list[float]], list[int]]:
    """Read a text file of numbers in columns, separated by spaces, commas or semicolons.

    Returns
    -------
    header : str
        Last line of text above the rows; empty if there is none.
    rows : list of list of float
    lines : list of int
        Line of each row in the file.

    Raises
    ------
    SeriesError
        If there are no rows, a row has another number of columns, or text stands between the rows.
    """
    header, rows, lines = "", list[list[float]](), list[int]()
    text = lines_of(file)
    refuse_text_between(file, text)
    for number, line in enumerate(text, start=1):
        words = [FORTRAN.sub("e", word) for word in re.split(r"[\s,;]+", line.strip(" \t,;"))]
        if not is_number(words[0]):
            if not rows and words != [""]:
                header = line.strip(" \t,;")
            continue
        if rows and len(words) != len(rows[0]):
            problem = f"{len(words)} columns after {len(rows[0])}"
            raise SeriesError(file, problem, "is it cut off?", number)
        rows.append(numbers(file, number, words))
        lines.append(number)
    if not rows:
        raise SeriesError(file, "it holds no rows of numbers")
    return header, rows, lines


def check_calendar(file: Path, line: int, calendar: list[float], mjd: float) -> None:
    """Refuse a modified Julian date that differs from the calendar date in its row.

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
        problem = f"there is no day {year:g}-{month:g}-{day:g}"
        raise SeriesError(file, problem, "is a column lost?", line) from None
    expected = first + hour / 24
    if not abs(mjd - expected) <= _SAME_DATE:
        problem = f"MJD {mjd:.2f} differs from the calendar date, MJD {expected:.2f}"
        raise SeriesError(file, problem, "the two must agree; is a column lost?", line)

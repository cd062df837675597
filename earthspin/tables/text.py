"""Lines and cells of text: compression, encodings, delimiters, quotes and decimals."""

from __future__ import annotations

import codecs
import csv
import gzip
import hashlib
import re
import zlib
from collections.abc import Iterable, Sequence
from pathlib import Path

from earthspin.errors import SeriesError, no_plain_file
from earthspin.tables import foreign

#: First bytes of a file compressed by gzip, and of text in UTF-16.
_GZIP, _UTF16 = b"\x1f\x8b", (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
#: Exponent letter of Fortran: 1.5D-03.
_FORTRAN = re.compile(r"(?<=[\d.])[dD](?=[-+]?\d)")
#: Beginning of a line that is a row, which may be quoted.
_FIRST_WORD = re.compile(r"[\s,;\"']*([^\s,;\"']+)")
_DATE = re.compile(r"[-+]?\d{4,}-\d\d-\d\d")
#: First characters of comments, and delimiters in the order in which they are tried.
COMMENTS, DELIMITERS = "#%!*$", ";\t,"
#: Words of cells without a number.
MISSING = ("", "na", "nan", "n/a", "null", "none", "-", "--", "*", "<na>")
#: Number of first rows in which decimal commas are looked for.
_FEW = 60


def lines_of(file: Path) -> list[str]:
    """Read the lines of a text file, which may be compressed by gzip.

    Raises
    ------
    SeriesError
        If the file cannot be read, or holds no text.
    """
    data = _bytes_of(file)
    if data.startswith(_GZIP):
        try:
            data = gzip.decompress(data)
        except (OSError, EOFError, zlib.error) as error:
            raise SeriesError(file, f"it cannot be read: {error}") from None
    foreign.refuse(file, data.removeprefix(codecs.BOM_UTF8))
    wide = data.startswith(_UTF16)
    return data.decode("utf-16" if wide else "utf-8-sig", errors="replace").splitlines()


def _bytes_of(file: Path) -> bytes:
    """Read a file, or refuse what is none."""
    if problem := no_plain_file(file):
        raise SeriesError(file, problem)
    try:
        return file.read_bytes()
    except OSError as error:
        raise SeriesError(file, f"it cannot be read: {error.strerror or error}") from None


def is_table(head: bytes) -> bool:
    """Return True if a file may be a table of text.

    Parameters
    ----------
    head : bytes
        First bytes of the file.
    """
    if head.startswith(_UTF16):
        head = head[: len(head) // 2 * 2].decode("utf-16", errors="replace").encode()
    row = re.search(rb"(?m)^[\s,;\"']*[-+]?\.?\d", head)
    text = b"\0" not in head and row is not None
    return head.startswith(_GZIP) or text


def checksum(file: Path) -> str:
    """SHA-256 hash of an input file, stored in results to identify the file."""
    return hashlib.sha256(_bytes_of(file)).hexdigest()


def is_number(word: str) -> bool:
    """Return True if a word of text can be read as a number."""
    try:
        float(_FORTRAN.sub("e", word).replace(",", "."))
    except ValueError:
        return False
    return True


def is_row(line: str) -> bool:
    """Return True if a line begins with a number or a date."""
    word = _FIRST_WORD.match(line)
    return word is not None and (is_number(word[1]) or _DATE.match(word[1]) is not None)


def delimiter_of(row: str) -> str:
    """Delimiter of the cells in a row; empty if these are separated by spaces.

    Titles and units mislead, so that only a row tells it. Cells that hold several numbers are not
    separated by it.
    """
    for mark in DELIMITERS:
        cells = [cell.split() for cell in row.strip().split(mark)]
        if len(cells) > 1 and not any(
            len(cell) > 1 and all(map(is_number, cell)) for cell in cells
        ):
            return mark
    return ""


def cells_of(lines: Sequence[str], mark: str) -> list[Sequence[str]]:
    """Split rows into cells at a delimiter, or at spaces if it is empty.

    Exponents may be those of Fortran, and decimals may be commas unless commas separate the cells.
    """
    if any(_FORTRAN.search(line) for line in (lines[0], lines[-1])):
        lines = [_FORTRAN.sub("e", line) for line in lines]
    if mark:
        rows: list[Sequence[str]] = [
            [cell.strip() for cell in row] for row in csv.reader(lines, delimiter=mark)
        ]
        if mark != "," and _has_decimal_commas(cell for row in rows[:_FEW] for cell in row):
            rows = [[re.sub(r"(?<=\d),(?=\d)", ".", cell) for cell in row] for row in rows]
        return rows
    if "," in lines[0] and "." not in lines[0] and _has_decimal_commas(lines[0].split()):
        lines = [line.replace(",", ".") for line in lines]
    if re.search('[,;"]', lines[0]):
        return [re.split(r"[\s,;]+", line.replace('"', "").strip(" \t,;")) for line in lines]
    return [line.split() for line in lines]


def _has_decimal_commas(cells: Iterable[str]) -> bool:
    """Return True if a cell is a number with a comma for its point."""
    return any(re.fullmatch(r"[-+]?\d+,\d+([eE][-+]?\d+)?", cell) for cell in cells)


def names_of(line: str, mark: str) -> list[str]:
    """Split a line above the rows into names of columns, which keep their units in parentheses."""
    bare = line.strip().lstrip(COMMENTS).strip(" ")
    if mark:
        return [name.strip() for name in next(csv.reader([bare], delimiter=mark), [])]
    return re.findall(r"[^\s,;()\[\]\"]+(?:\s*[(\[][^)\]]*[)\]])?", bare)

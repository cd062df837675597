"""Tables split into header and rows, from files of text and from data frames."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field, replace
from itertools import compress
from pathlib import Path
from typing import Any

import numpy as np

from earthspin.errors import SeriesError, nearest
from earthspin.numerics.arrays import Array, BoolArray, FloatArray
from earthspin.tables import text as text_of
from earthspin.tables.columns import BLANK, MORE, Meaning, column_of, declared, fits, written
from earthspin.tables.layouts import TableLayout
from earthspin.units import COMMON, as_written, real_numbers, time_scale

#: Number of lines above the rows in which a header is looked for, and in which names are.
_HEAD, _NEAREST = 60, 6
#: Longer cells above the rows are sentences, not names of columns.
_LONGEST_NAME = 40
#: Name of a data frame in messages.
FRAME = "DataFrame"


@dataclass(frozen=True, eq=False)
class Sheet:
    """Header and rows of a table.

    Attributes
    ----------
    file : Path or str
        File, or the name of a data frame.
    words : str
        Name of the file and the lines above its rows.
    names : list of str
        Names of the columns in the header; empty if there is none.
    cells : list of sequence
        Cells of each column: text, or the array of a data frame.
    lines : list of int
        Line of each row in the file; empty for a data frame.
    text : list of int
        Lines of text among the rows.
    layout : TableLayout or None
        TableLayout that the words above the rows name.
    known : dict of int to array
        Columns whose numbers are read already.
    """

    file: Path | str
    words: str
    names: list[str]
    cells: Sequence[Any]
    lines: list[int] = field(default_factory=list)
    text: list[int] = field(default_factory=list)
    layout: TableLayout | None = None
    known: dict[int, FloatArray] = field(default_factory=dict)

    @property
    def is_frame(self) -> bool:
        """Whether the table is a data frame."""
        return self.file == FRAME

    @property
    def width(self) -> int:
        """Number of columns."""
        return len(self.cells)

    def error(self, problem: str, remedy: str = "", row: int | None = None) -> SeriesError:
        """Build an error whose message names the file, and the line of a row."""
        if row is None:
            return SeriesError(self.file, problem, remedy)
        if self.is_frame:
            return SeriesError(self.file, f"row {row}: {problem}", remedy)
        return SeriesError(self.file, problem, remedy, self.lines[row])

    def refuse(self, wrong: BoolArray, problem: str, remedy: str = "", **columns: Array) -> None:
        """Refuse the first wrong row, if any; the problem names its values by ``{name}``."""
        if wrong.any():
            row = int(np.argmax(wrong))
            values = {name: column[row] for name, column in columns.items()}
            raise self.error(problem.format(**values), remedy, row)

    def only(self, kept: Iterable[bool]) -> Sheet:
        """Return the table with a selection of its rows."""
        kept = [*kept]
        cells = [[*compress(column, kept)] for column in self.cells]
        return replace(self, cells=cells, lines=[*compress(self.lines, kept)], known={})

    def column(self, place: int) -> FloatArray:
        """Return the numbers of a column; cells without a number are nan."""
        if place not in self.known:
            self.known[place] = self._numbers(place)
        return self.known[place]

    def _numbers(self, place: int) -> FloatArray:
        cells = self.cells[place]
        try:
            return real_numbers(cells) if self.is_frame else np.array(cells, dtype=float)
        except (TypeError, ValueError):
            if self.is_frame:
                raise self.error(f"column '{self.names[place]}' holds more than numbers") from None
            return np.array([self._number(row, cell) for row, cell in enumerate(cells)])

    def _number(self, row: int, cell: str) -> float:
        try:
            return np.nan if cell.strip().lower() in text_of.MISSING else float(cell)
        except ValueError as error:
            raise self.error(str(error), "a number is expected", row) from None

    def values(
        self,
        columns: Sequence[Meaning],
        quantity: str,
        unit: str,
        rows: slice | BoolArray = slice(None),
        missing: float = np.nan,
    ) -> FloatArray:
        """Return the numbers of a quantity in a unit, in all or some rows.

        Without a column of the quantity they are `missing`.
        """
        place = next((n for n, column in enumerate(columns) if column.quantity == quantity), None)
        if place is None:
            return np.full(len(self.cells[0]), missing)[rows]
        column = columns[place]
        try:
            factor, origin = column.conversion(unit)
        except ValueError:
            problem = f"the unit of '{column}' is not known"
            raise self.error(problem, f"write it like '{column.quantity} ({unit})'") from None
        numbers = self.column(place)[rows]
        return as_written(numbers, factor, origin) if origin or column.is_time else factor * numbers

    def refuse_text(self) -> None:
        """Refuse a table with lines of text among its rows."""
        if self.text:
            count = f"{len(self.text)} line{'s' * (len(self.text) > 1)}"
            problem = f"{count} among the rows does not begin with a number"
            remedy = "correct it, or begin a comment with #"
            raise SeriesError(self.file, problem, remedy, self.text[0])

    def as_declared(self, text: str, allowed: Collection[str] = ()) -> list[Meaning]:
        """Return the columns that the user declares, one for each column of the table.

        Raises
        ------
        SeriesError
            If a quantity is none of those that are allowed, or their number is another.
        """
        if not isinstance(text, str):
            raise self.error(f"columns={text!r}", "give one text, like 't (yr), k, h, q, p'")
        meaning = declared(text)
        names = [column.quantity for column in meaning if column.quantity]
        for name in names:
            if allowed and name not in allowed:
                raise self.error(f"columns='{text}': '{name}' is unknown", nearest(name, allowed))
            if names.count(name) > 1:
                raise self.error(f"columns='{text}': '{name}' stands twice", "keep one of them")
        if not fits(text, self.width):
            problem = f"{self.width} columns, of which {len(meaning)} are named"
            raise self.error(problem, f"name each, leave names empty, or end with '{MORE}'")
        return [*meaning, *[BLANK] * (self.width - len(meaning))]

    def not_understood(self, columns: Sequence[Meaning], needed: str = "") -> SeriesError:
        """Build an error for a header that is not understood, with the columns to type."""
        problem = f"its header '{', '.join(self.names)}' is not understood"
        return self.error(problem, f"say what its columns are: {typed(columns)} {needed}".rstrip())


def typed(columns: Sequence[Meaning], more: bool = False) -> str:
    """Return the key that declares columns, as the user types it."""
    return f"columns='{written(columns, more)}'"


def is_frame(table: object) -> bool:
    """Return True if an object is a data frame, of pandas or polars."""
    return hasattr(table, "columns") and (hasattr(table, "iloc") or hasattr(table, "get_column"))


def of_frame(frame: Any) -> Sheet:
    """Return a data frame of pandas or polars as a table."""
    arrays: list[Array] = [
        series_of(frame, place).to_numpy() for place in range(len(frame.columns))
    ]
    if not arrays or not arrays[0].size:
        raise SeriesError(FRAME, "it holds no rows")
    return Sheet(FRAME, "", [str(name) for name in frame.columns], arrays)


def series_of(frame: Any, place: int) -> Any:
    """Return a column of a data frame, whose names may be repeated."""
    return frame.iloc[:, place] if hasattr(frame, "iloc") else frame[frame.columns[place]]


def split(file: Path, layouts: Sequence[TableLayout] = ()) -> Sheet:
    """Split a file of text into header and rows.

    Semicolons, tabs, commas or spaces separate columns, as in the first row; cells may be quoted,
    decimals may be commas where these separate nothing, exponents those of Fortran.

    Parameters
    ----------
    file : Path
    layouts : sequence of TableLayout
        Layouts whose words are looked for above the rows, and whose rows and columns may be
        separated in their own way.

    Raises
    ------
    SeriesError
        If the file cannot be read, holds no rows, or rows of different length.
    """
    lines = text_of.lines_of(file)
    start = next((place for place, line in enumerate(lines) if text_of.is_row(line)), len(lines))
    head = [line for line in lines[max(start - _HEAD, 0) : start] if line.strip()]
    words, first = "\n".join([file.name, *head]), "".join(lines[start : start + 1])
    layout = next((x for x in layouts if _begins(x, words, first)), None)
    rows, numbers, text = _rows(lines, start, layout)
    if not rows:
        raise SeriesError(file, "it holds no rows of numbers", "is it complete?")
    if layout and layout.edges:
        cut = [[line[begin:end] for line in rows] for begin, end in layout.edges]
        return Sheet(file, words, [], cut, numbers, text, layout)
    mark = text_of.delimiter_of(rows[0])
    cells = text_of.cells_of(rows, mark)
    cells, names = _cells_and_names(cells, head, mark)
    sheet = Sheet(file, words, names, [*zip(*cells, strict=False)], numbers, text, layout)
    count = np.array([len(row) for row in cells])
    other = count != count[0]
    remedy = "is a column lost?" if other[:-1].any() else "is the file cut off?"
    sheet.refuse(other, f"{{count}} columns; {count[0]} are expected", remedy, count=count)
    return sheet


def _begins(layout: TableLayout, words: str, first: str) -> bool:
    """Return True if the words above the rows, or the first row, are those of a layout."""
    if layout.head:
        return re.search(layout.head, words) is not None
    return bool(layout.row) and re.match(layout.row, first) is not None


def _rows(
    lines: list[str], start: int, layout: TableLayout | None
) -> tuple[list[str], list[int], list[int]]:
    """Rows of a file from the line `start` on, their line numbers, and lines of text among them."""
    rows, numbers, text = [], [], []
    for number, line in enumerate(lines[start:], start=start + 1):
        if layout and layout.until and re.search(layout.until, line):
            break
        if re.match(layout.row, line) if layout and layout.row else text_of.is_row(line):
            rows.append(line)
            numbers.append(number)
        elif rows and line.strip() and line.lstrip()[0] not in text_of.COMMENTS:
            text.append(number)
    return rows, numbers, text


def _cells_and_names(
    cells: list[Sequence[str]], head: list[str], mark: str
) -> tuple[list[Sequence[str]], list[str]]:
    """Cells of the rows and names of the columns.

    The empty column after a delimiter at the end, and the names of rows that R writes, are left
    out.
    """
    names = _header(head, [mark, *text_of.DELIMITERS, ""], len(cells[0]))
    if mark and len(cells[0]) > 1 and not any(row[-1] for row in cells):
        shorter = _header(head, [mark], len(cells[0]) - 1)
        if (shorter and shorter[0]) or not (names and names[-1]):
            cells, names = [row[:-1] for row in cells], shorter or names[:-1]
    numbered = [row[0] for row in cells] == [str(row + 1) for row in range(len(cells))]
    if numbered and names and not names[0] and len(cells) > 1:
        cells, names = [row[1:] for row in cells], names[1:]
    return cells, names


def _header(head: list[str], marks: list[str], count: int) -> list[str]:
    """Names of the columns: the last line that has as many, or one less if rows have names.

    A line of units below the names is joined to them.
    """
    units: list[str] = []
    for line in reversed(head[-_NEAREST:]):
        for mark in dict.fromkeys(marks):
            names = text_of.names_of(line, mark)
            names = ["", *names] if len(names) == count - 1 and count > 2 else names
            prose = line.rstrip().endswith(".") or max(map(len, names), default=0) > _LONGEST_NAME
            if len(names) != count or count < 2 or prose or not re.search("[A-Za-z]", line):
                continue
            if not units and all(map(_is_unit, names)):
                units = names
                break
            pairs = zip(names, units or [""] * count, strict=True)
            return [f"{name} ({unit.strip('()[]')})" if unit else name for name, unit in pairs]
    return units


def _is_unit(word: str) -> bool:
    """Return True if a word is a unit, or stands for none."""
    unit = column_of(f"x ({word.strip('()[] ')})").unit
    return unit in COMMON or unit in ("", "1", "-", "uas") or time_scale(unit) is not None

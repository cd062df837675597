"""Tables of text, for the terminal and for HTML pages."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, SupportsFloat

import numpy as np
import xarray as xr

MAS_PER_CENTURY = 1e5  # of an arcsec/yr
#: From here on, numbers are written with a power of ten.
LARGE = 1e9
#: Text of a cell up to this length stands on one line.
SHORT = 32
#: Characters between two columns on the terminal.
SPACE = 3
#: What the brackets mean, for whoever meets them first.
BRACKETS = (
    "Every error is the half-width of a 95 % interval; digits in brackets give it in units of the "
    "last digits."
)

#: Said of a half-width that holds the uncertainty of the input numbers, and nothing that the model
#: leaves out.
NUMBERS_ONLY = "numbers only"


@dataclass(frozen=True)
class Table:
    """Table of text for the terminal or a page, with title, headers, note and run time.

    Attributes
    ----------
    title : str
    headers : tuple of str
    rows : sequence of tuple of str
    note : str
        A sentence or two below it; may have several lines.
    words : collection of int
        The columns that hold text; the others are set to the right.
    cost : str
        Run time, in small print below the table on a page.
    figure : str
        A picture below the table on a page, as SVG.
    """

    title: str
    headers: tuple[str, ...]
    rows: Sequence[tuple[str, ...]]
    note: str = ""
    words: Collection[int] = (0,)
    cost: str = ""
    figure: str = ""


@dataclass(frozen=True)
class Column:
    """Description of a table column: name of the variable, number format and header.

    In a table of quantities it describes a row.

    Attributes
    ----------
    name : str
        Variable that it shows; its label and unit make the header.
    shown : str or callable
        Format of the number, which is followed by its error in brackets if this is empty; or a
        function from the data of one row to the text.
    head : str
        Header, in place of label and unit.
    """

    name: str = ""
    shown: str | Callable[[xr.Dataset], str] = ""
    head: str = ""

    def header(self, data: xr.Dataset) -> str:
        """Header of the column; in a table of quantities, this text is the label of the row."""
        return self.head or label(data[self.name])

    def text(self, row: xr.Dataset) -> str:
        """Text of one table cell, from the data of one row."""
        if callable(self.shown):
            return self.shown(row)
        if row[self.name].dtype.kind in "UO":
            return str(row[self.name].values).replace("_", " ")
        if not self.shown:
            return measured(row, self.name)
        return short_exponents(f"{float(row[self.name]):{self.shown}}")


def label(variable: xr.DataArray) -> str:
    """Label of a variable for tables: its short label or its name, followed by the unit."""
    words, unit = variable.attrs.get("short", ""), variable.attrs.get("units", "")
    words = words or str(variable.name).replace("_", " ")
    return words if unit in ("", "1") else f"{words}, {unit}"


def table_along(
    data: xr.Dataset,
    dim: str,
    title: str,
    columns: Sequence[Column | str],
    note: str = "",
    *,
    first: str | None = None,
    words: Collection[int] = (0,),
    more: Sequence[tuple[str, ...]] = (),
) -> Table:
    """Build a table with one row for each label along a dimension of the data.

    Parameters
    ----------
    data : Dataset
    dim : str
    title : str
    columns : sequence of Column or str
        The columns after the labels; text is the name of a variable and, after a colon, the format.
    note, words
        As of `Table`.
    first : str, optional
        Header of the column of labels; the name of the dimension by default; without a column if
        it is empty.
    more : sequence of tuple of str
        Further rows at the end.
    """
    first = dim if first is None else first
    shown = [_column(column) for column in columns]
    if first:
        shown = [Column(dim, lambda row: str(row[dim].values), first), *shown]
    headers = tuple(column.header(data) for column in shown)
    rows = [tuple(column.text(row) for column in shown) for _, row in along(data, dim)]
    return Table(title, headers, [*rows, *more], note, words)


def least_width(head: str, cells: Sequence[str]) -> int:
    """Characters that a column needs so that no number, word or short text is broken.

    Headers take at most three lines, or more if their longest word is short.
    """
    whole = [cell for cell in cells if len(cell) <= SHORT]
    broken = " ".join(cell for cell in cells if len(cell) > SHORT).split()
    return max(len(head) // 3, *map(len, [*head.split(), *whole, *broken, ""]))


def quantities(data: xr.Dataset, *rows: Column | str) -> list[tuple[str, str]]:
    """Rows of a table with one quantity in each row: its label, and its value as text."""
    return [(row.header(data), row.text(data)) for row in map(_column, rows)]


def _column(column: Column | str) -> Column:
    """Convert a text such as "energy:.3g" to a table column; return a column unchanged."""
    return Column(*column.split(":")) if isinstance(column, str) else column


def with_error(value: SupportsFloat, error: SupportsFloat, unit: str = "") -> str:
    """Format a value with two digits of its half-width in brackets.

    The digits in brackets belong to the last ones before them, as journals write it:
    ``50.404315(33)`` is 50.404315 ± 0.000033, and ``430.9(1.4)`` is 430.9 ± 1.4.

    Parameters
    ----------
    value, error : float
    unit : str
        Written after the numbers.
    """
    value, error = float(value), float(error)
    if not math.isfinite(value):
        return "none (no motion)"
    if error <= 0 or not math.isfinite(error):
        text = short_exponents(f"{value:.6g}")
    elif (size := max(abs(value), error)) < LARGE:
        text = _in_brackets(value, error)
    else:
        power = math.floor(math.log10(size))
        text = f"{_in_brackets(value / 10.0**power, error / 10.0**power)}e{power}"
    return f"{text} {unit}".rstrip()


def _in_brackets(value: float, error: float) -> str:
    """Format a value followed by two digits of its error in brackets, like ``50.40(33)``."""
    digits = max(0, 1 - math.floor(math.log10(error)))
    half = f"{error:.{digits}f}"
    return f"{value:.{digits}f}({half.removeprefix('0.').lstrip('0') if error < 1 else half})"


def short_exponents(text: str) -> str:
    """Shorten the exponents of numbers in a text: 2.6e35 instead of 2.6e+35."""
    return re.sub(r"(?<=\d)e(-?)\+?0*(?=\d)", r"e\1", text)


def two_digits(value: SupportsFloat) -> str:
    """Format a number to two digits; exponents are used below 0.0001 and above 999999."""
    return short_exponents(f"{float(f'{float(value):.2g}'):g}")


def quality(row: xr.Dataset, name: str = "quality_factor", shown: str = ".0f") -> str:
    """Format a quality factor as text; the text is empty if the factor is infinite."""
    return f"{float(row[name]):{shown}}" if math.isfinite(row[name]) else ""


def beside_observed(
    value: SupportsFloat, error: SupportsFloat, left_out: xr.Dataset | None, unit: str = ""
) -> str:
    """Format a computed value with all its known errors, for comparison with an observation.

    Parameters
    ----------
    value, error : float
        The half-width holds the input numbers only.
    left_out : Dataset or None
        The section `neglected` in the same unit: its sizes, which are systematic, are added to the
        half-width. Where no size is known, or not all are, the value is followed by "numbers only".
    unit : str
        Written after the numbers.
    """
    if left_out is not None and left_out.sizes["effect"] and not some_unknown(left_out):
        return with_error(value, float(error) + systematic_size(left_out), unit)
    plain = with_error(value, error, unit)
    return f"{plain}, {NUMBERS_ONLY}" if float(error) > 0 else plain


def systematic_size(left_out: xr.Dataset) -> float:
    """Sum of the sizes in a section `neglected`, without effects that vanish in the mean."""
    sizes = left_out.neglected_effect
    periodic = sizes.attrs.get("zero_in_the_mean", "").split("; ")
    return float(abs(sizes[~np.isin(sizes["effect"].values, periodic)]).sum())


def some_unknown(left_out: xr.Dataset) -> bool:
    """Return True if a result's section `neglected` names effects of unknown size."""
    return bool(left_out.neglected_effect.attrs.get("of_unknown_size"))


def measured(data: xr.Dataset, name: str, unit: str = "") -> str:
    """Format a variable of a Dataset, with two digits of its half-width in brackets."""
    return with_error(data[name], data[f"{name}_error"], unit)


def date(time: xr.DataArray | np.datetime64, to: Literal["Y", "D", "m", "s"] = "D") -> str:
    """Format a date as text, to the year, day, minute or second."""
    return str(np.asarray(time).astype(f"datetime64[{to}]"))


def along(data: xr.Dataset, dim: str) -> Iterator[tuple[str, xr.Dataset]]:
    """For each label of a dimension, yield its text and the data at that label."""
    for number, label in enumerate(data[dim].values):
        yield str(label), data.isel({dim: number})

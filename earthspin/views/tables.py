"""Text tables for terminal and HTML pages, and general tables of any result."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal, SupportsFloat

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from earthspin.engine.variables import error_of, from_si, places, texts_as_columns
from earthspin.views.result_contents import Result, answer_of, section

#: Below and from here on, numbers are written with a power of ten.
SMALL, LARGE = 1e-6, 1e9
#: Text of a cell up to this length stands on one line.
SHORT = 32
#: Characters between two columns on the terminal.
SPACE = 3
#: Explanation of errors in brackets, printed below tables.
BRACKETS = (
    "Every error is the half-width of a 95 % interval; digits in brackets give it in units of the "
    "last digits."
)

#: Words in names of variables and sections, as text spells them.
SPELLING = {"iau": "IAU", "bulletin a": "Bulletin A", "dpsi sineps": "dpsi sin(eps)"}
SPELLING |= {word: word.capitalize() for word in ("chandler", "gregorian", "lyapunov", "love")}


@dataclass(frozen=True)
class TextTable:
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
    """

    title: str
    headers: tuple[str, ...]
    rows: Sequence[tuple[str, ...]]
    note: str = ""
    words: Collection[int] = (0,)
    cost: str = ""


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
        """Header of the column (or label of the row, if each row is one quantity)."""
        return self.head or label(data[self.name])

    def text(self, row: xr.Dataset) -> str:
        """Text of one table cell, from the data of one row."""
        if callable(self.shown):
            return self.shown(row)
        if row[self.name].dtype.kind in "UO":
            return in_words(row[self.name].values)
        if not self.shown:
            return measured(row, self.name)
        return short_exponents(f"{float(row[self.name]):{self.shown}}")


def label(variable: xr.DataArray) -> str:
    """Label of a variable for tables: short label or name of the variable, then the unit."""
    words, unit = variable.attrs.get("short", ""), variable.attrs.get("units", "")
    words = words or in_words(variable.name)
    return words if unit in ("", "1") else f"{words}, {unit}"


def in_words(name: object) -> str:
    """Write the name of a variable or a section as text; angles such as psi_A remain symbols."""
    words = re.sub("_(?!A$)", " ", str(name))
    for word, spelled in SPELLING.items():
        words = re.sub(rf"\b{word}\b", spelled, words)
    return words


def table_along(
    data: xr.Dataset,
    dim: str,
    title: str,
    columns: Sequence[Column | str],
    note: str = "",
    *,
    first: str | None = None,
    more: Sequence[tuple[str, ...]] = (),
) -> TextTable:
    """Build a table with one row for each label along a dimension of the data.

    Parameters
    ----------
    data : Dataset
    dim : str
    title : str
    columns : sequence of Column or str
        The columns after the labels; text is the name of a variable and, after a colon, the format.
    note : str
        A sentence or two below it.
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
    return TextTable(title, headers, [*rows, *more], note)


def least_width(head: str, cells: Sequence[str]) -> int:
    """Smallest width of a column, in characters, that breaks no number, word or short text.

    Headers take at most three lines, or more if their longest word is short.
    """
    whole = [cell for cell in cells if len(cell) <= SHORT]
    broken = " ".join(cell for cell in cells if len(cell) > SHORT).split()
    return max(len(head) // 3, *map(len, [*head.split(), *whole, *broken, ""]))


def quantity(data: xr.Dataset, row: Column | str) -> tuple[str, str]:
    """Table row of one quantity: label and value as text."""
    row = _column(row)
    return row.header(data), row.text(data)


def _column(column: Column | str) -> Column:
    """Convert a text such as "energy:.3g" to a table column; return a column unchanged."""
    return Column(*column.split(":")) if isinstance(column, str) else column


def with_error(value: SupportsFloat, error: SupportsFloat, unit: str = "") -> str:
    """Format a value with its error (95 % half-width) to two digits in brackets.

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
    elif SMALL <= (size := max(abs(value), error)) < LARGE:
        text = _in_brackets(value, error)
    else:
        power = math.floor(math.log10(size))
        text = f"{_in_brackets(value / 10.0**power, error / 10.0**power)}e{power}"
    return f"{text} {unit}".rstrip()


def _in_brackets(value: float, error: float) -> str:
    """Format a value and two digits of a nonzero error without exponent, like ``50.40(33)``."""
    digits = max(0, 1 - math.floor(math.log10(error)))
    half = f"{error:.{digits}f}"
    return f"{value:z.{digits}f}({half.removeprefix('0.').lstrip('0') if error < 1 else half})"


def short_exponents(text: str) -> str:
    """Shorten the exponents of numbers in a text: 2.6e35 instead of 2.6e+35."""
    return re.sub(r"(?<=\d)e(-?)\+?0*(?=\d)", r"e\1", text)


def two_digits(value: SupportsFloat) -> str:
    """Format a number to two digits; exponents are used below 0.0001 and above 999999."""
    return short_exponents(f"{float(f'{float(value):.2g}'):g}")


def measured(data: xr.Dataset, name: str, unit: str = "") -> str:
    """Format a number of a Dataset with its 95 % half-width in brackets."""
    return with_error(data[name], data[f"{name}_error"], unit)


def date(time: xr.DataArray | np.datetime64, to: Literal["Y", "D", "m", "s"] = "D") -> str:
    """Format a date as text, to the year, day, minute or second."""
    return str(np.asarray(time).astype(f"datetime64[{to}]"))


def along(data: xr.Dataset, dim: str) -> Iterator[tuple[str, xr.Dataset]]:
    """Yield each label of a dimension as text, with the data at this label."""
    for number, label in enumerate(data[dim].values):
        yield str(label), data.isel({dim: number})


# --- tables of any answer ------------------------------------------------------------------------


#: A table has at most so many rows; of more numbers or dates it shows a sample of this size.
MOST_ROWS, SAMPLE = 24, 12
#: A variable with a second dimension fills at most so many columns; wider ones are in the data.
MOST_COLUMNS = 8
#: Characters of a row; columns that do not fit follow in a further table.
WIDTH = 98
#: Digits of numbers without an error.
DIGITS = 6
#: Units of errors that also hold for the components of unit vectors, in radians.
ANGLES = "deg", "arcsec", "mas", "uas"
#: Attributes of a variable that stand below its first table.
NOTED = "long_name", "comment", "frame", "left_out"


@dataclass(frozen=True, eq=False)
class DataColumn:
    """Values of one table column, with 95 % half-widths if known.

    Attributes
    ----------
    name : str
        Variable of the data.
    head : str
    values : DataArray
        Along the dimension of the rows, or a single number.
    errors : DataArray or None
        Half-widths in the unit of the values.
    half : float
        Distance to the nearer end of an interval that is not symmetric; 0 if there is none.
    """

    name: str
    head: str
    values: xr.DataArray
    errors: xr.DataArray | None = None
    half: float = 0.0

    @property
    def numbers(self) -> NDArray[Any]:
        """The values as floats; NaN for text and dates."""
        known = self.values.dtype.kind in "fiu"
        return self.values.values.astype(float) if known else np.full(self.values.shape, np.nan)

    def cells(self, rows: Any = ()) -> list[str]:
        """Text of the values in the given rows."""
        values = np.atleast_1d(self.values.values[rows])
        if values.dtype.kind == "M":
            whole_days = (values == values.astype("M8[D]")).all()
            return [date(value, "D" if whole_days else "s") for value in values]
        if self.half > 0:
            return [_with_decimals(values.item(), 1 - math.floor(math.log10(self.half)))]
        if self.errors is None:
            digits = 3 if re.search("correlation|share", self.name) else DIGITS
            return _aligned(values, digits)
        pairs = zip(values.tolist(), np.atleast_1d(self.errors.values[rows]).tolist(), strict=True)
        return [with_error(v, e) if np.isfinite(v) else _text(v) for v, e in pairs]


def tables(tree: Result, without: Iterable[str] = ()) -> list[TextTable]:
    """General tables of a result and its sections, made from the variables and dimensions.

    A table has a row for each label of a dimension, or for each single number. Values are
    followed by their half-widths in brackets.

    Parameters
    ----------
    tree : Dataset or DataTree
        Result of `run` or `run_tree`.
    without : iterable of str
        Sections that are not shown; the answer itself is the empty text.
    """
    answer = answer_of(tree)
    nodes = {} if "" in without else {str(answer.attrs.get("title", "Data")): answer}
    names = [] if isinstance(tree, xr.Dataset) else [*tree.children]
    for name in (name for name in names if name not in {"plan", *without}):
        data = section(tree, name)
        if any(array.size for array in data.values()):
            title = in_words(name)
            nodes[title[0].upper() + title[1:]] = data
    return [table for title, data in nodes.items() for table in tables_of(data, title)]


def tables_of(data: xr.Dataset, title: str) -> Iterator[TextTable]:
    """Tables of one Dataset: first a table of single numbers, then tables along each dimension.

    The first table that shows a variable says what it means.
    """
    columns: dict[str, list[DataColumn]] = {}
    wide: list[DataColumn] = []
    for name in main_variables(data):
        if parts := [*data_columns(data, name)]:
            for dim, column in parts:
                columns.setdefault(dim, []).append(column)
        else:
            wide.append(DataColumn(name, label(data[name]), data[name]))
    noted: set[str] = set()
    single = columns.pop("", [])
    if single or wide:
        rows = [(column.head, *column.cells()) for column in single]
        shapes = [" x ".join(map(str, column.values.shape)) for column in wide]
        rows += [(c.head, f"{shape} values") for c, shape in zip(wide, shapes, strict=True)]
        note = _notes(data, [*single, *wide], noted)
        yield TextTable(title, ("quantity", "value"), rows, note)
    further = [t for dim, along in columns.items() for t in _tables_along(data, dim, along, noted)]
    for table in further:
        is_first = table is further[0] and not (single or wide)
        yield replace(table, title=title if is_first else f"{title}: {table.title}")


def with_own_titles(tables: Iterable[TextTable]) -> list[TextTable]:
    """Return the tables with different titles, as the links of a page need."""
    unique: dict[str, TextTable] = {}
    for table in tables:
        title = table.title
        while title in unique:
            title += ", continued"
        unique[title] = replace(table, title=title)
    return [*unique.values()]


def main_variables(data: xr.Dataset) -> list[str]:
    """Names of the variables that tables show: all except half-widths and their contributions."""
    names = [str(name) for name in texts_as_columns(data).data_vars]
    half_widths = {_half_width(data, name) for name in names}
    return [name for name in names if name not in half_widths and "_error_" not in name]


def _half_width(data: xr.Dataset, name: str) -> str:
    """Name of the variable with the half-widths of `name`; empty if units or dimensions differ."""
    error = error_of(data, name)
    if error == name or "_error" not in error or error not in data:
        return ""
    unit, own = data[name].attrs.get("units"), data[error].attrs.get("units")
    angle = own in ANGLES and unit in ("1", *ANGLES)
    fits = {*data[error].dims} <= {*data[name].dims} and (own == unit or angle)
    return error if fits else ""


def _distance(data: xr.Dataset, name: str) -> float:
    """Distance of a number to the nearer end of its interval; 0 if it has no ends."""
    middle = re.sub("_(low|high)$", "", name)
    if not {f"{middle}_low", f"{middle}_high"} <= {*data}:
        return 0.0
    ends = (data[f"{middle}_{end}"] for end in ("low", "high"))
    return min(abs(float(end) - float(data[middle])) for end in ends)


def data_columns(data: xr.Dataset, name: str) -> Iterator[tuple[str, DataColumn]]:
    """Yield the table columns of one variable, each with the dimension along which the rows are.

    The rows are along the longest dimension; each label of the others has a column.
    """
    values, error = data[name], _half_width(data, name)
    errors = data[error].broadcast_like(values) if error else None
    if errors is not None and errors.attrs.get("units") in ANGLES:
        errors = errors * (from_si(values.attrs["units"]) / from_si(errors.attrs["units"]))
    if values.ndim == 0:
        yield "", DataColumn(name, label(values), values, errors, _distance(data, name))
        return
    rows = str(max(values.dims, key=lambda dim: values.sizes[dim]))
    others = [dim for dim in values.dims if dim != rows]
    count = int(np.prod([values.sizes[dim] for dim in others], initial=1))
    if values.sizes[rows] and count <= MOST_COLUMNS:
        for at in places(values, others):
            words = [_text(data[dim].values.tolist()[k]) for dim, k in at.items()]
            quantity, comma, unit = label(values).rpartition(", ")
            head = " ".join([quantity if comma else unit, *words]) + (f", {unit}" if comma else "")
            half = None if errors is None else errors.isel(at)
            yield rows, DataColumn(name, head, values.isel(at), half)


def _tables_along(
    data: xr.Dataset, dim: str, columns: list[DataColumn], noted: set[str]
) -> Iterator[TextTable]:
    """Yield tables with a row for each label of a dimension; more than one if columns are many.

    The title of a table names its quantities.
    """
    labels, count = DataColumn(dim, label(data[dim]), data[dim]), data.sizes[dim]
    rows, part = np.arange(count), ""
    if count > MOST_ROWS and data[dim].dtype.kind in "UO":
        rows, part = rows[:MOST_ROWS], f"The first {MOST_ROWS} of {count} rows."
    elif count > MOST_ROWS:
        rows = np.linspace(0, count - 1, SAMPLE).round().astype(int)
        part = f"{SAMPLE} of {count} rows."
    texts = {column: column.cells(rows) for column in (labels, *columns)}
    for group in _side_by_side(texts, labels):
        names = dict.fromkeys(label(data[c.name].assign_attrs(units="")) for c in group[1:])
        yield TextTable(
            " to ".join(dict.fromkeys([*names][i] for i in (0, -1))),
            tuple(column.head for column in group),
            [*zip(*(texts[column] for column in group), strict=True)],
            "\n".join(filter(None, (part, _notes(data, group, noted)))),
            words=[0, *(k for k, column in enumerate(group) if column.values.dtype.kind in "UO")],
        )


def _side_by_side(
    texts: Mapping[DataColumn, list[str]], labels: DataColumn
) -> Iterator[list[DataColumn]]:
    """Yield groups of columns that fit, with the labels, into the table width; omit empty ones."""
    widths = {column: SPACE + least_width(column.head, cells) for column, cells in texts.items()}
    group, room = [labels], WIDTH - widths[labels]
    for column, cells in texts.items():
        if column is labels or not any(cells):
            continue
        if len(group) > 1 and room < widths[column]:
            yield group
            group, room = [labels], WIDTH - widths[labels]
        group.append(column)
        room -= widths[column]
    if len(group) > 1:
        yield group


def _notes(data: xr.Dataset, columns: Iterable[DataColumn], noted: set[str]) -> str:
    """Note below a table: meaning, frame, sources of variables that no earlier note explains."""
    lines: list[str] = []
    left_out: dict[str, None] = {}
    for name in dict.fromkeys(column.name for column in columns):
        attrs = data[name].attrs
        error = _half_width(data, name)
        if error:
            left_out[data[error].attrs.get("not_modelled", "")] = None
        if name not in noted:
            quantity = label(data[name].assign_attrs(units=""))
            words = [str(attrs[k]) for k in NOTED if attrs.get(k, "none") not in ("none", quantity)]
            if source := attrs.get("references"):
                words.append(f"source: {source}")
            if error not in ("", f"{name}_error") and error not in noted:
                words.append(f"in brackets: {data[error].attrs.get('long_name', error)}")
            lines += [f"{quantity}: {'; '.join(words)}."] if words else []
            noted |= {name, error}
    lines += [f"Left out: {effect}." for effect in left_out if effect]
    return "\n".join(lines)


def _aligned(values: Any, digits: int) -> list[str]:
    """Text of the values of a column, all with as many decimals as the largest needs."""
    real = values if values.dtype.kind == "f" else np.zeros(0)
    sizes = np.abs(real[np.isfinite(real) & (real != 0)])
    if not sizes.size or sizes.max() >= LARGE or sizes.min() < sizes.max() / 10.0 ** (digits - 2):
        return [_text(value, digits) for value in values.tolist()]
    most = max(0, digits - 1 - math.floor(math.log10(sizes.max())))
    rounded = np.round(sizes, most)
    decimals = next(
        k for k in range(most + 1) if np.allclose(np.round(sizes, k), rounded, 1e-12, 0)
    )
    return [_with_decimals(value, decimals) for value in values.tolist()]


def _with_decimals(value: float, decimals: int) -> str:
    return f"{value:z.{max(0, decimals)}f}" if np.isfinite(value) else _text(value)


def _text(value: Any, digits: int = DIGITS) -> str:
    """Text of a table cell: number to some digits, text without underscores, or yes and no."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        if np.isfinite(value):
            return short_exponents(f"{value or 0.0:.{digits}g}")
        return "" if np.isnan(value) else "infinite" if value > 0 else "-infinite"
    return in_words(value)

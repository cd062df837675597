"""Tables of any answer and any section, from the labels, units and errors of its variables."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import numpy as np
import xarray as xr

from earthspin.engine.labels import from_si
from earthspin.engine.neglected import error_of
from earthspin.views.reading import Result, answer_of, needed
from earthspin.views.table import (
    SPACE,
    Table,
    date,
    label,
    least_width,
    short_exponents,
    with_error,
)

#: A table has at most so many rows; of more numbers or dates it shows a sample of this size.
MOST_ROWS, SAMPLE = 24, 12
#: A variable with a second dimension fills at most so many columns; wider ones are in the data.
MOST_COLUMNS = 8
#: Characters of a row; columns that do not fit follow in a further table.
WIDTH = 98
#: Units of errors that also hold for the components of unit vectors, in radians.
ANGLES = "deg", "arcsec", "mas", "uas"
#: Attributes of a variable that stand below its first table.
NOTED = "long_name", "comment", "frame"


@dataclass(frozen=True, eq=False)
class _Column:
    """Values of one column of a table, with half-widths if they have any of their own.

    Attributes
    ----------
    name : str
        Variable of the data.
    head : str
    values : DataArray
        Along the dimension of the rows, or a single number.
    errors : DataArray or None
        In the unit of the values.
    """

    name: str
    head: str
    values: xr.DataArray
    errors: xr.DataArray | None = None

    @property
    def is_text(self) -> bool:
        """Return True if the column holds words."""
        return self.values.dtype.kind in "UO"

    def cells(self, rows: Any = ()) -> list[str]:
        """Text of the values in the given rows."""
        values = np.atleast_1d(self.values.values[rows])
        if values.dtype.kind == "M":
            whole_days = (values == values.astype("M8[D]")).all()
            return [date(value, "D" if whole_days else "s") for value in values]
        if self.errors is None:
            return [_text(value) for value in values.tolist()]
        errors = np.atleast_1d(self.errors.values[rows])
        return [
            with_error(value, error) if np.isfinite(value) else _text(value)
            for value, error in zip(values.tolist(), errors.tolist(), strict=True)
        ]


def tables(tree: Result, without: Iterable[str] = ()) -> list[Table]:
    """Tables of an answer and of its sections.

    A table has a row for each label of a dimension, or for each single number. Values are
    followed by their half-widths in brackets.

    Parameters
    ----------
    tree : Dataset or DataTree
        As `run` or `run_tree` give it.
    without : iterable of str
        Sections that are not shown; the answer itself is the empty text.
    """
    answer = answer_of(tree)
    nodes = {} if "" in without else {str(answer.attrs["title"]): answer}
    names = [] if isinstance(tree, xr.Dataset) else [*tree.children]
    for name in (name for name in names if name not in {"plan", *without}):
        data = needed(tree, name)
        if any(array.size for array in data.values()):
            nodes[name.replace("_", " ").capitalize()] = data
    return [table for title, data in nodes.items() for table in tables_of(data, title)]


def tables_of(data: xr.Dataset, title: str) -> Iterator[Table]:
    """Tables of one Dataset: first its single numbers, then one or more for each dimension.

    The first table that shows a variable says what it means.
    """
    columns: dict[str, list[_Column]] = {}
    wide: list[_Column] = []
    for name in _names(data):
        if parts := [*_columns(data, name)]:
            for dim, column in parts:
                columns.setdefault(dim, []).append(column)
        else:
            wide.append(_Column(name, label(data[name]), data[name]))
    said: set[str] = set()
    single = columns.pop("", [])
    if single or wide:
        rows = [(column.head, *column.cells()) for column in single]
        rows += [(column.head, _shape(column.values)) for column in wide]
        note = _notes(data, [*single, *wide], said)
        yield Table(title, ("quantity", "value"), rows, note)
    for dim, along in columns.items():
        yield from _tables_along(data, dim, along, title, said)


def numbered(tables: Iterable[Table]) -> list[Table]:
    """Add a number to each title that a table before has, so that all titles differ."""
    unique: dict[str, Table] = {}
    for table in tables:
        title, number = table.title, 1
        while title in unique:
            number += 1
            title = f"{table.title} ({number})"
        unique[title] = replace(table, title=title)
    return [*unique.values()]


def _names(data: xr.Dataset) -> list[str]:
    """Names of the variables that tables show: all but half-widths, and shares of these."""
    names = [str(name) for name in data.data_vars]
    beside = {_half_width(data, name) for name in names}
    return [name for name in names if name not in beside and "_error_" not in name]


def _half_width(data: xr.Dataset, name: str) -> str:
    """Name of the variable with the half-widths of another; empty if it has none in its unit."""
    error = error_of(data, name)
    if error == name or "_error" not in error or error not in data:
        return ""
    unit, own = data[name].attrs.get("units"), data[error].attrs.get("units")
    angle = own in ANGLES and unit in ("1", *ANGLES)
    fits = {*data[error].dims} <= {*data[name].dims} and (own == unit or angle)
    return error if fits else ""


def _columns(data: xr.Dataset, name: str) -> Iterator[tuple[str, _Column]]:
    """Columns of one variable, each with the dimension of its rows.

    The rows are along the longest dimension; each label of the others has a column.
    """
    values, error = data[name], _half_width(data, name)
    errors = data[error].broadcast_like(values) if error else None
    if errors is not None and errors.attrs.get("units") in ANGLES:
        errors = errors * (from_si(values.attrs["units"]) / from_si(errors.attrs["units"]))
    if values.ndim == 0:
        yield "", _Column(name, label(values), values, errors)
        return
    rows = str(max(values.dims, key=lambda dim: values.sizes[dim]))
    others = [dim for dim in values.dims if dim != rows]
    count = int(np.prod([values.sizes[dim] for dim in others], initial=1))
    if values.sizes[rows] and count <= MOST_COLUMNS:
        for place in product(*(range(values.sizes[dim]) for dim in others)):
            at = dict(zip(others, place, strict=True))
            words = [_text(data[dim].values.tolist()[k]) for dim, k in at.items()]
            quantity, comma, unit = label(values).rpartition(", ")
            head = " ".join([quantity if comma else unit, *words]) + (f", {unit}" if comma else "")
            half = None if errors is None else errors.isel(at)
            yield rows, _Column(name, head, values.isel(at), half)


def _tables_along(
    data: xr.Dataset, dim: str, columns: list[_Column], title: str, said: set[str]
) -> Iterator[Table]:
    """Tables with a row for each label of a dimension; several if the columns are many."""
    labels, count = _Column(dim, label(data[dim]), data[dim]), data.sizes[dim]
    rows, part = np.arange(count), ""
    if count > MOST_ROWS and data[dim].dtype.kind in "UO":
        rows, part = rows[:MOST_ROWS], f"The first {MOST_ROWS} of {count} rows."
    elif count > MOST_ROWS:
        rows = np.linspace(0, count - 1, SAMPLE).round().astype(int)
        part = f"{SAMPLE} of {count} rows."
    texts = {column: column.cells(rows) for column in (labels, *columns)}
    for group in _side_by_side(texts, labels):
        yield Table(
            title,
            tuple(column.head for column in group),
            [*zip(*(texts[column] for column in group), strict=True)],
            "\n".join(filter(None, (part, _notes(data, group, said)))),
            words=[k for k, column in enumerate(group) if column is labels or column.is_text],
        )


def _side_by_side(texts: Mapping[_Column, list[str]], labels: _Column) -> Iterator[list[_Column]]:
    """Groups of columns that fit beside the labels; columns without any text are left out."""
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


def _notes(data: xr.Dataset, columns: Iterable[_Column], said: set[str]) -> str:
    """Lines with meaning, comment, frame and sources of variables that are not in `said` yet."""
    lines: list[str] = []
    left_out: dict[str, None] = {}
    for name in dict.fromkeys(column.name for column in columns):
        attrs = data[name].attrs
        error = _half_width(data, name)
        if error:
            left_out[data[error].attrs.get("not_modelled", "")] = None
        if name not in said:
            quantity = label(data[name].assign_attrs(units=""))
            words = [str(attrs[key]) for key in NOTED if attrs.get(key, quantity) != quantity]
            if source := attrs.get("references"):
                words.append(f"source: {source}")
            if error not in ("", f"{name}_error") and error not in said:
                words.append(f"in brackets: {data[error].attrs.get('long_name', error)}")
            lines += [f"{quantity}: {'; '.join(words)}."] if words else []
            said |= {name, error}
    lines += [f"Left out: {effect}." for effect in left_out if effect]
    return "\n".join(lines)


def _shape(values: xr.DataArray) -> str:
    """Describe the size of an array that no table shows, such as "361 x 3 values"."""
    return f"{' x '.join(map(str, values.shape))} values"


def _text(value: Any) -> str:
    """Text of a single value: to seven digits, words without underscores, yes or no."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        if np.isfinite(value):
            return short_exponents(f"{value or 0.0:.7g}")
        return "" if np.isnan(value) else "infinite" if value > 0 else "-infinite"
    return str(value).replace("_", " ")

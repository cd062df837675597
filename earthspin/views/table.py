"""A table and the words around it, for the terminal and for the page alike."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, SupportsFloat

import numpy as np
import xarray as xr

MAS_PER_CENTURY = 1e5  # of an arcsec/yr


@dataclass(frozen=True)
class Table:
    """A table and the words around it.

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


def with_error(value: SupportsFloat, error: SupportsFloat, unit: str = "") -> str:
    """Write a value and its half-width to two digits of the half-width.

    Parameters
    ----------
    value, error : float
    unit : str
        Written after the numbers.
    """
    value, error = float(value), float(error)
    behind = f" {unit}" if unit else ""
    if not math.isfinite(value):
        return "none (no motion)"
    if error <= 0 or not math.isfinite(error):
        return f"{value:.6g}{behind}"
    digits = max(0, 1 - math.floor(math.log10(error)))
    if abs(value) >= 1e9:
        significant = math.floor(math.log10(abs(value))) - math.floor(math.log10(error)) + 1
        return f"{value:.{max(significant, 0)}e} ± {error:.1e}{behind}".replace("e+", "e")
    return f"{value:.{digits}f} ± {error:.{digits}f}{behind}"


def two_digits(value: SupportsFloat) -> str:
    """Write a number to two digits, without an exponent from 0.0001 to 999999."""
    return f"{float(f'{float(value):.2g}'):g}"


def measured(data: xr.Dataset, name: str, unit: str = "") -> str:
    """Write a variable and its error."""
    return with_error(data[name], data[f"{name}_error"], unit)


def listed(values: Iterable[SupportsFloat]) -> str:
    """Write numbers side by side."""
    return ", ".join(f"{float(value):.6g}" for value in values)


def date(time: xr.DataArray | np.datetime64, to: Literal["Y", "D", "m", "s"] = "D") -> str:
    """Write a date to the year, day, minute or second."""
    return str(np.asarray(time).astype(f"datetime64[{to}]"))


def along(data: xr.Dataset, dim: str) -> Iterator[tuple[str, xr.Dataset]]:
    """Go through a dimension: each label as text, with the data at it."""
    for number, label in enumerate(data[dim].values):
        yield str(label), data.isel({dim: number})

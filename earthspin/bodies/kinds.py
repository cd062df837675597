"""Classes that convert each field of a body from text, tables and Quantities, and back exactly."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from typing import Any

import numpy as np

from earthspin.constants import Constant
from earthspin.errors import EarthspinError, Where, nearest
from earthspin.sky.sources import read_position, write_position
from earthspin.units import pack, quantity, unpack

#: A value that a scene file can hold.
Plain = Any


@dataclass(frozen=True)
class Magnitude:
    """Converter of a field that is a number with a unit, or an array of such numbers.

    Attributes
    ----------
    unit : str
        Unit of the stored value.
    text : str
        Example of a number with its unit.
    ratio : str
        Definition of a dimensionless number as a quotient.
    """

    unit: str
    text: str
    ratio: str = "..."

    words, hint = "a number with its unit", "float | str | Quantity | DataArray"

    @property
    def form(self) -> str:
        """Example of how to write the value in a scene file, as text with a unit or as a ratio."""
        return f'"... {self.text.partition(" ")[2]}"' if self.unit else self.ratio

    def read(self, value: object, where: Where) -> Any:
        """Convert text, a number, a Quantity, an array or a table made by `write` to SI units."""
        if isinstance(value, Mapping):
            return _labelled(value, where)

        return quantity(value, self.unit, where, self.text)

    def write(self, value: Any) -> Plain:
        """Convert the value for a scene file: a number with its unit, or an array as a table."""
        if hasattr(value, "dims"):
            table = pack(value.values) | {"dims": list(map(str, value.dims))}
            return table | {"labels": _labels_of(value)}
        return f"{float(value)!r} {self.unit}" if self.unit else value


@dataclass(frozen=True)
class Moments:
    """Converter of three principal moments of inertia, the polar one last, kg m2."""

    words, hint = "three moments, the polar one last", "Sequence[float | str]"

    def read(self, value: object, where: Where) -> list[Any]:
        """Convert three principal moments of inertia to kg m2; refuse any other number of them."""
        if not isinstance(value, (list, tuple)) or len(value) != 3:
            raise where.error(value, "give three moments")
        return [quantity(moment, "kg m2", where, "8.03e37 kg m2") for moment in value]


@dataclass(frozen=True)
class Codes:
    """Converter of the NAIF codes of a body: integers that identify the body in kernels."""

    words, hint = "whole numbers, like [499, 4]", "Sequence[int]"

    def read(self, value: object, where: Where) -> tuple[int, ...]:
        """Return the NAIF codes as a tuple; refuse anything but integers."""
        if not isinstance(value, (list, tuple)) or not all(type(code) is int for code in value):
            raise where.error(value, "give a list of whole numbers, like [499, 4]")
        return tuple(value)

    def write(self, value: tuple[int, ...]) -> Plain:
        """Return the NAIF codes as a list, which is the form stored in scene files."""
        return list(value)


@dataclass(frozen=True)
class Uncertainties:
    """Converter of a table of relative standard deviations of the fields of a body."""

    words, hint = "standard deviation divided by value, by field", "Mapping[str, float]"

    def read(self, value: object, where: Where) -> dict[str, float]:
        """Check a table of relative standard deviations, and return it by field name.

        The body checks the field names.
        """
        if not isinstance(value, Mapping):
            raise where.error(value, "give a table of one number for each field")

        return {name: quantity(u, "", where.at(name), "1e-4") for name, u in value.items()}

    def write(self, value: Mapping[str, float]) -> Plain:
        """Return the relative standard deviations as a table by field name, for scene files."""
        return dict(value)


@dataclass(frozen=True)
class OneOf:
    """Converter of a field whose value must be one of several allowed words.

    Attributes
    ----------
    allowed : tuple of str
    """

    allowed: tuple[str, ...]

    hint = "str"

    @property
    def words(self) -> str:
        """The allowed words as text, for error messages."""
        return " or ".join(f'"{word}"' for word in self.allowed)

    def read(self, value: object, where: Where) -> str:
        """Return the given word unchanged; refuse a word that is not allowed."""
        if not isinstance(value, str) or value not in self.allowed:
            raise where.error(value, nearest(value, self.allowed))
        return value

    def write(self, value: str) -> Plain:
        """Return the word unchanged, because scene files store it as text."""
        return value


@dataclass(frozen=True)
class CitedPeriod:
    """Converter of a period in days, with its uncertainty and source, such as a wobble period."""

    words, hint = (
        "a table of value, unit, uncertainty and source",
        "Mapping[str, object] | Constant",
    )

    def read(self, value: object, where: Where) -> Constant:
        """Read a period in days from a `Constant`, or from a table of its fields."""
        if isinstance(value, Constant):
            return value

        try:
            table: dict[str, Any] = {"uncertainty": None} | dict(value)  # type: ignore[call-overload]
            for name in ("value", "uncertainty"):
                if table[name] is not None:
                    table[name] = quantity(table[name], "", where.at(name), "433.0")
            if table.get("unit") != "d" or not table["value"] > 0:
                raise where.error(value, "a period in days, unit = 'd', greater than zero")
            return Constant(**table)
        except (KeyError, TypeError, ValueError) as error:
            if isinstance(error, EarthspinError):
                raise
            names = ", ".join(field.name for field in fields(Constant))
            raise where.error(value, f"give a table of {names}") from None

    def write(self, value: Constant) -> Plain:
        """Convert the `Constant` to a table of all fields that are set, for scene files."""
        return {name: entry for name, entry in asdict(value).items() if entry not in (None, "")}


class OwnPlace:
    """Converter of the source of a body's position: a Skyfield function or kernel segments."""

    words = "a vector function of Skyfield's, or segments like {kernel, centre, target}"
    hint = "VectorFunction | Trajectory | Mapping[str, Any]"

    read = staticmethod(read_position)
    write = staticmethod(write_position)


def _labelled(table: Mapping[str, Any], where: Where) -> Any:
    """Restore an array with named dimensions from a table made by `Magnitude.write`.

    Raises
    ------
    SceneError
        If its dimensions or labels do not fit.
    """
    import xarray as xr

    values = unpack(table, where)
    try:
        labels = {}
        for name, label in table.get("labels", {}).items():
            floats = "float64" in label
            content = (
                unpack(label, where) if floats else np.asarray(label["values"], label["dtype"])
            )
            labels[name] = (label["dims"], content)
        return xr.DataArray(values, labels, table["dims"])
    except (KeyError, TypeError, ValueError, AttributeError, xr.CoordinateValidationError):
        raise where.error("a table", "give an array with its dims and labels") from None


def _labels_of(array: Any) -> dict[str, Any]:
    """Convert the coordinate labels of an array to tables, with their dimensions and types."""
    tables: dict[str, Any] = {}
    for name, label in array.coords.items():
        floats = label.dtype.kind == "f" and label.size
        dates = label.dtype.kind == "M"
        tables[str(name)] = {"dims": list(map(str, label.dims)), "dtype": str(label.dtype)} | (
            pack(label.values)
            if floats
            else {"values": (label.values.astype(str) if dates else label.values).tolist()}
        )
    return tables

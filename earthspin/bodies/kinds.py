"""How the fields of a body are read from text, tables and Quantities, and written back exactly."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from typing import Any

import numpy as np

from earthspin.constants import Constant
from earthspin.errors import EarthspinError, Where, nearest
from earthspin.sky.sources import read_position, write_position
from earthspin.units import pack, quantity, unpack

#: What a scene file can hold. The border itself is loaded when there is something to read.
Plain = Any


@dataclass(frozen=True)
class Magnitude:
    """A number with a unit, or an array of numbers with named dimensions.

    Attributes
    ----------
    unit : str
        In which it is kept.
    text : str
        An example: number and unit.
    ratio : str
        Of a pure number: what is divided by what.
    """

    unit: str
    text: str
    ratio: str = "..."

    words, hint = "a number with its unit", "float | str | Quantity | DataArray"

    @property
    def form(self) -> str:
        """How one would write it in a scene, whatever the body."""
        return f'"... {self.text.partition(" ")[2]}"' if self.unit else self.ratio

    def read(self, value: object, where: Where) -> Any:
        """Read text, a number in SI units, a Quantity, a labelled array, or what `write` wrote."""
        if isinstance(value, Mapping):
            return _labelled(value, where)

        return quantity(value, self.unit, where, self.text)

    def write(self, value: Any) -> Plain:
        """Give a number with its unit; an array as a table of its bytes, dims and labels."""
        if hasattr(value, "dims"):
            table = pack(value.values) | {"dims": list(map(str, value.dims))}
            return table | {"labels": _labels_of(value)}
        return f"{float(value)!r} {self.unit}" if self.unit else value


@dataclass(frozen=True)
class Moments:
    """Three principal moments, the polar one last."""

    words, hint = "three moments, the polar one last", "Sequence[float | str]"

    def read(self, value: object, where: Where) -> list[Any]:
        """Read each."""
        if not isinstance(value, (list, tuple)) or len(value) != 3:
            raise where.error(value, "give three moments")
        return [quantity(moment, "kg m2", where, "8.03e37 kg m2") for moment in value]


@dataclass(frozen=True)
class Codes:
    """Codes by which kernels know a body."""

    words, hint = "whole numbers, like [499, 4]", "Sequence[int]"

    def read(self, value: object, where: Where) -> tuple[int, ...]:
        """Check that they are whole numbers."""
        if not isinstance(value, (list, tuple)) or not all(type(code) is int for code in value):
            raise where.error(value, "give a list of whole numbers, like [499, 4]")
        return tuple(value)

    def write(self, value: tuple[int, ...]) -> Plain:
        """Give the list."""
        return list(value)


@dataclass(frozen=True)
class Uncertainties:
    """One standard deviation over value, by field."""

    words, hint = "one standard deviation over value, by field", "Mapping[str, float]"

    def read(self, value: object, where: Where) -> dict[str, float]:
        """Read each; the body knows which names it has."""
        if not isinstance(value, Mapping):
            raise where.error(value, "give a table of one number for each field")

        return {name: quantity(u, "", where.at(name), "1e-4") for name, u in value.items()}

    def write(self, value: Mapping[str, float]) -> Plain:
        """Give the table."""
        return dict(value)


@dataclass(frozen=True)
class OneOf:
    """One of a few words.

    Attributes
    ----------
    allowed : tuple of str
    """

    allowed: tuple[str, ...]

    hint = "str"

    @property
    def words(self) -> str:
        """What may be given."""
        return " or ".join(f'"{word}"' for word in self.allowed)

    def read(self, value: object, where: Where) -> str:
        """Check."""
        if not isinstance(value, str) or value not in self.allowed:
            raise where.error(value, nearest(value, self.allowed))
        return value

    def write(self, value: str) -> Plain:
        """Give the word."""
        return value


@dataclass(frozen=True)
class CitedPeriod:
    """A period in days with its uncertainty and source."""

    words, hint = (
        "a table of value, unit, uncertainty and source",
        "Mapping[str, object] | Constant",
    )

    def read(self, value: object, where: Where) -> Constant:
        """Take a constant, or a table of its fields."""
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
        """Give the table of what is known."""
        return {name: entry for name, entry in asdict(value).items() if entry not in (None, "")}


class OwnPlace:
    """What gives the place of a body, where a kernel does not."""

    words = "a vector function of Skyfield's, or segments like {kernel, centre, target}"
    hint = "VectorFunction | Trajectory | Mapping[str, Any]"

    read = staticmethod(read_position)
    write = staticmethod(write_position)


def _labelled(table: Mapping[str, Any], where: Where) -> Any:
    """A labelled array as `Magnitude.write` wrote it.

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
    """Labels of an array, of whatever kind, as tables."""
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

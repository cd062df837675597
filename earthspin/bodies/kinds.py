"""Converters of a body's properties from and to the text and tables of scene files."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, fields
from functools import cache
from itertools import pairwise
from typing import Any, get_type_hints

import numpy as np

from earthspin.constants import Constant
from earthspin.errors import EarthspinError, Where, nearest
from earthspin.interior.layers import Layer, LayeredBody, from_samples
from earthspin.interior.named import INTERIORS
from earthspin.sky.poles import (
    NAMED_POLES,
    Direction,
    FixedPole,
    MovingPole,
    OrbitNormal,
    PoleModel,
    TiltedPole,
)
from earthspin.sky.sources import read_position, write_position
from earthspin.units import TURN, Plain, Text, is_whole, pack, quantity, real_numbers, unpack

# --- numbers, words, codes and positions ----------------------------------------------------------


@dataclass(frozen=True)
class Magnitude:
    """Converter between SI value and scene file, for a number with a unit or a labelled array.

    Attributes
    ----------
    unit : str
        Unit of the stored value.
    text : str
        Example of a number with its unit.
    ratio : str
        Definition of a dimensionless number as a quotient.
    polar : bool
        Whether the number is an angle from 0 to 180 deg, from which whole turns are not removed.
    """

    unit: str
    text: str
    ratio: str = "..."
    polar: bool = False

    words, hint = "a number with its unit", "float | str | Quantity | DataArray"

    @property
    def form(self) -> str:
        """Pattern of the value in a scene file: text with a unit, or a quotient."""
        return f'"... {self.text.partition(" ")[2]}"' if self.unit else self.ratio

    def read(self, value: object, where: Where) -> Any:
        """Convert text, a number, a Quantity, an array or a table made by `write` to SI units."""
        if isinstance(value, Mapping):
            return _labelled(value, where)
        number = quantity(value, self.unit, where, self.text)
        if self.unit == "rad" and not self.polar and np.ndim(number) == 0 and abs(number) > TURN:
            return math.fmod(number, TURN)  # plain angles, as it is then, are within a turn
        return number

    def write(self, value: Any) -> Plain:
        """Convert the value for a scene file: a number with its unit, or an array as a table."""
        if hasattr(value, "dims"):
            table = pack(value.values) | {"dims": list(map(str, value.dims))}
            return table | {"labels": _labels_of(value)}
        return f"{float(value)!r} {self.unit}" if self.unit else value


#: An angle of a direction, and an obliquity.
ANGLE, OBLIQUITY = Magnitude("rad", "317.7 deg"), Magnitude("rad", "40 deg", polar=True)


@dataclass(frozen=True)
class PoleInText:
    """Converter of a pole: two angles, a name, or a table of an obliquity or of a moving pole.

    Attributes
    ----------
    of : callable
        Function that makes the direction from a name, a pole, or two angles in radians.
    """

    of: Callable[[Any], Any]

    words, hint = "right ascension and declination", "tuple[float | str, float | str]"
    form = '["... deg", "... deg"]'

    def read(self, value: object, where: Where) -> Any:
        """Read the pole of a body: two angles (rad by default), a name, or a table."""
        if isinstance(value, Mapping) and "obliquity" in value:
            where.refuse_unknown(value, ("obliquity", "equinox_of"))
            obliquity = OBLIQUITY.read(value["obliquity"], where.at("obliquity"))
            equinox_of = self.read(value["equinox_of"], where) if "equinox_of" in value else None
            return TiltedPole.at(obliquity, equinox_of)
        if isinstance(value, Mapping):
            return MovingPole.read(value, where)
        if isinstance(value, (list, tuple)) and not isinstance(value, (FixedPole, OrbitNormal)):
            value = tuple(ANGLE.read(angle, where) for angle in value)
            if any(map(np.ndim, value)):
                raise where.error("an array", f"give one direction: {self.words}")
        try:
            return self.of(value)
        except (ValueError, TypeError):
            given = "an array" if getattr(value, "ndim", 0) else value
            names = " or ".join(f"'{word}'" for word in NAMED_POLES)
            allowed = f"write {names} or {self.words}, -90 to 90 deg, in rad"
            raise where.error(given, f"give one direction: {allowed}") from None

    def write(self, value: Direction | PoleModel) -> Plain:
        """Convert a pole for scene files: to a name, two angles, or a table."""
        if isinstance(value, MovingPole):
            return value.write()
        if isinstance(value, TiltedPole):
            table = {"obliquity": OBLIQUITY.write(value.obliquity)}
            return table | {"equinox_of": self.write(value.equinox_of)}
        if isinstance(value, Direction):
            return [ANGLE.write(angle) for angle in value]
        return str(value)


class ThreeMoments:
    """Converter of three principal moments of inertia, the polar one last, to kg m2."""

    words, hint = "three moments, the polar one last", "Sequence[float | str]"

    def read(self, value: object, where: Where) -> list[Any]:
        """Convert three principal moments of inertia to kg m2; refuse any other number of them."""
        if not isinstance(value, (list, tuple)) or len(value) != 3:
            raise where.error(value, "give three moments")
        return [quantity(moment, "kg m2", where, "8.03e37 kg m2") for moment in value]


class Codes:
    """Converter of NAIF codes, the integers that identify a body in ephemeris kernels."""

    words, hint = "whole numbers, like [499, 4]", "Sequence[int]"

    def read(self, value: object, where: Where) -> tuple[int, ...]:
        """Return the NAIF codes as a tuple; refuse anything but integers."""
        if not isinstance(value, (list, tuple)) or not all(map(is_whole, value)):
            raise where.error(value, "give a list of whole numbers, like [499, 4]")
        return tuple(map(int, value))

    def write(self, value: tuple[int, ...]) -> Plain:
        """Return the NAIF codes as a list, which is the form stored in scene files."""
        return list(value)


class NumberTable:
    """Converter of a table of plain numbers by name; the body checks the names."""

    words, hint = "a table of one number for each name", "Mapping[str, float]"

    def read(self, value: object, where: Where) -> dict[str, float]:
        """Check a table of numbers, such as relative standard deviations by field."""
        if not isinstance(value, Mapping):
            raise where.error(value, f"give {self.words}")
        return {
            name: quantity(number, "", where.at(name), "1e-4") for name, number in value.items()
        }

    def write(self, value: Mapping[str, float]) -> Plain:
        """Return the numbers as a table by name, for scene files."""
        return dict(value)


class StokesCoefficients(NumberTable):
    """Converter of a table of unnormalised Stokes coefficients by name, such as "c31"."""

    words = 'a table of Stokes coefficients by name, like {"c31": 2.8e-5}'

    def read(self, value: object, where: Where) -> dict[str, float]:
        """Check the names, of degree 3 to 9 and order up to the degree, and the numbers."""
        coefficients = super().read(value, where)
        for name in coefficients:
            match = re.fullmatch(r"c([3-9])(\d)|s([3-9])([1-9])", str(name))
            degree, order = (match[1] or match[3], match[2] or match[4]) if match else (0, 1)
            if int(order) > int(degree):
                problem = "names are c30 to s99: degree 3 to 9, and an order up to the degree"
                raise where.error(name, problem)
        return coefficients


class CitedPeriod:
    """Converter between a table and a `Constant`, for a period in days such as a wobble period."""

    words = "a table of value, unit, uncertainty and source"
    hint = "Mapping[str, object] | Constant"

    def read(self, value: object, where: Where) -> Constant:
        """Convert a table to a `Constant`, a period in days; return a `Constant` unchanged."""
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


@cache
def kinds_of(record: type) -> dict[str, Any]:
    """Return the converters in the type annotations of a class, by name of the annotated field."""
    hints = get_type_hints(record, include_extras=True)
    annotated = {name: hint for name, hint in hints.items() if hasattr(hint, "__metadata__")}
    return {name: hint.__metadata__[0] for name, hint in annotated.items()}


class PositionConverter:
    """Converter of the input `position`: a Skyfield function, `Trajectory` or kernel segments."""

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
        values = label.values.astype(str) if label.dtype.kind == "M" else label.values
        content = pack(values) if floats else {"values": values.tolist()}
        dims = list(map(str, label.dims))
        tables[str(name)] = {"dims": dims, "dtype": str(label.dtype)} | content
    return tables


# --- interiors ------------------------------------------------------------------------------------

#: Columns of samples with their units.
COLUMNS = {"radius": "m", "density": "kg/m3", "vp": "m/s", "vs": "m/s", "shear_q": ""}


class Layers:
    """Converter of the layers of a body, from a name or a table to a `LayeredBody`."""

    words = (
        'the name of an interior with layers, like "prem", or a table: name, and either layers '
        "(top, density, vp, vs, shear_q; polynomials of the radius over that of the surface) or "
        "samples (radius, density, vp, vs, shear_q)"
    )
    hint = "str | LayeredBody | Mapping[str, Any]"
    by_name = True

    def read(self, value: object, where: Where) -> LayeredBody:
        """Return a `LayeredBody` from a name, a layered body, or a table."""
        if isinstance(value, LayeredBody):
            return value
        if isinstance(value, str):
            named = {name: i.layers for name, i in INTERIORS.items() if i.layers is not None}
            if value not in named:
                raise where.error(value, nearest(value, named))
            return named[value]
        if not isinstance(value, Mapping):
            raise where.error(value, f"give {self.words}")
        if ("layers" in value) == ("samples" in value):
            raise where.error("a table", "give either layers or samples")
        name, reference = str(value.get("name", "layers")), str(value.get("reference", ""))
        where = Where(where.key, where.source)  # columns and coefficients are in SI units
        if "samples" in value:
            return _sampled(value["samples"], name, reference, where.at("samples"))
        layers = tuple(
            _layer(table, where.at(f"layers[{number}]"))
            for number, table in enumerate(value["layers"])
        )
        tops = [layer.top for layer in layers]
        if not tops or any(top <= below for below, top in pairwise([0.0, *tops])):
            raise where.error(tops, "list layers from the centre outwards, with increasing tops")
        return LayeredBody(name, layers, reference)

    def write(self, value: LayeredBody) -> dict[str, Any]:
        """Convert a layered body to a table (name, cited source, layers) for scene files."""
        return {
            "name": value.name,
            "reference": value.reference,
            "layers": [
                {
                    "top": f"{layer.top!r} m",
                    "density": list(layer.density),
                    "vp": list(layer.vp),
                    **({"vs": list(layer.vs)} if layer.vs else {}),
                    **({"shear_q": layer.shear_q} if math.isfinite(layer.shear_q) else {}),
                }
                for layer in value.layers
            ],
        }


def _layer(table: Any, where: Where) -> Layer:
    """Make one layer of a body from a table; one number means a constant within the layer."""
    if not isinstance(table, Mapping) or not {"top", "density", "vp"} <= set(table):
        raise where.error(table, "give top, density, vp, and vs and shear_q if it is solid")
    if unknown := set(table) - {"top", "density", "vp", "vs", "shear_q"}:
        raise where.error(min(unknown), "a layer has top, density, vp, vs and shear_q")

    def series(name: str, unit: str) -> tuple[float, ...]:
        values = table.get(name, ())
        elements = values if isinstance(values, (list, tuple)) else (values,)
        return tuple(float(quantity(v, unit, where.at(name), "1 " + unit)) for v in elements)

    vs = series("vs", "m/s")
    vs = vs if any(vs) else ()
    return Layer(
        top=float(quantity(table["top"], "m", where.at("top"), "3480 km")),
        density=series("density", "kg/m3"),
        vp=series("vp", "m/s"),
        vs=vs,
        shear_q=series("shear_q", "")[0] if vs and "shear_q" in table else math.inf,
    )


def _sampled(table: Any, name: str, reference: str, where: Where) -> LayeredBody:
    """Make a layered body from a table of samples along the radius, with the columns `COLUMNS`."""
    try:
        columns = {
            column: real_numbers(table[column]).tolist()
            for column in COLUMNS
            if column != "shear_q" or column in table
        }
        columns.setdefault("shear_q", [math.inf] * len(columns["radius"]))
        return from_samples(name, **columns, reference=reference)
    except (KeyError, TypeError, ValueError) as error:
        units = ", ".join(f"{column} ({unit or 'a number'})" for column, unit in COLUMNS.items())
        problem = f"give columns of one length, outwards: {units}; {error}"
        raise where.error("a table", problem) from None


class InteriorConverter(Layers):
    """Converter of the input `interior` of a body: a name, a `LayeredBody` or its table."""

    words = Layers.words.replace("the name of an interior with layers", "a name")
    by_name = False

    def read(self, value: object, where: Where) -> Any:
        """Return a name unchanged, or make a `LayeredBody` from a layered body or its table."""
        return Text().read(value, where) if isinstance(value, str) else super().read(value, where)

    def write(self, value: str | LayeredBody) -> Any:
        """Return the name of the interior, or a layered body as a table, for scene files."""
        return value if isinstance(value, str) else super().write(value)

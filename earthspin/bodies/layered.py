"""Classes that convert a body's interior from a name, or a table of layers or samples, and back."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import pairwise
from typing import Any

from earthspin.errors import Where, nearest
from earthspin.interior.layers import Layer, LayeredBody
from earthspin.interior.named import INTERIORS
from earthspin.interior.samples import from_samples
from earthspin.units import Text, quantity, real_numbers

#: Columns of samples with their units.
COLUMNS = {"radius": "m", "density": "kg/m3", "vp": "m/s", "vs": "m/s", "shear_q": ""}


class Layers:
    """Converter of a field that holds a `LayeredBody`, from a name or a table."""

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
    """Make one layer of a body from a table; a single number means a value constant with radius."""
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
    """Read a layered body from samples along its radius: a table with the columns `COLUMNS`."""
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


class UnderTheSurface:
    """Converter of the interior of a body: either a name or a `LayeredBody`."""

    words = (
        'a name, like "prem", or a table: name, and either layers (top, density, vp, vs, '
        "shear_q) or samples (radius, density, vp, vs, shear_q)"
    )
    hint = Layers.hint

    def read(self, value: object, where: Where) -> str | LayeredBody:
        """Return a name unchanged, or make a `LayeredBody` from a layered body or its table."""
        if isinstance(value, (LayeredBody, Mapping)):
            return Layers().read(value, where)
        if not isinstance(value, str):
            raise where.error(value, f"give {self.words}")
        return Text().read(value, where)

    def write(self, value: str | LayeredBody) -> str | dict[str, Any]:
        """Return the name of the interior, or a layered body as a table, for scene files."""
        return value if isinstance(value, str) else Layers().write(value)

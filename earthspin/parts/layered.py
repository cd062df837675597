"""How a layered body is given: by name, as a table of layers or samples, or as itself."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np

from earthspin.errors import Where, nearest
from earthspin.interior.layers import Layer, LayeredBody, from_samples
from earthspin.interior.named import INTERIORS
from earthspin.units import Plain, quantity

#: Columns of samples with their units.
COLUMNS = {"radius": "m", "density": "kg/m3", "vp": "m/s", "vs": "m/s", "shear_q": ""}


class Layers:
    """Kind of a layered body."""

    words = (
        'the name of an interior with layers, like "prem", or a table: name, and either layers '
        "(top, density, vp, vs, shear_q; polynomials of the radius over that of the surface) or "
        "samples (radius, density, vp, vs, shear_q)"
    )
    hint = "str | LayeredBody | Mapping[str, Any]"

    def read(self, given: object, where: Where) -> LayeredBody:
        """Read a name, a layered body, or a table."""
        if isinstance(given, LayeredBody):
            return given
        named = {name: i.layers for name, i in INTERIORS.items() if i.layers is not None}
        if isinstance(given, str):
            if given not in named:
                raise where.error(given, nearest(given, named))
            return named[given]
        if not isinstance(given, Mapping):
            raise where.error(given, f"give {self.words}")
        if ("layers" in given) == ("samples" in given):
            raise where.error("a table", "give either layers or samples")
        name, reference = str(given.get("name", "layers")), str(given.get("reference", ""))
        if "samples" in given:
            return _sampled(given["samples"], name, reference, where.at("samples"))
        layers = tuple(
            _layer(one, where.at(f"layers[{number}]")) for number, one in enumerate(given["layers"])
        )
        tops = [layer.top for layer in layers]
        if not tops or np.any(np.diff([0.0, *tops]) <= 0):
            raise where.error(tops, "the tops of layers grow from the centre outwards")
        return LayeredBody(name, layers, reference)

    def write(self, value: LayeredBody) -> Plain:
        """Give the table of layers."""
        return {
            "name": value.name,
            "reference": value.reference,
            "layers": [
                {
                    "top": f"{layer.top!r} m",
                    "density": list(layer.density),
                    "vp": list(layer.vp),
                    **({"vs": list(layer.vs), "shear_q": layer.shear_q} if layer.vs else {}),
                }
                for layer in value.layers
            ],
        }


def _layer(given: Any, where: Where) -> Layer:
    """One layer of a table; a number stands for an even layer."""
    if not isinstance(given, Mapping) or not {"top", "density", "vp"} <= set(given):
        raise where.error(given, "give top, density, vp, and vs and shear_q if it is solid")
    if unknown := set(given) - {"top", "density", "vp", "vs", "shear_q"}:
        raise where.error(min(unknown), "a layer has top, density, vp, vs and shear_q")

    def series(name: str, unit: str) -> tuple[float, ...]:
        values = given.get(name, ())
        several = values if isinstance(values, (list, tuple)) else (values,)
        return tuple(float(quantity(v, unit, where.at(name), "1 " + unit)) for v in several)

    vs = series("vs", "m/s")
    vs = vs if any(vs) else ()
    return Layer(
        top=float(quantity(given["top"], "m", where.at("top"), "3480 km")),
        density=series("density", "kg/m3"),
        vp=series("vp", "m/s"),
        vs=vs,
        shear_q=series("shear_q", "")[0] if vs and "shear_q" in given else np.inf,
    )


def _sampled(given: Any, name: str, reference: str, where: Where) -> LayeredBody:
    """Samples as a table of columns, or anything with columns of these names."""
    try:
        columns = {
            column: [float(v) for v in np.asarray(given[column], dtype=float)]
            for column in COLUMNS
            if column != "shear_q" or column in given
        }
        columns.setdefault("shear_q", [np.inf] * len(columns["radius"]))
        return from_samples(name, **columns, reference=reference)
    except (KeyError, TypeError, ValueError) as error:
        units = ", ".join(f"{column} ({unit or 'a number'})" for column, unit in COLUMNS.items())
        raise where.error(
            "a table", f"give columns of one length, outwards: {units}; {error}"
        ) from None


#: A layered body, however given.
LayeredInterior = Annotated[LayeredBody, Layers()]

"""Datasets: what each variable is called, measured in, and laid out along.

Values in SI become labelled arrays here, in the units of a schema and with the attributes that the
CF conventions ask for. Plain floats only: a Quantity would lose its unit on disk.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from earthspin.constants import ARCSEC, ARCSEC_PER_YEAR, DAY, JULIAN_YEAR, MAS
from earthspin.errors import SceneError, UndefinedError, nearest

if TYPE_CHECKING:
    import xarray as xr

CONVENTIONS = "CF-1.11"

#: Units that are SI themselves; "1" for pure numbers, "" for words and dates.
_SI = (
    "", "1", "m", "s", "J", "rad", "N m", "kg m2", "kg m2 / s", "rad/s", "rad2 / s2", "1/s",
    "m/s2", "J/kg",
)  # fmt: skip

#: Factor from SI to each unit that results are shown in.
FROM_SI: dict[str, float] = {
    "arcsec/yr": 1 / ARCSEC_PER_YEAR,
    "arcsec": 1 / ARCSEC,
    "mas": 1 / MAS,
    "deg": 180 / math.pi,
    "uas": 1e6 / ARCSEC,
    "d": 1 / DAY,
    "yr": 1 / JULIAN_YEAR,
    **dict.fromkeys(_SI, 1.0),
}


#: Spelling in files of units that people read otherwise: UDUNITS and astropy read it as the same
#: number. UDUNITS takes `a` for are, and its `yr` is 2e-5 shorter than the Julian year.
IN_FILES: dict[str, str] = {
    "arcsec/yr": f"{1 / JULIAN_YEAR!r} arcsec s-1",
    "yr": "365.25 d",
    "deg": "degree",
    "mas": "marcsec",
    "uas": "uarcsec",
    "kg m2 / s": "kg m2 s-1",
    "rad/s": "rad s-1",
    "rad2 / s2": "rad2 s-2",
    "1/s": "s-1",
    "m/s2": "m s-2",
    "J/kg": "J kg-1",
}


def from_si(unit: str) -> float:
    """Factor from SI to a unit.

    Raises
    ------
    SceneError
        For a unit that no result is shown in; it is never taken for SI.
    """
    if unit not in FROM_SI:
        raise SceneError("units", unit, nearest(unit, [u for u in FROM_SI if u]))
    return FROM_SI[unit]


@dataclass(frozen=True)
class Variable:
    """What a variable of a result is.

    Attributes
    ----------
    dims : tuple of str
        Its dimensions; a body with labelled arrays adds theirs.
    units : str
        As astropy.units parses it; "1" for pure numbers, "" for words and dates.
    long_name : str
        In plain words.
    attrs : tuple of pairs
        Further attributes, such as cell_methods or references.
    error : str
        Names of the variables that hold its error, where they are not called after it.
    no_error : str
        Why it carries no error.
    short : str
        Label of tables and axes.
    """

    dims: tuple[str, ...]
    units: str
    long_name: str
    attrs: tuple[tuple[str, str], ...] = ()
    error: str = ""
    no_error: str = ""
    short: str = ""


Schema = Mapping[str, Variable]


class SchemaError(Exception):
    """A part gave something else than it declares: a defect of the program, not of the input."""


def build(
    schema: Schema,
    values: Mapping[str, Any],
    coords: Mapping[str, Any] | None = None,
    no_error: str = "",
) -> xr.Dataset:
    """Label the values that a part gave.

    Parameters
    ----------
    schema : Schema
        What it declares.
    values : mapping
        Arrays or labelled arrays by variable name, in SI units; plain arrays are laid along
        the declared dimensions.
    coords : mapping, optional
        Labels by dimension.
    no_error : str
        Why errors are not given where they are NaN; empty if all are given.

    Raises
    ------
    SchemaError
        If the variables are not the declared ones, or lack a declared dimension.
    UndefinedError
        If a number is missing.
    """
    import numpy as np
    import xarray as xr

    if set(values) != set(schema):
        raise SchemaError(f"a part gave {sorted(values)}, declares {sorted(schema)}")
    arrays: dict[str, xr.Variable] = {}
    labels: dict[Any, Any] = dict(coords or {})
    for name, declared in schema.items():
        value = values[name]
        if isinstance(value, xr.DataArray):
            for dim, own in value.coords.items():
                known = labels.setdefault(dim, own.variable)
                if hasattr(known, "equals") and not known.equals(own.variable):
                    raise SchemaError(f"labels along '{dim}' differ from one variable to the next")
            value = value.variable
        else:
            value = xr.Variable(declared.dims, value)
        if not set(declared.dims) <= set(value.dims):
            raise SchemaError(f"{name} has {value.dims}, declares {declared.dims}")
        laid = value.transpose(*declared.dims, ...)
        factor = from_si(declared.units)
        data = laid.values if factor == 1 else np.asarray(laid.values * factor)
        attributes = _attributes(name, declared, schema)
        if data.dtype.kind == "f" and np.isnan(data).any():
            if not (no_error and "_error" in name):
                problem = f"{declared.long_name} has no value here; check the body's numbers"
                raise UndefinedError(problem)
            attributes["no_error"] = no_error
        arrays[name] = xr.Variable(laid.dims, data, attributes)
    return xr.Dataset(arrays, coords=labels)


def si(array: xr.DataArray) -> xr.DataArray:
    """Values of a variable of a result, back in SI units.

    Raises
    ------
    SceneError
        If its units are not among those that results are shown in.
    """
    return array / from_si(array.attrs.get("units", ""))


def _attributes(name: str, variable: Variable, schema: Schema) -> dict[str, str]:
    attributes = {"long_name": variable.long_name}
    if variable.units:
        attributes["units"] = variable.units
    companions = [other for other in schema if other.startswith(f"{name}_error")]
    if companions or variable.error:
        attributes["ancillary_variables"] = variable.error or " ".join(companions)
    if variable.no_error:
        attributes["no_error"] = variable.no_error
    return attributes | dict(variable.attrs)

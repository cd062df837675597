"""Declaration of result variables with units and meaning, and sizes of neglected effects.

A part returns an instance of a class of `Variables` with values in SI units. `dataset` converts
them to the units of the class and adds the attributes of the CF conventions. Values are plain
floats, because a Quantity would lose its unit in a file.
"""

from __future__ import annotations

import math
import re
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from typing import Any, ClassVar, Self

import numpy as np

from earthspin._lazy import xr
from earthspin.constants import ARCSEC, ARCSEC_PER_YEAR, DAY, JULIAN_YEAR, MAS, Constant
from earthspin.errors import SceneError, UndefinedError, nearest
from earthspin.numerics.arrays import Estimate

# --- units ----------------------------------------------------------------------------------------

#: Units that are SI themselves; "1" for pure numbers, "" for text and dates.
_SI = (
    "", "1", "m", "s", "J", "rad", "N m", "kg m2", "kg m2 / s", "rad/s", "rad2 / s2", "1/s",
    "m/s2", "J/kg", "W m-2",
)  # fmt: skip

#: Factor from SI to each unit of results.
FROM_SI: dict[str, float] = {
    "arcsec/yr": 1 / ARCSEC_PER_YEAR,
    "mas/cy": 1e5 / ARCSEC_PER_YEAR,
    "arcsec": 1 / ARCSEC,
    "mas": 1 / MAS,
    "deg": 180 / math.pi,
    "uas": 1e6 / ARCSEC,
    "ms": 1e3,
    "d": 1 / DAY,
    "yr": 1 / JULIAN_YEAR,
    "GJ m-2": 1e-9,
    **dict.fromkeys(_SI, 1.0),
}


#: Spelling of units in files, which UDUNITS and astropy read as the same number. UDUNITS reads `a`
#: as the are, and its `yr` is 2e-5 shorter than the Julian year.
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


#: Spelling of units in answers, by that in files.
IN_ANSWERS = {spelled: unit for unit, spelled in IN_FILES.items()}


def from_si(unit: str) -> float:
    """Return the factor that converts a value from SI to a given unit of answers or of files.

    Raises
    ------
    SceneError
        If the unit is not among those of results.
    """
    unit = IN_ANSWERS.get(unit, unit)
    if unit not in FROM_SI:
        raise SceneError("units", unit, nearest(unit, [u for u in FROM_SI if u]))
    return FROM_SI[unit]


def si(array: xr.DataArray) -> xr.DataArray:
    """Convert a variable of a result from its unit to SI.

    Raises
    ------
    SceneError
        If its unit is not among those of results.
    """
    return array / from_si(array.attrs.get("units", ""))


#: Attributes of a variable in a file: units in the spelling of files, and of earthspin.
UNITS, SHOWN = "units", "units_shown"


def spelled(node: xr.Dataset) -> xr.Dataset:
    """Return a copy with units spelled as in files; `units_shown` holds the original spelling."""
    node = node.copy()
    for name, variable in node.variables.items():
        unit = variable.attrs.get(UNITS)
        if unit in IN_FILES:
            node[name].attrs = variable.attrs | {UNITS: IN_FILES[unit], SHOWN: unit}
    return node


def with_units_of_answers(data: xr.Dataset) -> xr.Dataset:
    """Return a copy of data, of a file or not, with units spelled as in answers."""
    data = data.copy()
    for variable in data.variables.values():
        own = IN_ANSWERS.get(str(variable.attrs.get(UNITS)), "")
        if unit := variable.attrs.pop(SHOWN, own):
            variable.attrs[UNITS] = unit
    return data


# --- declarations ---------------------------------------------------------------------------------

#: Attribute of a variable that says where its values are NaN.
MISSING = "missing_where"
#: Suffixes of the names of a field's variables, with patterns of their long names, in order.
_ERROR = {"": "{}", "_error": "95 % half-width of the {}"}
_SHARES = {
    "_error_method": "95 % half-width of the {} from averaging and sampling",
    "_error_input": "95 % half-width of the {} from the uncertainties of the inputs",
}


@dataclass(frozen=True)
class Variable:
    """Declaration of one variable of a result, or of several, such as a value and its error.

    Attributes
    ----------
    units : str
        Unit as astropy.units parses it; "1" for pure numbers, "" for text and dates.
    long_name : str
        Meaning in plain words.
    along : tuple of str or None
        Dimensions; those of the class if None.
    error : str
        Names of the variables that hold the error, if not ``<name>_error``.
    no_error : str
        Why there is no error.
    short : str
        Label of tables and axes.
    shown : str
        Unit of tables and axes, if not that of the numbers.
    default : object
        Default value; ``...`` if a value is required. A field whose value is None is omitted from
        the answer.
    endings : mapping of str to str
        Suffixes of the names of a field's variables, with patterns of their long names; empty for
        labels.
    attrs : mapping of str to str
        Further attributes, such as cell_methods or references.
    dims : tuple of str
        Dimensions in an answer; the labelled arrays of a body add further ones.
    """

    units: str
    long_name: str = ""
    along: tuple[str, ...] | None = None
    error: str = ""
    no_error: str = ""
    short: str = ""
    shown: str = ""
    default: Any = ...
    endings: Mapping[str, str] = field(default_factory=dict)
    attrs: Mapping[str, str] = field(default_factory=dict)
    dims: tuple[str, ...] = ()

    def attributes(self, name: str, others: Iterable[str]) -> dict[str, Any]:
        """Attributes of this variable: unit, meaning, and the names of its error variables."""
        errors = self.error or " ".join(n for n in others if n.startswith(f"{name}_error"))
        attributes = {"long_name": self.long_name, "units": self.units}
        attributes |= {"ancillary_variables": errors, "no_error": self.no_error}
        return {key: text for key, text in attributes.items() if text} | dict(self.attrs)


class SchemaError(Exception):
    """Error raised if returned variables differ from the declared ones (a program defect)."""


#: Options of a field; others are attributes of its variables.
_OPTIONS = {"along", "error", "no_error", "short", "shown", "default"}


def _field(endings: Mapping[str, str], units: str, long_name: str, options: dict[str, Any]) -> Any:
    attrs = {name: options.pop(name) for name in [*options] if name not in _OPTIONS}
    return Variable(units, long_name, endings=endings, attrs=attrs, **options)


def number(units: str, long_name: str, **options: Any) -> Any:
    """Declare a field of a `Variables` class that holds numbers.

    Parameters
    ----------
    units : str
        Unit of the result; "1" for pure numbers. Parts return values in SI units.
    long_name : str
        Meaning in plain words.
    along : tuple of str, optional
        Dimensions; those of the class by default.
    error : str
        Names of the variables that hold the error, if not ``<name>_error``.
    no_error : str
        Why there is no error.
    short : str
        Label of tables and axes.
    shown : str
        Unit of tables and axes, if not `units`.
    default : object
        ``None`` if an answer may omit the number.
    **options
        Further attributes, such as cell_methods.
    """
    return _field({"": "{}"}, units, long_name, options)


def measured(units: str, long_name: str, *, split: bool = False, **options: Any) -> Any:
    """Declare a number together with its 95 % half-width, the variable ``<name>_error``.

    The value is a pair of number and half-width, or an `Estimate`.

    Parameters
    ----------
    units, long_name, **options
        See `number`.
    split : bool
        Also declare the contributions of the method and of the inputs to the half-width.
    """
    return _field(_ERROR | _SHARES if split else _ERROR, units, long_name, options)


def amplitude(units: str, long_name: str, **options: Any) -> Any:
    """Declare a pair of variables: in-phase and out-of-phase amplitudes, as in IERS tables."""
    phases = {"_in_phase": "{}, in phase", "_out_of_phase": "{}, out of phase"}
    return _field(phases, units, long_name, options)


def words(long_name: str, **options: Any) -> Any:
    """Declare a field of a `Variables` class that holds text or dates, which have no unit."""
    return number("", long_name, **options)


def labels(long_name: str = "", units: str = "", **options: Any) -> Any:
    """Declare a field that holds the coordinate labels of the dimension of the same name.

    Parameters
    ----------
    long_name : str
    units : str
        Unit of the labels; they are not converted.
    default : object
        The labels, if they are always the same.
    **options
        Further attributes.
    """
    return _field({}, units, long_name, options)


class Variables:
    """Base class for the set of variables that one part (function) adds to a result.

    Options of a subclass apply to all of its fields: `along`, the dimensions; `error`, the variable
    that holds the error of every number without its own; or `no_error`, why these have no error.
    An instance takes the values by name, in SI units: numbers, text, labelled arrays, or arrays
    along the declared dimensions.
    """

    #: Default dimensions of the fields.
    dims: ClassVar[tuple[str, ...]] = ()
    #: The fields by name, with inherited fields first.
    fields: ClassVar[Mapping[str, Variable]] = {}
    #: The variables by name, in the order of an answer.
    schema: ClassVar[Mapping[str, Variable]] = {}

    def __init_subclass__(
        cls, along: tuple[str, ...] | None = None, error: str = "", no_error: str = ""
    ) -> None:
        """Collect the fields that a subclass declares."""
        cls.dims = cls.dims if along is None else along
        own = {name: entry for name, entry in vars(cls).items() if isinstance(entry, Variable)}
        cls.fields, schema = {**cls.fields, **own}, dict(cls.schema)
        for name, entry in own.items():
            dims = cls.dims if entry.along is None else entry.along
            for ending, meaning in entry.endings.items():
                declared = (
                    Variable(entry.units, shown=entry.shown)
                    if ending.startswith("_error")
                    else entry
                )
                long_name = meaning.format(entry.long_name)
                schema[name + ending] = replace(declared, dims=dims, long_name=long_name)
        for name, variable in schema.items():
            has_error = variable.error or variable.no_error or f"{name}_error" in schema
            if variable.units and not has_error and "_error" not in name and name != error:
                schema[name] = replace(variable, error=error, no_error=no_error)
        cls.schema = schema

    def __init__(self, **values: Any) -> None:
        unknown = values.keys() - self.fields.keys()
        missing = {n for n, entry in self.fields.items() if entry.default is ...} - {*values}
        if unknown or missing:
            problem = f"{type(self).__name__}: unknown {sorted(unknown)}, missing {sorted(missing)}"
            raise SchemaError(problem)
        self._values = {n: values.get(n, entry.default) for n, entry in self.fields.items()}
        self._attributes: dict[str, Mapping[str, object]] = {}
        self._no_error = ""

    def with_attributes(self, *, no_error: str = "", **attributes: Mapping[str, object]) -> Self:
        """Add attributes, known only after the computation, to variables of this result.

        Parameters
        ----------
        no_error : str
            Why some errors are NaN; empty if none is.
        **attributes
            Further attributes by the name of the variable.
        """
        self._no_error = no_error or self._no_error
        self._attributes |= attributes
        return self

    def dataset(self) -> xr.Dataset:
        """Convert the values to a Dataset, with the declared units and attributes.

        Raises
        ------
        SchemaError
            If a value lacks a declared dimension.
        UndefinedError
            If a number is missing.
        """
        values, coords = self._by_variable()
        arrays: dict[str, xr.Variable] = {}
        for name, value in values.items():
            declared = self.schema[name]
            if isinstance(value, xr.DataArray):
                for dim, own in value.coords.items():
                    known = coords.setdefault(dim, own.variable)
                    if hasattr(known, "equals") and not known.equals(own.variable):
                        raise SchemaError(f"labels along '{dim}' differ between variables")
                value = value.variable
            else:
                value = variable_of(declared.dims, value)
            if not set(declared.dims) <= set(value.dims):
                raise SchemaError(f"{name} has {value.dims}, declares {declared.dims}")
            laid = value.transpose(*declared.dims, ...)
            factor = from_si(declared.units)
            data = laid.values if factor == 1 else np.asarray(laid.values * factor)
            attributes = declared.attributes(name, values)
            if data.dtype.kind == "f" and np.isnan(data).any():
                base = self.schema.get(name.partition("_error")[0], declared)
                may_lack = base.attrs.get(MISSING)
                if not (may_lack or (self._no_error and "_error" in name)):
                    problem = f"{declared.long_name} is undefined; check the numbers of the body"
                    raise UndefinedError(problem)
                if self._no_error and "_error" in name:
                    attributes["no_error"] = self._no_error
            arrays[name] = variable_of(laid.dims, data, attributes)
        result = xr.Dataset(arrays, coords=coords)
        for name, extra in self._attributes.items():
            result[name].attrs.update(extra)
        return result

    def _by_variable(self) -> tuple[dict[str, Any], dict[Any, Any]]:
        """Values by variable name, and coordinate labels by dimension, as two dicts."""
        values: dict[str, Any] = {}
        coords: dict[Any, Any] = {}
        for name, entry in self.fields.items():
            value = self._values[name]
            if value is None:
                continue
            if len(entry.endings) == 1:
                values[name] = value
            elif entry.endings:
                if isinstance(value, Estimate):
                    shares = (value.value, value.error, value.method, value.given)
                    value = shares[: len(entry.endings)]
                names = (name + ending for ending in entry.endings)
                values |= dict(zip(names, value, strict=True))
            elif hasattr(value, "dims"):  # labelled arrays keep their own attributes
                coords[name] = value
            else:
                own = {"units": entry.units, "long_name": entry.long_name}
                attrs = {key: text for key, text in own.items() if text} | dict(entry.attrs)
                coords[name] = labels_of(name, value, attrs)
        return values, coords


def variable_of(
    dims: Iterable[Hashable], values: object, attrs: Mapping[str, object] | None = None
) -> xr.Variable:
    """Make an xarray Variable from a NumPy array, faster than the usual constructor.

    Without `fastpath`, xarray looks for arrays of dask and pint, and imports both if they are
    installed. Objects need that search, as it also converts them.
    """
    array = np.asarray(values)
    return xr.Variable(dims, array, attrs, fastpath=array.dtype != object)


def labels_of(name: str, values: object, attrs: Mapping[str, object] | None = None) -> xr.Variable:
    """Make a coordinate variable from an array, with an index along the dimension of this name."""
    import pandas as pd
    from xarray.indexes import PandasIndex

    array = np.asarray(values)
    index = PandasIndex(pd.Index(array), name, coord_dtype=array.dtype)
    variable = index.create_variables()[name]
    variable.attrs.update(attrs or {})
    return variable


def places(
    data: xr.Dataset | xr.DataArray, dims: Sequence[Hashable]
) -> Iterator[dict[Hashable, int]]:
    """Yield all combinations of indices along some dimensions, each in the form of `isel`."""
    for index in product(*(range(data.sizes[dim]) for dim in dims)):
        yield dict(zip(dims, index, strict=True))


def texts_as_labels(answer: xr.Dataset) -> xr.Dataset:
    """Make texts and dates coordinates, because reductions of xarray fail for text variables."""
    return answer.set_coords([n for n, array in answer.data_vars.items() if _is_text(array)])


def texts_as_columns(answer: xr.Dataset) -> xr.Dataset:
    """Make texts and dates variables again, other than dimensions and inputs of members."""
    others = (n for n, array in answer.coords.items() if _is_text(array) and n not in answer.dims)
    return answer.reset_coords([name for name in others if "input" not in answer[name].attrs])


def _is_text(array: xr.DataArray) -> bool:
    return array.dtype.kind in "OUM"


# --- neglected effects: they are not part of the errors of results -------------------------------


def largest_of(text: str) -> tuple[str, float, str] | None:
    """Name, size and unit of the largest neglected effect, from the text of `Neglected.largest`.

    The name says if the effect is zero in the mean. The result is None if the text gives no size.
    """
    written = re.match(r"([^:]+): ([-+.e\d]+) ([^(]+) \(", text)
    if written is None:
        return None
    name = f"{written[1]}, zero in the mean" if PERIODIC in text else written[1]
    return name, float(written[2]), written[3]


def error_of(answer: xr.Dataset, headline: str) -> str:
    """Name of the variable with the error of the main result `headline`; empty if there is none."""
    if headline.endswith("_error") or headline not in answer:
        return headline
    return str(answer[headline].attrs.get("ancillary_variables", "")).split(" ")[0]


PERIODIC = "; zero in the mean over its period"
BOUND = "this is a bound on a neglected effect, or its published size"


@dataclass(frozen=True)
class Neglected:
    """Sizes of the effects that a model neglects, with the source of the sizes.

    Attributes
    ----------
    sizes : mapping of str to float
        Size of each effect, SI.
    unit : str
        Unit of the sizes in results.
    what : str
        Meaning of the sizes in plain words; without sizes, the neglected effect.
    source : str
        Source of the sizes.
    unknown : str
        Further neglected effects of unknown size.
    periodic : tuple of str
        Effects with a size that vanish in the mean over their period, which the answer gives.
    """

    #: Name of the part of a question that returns the sizes.
    PART: ClassVar[str] = "neglected"

    sizes: Mapping[str, float] = field(default_factory=dict)
    unit: str = "1"
    what: str = "nothing that has a known size"
    source: str = ""
    unknown: str = ""
    periodic: tuple[str, ...] = ()

    @classmethod
    def cited(cls, sizes: Mapping[str, Constant], what: str) -> Self:
        """Make a `Neglected` from sizes given as constants, each with its own source."""
        (unit,) = {size.unit for size in sizes.values()}
        si_values = {name: size.value / from_si(unit) for name, size in sizes.items()}
        source = "; ".join(f"{name}: {size.source}" for name, size in sizes.items())
        return cls(si_values, unit, what, source)

    def also(self, effect: str) -> Self:
        """Return a copy with one more neglected effect of unknown size; an empty text adds none."""
        if not effect:
            return self
        # without sizes, `what` names the neglected effect
        known = self.what if not self.sizes and self.what != Neglected.what else ""
        unknown = ", ".join(filter(None, (self.unknown or known, effect)))
        return replace(self, unknown=unknown)

    @property
    def largest(self) -> str:
        """Describe the largest neglected effect, with its size, for the attributes of a result."""
        unknown = f"of unknown size: {self.unknown}" if self.unknown else ""
        if not self.sizes:
            return unknown or self.what
        name = max(self.sizes, key=lambda effect: abs(self.sizes[effect]))
        shown = self.sizes[name] * from_si(self.unit)
        mean = PERIODIC if name in self.periodic else ""
        known = f"{name}: {shown:.3g} {self.unit} ({self.what}{mean})"
        return f"{known}; {unknown}" if unknown else known

    def dataset(self, effects: Sequence[str] = ()) -> xr.Dataset:
        """Sizes of neglected effects as a Dataset along `effect`, the largest first by default.

        Parameters
        ----------
        effects : sequence of str
            All labels that the answer has along `effect`, in their order. Those without a size in
            `sizes` are effects that the answer includes; their size is 0, as nothing is neglected.
        """
        names = list(effects) or sorted(self.sizes, key=lambda effect: -abs(self.sizes[effect]))
        sizes = np.array([self.sizes.get(name, 0.0) for name in names]) * from_si(self.unit)
        attrs = {"long_name": self.what, "units": self.unit, "no_error": BOUND}
        attrs |= {"references": self.source, "of_unknown_size": self.unknown}
        attrs |= {"zero_in_the_mean": "; ".join(self.periodic)}
        attrs = {name: words for name, words in attrs.items() if words}
        sized = variable_of(("effect",), sizes, attrs)
        labelled = labels_of("effect", np.array(names, dtype=str))
        return xr.Dataset({"neglected_effect": sized}, {"effect": labelled})

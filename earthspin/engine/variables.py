"""Classes that declare the variables of results, with unit, meaning, dimensions and error.

A part returns an instance with values in SI units. `dataset` converts them to the units of the
class and adds the attributes of the CF conventions. Values are plain floats, because a Quantity
would lose its unit in a file.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import MISSING, dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar, Self, dataclass_transform

import numpy as np

from earthspin.engine.labels import from_si
from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import Estimate

if TYPE_CHECKING:
    import xarray as xr

#: A number, an array along the declared dimensions, a labelled array, or text.
Value = Any
#: Labels along a dimension: an array, a list, or a labelled array of another answer.
Labels = Any


#: A number with its half-width.
Pair = Estimate | tuple[Any, Any]

#: Suffixes of the names of a field's variables, with patterns of their long names, in order.
_ALONE = {"": "{}"}
_WITH_ERROR = {"": "{}", "_error": "95 % half-width of the {}"}
_WITH_SHARES = {
    **_WITH_ERROR,
    "_error_method": "95 % half-width of the {} from averaging and sampling",
    "_error_input": "95 % half-width of the {} from the uncertainties of the inputs",
}
_PHASES = {"_in_phase": "{}, in phase", "_out_of_phase": "{}, out of phase"}


@dataclass(frozen=True)
class Variable:
    """Declaration of one variable of a result: unit, meaning, dimensions and error.

    Attributes
    ----------
    dims : tuple of str
        Dimensions; the labelled arrays of a body add further ones.
    units : str
        Unit as astropy.units parses it; "1" for pure numbers, "" for text and dates.
    long_name : str
        Meaning in plain words.
    attrs : tuple of pairs
        Further attributes, such as cell_methods or references.
    error : str
        Names of the variables that hold the error, if not ``<name>_error``.
    no_error : str
        Why there is no error.
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

    def attributes(self, name: str, others: Iterable[str]) -> dict[str, Any]:
        """Attributes of this variable: unit, meaning, and the names of its error variables."""
        attributes = {"long_name": self.long_name}
        if self.units:
            attributes["units"] = self.units
        companions = [other for other in others if other.startswith(f"{name}_error")]
        if companions or self.error:
            attributes["ancillary_variables"] = self.error or " ".join(companions)
        if self.no_error:
            attributes["no_error"] = self.no_error
        return attributes | dict(self.attrs)


class SchemaError(Exception):
    """Error raised if a part returns variables that it does not declare (a program defect)."""


@dataclass(frozen=True)
class Field:
    """Declaration of one field of a `Variables` class, which defines one or more variables.

    Attributes
    ----------
    variable : Variable
        Declaration of the field's main variable.
    along : tuple of str or None
        Dimensions; those of the class if None.
    endings : mapping of str to str
        Suffixes of the names of the field's variables, with patterns of their long names; empty
        for labels.
    default : object
        Default value; a field whose value is None is omitted from the answer.
    """

    variable: Variable
    along: tuple[str, ...] | None
    endings: Mapping[str, str]
    default: Any


def _field(
    endings: Mapping[str, str],
    units: str,
    long_name: str,
    *,
    along: tuple[str, ...] | None = None,
    error: str = "",
    no_error: str = "",
    short: str = "",
    default: Any = MISSING,
    **attrs: str,
) -> Any:
    variable = Variable((), units, long_name, tuple(attrs.items()), error, no_error, short)
    return Field(variable, along, endings, default)


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
    default : object
        ``None`` if an answer may omit the number.
    **options
        Further attributes, such as cell_methods.
    """
    return _field(_ALONE, units, long_name, **options)


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
    return _field(_WITH_SHARES if split else _WITH_ERROR, units, long_name, **options)


def amplitude(units: str, long_name: str, **options: Any) -> Any:
    """Declare a pair of variables: in-phase and out-of-phase amplitudes, as in IERS tables."""
    return _field(_PHASES, units, long_name, **options)


def words(long_name: str, **options: Any) -> Any:
    """Declare a field of a `Variables` class that holds text or dates, which have no unit."""
    return _field(_ALONE, "", long_name, **options)


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
    return _field({}, units, long_name, **options)


@dataclass_transform(
    kw_only_default=True, field_specifiers=(number, measured, amplitude, words, labels)
)
class Variables:
    """Base class for the set of variables that one part (function) adds to a result.

    Options of a subclass apply to all of its fields: `along`, the dimensions; `error`, the variable
    that holds the error of every number without its own; or `no_error`, why these have no error.
    An instance takes the values by name, in SI units.
    """

    #: Default dimensions of the fields.
    dims: ClassVar[tuple[str, ...]] = ()
    #: The fields by name, with inherited fields first.
    fields: ClassVar[Mapping[str, Field]] = {}
    #: The variables by name, in the order of an answer.
    schema: ClassVar[Mapping[str, Variable]] = {}

    def __init_subclass__(
        cls, along: tuple[str, ...] | None = None, error: str = "", no_error: str = ""
    ) -> None:
        """Collect the fields that a subclass declares."""
        cls.dims = cls.dims if along is None else along
        own = {name: field for name, field in vars(cls).items() if isinstance(field, Field)}
        cls.fields, schema = {**cls.fields, **own}, dict(cls.schema)
        for name, field in own.items():
            dims = cls.dims if field.along is None else field.along
            variable = replace(field.variable, dims=dims)
            half_width = Variable(dims, variable.units, "")
            for ending, meaning in field.endings.items():
                declared = half_width if ending.startswith("_error") else variable
                long_name = meaning.format(variable.long_name)
                schema[name + ending] = replace(declared, long_name=long_name)
        for name, variable in schema.items():
            has_error = variable.error or variable.no_error or f"{name}_error" in schema
            if variable.units and not has_error and "_error" not in name and name != error:
                schema[name] = replace(variable, error=error, no_error=no_error)
        cls.schema = schema

    def __init__(self, **values: Any) -> None:
        unknown = values.keys() - self.fields.keys()
        missing = {n for n, field in self.fields.items() if field.default is MISSING} - {*values}
        if unknown or missing:
            problem = f"{type(self).__name__}: unknown {sorted(unknown)}, missing {sorted(missing)}"
            raise SchemaError(problem)
        self._values = {n: values.get(n, field.default) for n, field in self.fields.items()}
        self._attributes: dict[str, Mapping[str, object]] = {}
        self._no_error = ""

    def with_attributes(self, *, no_error: str = "", **attributes: Mapping[str, object]) -> Self:
        """Add attributes to variables that are known only after the computation.

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
        import xarray as xr

        values, coords = self._by_variable()
        arrays: dict[str, xr.Variable] = {}
        for name, value in values.items():
            declared = self.schema[name]
            if isinstance(value, xr.DataArray):
                for dim, own in value.coords.items():
                    known = coords.setdefault(dim, own.variable)
                    if hasattr(known, "equals") and not known.equals(own.variable):
                        problem = f"labels along '{dim}' differ between variables"
                        raise SchemaError(problem)
                value = value.variable
            else:
                value = xr.Variable(declared.dims, value)
            if not set(declared.dims) <= set(value.dims):
                raise SchemaError(f"{name} has {value.dims}, declares {declared.dims}")
            laid = value.transpose(*declared.dims, ...)
            factor = from_si(declared.units)
            data = laid.values if factor == 1 else np.asarray(laid.values * factor)
            attributes = declared.attributes(name, values)
            if data.dtype.kind == "f" and np.isnan(data).any():
                if not (self._no_error and "_error" in name):
                    problem = f"{declared.long_name} is undefined; check the numbers of the body"
                    raise UndefinedError(problem)
                attributes["no_error"] = self._no_error
            arrays[name] = xr.Variable(laid.dims, data, attributes)
        result = xr.Dataset(arrays, coords=coords)
        for name, extra in self._attributes.items():
            result[name].attrs.update(extra)
        return result

    def _by_variable(self) -> tuple[dict[str, Any], dict[Any, Any]]:
        """Values by variable name, and coordinate labels by dimension, as two dicts."""
        values: dict[str, Any] = {}
        coords: dict[Any, Any] = {}
        for name, field in self.fields.items():
            value = self._values[name]
            if value is None:
                continue
            if len(field.endings) == 1:
                values[name] = value
            elif field.endings:
                if isinstance(value, Estimate):
                    shares = (value.value, value.error, value.method, value.given)
                    value = shares[: len(field.endings)]
                names = (name + ending for ending in field.endings)
                values |= dict(zip(names, value, strict=True))
            elif hasattr(value, "dims"):  # labelled arrays keep their own attributes
                coords[name] = value
            else:
                label = field.variable
                attrs = {"units": label.units} if label.units else {}
                attrs |= {"long_name": label.long_name} if label.long_name else {}
                coords[name] = (name, value, attrs | dict(label.attrs))
        return values, coords

"""Answers as classes: each variable is declared once, with its unit, meaning, dimensions and error.

A part returns an instance, whose values are in SI; `dataset` labels them, in the units of the class
and with the attributes that the CF conventions ask for. Plain floats only: a Quantity would lose
its unit on disk.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import MISSING, dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar, Self, dataclass_transform

import numpy as np

from earthspin.engine.labels import from_si
from earthspin.errors import UndefinedError
from earthspin.numerics.estimate import Estimate

if TYPE_CHECKING:
    import xarray as xr

#: A number, an array laid along the declared dimensions, or a labelled array; or words.
Value = Any
#: Labels along a dimension: an array, a list, or a labelled array of another answer.
Labels = Any


#: A number with its half-width.
Pair = Estimate | tuple[Any, Any]

#: Ends of the names and of the meanings of what a field holds, in the order of its values.
_ALONE = {"": "{}"}
_WITH_ERROR = {"": "{}", "_error": "95 % half-width of the {}"}
_WITH_SHARES = {
    **_WITH_ERROR,
    "_error_method": "95 % half-width of the {} from averaging and sampling",
    "_error_input": "95 % half-width of the {} from given numbers",
}
_PHASES = {"_in_phase": "{}, in phase", "_out_of_phase": "{}, out of phase"}


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

    def attributes(self, name: str, others: Iterable[str]) -> dict[str, Any]:
        """Attributes of the variable of this name in a dataset with these others."""
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
    """A part gave something else than it declares: a defect of the program, not of the input."""


@dataclass(frozen=True)
class Field:
    """Declaration of one field of an answer.

    Attributes
    ----------
    variable : Variable
        What it holds.
    along : tuple of str or None
        Its dimensions; those of the class if None.
    endings : mapping of str to str
        Ends of the names of its variables, with their meanings; empty for labels.
    default : object
        Used where no value is given; a field whose value is None is left out of the answer.
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
    """Declare a number.

    Parameters
    ----------
    units : str
        In which it is shown; "1" for pure numbers. Values are given in SI.
    long_name : str
        In plain words.
    along : tuple of str, optional
        Its dimensions; those of the class if not given.
    error : str
        Names of the variables that hold its error, where they are not called after it.
    no_error : str
        Why it carries no error.
    short : str
        Label of tables and axes.
    default : object
        ``None`` if it may be left out of an answer.
    **options
        Further attributes, such as cell_methods.
    """
    return _field(_ALONE, units, long_name, **options)


def measured(units: str, long_name: str, *, split: bool = False, **options: Any) -> Any:
    """Declare a number together with its 95 % half-width, ``<name>_error``.

    Its value is a pair, or an estimate that knows its shares.

    Parameters
    ----------
    units, long_name, **options
        As of `number`.
    split : bool
        Also declare the shares of the method and of the inputs.
    """
    return _field(_WITH_SHARES if split else _WITH_ERROR, units, long_name, **options)


def amplitude(units: str, long_name: str, **options: Any) -> Any:
    """Declare an amplitude as the IERS tabulates it: in phase and out of phase, given as a pair."""
    return _field(_PHASES, units, long_name, **options)


def words(long_name: str, **options: Any) -> Any:
    """Declare words or dates, which have no unit."""
    return _field(_ALONE, "", long_name, **options)


def labels(long_name: str = "", units: str = "", **options: Any) -> Any:
    """Declare the labels of the dimension that the field is called after.

    Parameters
    ----------
    long_name : str
    units : str
        Of the labels, which are given in these.
    default : object
        The labels, where they are always the same.
    **options
        Further attributes.
    """
    return _field({}, units, long_name, **options)


@dataclass_transform(
    kw_only_default=True, field_specifiers=(number, measured, amplitude, words, labels)
)
class Variables:
    """Variables of an answer or of a section, as one part gives them.

    A class of them may say what holds for all of its fields: `along`, their dimensions; `error`,
    the variable that holds the error of all numbers that have none of their own; or `no_error`, why
    these have none. An instance takes the values by name, in SI units.
    """

    #: Dimensions of the fields that do not say theirs.
    dims: ClassVar[tuple[str, ...]] = ()
    #: The fields by name, those of the bases first.
    fields: ClassVar[Mapping[str, Field]] = {}
    #: The variables by name, in the order of an answer.
    schema: ClassVar[Mapping[str, Variable]] = {}

    def __init_subclass__(
        cls, along: tuple[str, ...] | None = None, error: str = "", no_error: str = ""
    ) -> None:
        """Collect what the class declares."""
        cls.dims = cls.dims if along is None else along
        own = {name: field for name, field in vars(cls).items() if isinstance(field, Field)}
        cls.fields, schema = {**cls.fields, **own}, dict(cls.schema)
        for name, field in own.items():
            dims = cls.dims if field.along is None else field.along
            variable = replace(field.variable, dims=dims)
            half_width = Variable(dims, variable.units, "")
            for ending, meaning in field.endings.items():
                declared = half_width if ending.startswith("_error") else variable
                words = meaning.format(variable.long_name)
                schema[name + ending] = replace(declared, long_name=words)
        for name, variable in schema.items():
            has_error = variable.error or variable.no_error or f"{name}_error" in schema
            if variable.units and not has_error and "_error" not in name and name != error:
                schema[name] = replace(variable, error=error, no_error=no_error)
        cls.schema = schema

    def __init__(self, **values: Any) -> None:
        unknown = values.keys() - self.fields.keys()
        missing = {n for n, field in self.fields.items() if field.default is MISSING} - {*values}
        if unknown or missing:
            words = f"{type(self).__name__}: unknown {sorted(unknown)}, missing {sorted(missing)}"
            raise SchemaError(words)
        self._values = {n: values.get(n, field.default) for n, field in self.fields.items()}
        self._attributes: dict[str, Mapping[str, object]] = {}
        self._no_error = ""

    def with_attributes(self, *, no_error: str = "", **attributes: Mapping[str, object]) -> Self:
        """Add what is known only when the numbers are.

        Parameters
        ----------
        no_error : str
            Why errors are not given where they are NaN; empty if all are given.
        **attributes
            Further attributes by the name of the variable.
        """
        self._no_error = no_error or self._no_error
        self._attributes |= attributes
        return self

    def dataset(self) -> xr.Dataset:
        """Lay the values out, in the units of the class and with its attributes.

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
                        problem = f"labels along '{dim}' differ from one variable to the next"
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
                    problem = f"{declared.long_name} has no value here; check the body's numbers"
                    raise UndefinedError(problem)
                attributes["no_error"] = self._no_error
            arrays[name] = xr.Variable(laid.dims, data, attributes)
        result = xr.Dataset(arrays, coords=coords)
        for name, extra in self._attributes.items():
            result[name].attrs.update(extra)
        return result

    def _by_variable(self) -> tuple[dict[str, Any], dict[Any, Any]]:
        """Values that are given by the names of their variables, and labels by dimension."""
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

"""Inputs of a question that may differ between ensemble members, found by their names.

``"body.j2"`` is a number of the body, ``"moon.gm"`` one of a perturber, ``"spin"`` a key that is a
number, and ``"moments.2"`` a number in a key that is a list of numbers. ``"orbit"`` is a key whose
values are names.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from earthspin.engine.member_values import MEMBER
from earthspin.engine.members import TWICE, Distribution, checked_names
from earthspin.engine.question import Question, keys_of
from earthspin.errors import Where, nearest
from earthspin.units import Number, by_name, unit_factor

if TYPE_CHECKING:
    import xarray as xr

#: Names of the numbers that users know by their symbols.
_SYMBOLS = {"H": "body.dynamical_flattening", "J2": "body.j2", "J3": "body.j3", "GM": "body.gm"}


@dataclass(frozen=True)
class Input:
    """One input that may differ between ensemble members: a number, or a name such as a file.

    Attributes
    ----------
    name : str
        Name of the input, as the user wrote it.
    key : str
        Key of the question.
    element : int or None
        Index in the list that the key holds; None if the key holds no list.
    field : str
        Field of a body; empty if the input is the key itself.
    kind : Kind
        Type that reads and checks a value.
    labelled : bool
        Whether the input may be an array along `member`, if the question takes arrays in this key.
    """

    name: str
    key: str
    element: int | None
    field: str
    kind: Any
    labelled: bool

    @property
    def named(self) -> bool:
        """Return True if the values of this input are names rather than numbers."""
        return not self.field and self.element is None and by_name(self.kind)

    @property
    def unit(self) -> str:
        """Unit of the values of this input; empty for pure numbers and names."""
        return "" if self.named else str(self.kind.unit)

    @property
    def label(self) -> str:
        """Name of the coordinate that holds the values of this input in a result."""
        return self.name.replace(".", "_")

    def checked(self, values: NDArray[Any], unit: str | None, where: Where) -> NDArray[Any]:
        """Return the values of this input for all members, in its unit; refuse a wrong type.

        Raises
        ------
        EarthspinError
            If a number is required and names were given, the key does not take one of the names, or
            the unit is of another kind.
        """
        if self.named:
            checked_names(np.unique(values).tolist(), self.kind, where)
        elif values.dtype.kind == "U":
            raise where.error(str(values[0]), "give finite numbers")
        elif unit is not None:
            return values * unit_factor(unit, self.unit, where, f"1 {self.unit}".strip())
        return values


def inputs_of(question: Question, names: Iterable[str], where: Where) -> dict[str, Input]:
    """Return the inputs of a question that have the given names, as `Input` objects.

    Parameters
    ----------
    question : Question
    names : iterable of str
    where : Where
        The key that holds the names, for messages.

    Raises
    ------
    SceneError
        If the question has no input of a name (the message suggests the nearest one), two names
        are those of one input, or a number belongs to a key whose value itself varies.
    """
    every = {entry.name: entry for entry in _all_inputs(question)}
    inputs: dict[str, Input] = {}
    for name in names:
        short = name.removeprefix(f"{question.table}.") if question.table else name
        known = every.get(name) or every.get(short)
        if known is None:
            symbol = _SYMBOLS.get(name)
            raise where.error(
                name, f"write '{symbol}'" if symbol in every else nearest(name, every)
            )
        if any(replace(entry, name=known.name) == known for entry in inputs.values()):
            raise where.at(name).error(name, TWICE)
        inputs[name] = replace(known, name=name)
    chosen = {entry.key: entry.name for entry in inputs.values() if entry.named}
    for entry in inputs.values():
        if chosen.get(entry.key, entry.name) != entry.name:
            problem = (
                f"members already differ in '{chosen[entry.key]}' itself; remove one of the two"
            )
            raise where.at(entry.name).error("a number", problem)
    return inputs


def _all_inputs(question: Question) -> Iterator[Input]:
    """Yield all inputs of a question: every number that is set, and every key that takes a name."""
    for key, entry in keys_of(question.__class__).items():
        value = getattr(question, key)
        if by_name(entry.kind) and key not in keys_of(Question):
            yield Input(key, key, None, "", entry.kind, False)
        if hasattr(value, "magnitudes"):
            for field, kind in value.magnitudes().items():
                yield Input(f"{key}.{field}", key, None, field, kind, field in value.LABELLED)
        elif isinstance(value, tuple) and value and hasattr(value[0], "magnitudes"):
            for index, body in enumerate(value):
                for field, kind in body.magnitudes().items():
                    name, labelled = f"{body.name}.{field}", field in body.LABELLED
                    yield Input(name, key, index, field, kind, labelled)
        elif isinstance(entry.kind, Number):
            yield Input(key, key, None, "", entry.kind, True)
        elif hasattr(value, "numbers") or isinstance(value, np.ndarray):
            list_kind: Any = entry.kind
            kind = Number(list_kind.unit, list_kind.example)
            if isinstance(value, np.ndarray):
                yield Input(key, key, None, "", entry.kind, True)
            for index in range(np.size(getattr(value, "numbers", value))):
                yield Input(f"{key}.{index}", key, index, "", kind, True)


def published(question: Question) -> dict[str, Distribution]:
    """Probability distributions of all inputs with a published uncertainty, by input name.

    Numbers of bodies have normal distributions; of a perturber, only the mass varies. The question
    adds distributions of its own keys. No correlations are published.
    """
    distributions: dict[str, Distribution] = {}
    for item in _all_inputs(question):
        body = getattr(question, item.key)
        if item.element is not None and item.field:
            body = body[item.element]
        u = getattr(body, "relative_uncertainty", {}).get(item.field, 0.0)
        counts = item.element is None or item.field == "gm"
        if u and counts and np.ndim(getattr(body, item.field)) == 0:
            value = float(getattr(body, item.field))
            distributions[item.name] = Distribution("normal", (value, abs(value) * u))
    own = question.published_inputs()
    return distributions | {name: Distribution(*entry) for name, entry in own.items()}


def with_values(
    question: Question, inputs: Mapping[str, Input], values: Mapping[str, Any]
) -> Question:
    """Return a copy of the question with the input values of one or several members.

    Parameters
    ----------
    question : Question
    inputs : mapping of str to Input
    values : mapping of str to float, ndarray or DataArray
        Values by name of the input; arrays along `member` hold values of several members.

    Raises
    ------
    EarthspinError
        If a body or question with these values is impossible.
    """
    fields: dict[tuple[str, int | None], dict[str, Any]] = {}
    for name, entry in inputs.items():
        if entry.field:
            fields.setdefault((entry.key, entry.element), {})[entry.field] = values[name]
    bodies: dict[str, Any] = {}
    for (key, element), numbers in fields.items():
        body = bodies.get(key, getattr(question, key))
        if element is None:
            bodies[key] = body.replace(**numbers)
        else:
            bodies[key] = _with_item(body, element, body[element].replace(**numbers))
    changes: dict[str, Any] = {}
    for name, entry in inputs.items():
        if entry.element is None and not entry.field:
            changes[entry.key] = values[name]
        elif not entry.field:
            sequence = changes.get(entry.key, getattr(question, entry.key))
            changes[entry.key] = _with_number(sequence, entry.element, values[name])
    changed = question.replace(**bodies)
    labelled = any(hasattr(values[name], "dims") and not inputs[name].field for name in inputs)
    return changed.holding(**changes) if labelled else changed.replace(**changes)


def _with_item(items: tuple[Any, ...], index: int, item: Any) -> tuple[Any, ...]:
    return (*items[:index], item, *items[index + 1 :])


def _with_number(sequence: Any, index: Any, value: Any) -> Any:
    """Return a list with one number replaced, by a number or by one value for each member."""
    if hasattr(sequence, "numbers"):
        return replace(sequence, numbers=_with_item(sequence.numbers, index, value))
    labelled = hasattr(value, "dims")
    if labelled and not hasattr(sequence, "dims"):
        sequence = _along_members(np.stack([sequence] * value.size))
    sequence = sequence.copy()
    rows = value.size if labelled else 1
    getattr(sequence, "values", sequence).reshape(rows, -1)[:, index] = value
    return sequence


def _along_members(values: NDArray[Any]) -> xr.DataArray:
    """Make an array of member values with named dimensions, of which the first is `member`."""
    import xarray as xr

    return xr.DataArray(values, dims=(MEMBER, *(f"{MEMBER}_{k}" for k in range(values.ndim - 1))))


def along_members(values: Mapping[str, NDArray[Any]], which: Any) -> dict[str, Any]:
    """Return input values of several members as arrays along the dimension `member`."""
    return {name: _along_members(array[which]) for name, array in values.items()}


def one_member(values: Mapping[str, NDArray[Any]], number: int) -> dict[str, Any]:
    """Return the input values of one member, by name of the input."""
    return {
        name: array[number].item() if array.ndim == 1 else array[number]
        for name, array in values.items()
    }

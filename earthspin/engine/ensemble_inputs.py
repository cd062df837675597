"""Inputs of a question that may differ between ensemble members, found by their names.

``"body.j2"`` is a number of the body, ``"moon.gm"`` one of a perturber, ``"spin"`` a key that is a
number, and ``"moments.2"`` a number in a key that is a list of numbers. ``"orbit"`` is a key whose
values are names.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin._lazy import xr
from earthspin.engine.members import MEMBER, TWICE, Distribution
from earthspin.engine.question import Question, keys_of
from earthspin.errors import Where, nearest
from earthspin.units import Number, by_name

#: Names of the numbers that users know by their symbols.
_SYMBOLS = {"H": "body.dynamical_flattening", "J2": "body.j2", "J3": "body.j3", "GM": "body.gm"}


class Input(NamedTuple):
    """One input that may differ between ensemble members: a number, or a text such as a file name.

    Attributes
    ----------
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

    key: str
    element: int | None
    field: str
    kind: Any
    labelled: bool

    @property
    def named(self) -> bool:
        """Return True if this input is a text, such as a model or file name, not a number."""
        return not self.field and self.element is None and by_name(self.kind)


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
    every = dict(_all_inputs(question))
    inputs: dict[str, Input] = {}
    for name in names:
        short = name.removeprefix(f"{question.table}.") if question.table else name
        known = every.get(name) or every.get(short)
        if known is None:
            symbol = _SYMBOLS.get(name)
            problem = f"write '{symbol}'" if symbol in every else nearest(name, every)
            raise where.error(name, problem)
        if known in inputs.values():
            raise where.at(name).error(name, TWICE)
        inputs[name] = known
    keys = {entry.key for entry in inputs.values() if entry.named}
    for name, entry in inputs.items():
        if entry.key in keys and not entry.named:
            problem = f"members already differ in '{entry.key}' itself; remove one of the two"
            raise where.at(name).error("a number", problem)
    return inputs


def _all_inputs(question: Question) -> Iterator[tuple[str, Input]]:
    """Yield the name and the `Input` of every numerical input and text input of a question."""
    for key, entry in keys_of(type(question)).items():
        value, kind = getattr(question, key), entry.kind
        if by_name(kind) and key not in keys_of(Question):
            yield key, Input(key, None, "", kind, False)
        bodies = value if isinstance(value, tuple) else (value,)
        if bodies and hasattr(bodies[0], "magnitudes"):
            for index, body in enumerate(bodies):
                owner, element = (key, None) if body is value else (body.name, index)
                for field, inner in body.magnitudes().items():
                    labelled = field in body.LABELLED or field not in {*body.UNITS, "mass"}
                    yield f"{owner}.{field}", Input(key, element, field, inner, labelled)
        elif isinstance(kind, Number):
            yield key, Input(key, None, "", kind, True)
        elif hasattr(value, "numbers") or isinstance(value, np.ndarray):
            if isinstance(value, np.ndarray):
                yield key, Input(key, None, "", kind, True)
            several: Any = kind
            single = Number(several.unit, several.example)
            for index in range(np.size(getattr(value, "numbers", value))):
                yield f"{key}.{index}", Input(key, index, "", single, True)


def published(question: Question) -> dict[str, Distribution]:
    """Probability distributions of all inputs with a published uncertainty, by input name.

    Numbers of bodies have normal distributions; of a perturber, only the mass varies. The question
    adds distributions of its own keys. No correlations are published.
    """
    distributions: dict[str, Distribution] = {}
    for name, (key, element, field, *_) in _all_inputs(question):
        body = getattr(question, key)
        body = body[element] if field and element is not None else body
        u = getattr(body, "relative_uncertainty", {}).get(field, 0.0)
        if u and (element is None or field == "gm") and np.ndim(getattr(body, field)) == 0:
            value = float(getattr(body, field))
            distributions[name] = Distribution("normal", (value, abs(value) * u))
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
    changes: dict[str, Any] = {}
    for name, (key, element, field, *_) in inputs.items():
        if field:
            fields.setdefault((key, element), {})[field] = values[name]
        else:
            numbers = changes.get(key, getattr(question, key))
            changes[key] = _with_number(numbers, element, values[name])
    bodies: dict[str, Any] = {}
    for (key, element), numbers in fields.items():  # the numbers of a body change at once
        body = bodies.get(key, getattr(question, key))
        changed = (body if element is None else body[element]).replace(**numbers)
        bodies[key] = changed if element is None else _with_item(body, element, changed)
    question = question.replace(**bodies)
    if any(hasattr(values[name], "dims") for name, entry in inputs.items() if not entry.field):
        return question.replace(changes)
    return question.replace(**changes)


def _with_item(items: tuple[Any, ...], index: int, item: Any) -> tuple[Any, ...]:
    return (*items[:index], item, *items[index + 1 :])


def _with_number(sequence: Any, index: int | None, value: Any) -> Any:
    """Return an array with one element replaced by a number, or by an array along `member`.

    Without an index, the value takes the place of the whole.
    """
    if index is None:
        return value
    if hasattr(sequence, "numbers"):
        return replace(sequence, numbers=_with_item(sequence.numbers, index, value))
    labelled = hasattr(value, "dims")
    if labelled and not hasattr(sequence, "dims"):
        sequence = along_members(np.stack([sequence] * value.size))
    sequence = sequence.copy()
    rows = value.size if labelled else 1
    getattr(sequence, "values", sequence).reshape(rows, -1)[:, index] = value
    return sequence


def along_members(values: NDArray[Any]) -> xr.DataArray:
    """Make a DataArray from values of all members; the first dimension is `member`."""
    return xr.DataArray(values, dims=(MEMBER, *(f"{MEMBER}_{k}" for k in range(values.ndim - 1))))

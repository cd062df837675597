"""Read the Dataset, sections, body and perturbers from a result, for tables and figures."""

from __future__ import annotations

from collections.abc import Hashable, Mapping

import xarray as xr

from earthspin.bodies import in_a_sentence
from earthspin.engine.question import Question
from earthspin.scenes import QUESTIONS, run_tree

#: A plain answer, or one with sections beside it.
Result = xr.Dataset | xr.DataTree


def answer_of(result: Result) -> xr.Dataset:
    """Return the main Dataset of a result; for many bodies or starts, select the first."""
    whole = result.to_dataset() if isinstance(result, xr.DataTree) else result
    return _first(whole, whole.attrs)


def question_of(result: Result) -> type[Question] | None:
    """Return the class of the question that gave a result; None if it is not in this package."""
    return QUESTIONS.get(result.attrs["compute"])


def section(result: Result, name: str) -> xr.Dataset | None:
    """Return the section (Dataset) of a result with the given name, or None if there is none."""
    if not isinstance(result, xr.DataTree) or name not in result.children:
        return None
    return _first(result[name].to_dataset(), result.attrs)


def needed(result: Result, name: str) -> xr.Dataset:
    """Return the section (Dataset) of a result with the given name; compute it if it is missing.

    Raises
    ------
    SceneError
        If the question has no such section, or the section does not apply; the error says why.
    """
    found = section(result, name)
    if found is None:
        found = section(run_tree(result, [name]), name)
    assert found is not None
    return found


def body_of(answer: xr.Dataset) -> str:
    """Name of the body of a result, followed by its properties that the user changed.

    ``"Mars"``, ``"the Earth with spin_period = 43200.0 s"``.
    """
    name, changes = in_a_sentence(answer.attrs["body"]), answer.attrs.get("body_changes")
    return f"{name} with {changes}" if changes else name


def perturbers_of(answer: xr.Dataset) -> str:
    """List the perturbers of a result in words: ``"the Sun, the Moon and Jupiter"``."""
    *others, last = map(in_a_sentence, answer.attrs["perturbers"].split())
    return f"{', '.join(others)} and {last}" if others else last


def changes_of(answer: xr.Dataset, *keys: str) -> list[str]:
    """Sentences that list which properties of the body and the perturbers the user changed.

    Parameters
    ----------
    answer : Dataset
    *keys : str
        The keys to look at; ``"body"`` and ``"perturbers"`` by default.
    """
    return [
        f"{key.capitalize()}: {answer.attrs[key]} with {answer.attrs[f'{key}_changes']}."
        for key in keys or ("body", "perturbers")
        if f"{key}_changes" in answer.attrs
    ]


def _first(data: xr.Dataset, attrs: Mapping[Hashable, str]) -> xr.Dataset:
    """Select the first body or initial state from a Dataset with many of them.

    That is, the first along dimensions that no part of the question declares.
    """
    question = QUESTIONS.get(attrs.get("compute", ""))
    if question is None:
        return data
    declared = {n: v for part in question.graph.parts.values() for n, v in part.gives.items()}
    known = {"effect", "part", *(dim for variable in declared.values() for dim in variable.dims)}
    first = data.isel({dim: 0 for dim in data.dims if dim not in known}).copy()
    for name in first.variables.keys() & declared.keys():
        first[name].attrs |= {"short": declared[str(name)].short}
    return first

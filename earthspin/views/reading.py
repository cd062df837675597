"""What a view reads from what it is given: the answer, a section of it, whose answer it is."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from typing import TypeVar

import xarray as xr

from earthspin.scenes import QUESTIONS, run_tree

#: A plain answer, or one with sections beside it.
Result = xr.Dataset | xr.DataTree

T = TypeVar("T")


def answer_of(result: Result) -> xr.Dataset:
    """Answer itself; of many bodies or starts the first, which is the one that is shown."""
    whole = result.to_dataset() if isinstance(result, xr.DataTree) else result
    return _first(whole, whole.attrs)


def section(result: Result, name: str) -> xr.Dataset | None:
    """Section of an answer; None if it is not there."""
    if not isinstance(result, xr.DataTree) or name not in result.children:
        return None
    return _first(result[name].to_dataset(), result.attrs)


def needed(result: Result, name: str) -> xr.Dataset:
    """Section of an answer, which is run again where it lacks it.

    Raises
    ------
    SceneError
        If the question has no such section, or it does not apply; it gives the reason.
    """
    found = section(result, name)
    if found is None:
        found = section(run_tree(result, [name]), name)
    assert found is not None
    return found


def of_sections(tree: Result, makers: Mapping[str, Callable[[Result], T]]) -> list[T]:
    """Views of the sections that are there.

    Parameters
    ----------
    tree : Dataset or DataTree
    makers : mapping of str to callable
        By the section that each stands on; each takes the tree.
    """
    return [make(tree) for name, make in makers.items() if section(tree, name) is not None]


def body_of(answer: xr.Dataset) -> str:
    """Name of the body, with what sets it apart from the one that it is named after.

    ``"Mars"``, ``"Earth with spin_period = 43200.0 s"``.
    """
    name, changes = str(answer.attrs["body"]).capitalize(), answer.attrs.get("body_changes")
    return f"{name} with {changes}" if changes else name


def changes_of(answer: xr.Dataset, *keys: str) -> list[str]:
    """Say which bodies are not as they are kept under their names, a sentence each.

    Parameters
    ----------
    answer : Dataset
    *keys : str
        Of those keys alone; ``"body"`` and ``"perturbers"`` by default.
    """
    return [
        f"{key.capitalize()}: {answer.attrs[key]} with {answer.attrs[f'{key}_changes']}."
        for key in keys or ("body", "perturbers")
        if f"{key}_changes" in answer.attrs
    ]


def _first(data: xr.Dataset, attrs: Mapping[Hashable, str]) -> xr.Dataset:
    """First of many bodies or starts: along dimensions that no part of the question declares."""
    question = QUESTIONS.get(attrs.get("compute", ""))
    if question is None:
        return data
    every = question.graph.parts.values()
    known = {dim for one in every for declared in one.gives.values() for dim in declared.dims}
    return data.isel({dim: 0 for dim in data.dims if dim not in known | {"effect", "part"}})

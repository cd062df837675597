"""Contents of a result: its answer, sections and attributes."""

from __future__ import annotations

from collections.abc import Hashable, Mapping

import xarray as xr

from earthspin.bodies import in_a_sentence
from earthspin.engine.accessor import Answer
from earthspin.engine.question import Question
from earthspin.errors import listed
from earthspin.scenes import QUESTIONS, run_tree

#: A plain answer, or one with sections beside it.
Result = xr.Dataset | xr.DataTree


def dataset_of(result: Result) -> xr.Dataset:
    """Return the main Dataset of a result, with all bodies, initial states and members."""
    return result.to_dataset() if isinstance(result, xr.DataTree) else result


def answer_of(result: Result) -> xr.Dataset:
    """Return the main Dataset of a result; of several bodies or initial states, only the first."""
    return _first_case(dataset_of(result), result.attrs)


def question_of(result: Result) -> type[Question] | None:
    """Return the `Question` class (type of computation) of a result; None for an unknown type."""
    return QUESTIONS.get(result.attrs["compute"])


def stored_section(result: Result, name: str) -> xr.Dataset | None:
    """Return the section (Dataset) of a result with the given name, or None if there is none."""
    if not isinstance(result, xr.DataTree) or name not in result.children:
        return None
    return _first_case(Answer(result).section(name), result.attrs)


def section(result: Result, name: str) -> xr.Dataset:
    """Return the section (Dataset) of a result with the given name; compute it if it is missing.

    Raises
    ------
    SceneError
        If the question has no such section, or the section does not apply; the error says why.
    """
    data = stored_section(result, name)
    if data is None:
        data = stored_section(run_tree(result, [name]), name)
    assert data is not None
    return data


def body_of(answer: xr.Dataset) -> str:
    """Name of the body of a result, followed by its properties that the user changed.

    ``"Mars"``, ``"the Earth with spin_period = 43200.0 s"``.
    """
    name, changes = in_a_sentence(answer.attrs["body"]), answer.attrs.get("body_changes")
    return f"{name} with {changes}" if changes else name


def perturbers_of(answer: xr.Dataset) -> str:
    """List the perturbers of a result in words: ``"the Sun, the Moon and Jupiter"``."""
    names = [in_a_sentence(name) for name in answer.perturber.values.tolist()]
    return listed(names[:-1] or names)  # the last of several is their total


def changes_of(answer: xr.Dataset, *keys: str) -> list[str]:
    """Sentences that list the properties of the body and the perturbers that the user changed.

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


def _first_case(data: xr.Dataset, attrs: Mapping[Hashable, str]) -> xr.Dataset:
    """Select the first body or initial state from a Dataset with many of them.

    That is, the first along dimensions that no part of the question declares.
    """
    question = QUESTIONS.get(attrs.get("compute", ""))
    if question is None:
        return data
    declared = question.graph.variables
    known = {"effect", "part", *question.graph.labels}
    first = _in_order(data.isel({dim: 0 for dim in data.dims if dim not in known}), question)
    for name in first.variables.keys() & declared.keys():
        first[name] = first[name].transpose(*declared[str(name)].dims, ..., missing_dims="ignore")
        first[name].attrs |= {"short": declared[str(name)].short}
    return first


def _in_order(data: xr.Dataset, question: type[Question]) -> xr.Dataset:
    """Return a copy with labels in the order of an answer, such as x, y, z, and the total last."""
    orders = question.graph.constant_labels
    if "perturber" in data.coords:
        names = data.perturber.values.ravel().tolist()
        orders = orders | {"perturber": sorted(names, key=lambda name: name == "total")}
    return data.copy().sel(
        {
            dim: order
            for dim, order in orders.items()
            if dim in data.dims and sorted(data[dim].values.tolist()) == sorted(order)
        }
    )

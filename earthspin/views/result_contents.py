"""Contents of a result: its answer, sections and attributes."""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from functools import partial
from itertools import islice
from typing import Any

import numpy as np
import xarray as xr

from earthspin.bodies import in_a_sentence
from earthspin.engine.accessor import Answer, is_ensemble
from earthspin.engine.origin import is_whole, without_lost_units
from earthspin.engine.question import Question
from earthspin.engine.variables import from_si, places
from earthspin.errors import listed
from earthspin.scenes import QUESTIONS, load_scene, run_tree

#: A plain answer, or one with sections beside it.
Result = xr.Dataset | xr.DataTree


def dataset_of(result: Result) -> xr.Dataset:
    """Return the main Dataset of a result, with all bodies, initial states and members."""
    return result.to_dataset() if isinstance(result, xr.DataTree) else result


def answer_of(result: Result) -> xr.Dataset:
    """Return the main Dataset of a result; of several bodies or initial states, only the first."""
    return _first_case(dataset_of(result), question_of(result))


def question_of(result: Result) -> type[Question] | None:
    """Return the `Question` class (type of computation) of a result; None for an unknown type."""
    return QUESTIONS.get(result.attrs.get("compute", ""))


def stored_section(result: Result, name: str) -> xr.Dataset | None:
    """Return the section (Dataset) of a result with the given name, or None if there is none."""
    if not isinstance(result, xr.DataTree) or name not in result.children:
        return None
    return _first_case(Answer(result).section(name), question_of(result))


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


def changes_of(answer: xr.Dataset) -> list[str]:
    """Sentences that list the properties of the body and the perturbers that the user changed."""
    return [
        f"{key.capitalize()}: {answer.attrs[key]} with {answer.attrs[f'{key}_changes']}."
        for key in ("body", "perturbers")
        if f"{key}_changes" in answer.attrs
    ]


#: Number of bodies or initial states of which figures are drawn.
MOST_CASES = 6


def cases_of(result: Result) -> dict[str, Result]:
    """The first bodies or initial states of a result, each with its labels as text."""
    data = dataset_of(result)
    cases: dict[str, Result] = {}
    dims = [] if is_ensemble(data) else [*_case_dims(data, question_of(result))]
    if not dims:
        return {"": result}
    for at in islice(places(data, dims), MOST_CASES):
        words = ", ".join(f"{dim} {data[dim].values[number]}" for dim, number in at.items())
        case = partial(xr.Dataset.isel, indexers=at, missing_dims="ignore")
        if isinstance(result, xr.Dataset):
            cases[words] = case(result)
        else:
            cases[words] = result.map_over_datasets(case)
    return cases


def resampled(result: Result, points: int) -> Result:
    """Compute a motion in closed form at more times, from its first to its last one."""
    data = dataset_of(result)
    if not is_whole(data) or data.sizes["time"] >= points:
        return result
    first, last = data.time.values[[0, -1]].tolist()
    times = np.linspace(first, last, points)
    names = [name for name in getattr(result, "children", ()) if name != "plan"]
    return run_tree(load_scene(data).replace(times=times, duration=None, points=None), names)


def laid_out(data: xr.Dataset) -> xr.Dataset:
    """Return a part of an answer with the dimensions of its question, in their order."""
    question, data = question_of(data), without_lost_units(data)
    declared = {n: v.dims for n, v in question.graph.variables.items()} if question else {}
    declared = {name: dims for name, dims in declared.items() if name in data.data_vars}
    single = {
        d for dims in declared.values() for d in dims if d in data.coords and not data[d].ndim
    }
    labels = {dim: ((dim,), data[dim].values[None], data[dim].attrs) for dim in single}
    arrays = {}
    for name, dims in declared.items():
        array: Any = data[name].variable
        own = [dim for dim in dims if dim in array.dims or dim in single]
        arrays[name] = array.set_dims([*own, *(dim for dim in array.dims if dim not in dims)])
    return data.drop_vars(single).assign(arrays).assign_coords(labels)


def ascending(data: xr.Dataset) -> xr.Dataset:
    """Sort a part of an answer by its numbers and dates."""
    return data.sortby([dim for dim in data.indexes if data[dim].dtype.kind in "Mfi"])


def _first_case(data: xr.Dataset, question: type[Question] | None) -> xr.Dataset:
    """Select the first body or initial state from a Dataset with many of them.

    That is, the first along dimensions that no part of the question declares.
    """
    if question is None:
        return data
    declared = question.graph.variables
    first = _in_order(data.isel(dict.fromkeys(_case_dims(data, question), 0)), question)
    first = in_shown_units(first, question)
    for name in first.variables.keys() & declared.keys():
        first[name] = first[name].transpose(*declared[str(name)].dims, ..., missing_dims="ignore")
        first[name].attrs |= {"short": declared[str(name)].short}
    return first


def in_shown_units(data: xr.Dataset, question: type[Question]) -> xr.Dataset:
    """Convert variables to the units of tables and axes, where those of the numbers are others."""
    converted = {}
    for name in data.variables.keys() & question.graph.variables.keys():
        declared, array = question.graph.variables[str(name)], data[name]
        if declared.shown and array.attrs.get("units") == declared.units:
            scaled = array * (from_si(declared.shown) / from_si(declared.units))
            converted[name] = scaled.assign_attrs(array.attrs | {"units": declared.shown})
    return data.assign(converted)


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
            if dim in data.dims
            and sorted(data[dim].values.tolist()) == sorted(order)
            and data.indexes[dim].is_unique
        }
    )


def _case_dims(data: xr.Dataset, question: type[Question] | None) -> Iterator[Hashable]:
    """Yield the dimensions that no part of the question declares."""
    known = {"effect", "part", *question.graph.labels} if question else {*data.dims}
    return (dim for dim in data.dims if dim not in known)

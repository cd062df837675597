"""Line that closes the output of a command: error of the main number of a result, and run time."""

from __future__ import annotations

from collections.abc import Hashable

import numpy as np
import xarray as xr

from earthspin.engine.run import run_time_words
from earthspin.engine.variables import error_of, from_si, largest_of
from earthspin.number_text import plain, shown_unit
from earthspin.process import seconds_since_start
from earthspin.views.result_contents import Result, dataset_of, in_shown_units, question_of

#: Words for shares of an error whose names end otherwise.
WORDS = {"input": "inputs", "kernel": "positions"}


def closing_line(result: Result, computation_time: float | None = None) -> str:
    """One line of text with the error of the main number of a result, and the time that it took.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to a question. In a series, the largest error is given, with its place. The largest
        neglected effect is named if it is larger than the error.
    computation_time : float, optional
        Run time of the computation, s; that in the plan of the tree by default. The line gives
        first the wall time since this process began.

    Returns
    -------
    str
        Such as ``"precession rate: 95 % error 3.3e-5 arcsec/yr (method 1.3e-5, inputs 3e-5); 2.1 s,
        of it 0.03 s computation"``. Without an error it gives the reason.
    """
    answer = dataset_of(result)
    if isinstance(result, xr.DataTree) and "plan" in result.children:
        computation_time = float(result["plan"].computation_time)
    cost = "" if computation_time is None else run_time(computation_time)
    sections = *_of_sections(result), *_conditions(result)
    return "; ".join(filter(None, (_error(answer), *sections, cost)))


def run_time(computation_time: float) -> str:
    """Wall time since this process began, and the given run time of the computation, as text."""
    return run_time_words(seconds_since_start(), computation_time)


def _of_sections(result: Result) -> list[str]:
    """Largest values of numbers in sections whose attribute is `closing`, or where they are."""
    if (question := question_of(dataset_of(result))) is None:
        return []
    children = result.children if isinstance(result, xr.DataTree) else {}
    texts = []
    for name, parts in question.graph.sections.items():
        variables = {k: v for part in parts for k, v in question.graph.parts[part].gives.items()}
        closing = {key: v.attrs["closing"] for key, v in variables.items() if "closing" in v.attrs}
        if closing and name not in children:
            texts.append(f"{next(iter(closing.values()))}: --sections {name}")
        for key, words in closing.items() if name in children else ():
            value = children[name].to_dataset()[key]
            place = value[{value.dims[0]: int(np.nanargmax(value.values))}]
            size = plain(float(place)) + shown_unit(value.attrs["units"])
            at = _label(place, value.dims[0], 0)
            texts.append(f"{words}: largest 95 % error {size} at {at}")
    return texts


def _conditions(result: Result) -> list[str]:
    """Conditions of the errors in the sections of a result, each said once."""
    parts = result.children.values() if isinstance(result, xr.DataTree) else ()
    conditions: dict[str, str] = {}
    for name, error in (pair for part in parts for pair in part.data_vars.items()):
        if "condition" in error.attrs:
            conditions.setdefault(error.attrs["condition"], str(name).replace("_", " "))
    return [f"{name} holds for {condition}" for condition, name in conditions.items()]


def _error(answer: xr.Dataset) -> str:
    """Text with the largest 95 % error of the main number and its causes, or why none exists."""
    question = question_of(answer)
    if question is None or question.headline not in answer:
        return ""
    answer, name = in_shown_units(answer, question), question.headline
    value = answer[name]
    label = name.removesuffix("_error").replace("_", " ")
    error_name = error_of(answer, name)
    if not error_name:
        return f"{label}: no error: {value.attrs['no_error']}"
    if answer.sizes.get("perturber", 0) == 1 or "total" in answer.get("perturber", ()):
        answer = answer.isel(perturber=-1)
    value, error = answer[name], answer[error_name]
    if not np.isfinite(error).any():
        return f"{label}: no error: {error.attrs.get('no_error', 'it is not finite')}"
    largest = np.unravel_index(np.nanargmax(error.values), error.shape)
    place = {dim: int(index) for dim, index in zip(error.dims, largest, strict=True)}
    size, unit = float(error[place]), error.attrs["units"]
    shares = [
        f"{WORDS.get(name.split('_')[-1], name.split('_')[-1])} {plain(float(answer[name][place]))}"
        for name in question.graph.variables
        if name.startswith(f"{error_name}_") and name in answer
    ]
    relative = unit == "1" != value.attrs["units"]
    text = f"{label}: {'largest ' if place else ''}{'relative ' if relative else ''}95 % error "
    text += plain(size) + shown_unit(unit)
    text += f" ({', '.join(shares)})" if shares else ""
    if place:
        text += f" at {', '.join(_label(error[place], dim, index) for dim, index in place.items())}"
    if relative:
        size *= float(np.abs(value).max())
        unit = value.attrs["units"]
    effect, left_out, its_unit = largest_of(answer.attrs.get("neglected", "")) or ("", 0.0, "1")
    left_out *= from_si(unit) / from_si(its_unit)
    if abs(left_out) > size:
        text += f"; not modelled: {effect}, {plain(left_out)}{shown_unit(unit)}"
    return text


def _label(point: xr.DataArray, dim: Hashable, index: int) -> str:
    """Coordinate label of a point along a dimension, as text; the index if there are no labels."""
    if dim not in point.coords:
        return f"{dim} {index}"
    label = point[dim]
    if label.dtype.kind == "M":
        return str(label.values.astype("M8[D]"))
    if label.dtype.kind in "fiu":
        return f"{dim} {float(label):.9g}{shown_unit(label.attrs.get('units', '1'))}"
    return str(label.item())

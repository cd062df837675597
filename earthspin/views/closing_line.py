"""Read sections and attributes of a result, and describe its error and run time in one line."""

from __future__ import annotations

from collections.abc import Hashable, Mapping

import numpy as np
import xarray as xr

from earthspin.bodies import in_a_sentence
from earthspin.engine.accessor import Answer
from earthspin.engine.question import Question
from earthspin.engine.run import IMPORTS
from earthspin.engine.variables import error_of, from_si, largest_of
from earthspin.errors import listed
from earthspin.number_text import plain, shown_unit
from earthspin.scenes import QUESTIONS, run_tree

#: A plain answer, or one with sections beside it.
Result = xr.Dataset | xr.DataTree


def answer_of(result: Result) -> xr.Dataset:
    """Return the main Dataset of a result; of several bodies or initial states, only the first."""
    whole = result.to_dataset() if isinstance(result, xr.DataTree) else result
    return _first_case(whole, whole.attrs)


def question_of(result: Result) -> type[Question] | None:
    """Return the `Question` class (type of computation) of a result; None for an unknown type."""
    return QUESTIONS.get(result.attrs["compute"])


def section(result: Result, name: str) -> xr.Dataset | None:
    """Return the section (Dataset) of a result with the given name, or None if there is none."""
    if not isinstance(result, xr.DataTree) or name not in result.children:
        return None
    return _first_case(Answer(result).section(name), result.attrs)


def needed(result: Result, name: str) -> xr.Dataset:
    """Return the section (Dataset) of a result with the given name; compute it if it is missing.

    Raises
    ------
    SceneError
        If the question has no such section, or the section does not apply; the error says why.
    """
    data = section(result, name)
    if data is None:
        data = section(run_tree(result, [name]), name)
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
    declared = {n: v for part in question.graph.parts.values() for n, v in part.gives.items()}
    known = {"effect", "part", *question.graph.labels}
    first = data.isel({dim: 0 for dim in data.dims if dim not in known}).copy()
    for name in first.variables.keys() & declared.keys():
        first[name].attrs |= {"short": declared[str(name)].short}
    return first


# --- line that closes the output -----------------------------------------------------------------


#: Endings of the names of shares of an error, and the words for endings that are not shown as such.
SHARES = ("method", "input", "kernel", "response", "satellites")
WORDS = {"input": "inputs", "kernel": "positions"}


def closing_line(result: Result, seconds: float | None = None) -> str:
    """One line of text with the error of the main number of a result, and the run time.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to a question. In a series, the largest error is given, with its place. The largest
        neglected effect is named if it is larger than the error.
    seconds : float, optional
        Run time, s; that of the parts in the plan of the tree by default.

    Returns
    -------
    str
        Such as ``"precession rate: 95 % error 3.3e-5 arcsec/yr (method 1.3e-5, inputs 3e-5); 0.09 s
        (+ 0.5 s imports)"``. Without an error it gives the reason.
    """
    answer = result.to_dataset() if isinstance(result, xr.DataTree) else result
    cost = "" if seconds is None else f"{plain(seconds)} s"
    if isinstance(result, xr.DataTree) and "plan" in result.children:
        run_time = result["plan"].run_time
        imports = float(run_time.sel(part=IMPORTS)) if IMPORTS in run_time.part else 0.0
        cost = f"{plain(float(run_time.sum()) - imports)} s (+ {plain(imports)} s imports)"
    return "; ".join(filter(None, (_error(answer), cost)))


def _error(answer: xr.Dataset) -> str:
    """Text with the largest 95 % error of the main number and its causes, or why none exists."""
    question = question_of(answer)
    if question is None or question.headline not in answer:
        return ""
    name = question.headline
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
        f"{WORDS.get(share, share)} {plain(float(answer[f'{error_name}_{share}'][place]))}"
        for share in SHARES
        if f"{error_name}_{share}" in answer
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
    if abs(left_out) / from_si(its_unit) > size / from_si(unit):
        text += f"; not modelled: {effect}, {plain(left_out)}{shown_unit(its_unit)}"
    return text


def _label(point: xr.DataArray, dim: Hashable, index: int) -> str:
    """Coordinate label of a point along a dimension, as text; the index if there are no labels."""
    if dim not in point.coords:
        return f"{dim} {index}"
    label = point[dim]
    if label.dtype.kind == "M":
        return str(label.values.astype("M8[D]"))
    if label.dtype.kind in "fiu":
        return f"{dim} {plain(float(label))}{shown_unit(label.attrs.get('units', '1'))}"
    return str(label.item())

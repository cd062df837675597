"""Compute the answer to a question: once, for each ensemble member, or with sampled errors."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from earthspin.engine.ensemble import Ensemble
from earthspin.engine.members import MEMBER, Members
from earthspin.engine.question import NEGLECTED, Question
from earthspin.engine.run import ALL, Run
from earthspin.errors import SceneError

if TYPE_CHECKING:
    import xarray as xr


#: Default number of members of a sample.
MEMBERS = 1000
#: Quantiles at the ends of the central 95 % interval.
_ENDS = (0.025, 0.975)
_NO_ERROR = "no number of this answer has an error that can be sampled; leave it out"


def answer(question: Question) -> xr.Dataset:
    """Compute the answer to a question, as a Dataset.

    Parameters
    ----------
    question : Question

    Returns
    -------
    Dataset
        With dimension `member` if the question has members; with sampled errors if
        ``uncertainty = "sample"``.

    Raises
    ------
    EarthspinError
        If the question cannot be answered; the message is one line.
    """
    if question.members is not None:
        return Ensemble(question, in_memory=True).hold()
    result = Run(question).answer()
    return _with_sample(question, result) if question.uncertainty == "sample" else result


def answer_tree(question: Question, sections: str | Iterable[str] = ALL) -> xr.DataTree:
    """Compute the answer to a question, and return it with the requested sections as a DataTree.

    An ensemble has only the sections `plan` and `neglected`.

    Parameters
    ----------
    question : Question
    sections : str or iterable of str
        Names, or ``"all"``.

    Raises
    ------
    EarthspinError
        If the question cannot be answered, or another section of an ensemble is requested.
    """
    import xarray as xr

    if question.members is not None:
        named = [sections] if isinstance(sections, str) else [*sections]
        if not {*named} <= {ALL, NEGLECTED}:
            problem = f"an ensemble has only the section '{NEGLECTED}'; request that or none"
            raise SceneError("sections", sections, problem)
        work = Ensemble(question, in_memory=True)
        nodes = {"/": work.hold(), "plan": work.nominal_run.plan().dataset()}
        if named:
            nodes[NEGLECTED] = work.nominal_run.tree(NEGLECTED)[NEGLECTED].to_dataset()
        return xr.DataTree.from_dict(nodes)
    tree = Run(question).tree(sections)
    if question.uncertainty == "sample":
        tree.dataset = _with_sample(question, tree.to_dataset())
    return tree


def _with_sample(question: Question, answer: xr.Dataset) -> xr.Dataset:
    """Add to a result the errors that follow from a random sample of its inputs.

    Parameters
    ----------
    question : Question
        With ``uncertainty = "sample"``.
    answer : Dataset

    Returns
    -------
    Dataset
        The answer with a variable ``<name>_error_sampled`` for each number with an error, its own
        or one that it shares with other numbers: half the width of the central 95 % interval of
        the members. Its attributes hold the largest difference from the linear error if that has
        the same unit, and the largest difference between the median of the sample and the value.

    Raises
    ------
    EarthspinError
        If the members cannot be computed, or no number of the answer has an error.
    """
    linear_errors = {
        str(name): error
        for name, array in answer.data_vars.items()
        if array.dtype.kind == "f"
        and (error := _linear_error(answer, str(name))) is not None
        # the error of a vector is an angle or a length, not that of a component
        and not {*array.dims}.difference(error.dims) & {"component", "quaternion"}
    }
    if not linear_errors:
        raise question.error("uncertainty", "sample", _NO_ERROR)
    plain = question.replace(uncertainty=None, n=None)
    count = MEMBERS if question.n is None else question.n
    members = Members(n=count, published=True)
    sample = Ensemble(plain.replace(members=members), in_memory=True).hold()
    sampled: dict[str, Any] = {}
    for name, linear in linear_errors.items():
        values = sample[name]
        if MEMBER not in values.dims:
            width, shift = np.zeros(answer[name].shape), 0.0
        else:
            low, middle, high = np.quantile(values.values, (_ENDS[0], 0.5, _ENDS[1]), axis=0)
            width = (high - low) / 2
            shift = float(np.max(np.abs(middle - answer[name].values)))
        units = answer[name].attrs.get("units", "1")
        attrs = {
            "long_name": f"95 % half-width of the {answer[name].attrs['long_name']} from "
            f"{count} members",
            "units": units,
            "members": count,
            "middle_of_the_sample": f"{shift:.3g} {units} at most from {name}",
        }
        if linear.attrs.get("units") == units and linear.dims == answer[name].dims:
            difference = float(np.max(np.abs(linear.values - width), initial=0.0))
            words = f"{difference:.3g} {units} at most from {linear.name}"
            attrs["difference_from_linear"] = words
        sampled[f"{name}_error_sampled"] = (answer[name].dims, width, attrs)
    inputs = ", ".join(str(c.attrs["input"]) for c in sample.coords.values() if "input" in c.attrs)
    summary = {"sampled": f"{count} members in {inputs}"}
    return answer.assign(sampled).assign_attrs(summary)


def _linear_error(answer: xr.Dataset, name: str) -> xr.DataArray | None:
    """Linear error of a number: from its inputs, its own, or one shared with other numbers."""
    shared = str(answer[name].attrs.get("ancillary_variables", "")).split()
    names = (f"{name}_error_input", f"{name}_error", *shared)
    return next((answer[error] for error in names if error in answer), None)

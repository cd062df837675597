"""Answer a question: for one, for many, or for one with the errors of a sample."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from earthspin.engine.ensemble import Ensemble
from earthspin.engine.given import MEMBER
from earthspin.engine.members import Members
from earthspin.engine.plan import ALL, plan_parts
from earthspin.engine.question import NEGLECTED, Question
from earthspin.engine.run import run_parts
from earthspin.errors import SceneError

if TYPE_CHECKING:
    import xarray as xr


#: How many members are drawn if nothing says it.
MEMBERS = 1000
#: Ends of the central 95 %.
_ENDS = (0.025, 0.975)


def answer(question: Question) -> xr.Dataset:
    """Answer a question.

    Parameters
    ----------
    question : Question

    Returns
    -------
    Dataset
        Along `member` if it is asked for members; with the errors of a sample if these are asked
        for.

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line.
    """
    if question.members is not None:
        return Ensemble(question).hold()
    result = run_parts(plan_parts(question)).answer()
    return _with_sample(question, result) if question.uncertainty == "sample" else result


def answer_tree(question: Question, sections: str | Iterable[str] = ALL) -> xr.DataTree:
    """Answer a question with sections; for many the answer, the plan, and what is neglected.

    Parameters
    ----------
    question : Question
    sections : str or iterable of str
        Names, or ``"all"``.

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line; among it a section of an ensemble.
    """
    import xarray as xr

    if question.members is not None:
        named = [sections] if isinstance(sections, str) else [*sections]
        if not {*named} <= {ALL, NEGLECTED}:
            words = f"an ensemble tells its answer, and of its sections '{NEGLECTED}' alone"
            raise SceneError("sections", sections, words)
        work = Ensemble(question)
        nodes = {"/": work.hold(), "plan": work.plan_data()}
        if named:
            single = work.variants.question(work.words(0))
            nodes[NEGLECTED] = answer_tree(single, NEGLECTED)[NEGLECTED].to_dataset()
        return xr.DataTree.from_dict(nodes)
    tree = run_parts(plan_parts(question, sections)).tree()
    if question.uncertainty == "sample":
        tree.dataset = _with_sample(question, tree.to_dataset())
    return tree


def _with_sample(question: Question, answer: xr.Dataset) -> xr.Dataset:
    """Give beside each linear error of an answer that of a sample.

    Parameters
    ----------
    question : Question
        With ``uncertainty = "sample"``.
    answer : Dataset

    Returns
    -------
    Dataset
        The answer; for each ``<name>_error`` there is ``<name>_error_sampled``, the half-width of
        the central 95 % of the members, whose attributes say how far the linear error of the same
        numbers is from it, at most, and by how much the middle of the sample is off.

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line.
    """
    plain = question.replace(uncertainty=None, n=None)
    count = MEMBERS if question.n is None else question.n
    sample = Ensemble(plain.replace(members=Members(n=count, published=True))).hold()
    beside: dict[str, Any] = {}
    for name in map(str, answer.data_vars):
        linear = answer.get(f"{name}_error_input", answer.get(f"{name}_error"))
        if linear is None or answer[name].dtype.kind != "f" or linear.dims != answer[name].dims:
            continue
        values = sample[name]
        if MEMBER not in values.dims:
            width, shift = np.zeros(answer[name].shape), 0.0
        else:
            low, middle, high = np.quantile(values.values, (_ENDS[0], 0.5, _ENDS[1]), axis=0)
            width = (high - low) / 2
            shift = float(np.max(np.abs(middle - answer[name].values)))
        units = answer[name].attrs.get("units", "1")
        difference = float(np.max(np.abs(linear.values - width), initial=0.0))
        attrs = {
            "long_name": f"95 % half-width of the {answer[name].attrs['long_name']} from "
            f"{count} members",
            "units": units,
            "members": count,
            "difference_from_linear": f"{difference:.3g} {units} at most from {linear.name}",
            "middle_of_the_sample": f"{shift:.3g} {units} at most from {name}",
        }
        beside[f"{name}_error_sampled"] = (answer[name].dims, width, attrs)
    inputs = ", ".join(str(c.attrs["input"]) for c in sample.coords.values() if "input" in c.attrs)
    summary = {"sampled": f"{count} members in {inputs}"}
    return answer.assign(beside).assign_attrs(summary)

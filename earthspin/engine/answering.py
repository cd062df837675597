"""Answer a question: for one, for many, or for one with the errors of a sample."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from earthspin.engine.ensemble import Ensemble
from earthspin.engine.plan import ALL, plan_parts
from earthspin.engine.question import NEGLECTED, Question
from earthspin.engine.run import run_parts
from earthspin.engine.sampled import with_sample
from earthspin.errors import SceneError

if TYPE_CHECKING:
    import xarray as xr


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
    return with_sample(question, result) if question.uncertainty == "sample" else result


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
        tree.dataset = with_sample(question, tree.to_dataset())
    return tree

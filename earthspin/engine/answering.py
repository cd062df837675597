"""Answer a question: for one, for many, or for one with the errors of a sample."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from earthspin.engine import run as running
from earthspin.engine.ensemble import Ensemble
from earthspin.engine.question import NEGLECTED, Question
from earthspin.engine.sampled import with_sample
from earthspin.errors import SceneError

if TYPE_CHECKING:
    import xarray as xr


def run(question: Question) -> xr.Dataset:
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
    if question.uncertainty == "sample":
        return with_sample(question, running.run(question))
    return running.run(question)


def run_tree(question: Question, sections: str | Iterable[str] = "all") -> xr.DataTree:
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
        if not {*named} <= {"all", NEGLECTED}:
            words = f"an ensemble tells its answer, and of its sections '{NEGLECTED}' alone"
            raise SceneError("sections", sections, words)
        work = Ensemble(question)
        nodes = {"/": work.hold(), "plan": work.plan_data()}
        if named:
            beside = running.run_tree(work.variants.question(work.words(0)), NEGLECTED)
            nodes[NEGLECTED] = beside[NEGLECTED].to_dataset()
        return xr.DataTree.from_dict(nodes)
    tree = running.run_tree(question, sections)
    if question.uncertainty == "sample":
        tree.dataset = with_sample(question, tree.to_dataset())
    return tree

"""Run and judge every stiff and extreme case, and return the verdicts as one dataset."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from typing import TYPE_CHECKING

from earthspin._version import __version__
from earthspin.checks.case import Case, Outcome, judge
from earthspin.engine.labels import CONVENTIONS
from earthspin.engine.variables import Labels, Value, Variables, labels, number, words
from earthspin.errors import SceneError, nearest
from earthspin.progress import progress

if TYPE_CHECKING:
    import xarray as xr

#: Parts of the package that have cases, in the order in which they run.
PARTS = (
    "numerics", "mass", "rotor", "top", "torque", "motion", "rotation", "secular", "wobble",
    "nutation", "sky", "scene", "many", "units", "storage",
)  # fmt: skip

_UNIT = "in the unit that 'unit' names for the case"


class Cases(Variables, along=("case",)):
    """Cases and their outcomes."""

    measured: Value = words("distance from what the case is held against", comment=_UNIT)
    bound: Value = words("largest distance that holds", comment=_UNIT)
    unit: Value = words("unit of the distance and its bound")
    verdict: Value = words("holds, refused or fails")
    must_hold: Value = words("whether only an answer will do")
    case_part: Value = words("part of the package that is tried")
    hard_because: Value = words("what makes it hard")
    held_against: Value = words("invariant, or independent reference")
    reason: Value = words("why it was refused, or fails")
    run_time: Value = number("s", "run time of the case")
    case: Labels = labels("stiff or extreme case")


def stability(*, quick: bool = False, only: str | None = None, long: bool = False) -> xr.Dataset:
    """Run the stiff and extreme cases.

    Parameters
    ----------
    quick : bool
        Leave out those that take more than a moment.
    only : str, optional
        A part (``"motion"``), or a word in the names of the cases that are wanted.
    long : bool
        Also run those that take minutes.

    Returns
    -------
    Dataset
        Over `case`: `measured`, `bound` and their `unit`; `verdict` (``holds``, ``refused``,
        ``fails``); `must_hold`; `case_part`, `hard_because`, `held_against`, `reason`,
        `run_time` (s). Where a refusal was expected and came, `measured` and `bound` are 0 and
        `reason` is its line.

    Raises
    ------
    SceneError
        If no case has that word.

    Examples
    --------
    >>> import earthspin
    >>> verdicts = earthspin.stability(only="sleeping top").verdict
    >>> print(sorted(set(verdicts.values.tolist())))
    ['holds']
    """
    cases = chosen_cases(quick=quick, only=only, long=long)
    outcomes = []
    with progress("stability", len(cases)) as advance:
        for case in cases:
            outcomes.append(judge(case))
            advance(1)
    return labelled(cases, outcomes)


def all_cases() -> tuple[Case, ...]:
    """Return every case, in the order of `PARTS` and of definition."""
    modules = (import_module(f"earthspin.checks.cases.{part}") for part in PARTS)
    return tuple(c for module in modules for c in vars(module).values() if isinstance(c, Case))


def chosen_cases(
    *, quick: bool = False, only: str | None = None, long: bool = False
) -> tuple[Case, ...]:
    """Return the cases that a run takes; arguments as of `stability`.

    Raises
    ------
    SceneError
        If there are none.
    """
    cases = every = all_cases()
    for name, value in (("quick", quick), ("long", long)):
        if not isinstance(value, bool):
            raise SceneError(name, value, "give True or False", source="stability")
    if only is not None:
        if not isinstance(only, str):
            raise SceneError("only", only, "give a word", source="stability")
        word = only.lower()
        if word in PARTS:
            cases = tuple(c for c in every if c.part == word)
        else:
            cases = tuple(c for c in every if word in c.name.lower())
        if not word or not cases:
            words = {*PARTS, *(w for c in every for w in c.name.lower().split())}
            hint = nearest(only, words).split("allowed:")[0]
            allowed = f"give a part ({', '.join(PARTS)}) or a word of a case's name"
            reason = f"no case has that word; {hint}{allowed}"
            raise SceneError("only", only, reason, source="stability")
    cases = tuple(c for c in cases if (long or not c.long) and not (quick and c.slow))
    if not cases:
        reason = "its cases take long; leave out --quick, or add --long"
        raise SceneError("only", only, reason, source="stability")
    return cases


def labelled(cases: Sequence[Case], outcomes: Sequence[Outcome]) -> xr.Dataset:
    """Return the dataset of cases and their outcomes."""
    # the bound of an outcome replaces that of its case
    rows = [
        {"case_part": case.part, "must_hold": case.must_hold} | vars(case) | vars(outcome)
        for case, outcome in zip(cases, outcomes, strict=True)
    ]
    columns = {name: [row[name] for row in rows] for name in Cases.schema}
    result = Cases(**columns, case=[case.name for case in cases]).dataset()
    result.attrs = {
        "Conventions": CONVENTIONS,
        "title": "Stiff and extreme cases",
        "source": f"earthspin {__version__}",
        "earthspin_version": __version__,
    }
    return result

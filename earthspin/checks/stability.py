"""Run the stiff and extreme test cases, and return their verdicts as one Dataset."""

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

_UNIT = "in the unit of the case, see 'unit'"


class Cases(Variables, along=("case",)):
    """Variables of the dataset that `stability` returns: the outcome of each test case."""

    measured: Value = words("distance from the reference", comment=_UNIT)
    bound: Value = words("largest allowed distance", comment=_UNIT)
    unit: Value = words("unit of the distance and its bound")
    verdict: Value = words("verdict: holds, refused or fails")
    must_hold: Value = words("whether an answer is expected, not a refusal")
    case_part: Value = words("part of the package")
    hard_because: Value = words("reason why the case is hard")
    held_against: Value = words("reference: invariant or independent method")
    reason: Value = words("message of the refusal, or reason of the failure")
    run_time: Value = number("s", "run time of the case")
    case: Labels = labels("stiff or extreme case")


def stability(*, quick: bool = False, only: str | None = None, long: bool = False) -> xr.Dataset:
    """Run the stiff and extreme test cases of the self-checks.

    Parameters
    ----------
    quick : bool
        Omit the cases that take seconds.
    only : str, optional
        Run only the cases of a part (``"motion"``), or with this text in their names.
    long : bool
        Also run the cases that take minutes.

    Returns
    -------
    Dataset
        Along `case`: `measured`, `bound` and their `unit`; `verdict` (``holds``, ``refused``,
        ``fails``); `must_hold`; `case_part`, `hard_because`, `held_against`, `reason`,
        `run_time` (s). After an expected refusal, `measured` and `bound` are 0 and `reason` is the
        message.

    Raises
    ------
    SceneError
        If no case matches `only`.

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
    """Return all stiff and extreme test cases, ordered by part of the package."""
    modules = (import_module(f"earthspin.checks.cases.{part}") for part in PARTS)
    return tuple(c for module in modules for c in vars(module).values() if isinstance(c, Case))


def chosen_cases(
    *, quick: bool = False, only: str | None = None, long: bool = False
) -> tuple[Case, ...]:
    """Return the test cases that the arguments `quick`, `only` and `long` select.

    Raises
    ------
    SceneError
        If no case is selected.
    """
    cases = every = all_cases()
    for name, value in (("quick", quick), ("long", long)):
        if not isinstance(value, bool):
            raise SceneError(name, value, "give True or False", source="stability")
    if only is not None:
        if not isinstance(only, str):
            raise SceneError("only", only, "give text", source="stability")
        word = only.lower()
        if word in PARTS:
            cases = tuple(c for c in every if c.part == word)
        else:
            cases = tuple(c for c in every if word in c.name.lower())
        if not word or not cases:
            known = {*PARTS, *(w for c in every for w in c.name.lower().split())}
            hint = nearest(only, known).split("allowed:")[0]
            allowed = f"give a part ({', '.join(PARTS)}) or a word of a case's name"
            reason = f"no case has that word; {hint}{allowed}"
            raise SceneError("only", only, reason, source="stability")
    cases = tuple(c for c in cases if (long or not c.long) and not (quick and c.slow))
    if not cases:
        reason = "these cases take long; remove --quick, or add --long"
        raise SceneError("only", only, reason, source="stability")
    return cases


def labelled(cases: Sequence[Case], outcomes: Sequence[Outcome]) -> xr.Dataset:
    """Make a dataset of test cases and their outcomes, labelled by the name of the case."""
    # The later keys win: the bound of an outcome replaces that of its case.
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

"""What a stiff or extreme case is, and how it is judged.

A case measures how far a result is from what it is held against: an invariant, a closed form,
another method. It runs with every warning and every overflow, division by zero and invalid
operation of numpy made an error, so that nothing slips by unseen. It is written as

    @CASES.case("what is tried")
    @hard_because("what makes it extreme")
    @held_against("what it has to agree with", bound=1e-14, unit="rad")
    def _name() -> Distances:
        yield found - true

and one that has no answer with ``@refused("words of the refusal")`` in place of the third line.
"""

from __future__ import annotations

import math
import time
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from earthspin.errors import EarthspinError, UndefinedError

HOLDS, REFUSED, FAILS = "holds", "refused", "fails"

#: What a measure yields: numbers or arrays, the largest of whose sizes is the distance.
Distances = Iterable[ArrayLike]
Measure = Callable[[], Distances | None]

#: What later versions of a library will change is none of a case's business.
_NOT_NUMERICAL = (DeprecationWarning, PendingDeprecationWarning, FutureWarning, ImportWarning)


@dataclass(frozen=True, kw_only=True)
class Case:
    """One stiff or extreme case.

    Attributes
    ----------
    measure : callable
        Yields distances from the reference; that of a refusal gives nothing.
    held_against : str
        The invariant or the independent reference; for a refusal, what it must say.
    hard_because : str
        What makes it hard.
    name : str
        In plain words, like no other.
    part : str
        Of the package.
    unit : str
        Of that distance; "1" for a pure number.
    bound : float
        Largest distance that holds.
    must_hold : bool
        Whether only an answer will do; not so where a refusal is what is expected.
    refusal : str
        Words that an expected refusal holds; empty where an answer is expected.
    slow : bool
        Left out of a quick run.
    long : bool
        Run only when it is asked for.
    """

    measure: Measure
    held_against: str
    hard_because: str = ""
    name: str = ""
    part: str = ""
    unit: str = "1"
    bound: float = 0.0
    must_hold: bool = True
    refusal: str = ""
    slow: bool = False
    long: bool = False


@dataclass(frozen=True)
class Outcome:
    """How a case went.

    Attributes
    ----------
    measured, bound : float
        Both 0 where a refusal was expected and came; `measured` is infinite where a case that
        fails gave no number. Never NaN.
    verdict : str
        ``"holds"``, ``"refused"`` or ``"fails"``.
    reason : str
        The line of a refusal, or why it fails; empty if it holds.
    run_time : float
        s.
    """

    measured: float
    bound: float
    verdict: str
    reason: str
    run_time: float


def judge(case: Case) -> Outcome:
    """Run a case and judge it.

    Parameters
    ----------
    case : Case

    Returns
    -------
    Outcome
        ``holds`` if the distance is finite and within the bound. ``refused`` if a refusal was
        expected and came in the expected words, or if one came where the case may be refused.
        ``fails`` for all else: a NaN, a warning, an overflow, an exception, an answer where a
        refusal was due.
    """
    begun = time.perf_counter()
    measured, verdict, reason = _verdict(case)
    bound = 0.0 if verdict == REFUSED else case.bound
    return Outcome(measured, bound, verdict, reason, time.perf_counter() - begun)


def _verdict(case: Case) -> tuple[float, str, str]:
    try:
        with warnings.catch_warnings(), np.errstate(over="raise", invalid="raise", divide="raise"):
            warnings.simplefilter("error")
            for kind in _NOT_NUMERICAL:
                warnings.simplefilter("ignore", kind)
            warnings.filterwarnings("ignore", message="numpy.ndarray size changed")
            given = case.measure()
            sizes = [] if given is None else [float(np.max(np.abs(one))) for one in given]
    except EarthspinError as error:
        return _on_refusal(case, str(error))
    except Exception as error:  # whatever else comes out is a defect, which is to be reported
        return math.inf, FAILS, _one_line(f"{type(error).__name__}: {error}")
    if case.refusal:
        return math.inf, FAILS, f"it answered where a refusal was due ('{case.refusal}')"
    if not sizes:
        return math.inf, FAILS, "it gave no distance"
    measured = float(np.max(sizes))  # NaN if any of them is
    if math.isnan(measured):
        return math.inf, FAILS, "it gave a NaN"
    if measured <= case.bound:
        return measured, HOLDS, ""
    return measured, FAILS, f"{measured:.3g} is beyond the bound of {case.bound:.3g}"


def _on_refusal(case: Case, line: str) -> tuple[float, str, str]:
    if "\n" in line:
        return math.inf, FAILS, f"the refusal is not one line: {_one_line(line)}"
    if case.must_hold:
        return math.inf, FAILS, f"it was refused: {line}"
    if case.refusal not in line:
        return math.inf, FAILS, f"the refusal does not say '{case.refusal}': {line}"
    return 0.0, REFUSED, line


def _one_line(text: str) -> str:
    return " ".join(text.split())


def apart(found: ArrayLike, true: ArrayLike) -> float:
    """Largest difference of two arrays, over the largest size of the second."""
    return float(np.max(np.abs(np.subtract(found, true))) / np.max(np.abs(true)))


@contextmanager
def without_folder(path: Path) -> Iterator[None]:
    """Let a refusal name a file without the folder that it happens to lie in.

    Parameters
    ----------
    path : Path
    """
    try:
        yield
    except EarthspinError as error:
        raise UndefinedError(str(error).replace(str(path), path.name)) from None


def held_against(reference: str, *, bound: float, unit: str = "1") -> Callable[[Measure], Case]:
    """Make a measure a case that must hold: its distance from the reference is within a bound."""
    return lambda measure: Case(measure=measure, held_against=reference, bound=bound, unit=unit)


def refused(saying: str) -> Callable[[Measure], Case]:
    """Make a measure a case that must be refused in these words."""
    told = f"a refusal in one line that says '{saying}'"
    return lambda measure: Case(measure=measure, held_against=told, must_hold=False, refusal=saying)


def hard_because(reason: str) -> Callable[[Case], Case]:
    """Say what makes a case hard."""
    return lambda case: replace(case, hard_because=reason)


class Cases(list[Case]):
    """The cases of one part, added where they are defined.

    Parameters
    ----------
    part : str
    """

    def __init__(self, part: str) -> None:
        super().__init__()
        self.part = part

    def case(self, name: str, *, slow: bool = False, long: bool = False) -> Callable[[Case], Case]:
        """Add what follows under a name; arguments as of `Case`."""

        def add(case: Case) -> Case:
            self.append(replace(case, name=name, part=self.part, slow=slow, long=long))
            return self[-1]

        return add

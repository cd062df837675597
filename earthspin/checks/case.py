"""What a stiff or extreme case is, and how it is judged.

A case measures how far a result is from what it is held against: an invariant, a closed form,
another method. It runs with every warning and every overflow, division by zero and invalid
operation of numpy made an error, so that nothing slips by unseen.
"""

from __future__ import annotations

import math
import time
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from earthspin.errors import EarthspinError, UndefinedError

HOLDS, REFUSED, FAILS = "holds", "refused", "fails"

#: What later versions of a library will change is none of a case's business.
_NOT_NUMERICAL = (DeprecationWarning, PendingDeprecationWarning, FutureWarning, ImportWarning)


@dataclass(frozen=True, kw_only=True)
class Case:
    """One stiff or extreme case.

    Attributes
    ----------
    name : str
        In plain words, like no other.
    part : str
        Of the package.
    hard_because : str
        What makes it hard.
    held_against : str
        The invariant or the independent reference; for a refusal, what it must say.
    measure : callable
        Gives the distance from the reference; that of a refusal gives nothing.
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

    name: str
    part: str
    hard_because: str
    held_against: str
    measure: Callable[[], Any]
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
            answer = case.measure()
    except EarthspinError as error:
        return _on_refusal(case, str(error))
    except Exception as error:  # whatever else comes out is a defect, which is to be reported
        return math.inf, FAILS, _one_line(f"{type(error).__name__}: {error}")
    if case.refusal:
        return math.inf, FAILS, f"it answered where a refusal was due ('{case.refusal}')"
    return _on_answer(case, answer)


def _on_answer(case: Case, answer: Any) -> tuple[float, str, str]:
    try:
        measured = float(answer)
    except (TypeError, ValueError):
        return math.inf, FAILS, f"it gave no number but {type(answer).__name__}"
    if math.isnan(measured):
        return math.inf, FAILS, "it gave a NaN"
    if abs(measured) <= case.bound:
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


class Cases(list[Case]):
    """The cases of one part, added where they are defined.

    Parameters
    ----------
    part : str
    """

    def __init__(self, part: str) -> None:
        super().__init__()
        self.part = part

    def hold(
        self,
        name: str,
        *,
        because: str,
        against: str,
        bound: float,
        unit: str = "1",
        **rest: Any,
    ) -> Callable[[Callable[[], Any]], Callable[[], Any]]:
        """Add what follows as a case that must hold; arguments as of `Case`."""

        def add(measure: Callable[[], Any]) -> Callable[[], Any]:
            self.append(
                Case(
                    name=name,
                    part=self.part,
                    hard_because=because,
                    held_against=against,
                    measure=measure,
                    unit=unit,
                    bound=bound,
                    **rest,
                )
            )
            return measure

        return add

    def refuse(
        self, name: str, *, because: str, saying: str, **rest: Any
    ) -> Callable[[Callable[[], Any]], Callable[[], Any]]:
        """Add what follows as a case that must be refused in these words."""

        def add(measure: Callable[[], Any]) -> Callable[[], Any]:
            self.append(
                Case(
                    name=name,
                    part=self.part,
                    hard_because=because,
                    held_against=f"a refusal in one line that says '{saying}'",
                    measure=measure,
                    must_hold=False,
                    refusal=saying,
                    **rest,
                )
            )
            return measure

        return add

"""A stiff or extreme case, and how it is judged.

A case measures how far a result is from what it is held against: an invariant, a closed form,
another method. It runs with every warning and every overflow, division by zero and invalid
operation of numpy made an error. A case that must have an answer is a function that yields
distances, and its docstring holds the words:

    @holds(bound=1e-14, unit="rad")
    def _name() -> Distances:
        \"\"\"what is tried

        Hard because: what makes it extreme
        Held against: what it has to agree with
        \"\"\"
        yield result - reference

A case without an answer has ``@refused("words of the refusal")`` and no line "Held against".
"""

from __future__ import annotations

import math
import tempfile
import time
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from earthspin.errors import EarthspinError, UndefinedError

FloatArray = NDArray[np.float64]

HOLDS, REFUSED, FAILS = "holds", "refused", "fails"

#: What a measure yields: numbers or arrays, the largest of whose sizes is the distance.
Distances = Iterable[ArrayLike]
Measure = Callable[[], Distances | None]

#: Warnings about later versions of a library, which do not concern a case.
_NOT_NUMERICAL = (DeprecationWarning, PendingDeprecationWarning, FutureWarning, ImportWarning)


@dataclass(frozen=True, kw_only=True)
class Case:
    """One stiff or extreme case.

    Attributes
    ----------
    measure : callable
        Yields distances from the reference; the measure of a refusal returns None.
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
    refusal: str = ""
    slow: bool = False
    long: bool = False

    @property
    def must_hold(self) -> bool:
        """Whether only an answer will do; False where a refusal is expected."""
        return not self.refusal


def holds(
    *, bound: float, unit: str = "1", slow: bool = False, long: bool = False
) -> Callable[[Measure], Case]:
    """Make a measure a case that must hold within a bound; arguments as of `Case`."""
    return partial(_case, bound=bound, unit=unit, slow=slow, long=long)


def refused(words: str) -> Callable[[Measure], Case]:
    """Make a measure a case that must be refused in a line that holds these words."""
    return partial(_case, refusal=words)


def _case(measure: Measure, refusal: str = "", **numbers: Any) -> Case:
    """Take name, difficulty and reference of a case from the docstring of its measure."""
    name, _, rest = (measure.__doc__ or measure.__name__).partition("Hard because:")
    why, _, reference = rest.partition("Held against:")
    if refusal:
        reference = f"a refusal in one line that says '{refusal}'"
    return Case(
        measure=measure, part=measure.__module__.rpartition(".")[2], name=_one_line(name),
        hard_because=_one_line(why), held_against=_one_line(reference), refusal=refusal, **numbers,
    )  # fmt: skip


@dataclass(frozen=True)
class Outcome:
    """Outcome of a case.

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
        expected and came in the expected words.
        ``fails`` for all else: a NaN, a warning, an overflow, an exception, an answer where a
        refusal was due.
    """
    begin = time.perf_counter()
    measured, verdict, reason = _verdict(case)
    bound = 0.0 if verdict == REFUSED else case.bound
    return Outcome(measured, bound, verdict, reason, time.perf_counter() - begin)


def _verdict(case: Case) -> tuple[float, str, str]:
    try:
        with warnings.catch_warnings(), np.errstate(over="raise", invalid="raise", divide="raise"):
            warnings.simplefilter("error")
            for kind in _NOT_NUMERICAL:
                warnings.simplefilter("ignore", kind)
            warnings.filterwarnings("ignore", message="numpy.ndarray size changed")
            distances = case.measure()
            sizes = [] if distances is None else [float(np.max(np.abs(d))) for d in distances]
    except EarthspinError as error:
        return _refusal_verdict(case, str(error))
    except Exception as error:  # any other exception is a defect, which is to be reported
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


def _refusal_verdict(case: Case, line: str) -> tuple[float, str, str]:
    if "\n" in line:
        return math.inf, FAILS, f"the refusal is not one line: {_one_line(line)}"
    if case.must_hold:
        return math.inf, FAILS, f"it was refused: {line}"
    if case.refusal not in line:
        return math.inf, FAILS, f"the refusal does not say '{case.refusal}': {line}"
    return 0.0, REFUSED, line


def _one_line(text: str) -> str:
    return " ".join(text.split())


def relative_error(values: ArrayLike, reference: ArrayLike) -> float:
    """Largest difference of two arrays, over the largest size of the second."""
    difference = np.max(np.abs(np.subtract(values, reference)))
    return float(difference / np.max(np.abs(reference)))


@contextmanager
def temporary(name: str) -> Iterator[Path]:
    """Give the path of a file in a temporary folder, which refusals name without that folder."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / name
        try:
            yield path
        except EarthspinError as error:
            raise UndefinedError(str(error).replace(str(path), name)) from None

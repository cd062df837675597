"""Stiff and extreme test cases of the self-checks, and how their results are judged.

A case measures the distance of a result from a reference: an invariant, a closed form or another
method. During a case, every warning and every overflow, division by zero and invalid operation of
numpy is an error. A case that must have an answer is a function that yields distances, with a
docstring of this form:

    @holds(bound=1e-14, unit="rad")
    def _name() -> Distances:
        \"\"\"name of the case

        Hard because: reason why it is extreme
        Compared with: reference
        \"\"\"
        yield result - reference

A case that must be refused has ``@refused("part of the message")`` and no line "Compared with".
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

#: Numbers or arrays that a measure yields; the distance is the largest absolute value.
Distances = Iterable[ArrayLike]
Measure = Callable[[], Distances | None]

#: Warnings about later versions of a library, which do not concern a case.
_NOT_NUMERICAL = (DeprecationWarning, PendingDeprecationWarning, FutureWarning, ImportWarning)


@dataclass(frozen=True, kw_only=True)
class Case:
    """One stiff or extreme test case of the self-checks.

    Attributes
    ----------
    measure : callable
        Function that yields distances from the reference; for a refusal, it returns None.
    held_against : str
        The invariant or the independent reference; for a refusal, part of the message.
    hard_because : str
        Reason why the case is hard.
    name : str
        Unique name in plain words.
    part : str
        Part of the package.
    unit : str
        Unit of the distance; "1" for a pure number.
    bound : float
        Largest allowed distance.
    refusal : str
        Part of the message of an expected refusal; empty if an answer is expected.
    slow : bool
        True if a quick run omits the case.
    long : bool
        True if the case runs only on request.
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
        """Return True if this test case must give a result, False if it must raise an error."""
        return not self.refusal


def holds(
    *, bound: float, unit: str = "1", slow: bool = False, long: bool = False
) -> Callable[[Measure], Case]:
    """Decorator: make a `Case` of a function that yields errors, which must not exceed `bound`.

    The other arguments are those of `Case`.
    """
    return partial(_case, bound=bound, unit=unit, slow=slow, long=long)


def refused(message: str) -> Callable[[Measure], Case]:
    """Decorator: make a `Case` of a function that must raise an error containing `message`."""
    return partial(_case, refusal=message)


def _case(measure: Measure, refusal: str = "", **numbers: Any) -> Case:
    """Make a `Case` from a decorated function, whose docstring holds name, reason and reference."""
    name, _, rest = (measure.__doc__ or measure.__name__).partition("Hard because:")
    why, _, reference = rest.partition("Compared with:")
    if refusal:
        reference = f"a refusal in one line that says '{refusal}'"
    return Case(
        measure=measure, part=measure.__module__.rpartition(".")[2], name=_one_line(name),
        hard_because=_one_line(why), held_against=_one_line(reference), refusal=refusal, **numbers,
    )  # fmt: skip


@dataclass(frozen=True)
class Outcome:
    """Outcome of a test case: distance from the reference, verdict and run time.

    Attributes
    ----------
    measured, bound : float
        Measured and largest allowed distance; both 0 after an expected refusal. `measured` is
        infinite if a failed case gave no number, and is never NaN.
    verdict : str
        ``"holds"``, ``"refused"`` or ``"fails"``.
    reason : str
        Message of the refusal, or reason of the failure; empty if the case holds.
    run_time : float
        Run time, s.
    """

    measured: float
    bound: float
    verdict: str
    reason: str
    run_time: float


def judge(case: Case) -> Outcome:
    """Run a test case, and compare its result with the bound or its error with the expected one.

    Parameters
    ----------
    case : Case

    Returns
    -------
    Outcome
        The verdict is ``holds`` if the distance is finite and within the bound, and ``refused`` if
        an expected refusal has the expected message. It is ``fails`` otherwise: after a NaN, a
        warning, an overflow, another exception, or an answer instead of a refusal.
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
    except Exception as error:  # any other exception is a defect of the package
        return math.inf, FAILS, _one_line(f"{type(error).__name__}: {error}")
    if case.refusal:
        return math.inf, FAILS, f"it gave an answer instead of a refusal ('{case.refusal}')"
    if not sizes:
        return math.inf, FAILS, "it gave no distance"
    measured = float(np.max(sizes))  # NaN if any distance is NaN
    if math.isnan(measured):
        return math.inf, FAILS, "it gave a NaN"
    if measured <= case.bound:
        return measured, HOLDS, ""
    return measured, FAILS, f"{measured:.3g} exceeds the bound of {case.bound:.3g}"


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
    """Largest absolute difference of two arrays, relative to the largest value of the second."""
    difference = np.max(np.abs(np.subtract(values, reference)))
    return float(difference / np.max(np.abs(reference)))


@contextmanager
def temporary(name: str) -> Iterator[Path]:
    """Yield the path of a file in a temporary folder; hide the folder in error messages."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / name
        try:
            yield path
        except EarthspinError as error:
            raise UndefinedError(str(error).replace(str(path), name)) from None

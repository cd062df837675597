"""Measure error and run time of the settings of some methods for one quantity.

Each setting is compared with a reference that is at least a hundred times more accurate. Run times
are those of the fastest of some samples after a warm-up, because other processes only lengthen
them. Calls that a user types are timed a second time as the first call of a process.
"""

import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import pandas as pd

import earthspin
from earthspin.number_text import plain

#: Function that returns values and the number of evaluations of the costly function.
Run = Callable[..., tuple[Any, int]]
#: Number of samples, and shortest length of a sample, s.
SAMPLES, SHORTEST = 5, 2e-3
#: Relative tolerances of integrators of low and of high order.
COARSE, FINE = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8), (1e-4, 1e-6, 1e-8, 1e-10, 1e-13)


@dataclass(frozen=True)
class Ladder:
    """Methods for one quantity, each with settings from coarse to fine, and the true values.

    Attributes
    ----------
    title, problem, reference : str
        Title of the figure, description of the problem and the error, source of the true values.
    unit : str
        Unit of all errors; "1" if they are relative or in rad.
    floor : float
        Error of the reference.
    error : callable
        Function that returns the error of the values of a run, or of a list of them.
    runs : mapping of str to mapping of str to callable
        By method and setting.
    bounds : mapping of str to float
        Largest error of the last setting of each method of the package; other methods have none.
    cases : int
        Number of cases (epochs, records, seeds) from which the error is taken. If there are
        several, a run takes the number of the case, and the first one is timed.
    """

    title: str
    problem: str
    reference: str
    unit: str
    floor: float
    error: Callable[[Any], float]
    runs: Mapping[str, Mapping[str, Run]]
    bounds: Mapping[str, float]
    cases: int = 1

    def error_of(self, run: Run) -> float:
        """Error of a setting; an error below that of the reference cannot be measured."""
        values = [run(case)[0] for case in range(self.cases)] if self.cases > 1 else run()[0]
        return max(float(self.error(values)), self.floor)


@dataclass(frozen=True)
class PublicCall:
    """Call that a user types, timed as the first or as a later call of a process.

    Attributes
    ----------
    text : str
        Expression, like ``earthspin.precession()``.
    values : callable
        Values that are compared with the reference, from the answer.
    first : bool
        True to time the first call of a fresh process that has imported the package.
    """

    text: str
    values: Callable[[Any], Any]
    first: bool = False

    def __call__(self, case: int = 0) -> tuple[Any, int]:
        """Values of the call, the same in each case; evaluations are not counted."""
        return self.values(self._answer()), 0

    def seconds(self) -> float:
        """Run time of the call alone."""
        if not self.first:
            return _seconds(self._answer)
        clock = f"b = time.perf_counter(); {self.text}; print(time.perf_counter() - b)"
        command = [sys.executable, "-c", f"import earthspin, time; {clock}"]
        ended = subprocess.run(command, capture_output=True, text=True, check=True)
        return float(ended.stdout)

    def _answer(self) -> Any:
        return eval(self.text, {"earthspin": earthspin})


def public_call(text: str, values: Callable[[Any], Any]) -> dict[str, Run]:
    """Two settings of a call that a user types: first and later in a process."""
    return {"first call": PublicCall(text, values, True), "later call": PublicCall(text, values)}


def settings(words: str, run: Run, values: Iterable[float]) -> dict[str, Run]:
    """Runs with one number each, which takes the place of the braces in the words."""
    return {words.format(plain(value)): partial(run, value) for value in values}


def measured(ladder: Ladder) -> pd.DataFrame:
    """Run each setting; return rows with method, setting, error, seconds, evaluations and leads.

    A setting leads if no other one has both a smaller or equal error and a shorter run time.
    """
    rows = pd.DataFrame(_rows(ladder))
    beaten = [(rows.error <= row.error) & (rows.seconds < row.seconds) for row in rows.itertuples()]
    rows["leads"] = [not better.any() for better in beaten]
    return rows


def _rows(ladder: Ladder) -> Iterator[dict[str, Any]]:
    for method, runs in ladder.runs.items():
        for setting, run in runs.items():
            error, (_, evaluations) = ladder.error_of(run), run()
            clock = run.seconds if isinstance(run, PublicCall) else partial(_seconds, run)
            seconds = min(clock() for _ in range(SAMPLES))
            yield {
                **{"method": method, "setting": setting, "error": error},
                **{"seconds": seconds, "evaluations": evaluations},
            }


def _seconds(run: Run) -> float:
    """Run time of a call, the mean of as many calls as last two milliseconds."""
    calls, begin = 0, time.perf_counter()
    while not calls or time.perf_counter() - begin < SHORTEST:
        run()
        calls += 1
    return (time.perf_counter() - begin) / calls

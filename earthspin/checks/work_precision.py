"""Measure error and run time of all methods for a quantity (work-precision diagrams).

A ladder contains every method for one quantity, with settings from coarse to fine, and an
independent reference that is at least a hundred times more accurate. Each setting is run and timed.
A point is on the Pareto front if no other point has both a smaller error and a shorter run time.

Run times are medians after a warm-up, with half their range as spread. Runs shorter than two
milliseconds are repeated until a sample lasts that long.
"""

from __future__ import annotations

import gc
import math
import statistics
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, fields
from functools import partial
from importlib import import_module
from importlib.metadata import version
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin._version import __version__
from earthspin.engine.labels import CONVENTIONS, from_si
from earthspin.engine.variables import Labels, Value, Variables, labels, number, words
from earthspin.errors import SceneError, nearest
from earthspin.progress import Advance, progress
from earthspin.rounded import duration, plain, shown_unit

if TYPE_CHECKING:
    import xarray as xr

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
#: Values, and the number of evaluations of the costly function.
Result = tuple[Any, int]

#: Quantities, each with a module of `earthspin.checks.ladders`.
QUANTITIES = (
    "precession", "torque", "pole", "long-term", "elements", "mean-orbit", "rotation",
    "free-rotor", "top", "spheroid", "excitation", "chandler", "forecast", "compliances",
    "ensemble",
)  # fmt: skip

#: Shortest sample, s; number of samples, and of samples for runs longer than `LONG_RUN`, s.
SHORTEST_SAMPLE = 2e-3
SAMPLES, FEW_SAMPLES, LONG_RUN = 5, 3, 1.0
#: Required ratio of a measured error to the error of the reference.
REFERENCE_MARGIN = 100.0
#: Largest number of error levels in the summary sentence.
MOST_STEPS = 4


@dataclass(frozen=True)
class Setting:
    """One setting of a method, such as a tolerance, with the function that runs the method.

    Attributes
    ----------
    words : str
        Description of the setting, e.g. ``"8 d, 14 nodes"``.
    run : callable
        Function that is timed; it returns values and the number of evaluations of the costly
        function.
    error_values : callable or None
        Values that the error is taken from, where those of one run are too few (many epochs,
        many records); it is not timed.
    """

    words: str
    run: Callable[[], Result]
    error_values: Callable[[], Any] | None = None


@dataclass(frozen=True)
class Method:
    """A numerical method, and its settings for which error and run time are measured.

    Attributes
    ----------
    name : str
    settings : sequence of Setting
        Settings from coarse to fine.
    bound : float
        Largest allowed error of the last setting, SI. Methods of this package have a bound; direct
        calls of SciPy and other libraries have none (infinite).
    task : str
        Direction of the computation, if a ladder has two.
    """

    name: str
    settings: Sequence[Setting]
    bound: float = math.inf
    task: str = ""

    @property
    def ours(self) -> bool:
        """Return True if the method belongs to this package, not to another library."""
        return math.isfinite(self.bound)


def method(
    name: str,
    words: str,
    run: Callable[..., Result],
    values: Iterable[float] | None = None,
    bound: float = math.inf,
) -> Method:
    """Make a `Method` whose settings differ in one number, such as the tolerance.

    Parameters
    ----------
    name : str
    words : str
        Description of a setting with braces for the number, e.g. ``"rtol {}"``.
    run : callable
        Function of the number.
    values : iterable, optional
        Numbers from coarse to fine; by default there is one setting, and `run` has no argument.
    bound : float
        See `Method`.
    """
    if values is None:
        return Method(name, [Setting(words, run)], bound)
    rungs = [Setting(words.format(plain(value)), partial(run, value)) for value in values]
    return Method(name, rungs, bound)


@dataclass(frozen=True)
class Ladder:
    """Comparison of all methods that compute the same quantity (work-precision diagram).

    Attributes
    ----------
    quantity : str
    unit : str
        Unit of errors in results.
    problem : str
        Description of the problem and definition of the error.
    subject : str
        The problem in a few words, for a sentence that begins with "For".
    reference : str
        Source of the true values.
    reference_error : float
        Error of the reference, SI.
    methods : sequence of Method
    error : callable
        Function that returns the error of values, SI.
    useful : float
        Largest useful error, SI; the summary sentence ignores larger ones.
    skipped : str
        Methods that are omitted, with the reason.
    """

    quantity: str
    unit: str
    problem: str
    subject: str
    reference: str
    reference_error: float
    methods: Sequence[Method]
    error: Callable[[Any], float]
    useful: float = math.inf
    skipped: str = ""

    @property
    def rungs(self) -> int:
        """Largest number of settings (rungs) of any method in this comparison."""
        return max(len(method.settings) for method in self.methods)


class Timing(NamedTuple):
    """Run time of the first call of a function, and median and spread of later calls, s.

    Attributes
    ----------
    first : float
        Run time of the first call, including imports and preparations, s.
    median, spread : float
        Median and half the range of the run times of the later calls, s.
    result : object
        Result of the first call.
    """

    first: float
    median: float
    spread: float
    result: Any


@dataclass(frozen=True)
class Point:
    """Measured error (SI) and run times (s) of one method at one setting."""

    setting: str
    error: float
    run_time: float
    run_time_spread: float
    warm_up_time: float
    evaluations: int


# --- measuring ---------------------------------------------------------------------------------


def timed(run: Callable[[], Any]) -> Timing:
    """Measure the run time of a function call: the first call, and the median of repeated calls.

    Parameters
    ----------
    run : callable
    """
    collecting = gc.isenabled()
    gc.disable()  # the garbage collector must not run during a sample
    try:
        first, result = _seconds(run, 1)
        once, _ = _seconds(run, 1)
        loops = max(1, math.ceil(SHORTEST_SAMPLE / max(once, 1e-9)))
        samples = [once] if loops == 1 else []
        wanted = FEW_SAMPLES if once > LONG_RUN else SAMPLES
        while len(samples) < wanted:
            seconds, _ = _seconds(run, loops)
            if seconds < SHORTEST_SAMPLE:  # the first estimate of the run time was too long
                loops, samples = 2 * loops, []
                continue
            samples.append(seconds / loops)
    finally:
        if collecting:
            gc.enable()
    return Timing(first, statistics.median(samples), (max(samples) - min(samples)) / 2, result)


def _seconds(run: Callable[[], Any], loops: int) -> tuple[float, Any]:
    """Run a function `loops` times; return the total time, s, and the last result."""
    result = None
    begin = time.perf_counter()
    for _ in range(loops):
        result = run()
    return time.perf_counter() - begin, result


def measure(ladder: Ladder, advance: Advance = lambda amount: None) -> list[list[Point]]:
    """Run every setting of every method in a comparison, and measure error and run time.

    Parameters
    ----------
    ladder : Ladder
    advance : callable
        Called after each setting.

    Returns
    -------
    list of list of Point
        A list for each method, with a point for each setting.
    """

    def point(setting: Setting) -> Point:
        timing = timed(setting.run)
        values, evaluations = timing.result
        if setting.error_values is not None:
            values = setting.error_values()
        # Errors below that of the reference cannot be measured.
        error = max(float(ladder.error(values)), ladder.reference_error)
        advance(1)
        times = timing.median, timing.spread, timing.first
        return Point(setting.words, error, *times, int(evaluations))

    return [[point(setting) for setting in method.settings] for method in ladder.methods]


def pareto_front(error: Any, run_time: Any) -> BoolArray:
    """Return True for each point on the Pareto front: no other point surpasses it.

    Another point surpasses it if it is better in error or run time and not worse in the other.

    Parameters
    ----------
    error, run_time : array_like
        Arrays of the same shape.
    """
    e, t = np.ravel(error), np.ravel(run_time)
    no_worse = (e[:, np.newaxis] <= e) & (t[:, np.newaxis] <= t)
    better = (e[:, np.newaxis] < e) | (t[:, np.newaxis] < t)
    beaten = np.any(no_worse & better, axis=0)
    return np.asarray((~beaten & np.isfinite(e) & np.isfinite(t)).reshape(np.shape(error)))


# --- the result --------------------------------------------------------------------------------


def accuracy(quantity: str, *, quick: bool = False) -> xr.Dataset:
    """Measure error and run time of all methods for a quantity, here and in other libraries.

    Parameters
    ----------
    quantity : str
        ``"precession"``, ``"torque"``, ``"pole"``, ``"long-term"``, ``"elements"``,
        ``"mean-orbit"``, ``"rotation"``, ``"free-rotor"``, ``"top"``, ``"spheroid"``,
        ``"excitation"``, ``"chandler"``, ``"forecast"``, ``"compliances"`` or
        ``"ensemble"``.
    quick : bool
        Use a short problem with few settings, which takes a second or two.

    Returns
    -------
    Dataset
        Along `method` and `rung`: `error` (in the unit of the quantity), `run_time`,
        `run_time_spread` and `warm_up_time` (s), `evaluations`, `setting` (text), `pareto` (True
        on the front), and `at_floor` (True if the error is less than 100 times that of the
        reference). Along `method`: `ours`, `bound` (infinite for other libraries), `holds`, and
        `task`; each task has its own front. If a method has fewer settings, its last one is
        repeated.

    Raises
    ------
    SceneError
        If the quantity is unknown.

    Examples
    --------
    >>> import earthspin
    >>> result = earthspin.accuracy("spheroid", quick=True)
    >>> print(bool(result.holds.all()))
    True
    """
    ladder = ladder_of(quantity, quick=quick)
    with progress(quantity, sum(len(method.settings) for method in ladder.methods)) as advance:
        points = measure(ladder, advance)
    return dataset(ladder, points, quick=quick)


def ladder_of(quantity: str, *, quick: bool = False) -> Ladder:
    """Build the comparison of methods (`Ladder`) for a quantity, by its name.

    Raises
    ------
    SceneError
        If the quantity is unknown.
    """
    if not isinstance(quantity, str) or quantity not in QUANTITIES:  # type: ignore[redundant-expr]
        raise SceneError("quantity", quantity, nearest(quantity, QUANTITIES), source="accuracy")
    module = import_module(f"earthspin.checks.ladders.of_{quantity.replace('-', '_')}")
    ladder: Ladder = module.ladder(quick)
    return ladder


def dataset(ladder: Ladder, points: Sequence[Sequence[Point]], *, quick: bool) -> xr.Dataset:
    """Make a Dataset of the measured errors and run times, labelled by method and setting.

    Parameters
    ----------
    ladder : Ladder
    points : sequence of sequence of Point
        Result of `measure`.
    quick : bool
    """
    methods = ladder.methods
    full = [[*row, *[row[-1]] * (ladder.rungs - len(row))] for row in points]
    values: dict[str, Any] = {
        field.name: np.array([[getattr(point, field.name) for point in row] for row in full])
        for field in fields(Point)
    }
    for name in ("task", "ours", "bound"):
        values[name] = np.array([getattr(method, name) for method in methods])
    error, run_time = values["error"], values["run_time"]
    values["settings"] = np.array([len(method.settings) for method in methods])
    values["at_floor"] = error < REFERENCE_MARGIN * ladder.reference_error
    values["holds"] = ~values["ours"] | (error[:, -1] <= values["bound"])
    values["pareto"] = np.zeros(error.shape, dtype=bool)
    for task in {method.task for method in methods}:
        rows = values["task"] == task
        values["pareto"][rows] = pareto_front(error[rows], run_time[rows])
    values["method"] = [method.name for method in methods]
    values["rung"] = np.arange(1, ladder.rungs + 1)
    result = points_class(ladder.unit)(**values).dataset()
    result.attrs = {
        "title": f"Error against run time: {ladder.quantity}",
        "Conventions": CONVENTIONS,
        "quantity": ladder.quantity,
        "problem": ladder.problem,
        "reference": ladder.reference,
        "reference_error": ladder.reference_error * from_si(ladder.unit),
        "sentence": sentence(ladder, points),
        "skipped": ladder.skipped,
        "quick": int(quick),
        "source": f"earthspin {__version__}, numpy {version('numpy')}, scipy {version('scipy')}",
    }
    return result


def points_class(unit: str) -> type[Variables]:
    """Make the class that declares the measured errors (in `unit`) and run times of methods."""
    by_method = ("method",)

    class Points(Variables, along=("method", "rung")):
        """Measured errors and run times of each method at each of its settings."""

        error: Value = number(unit, "error with respect to the reference")
        run_time: Value = number("s", "median run time")
        run_time_spread: Value = number("s", "half the range of the run times")
        warm_up_time: Value = number("s", "run time of the first call")
        evaluations: Value = number("1", "evaluations of the costly function")
        setting: Value = words("setting")
        pareto: Value = words("whether the point is on the Pareto front")
        at_floor: Value = words("whether the error is below 100 times that of the reference")
        ours: Value = words("whether the method belongs to this package", along=by_method)
        bound: Value = number(unit, "bound on the error of the last setting", along=by_method)
        holds: Value = words("whether the last setting is within the bound", along=by_method)
        settings: Value = number("1", "number of settings", along=by_method)
        task: Value = words("task, if the quantity has two", along=by_method)
        method: Labels = labels()
        rung: Labels = labels()

    return Points


# --- summary sentence --------------------------------------------------------------------------


def sentence(ladder: Ladder, points: Sequence[Sequence[Point]]) -> str:
    """Write a sentence that names the fastest method for each of a few error levels.

    Parameters
    ----------
    ladder : Ladder
    points : sequence of sequence of Point
        Result of `measure`.
    """
    tasks = list(dict.fromkeys(method.task for method in ladder.methods))
    return " ".join(_sentence_of_task(ladder, points, task) for task in tasks)


def _sentence_of_task(ladder: Ladder, points: Sequence[Sequence[Point]], task: str) -> str:
    subject, factor = task or ladder.subject, from_si(ladder.unit)
    rows = [
        _Row(
            point.error * factor, point.run_time, point.run_time_spread, method.name, point.setting
        )
        for method, row in zip(ladder.methods, points, strict=True)
        for point in row
        if method.task == task and point.error <= ladder.useful
    ]
    if not rows:
        return f"For {subject}: no method is accurate enough."
    parts = [
        f"within {plain(level)}{shown_unit(ladder.unit)} use "
        f"{row.method}{f' ({row.words})' if row.words else ''}, {duration(row.run_time)}"
        for level, row in _steps(rows)
    ]
    return f"For {subject}: " + "; ".join(parts) + "."


class _Row(NamedTuple):
    """Error, run time and name of one measured setting, in the unit of the result."""

    error: float
    run_time: float
    spread: float
    method: str
    words: str


def _cheapest(rows: list[_Row]) -> _Row:
    """Fastest of the measured settings; if several are equally fast, the most accurate."""
    fastest = min(rows, key=lambda row: row.run_time)
    similar = [r for r in rows if r.run_time - fastest.run_time <= max(r.spread, fastest.spread)]
    return min(similar, key=lambda row: row.error)


def _steps(rows: list[_Row]) -> list[tuple[float, _Row]]:
    """Error levels, each with the fastest setting that reaches it, at most `MOST_STEPS`.

    A row that is fastest for several levels appears only with the smallest level.
    """
    finest: dict[_Row, float] = {}
    for level in _levels(min(row.error for row in rows), max(row.error for row in rows)):
        finest[_cheapest([row for row in rows if row.error <= level])] = level
    steps = [(level, row) for row, level in finest.items()]
    if len(steps) <= MOST_STEPS:
        return steps
    chosen = np.linspace(0, len(steps) - 1, MOST_STEPS).round().astype(int)
    return [steps[place] for place in chosen]


def _levels(least: float, largest: float) -> list[float]:
    """Error levels in descending order: powers of ten, with 2 and 5 for a narrow range."""
    between = (5.0, 2.0, 1.0) if largest < 100 * least else (1.0,)
    powers = range(math.floor(math.log10(largest)) + 1, math.floor(math.log10(least)) - 1, -1)
    levels = [float(f"{digit:g}e{power}") for power in powers for digit in between]
    above = [level for level in levels if level >= largest]
    return [level for level in levels if least <= level <= min(above)]

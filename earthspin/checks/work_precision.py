"""Error against run time: what each way to a number costs, and how wrong it then is.

A ladder holds, for one quantity, every method with its settings from coarse to fine, and a
reference made in another way that is at least a hundred times better. Each setting is run and
timed; no point of the front (Pareto's) is beaten in error and run time at once by another.

Run times are medians after a warm-up, with half their range as spread; what takes less than
two milliseconds is repeated until a sample lasts that long.
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
#: Values, and how often the costly function was evaluated.
Result = tuple[Any, int]

#: Quantities, each with a module of `earthspin.checks.ladders`.
QUANTITIES = (
    "precession", "torque", "pole", "long-term", "elements", "mean-orbit", "rotation",
    "free-rotor", "top", "spheroid", "excitation", "chandler", "forecast", "compliances",
    "ensemble",
)  # fmt: skip

#: A sample lasts at least so long, s; there are so many, or fewer of runs above `LONG_RUN`.
SHORTEST_SAMPLE = 2e-3
SAMPLES, FEW_SAMPLES, LONG_RUN = 5, 3, 1.0
#: How much better than a measured error its reference has to be.
REFERENCE_MARGIN = 100.0
#: Most steps of error that the sentence tells of.
MOST_STEPS = 4


@dataclass(frozen=True)
class Setting:
    """One way to run a method.

    Attributes
    ----------
    words : str
        What is set, e.g. ``"8 d, 14 nodes"``.
    run : callable
        What is timed; gives values and how often the costly function was evaluated.
    judged : callable or None
        Values that the error is taken from, where those of one run are too few (many epochs,
        many records); it is not timed.
    """

    words: str
    run: Callable[[], Result]
    judged: Callable[[], Any] | None = None


@dataclass(frozen=True)
class Method:
    """A method with its settings.

    Attributes
    ----------
    name : str
    settings : sequence of Setting
        From coarse to fine.
    bound : float
        Error that the last setting stays within, SI, or the method fails. Methods of this package
        have one; SciPy set by hand and other libraries have none (infinite).
    task : str
        Direction, where a ladder holds two.
    """

    name: str
    settings: Sequence[Setting]
    bound: float = math.inf
    task: str = ""

    @property
    def ours(self) -> bool:
        """Whether this is a method of this package."""
        return math.isfinite(self.bound)


def method(
    name: str,
    words: str,
    run: Callable[..., Result],
    values: Iterable[float] | None = None,
    bound: float = math.inf,
) -> Method:
    """Return a method whose settings differ in one number.

    Parameters
    ----------
    name : str
    words : str
        With braces in the place of that number, e.g. ``"rtol {}"``.
    run : callable
        From that number.
    values : iterable, optional
        From coarse to fine; by default there is one setting, whose run takes nothing.
    bound : float
        As of `Method`.
    """
    if values is None:
        return Method(name, [Setting(words, run)], bound)
    rungs = [Setting(words.format(plain(value)), partial(run, value)) for value in values]
    return Method(name, rungs, bound)


@dataclass(frozen=True)
class Ladder:
    """All methods for one quantity.

    Attributes
    ----------
    quantity : str
    unit : str
        In which errors are shown.
    problem : str
        What is solved, and what the error is.
    subject : str
        The same in a few words, for a sentence that begins with "For".
    reference : str
        Where the true values come from.
    reference_error : float
        SI.
    methods : sequence of Method
    error : callable
        From values to their error, SI.
    useful : float
        Larger errors are of no use to anybody, SI; the sentence passes over them.
    skipped : str
        What is left out here, and why.
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
        """Settings of the method that has most."""
        return max(len(method.settings) for method in self.methods)


class Timing(NamedTuple):
    """Run time of a call.

    Attributes
    ----------
    first : float
        Of the first call, with what it imports and prepares, s.
    median, spread : float
        Of the calls after it, and half the range, s.
    result : object
        Result of the first call.
    """

    first: float
    median: float
    spread: float
    result: Any


@dataclass(frozen=True)
class Point:
    """A setting, measured; errors in SI, times in s; named as the variables of a result."""

    setting: str
    error: float
    run_time: float
    run_time_spread: float
    warm_up_time: float
    evaluations: int


# --- measuring ---------------------------------------------------------------------------------


def timed(run: Callable[[], Any]) -> Timing:
    """Time a call: once to warm up, then as often as its length asks for.

    Parameters
    ----------
    run : callable
    """
    collecting = gc.isenabled()
    gc.disable()  # the collector must not run in the middle of a sample
    try:
        first, result = _seconds(run, 1)
        once, _ = _seconds(run, 1)
        loops = max(1, math.ceil(SHORTEST_SAMPLE / max(once, 1e-9)))
        samples = [once] if loops == 1 else []
        wanted = FEW_SAMPLES if once > LONG_RUN else SAMPLES
        while len(samples) < wanted:
            seconds, _ = _seconds(run, loops)
            if seconds < SHORTEST_SAMPLE:  # the first guess was too slow
                loops, samples = 2 * loops, []
                continue
            samples.append(seconds / loops)
    finally:
        if collecting:
            gc.enable()
    return Timing(first, statistics.median(samples), (max(samples) - min(samples)) / 2, result)


def _seconds(run: Callable[[], Any], loops: int) -> tuple[float, Any]:
    """Time of so many calls, s, and the result of the last one."""
    result = None
    begin = time.perf_counter()
    for _ in range(loops):
        result = run()
    return time.perf_counter() - begin, result


def measure(ladder: Ladder, advance: Advance = lambda amount: None) -> list[list[Point]]:
    """Run and time every setting of a ladder.

    Parameters
    ----------
    ladder : Ladder
    advance : callable
        Called after each setting.

    Returns
    -------
    list of list of Point
        By method; as many as its settings.
    """

    def point(setting: Setting) -> Point:
        timing = timed(setting.run)
        values, evaluations = timing.result
        if setting.judged is not None:
            values = setting.judged()
        # nothing is known below the error of the reference
        error = max(float(ladder.error(values)), ladder.reference_error)
        advance(1)
        times = timing.median, timing.spread, timing.first
        return Point(setting.words, error, *times, int(evaluations))

    return [[point(setting) for setting in method.settings] for method in ladder.methods]


def pareto_front(error: Any, run_time: Any) -> BoolArray:
    """Points that no other beats: none has both at most the error and at most the run time.

    Parameters
    ----------
    error, run_time : array_like, of one shape
        Equal points do not beat each other.
    """
    e, t = np.ravel(error), np.ravel(run_time)
    no_worse = (e[:, np.newaxis] <= e) & (t[:, np.newaxis] <= t)
    better = (e[:, np.newaxis] < e) | (t[:, np.newaxis] < t)
    beaten = np.any(no_worse & better, axis=0)
    return np.asarray((~beaten & np.isfinite(e) & np.isfinite(t)).reshape(np.shape(error)))


# --- the result --------------------------------------------------------------------------------


def accuracy(quantity: str, *, quick: bool = False) -> xr.Dataset:
    """Error against run time of every method for a quantity, ours and those set by hand.

    Parameters
    ----------
    quantity : str
        ``"precession"``, ``"torque"``, ``"pole"``, ``"long-term"``, ``"elements"``,
        ``"mean-orbit"``, ``"rotation"``, ``"free-rotor"``, ``"top"``, ``"spheroid"``,
        ``"excitation"``, ``"chandler"``, ``"forecast"``, ``"compliances"`` or
        ``"ensemble"``.
    quick : bool
        A short problem with few settings, in a second or two.

    Returns
    -------
    Dataset
        Over `method` and `rung`: `error` (in the unit of the quantity), `run_time` with its
        `run_time_spread` and `warm_up_time` (s), `evaluations`, `setting` in words, `pareto`,
        and `at_floor` where the reference is not a hundred times better; over `method`:
        `ours`, `bound` (infinite where none is claimed), `holds`, and `task`, of which each
        has a front of its own. A method with few settings stays at its last one.

    Raises
    ------
    SceneError
        If there is no such quantity.

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
    """Make the ladder of a quantity.

    Raises
    ------
    SceneError
        If there is no such quantity.
    """
    if not isinstance(quantity, str) or quantity not in QUANTITIES:  # type: ignore[redundant-expr]
        raise SceneError("quantity", quantity, nearest(quantity, QUANTITIES), source="accuracy")
    module = import_module(f"earthspin.checks.ladders.of_{quantity.replace('-', '_')}")
    ladder: Ladder = module.ladder(quick)
    return ladder


def dataset(ladder: Ladder, points: Sequence[Sequence[Point]], *, quick: bool) -> xr.Dataset:
    """Label what was measured.

    Parameters
    ----------
    ladder : Ladder
    points : sequence of sequence of Point
        As `measure` gives them.
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
        mine = values["task"] == task
        values["pareto"][mine] = pareto_front(error[mine], run_time[mine])
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
    """Return the class of a result whose errors are shown in `unit`."""
    by_method = ("method",)

    class Points(Variables, along=("method", "rung")):
        """Errors and run times of each method at each setting."""

        error: Value = number(unit, "error against the reference")
        run_time: Value = number("s", "median run time")
        run_time_spread: Value = number("s", "half the range of the run times")
        warm_up_time: Value = number("s", "run time of the first call")
        evaluations: Value = number("1", "evaluations of the costly function")
        setting: Value = words("setting")
        pareto: Value = words("no other point has less error and less run time")
        at_floor: Value = words("the reference is less than a hundred times better")
        ours: Value = words("a method of this package", along=by_method)
        bound: Value = number(unit, "bound on the error of the last setting", along=by_method)
        holds: Value = words("the last setting stays within its bound", along=by_method)
        settings: Value = number("1", "how many settings differ", along=by_method)
        task: Value = words("what is asked for, where there are two", along=by_method)
        method: Labels = labels()
        rung: Labels = labels()

    return Points


# --- in a sentence -----------------------------------------------------------------------------


def sentence(ladder: Ladder, points: Sequence[Sequence[Point]]) -> str:
    """Say which method is cheapest for a few errors, and what it costs.

    Parameters
    ----------
    ladder : Ladder
    points : sequence of sequence of Point
        As `measure` gives them.
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
        return f"For {subject}: none is of use."
    parts = [
        f"within {plain(level)}{shown_unit(ladder.unit)} use "
        f"{row.method}{f' ({row.words})' if row.words else ''}, {duration(row.run_time)}"
        for level, row in _steps(rows)
    ]
    return f"For {subject}: " + "; ".join(parts) + "."


class _Row(NamedTuple):
    """A point as the sentence needs it, its error in the unit shown."""

    error: float
    run_time: float
    spread: float
    method: str
    words: str


def _cheapest(rows: list[_Row]) -> _Row:
    """Cheapest row; of those that the clock cannot tell from it, the most accurate."""
    best = min(rows, key=lambda row: row.run_time)
    alike = [r for r in rows if r.run_time - best.run_time <= max(r.spread, best.spread)]
    return min(alike, key=lambda row: row.error)


def _steps(rows: list[_Row]) -> list[tuple[float, _Row]]:
    """Cheapest row for each level of error, each once, at the finest level that it meets."""
    finest: dict[_Row, float] = {}
    for level in _levels(min(row.error for row in rows), max(row.error for row in rows)):
        finest[_cheapest([row for row in rows if row.error <= level])] = level
    steps = [(level, row) for row, level in finest.items()]
    if len(steps) <= MOST_STEPS:
        return steps
    chosen = np.linspace(0, len(steps) - 1, MOST_STEPS).round().astype(int)
    return [steps[place] for place in chosen]


def _levels(least: float, largest: float) -> list[float]:
    """Powers of ten that frame errors, falling; with 2 and 5 between where there are few."""
    between = (5.0, 2.0, 1.0) if largest < 100 * least else (1.0,)
    powers = range(math.floor(math.log10(largest)) + 1, math.floor(math.log10(least)) - 1, -1)
    levels = [float(f"{digit:g}e{power}") for power in powers for digit in between]
    above = [level for level in levels if level >= largest]
    return [level for level in levels if least <= level <= min(above)]

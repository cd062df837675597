"""Dates or times of a series."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

import numpy as np

from earthspin.bodies import Body
from earthspin.bodies.body import members
from earthspin.dates import Epochs, Span, Step, TimeGrid, TimeList
from earthspin.engine import Block, Question, Variables, key, labels, part, setting
from earthspin.errors import SceneError, in_bytes
from earthspin.numerics.arrays import FloatArray
from earthspin.questions.sky import PerturbedBody
from earthspin.units import LONGEST_IN_MEMORY as LONGEST_IN_MEMORY
from earthspin.units import Duration, Numbers, Whole

#: Seconds from the start of a motion.
Seconds = Annotated[FloatArray, Numbers("s", "1 s", (None,))]

#: Descriptions of keys that several questions declare with different defaults.
SPAN_DOC = "first and last date, TDB; the last is included if the step meets it"


class DateSeries(PerturbedBody):
    """Base class of computations whose results are time series at given dates."""

    exclusive = ((("times",), ("span", "step")),)

    span: Span = key(doc=SPAN_DOC)
    step: Step = key(doc="time between two dates")
    times: TimeList | None = key(None, doc="list of dates, instead of span and step")


class TimesOfMotion(Question):
    """Base class of computations of a motion at times from its start."""

    exclusive = ((("times",), ("duration", "points")),)

    times: Seconds | None = setting(None, doc="times from the start")
    duration: Duration = setting("20 s", doc="last time, if times are not given")
    points: Annotated[int, Whole()] = setting(401, doc="number of evenly spaced times")


class Dated(Variables, along=("time",)):
    """Base class of results given at the dates of a time series."""

    time = labels("time (TDB)", standard_name="time", axis="T")


class TimesFromStart(Variables, along=("time",)):
    """Base class of results at times after the start of a motion, s; vectors are along x, y, z."""

    time = labels("time from the start", "s")
    component = labels(default=["x", "y", "z"])


@part
def epochs(span: Span, step: float, times: TimeList | None) -> Epochs:
    """Dates of a time series, from its span and step or from a list of dates."""
    return TimeGrid.over(span, step) if times is None else times


@part
def instants(duration: float, points: int, times: FloatArray | None) -> FloatArray:
    """Times at which a motion is computed, s from the start of the motion."""
    return np.linspace(0.0, duration, points) if times is None else times


#: Approximate memory of a series for each of its times, bytes.
BYTES_PER_TIME = 128


def days_of(
    epochs: Epochs, block: Block | None = None, store: str = "", bodies: Iterable[Body] = ()
) -> FloatArray:
    """Times of a time series, or of one block (interval) of the series, days from J2000.0 TDB.

    Parameters
    ----------
    epochs : TimeGrid or TimeList
    block : Block, optional
    store : str
        Name of a store, for the advice to write a series by region that does not fit into memory.
    bodies : iterable of Body
        Bodies whose labelled arrays multiply the size of the series.

    Raises
    ------
    SceneError
        If no block is given, and the series is too long for memory.
    """
    if block is not None:
        return epochs.days(block.first, block.last)
    count = members(bodies)
    size = epochs.size * count
    if size > LONGEST_IN_MEMORY:
        remedy = "choose a longer step or a shorter span"
        if store:
            remedy = f"write them by region with write_series(scene, '{store}') or run --out"
        times = f"{epochs.size} times" + (f" of {count} members" if count > 1 else "")
        step = None if isinstance(epochs, TimeList) else f"{epochs.step * 1e-6:g} s"
        problem = f"{times} take {in_bytes(size * BYTES_PER_TIME)} and do not fit into memory"
        raise SceneError("step", step, f"{problem} (up to {LONGEST_IN_MEMORY}); {remedy}")
    return epochs.days()

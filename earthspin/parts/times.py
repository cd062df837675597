"""Times of a series: dates, or seconds from the start of a motion."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

import numpy as np

from earthspin.bodies import Body
from earthspin.bodies.body import members
from earthspin.dates import Epochs, Span, Step, TimeGrid, TimeList
from earthspin.engine.part import Block, part
from earthspin.engine.question import key
from earthspin.engine.variables import Labels, Variables, labels
from earthspin.errors import SceneError, in_bytes
from earthspin.numerics.arrays import FloatArray
from earthspin.parts.sky import PerturbedBody
from earthspin.units import LONGEST_IN_MEMORY as LONGEST_IN_MEMORY
from earthspin.units import Numbers

#: Seconds from the start of a motion.
Seconds = Annotated[FloatArray, Numbers("s", "1 s", (None,))]

#: Descriptions of keys that several questions declare with different defaults.
SPAN_DOC = "first and last date, TDB; the last is included if the step meets it"


class Series(PerturbedBody):
    """Base class of questions whose results are time series at given dates."""

    exclusive = (("times",), ("span", "step"))

    span: Span = key(doc=SPAN_DOC)
    step: Step = key(doc="time between two dates")
    times: TimeList | None = key(None, doc="list of dates, instead of span and step")


class Dated(Variables, along=("time",)):
    """Base class of results given at the dates of a time series."""

    time: Labels = labels("time (TDB)", standard_name="time", axis="T")


class FromStart(Variables, along=("time",)):
    """Base class of results given at times from the start of a motion, in axes of the body."""

    time: Labels = labels("time from the start", "s")
    component: Labels = labels(default=["x", "y", "z"])


@part
def epochs(span: Span, step: float, times: TimeList | None) -> Epochs:
    """Dates of a time series, from its span and step or from a list of dates."""
    return TimeGrid.over(span, step) if times is None else times


@part
def instants(duration: float, points: int, times: FloatArray | None) -> FloatArray:
    """Times at which a motion is computed, s from its start."""
    return np.linspace(0.0, duration, points) if times is None else times


#: Approximate memory of a series for each of its times, bytes.
BYTES_PER_TIME = 128


def by_region(store: str) -> str:
    """Advice, for error messages, on how to write a series that is too long for memory."""
    return f"write them by region with write_series(scene, '{store}') or run --out"


def days_of(
    epochs: Epochs,
    block: Block | None = None,
    remedy: str = "choose a longer step or a shorter span",
    bodies: Iterable[Body] = (),
) -> FloatArray:
    """Days from J2000.0 TDB of one block of a time series, or of the whole series.

    Parameters
    ----------
    epochs : TimeGrid or TimeList
    block : Block, optional
    remedy : str
        Advice if the times do not fit into memory.
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
        times = f"{epochs.size} times" + (f" of {count} members" if count > 1 else "")
        raise SceneError(
            "step",
            None if isinstance(epochs, TimeList) else f"{epochs.step * 1e-6:g} s",
            f"{times} take {in_bytes(size * BYTES_PER_TIME)} and do not fit into memory "
            f"(up to {LONGEST_IN_MEMORY}); {remedy}",
        )
    return epochs.days()

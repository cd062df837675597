"""Convert Skyfield vector functions to trajectories and to the form stored in scene files.

A segment, a sum of vectors, a comet from its elements, a satellite or a custom function gives a
position at a time, and can be the position of a body. Vector functions based on kernels only have a
measured error and can be stored in scenes, segment by segment.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from typing import Any

import numpy as np
from skyfield.api import load
from skyfield.constants import AU_M
from skyfield.jpllib import SpiceKernel, SPICESegment, Stack
from skyfield.positionlib import ICRF
from skyfield.timelib import Time, Timescale
from skyfield.vectorlib import ReversedVector, VectorFunction, VectorSum

from earthspin.constants import J2000_JD
from earthspin.errors import EarthspinError, KernelError, UndefinedError, Where, nearest
from earthspin.numerics.arrays import FloatArray
from earthspin.sky.ephemeris import Ephemeris, open_ephemeris
from earthspin.sky.protocol import Trajectory, words

_BLOCK = 1 << 12  # times per block: 1365 nutation terms for each take 45 MB


@lru_cache
def timescale() -> Timescale:
    """Skyfield's time scale from tables included in Skyfield, without downloads."""
    return load.timescale(builtin=True)


def blocks_of_times(days: FloatArray) -> Iterator[tuple[slice, Time]]:
    """Yield Skyfield times for days of TDB from J2000.0, in blocks of limited size."""
    for first in range(0, days.size, _BLOCK):
        block = slice(first, first + _BLOCK)
        yield block, timescale().tdb_jd(J2000_JD, days[block])


def at(function: VectorFunction, t: Time) -> ICRF:
    """Compute the position of a Skyfield vector function at given times.

    Raises
    ------
    UndefinedError
        If the position cannot be computed; includes Skyfield's message.
    """
    try:
        return function.at(t)
    except EarthspinError:
        raise
    except Exception as error:  # errors differ between kinds of vector functions
        raise UndefinedError(f"{words(function)} cannot be placed: {error}") from error


@dataclass(frozen=True)
class VectorTrajectory:
    """Trajectory that computes its positions by a Skyfield vector function.

    Attributes
    ----------
    function : VectorFunction
    """

    function: VectorFunction

    @property
    def centre(self) -> int:
        """NAIF code of the body relative to which the vector function gives positions."""
        return int(self.function.center)

    @cached_property
    def code(self) -> int | None:
        """NAIF code of the vector function's target, if all its segments are from kernels."""
        target = self.function.target
        is_measured = all(map(_segments, _leaves(self.function))) and isinstance(target, int)
        return target if is_measured else None

    @cached_property
    def coverage(self) -> tuple[float, float]:
        """First and last day covered by all kernel segments; infinite if there are none."""
        stacks = [stack for stack in map(_segments, _leaves(self.function)) if stack]
        first = [min(s.spk_segment.start_jd for s in segments) - J2000_JD for segments in stacks]
        last = [max(s.spk_segment.end_jd for s in segments) - J2000_JD for segments in stacks]
        return max(first, default=-math.inf), min(last, default=math.inf)

    def positions(self, days: FloatArray) -> FloatArray:
        """Positions of the vector function's target, in the ICRF, m, shape (n, 3)."""
        blocks = [at(self.function, t).position.m.T for _, t in blocks_of_times(days)]
        return np.concatenate(blocks) if blocks else np.empty((0, 3))

    def __str__(self) -> str:
        return words(repr(self.function))


class _Along(VectorFunction):  # type: ignore[misc]
    """Skyfield vector function whose positions are those of a trajectory; no velocities."""

    def __init__(self, trajectory: Trajectory) -> None:
        self.trajectory, self.center, self.target = trajectory, trajectory.centre, self

    def _at(self, t: Time) -> tuple[FloatArray, FloatArray, None, None]:
        days = np.atleast_1d((t.whole - J2000_JD) + t.tdb_fraction)
        positions = np.asarray(self.trajectory.positions(days)).T / AU_M
        return positions, np.full_like(positions, np.nan), None, None

    def __str__(self) -> str:
        return words(self.trajectory)


def function_of(trajectory: Trajectory) -> VectorFunction:
    """Convert a trajectory to a Skyfield vector function, by a wrapper if necessary."""
    if isinstance(trajectory, VectorTrajectory):
        return trajectory.function
    return _Along(trajectory)


# --- segments of a vector function ------------------------------------------------------------


def _leaves(function: VectorFunction) -> Iterator[VectorFunction]:
    """Yield the elementary vector functions whose sum is the given one; signs are ignored."""
    if isinstance(function, VectorSum):
        for term in function.vector_functions:
            yield from _leaves(term)
    elif isinstance(function, ReversedVector):
        yield from _leaves(function.vector_function)
    else:
        yield function


def _segments(function: VectorFunction) -> Sequence[SPICESegment]:
    """Kernel segments of an elementary vector function; empty if it does not use a kernel."""
    if isinstance(function, Stack):
        return list(function.segments)
    return [function] if isinstance(function, SPICESegment) else []


def write_segments(function: VectorFunction) -> list[dict[str, Any]] | None:
    """Describe a vector function by tables of kernel segments; None if it has other components."""
    tables = []
    for term in getattr(function, "vector_functions", (function,)):
        inner = term.vector_function if isinstance(term, ReversedVector) else term
        if not _segments(inner):
            return None
        path = os.path.abspath(inner.ephemeris.path)
        tables.append(
            {
                "kernel": path,
                "centre": int(term.center),
                "target": int(term.target),
                "sha256": Ephemeris(path).sha256,
            }
        )
    return tables


def read_segments(tables: Sequence[Mapping[str, Any]], where: Where) -> VectorFunction:
    """Build a Skyfield vector function from tables that describe a chain of kernel segments.

    Raises
    ------
    SceneError
        If a table does not match a segment of its kernel, or the segments do not form a chain.
    KernelError
        If a kernel is invalid, or has another hash than in the table.
    """
    chain = tuple(_read_segment(table, where) for table in tables)
    for before, after in pairwise(chain):
        if before.target != after.center:
            problem = "each segment must start where the previous one ended"
            raise where.error(f"{before.target}, then {after.center}", problem)
    return chain[0] if len(chain) == 1 else VectorSum(chain[0].center, chain[-1].target, chain)


_NAMES = ("kernel", "centre", "target", "sha256")


def _read_segment(table: Mapping[str, Any], where: Where) -> VectorFunction:
    for name in table:
        if name not in _NAMES:
            raise where.at(name).error(table[name], nearest(name, _NAMES))
    codes = table.get("centre"), table.get("target")
    if not isinstance(table.get("kernel"), str) or not all(type(code) is int for code in codes):
        problem = "name a segment like {kernel = 'de421', centre = 0, target = 5}"
        raise where.error(dict(table), problem)
    file = open_ephemeris(table["kernel"])
    if table.get("sha256", file.sha256) != file.sha256:
        problem = "it is not the file that this position was read from: its SHA-256 is another"
        raise KernelError(file.path, problem, "restore that file, or omit sha256")
    segments = _spice_kernel(os.fspath(file.path), file.sha256).segments
    for (centre, target), reverse in ((codes, False), (codes[::-1], True)):
        matches = [s for s in segments if (s.center, s.target) == (centre, target)]
        if matches:
            function = matches[0] if len(matches) == 1 else Stack(matches)
            return -function if reverse else function
    available = ", ".join(f"{s.center} to {s.target}" for s in segments)
    raise where.error(f"{codes[0]} to {codes[1]}", f"the kernel has {available}")


@lru_cache
def _spice_kernel(path: str, sha256: str) -> SpiceKernel:
    """Open a kernel with Skyfield; a kernel with the same file and hash is opened once."""
    return SpiceKernel(path)

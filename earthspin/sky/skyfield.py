"""Positions, right ascensions and declinations, computed by Skyfield.

The call is ``(body - earth).at(t).frame_latlon(mean_equator_and_equinox_of_date)``. The geometric
`at(t)` is used, because gravity acts from the geometric position, not from the apparent one.
Skyfield's
mean equator of date differs from that of ERFA by 1.5e-12 rad. Its true equator is that of IAU 2000A
without the adjustment to IAU 2006 (1.3e-10 rad in 1900), so the true equator, like the equator of
any other body, is passed to Skyfield as a frame.
"""

from __future__ import annotations

import math
import os
import weakref
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from jplephem.spk import SPK
from skyfield.api import load
from skyfield.constants import AU_M
from skyfield.framelib import mean_equator_and_equinox_of_date
from skyfield.jpllib import SpiceKernel, SPICESegment, Stack
from skyfield.positionlib import ICRF
from skyfield.timelib import Time, Timescale
from skyfield.vectorlib import ReversedVector, VectorFunction, VectorSum

from earthspin._version import version
from earthspin.constants import J2000_JD
from earthspin.errors import EarthspinError, KernelError, UndefinedError, Where
from earthspin.numerics.arrays import FloatArray
from earthspin.sky.ephemeris import Ephemeris, open_ephemeris
from earthspin.sky.kernel import is_readable
from earthspin.sky.protocol import Place, Trajectory, checked, words

# --- vector functions as trajectories -------------------------------------------------------------
# A segment, a sum of vectors, a comet from its elements, a satellite or a custom function gives a
# position at a time, and can be the position of a body. Vector functions based on kernels only have
# a measured error and can be stored in scenes, segment by segment.

_BLOCK = 1 << 12  # times per block: 1365 nutation terms for each take 45 MB


@lru_cache
def timescale() -> Timescale:
    """Skyfield's time scale from tables included in Skyfield, without downloads."""
    return load.timescale(builtin=True)


def blocks_of_times(days: FloatArray) -> Iterator[tuple[slice, Time]]:
    """Yield given days (TDB from J2000.0) in blocks: the slice, and the times for Skyfield."""
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
    """Trajectory with positions from a Skyfield vector function.

    Attributes
    ----------
    function : VectorFunction
    """

    function: VectorFunction

    @property
    def centre(self) -> int:
        """NAIF code of the reference body of the vector function's positions."""
        return int(self.function.center)

    @cached_property
    def code(self) -> int | None:
        """NAIF code of the vector function's target if all segments are from kernels, else None."""
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


class _TrajectoryFunction(VectorFunction):  # type: ignore[misc]
    """Skyfield vector function with positions from a trajectory, without velocities."""

    def __init__(self, trajectory: Trajectory) -> None:
        self.trajectory, self.center, self.target = trajectory, trajectory.centre, self

    def _at(self, t: Time) -> tuple[FloatArray, FloatArray, None, None]:
        days = np.atleast_1d((t.whole - J2000_JD) + t.tdb_fraction)
        positions = checked(self.trajectory.positions(days), self.trajectory, days).T / AU_M
        return positions, np.full_like(positions, np.nan), None, None

    def __str__(self) -> str:
        return words(self.trajectory)


def function_of(trajectory: Trajectory) -> VectorFunction:
    """Convert a trajectory to a Skyfield vector function, by a wrapper if necessary."""
    if isinstance(trajectory, VectorTrajectory):
        return trajectory.function
    return _TrajectoryFunction(trajectory)


# --- segments of a vector function ------------------------------------------------------------


def _leaves(function: VectorFunction) -> Iterator[VectorFunction]:
    """Yield the elementary vector functions in a sum; a reversed one is yielded unreversed."""
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
        segment = {"centre": int(term.center), "target": int(term.target)}
        tables.append({"kernel": path} | segment | {"sha256": Ephemeris(path).sha256})
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
    where.refuse_unknown(table, _NAMES)
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
    return _ReadableSegments(path)


class _ReadableSegments(SpiceKernel):  # type: ignore[misc]
    """Kernel of Skyfield without segments of types that Skyfield does not read."""

    def __init__(self, path: str) -> None:
        self.path, self.filename, self.spk = path, os.path.basename(path), SPK.open(path)
        self.segments = [SPICESegment(self, s) for s in self.spk.segments if is_readable(s)]


# --- positions and directions by Skyfield ---------------------------------------------------------


@dataclass(frozen=True)
class SkyfieldEquator:
    """Skyfield frame of an equator of date, defined by rotation matrices for given days.

    Attributes
    ----------
    matrices : callable
        Function of days from J2000.0 TDB, shape (n,), that returns matrices from the ICRF, shape
        (n, 3, 3) or (3, 3).
    """

    matrices: Callable[[FloatArray], FloatArray]

    def rotation_at(self, t: Time) -> FloatArray:
        """Rotation matrices at the times of a Skyfield Time, shape (3, 3, n) or (3, 3)."""
        matrices = self.matrices((t.whole - J2000_JD) + t.tdb_fraction)
        return matrices if matrices.ndim == 2 else np.moveaxis(matrices, 0, -1)


class Skyfield(Ephemeris):
    """Ephemeris kernel from which Skyfield computes positions and directions.

    Codes, coverage and measured errors are those of an `Ephemeris`.

    Parameters
    ----------
    path : str or Path
    name : str, optional
        Name for messages; the file's name by default.
    """

    def __init__(self, path: str | Path, name: str | None = None) -> None:
        super().__init__(path, name)
        self.kernel = _ReadableSegments(str(self.path))
        weakref.finalize(self, self.kernel.spk.close)

    @property
    def provenance(self) -> dict[str, str]:
        """Name and hash of the kernel, and version of Skyfield, for the attributes of a result."""
        reader = {"ephemeris_reader": "Skyfield", "skyfield_version": version("skyfield")}
        return super().provenance | reader

    def positions(
        self, targets: Mapping[str, Place], centre: Place, days: FloatArray
    ) -> dict[str, FloatArray]:
        """Positions of bodies relative to a centre, from Skyfield, in the ICRF, m, (n, 3) each.

        That is ``(body - centre).at(t)``.

        Parameters
        ----------
        targets : mapping of str to int or Trajectory
            NAIF code or trajectory by label.
        centre : int or Trajectory
        days : ndarray, shape (n,)
            Days from J2000.0 TDB.

        Raises
        ------
        CoverageError
            If a time is outside the kernel or a trajectory.
        UndefinedError
            If a trajectory gives no finite position.
        """
        self.check_times(days, {*targets.values(), centre})
        self.check_records(days, {*targets.values(), centre})
        positions = {name: np.empty((days.size, 3)) for name in targets}
        for block, t in blocks_of_times(days):
            for name, place in targets.items():
                vectors = at(self._seen_from(place, centre), t).position.m.T
                positions[name][block] = checked(vectors, place, days[block])
        return positions

    def equator(self, days: FloatArray) -> FloatArray:
        """Matrices from the ICRF to Skyfield's mean equator and equinox of date.

        Parameters
        ----------
        days : ndarray, shape (n,)
            Days from J2000.0 TDB.

        Returns
        -------
        ndarray, shape (n, 3, 3)
        """
        matrices = np.empty((days.size, 3, 3))
        for block, t in blocks_of_times(days):
            matrices[block] = np.moveaxis(mean_equator_and_equinox_of_date.rotation_at(t), -1, 0)
        return matrices

    def radec(
        self,
        targets: Mapping[str, Place],
        centre: Place,
        days: FloatArray,
        equator: Callable[[FloatArray], FloatArray] | None,
    ) -> dict[str, tuple[FloatArray, FloatArray, FloatArray]]:
        """Right ascension, declination (rad) and distance (m) of each target, from Skyfield.

        That is ``(body - centre).at(t).frame_latlon(equator)``, with shape (n,) each.

        Parameters
        ----------
        targets, centre, days
            As for `positions`.
        equator : callable or None
            Matrices from the ICRF to the equator of date at days from J2000.0 TDB; None for
            Skyfield's mean equator and equinox of date.
        """
        self.check_times(days, {*targets.values(), centre})
        self.check_records(days, {*targets.values(), centre})
        frame = mean_equator_and_equinox_of_date if equator is None else SkyfieldEquator(equator)
        angles = {name: np.empty((3, days.size)) for name in targets}
        for block, t in blocks_of_times(days):
            for name, place in targets.items():
                position = at(self._seen_from(place, centre), t)
                checked(position.position.m.T, place, days[block])
                declination, right_ascension, distance = position.frame_latlon(frame)
                angles[name][:, block] = right_ascension.radians, declination.radians, distance.m
        return {name: (ra, dec, distance) for name, (ra, dec, distance) in angles.items()}

    def _seen_from(self, target: Place, centre: Place) -> VectorFunction:
        """Skyfield vector function for the position of one body relative to another."""
        if not isinstance(target, int) and target.centre == centre:
            return function_of(target)  # no common vectors to cancel
        if centre == 0:  # Skyfield has no vector function for the barycentre itself
            return self._from_barycentre(target)
        if target == 0:
            return -self._from_barycentre(centre)
        return self._from_barycentre(target) - self._from_barycentre(centre)

    def _from_barycentre(self, place: Place) -> VectorFunction:
        if isinstance(place, int):
            return self.kernel[place]
        function = function_of(place)
        return function if place.centre == 0 else self.kernel[place.centre] + function

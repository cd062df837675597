"""Protocols (required methods) of sources of positions and of trajectories.

A *source* gives positions of many bodies by their NAIF codes, as a kernel does. A *trajectory*
gives positions of one body relative to another, from any origin: a vector function of Skyfield, an
orbit, a table. Every source accepts trajectories in addition to its own codes.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from typing import Protocol, TypeAlias, runtime_checkable

import numpy as np

from earthspin.dates import date_text
from earthspin.errors import UndefinedError, Where
from earthspin.numerics.arrays import FloatArray
from earthspin.units import vectors


class Trajectory(Protocol):
    """Protocol of a trajectory: positions of one body relative to another, given by the user.

    It must be hashable, such as a frozen dataclass, so that a shared trajectory is evaluated once.

    Attributes
    ----------
    centre : int
        NAIF code of the reference body; 0 is the solar-system barycentre.
    coverage : tuple of float
        First and last day with positions, TDB from J2000.0; infinite if unlimited.
    code : int or None, not needed
        NAIF code of the body, for a trajectory based on a kernel whose error was measured. Without
        it no error is stated.
    """

    @property
    def centre(self) -> int:
        """NAIF code of the reference body; 0 is the solar-system barycentre."""

    @property
    def coverage(self) -> tuple[float, float]:
        """First and last day with positions, TDB from J2000.0; infinite if unlimited."""

    def positions(self, days: FloatArray, /) -> FloatArray:
        """Geometric positions of the body relative to its centre, in the ICRF, m, shape (n, 3).

        Parameters
        ----------
        days : ndarray, shape (n,)
            Days from J2000.0 TDB.
        """


#: Name of the source without a kernel, for bodies that all have elements.
BY_ELEMENTS = "elements of orbits"

#: Origin of a body's positions: a NAIF code of the source, or a trajectory.
Place: TypeAlias = "int | Trajectory"


class Source(Protocol):
    """Protocol of a source that gives the positions of many bodies.

    Attributes
    ----------
    name : str
        Name in messages and results.
    """

    @property
    def name(self) -> str:
        """Name of the source, as shown in messages and results."""

    @property
    def provenance(self) -> dict[str, str]:
        """Names, hashes and versions of files and programs that give the positions."""

    def code(self, codes: Iterable[int], name: str, /) -> int:
        """Return the first of a body's NAIF codes that the source has; KernelError if none."""

    def coverage(self, places: Iterable[Place], /) -> tuple[float, float]:
        """First and last day (TDB, from J2000.0) for which all given bodies have positions."""

    def check_times(self, days: FloatArray, places: Iterable[Place], /) -> None:
        """Refuse times at which any of the given bodies has no position, with a CoverageError."""

    def positions(
        self, targets: Mapping[str, Place], centre: Place, days: FloatArray, /
    ) -> dict[str, FloatArray]:
        """Geometric positions of targets relative to a centre, in the ICRF, m, (n, 3) each."""

    def error(self, target: Place, centre: Place, day: float, /) -> tuple[float, float]:
        """Bounds on the error of a body's direction (rad) and distance (m) on a day.

        The errors grow with the time from J2000.0; NaN if no error was measured.
        """

    def drift(self, target: Place, centre: Place, distance: float, /) -> float:
        """Relative error of the spin axis motion due to the position error of a perturber.

        It is a fraction of the angle by which the axis moves.

        Parameters
        ----------
        target, centre : Place
        distance : float
            Distance between the two bodies, m.
        """


@runtime_checkable
class OfDate(Protocol):
    """Protocol of a source that gives right ascension and declination as well as positions."""

    def equator(self, days: FloatArray, /) -> FloatArray:
        """Matrices from the ICRF to the Earth's mean equator of date, shape (n, 3, 3)."""

    def radec(
        self,
        targets: Mapping[str, Place],
        centre: Place,
        days: FloatArray,
        equator: Callable[[FloatArray], FloatArray] | None,
        /,
    ) -> dict[str, tuple[FloatArray, FloatArray, FloatArray]]:
        """Right ascension, declination (rad) and distance (m) of each target, shape (n,) each.

        The equator is given by its matrices, or is the Earth's mean equator of date.
        """


def measured_code(place: Place) -> int | None:
    """NAIF code of a body, to look up its measured position error; None if it has no code."""
    return place if isinstance(place, int) else getattr(place, "code", None)


def words(place: object) -> str:
    """Describe a NAIF code or trajectory in one line of text, without memory addresses."""
    text = f"NAIF {place}" if isinstance(place, int) else " ".join(str(place).split())
    return re.sub(r" at 0x[0-9a-fA-F]+", "", text)


def checked(positions: FloatArray, place: Place, days: FloatArray) -> FloatArray:
    """Check and return a trajectory's positions: one finite vector for each time.

    Raises
    ------
    UndefinedError
        If the shape is wrong or a position is not finite; gives the first such day.
    UnitsError, SceneError
        If the positions are no lengths, or have other labels than x, y and z.
    """
    values = vectors(positions, "m", Where(words(place)), "384399 km")
    if values.shape != (days.size, 3):
        raise UndefinedError(
            f"{words(place)} gives positions of shape {values.shape} at {days.size} times; one "
            f"body has shape ({days.size}, 3)"
        )
    missing = ~np.isfinite(values).all(axis=1)
    if missing.any():
        date = date_text(days[missing][0], "s")
        raise UndefinedError(
            f"{words(place)} gives no finite position on {date} TDB; choose times at which it does"
        )
    return values

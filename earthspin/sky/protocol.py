"""What gives positions: the protocols that a source and a trajectory keep.

A *source* places many bodies by their NAIF codes, as a kernel does. A *trajectory* places one body
as seen from another, whatever it stands on: a vector function of Skyfield's, an orbit, a table.
Every source takes trajectories beside its own codes; nothing above this package knows which is
which.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Protocol, TypeAlias, runtime_checkable

import numpy as np

from earthspin.dates import datetime64
from earthspin.errors import UndefinedError, one_line
from earthspin.units import real_numbers

if TYPE_CHECKING:
    from numpy.typing import NDArray

    FloatArray: TypeAlias = NDArray[np.float64]


class Trajectory(Protocol):
    """One body as seen from another: all that is needed to place a body of one's own.

    It can be hashed, as a frozen dataclass can: what two bodies share is evaluated once.

    Attributes
    ----------
    centre : int
        NAIF code of what it is seen from; 0 is the barycentre of the solar system.
    coverage : tuple of float
        First and last day on which it is known, TDB from J2000.0; infinite if always.
    code : int or None, not needed
        NAIF code by which the measured error of a kernel is found, if a kernel is what it stands
        on. Without it no error is claimed.
    """

    @property
    def centre(self) -> int: ...  # noqa: D102
    @property
    def coverage(self) -> tuple[float, float]: ...  # noqa: D102

    def positions(self, days: FloatArray, /) -> FloatArray:
        """Geometric positions in metres along the axes of the ICRF, shape (n, 3).

        Parameters
        ----------
        days : ndarray, shape (n,)
            Days from J2000.0 TDB.
        """


#: Name of the source that needs no kernel, as everything has elements.
BY_ELEMENTS = "elements of orbits"

#: Where a body is found: by a NAIF code in the source, or along a trajectory.
Place: TypeAlias = "int | Trajectory"


class Source(Protocol):
    """Positions of many bodies.

    Attributes
    ----------
    name : str
        What it is called in messages and results.
    """

    @property
    def name(self) -> str: ...  # noqa: D102

    @property
    def provenance(self) -> dict[str, str]:
        """What tells it from any other: names, hashes, versions, for the attributes of answers."""

    def code(self, codes: Iterable[int], name: str, /) -> int:
        """First of a body's NAIF codes that it can place; KernelError if there is none."""

    def coverage(self, places: Iterable[Place], /) -> tuple[float, float]:
        """First and last day (TDB, from J2000.0) on which all of these can be placed."""

    def check_times(self, days: FloatArray, places: Iterable[Place], /) -> None:
        """Refuse, with a CoverageError, times at which not all of these can be placed."""

    def positions(
        self, targets: Mapping[str, Place], centre: Place, days: FloatArray, /
    ) -> dict[str, FloatArray]:
        """Geometric positions as seen from a body, m along the ICRF, shape (n, 3) each."""

    def error(self, target: Place, centre: Place, day: float, /) -> tuple[float, float]:
        """How far a body may be on a day from where it is put: angle (rad), distance (m).

        It grows with the distance of the day from J2000.0; NaN where no error was ever measured.
        """

    def drift(self, target: Place, centre: Place, distance: float, /) -> float:
        """By what the pull of a body may turn an axis aside, over the angle that the axis sweeps.

        Parameters
        ----------
        target, centre : Place
        distance : float
            Between them, m.
        """


@runtime_checkable
class OfDate(Protocol):
    """A source that measures right ascension and declination itself."""

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
        """Right ascension, declination (rad) and distance (m), shape (n,) each.

        They refer to an equator given by its matrices, or to the Earth's mean equator of date.
        """


def measured_code(place: Place) -> int | None:
    """NAIF code under which the error of a place was measured; None if it never was."""
    return place if isinstance(place, int) else getattr(place, "code", None)


def words(place: object) -> str:
    """A place for people, on one line; the same in every run."""
    text = f"NAIF {place}" if isinstance(place, int) else " ".join(str(place).split())
    return re.sub(r" at 0x[0-9a-fA-F]+", "", text)


def checked(positions: FloatArray, place: Place, days: FloatArray) -> FloatArray:
    """Positions of a place, if they are one finite vector for each time.

    Raises
    ------
    UndefinedError
        Naming the first day on which they are not.
    """
    try:
        values = real_numbers(positions)
    except (TypeError, ValueError) as error:
        raise UndefinedError(f"{words(place)} gives positions that are {one_line(error)}") from None
    if values.shape != (days.size, 3):
        raise UndefinedError(
            f"{words(place)} gives positions of shape {values.shape} at {days.size} times; one "
            f"body has shape ({days.size}, 3)"
        )
    lost = ~np.isfinite(values).all(axis=1)
    if lost.any():
        date = str(datetime64(days[lost][:1])[0])[:19]
        raise UndefinedError(
            f"{words(place)} gives no finite position on {date} TDB; choose times at which it does"
        )
    return values

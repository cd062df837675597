"""Positions by Skyfield, read the obvious way: ``(body - earth).at(t).radec(epoch="date")``.

A source beside the fast reader, slower and as exact, and the way to read the method. Three things
are worth knowing:

- ``at(t)`` is geometric: gravity pulls from where a body is, not from where its light left it.
- ``radec(epoch="date")`` refers to the *true* equator of date. A time without nutation refers it
  to the mean one; Skyfield's own way to say that is to set the angles of nutation of the time.
- Skyfield adds up IAU 2000A as it was published. IAU 2006 changed it a little (`SCALE_2006`,
  `J2_RATE_2006`): 4e-11 rad by 2030, 1.3e-10 rad in 1900. With that change, declinations are those
  of the fast reader and ERFA to 5e-12 rad (the mean ones to 2e-12), over all that DE421 covers.
"""

from __future__ import annotations

import weakref
from collections.abc import Iterable, Mapping
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from skyfield.jpllib import SpiceKernel
from skyfield.nutationlib import iau2000a_radians
from skyfield.timelib import Time
from skyfield.vectorlib import VectorFunction

from earthspin._version import version
from earthspin.constants import DAYS_PER_CENTURY, J2000_JD
from earthspin.sky.ephemeris import Ephemeris
from earthspin.sky.protocol import Place, checked
from earthspin.sky.vector_functions import at, blocks_of_times, function_of

FloatArray: TypeAlias = NDArray[np.float64]

#: What IAU 2006 changes in the nutation of IAU 2000A: the scale of the longitude, for the
#: obliquity that it starts from, and the rate of J2 per century in both (Wallace & Capitaine 2006,
#: Astron. Astrophys. 459, 981, eq. 5).
SCALE_2006, J2_RATE_2006 = 0.4697e-6, -2.7774e-6


class Skyfield:
    """A kernel, its positions read by Skyfield.

    Parameters
    ----------
    file : Ephemeris
        The kernel; codes, coverage and measured errors are those of the file.
    """

    def __init__(self, file: Ephemeris) -> None:
        self.file, self.name = file, file.name
        self.kernel = SpiceKernel(str(file.path))
        weakref.finalize(self, self.kernel.spk.close)

    @property
    def provenance(self) -> dict[str, str]:
        """Kernel and reader, for the attributes of an answer."""
        return self.file.provenance | {"skyfield_version": version("skyfield")}

    def code(self, codes: Iterable[int], name: str) -> int:
        """First of a body's NAIF codes that the kernel holds; KernelError if there is none."""
        return self.file.code(codes, name)

    def coverage(self, places: Iterable[Place]) -> tuple[float, float]:
        """First and last day (TDB, from J2000.0) on which all of these can be placed."""
        return self.file.coverage(places)

    def check_times(self, days: FloatArray, places: Iterable[Place]) -> None:
        """Refuse, with a CoverageError, times at which not all of these can be placed."""
        self.file.check_times(days, places)

    def error(self, target: Place, centre: Place, day: float = 0.0) -> tuple[float, float]:
        """How far a body may be from where it is put: angle (rad), distance (m); the kernel's."""
        return self.file.error(target, centre, day)

    def drift(self, target: Place, centre: Place, distance: float) -> float:
        """By what the pull of a body may turn an axis aside; the kernel's."""
        return self.file.drift(target, centre, distance)

    def positions(
        self, targets: Mapping[str, Place], centre: Place, days: FloatArray
    ) -> dict[str, FloatArray]:
        """Positions ``(body - centre).at(t)``, m along the ICRF, shape (n, 3) each.

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
            If a time lies outside the kernel or a trajectory.
        UndefinedError
            If a trajectory gives no finite position.
        """
        self.check_times(days, {*targets.values(), centre})
        self.file.check_records(days, {*targets.values(), centre})
        found = {name: np.empty((days.size, 3)) for name in targets}
        for block, t in blocks_of_times(days):
            for name, place in targets.items():
                there = at(self._seen_from(place, centre), t).position.m.T
                found[name][block] = checked(there, place, days[block])
        return found

    def equator(self, days: FloatArray, *, true: bool) -> FloatArray:
        """What ``radec(epoch="date")`` turns a position by, ``t.M``, shape (n, 3, 3).

        Parameters
        ----------
        days : ndarray, shape (n,)
            Days from J2000.0 TDB.
        true : bool
            With nutation, or without.
        """
        matrices = np.empty((days.size, 3, 3))
        for block, t in blocks_of_times(days):
            matrices[block] = np.moveaxis(_with_equator(t, true=true).M, -1, 0)
        return matrices

    def radec(
        self, targets: Mapping[str, Place], centre: Place, days: FloatArray, *, true: bool
    ) -> dict[str, tuple[FloatArray, FloatArray, FloatArray]]:
        """``(body - centre).at(t).radec(epoch="date")``: rad, rad and m, shape (n,) each.

        Parameters
        ----------
        targets, centre, days
            As `positions` takes them.
        true : bool
            At the true equator and equinox of date, or at the mean ones.
        """
        self.check_times(days, {*targets.values(), centre})
        self.file.check_records(days, {*targets.values(), centre})
        found = {name: np.empty((3, days.size)) for name in targets}
        for block, t in blocks_of_times(days):
            t = _with_equator(t, true=true)
            for name, place in targets.items():
                there = at(self._seen_from(place, centre), t)
                checked(there.position.m.T, place, days[block])
                ra, dec, distance = there.radec(epoch="date")
                found[name][:, block] = ra.radians, dec.radians, distance.m
        return {name: (ra, dec, distance) for name, (ra, dec, distance) in found.items()}

    def _seen_from(self, target: Place, centre: Place) -> VectorFunction:
        """Vector function from one body to another."""
        if not isinstance(target, int) and target.centre == centre:
            return function_of(target)  # nothing between them that would cancel
        return self._from_barycentre(target) - self._from_barycentre(centre)

    def _from_barycentre(self, place: Place) -> VectorFunction:
        if isinstance(place, int):
            return self.kernel[place]
        own = function_of(place)
        return own if place.centre == 0 else self.kernel[place.centre] + own


def _with_equator(t: Time, *, true: bool) -> Time:
    """A time whose equator of date is that of IAU 2006, with the nutation 2000A or without."""
    if true:
        longitude, obliquity = iau2000a_radians(t)
        of_j2 = J2_RATE_2006 * (t.tt - J2000_JD) / DAYS_PER_CENTURY
        angles = longitude * (1 + SCALE_2006 + of_j2), obliquity * (1 + of_j2)
    else:
        angles = np.zeros_like(t.tt), np.zeros_like(t.tt)
    t._nutation_angles_radians = angles  # what Skyfield computes when it is first asked
    return t

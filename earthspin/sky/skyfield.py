"""Positions, right ascensions and declinations, computed by Skyfield.

The call is ``(body - earth).at(t).frame_latlon(mean_equator_and_equinox_of_date)``. The geometric
`at(t)` is used, because gravity acts from the geometric position, not from the apparent one.
Skyfield's
mean equator of date differs from that of ERFA by 1.5e-12 rad. Its true equator is that of IAU 2000A
without the adjustment to IAU 2006 (1.3e-10 rad in 1900), so the true equator, like the equator of
any other body, is passed to Skyfield as a frame.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from skyfield.framelib import mean_equator_and_equinox_of_date
from skyfield.jpllib import SpiceKernel
from skyfield.timelib import Time
from skyfield.vectorlib import VectorFunction

from earthspin._version import version
from earthspin.constants import J2000_JD
from earthspin.numerics.arrays import FloatArray
from earthspin.sky.ephemeris import Ephemeris
from earthspin.sky.protocol import Place, checked
from earthspin.sky.vector_functions import at, blocks_of_times, function_of


@dataclass(frozen=True)
class EquatorOfDate:
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


class Skyfield:
    """Source of positions that Skyfield computes from an ephemeris kernel.

    Parameters
    ----------
    file : Ephemeris
        The kernel, which also provides codes, coverage and measured errors.
    """

    def __init__(self, file: Ephemeris) -> None:
        self.file, self.name = file, file.name
        self.kernel = SpiceKernel(str(file.path))
        weakref.finalize(self, self.kernel.spk.close)

    @property
    def provenance(self) -> dict[str, str]:
        """Name and hash of the kernel, and version of Skyfield, for the attributes of a result."""
        return self.file.provenance | {
            "ephemeris_reader": "Skyfield",
            "skyfield_version": version("skyfield"),
        }

    def code(self, codes: Iterable[int], name: str) -> int:
        """Return the first of a body's NAIF codes that the kernel has; KernelError if none."""
        return self.file.code(codes, name)

    def coverage(self, places: Iterable[Place]) -> tuple[float, float]:
        """First and last day (TDB, from J2000.0) for which all given bodies have positions."""
        return self.file.coverage(places)

    def check_times(self, days: FloatArray, places: Iterable[Place]) -> None:
        """Refuse times at which any of the given bodies has no position, with a CoverageError."""
        self.file.check_times(days, places)

    def error(self, target: Place, centre: Place, day: float = 0.0) -> tuple[float, float]:
        """Bounds on the error of a body's direction (rad) and distance (m) in the kernel."""
        return self.file.error(target, centre, day)

    def drift(self, target: Place, centre: Place, distance: float) -> float:
        """Relative error of the spin axis motion due to the position error of a perturber.

        It is a fraction of the angle by which the axis moves.
        """
        return self.file.drift(target, centre, distance)

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
        self.file.check_records(days, {*targets.values(), centre})
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
        self.file.check_records(days, {*targets.values(), centre})
        frame = mean_equator_and_equinox_of_date if equator is None else EquatorOfDate(equator)
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
        return self._from_barycentre(target) - self._from_barycentre(centre)

    def _from_barycentre(self, place: Place) -> VectorFunction:
        if isinstance(place, int):
            return self.kernel[place]
        function = function_of(place)
        return function if place.centre == 0 else self.kernel[place.centre] + function

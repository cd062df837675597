"""Positions of bodies from Keplerian orbital elements, without an ephemeris kernel.

Orbits are ellipses whose node and pericentre precess at constant rates. If the elements define the
orbit, the only errors are those of rounding; mean elements of a real orbit state how far it departs
from the ellipse.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Self

import numpy as np

from earthspin.constants import DAY, DAYS_PER_CENTURY
from earthspin.errors import SceneError, UndefinedError
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.kepler import eccentric_anomaly
from earthspin.sky.iau_models import fixed_ecliptic
from earthspin.sky.poles import Direction, PoleModel, fixed_equator
from earthspin.sky.protocol import BY_ELEMENTS, Place, checked

#: Bound on the error of a direction in units of the rounding of all angles; measured: 0.73 at most,
#: for 301 days in two centuries at e up to 0.99, against 50-digit arithmetic.
ROUNDINGS = 2

#: Code of the spinning body in `Elements`.
CENTRE = 0
#: Default span for searches and averages: days before and after J2000.0.
USUAL_REACH = 0.75 * DAYS_PER_CENTURY

_EPS = float(np.finfo(float).eps)


@dataclass(frozen=True)
class Plane:
    """Reference plane for the inclination and node of an orbit, such as the ecliptic.

    Attributes
    ----------
    axes : tuple of float
        Nine numbers, row by row: unit vectors towards longitude 0, longitude 90 degrees and the
        pole, in the ICRF.
    """

    axes: tuple[float, ...]

    @classmethod
    def of(cls, word: str, pole: PoleModel | None, orbit: Direction | None) -> Self:
        """Create the reference plane of an orbit from its name, such as "ecliptic".

        Parameters
        ----------
        word : str
            ``"ecliptic"``, ``"equator"``, ``"orbit"`` or ``"icrf"``.
        pole : PoleModel or None
            Pole of the spinning body, at J2000.0.
        orbit : Direction or None
            Normal of the spinning body's orbit.

        Raises
        ------
        UndefinedError
            If the body has no such plane.
        """
        if word == "icrf":
            return cls(tuple(np.eye(3).ravel().tolist()))
        if word == "ecliptic":
            return cls(tuple(fixed_ecliptic().ravel().tolist()))
        if pole is None:
            raise UndefinedError(f"plane = '{word}' needs the body's pole; give it")
        if word == "orbit":
            return cls(tuple(pole.orbit_axes(orbit).ravel().tolist()))
        if orbit is None and not pole.of_the_iau:
            rows = fixed_equator(pole.true(0.0), np.array([0.0, 0.0, -1.0]))
        else:
            rows = pole.equator(orbit, np.zeros(1)).reshape(3, 3)
        return cls(tuple(rows.ravel().tolist()))

    @property
    def matrix(self) -> FloatArray:
        """Matrix that rotates vectors from the ICRF to the reference plane, shape (3, 3)."""
        return np.array(self.axes).reshape(3, 3)

    def normal(self, i: float, node: float) -> FloatArray:
        """Unit normal of an orbit with given inclination and node, in the ICRF, shape (3,)."""
        tilted = [math.sin(i) * math.sin(node), -math.sin(i) * math.cos(node), math.cos(i)]
        return np.asarray(np.array(tilted) @ self.matrix)

    def mean_normal(self, i: float, node: float, node_period: float | None) -> Direction:
        """Return the pole of this plane if the node precesses, else the normal of the orbit."""
        x, y, z = self.normal(0.0 if node_period is not None else i, node)
        return Direction(math.atan2(y, x), math.atan2(z, math.hypot(x, y)))


@dataclass(frozen=True)
class Ellipse:
    """Orbit of one body about another: an ellipse whose node and pericentre may precess.

    Attributes
    ----------
    a, e, i, node, pericentre, mean_anomaly
        Elements at the epoch.
    epoch : float
        Days from J2000.0 TDB.
    motion, node_rate, pericentre_rate : float
        Rates of mean anomaly, node, and argument of the pericentre, rad/s.
    plane : Plane
    direction_error, direction_drift, distance_error, distance_drift : float
        Bounds on what the ellipse differs from the real orbit by: angle at the epoch, rad, and its
        growth, rad/s; distance at the epoch, m, and its growth, m/s; zero if the elements define
        the orbit.
    """

    a: float
    e: float
    i: float
    node: float
    pericentre: float
    mean_anomaly: float
    epoch: float
    motion: float
    node_rate: float
    pericentre_rate: float
    plane: Plane
    direction_error: float = 0.0
    direction_drift: float = 0.0
    distance_error: float = 0.0
    distance_drift: float = 0.0

    @property
    def normal(self) -> FloatArray:
        """Unit normal of the orbit at its epoch, in the ICRF, shape (3,)."""
        return self.plane.normal(self.i, self.node)

    @property
    def sidereal_motion(self) -> float:
        """Rate of the body's mean longitude, precession of the orbit included, rad/s."""
        return self.motion + self.node_rate + self.pericentre_rate

    def positions(self, days: FloatArray) -> FloatArray:
        """Positions of the body relative to the focus of the ellipse, m, in the ICRF, shape (n, 3).

        Parameters
        ----------
        days : ndarray, shape (n,)
            Days from J2000.0 TDB.
        """
        time = (days - self.epoch) * DAY
        anomaly = eccentric_anomaly(self.mean_anomaly + self.motion * time, np.asarray(self.e))
        # from the focus, with x towards the pericentre; (1 - e) is separate to avoid cancellation
        x = self.a * ((1 - self.e) - 2 * np.sin(anomaly / 2) ** 2)
        y = self.a * math.sqrt((1 - self.e) * (1 + self.e)) * np.sin(anomaly)
        argument = self.pericentre + self.pericentre_rate * time  # from the node
        cos, sin = np.cos(argument), np.sin(argument)
        ahead, aside = x * cos - y * sin, x * sin + y * cos
        node = self.node + self.node_rate * time
        flat, height = aside * math.cos(self.i), aside * math.sin(self.i)
        cos, sin = np.cos(node), np.sin(node)
        in_plane = np.stack([ahead * cos - flat * sin, ahead * sin + flat * cos, height], axis=-1)
        return np.asarray(in_plane @ self.plane.matrix)

    def error(self, day: float) -> tuple[float, float]:
        """Bounds on the errors of the body's direction (rad) and distance (m) on a day.

        They contain rounding, and the difference of the ellipse from the real orbit. An error of
        the mean anomaly is amplified in direction by at most sqrt(1 + e)/(1 - e)^(3/2); in
        distance, to which node and pericentre do not matter, by a e/sqrt(1 - e^2).
        """
        time = abs(day - self.epoch) * DAY
        angles = abs(self.mean_anomaly) + abs(self.node) + abs(self.pericentre)
        rates = abs(self.motion) + abs(self.node_rate) + abs(self.pericentre_rate)
        steepest = math.sqrt(1 + self.e) / (1 - self.e) ** 1.5
        angle = ROUNDINGS * _EPS * (1 + angles + rates * time) * steepest
        radial = self.e / math.sqrt((1 - self.e) * (1 + self.e))
        anomaly = ROUNDINGS * _EPS * (1 + abs(self.mean_anomaly) + abs(self.motion) * time)
        rounding = self.a * ((ROUNDINGS + 1) * _EPS * (1 + self.e) + anomaly * radial)
        real, far = self.departure(day)
        return angle + real, rounding + far

    def departure(self, day: float) -> tuple[float, float]:
        """Bounds on the angle (rad) and distance (m) of the ellipse from the real orbit."""
        time = abs(day - self.epoch) * DAY
        angle = self.direction_error + self.direction_drift * time
        return angle, self.distance_error + self.distance_drift * time

    def rounding(self, day: float) -> float:
        """Relative error of the tidal tensor on a given day due to rounding of the mean longitude.

        Half a unit in the last place of the mean longitude: measured, see docs/coverage.md.
        """
        rates = abs(self.motion) + abs(self.node_rate) + abs(self.pericentre_rate)
        return _EPS / 2 * (1 + rates * abs(day - self.epoch) * DAY)


@dataclass(frozen=True)
class ByElements:
    """Trajectory of a body as the sum of position vectors on a chain of Keplerian orbits.

    Attributes
    ----------
    ellipses : tuple of (Ellipse, int)
        Chain from the centre to the body; the number is 1, or -1 if the vector of an ellipse is
        subtracted.
    centre : int
        NAIF code of the start of the chain.
    """

    ellipses: tuple[tuple[Ellipse, int], ...]
    centre: int

    @property
    def coverage(self) -> tuple[float, float]:
        """First and last day with positions: minus and plus infinity, as orbits have no end."""
        return -math.inf, math.inf

    def positions(self, days: FloatArray) -> FloatArray:
        """Positions of the body relative to the centre, in the ICRF, m, shape (n, 3)."""
        first, sign = self.ellipses[0]
        total = sign * first.positions(days)
        for ellipse, sign in self.ellipses[1:]:
            total = total + sign * ellipse.positions(days)
        return total

    @property
    def is_mean(self) -> bool:
        """Return True if a real orbit is known to differ from one of the ellipses."""
        return any(max(ellipse.departure(0.0)) > 0 for ellipse, _ in self.ellipses)

    def error(self, day: float) -> tuple[float, float]:
        """Bounds on the errors of direction (rad) and distance (m), summed over the ellipses."""
        angles, distances = zip(*(ellipse.error(day) for ellipse, _ in self.ellipses), strict=True)
        return sum(angles), sum(distances)

    def rounding(self, day: float) -> float:
        """Relative error of the tidal tensor due to rounding, summed over the ellipses."""
        return sum(ellipse.rounding(day) for ellipse, _ in self.ellipses)

    def __str__(self) -> str:
        return " and ".join(
            f"an ellipse of {ellipse.a:.6g} m, e = {ellipse.e:.6g}" for ellipse, _ in self.ellipses
        )


class Elements:
    """Source of positions of bodies that all have orbital elements; no kernel is needed."""

    name = BY_ELEMENTS

    @property
    def provenance(self) -> dict[str, str]:
        """Result attribute that says how positions are computed: from orbital elements."""
        return {"positions": "by the elements of orbits, without a kernel"}

    def code(self, codes: Iterable[int], name: str) -> int:
        """Raise an error: this source has no NAIF codes, so each body needs orbital elements.

        Raises
        ------
        SceneError
        """
        raise SceneError("perturbers", name, "it has no orbit by elements; give it one")

    def coverage(self, places: Iterable[Place]) -> tuple[float, float]:
        """First and last day with positions: minus and plus infinity, as orbits have no end."""
        return -math.inf, math.inf

    def check_times(self, days: FloatArray, places: Iterable[Place]) -> None:
        """Refuse times that are not finite."""
        if not np.all(np.isfinite(days)):
            raise UndefinedError("a time is not finite")

    def positions(
        self, targets: Mapping[str, Place], centre: Place, days: FloatArray
    ) -> dict[str, FloatArray]:
        """Positions of the targets relative to the centre, in the ICRF, m, shape (n, 3) each."""
        self.check_times(days, ())
        return {
            name: checked(_trajectory(place).positions(days), place, days)
            for name, place in targets.items()
        }

    def error(self, target: Place, centre: Place, day: float = 0.0) -> tuple[float, float]:
        """Bounds on the errors of a body's direction (rad) and distance (m) on a day."""
        return _trajectory(target).error(day)

    def drift(self, target: Place, centre: Place, distance: float) -> float:
        """Relative error of the spin axis motion due to the position error of a perturber.

        It is a fraction of the angle by which the axis moves.
        """
        angle, metres = self.error(target, centre)
        return 2 * angle + 3 * metres / distance


def _trajectory(place: Place) -> ByElements:
    """Return the trajectory of a body; refuse a body that has no orbital elements."""
    if not isinstance(place, ByElements):
        raise SceneError("perturbers", place, "it has no orbit by elements; give it one")
    return place

"""Orbits by their elements: places without a kernel.

An ellipse whose node and pericentre turn at even rates, solved by Kepler's equation. Whatever is
placed by such ellipses alone has errors of rounding: the elements are the orbit.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import DAY, DAYS_PER_CENTURY
from earthspin.errors import SceneError, UndefinedError
from earthspin.numerics.kepler import eccentric_anomaly
from earthspin.sky.equator import fixed_equator
from earthspin.sky.poles import Direction, Pole
from earthspin.sky.protocol import BY_ELEMENTS, Place, checked

FloatArray = NDArray[np.float64]

#: Roundings in a direction, of all angles together; measured: 0.73 at most, over 301 days of two
#: centuries at e up to 0.99, against 50 digits.
ROUNDINGS = 2

#: Code of the spinning body in `Elements`.
CENTRE = 0
#: Days each way from J2000.0 that are searched or averaged over where no span is given.
USUAL_REACH = 0.75 * DAYS_PER_CENTURY

_EPS = float(np.finfo(float).eps)


@dataclass(frozen=True)
class Plane:
    """What the angles of an orbit are counted from.

    Attributes
    ----------
    axes : tuple of float
        Nine numbers, row by row: unit vectors to where longitudes begin, a quarter turn on, and
        to the pole, along the ICRF.
    """

    axes: tuple[float, ...]

    @classmethod
    def of(cls, word: str, pole: Pole | None, orbit: Direction | None) -> Self:
        """Make a plane from its word.

        Parameters
        ----------
        word : str
            ``"ecliptic"``, ``"equator"``, ``"orbit"`` or ``"icrf"``.
        pole : Pole or None
            Of the spinning body, at J2000.0.
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
            from earthspin.sky.iau import fixed_ecliptic

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
        """From the ICRF to the plane, shape (3, 3)."""
        return np.array(self.axes).reshape(3, 3)

    def normal(self, i: float, node: float) -> FloatArray:
        """Unit normal of an orbit along the ICRF, shape (3,)."""
        tilted = [math.sin(i) * math.sin(node), -math.sin(i) * math.cos(node), math.cos(i)]
        return np.asarray(np.array(tilted) @ self.matrix)

    def mean_normal(self, i: float, node: float, node_period: float | None) -> Direction:
        """Where the normal of an orbit points; of one whose node turns, the plane's own."""
        x, y, z = self.normal(0.0 if node_period is not None else i, node)
        return Direction(math.atan2(y, x), math.atan2(z, math.hypot(x, y)))


@dataclass(frozen=True)
class Ellipse:
    """An ellipse that turns: the orbit of one body about another, in SI and radians.

    Attributes
    ----------
    a, e, i, node, pericentre, mean_anomaly
        Elements at the epoch.
    epoch : float
        Days from J2000.0 TDB.
    motion, node_rate, pericentre_rate : float
        Rates of mean anomaly, node, and argument of the pericentre, rad/s.
    plane : Plane
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

    @property
    def normal(self) -> FloatArray:
        """Unit normal at the epoch along the ICRF, shape (3,)."""
        return self.plane.normal(self.i, self.node)

    @property
    def sidereal_motion(self) -> float:
        """Rate of the mean longitude, rad/s."""
        return self.motion + self.node_rate + self.pericentre_rate

    def positions(self, days: FloatArray) -> FloatArray:
        """Positions about the focus in metres along the ICRF, shape (n, 3).

        Parameters
        ----------
        days : ndarray, shape (n,)
            Days from J2000.0 TDB.
        """
        time = (days - self.epoch) * DAY
        anomaly = eccentric_anomaly(self.mean_anomaly + self.motion * time, np.asarray(self.e))
        # from the focus, x to the pericentre; (1 - e) stands apart, so that nothing cancels there
        x = self.a * ((1 - self.e) - 2 * np.sin(anomaly / 2) ** 2)
        y = self.a * math.sqrt((1 - self.e) * (1 + self.e)) * np.sin(anomaly)
        along = self.pericentre + self.pericentre_rate * time  # from the node
        cos, sin = np.cos(along), np.sin(along)
        ahead, across = x * cos - y * sin, x * sin + y * cos
        node = self.node + self.node_rate * time
        flat, up = across * math.cos(self.i), across * math.sin(self.i)
        cos, sin = np.cos(node), np.sin(node)
        in_plane = np.stack([ahead * cos - flat * sin, ahead * sin + flat * cos, up], axis=-1)
        return np.asarray(in_plane @ self.plane.matrix)

    def error(self, day: float) -> tuple[float, float]:
        """What rounding does to a direction (rad) and a distance (m) on a day.

        A mean anomaly that is off turns the body by sqrt(1 + e)/(1 - e)^(3/2) of it at most.
        """
        time = abs(day - self.epoch) * DAY
        angles = abs(self.mean_anomaly) + abs(self.node) + abs(self.pericentre)
        rates = abs(self.motion) + abs(self.node_rate) + abs(self.pericentre_rate)
        steepest = math.sqrt(1 + self.e) / (1 - self.e) ** 1.5
        angle = ROUNDINGS * _EPS * (1 + angles + rates * time) * steepest
        return angle, self.a * (1 + self.e) * angle

    def rounding(self, day: float) -> float:
        """Relative change of the tide that has the effect of rounding on a day.

        Half a unit in the last place of the mean longitude: measured, see docs/coverage.md.
        """
        rates = abs(self.motion) + abs(self.node_rate) + abs(self.pericentre_rate)
        return _EPS / 2 * (1 + rates * abs(day - self.epoch) * DAY)


@dataclass(frozen=True)
class ByElements:
    """A body placed by ellipses that follow one another: a trajectory.

    Attributes
    ----------
    ellipses : tuple of (Ellipse, int)
        From the centre outwards; the number is 1, or -1 where an ellipse is gone back.
    centre : int
        NAIF code of where the first one starts.
    """

    ellipses: tuple[tuple[Ellipse, int], ...]
    centre: int

    @property
    def coverage(self) -> tuple[float, float]:
        """Always."""
        return -math.inf, math.inf

    def positions(self, days: FloatArray) -> FloatArray:
        """Positions in metres along the ICRF, shape (n, 3)."""
        first, sign = self.ellipses[0]
        total = sign * first.positions(days)
        for ellipse, sign in self.ellipses[1:]:
            total = total + sign * ellipse.positions(days)
        return total

    def error(self, day: float) -> tuple[float, float]:
        """What rounding does to the direction (rad) and the distance (m) on a day."""
        angles, distances = zip(*(ellipse.error(day) for ellipse, _ in self.ellipses), strict=True)
        return sum(angles), sum(distances)

    def rounding(self, day: float) -> float:
        """Relative change of the tide that has the effect of rounding on a day."""
        return sum(ellipse.rounding(day) for ellipse, _ in self.ellipses)

    def __str__(self) -> str:
        return " and ".join(
            f"an ellipse of {ellipse.a:.6g} m, e = {ellipse.e:.6g}" for ellipse, _ in self.ellipses
        )


class Elements:
    """The source of positions of a question all of whose bodies have elements."""

    name = BY_ELEMENTS

    @property
    def provenance(self) -> dict[str, str]:
        """Nothing but the elements, which stand in the scene."""
        return {"positions": "by the elements of orbits, without a kernel"}

    def code(self, codes: Iterable[int], name: str) -> int:
        """Refuse: what has no elements cannot be placed.

        Raises
        ------
        SceneError
        """
        raise SceneError("perturbers", name, "it has no orbit by elements; give it one")

    def coverage(self, places: Iterable[Place]) -> tuple[float, float]:
        """Always."""
        return -math.inf, math.inf

    def check_times(self, days: FloatArray, places: Iterable[Place]) -> None:
        """Refuse what is no time."""
        if not np.all(np.isfinite(days)):
            raise UndefinedError("a time is not finite")

    def positions(
        self, targets: Mapping[str, Place], centre: Place, days: FloatArray
    ) -> dict[str, FloatArray]:
        """Positions in metres along the ICRF, shape (n, 3) each."""
        self.check_times(days, ())
        return {
            name: checked(_trajectory(place).positions(days), place, days)
            for name, place in targets.items()
        }

    def error(self, target: Place, centre: Place, day: float = 0.0) -> tuple[float, float]:
        """What rounding does to a direction (rad) and a distance (m)."""
        return _trajectory(target).error(day)

    def drift(self, target: Place, centre: Place, distance: float) -> float:
        """By what the pull may turn an axis aside, over the angle that the axis sweeps."""
        angle, metres = self.error(target, centre)
        return 2 * angle + 3 * metres / distance


def _trajectory(place: Place) -> ByElements:
    """What this source can place: a body by its elements."""
    if not isinstance(place, ByElements):
        raise SceneError("perturbers", place, "it has no orbit by elements; give it one")
    return place

"""Where the spin axis of a body points, and the plane along which its precession is counted.

A body carries one of these small values, and whoever needs an equator asks it: nobody else knows
which kind it is. Times are days from J2000.0 TDB, vectors are in the GCRS.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, Protocol, Self

import numpy as np

from earthspin.constants import ARCSEC, EPSILON_0
from earthspin.errors import UndefinedError
from earthspin.sky.equator import direction, fixed_equator

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from earthspin.sky.iau import Nutation

    FloatArray = NDArray[np.float64]


#: An axis closer to the normal of the orbit than this has no longitude, rad.
UPRIGHT = 2e-7


class Direction(NamedTuple):
    """A direction in the ICRF.

    Attributes
    ----------
    right_ascension, declination : float
        rad.
    """

    right_ascension: float
    declination: float

    @classmethod
    def of(cls, pair: object) -> Self:
        """Take a pair of angles in radians.

        Raises
        ------
        ValueError
            If it is no pair, not finite, or beyond a pole.
        """
        if not isinstance(pair, tuple) or len(pair) != 2:
            raise ValueError(pair)
        ra, dec = pair
        if not (math.isfinite(ra) and abs(dec) <= math.pi / 2):
            raise ValueError(pair)
        return cls(ra, dec)

    @classmethod
    def across(cls, i: float, node: float) -> Self:
        """Normal of an orbit, by its elements on the ecliptic and equinox of J2000.0.

        The mean equator of that date is taken for the ICRF's, from which it lies 0.02 arcsec away.

        Parameters
        ----------
        i, node : float
            Inclination and longitude of the ascending node, rad.
        """
        obliquity = EPSILON_0.value * ARCSEC
        x, y, z = math.sin(i) * math.sin(node), -math.sin(i) * math.cos(node), math.cos(i)
        north = y * math.sin(obliquity) + z * math.cos(obliquity)
        along = y * math.cos(obliquity) - z * math.sin(obliquity)
        return cls(math.atan2(along, x) % math.tau, math.asin(north))

    @classmethod
    def along(cls, vector: FloatArray) -> Self:
        """Take the direction of a vector, shape (3,)."""
        x, y, z = vector
        return cls(math.atan2(y, x) % math.tau, math.atan2(z, math.hypot(x, y)))

    def __str__(self) -> str:
        ra, dec = (math.degrees(angle) for angle in self)
        return f"right ascension {ra:.5f} deg, declination {dec:.5f} deg"

    def vector(self) -> FloatArray:
        """Unit vector, shape (3,)."""
        return direction(*self)


class Pole(Protocol):
    """What a spin axis must tell; `orbit` is the normal of the body's own orbit, if it has one."""

    #: Whether the IAU's models of precession and nutation describe it.
    of_the_iau: bool

    def orbit_normal(self, orbit: Direction | None) -> FloatArray:
        """Unit normal of the plane along which precession is counted, shape (3,).

        Raises
        ------
        UndefinedError
            If there is no orbit to refer to.
        """

    def is_upright(self, orbit: Direction | None) -> bool:
        """Whether it stands on that plane so closely that it has no longitude there."""

    def orbit_axes(self, orbit: Direction | None) -> FloatArray:
        """Matrix from the GCRS to that plane and the equinox of J2000.0, shape (3, 3)."""

    def mean(self, days: FloatArray) -> FloatArray:
        """Unit vectors of the axis without nutation, shape (n, 3)."""

    def without_nutation(self) -> Pole:
        """The axis whose `mean` has no periodic terms that repeat within millennia."""

    def true(self, day: float) -> FloatArray:
        """Unit vector of the axis, nutation included, shape (3,)."""

    def equator(
        self, orbit: Direction | None, days: FloatArray, nutation: Nutation | None = None
    ) -> FloatArray:
        """Matrices from the GCRS to equator and equinox of date.

        Parameters
        ----------
        orbit : Direction or None
        days : ndarray, shape (n,)
        nutation : Nutation, optional
            With it the equator is the true one, without it the mean one.

        Returns
        -------
        ndarray, shape (n, 3, 3), or (3, 3) for an axis that does not move
        """


class FixedPole(Direction):
    """A spin axis that keeps its direction among the stars."""

    of_the_iau = False

    def orbit_normal(self, orbit: Direction | None) -> FloatArray:
        """Normal of the body's orbit."""
        if orbit is None:
            raise UndefinedError("precession is counted along the orbit; set the body's orbit_pole")
        return orbit.vector()

    def is_upright(self, orbit: Direction | None) -> bool:
        """Whether it is closer to the orbit's normal than `UPRIGHT`, either way up."""
        if orbit is None:
            return False
        (ra, dec), (ra0, dec0) = self, orbit
        half = math.sin((dec - dec0) / 2) ** 2
        half += math.cos(dec) * math.cos(dec0) * math.sin((ra - ra0) / 2) ** 2
        return min(half, 1 - half) < (UPRIGHT / 2) ** 2

    def orbit_axes(self, orbit: Direction | None) -> FloatArray:
        """Plane of the orbit, from where the Sun crosses the equator northward."""
        normal = self.orbit_normal(orbit)
        equinox = self.equator(orbit)[0]
        return np.stack([equinox, np.cross(normal, equinox), normal])

    def mean(self, days: FloatArray) -> FloatArray:
        """Give the same direction at all days."""
        return np.broadcast_to(self.vector(), (days.size, 3))

    def without_nutation(self) -> Self:
        """Return the pole itself: it does not move."""
        return self

    def true(self, day: float) -> FloatArray:
        """Give the direction: it has no nutation."""
        return self.vector()

    def equator(
        self,
        orbit: Direction | None,
        days: FloatArray | None = None,
        nutation: Nutation | None = None,
    ) -> FloatArray:
        """Give one matrix for all days."""
        return fixed_equator(self.vector(), self.orbit_normal(orbit))


@dataclass(frozen=True)
class IAU2006Pole:
    """The Earth's: precession of IAU 2006, nutation IAU 2000A, on the ecliptic of J2000.0."""

    of_the_iau = True

    def __str__(self) -> str:
        return "iau2006"

    def orbit_normal(self, orbit: Direction | None) -> FloatArray:
        """Pole of the ecliptic of J2000.0."""
        from earthspin.sky import iau

        return iau.ecliptic_pole()

    def is_upright(self, orbit: Direction | None) -> bool:
        """It is not: the obliquity stays near 23.4 degrees."""
        return False

    def orbit_axes(self, orbit: Direction | None) -> FloatArray:
        """Ecliptic and mean equinox of J2000.0."""
        from earthspin.sky import iau

        return iau.fixed_ecliptic()

    def mean(self, days: FloatArray) -> FloatArray:
        """Mean pole of date, frame bias included."""
        from earthspin.sky import iau

        return np.asarray(iau.mean_equator(days)[..., 2, :])

    def without_nutation(self) -> Self:
        """Return the pole itself: its `mean` has no nutation."""
        return self

    def true(self, day: float) -> FloatArray:
        """Celestial intermediate pole, frame bias included."""
        from earthspin.sky import iau

        return np.asarray(iau.true_pole(np.array([day]))[0])

    def equator(
        self, orbit: Direction | None, days: FloatArray, nutation: Nutation | None = None
    ) -> FloatArray:
        """Mean or true equator and equinox of date."""
        from earthspin.sky import iau

        return iau.mean_equator(days) if nutation is None else nutation.true_equator(days)


IAU_2006 = IAU2006Pole()
#: Poles that have a name.
NAMED_POLES: dict[str, Pole] = {str(IAU_2006): IAU_2006}


def pole_of(value: object) -> Pole:
    """Take a pole: itself, its name, or a pair of angles in radians.

    Raises
    ------
    ValueError
        If it is none of them.
    """
    if isinstance(value, str):
        if value not in NAMED_POLES:
            raise ValueError(value)
        return NAMED_POLES[value]
    return value if hasattr(value, "of_the_iau") else FixedPole.of(value)  # type: ignore[return-value]

"""Direction of a body's pole (spin axis), and the plane in which its precession is measured.

All kinds of poles have the interface of `Pole`. Times are days from J2000.0 TDB, vectors are in the
GCRS.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, Protocol, Self

import numpy as np

from earthspin.constants import ARCSEC, EPSILON_0
from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import FloatArray
from earthspin.sky.equator import direction, fixed_equator

if TYPE_CHECKING:
    from earthspin.sky.iau import Nutation


#: Smallest angle between an axis and the normal of the orbit for which a longitude is defined, rad.
UPRIGHT = 2e-7


class Direction(NamedTuple):
    """Direction in the ICRF, as right ascension and declination.

    Attributes
    ----------
    right_ascension, declination : float
        rad.
    """

    right_ascension: float
    declination: float

    @classmethod
    def of(cls, pair: object) -> Self:
        """Create a direction from a pair of angles: right ascension and declination, rad.

        Raises
        ------
        ValueError
            If `pair` is not a pair of finite angles, or the declination is beyond a pole.
        """
        if not isinstance(pair, tuple) or len(pair) != 2:
            raise ValueError(pair)
        ra, dec = pair
        if not (math.isfinite(ra) and abs(dec) <= math.pi / 2):
            raise ValueError(pair)
        return cls(ra, dec)

    @classmethod
    def across(cls, i: float, node: float) -> Self:
        """Create the direction of an orbit's normal, from inclination and node.

        The angles refer to the ecliptic of J2000.0.

        The mean equator of that date is used for that of the ICRF; they differ by 0.02 arcsec.

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
        """Create a direction that is parallel to a given vector, shape (3,)."""
        x, y, z = vector
        return cls(math.atan2(y, x) % math.tau, math.atan2(z, math.hypot(x, y)))

    def __str__(self) -> str:
        ra, dec = (math.degrees(angle) for angle in self)
        return f"right ascension {ra:.5f} deg, declination {dec:.5f} deg"

    def vector(self) -> FloatArray:
        """Unit vector of the direction, shape (3,)."""
        return direction(*self)


class Pole(Protocol):
    """Protocol of a body's pole (spin axis).

    The argument `orbit` is the normal of the body's own orbit, if known.
    """

    #: Whether the axis follows the IAU models of precession and nutation of the Earth.
    of_the_iau: bool

    def orbit_normal(self, orbit: Direction | None) -> FloatArray:
        """Unit normal of the plane in which precession is measured, shape (3,).

        Raises
        ------
        UndefinedError
            If there is no orbit.
        """

    def is_upright(self, orbit: Direction | None) -> bool:
        """Return True if the spin axis is nearly normal to the orbit.

        Its longitude is then undefined.
        """

    def orbit_axes(self, orbit: Direction | None) -> FloatArray:
        """Matrix from the GCRS to the orbital plane and equinox of J2000.0, shape (3, 3)."""

    def mean(self, days: FloatArray) -> FloatArray:
        """Unit vectors of the spin axis on given days, without IAU nutation, shape (n, 3)."""

    def without_nutation(self) -> Pole:
        """Return the pole without the periodic terms that count as nutation."""

    def true(self, day: float) -> FloatArray:
        """Unit vector of the spin axis on one day, nutation included, shape (3,)."""

    def equator(
        self, orbit: Direction | None, days: FloatArray, nutation: Nutation | None = None
    ) -> FloatArray:
        """Matrices from the GCRS to the body's equator and equinox of date, on given days.

        Parameters
        ----------
        orbit : Direction or None
        days : ndarray, shape (n,)
        nutation : Nutation, optional
            If given, the true equator is returned, otherwise the mean equator.

        Returns
        -------
        ndarray, shape (n, 3, 3), or (3, 3) for an axis that does not move
        """


class FixedPole(Direction):
    """Pole (spin axis) with a fixed direction in the ICRF."""

    of_the_iau = False

    def orbit_normal(self, orbit: Direction | None) -> FloatArray:
        """Unit normal of the body's orbit, the plane in which precession is measured, (3,)."""
        if orbit is None:
            raise UndefinedError("precession is counted along the orbit; set the body's orbit_pole")
        return orbit.vector()

    def is_upright(self, orbit: Direction | None) -> bool:
        """Return True if the spin axis is nearly parallel or opposite to the orbit's normal."""
        if orbit is None:
            return False
        (ra, dec), (ra0, dec0) = self, orbit
        half = math.sin((dec - dec0) / 2) ** 2
        half += math.cos(dec) * math.cos(dec0) * math.sin((ra - ra0) / 2) ** 2
        return min(half, 1 - half) < (UPRIGHT / 2) ** 2

    def orbit_axes(self, orbit: Direction | None) -> FloatArray:
        """Matrix from the GCRS to the orbital plane, with the body's equinox as first axis."""
        normal = self.orbit_normal(orbit)
        equinox = self.equator(orbit)[0]
        return np.stack([equinox, np.cross(normal, equinox), normal])

    def mean(self, days: FloatArray) -> FloatArray:
        """Unit vectors of the fixed spin axis on given days, shape (n, 3)."""
        return np.broadcast_to(self.vector(), (days.size, 3))

    def without_nutation(self) -> Self:
        """Return the pole itself, which has no nutation."""
        return self

    def true(self, day: float) -> FloatArray:
        """Unit vector of the fixed spin axis, which has no nutation, shape (3,)."""
        return self.vector()

    def equator(
        self,
        orbit: Direction | None,
        days: FloatArray | None = None,
        nutation: Nutation | None = None,
    ) -> FloatArray:
        """Matrix from the GCRS to the fixed equator of the body, shape (3, 3)."""
        return fixed_equator(self.vector(), self.orbit_normal(orbit))


@dataclass(frozen=True)
class IAU2006Pole:
    """Pole of the Earth, with precession IAU 2006 and nutation IAU 2000A."""

    of_the_iau = True

    def __str__(self) -> str:
        return "iau2006"

    def orbit_normal(self, orbit: Direction | None) -> FloatArray:
        """Unit normal of the ecliptic of J2000.0, where precession is measured, shape (3,)."""
        from earthspin.sky import iau

        return iau.ecliptic_pole()

    def is_upright(self, orbit: Direction | None) -> bool:
        """Return False, as the Earth's axis is never normal to the ecliptic."""
        return False

    def orbit_axes(self, orbit: Direction | None) -> FloatArray:
        """Matrix from the GCRS to the ecliptic and mean equinox of J2000.0."""
        from earthspin.sky import iau

        return iau.fixed_ecliptic()

    def mean(self, days: FloatArray) -> FloatArray:
        """Unit vectors of the mean pole of date, frame bias included, shape (n, 3)."""
        from earthspin.sky import iau

        return np.asarray(iau.mean_equator(days)[..., 2, :])

    def without_nutation(self) -> Self:
        """Return the pole itself; its mean direction has no nutation."""
        return self

    def true(self, day: float) -> FloatArray:
        """Unit vector of the celestial intermediate pole on a day, bias included, shape (3,)."""
        from earthspin.sky import iau

        return np.asarray(iau.true_pole(np.array([day]))[0])

    def equator(
        self, orbit: Direction | None, days: FloatArray, nutation: Nutation | None = None
    ) -> FloatArray:
        """Matrices from the GCRS to the Earth's mean or true equator and equinox of date."""
        from earthspin.sky import iau

        return iau.mean_equator(days) if nutation is None else nutation.true_equator(days)


IAU_2006 = IAU2006Pole()
#: Poles by name.
NAMED_POLES: dict[str, Pole] = {str(IAU_2006): IAU_2006}


def pole_of(value: object) -> Pole:
    """Return the pole that is given directly, by its name, or by a pair of angles in radians.

    Raises
    ------
    ValueError
        If `value` is none of these.
    """
    if isinstance(value, str):
        if value not in NAMED_POLES:
            raise ValueError(value)
        return NAMED_POLES[value]
    return value if hasattr(value, "of_the_iau") else FixedPole.of(value)  # type: ignore[return-value]

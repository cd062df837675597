"""Direction of a body's pole (spin axis), and the plane in which its precession is measured.

All kinds of poles have the interface of `PoleModel`. Times are days from J2000.0 TDB, vectors are
in the GCRS.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, Self

import numpy as np

from earthspin._lazy import xr
from earthspin.constants import ARCSEC, DAY, DAYS_PER_CENTURY, EPSILON_0
from earthspin.errors import UndefinedError, Where
from earthspin.numerics.arrays import FloatArray, Numeric
from earthspin.sky import iau_models
from earthspin.units import quantity

# --- equator of date ------------------------------------------------------------------------------
# The third axis is the spin axis, the first points to the body's equinox, where the Sun on its
# apparent orbit crosses the equator northward.


def direction(right_ascension: float, declination: float) -> FloatArray:
    """Unit vector from right ascension and declination in radians, shape (3,)."""
    equatorial = math.cos(declination)
    x, y = equatorial * math.cos(right_ascension), equatorial * math.sin(right_ascension)
    return np.array([x, y, math.sin(declination)])


def fixed_equator(axis: FloatArray, normal: FloatArray) -> FloatArray:
    """Matrix from the ICRF to the equator of a fixed spin axis, shape (3, 3).

    If the axis is along the orbit's normal there is no equinox; right ascension is then measured
    from an arbitrary point of the equator.
    """
    node = np.cross(axis, normal)
    if np.linalg.norm(node) < 1e-12:
        node = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    x = node / np.linalg.norm(node)
    return np.stack([x, np.cross(axis, x), axis])


def rotate(matrix: FloatArray, vectors: FloatArray) -> FloatArray:
    """Rotate vectors, shape (n, 3), by one matrix, or each vector by its own matrix."""
    if matrix.ndim == 2:
        return vectors @ matrix.T
    return np.asarray((matrix @ vectors[:, :, np.newaxis])[:, :, 0])


def angle(a: FloatArray, b: FloatArray) -> float:
    """Angle between two vectors, rad; accurate for small angles and for nearly opposite vectors."""
    return math.atan2(float(np.linalg.norm(np.cross(a, b))), float(np.dot(a, b)))


def spherical(vectors: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Right ascension (0 to 2 pi), declination and length of vectors (n, 3), shape (n,) each.

    Uses arctan2, because arcsin and arccos lose half the digits near the poles.
    """
    x, y, z = vectors.T
    in_plane = np.hypot(x, y)
    return np.arctan2(y, x) % (2 * np.pi), np.arctan2(z, in_plane), np.hypot(in_plane, z)


def node_angle(axis: FloatArray) -> float:
    """Angle along the equator of an axis from the projected x axis to its ascending node, rad.

    Parameters
    ----------
    axis : ndarray, shape (3,)
        Unit vector in the ICRF; the node is on the equator of the ICRF.
    """
    x, y, z = axis
    return math.atan2(x * z, -y)


# --- poles ----------------------------------------------------------------------------------------

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
        if isinstance(pair, cls):
            return pair
        if not isinstance(pair, tuple) or len(pair) != 2:
            raise ValueError(pair)
        ra, dec = pair
        if not (np.all(np.isfinite(ra)) and np.all(np.abs(dec) <= math.pi / 2)):
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
        if any(map(np.ndim, self)):
            return "right ascension and declination in arrays"
        ra, dec = (math.degrees(angle) for angle in self)
        return f"right ascension {ra:.5f} deg, declination {dec:.5f} deg"

    def vector(self) -> FloatArray:
        """Unit vector of the direction, shape (3,)."""
        return direction(*self)


class OrbitNormal(Direction):
    """Normal of an orbit that follows from the elements of the orbit."""


class PoleModel:
    """Base class of a body's pole (spin axis).

    The argument `orbit` is the normal of the body's own orbit, if known.
    """

    #: Whether the axis follows the IAU models of precession and nutation of the Earth.
    of_the_iau = False

    def at_epoch(self) -> Direction:
        """Direction of the spin axis at J2000.0."""
        raise NotImplementedError

    def mean(self, days: FloatArray) -> FloatArray:
        """Unit vectors of the spin axis on given days, without IAU nutation, shape (n, 3)."""
        raise NotImplementedError

    def equator(
        self,
        orbit: Direction | None,
        days: FloatArray,
        nutation: iau_models.NutationSpline | None = None,
    ) -> FloatArray:
        """Matrices from the GCRS to the body's equator and equinox of date, on given days.

        Parameters
        ----------
        orbit : Direction or None
        days : ndarray, shape (n,)
        nutation : NutationSpline, optional
            If given, the true equator of the Earth is returned, otherwise the mean equator.

        Returns
        -------
        ndarray, shape (n, 3, 3), or (3, 3) for an axis that does not move
        """
        raise NotImplementedError

    def orbit_normal(self, orbit: Direction | None) -> FloatArray:
        """Unit normal of the body's orbit, the plane to which precession refers, shape (3,).

        Raises
        ------
        UndefinedError
            If there is no orbit.
        """
        if orbit is None:
            raise UndefinedError(
                "the equinox of a body is the node of its orbit, which is not known; set its orbit "
                "or orbit_pole, like orbit_pole = ['273 deg', '67 deg']"
            )
        return orbit.vector()

    def is_upright(self, orbit: Direction | None) -> bool:
        """Return True if the spin axis is nearly parallel or opposite to the orbit's normal.

        Its longitude is then undefined.
        """
        if orbit is None:
            return False
        (ra, dec), (ra0, dec0) = self.at_epoch(), orbit
        half = math.sin((dec - dec0) / 2) ** 2
        half += math.cos(dec) * math.cos(dec0) * math.sin((ra - ra0) / 2) ** 2
        return min(half, 1 - half) < (UPRIGHT / 2) ** 2

    def orbit_axes(self, orbit: Direction | None) -> FloatArray:
        """Matrix from the GCRS to the orbital plane, with the equinox of J2000.0 as first axis."""
        normal = self.orbit_normal(orbit)
        equinox = fixed_equator(self.at_epoch().vector(), normal)[0]
        return np.stack([equinox, np.cross(normal, equinox), normal])

    def without_nutation(self) -> Self:
        """Return the pole without the periodic terms that count as nutation."""
        return self

    def true(self, day: float) -> FloatArray:
        """Unit vector of the spin axis on one day, nutation included, shape (3,)."""
        return np.asarray(self.mean(np.array([day]))[0])


class FixedPole(Direction, PoleModel):
    """Pole (spin axis) with a fixed direction in the ICRF."""

    def at_epoch(self) -> Direction:
        """Return the pole itself."""
        return self

    def mean(self, days: FloatArray) -> FloatArray:
        """Unit vectors of the fixed spin axis on given days, shape (n, 3)."""
        return np.broadcast_to(self.vector(), (days.size, 3))

    def equator(
        self,
        orbit: Direction | None,
        days: FloatArray | None = None,
        nutation: iau_models.NutationSpline | None = None,
    ) -> FloatArray:
        """Matrix from the GCRS to the fixed equator of the body, shape (3, 3)."""
        return fixed_equator(self.vector(), self.orbit_normal(orbit))


class TiltedPole(FixedPole):
    """Pole that is given by the obliquity, and follows from it and from the normal of the orbit.

    Attributes
    ----------
    obliquity : float
        Angle from the normal of the orbit to the pole, rad.
    equinox_of : FixedPole
        Pole that has the same equinox; by default that of the ICRF.
    """

    obliquity: float
    equinox_of: FixedPole

    @classmethod
    def at(
        cls, obliquity: Numeric, equinox_of: FixedPole | None = None, orbit: Direction | None = None
    ) -> Self:
        """Create the pole of a body; without the normal of its orbit, the direction is open."""
        equinox_of = equinox_of or FixedPole(0.0, math.pi / 2)

        def tilted(angle: float, *normal_angles: float) -> Direction:
            _, leaning, normal = equinox_of.orbit_axes(Direction(*normal_angles))
            return Direction.along(math.cos(angle) * normal + math.sin(angle) * leaning)

        pole = cls(*(equinox_of if orbit is None else of_each(tilted, obliquity, *orbit)))
        pole.obliquity, pole.equinox_of = obliquity, equinox_of
        return pole


def of_each(direction: Callable[..., Direction], *values: Any) -> Direction:
    """Direction that follows from numbers; for labelled arrays, the arrays of its two angles."""
    if not any(hasattr(value, "dims") for value in values):
        return direction(*values)
    return Direction(
        *xr.apply_ufunc(direction, *values, output_core_dims=[[], []], vectorize=True, join="exact")
    )


@dataclass(frozen=True)
class IAU2006Pole(PoleModel):
    """Pole of the Earth, with precession IAU 2006 and nutation IAU 2000A."""

    of_the_iau = True

    def __str__(self) -> str:
        return "iau2006"

    def orbit_normal(self, orbit: Direction | None) -> FloatArray:
        """Unit normal of the ecliptic of J2000.0, to which precession refers, shape (3,)."""
        return iau_models.ecliptic_pole()

    def is_upright(self, orbit: Direction | None) -> bool:
        """Return False, as the Earth's axis is never normal to the ecliptic."""
        return False

    def orbit_axes(self, orbit: Direction | None) -> FloatArray:
        """Matrix from the GCRS to the ecliptic and mean equinox of J2000.0."""
        return iau_models.fixed_ecliptic()

    def mean(self, days: FloatArray) -> FloatArray:
        """Unit vectors of the mean pole of date, frame bias included, shape (n, 3)."""
        return np.asarray(iau_models.mean_equator(days)[..., 2, :])

    def true(self, day: float) -> FloatArray:
        """Unit vector of the celestial intermediate pole on a day, bias included, shape (3,)."""
        return np.asarray(iau_models.true_pole(np.array([day]))[0])

    def equator(
        self,
        orbit: Direction | None,
        days: FloatArray,
        nutation: iau_models.NutationSpline | None = None,
    ) -> FloatArray:
        """Matrices from the GCRS to the Earth's mean or true equator and equinox of date."""
        return iau_models.mean_equator(days) if nutation is None else nutation.true_equator(days)


IAU_2006 = IAU2006Pole()
#: Poles by name.
NAMED_POLES: dict[str, PoleModel] = {str(IAU_2006): IAU_2006}


def pole_of(value: object) -> PoleModel:
    """Return a pole from a pole, a name, or right ascension and declination in radians.

    Raises
    ------
    ValueError
        If `value` is none of these.
    """
    if isinstance(value, str):
        if value not in NAMED_POLES:
            raise ValueError(value)
        return NAMED_POLES[value]
    return value if isinstance(value, PoleModel) else FixedPole.of(value)


# --- moving poles as published by the IAU ---------------------------------------------------------
# The working group on cartographic coordinates writes right ascension and declination of a pole as
#
#     alpha = alpha_0 + alpha_1 T + sum a_k sin(phi_k + phi'_k T),
#     delta = delta_0 + delta_1 T + sum d_k cos(psi_k + psi'_k T)
#
# with T in Julian centuries of TDB from J2000.0, in the ICRF (Archinal et al. 2018, Celest. Mech.
# Dyn. Astron. 130, 22).

_CENTURY = DAYS_PER_CENTURY * DAY
#: Longest period, s, of terms that count as nutation, because torques averaged over orbits and
#: their nodes do not include them.
LONGEST_NUTATION = 100 * _CENTURY


class PeriodicTerm(NamedTuple):
    """Periodic term in the right ascension or declination of a moving pole.

    Attributes
    ----------
    size : float
        Amplitude of the sine (right ascension) or cosine (declination), rad.
    phase : float
        Phase at J2000.0, rad.
    rate : float
        rad/s.
    """

    size: float
    phase: float
    rate: float


_NAMES = ("right_ascension", "declination")
_RATES = ("right_ascension_rate", "declination_rate")
_SWINGS = ("right_ascension_swings", "declination_swings")


@dataclass(frozen=True)
class MovingPole(PoleModel):
    """Pole (spin axis) that moves with constant rates and periodic terms.

    Attributes
    ----------
    right_ascension, declination : float
        Direction at J2000.0 without periodic terms, ICRF, rad.
    right_ascension_rate, declination_rate : float
        rad/s.
    right_ascension_swings, declination_swings : tuple of PeriodicTerm
    """

    right_ascension: float
    declination: float
    right_ascension_rate: float = 0.0
    declination_rate: float = 0.0
    right_ascension_swings: tuple[PeriodicTerm, ...] = ()
    declination_swings: tuple[PeriodicTerm, ...] = ()

    @classmethod
    def published(
        cls,
        alpha: tuple[float, float],
        delta: tuple[float, float],
        alpha_terms: Sequence[tuple[float, float, float]] = (),
        delta_terms: Sequence[tuple[float, float, float]] = (),
    ) -> Self:
        """Create a moving pole from published numbers in degrees and degrees per Julian century.

        Parameters
        ----------
        alpha, delta : tuple of float
            Angle and rate.
        alpha_terms, delta_terms : sequence of (size, phase, rate)
            Sine terms of alpha, and cosine terms of delta.
        """

        def swings(terms: Sequence[tuple[float, float, float]]) -> tuple[PeriodicTerm, ...]:
            return tuple(
                PeriodicTerm(math.radians(size), math.radians(phase), math.radians(rate) / _CENTURY)
                for size, phase, rate in terms
            )

        return cls(
            math.radians(alpha[0]),
            math.radians(delta[0]),
            math.radians(alpha[1]) / _CENTURY,
            math.radians(delta[1]) / _CENTURY,
            swings(alpha_terms),
            swings(delta_terms),
        )

    def __str__(self) -> str:
        return f"moving; at J2000.0 {Direction(*self.at(0.0))}"

    def at_epoch(self) -> Direction:
        """Direction of the pole at J2000.0, with periodic terms."""
        return self.at(0.0)

    def at(self, day: float) -> FixedPole:
        """Direction of the pole on a given day from J2000.0 TDB, with periodic terms."""
        return FixedPole(*map(float, self._angles(day)))

    def _angles(self, days: float | FloatArray) -> tuple[FloatArray, FloatArray]:
        """Angles of the pole on days from J2000.0 TDB, with periodic terms, rad."""
        time = np.asarray(days) * DAY
        ra = self.right_ascension + self.right_ascension_rate * time
        dec = self.declination + self.declination_rate * time
        for size, phase, rate in self.right_ascension_swings:
            ra = ra + size * np.sin(phase + rate * time)
        for size, phase, rate in self.declination_swings:
            dec = dec + size * np.cos(phase + rate * time)
        return ra, dec

    def mean(self, days: FloatArray) -> FloatArray:
        """Unit vectors of the spin axis on given days, shape (n, 3).

        All periodic terms are included, as they count as mean motion.
        """
        ra, dec = self._angles(days)
        equatorial = np.cos(dec)
        return np.stack([equatorial * np.cos(ra), equatorial * np.sin(ra), np.sin(dec)], axis=-1)

    def without_nutation(self) -> Self:
        """Return the pole without its short-period terms, which count as nutation."""

        def slow(swings: tuple[PeriodicTerm, ...]) -> tuple[PeriodicTerm, ...]:
            return tuple(s for s in swings if abs(s.rate) * LONGEST_NUTATION < math.tau)

        return replace(
            self,
            right_ascension_swings=slow(self.right_ascension_swings),
            declination_swings=slow(self.declination_swings),
        )

    def equator(
        self,
        orbit: Direction | None,
        days: FloatArray,
        nutation: iau_models.NutationSpline | None = None,
    ) -> FloatArray:
        """Matrices from the GCRS to the equator and equinox of date, shape (n, 3, 3)."""
        normal = self.orbit_normal(orbit)
        axes = self.mean(days)
        if self.is_upright(orbit):
            return np.stack([fixed_equator(axis, normal) for axis in axes])
        x = np.cross(axes, normal)
        x /= np.linalg.norm(x, axis=-1, keepdims=True)
        return np.stack([x, np.cross(axes, x), axes], axis=1)

    # --- from and to a scene ---------------------------------------------------------------------

    @classmethod
    def read(cls, table: Mapping[str, Any], where: Where) -> Self:
        """Create a moving pole from the table that `write` returned.

        Raises
        ------
        SceneError, UnitsError
            If a key is unknown or missing, or a value is not an angle or rate.
        """
        where.refuse_unknown(table, (*_NAMES, *_RATES, *_SWINGS))
        fields: dict[str, Any] = {}
        for name in _NAMES:
            if name not in table:
                raise where.at(name).error(None, f"give it, like {name} = '52.9 deg'")
            fields[name] = float(quantity(table[name], "rad", where.at(name), "52.9 deg"))
        if abs(fields["declination"]) > math.pi / 2:
            raise where.at("declination").error(table["declination"], "it is -90 to 90 deg")
        for name in _RATES:
            rate = quantity(table.get(name, 0.0), "rad/s", where.at(name), "-1e-12 rad/s")
            fields[name] = float(rate)
        for name in _SWINGS:
            fields[name] = tuple(_swing(row, where.at(name)) for row in table.get(name, ()))
        return cls(**fields)

    def write(self) -> dict[str, Any]:
        """Table for scene files: the pole's angles, rates and periodic terms."""
        table: dict[str, Any] = {name: f"{getattr(self, name)!r} rad" for name in _NAMES}
        table |= {name: f"{getattr(self, name)!r} rad/s" for name in _RATES}
        return table | {
            name: [
                [f"{size!r} rad", f"{phase!r} rad", f"{rate!r} rad/s"]
                for size, phase, rate in getattr(self, name)
            ]
            for name in _SWINGS
        }


def _swing(row: object, where: Where) -> PeriodicTerm:
    """Read one periodic term of a moving pole: amplitude, phase and rate."""
    if not isinstance(row, (list, tuple)) or len(row) != 3:
        raise where.error(row, "give size, phase and rate of each term")
    units, examples = ("rad", "rad", "rad/s"), ("0.7 deg", "357.85 deg", "1e-11 rad/s")
    terms = zip(row, units, examples, strict=True)
    return PeriodicTerm(
        *(float(quantity(term, unit, where, example)) for term, unit, example in terms)
    )

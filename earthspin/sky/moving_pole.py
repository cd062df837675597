"""Poles (spin axes) that move as published by the IAU: linear rates and periodic terms.

The working group on cartographic coordinates writes right ascension and declination of a pole as

    alpha = alpha_0 + alpha_1 T + sum a_k sin(phi_k + phi'_k T),
    delta = delta_0 + delta_1 T + sum d_k cos(psi_k + psi'_k T)

with T in Julian centuries of TDB from J2000.0, in the ICRF (Archinal et al. 2018,
Celest. Mech. Dyn. Astron. 130, 22).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple, Self

import numpy as np

from earthspin.constants import DAY, DAYS_PER_CENTURY
from earthspin.errors import Where, nearest
from earthspin.numerics.arrays import FloatArray
from earthspin.sky.equator import fixed_equator
from earthspin.sky.poles import Direction, FixedPole
from earthspin.units import quantity

if TYPE_CHECKING:
    from earthspin.sky.iau import Nutation


_CENTURY = DAYS_PER_CENTURY * DAY
#: Longest period, s, of terms that count as nutation, because torques averaged over orbits and
#: their nodes do not include them.
LONGEST_NUTATION = 100 * _CENTURY


class Swing(NamedTuple):
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
class MovingPole:
    """Pole (spin axis) that moves with constant rates and periodic terms.

    Attributes
    ----------
    right_ascension, declination : float
        At J2000.0 without periodic terms, ICRF, rad.
    right_ascension_rate, declination_rate : float
        rad/s.
    right_ascension_swings, declination_swings : tuple of Swing
    """

    right_ascension: float
    declination: float
    right_ascension_rate: float = 0.0
    declination_rate: float = 0.0
    right_ascension_swings: tuple[Swing, ...] = ()
    declination_swings: tuple[Swing, ...] = ()

    of_the_iau = False

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

        def swings(terms: Sequence[tuple[float, float, float]]) -> tuple[Swing, ...]:
            return tuple(
                Swing(math.radians(size), math.radians(phase), math.radians(rate) / _CENTURY)
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

    def at(self, day: float) -> FixedPole:
        """Direction of the pole on a given day from J2000.0 TDB, with periodic terms."""
        time = day * DAY
        ra = self.right_ascension + self.right_ascension_rate * time
        dec = self.declination + self.declination_rate * time
        ra += sum(s.size * math.sin(s.phase + s.rate * time) for s in self.right_ascension_swings)
        dec += sum(s.size * math.cos(s.phase + s.rate * time) for s in self.declination_swings)
        return FixedPole(ra, dec)

    def orbit_normal(self, orbit: Direction | None) -> FloatArray:
        """Unit normal of the body's orbit, shape (3,)."""
        return self.at(0.0).orbit_normal(orbit)

    def is_upright(self, orbit: Direction | None) -> bool:
        """Return True if the spin axis at J2000.0 is nearly normal to the orbit.

        Its longitude is then undefined.
        """
        return self.at(0.0).is_upright(orbit)

    def orbit_axes(self, orbit: Direction | None) -> FloatArray:
        """Matrix from the GCRS to the orbital plane, with the equinox of J2000.0 as first axis."""
        return self.at(0.0).orbit_axes(orbit)

    def mean(self, days: FloatArray) -> FloatArray:
        """Unit vectors of the spin axis on given days, shape (n, 3).

        All periodic terms are included, as they count as mean motion.
        """
        time = np.asarray(days) * DAY
        ra = self.right_ascension + self.right_ascension_rate * time
        dec = self.declination + self.declination_rate * time
        for size, phase, rate in self.right_ascension_swings:
            ra = ra + size * np.sin(phase + rate * time)
        for size, phase, rate in self.declination_swings:
            dec = dec + size * np.cos(phase + rate * time)
        level = np.cos(dec)
        return np.stack([level * np.cos(ra), level * np.sin(ra), np.sin(dec)], axis=-1)

    def without_nutation(self) -> Self:
        """Return the pole without its short-period terms, which count as nutation."""

        def slow(swings: tuple[Swing, ...]) -> tuple[Swing, ...]:
            return tuple(s for s in swings if abs(s.rate) * LONGEST_NUTATION < math.tau)

        return replace(
            self,
            right_ascension_swings=slow(self.right_ascension_swings),
            declination_swings=slow(self.declination_swings),
        )

    def true(self, day: float) -> FloatArray:
        """Unit vector of the spin axis on one day, all periodic terms included, shape (3,)."""
        return np.asarray(self.mean(np.array([day]))[0])

    def equator(
        self, orbit: Direction | None, days: FloatArray, nutation: Nutation | None = None
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
        names = (*_NAMES, *_RATES, *_SWINGS)
        for name in table:
            if name not in names:
                raise where.at(name).error(table[name], nearest(name, names))
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
        """Form stored in scene files: a table of the pole's angles, rates and periodic terms."""
        table: dict[str, Any] = {name: f"{getattr(self, name)!r} rad" for name in _NAMES}
        table |= {name: f"{getattr(self, name)!r} rad/s" for name in _RATES}
        return table | {
            name: [
                [f"{size!r} rad", f"{phase!r} rad", f"{rate!r} rad/s"]
                for size, phase, rate in getattr(self, name)
            ]
            for name in _SWINGS
        }


def _swing(row: object, where: Where) -> Swing:
    """Read one periodic term of a moving pole: amplitude, phase and rate."""
    if not isinstance(row, (list, tuple)) or len(row) != 3:
        raise where.error(row, "give size, phase and rate of each term")
    units, examples = ("rad", "rad", "rad/s"), ("0.7 deg", "357.85 deg", "1e-11 rad/s")
    terms = zip(row, units, examples, strict=True)
    return Swing(*(float(quantity(term, unit, where, example)) for term, unit, example in terms))

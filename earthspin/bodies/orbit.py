"""Keplerian orbits with precessing node and pericentre, and satellites of a planet."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import combinations
from typing import Annotated, ClassVar

import numpy as np

from earthspin.bodies.checks import Record, all_of, is_same
from earthspin.bodies.kinds import Magnitude, kinds_of
from earthspin.dates import MICROSECONDS_PER_DAY, microseconds
from earthspin.errors import Where, checked
from earthspin.numerics.arrays import Numeric
from earthspin.units import Plain, Text, Word

# --- orbits ---------------------------------------------------------------------------------------

#: Reference planes for the angles of an orbit.
PLANES = ("ecliptic", "equator", "orbit", "icrf")

_ONE_OF = 'give a or period, like a = "384399 km" or period = "27.32 d"'


class Epoch:
    """Converter of a date to days from J2000.0 TDB, the form in which an orbit stores its epoch."""

    words, hint = 'a date, like "2000-01-01T12:00"', "Date | float"

    def read(self, value: object, where: Where) -> float:
        """Convert a date, or a number of days from J2000.0 TDB, to days from J2000.0 TDB."""
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            if not abs(value) <= _LARGEST:
                raise where.error(value, f"give a date, or at most {_LARGEST:g} days from J2000.0")
            return float(value)
        return microseconds(value, where) / MICROSECONDS_PER_DAY

    def write(self, value: float) -> Plain:
        """Return the date as days from J2000.0 TDB, without rounding, for scene files."""
        return value


@dataclass(frozen=True, kw_only=True, eq=False)
class Orbit(Record):
    """Keplerian elements of an orbit, from which positions are computed without a kernel.

    For a perturber this is its orbit about the spinning body, unless `about` names another centre.
    For the spinning body this is its own orbit. Thus either the Sun may have its apparent orbit, or
    the spinning body its orbit about the Sun.

    Numbers carry their units as text or Quantities; plain ones are SI and radians. They may be
    labelled arrays, for many orbits.

    Attributes
    ----------
    a : float or None
        Semi-major axis, m. If not given, it follows from the period and both masses.
    period : float or None
        Sidereal period, s: that of the mean longitude (node + pericentre + mean anomaly). If not
        given, it follows from `a` and both masses. If both are given, `a` sets the distance and
        `period` the motion; they must agree with Kepler's third law to 1 %, as real orbits are
        perturbed.
    e : float
        Eccentricity, 0 to less than 1.
    i, node, pericentre, mean_anomaly : float
        Inclination, longitude of the ascending node, argument of the pericentre, and mean anomaly
        at the epoch, rad.
    epoch : float
        Days from J2000.0 TDB; given as a date or such days.
    node_period, pericentre_period : float or None
        Period of the node, and of the argument of the pericentre, s; negative if retrograde. None:
        constant.
    plane : str or None
        Reference plane of the angles: the ``"ecliptic"`` and equinox of J2000.0; the ``"equator"``
        or the ``"orbit"`` of the spinning body at J2000.0, from its equinox (or, without an orbit,
        from the ascending node of its equator on the equator of the ICRF); or the ``"icrf"``. None:
        for an orbit `about` a built-in planet other than the Earth the Laplace plane of the moon,
        from its ascending node on the equator of the ICRF; otherwise the ecliptic.
    about : str
        Name of the central body; empty for the spinning body.
    reference : str
        Source of the numbers.
    direction_error, direction_drift, distance_error, distance_drift, rate_error : float or None
        For mean elements of a real orbit, bounds on what the ellipse differs from it by: angle at
        the epoch, rad, and its growth, rad/s; distance at the epoch, m, and its growth, m/s; and
        relative error of the mean torque. None: the elements define the orbit.

    Raises
    ------
    SceneError, UnitsError
        If an element is out of range, or both `a` and `period` are missing.

    Examples
    --------
    >>> import earthspin
    >>> moon = earthspin.MOON.replace(
    ...     orbit=earthspin.Orbit(a="384399 km", e=0.0549, i="5.145 deg", node_period="-6793.5 d")
    ... )
    >>> sun = earthspin.SUN.replace(orbit={"a": "1 au", "e": 0.0167})
    >>> rate = earthspin.precession(perturbers=[sun, moon]).precession_rate
    >>> print(rate.sel(perturber="total").round(2).values)
    50.4
    """

    a: Annotated[Numeric | None, Magnitude("m", "384399 km")] = None
    period: Annotated[Numeric | None, Magnitude("s", "27.32 d")] = None
    e: Annotated[Numeric, Magnitude("", "0.0549")] = 0.0
    i: Annotated[Numeric, Magnitude("rad", "5.145 deg", polar=True)] = 0.0
    node: Annotated[Numeric, Magnitude("rad", "125 deg")] = 0.0
    pericentre: Annotated[Numeric, Magnitude("rad", "318 deg")] = 0.0
    mean_anomaly: Annotated[Numeric, Magnitude("rad", "135 deg")] = 0.0
    epoch: Annotated[float, Epoch()] = 0.0
    node_period: Annotated[Numeric | None, Magnitude("s", "-6793.5 d")] = None
    pericentre_period: Annotated[Numeric | None, Magnitude("s", "2191 d")] = None
    plane: Annotated[str | None, Word(PLANES)] = None
    about: Annotated[str, Text()] = ""
    reference: Annotated[str, Text()] = ""
    direction_error: Annotated[Numeric | None, Magnitude("rad", "700 arcsec")] = None
    direction_drift: Annotated[Numeric | None, Magnitude("rad/s", "3 arcsec/yr")] = None
    distance_error: Annotated[Numeric | None, Magnitude("m", "7e5 km")] = None
    distance_drift: Annotated[Numeric | None, Magnitude("m/s", "0.06 m/s")] = None
    rate_error: Annotated[Numeric | None, Magnitude("", "0.001")] = None

    words: ClassVar[str] = 'a table of elements, like {a = "384399 km", e = 0.0549}'
    hint: ClassVar[str] = "Orbit | Mapping[str, Any]"

    def __post_init__(self) -> None:
        elements = self.checked(vars(self), Where("orbit"))
        if elements.keys().isdisjoint(("a", "period")):
            raise Where("orbit").error(None, _ONE_OF)
        vars(self).update(elements)

    def __str__(self) -> str:
        elements = (
            f"{name} = {'an array' if isinstance(value, dict) else value}"
            for name, value in self.write().items()
            if name != "reference" and not is_same(getattr(self, name), getattr(Orbit, name))
        )
        return ", ".join(elements)


#: Plausibility bound: above the size and age of the observable universe, m and s.
_LARGEST = 1e30


def _is_size(size: Numeric) -> Numeric:
    return (size > 0) & (size <= _LARGEST)


_ELLIPSE = "the orbit must be an ellipse: e is 0 or more, less than 1; a hyperbola is a position="
_INCLINATION = ("i", lambda i: (i >= 0) & (i <= math.pi), "an inclination must be 0 to 180 deg")
_BOUNDS = ("direction_error", "direction_drift", "distance_error", "distance_drift", "rate_error")
Orbit.KINDS = kinds_of(Orbit)
Orbit.RULES = (
    ("a", _is_size, f"it is greater than zero, and at most {_LARGEST:g} m"),
    ("period", _is_size, f"it is greater than zero, and at most {_LARGEST:g} s"),
    ("e", lambda e: (e >= 0) & (e < 1), _ELLIPSE),
    _INCLINATION,
    ("node_period", lambda p: p != 0, "a period is not zero; negative is backwards"),
    ("pericentre_period", lambda p: p != 0, "a period is not zero; negative is backwards"),
    *(
        (name, lambda size: (size >= 0) & (size <= _LARGEST), "a bound on an error is zero or more")
        for name in _BOUNDS
    ),
)
Orbit.__init__ = checked(Orbit.__init__)  # type: ignore[method-assign]


# --- satellites -----------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True, eq=False)
class Satellite(Record):
    """Satellite of a planet, with a mean orbital plane that precesses with the planet's equator.

    Numbers carry their units as text or Quantities; plain ones are SI and radians.

    Attributes
    ----------
    name : str
    gm : float
        Gravitational parameter, m3 s-2.
    a : float
        Semi-major axis, m.
    i : float
        Inclination to the Laplace plane, about which the node of the orbit precesses, rad; more
        than 90 deg for an orbit opposite to the spin of the planet.
    gm_uncertainty : float
        One standard deviation of `gm`, m3 s-2.
    reference : str
        Source of the numbers.

    Raises
    ------
    SceneError, UnitsError
        If a number is out of range.

    Examples
    --------
    >>> import earthspin
    >>> moon = {"name": "moon", "gm": "9 km3/s2", "a": "30000 km"}
    >>> planet = earthspin.MARS.replace(satellites=[moon])
    >>> rate = earthspin.precession(body=planet).precession_rate.sel(perturber="total")
    >>> print(planet.satellites[0].a, rate.round(2).item())  # without satellites 7.61 arcsec/yr
    30000000.0 35.97
    """

    name: Annotated[str, Text()]
    gm: Annotated[Numeric, Magnitude("m3/s2", "8978 km3/s2")]
    a: Annotated[Numeric, Magnitude("m", "1221865 km")]
    i: Annotated[Numeric, Magnitude("rad", "0.3 deg", polar=True)] = 0.0
    gm_uncertainty: Annotated[Numeric, Magnitude("m3/s2", "2 km3/s2")] = 0.0
    reference: Annotated[str, Text()] = ""

    words: ClassVar[str] = 'a table like {name = "titan", gm = "8978 km3/s2", a = "1221865 km"}'

    REQUIRED = ("name", "gm", "a")
    UNWRITTEN = (0.0, "")

    def __post_init__(self) -> None:
        vars(self).update(self.checked(vars(self), Where(f"satellites.{self.name}")))


Satellite.__init__ = checked(Satellite.__init__)  # type: ignore[method-assign]
#: Plausibility bound: above mass and size of the observable universe, SI.
_LARGEST_SATELLITE = 1e60
#: Smallest GM, that of a rock of 15 kg, m3 s-2.
_LEAST = 1e-9
_RANGE_OF_GM = f"it is {_LEAST:g} to {_LARGEST_SATELLITE:g} m3 s-2; leave out what has no mass"
_RANGE_OF_A = f"it is greater than zero, and at most {_LARGEST_SATELLITE:g} m"
Satellite.KINDS = kinds_of(Satellite)
Satellite.RULES = (
    ("gm", lambda gm: (gm >= _LEAST) & (gm <= _LARGEST_SATELLITE), _RANGE_OF_GM),
    ("a", lambda a: (a > 0) & (a <= _LARGEST_SATELLITE), _RANGE_OF_A),
    _INCLINATION,
    ("gm_uncertainty", lambda u: u >= 0, "an uncertainty must be zero or more"),
)


#: Smallest relative distance of two orbits; closer ones do not pull as rings do.
_APART = 1e-3


class SatelliteList:
    """Converter of the field `satellites` of a body: a list with one table for each satellite."""

    words = f"a list of satellites, each {Satellite.words}"
    hint = "Sequence[Satellite | Mapping[str, Any]]"

    def read(self, value: object, where: Where) -> tuple[Satellite, ...]:
        """Read a list of satellites; refuse equal names, and orbits of almost equal size."""
        if not isinstance(value, (list, tuple)):
            raise where.error(value, f"give {self.words}")
        satellites = tuple(Satellite.read(entry, where) for entry in value)
        names = [satellite.name for satellite in satellites]
        if len(set(names)) < len(names):
            raise where.error(names, "each satellite has its own name")
        pairs = combinations((satellite.a for satellite in satellites), 2)
        if not all(all_of(abs(one - two) >= _APART * np.maximum(one, two)) for one, two in pairs):
            raise where.error(names, "two satellites share one orbit; join their masses")
        return satellites

    def write(self, value: tuple[Satellite, ...]) -> Plain:
        """Return a list of tables, which is the form stored in scene files."""
        return [satellite.write() for satellite in value]

"""Satellites of a planet, which precess together with it; tables of them in scenes."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from itertools import pairwise
from typing import Annotated, Any, ClassVar, get_type_hints

from earthspin.bodies.kinds import Magnitude, Plain
from earthspin.errors import Where, nearest
from earthspin.units import Text


@dataclass(frozen=True, kw_only=True)
class Satellite:
    """A satellite that precesses together with the equator of its planet.

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
        Where the numbers come from.

    Raises
    ------
    SceneError, UnitsError
        If a number is out of range.

    Examples
    --------
    >>> import earthspin
    >>> moon = {"name": "moon", "gm": "9 km3/s2", "a": "30000 km"}
    >>> planet = earthspin.MARS.replace(satellites=[moon])
    >>> faster = earthspin.precession(body=planet).precession_rate / -7.6142
    >>> print(planet.satellites[0].a, faster.round(2).values)
    30000000.0 [-1.02]
    """

    name: Annotated[str, Text()]
    gm: Annotated[float, Magnitude("m3/s2", "8978 km3/s2")]
    a: Annotated[float, Magnitude("m", "1221865 km")]
    i: Annotated[float, Magnitude("rad", "0.3 deg")] = 0.0
    gm_uncertainty: Annotated[float, Magnitude("m3/s2", "2 km3/s2")] = 0.0
    reference: Annotated[str, Text()] = ""

    words: ClassVar[str] = 'a table like {name = "titan", gm = "8978 km3/s2", a = "1221865 km"}'

    def __post_init__(self) -> None:
        where = Where(f"satellites.{self.name}")
        for name, kind in _KINDS.items():
            value = kind.read(getattr(self, name), where.at(name))
            if isinstance(kind, Magnitude) and not isinstance(value, float):
                raise where.at(name).error("an array", "it is one number")
            object.__setattr__(self, name, value)
        for name, holds, allowed in _RULES:
            if not holds(getattr(self, name)):
                raise where.at(name).error(getattr(self, name), allowed)

    @classmethod
    def read(cls, value: object, where: Where) -> Satellite:
        """Read a satellite: a `Satellite`, or a table of its numbers.

        Raises
        ------
        SceneError, UnitsError
            If a key is unknown or missing, or a number is impossible.
        """
        if isinstance(value, cls):
            return value
        if not isinstance(value, Mapping):
            raise where.error(value, f"give {cls.words}")
        for key in value:
            if key not in _KINDS:
                raise where.at(key).error(value[key], nearest(key, _KINDS))
        for key in ("name", "gm", "a"):
            if key not in value:
                raise where.at(key).error(None, f"give {cls.words}")
        return cls(**{key: _KINDS[key].read(entry, where.at(key)) for key, entry in value.items()})

    def write(self) -> Plain:
        """Convert the satellite to a table of all numbers that are set, for scene files."""
        values = {f.name: getattr(self, f.name) for f in fields(self)}
        return {n: _KINDS[n].write(v) for n, v in values.items() if v not in (0.0, "")}


_KINDS: dict[str, Any] = {
    name: hint.__metadata__[0]
    for name, hint in get_type_hints(Satellite, include_extras=True).items()
    if hasattr(hint, "__metadata__")
}
#: Plausibility bound: above mass and size of the observable universe, SI.
_LARGEST = 1e60
#: Smallest GM, that of a rock of 15 kg, m3 s-2.
_LEAST = 1e-9
#: Conditions on each number.
_RULES: tuple[tuple[str, Callable[[float], bool], str], ...] = (
    (
        "gm",
        lambda gm: _LEAST <= gm <= _LARGEST,
        f"it is {_LEAST:g} to {_LARGEST:g} m3 s-2; leave out what has no mass",
    ),
    ("a", lambda a: 0 < a <= _LARGEST, f"it is greater than zero, and at most {_LARGEST:g} m"),
    ("i", lambda i: 0 <= i <= math.pi, "an inclination must be 0 to 180 deg"),
    ("gm_uncertainty", lambda u: u >= 0, "an uncertainty must be zero or more"),
)


#: Smallest relative distance of two orbits; closer ones do not pull as rings do.
_APART = 1e-3


class SatelliteList:
    """Converter of the satellites of a body: a list of tables, each with one satellite."""

    words = f"a list of satellites, each {Satellite.words}"
    hint = "Sequence[Satellite | Mapping[str, Any]]"

    def read(self, value: object, where: Where) -> tuple[Satellite, ...]:
        """Read a list of satellites; refuse two of one name."""
        if not isinstance(value, (list, tuple)):
            raise where.error(value, f"give {self.words}")
        satellites = tuple(Satellite.read(entry, where) for entry in value)
        names = [satellite.name for satellite in satellites]
        if len(set(names)) < len(names):
            raise where.error(names, "each satellite has its own name")
        sizes = sorted(satellite.a for satellite in satellites)
        if any(outer - inner < _APART * outer for inner, outer in pairwise(sizes)):
            raise where.error(names, "two satellites share one orbit; join their masses")
        return satellites

    def write(self, value: tuple[Satellite, ...]) -> Plain:
        """Return a list of tables, which is the form stored in scene files."""
        return [satellite.write() for satellite in value]

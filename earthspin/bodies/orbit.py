"""An orbit by its elements: an ellipse whose node and pericentre may turn at even rates."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from typing import Annotated, Any, ClassVar, get_origin, get_type_hints

from earthspin.bodies.kinds import Magnitude, OneOf, Plain
from earthspin.dates import MICROSECONDS_PER_DAY, microseconds
from earthspin.errors import Where, nearest
from earthspin.units import Text

#: What the angles of an orbit may be counted from.
PLANES = ("ecliptic", "equator", "orbit", "icrf")

_ONE_OF = 'give a or period, like a = "384399 km" or period = "27.32 d"'


class Epoch:
    """Kind of a date that is kept in days from J2000.0 TDB."""

    words, hint = 'a date, like "2000-01-01T12:00"', "str | datetime | datetime64 | Time | float"

    def read(self, value: object, where: Where) -> float:
        """Read a date; a number is days from J2000.0 TDB."""
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            if not abs(value) <= _LARGEST:
                raise where.error(value, f"give a date, or at most {_LARGEST:g} days from J2000.0")
            return float(value)
        return microseconds(value, where) / MICROSECONDS_PER_DAY

    def write(self, value: float) -> Plain:
        """Give the days: a date would round them to the microsecond."""
        return value


@dataclass(frozen=True, kw_only=True)
class Orbit:
    """An orbit by its elements, in place of a kernel.

    Of a perturber it is the orbit about the spinning body, unless `about` names what else it goes
    round; of the spinning body, the one about what it goes round. The Sun may thus be given its
    apparent orbit, or the body its own.

    Numbers carry their units as text or Quantities; plain ones are SI and radians.

    Attributes
    ----------
    a : float or None
        Half the long axis, m. If it is not given it follows from the period and both masses.
    period : float or None
        Sidereal, s: of the mean longitude (node + pericentre + mean anomaly). If it is not given it
        follows from `a` and both masses. With both, `a` gives the distance and `period` the motion;
        they must agree with Kepler's third law to one per cent, because others disturb real orbits.
    e : float
        Eccentricity, 0 to less than 1.
    i, node, pericentre, mean_anomaly : float
        Inclination, longitude of the ascending node, argument of the pericentre, and mean anomaly
        at the epoch, rad.
    epoch : float
        Days from J2000.0 TDB; given as a date or such days.
    node_period, pericentre_period : float or None
        In which the node, and the argument of the pericentre, go once round, s; negative if they
        go backwards. None: they stand still.
    plane : str
        What the angles are counted from: the ``"ecliptic"`` and equinox of J2000.0; the
        ``"equator"`` or the ``"orbit"`` of the spinning body, at J2000.0 and from its equinox
        (without an orbit: where its equator rises above that of the ICRF); or the ``"icrf"``.
    about : str
        Name of the body that it goes round; empty for the spinning body.
    reference : str
        Where the numbers come from.

    Raises
    ------
    SceneError, UnitsError
        If an element is impossible (no ellipse, a length of zero, both `a` and `period` missing).

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

    a: Annotated[float | None, Magnitude("m", "384399 km")] = None
    period: Annotated[float | None, Magnitude("s", "27.32 d")] = None
    e: Annotated[float, Magnitude("", "0.0549")] = 0.0
    i: Annotated[float, Magnitude("rad", "5.145 deg")] = 0.0
    node: Annotated[float, Magnitude("rad", "125 deg")] = 0.0
    pericentre: Annotated[float, Magnitude("rad", "318 deg")] = 0.0
    mean_anomaly: Annotated[float, Magnitude("rad", "135 deg")] = 0.0
    epoch: Annotated[float, Epoch()] = 0.0
    node_period: Annotated[float | None, Magnitude("s", "-6793.5 d")] = None
    pericentre_period: Annotated[float | None, Magnitude("s", "2191 d")] = None
    plane: Annotated[str, OneOf(PLANES)] = "ecliptic"
    about: Annotated[str, Text()] = ""
    reference: Annotated[str, Text()] = ""

    words: ClassVar[str] = 'a table of elements, like {a = "384399 km", e = 0.0549}'
    hint: ClassVar[str] = "Orbit | Mapping[str, Any]"

    def __post_init__(self) -> None:
        elements = {f.name: getattr(self, f.name) for f in fields(self)}
        for name, value in _checked(elements, Where("orbit")).items():
            object.__setattr__(self, name, value)

    @classmethod
    def read(cls, value: object, where: Where) -> Orbit:
        """Read an orbit: itself, or a table of its elements.

        Raises
        ------
        SceneError, UnitsError
            If an element is unknown or impossible.
        """
        if isinstance(value, cls):
            return value
        if not isinstance(value, Mapping):
            raise where.error(value, f"give {cls.words}")
        for name in value:
            if name not in _KINDS:
                raise where.at(name).error(value[name], nearest(name, _KINDS))
        return cls(**_checked(value, where))

    def write(self) -> Plain:
        """Give the table of every element that is set."""
        elements = {name: getattr(self, name) for name in _KINDS}
        return {n: _KINDS[n].write(v) for n, v in elements.items() if v not in (None, "")}

    def __str__(self) -> str:
        elements = (
            f"{name} = {value}"
            for name, value in self.write().items()
            if name != "reference" and getattr(self, name) != _DEFAULTS[name]
        )
        return ", ".join(elements)


_KINDS: dict[str, Any] = {
    name: hint.__metadata__[0]
    for name, hint in get_type_hints(Orbit, include_extras=True).items()
    if get_origin(hint) is Annotated
}
_DEFAULTS = {f.name: f.default for f in fields(Orbit)}

#: Larger than all that is seen, and longer than its age: m, s.
_LARGEST = 1e30

#: What an element must be beyond a finite number.
_RULES: dict[str, tuple[Callable[[float], bool], str]] = {
    "a": (lambda a: 0 < a <= _LARGEST, f"it is greater than zero, and at most {_LARGEST:g} m"),
    "period": (lambda p: 0 < p <= _LARGEST, f"it is greater than zero, and at most {_LARGEST:g} s"),
    "e": (lambda e: 0 <= e < 1, "elements are those of an ellipse: e is 0 or more, less than 1"),
    "i": (lambda i: 0 <= i <= math.pi, "an inclination is 0 to 180 deg"),
    "node_period": (lambda p: p != 0, "a period is not zero; negative is backwards"),
    "pericentre_period": (lambda p: p != 0, "a period is not zero; negative is backwards"),
}


def _checked(elements: Mapping[str, Any], where: Where) -> dict[str, Any]:
    """Each element read and within its bounds.

    Raises
    ------
    SceneError, UnitsError
        Naming the element.
    """
    read: dict[str, Any] = {}
    for name, value in elements.items():
        if value is None:
            continue
        if hasattr(value, "dims") or isinstance(value, Mapping):
            raise where.at(name).error("an array", "an element is one number")
        # in SI: nothing to load for it
        plain = type(value) is float and math.isfinite(value) and not where.typed
        read[name] = value if plain else _KINDS[name].read(value, where.at(name))
        if not isinstance(read[name], (float, str)):
            raise where.at(name).error(value, "an element is one number")
        if name in _RULES and not _RULES[name][0](read[name]):
            raise where.at(name).error(value, _RULES[name][1])
    if "a" not in read and "period" not in read:
        raise where.error(None, _ONE_OF)
    return read

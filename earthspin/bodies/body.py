"""The class `Body`: an immutable record of a body's name and of its cited numbers in SI units.

A body that spins needs its figure (`j2`, `dynamical_flattening`, `radius`), its `spin_period`
and its `pole`; a body that only exerts a torque needs `gm` and `naif`. The built-in bodies
are in other files of this package, with the source and uncertainty of every number.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import InitVar, dataclass, field, replace
from functools import reduce, wraps
from operator import and_
from typing import Annotated, Any, ClassVar, Literal, overload

import numpy as np

from earthspin import constants as c
from earthspin._lazy import xr
from earthspin.bodies import checks, kinds, shapes
from earthspin.bodies.checks import all_of, are_close, is_close, is_same
from earthspin.bodies.kinds import Magnitude
from earthspin.bodies.laplace_plane import reference_plane
from earthspin.bodies.orbit import Orbit, Satellite, SatelliteList
from earthspin.errors import (
    ApartError,
    ArgumentError,
    BodyError,
    EarthspinError,
    SceneError,
    Where,
    nearest,
)
from earthspin.html_table import card
from earthspin.interior.layers import LayeredBody
from earthspin.numerics.arrays import Numeric
from earthspin.sky import poles
from earthspin.sky.poles import Direction, FixedPole, MovingPole, PoleModel, TiltedPole
from earthspin.sky.sources import describe_position
from earthspin.units import Text

#: Fields that hold a number, or None if it is not known.
NumberName = Literal[
    "gm", "radius", "j2", "dynamical_flattening", "triaxiality", "j3", "j4", "j2_rate",
    "k2", "tidal_delay", "core_moment", "core_flattening", "core_friction",
    "prime_meridian", "prime_meridian_uncertainty", "long_axis", "flattening", "spin_period",
    "pole_uncertainty", "orbital_period",
]  # fmt: skip
#: Values of the key "from" in a table of a body: all numbers are in the table, or the figure
#: follows from its layers.
NOTHING, LAYERS = "nothing", "layers"
_H = "(C - A)/C = j2/(C/(M radius2))"
_ONE_AXIS = "the pole already gives it; set one of pole and obliquity"


@dataclass(frozen=True, kw_only=True, eq=False)
class Body(checks.Record, shapes.FromMass):
    """A body that spins, exerts a torque, or both.

    Numbers carry their units as text or Quantities (``"5 h"``); plain ones are SI and radians.

    Attributes
    ----------
    name : str
        Label in results.
    gm : float
        Gravitational parameter, m3 s-2.
    naif : tuple of int
        NAIF codes of the body in kernels, the preferred one first.
    radius : float
        Equatorial radius a, m; the reference radius of `j2`.
    j2 : float
        (C - (A + B)/2) / (M a2); geodesy's J2, not the source text's (I.9.25).
    dynamical_flattening : float
        H = (C - (A + B)/2) / C. At most 1/2, the thin disc; negative if prolate.
    triaxiality : float
        (B - A) / (M a2).
    j3, j4 : float
        Zonal coefficients beyond J2, unnormalised, with the sign of geodesy's J_n.
    j2_rate : float
        Rate of change of `j2`, s-1.
    harmonics : mapping of str to float
        Unnormalised Stokes coefficients of degree 3 and higher, by name, such as ``"c31"`` and
        ``"s31"``; they contain those of `j3` and `j4`, which are then not given.
    k2 : float
        Love number of degree 2, for the tides on the body. Numbers that are not known are None, and
        the effects that need them are left out.
    tidal_delay : float
        Delay of these tides, s.
    core_moment : float
        Polar moment of a fluid core, divided by C of the body.
    core_flattening : float
        (C - A)/C of that core.
    core_friction : float
        Torque between core and mantle, divided by C and by the difference of their angular
        velocities, s-1.
    prime_meridian : float or None
        Angle W at J2000.0 TDB, along the equator of date, from its ascending node on the equator of
        the ICRF to the prime meridian, rad; it grows by one turn in each `spin_period`. None if it
        is not known, and for the pole `IAU_2006`, whose prime meridian follows from UT1.
    prime_meridian_uncertainty : float or None
        One standard deviation of `prime_meridian`, rad; None if it is not known.
    long_axis : float
        East longitude of the axis of least moment, rad.
    flattening : float
        (a - c) / a of the figure, the ellipticity epsilon of (I.9.38).
    spin_period : float
        One turn relative to the stars, s; negative if retrograde, that is backwards about `pole`.
    pole : PoleModel
        Direction of the spin axis: `IAU_2006` (``"iau2006"``), or a `FixedPole`, which may be given
        as right ascension and declination (ICRF, J2000.0, rad).
    pole_uncertainty : float or None
        One standard deviation of `pole` at J2000.0 in each of two directions, rad; None if it is
        not known.
    orbit_pole : Direction or None
        Right ascension and declination of the orbit's normal (ICRF, rad); not used with
        `IAU_2006`, which includes a model of the ecliptic.
    orbital_period : float
        Sidereal period of the orbit, s.
    cycle : float
        For a perturber: the longest cycle of its torque that averages must span, s. For the Moon
        this is the period of its node; otherwise the period of Jupiter, which perturbs every orbit.
    slow_swing : float
        For a perturber: relative variation of its mean torque on time scales longer than any
        averaging window, half-width of the 95 % interval.
    interior : str, LayeredBody or None
        Interior structure: a name from `earthspin.interior.named`, or layers, which may be given as
        a table of layers or samples; None means rigid.
    observed_wobble : Constant or None
        Observed period of the free wobble, d.
    position : vector function, Trajectory or None
        Source of the body's position if not a kernel: a vector function of Skyfield, or an object
        as described in `earthspin.sky.protocol`.
    orbit : Orbit or None
        Orbital elements, used if neither a kernel nor `position` is. For a spinning body,
        `orbit_pole` follows from the elements if it is not given.
    relative_uncertainty : mapping
        Standard deviation divided by the value, by field name.
    satellites : tuple of Satellite
        Satellites that precess together with the body; `gm` and the moments are without them. They
        may be given as a list of tables.
    reference : str
        Source of the numbers.
    obliquity : float
        Given instead of `pole`: angle from the orbit normal to the pole, rad, 0 to pi, which stays
        if the orbit is replaced. The direction of the equinox does not change; for a new body it is
        the node of the orbit on the equator of the ICRF.
    mass : float
        Given instead of `gm`, kg.
    moments : sequence of float
        Given instead of `j2`, `dynamical_flattening` and `triaxiality`: three principal moments, kg
        m2, the polar one last.

    Raises
    ------
    UnitsError
        If a unit is unknown, or has the wrong dimension.
    BodyError
        If a field is not finite, a mass is negative, C exceeds A + B, j2 and H differ in sign, or a
        nearly round body has larger moments than a hollow sphere.

    Examples
    --------
    >>> import earthspin
    >>> slow = earthspin.EARTH.replace(spin_period="48 h")
    >>> period = earthspin.precession(body=slow).precession_period.sel(perturber="total")
    >>> print(period.round().values, "years")
    12821.0 years
    """

    name: Annotated[str, Text()]
    gm: Annotated[Numeric, Magnitude("m3/s2", "3.986e14 m3/s2")]
    naif: Annotated[tuple[int, ...], kinds.Codes()] = ()
    radius: Annotated[Numeric | None, Magnitude("m", "6378 km")] = None
    j2: Annotated[Numeric | None, Magnitude("", "1.08e-3", "(C - A)/(M a2)")] = None
    dynamical_flattening: Annotated[Numeric | None, Magnitude("", "3.27e-3", _H)] = None
    triaxiality: Annotated[Numeric, Magnitude("", "7.26e-6")] = 0.0
    j3: Annotated[Numeric | None, Magnitude("", "-2.53e-6")] = None
    j4: Annotated[Numeric | None, Magnitude("", "-1.62e-6")] = None
    j2_rate: Annotated[Numeric | None, Magnitude("1/s", "-9.5e-19 1/s")] = None
    harmonics: Annotated[Mapping[str, float], kinds.StokesCoefficients()] = field(
        default_factory=dict
    )
    k2: Annotated[Numeric | None, Magnitude("", "0.024")] = None
    tidal_delay: Annotated[Numeric | None, Magnitude("s", "0.1 d")] = None
    core_moment: Annotated[Numeric | None, Magnitude("", "7e-4")] = None
    core_flattening: Annotated[Numeric | None, Magnitude("", "2.5e-4")] = None
    core_friction: Annotated[Numeric | None, Magnitude("1/s", "1.9e-13 1/s")] = None
    prime_meridian: Annotated[float | None, Magnitude("rad", "329.6 deg")] = None
    prime_meridian_uncertainty: Annotated[float | None, Magnitude("rad", "0.1 deg")] = None
    long_axis: Annotated[float, Magnitude("rad", "75 deg")] = 0.0
    flattening: Annotated[Numeric | None, Magnitude("", "3.35e-3", "(a - c)/a")] = None
    spin_period: Annotated[Numeric | None, Magnitude("s", "23.93 h")] = None
    pole: Annotated[PoleModel | None, kinds.PoleInText(poles.pole_of)] = None
    pole_uncertainty: Annotated[float | None, Magnitude("rad", "0.5 arcsec")] = None
    orbit_pole: Annotated[Direction | None, kinds.PoleInText(Direction.of)] = None
    orbital_period: Annotated[float | None, Magnitude("s", "365.25 d")] = None
    cycle: Annotated[float, Magnitude("s", "4333 d")] = c.JUPITER_ORBITAL_PERIOD.value
    # from the scatter of averages about epochs every 1500 d in DE440 (docs/accuracy.md)
    slow_swing: Annotated[float, Magnitude("", "2e-7")] = 2e-7
    interior: Annotated[str | LayeredBody | None, kinds.InteriorConverter()] = None
    observed_wobble: Annotated[c.Constant | None, kinds.CitedPeriod()] = None
    position: Annotated[Any, kinds.PositionConverter()] = None
    orbit: Annotated[Orbit | None, Orbit] = None
    relative_uncertainty: Annotated[Mapping[str, float], kinds.NumberTable()] = field(
        default_factory=dict
    )
    satellites: Annotated[tuple[Satellite, ...], SatelliteList()] = ()
    reference: Annotated[str, Text()] = ""
    obliquity: InitVar[Any] = None

    words: ClassVar[str] = 'a Body, a name like "mars", or a table of numbers'
    hint: ClassVar[str] = "Body | str | Mapping[str, Any] | VectorFunction"
    by_name: ClassVar[bool] = True
    #: Converter of each field; unit of each numeric field; and the numeric fields that may be
    #: labelled arrays, for an ensemble of bodies.
    #:
    #: :meta hide-value:
    KINDS: ClassVar[dict[str, Any]]
    UNITS: ClassVar[dict[str, str]]
    LABELLED: ClassVar[frozenset[str]]

    def __post_init__(self, obliquity: Any) -> None:
        if obliquity is not None:
            if self.pole is not None:
                raise BodyError(self.name, "obliquity", obliquity, _ONE_AXIS)
            self._set(pole=TiltedPole.at(self._checked_obliquity(obliquity)))
        try:
            self._set(**self.checked(vars(self), Where(str(self.name))))
        except SceneError as error:
            field = error.key.removeprefix(f"{self.name}.")
            if field not in (*self.UNITS, "pole", "orbit_pole"):
                raise
            raise BodyError(self.name, field, error.given, error.problem) from None
        if self.orbit is not None:
            self._place_on(self.orbit)
        checks.check_numbers(vars(self), self.UNITS)
        checks.check_labels(self.name, self.arrays)
        if isinstance(self.pole, TiltedPole):
            self._set(pole=self._pole_at(self.pole))
        for name in ("j3", "j4") if self.harmonics else ():
            value = getattr(self, name)
            if value is not None and not all_of(value == 0):
                allowed = "harmonics contains them, as c30 = -j3 and c40 = -j4; leave them out"
                raise BodyError(self.name, name, value, allowed)
        if self.prime_meridian is not None and self.pole is not None and self.pole.of_the_iau:
            allowed = "the prime meridian of the pole iau2006 follows from UT1; set another pole"
            raise BodyError(self.name, "prime_meridian", self.prime_meridian, allowed)

    def _set(self, **values: Any) -> None:
        for name, value in values.items():
            object.__setattr__(self, name, value)

    def _checked_obliquity(self, value: object) -> Numeric:
        """Read an obliquity: a number, or an array with named dimensions."""
        angle = kinds.OBLIQUITY.read(value, Where(f"{self.name}.obliquity"))
        one = hasattr(angle, "dims") or not np.ndim(angle)
        if not one or not all_of((angle >= 0) & (angle <= math.pi)):
            allowed = "from 0 to 180 deg; plain numbers are radians, so write '40 deg'"
            raise BodyError(self.name, "obliquity", value, f"give one angle {allowed}")
        return angle

    def _pole_at(self, pole: TiltedPole) -> PoleModel:
        """Spin axis, fixed in space, with its obliquity to the orbit and its equinox."""
        if self.orbit_pole is None:
            allowed = "it is measured from the normal of the orbit: set orbit or orbit_pole"
            raise BodyError(self.name, "obliquity", pole.obliquity, allowed)
        if self.orbit is not None and self.orbit.plane == "equator":
            allowed = "the orbit is given on the equator, which follows from it; choose a plane"
            raise BodyError(self.name, "orbit.plane", "equator", allowed)
        return TiltedPole.at(pole.obliquity, pole.equinox_of, self.orbit_pole)

    def _place_on(self, orbit: Orbit) -> None:
        """For a spinning body, derive the normal of its orbit."""
        if self.position is not None:
            raise BodyError(self.name, "orbit", str(orbit), "position places it; set one")
        if self.pole is not None and not self.pole.of_the_iau and self.orbit_pole is None:
            if orbit.plane == "orbit":
                allowed = (
                    "the plane of its own orbit cannot be its reference plane; use another plane"
                )
                raise BodyError(self.name, "orbit.plane", "orbit", allowed)
            planet = BODIES.get(orbit.about)
            plane = reference_plane(orbit, np.min(self.gm), planet, self.pole, None)
            elements = orbit.i, orbit.node, orbit.node_period
            self._set(orbit_pole=poles.OrbitNormal(*poles.of_each(plane.mean_normal, *elements)))

    def __hash__(self) -> int:
        return hash((self.name, self.naif))

    def __repr__(self) -> str:
        numbers = (f"{name} = {number}" for name, number in self._in_words() if name in _IN_REPR)
        return f"<Body {self.name}: {', '.join(numbers)}>"

    def _repr_html_(self) -> str:
        rows = [(name, words, self._source(name)) for name, words in self._in_words()]
        return card(f"{self.name}; ± is one standard deviation", rows)

    def _source(self, name: str) -> str:
        """Literature source of the value of a field; empty if no source is known."""
        value, cited = getattr(self, name), NUMBERS.get(self.known_as, {}).get(name)
        if isinstance(value, c.Constant):
            return value.source
        return cited.source if cited is not None and is_same(cited.value, value) else ""

    def _in_words(self) -> list[tuple[str, str]]:
        """Return pairs of field name and value with unit, as text, for the fields that are set."""
        rows = []
        for name in self.KINDS:
            value, unit = getattr(self, name), self.UNITS.get(name, "")
            labelled = hasattr(value, "dims")
            if value is None or name in _HIDDEN_FIELDS or (not labelled and value in ((), {}, "")):
                continue
            words = f"an array along {', '.join(map(str, value.dims))}" if labelled else f"{value}"
            if name == "satellites":
                words = ", ".join(satellite.name for satellite in value)
            elif isinstance(value, c.Constant):
                words, unit = f"{value.value} ± {value.uncertainty}", value.unit
            elif name in self.relative_uncertainty and not labelled:
                words += f" ± {abs(value) * self.relative_uncertainty[name]:.2g}"
            rows.append((name, f"{words} {unit}".rstrip()))
        return rows

    # --- from and to a scene -----------------------------------------------------------------

    @classmethod
    def cited(cls, name: str, numbers: Mapping[str, c.Constant], **others: Any) -> Body:
        """Create and register a built-in body from numbers with sources and uncertainties.

        Parameters
        ----------
        name : str
        numbers : mapping of str to Constant
            Values with sources and uncertainties, by field, in the unit of the field. An angle has
            no relative uncertainty.
        **others
            Non-numeric fields.
        """
        values: dict[str, Any] = {key: number.value for key, number in numbers.items()}
        uncertainty = {
            key: number.relative_uncertainty
            for key, number in numbers.items()
            if number.uncertainty and number.unit != "rad"
        }
        world = cls(name=name, relative_uncertainty=uncertainty, **values, **others)
        BODIES[name], NUMBERS[name] = world, dict(numbers)
        return world

    @classmethod
    def read(cls, value: object, where: Where) -> Body:
        """Return a `Body` from a `Body`, a name, or a table of changes to a named body.

        A table without "from" changes the Earth; a question adds its default body as "from". A
        table `satellites` changes numbers of satellites, by their names.

        Raises
        ------
        SceneError, UnitsError
            If a name or key is unknown, a unit is wrong, the body is impossible, or a table with a
            name has no "from".
        """
        if isinstance(value, Body):
            return value
        if not isinstance(value, Mapping):
            return _placed(value, where) if hasattr(value, "target") else body(value, where)
        table = dict(value)
        start = table.pop("from", "earth")
        meridian = table.pop("meridian", None)
        by_name = table.pop("satellites") if isinstance(table.get("satellites"), Mapping) else {}
        where.refuse_unknown(table, ["from", *_CONVERTERS])
        changes = {key: _CONVERTERS[key].read(entry, where.at(key)) for key, entry in table.items()}
        for moon, elements in by_name.items():
            owner = f"satellites.{moon.lower()}"
            read = Satellite.checked(elements, where.at(owner))
            changes |= {f"{owner}.{element}": value for element, value in read.items()}
        if meridian is not None:
            of_the_iau = table.get("pole", start == "earth" and "iau2006") == "iau2006"
            angle = Magnitude("rad", "10 deg").read(meridian, where.at("meridian"))
            changes |= _without_meridian(angle, of_the_iau)
        if "from" not in value and "name" in changes:
            allowed = "write from = 'earth' or another to change, from = 'nothing' for a new body"
            raise where.error(dict(table), allowed)
        try:
            if start in _REQUIRED_KEYS:
                if missing := _missing_fields(start, changes):
                    raise where.error(dict(table), f"a body from {start} {missing}")
                if start == LAYERS:
                    return cls.from_layers(changes.pop("interior"), **changes)
                return cls(**changes)
            return body(start, where.at("from")).replace(**changes)
        except (EarthspinError, TypeError) as error:
            if isinstance(error, EarthspinError) and not isinstance(error, BodyError):
                raise
            raise where.error(dict(table), str(error)) from None

    def write(self) -> Any:
        """Convert the body to a table of its fields for a scene file; `read` restores it."""
        values = {name: getattr(self, name) for name in self.KINDS}
        if not self.satellites:
            del values["satellites"]
        if self.orbit is not None and isinstance(self.orbit_pole, poles.OrbitNormal):
            del values["orbit_pole"]
        table = {n: self.KINDS[n].write(value) for n, value in values.items() if value is not None}
        return {"from": NOTHING} | table

    @property
    def known_as(self) -> str:
        """Name of the built-in body that shares a NAIF code with this body; empty if none does.

        A body without codes is known by its own name. Orbits, models and published numbers are
        looked up by this name.
        """
        if not self.naif:
            return self.name
        codes = set(self.naif)
        return next((name for name, world in BODIES.items() if codes & set(world.naif)), "")

    @property
    def changes(self) -> str:
        """Describe changes from the built-in body with the same NAIF code or name, if any."""
        start = BODIES.get(self.known_as)
        if start is None or start is self:
            return ""
        changes = []
        if self.position is not None:
            changes.append(f"position = {describe_position(self.position)}")
        for name in (*self.UNITS, "pole", "orbit_pole", "interior"):
            value, before = getattr(self, name), getattr(start, name)
            if hasattr(value, "dims"):
                changes.append(f"{name} along {', '.join(map(str, value.dims))}")
            elif value != before and not (name == "pole_uncertainty" and value is None):
                unit = self.UNITS.get(name, "")
                changes.append(f"{name} = {value}{unit and ' '}{unit}")
        if self.satellites != start.satellites:
            names = [satellite.name for satellite in self.satellites]
            changes.append(f"satellites = {', '.join(names) or 'none'}")
        return "; ".join(changes)

    # --- derived quantities --------------------------------------------------------

    @property
    def mass(self) -> Numeric:
        """Mass, kg; its uncertainty is dominated by that of G."""
        return self.gm / c.G.value

    def gm_on(self, other: Body) -> Numeric:
        """GM of this body and its satellites, except `other`, as it acts on `other`, m3 s-2."""
        name = (other.known_as or other.name).lower()
        return self.gm + sum(s.gm for s in self.satellites if s.name.lower() != name)

    @property
    def spin_rate(self) -> Numeric:
        """Angular velocity of rotation, rad/s; negative if retrograde."""
        return 2 * math.pi / self.needed("spin_period")

    @property
    def moments(self) -> Any:
        """Principal moments of inertia A <= B <= C, kg m2, with C about the spin axis.

        The result is a NumPy array of shape (3,).

        Raises
        ------
        BodyError
            If `j2`, `dynamical_flattening` or `radius` is not set or is an array of many bodies, or
            the flattening is zero, so that C cannot be derived.
        """
        self.require(("j2", "dynamical_flattening", "radius"))
        h = self.number("dynamical_flattening")
        if h == 0:
            raise BodyError(
                self.name, "dynamical_flattening", h, "C of a sphere cannot be derived from j2"
            )
        scale = self.number("gm") / c.G.value * self.number("radius") ** 2
        return scale * shapes.moments_of(self.number("j2"), h, self.number("triaxiality"))

    def relative_uncertainty_of_bulge(self) -> float:
        """Relative standard deviation of C - A = J2 M a2, mainly due to that of G."""
        u = self.relative_uncertainty
        return math.hypot(
            u.get("j2", 0.0), u.get("gm", 0.0), 2 * u.get("radius", 0.0), c.G.relative_uncertainty
        )

    @overload
    def needed(self, name: NumberName) -> float | xr.DataArray: ...
    @overload
    def needed(self, name: Literal["pole"]) -> PoleModel: ...
    @overload
    def needed(self, name: Literal["orbit"]) -> Orbit: ...
    def needed(self, name: str) -> Any:
        """Return the value of a field by field name; raise an error if the field is not set.

        Raises
        ------
        BodyError
            If the field is not set.
        """
        self.require((name,))
        return getattr(self, name)

    def require(self, names: Iterable[str]) -> None:
        """Raise an error if any of the given fields is not set; the message shows example values.

        Parameters
        ----------
        names : iterable of str
            Fields that must be set.

        Raises
        ------
        BodyError
            If one or more are not.
        """
        missing = [name for name in names if getattr(self, name) is None]
        if missing:
            raise BodyError.lacking(self.name, {name: self.KINDS[name].form for name in missing})

    def number(self, name: NumberName) -> float:
        """Return the value of a field as a float; refuse an array.

        Raises
        ------
        BodyError
            If the field is not set, or is an array of many bodies.
        """
        value = self.needed(name)
        if getattr(value, "dims", ()):
            raise BodyError(self.name, name, "an array", "this question takes one body at a time")
        return float(value)

    def magnitudes(self) -> dict[str, Magnitude]:
        """Converters between text and SI values, by field: for the mass and each known number."""
        numbers = {n: self.KINDS[n] for n in self.UNITS if getattr(self, n) is not None}
        return numbers | {"mass": _CONVERTERS["mass"]} | {n: k for n, (_, k) in self._elements()}

    def _elements(self) -> Iterator[tuple[str, tuple[Numeric, Magnitude]]]:
        """Yield value and converter of each number of orbit, pole and satellites, by its name."""
        records: dict[str, Any] = {} if self.orbit is None else {"orbit": self.orbit}
        records |= {f"satellites.{moon.name.lower()}": moon for moon in self.satellites}
        for owner, record in records.items():
            for name, kind in kinds.kinds_of(record.__class__).items():
                if isinstance(kind, Magnitude) and getattr(record, name) is not None:
                    yield f"{owner}.{name}", (getattr(record, name), kind)
        if self.pole is not None and (self.orbit_pole is not None or self.pole.of_the_iau):
            yield "obliquity", (getattr(self.pole, "obliquity", None), kinds.OBLIQUITY)
        if type(self.pole) in (FixedPole, MovingPole):
            for name in Direction._fields:
                yield f"pole.{name}", (getattr(self.pole, name), kinds.ANGLE)

    @property
    def arrays(self) -> dict[str, xr.DataArray]:
        """Numbers that are arrays with named dimensions, by names such as "gm" or "orbit.a"."""
        values = {name: getattr(self, name) for name in self.UNITS}
        values |= {name: value for name, (value, _) in self._elements()}
        return {name: value for name, value in values.items() if hasattr(value, "dims")}

    @property
    def labelled(self) -> bool:
        """True if some number is an array with named dimensions (one body stands for many)."""
        return bool(self.arrays)

    def isel(self, places: Mapping[Any, int]) -> Body:
        """Return the body at places along dimensions of its arrays, like `isel` of an array."""
        arrays = {n: array.isel(places, True, "ignore") for n, array in self.arrays.items()}
        numbers: dict[str, Any] = {n: a if a.dims else a.item() for n, a in arrays.items()}
        if "j2" in numbers:  # J2 alone would change H
            numbers = {"dynamical_flattening": self.dynamical_flattening} | numbers
        return self.replace(**numbers) if numbers else self

    def replace(self, **changes: Any) -> Body:
        """Return a copy of the body with changed fields; fields that depend on them are updated.

        Parameters
        ----------
        **changes
            Fields of `Body`; also ``mass`` (kg) for `gm`, ``obliquity`` (rad) for `pole`, and
            ``moments`` (three principal moments, kg m2, the polar one last) for `j2`,
            `dynamical_flattening` and `triaxiality`. If `j2` is given without
            `dynamical_flattening`, C / (M a2) is unchanged.
            Plain numbers are SI; text and Quantities carry their units (``"12 h"``).

        Raises
        ------
        BodyError
            If the changes contradict each other or make an impossible body.
        UnitsError
            If a unit is missing or unknown, or has the wrong dimension.

        Examples
        --------
        >>> from earthspin import EARTH
        >>> rounder = EARTH.replace(j2=EARTH.j2 / 2)
        >>> print(rounder.dynamical_flattening / EARTH.dynamical_flattening)
        0.5
        """
        changes = self._with_elements(changes)
        for key, value in changes.items():
            if key not in _CONVERTERS:
                problem = _ADVICE.get(key) or nearest(key, {*_CONVERTERS, *dict(self._elements())})
                raise BodyError(self.name, key, value, problem)
            if value is None and key not in self.KINDS:
                raise BodyError(self.name, key, value, f"give {_CONVERTERS[key].words}")
        changes = _without_mass_and_moments(changes, vars(self))
        obliquity = changes.pop("obliquity", None)
        if obliquity is not None and changes.get("pole") is not None:
            raise BodyError(self.name, "obliquity", obliquity, _ONE_AXIS)
        if changes.get("prime_meridian") is not None:
            changes.setdefault("prime_meridian_uncertainty", None)
        if changes.get("j2") is not None and "dynamical_flattening" not in changes:
            changes |= self._flattening(changes["j2"])
        # What follows from the previous orbit or pole is derived anew.
        derived = isinstance(self.orbit_pole, poles.OrbitNormal)
        follows = (derived and "pole" in changes) or (
            (derived or obliquity is not None) and "orbit" in changes
        )
        if follows and changes.get("orbit", self.orbit) is not None:
            changes = {"orbit_pole": None} | changes
        # The uncertainty of a number does not apply to a changed value.
        if "pole" in changes or obliquity is not None:
            changes.setdefault("pole_uncertainty", None)
        uncertainties = {k: v for k, v in self.relative_uncertainty.items() if k not in changes}
        if obliquity is not None and (self.pole is None or isinstance(self.pole, TiltedPole)):
            equinox_of = getattr(self.pole, "equinox_of", None)
            changes["pole"] = TiltedPole.at(self._checked_obliquity(obliquity), equinox_of)
        changed = _replace(self, **({"relative_uncertainty": uncertainties} | changes))
        if obliquity is not None and "pole" not in changes:
            changed = changed._tilted(obliquity)
        if changed.observed_wobble is None or "observed_wobble" in changes:
            return changed
        affects_wobble = _WOBBLE_FIELDS & changes.keys()
        same = all(is_close(getattr(changed, n), getattr(self, n)) for n in affects_wobble)
        return changed if same else _replace(changed, observed_wobble=None)  # to 1 %

    def _with_elements(self, changes: dict[str, Any]) -> dict[str, Any]:
        """Join changes of elements, like "orbit.a", to changes of orbit, pole and satellites."""
        known = {name for name, _ in self._elements() if "." in name}
        whole = {key: value for key, value in changes.items() if key not in known}
        for key in changes.keys() & known:
            path, _, element = key.rpartition(".")
            owner, _, label = path.partition(".")
            if owner in changes:
                raise BodyError(self.name, key, changes[key], f"{owner} already gives it; set one")
            change, before = {element: changes[key]}, whole.get(owner, getattr(self, owner))
            if owner == "orbit":
                whole[owner] = replace(before, **change)
            elif owner == "satellites":
                whole[owner] = tuple(
                    replace(moon, **change) if moon.name.lower() == label else moon
                    for moon in before
                )
            else:
                change = {element: kinds.ANGLE.read(changes[key], Where(key))}
                if np.ndim(change[element]):
                    raise ApartError("a pole has one direction")
                moving = isinstance(before, MovingPole)
                whole[owner] = replace(before, **change) if moving else before._replace(**change)
        return whole

    def _tilted(self, obliquity: object) -> Body:
        """Return a copy of the body, whose pole has an equinox, with another obliquity."""
        before, normal = self.needed("pole"), self.orbit_pole
        equinox_of = FixedPole.along(before.mean(np.zeros(1))[0])
        pole = TiltedPole.at(self._checked_obliquity(obliquity), equinox_of)
        if before.of_the_iau:  # its orbit is the ecliptic, unless another is given
            ecliptic = poles.OrbitNormal.along(before.orbit_normal(None))
            normal = ecliptic if self.orbit is None else None
        return _replace(self, pole=pole, orbit_pole=normal)

    def _flattening(self, j2: object) -> dict[str, Numeric]:
        """Return H from a new J2 with the same C, as a dict; empty if J2 is not known."""
        if self.j2 is None:
            return {}
        if not all_of(self.j2 != 0):
            allowed = "set dynamical_flattening too: C is not known"
            raise BodyError(self.name, "j2", j2, allowed)
        new = self.KINDS["j2"].read(j2, Where(f"{self.name}.j2"))
        return {"dynamical_flattening": self.needed("dynamical_flattening") * new / self.j2}

    @property
    def are_as_named(self) -> Numeric:
        """Test for each ensemble member if figure and spin agree with the built-in body to 1 %."""
        named = BODIES.get(self.known_as)
        if named is None or self.satellites != named.satellites:
            return False
        close = (are_close(getattr(self, name), getattr(named, name)) for name in _WOBBLE_FIELDS)
        return reduce(and_, close)

    @property
    def is_as_named(self) -> bool:
        """True if figure and spin of all ensemble members agree with the built-in body to 1 %."""
        return all_of(self.are_as_named)


def _without_mass_and_moments(given: Mapping[str, Any], known: Mapping[str, Any]) -> dict[str, Any]:
    """Replace mass and principal moments of inertia by the fields that follow from them.

    Parameters
    ----------
    given : mapping
        Numbers for a new or changed body.
    known : mapping
        All fields of the body before the change, or `given` for a new body.
    """
    name = known["name"]
    for key, follows in _FOLLOWS.items():
        if key in given and (clash := follows & given.keys()):
            raise BodyError(name, key, given[key], f"it already gives {min(clash)}; set one")
    values = {key: value for key, value in given.items() if key not in _FOLLOWS}
    read = {
        key: _CONVERTERS[key].read(given[key], Where(key)) for key in _FOLLOWS.keys() & given.keys()
    }
    if "mass" in read:
        values["gm"] = c.G.value * read["mass"]
    if "moments" in read:
        size = {key: {**known, **values}.get(key) for key in ("gm", "radius")}
        if size["radius"] is None:
            raise BodyError.lacking(name, {"radius": Body.KINDS["radius"].form})
        gm, radius = (Body.KINDS[key].read(value, Where(key)) for key, value in size.items())
        values |= shapes.figure_of(name, read["moments"], gm / c.G.value * radius**2)
    return values


def _replace(body: Body, **changes: Any) -> Body:
    """Return a copy of a body with other fields, made anew and checked."""
    return Body(**(vars(body) | changes))


def _by_keyword(make: Callable[..., None]) -> Callable[..., None]:
    """Decorate the `__init__` of a body: refuse unknown keys, and read mass and moments.

    Both are keywords and no fields, because `dataclasses.replace` would copy them to a body with
    another GM or radius.
    """

    @wraps(make)
    def init(self: Body, *places: object, **given: Any) -> None:
        if places:
            raise TypeError("Body() takes its arguments by name: Body(name='x', gm=1e14)")
        for key in given.keys() - _CONVERTERS.keys():
            name = given.get("name")
            problem = _ADVICE.get(key) or nearest(key, _CONVERTERS)
            raise BodyError(name if isinstance(name, str) else "", key, given[key], problem)
        if missing := _missing_fields(NOTHING, given):
            raise ArgumentError(f"Body() {missing}")
        make(self, **_without_mass_and_moments(given, given))

    return init


Body.__init__ = _by_keyword(Body.__init__)  # type: ignore[method-assign]

Body.KINDS, Body.RULES = kinds.kinds_of(Body), checks.RULES_OF_BODIES
Body.UNITS = {name: kind.unit for name, kind in Body.KINDS.items() if isinstance(kind, Magnitude)}
Body.LABELLED = frozenset(Body.UNITS) - {
    "prime_meridian", "prime_meridian_uncertainty", "long_axis", "pole_uncertainty",
    "orbital_period", "cycle", "slow_swing",
}  # fmt: skip

#: Converters of all keys by which a body can be created or changed.
_CONVERTERS: dict[str, Any] = {
    **Body.KINDS, "mass": Magnitude("kg", "5.97e24 kg"), "moments": kinds.ThreeMoments(),
    "obliquity": kinds.OBLIQUITY,
}  # fmt: skip

#: Fields that follow from other keys.
_FOLLOWS = {
    "mass": frozenset({"gm"}),
    "moments": frozenset({"j2", "dynamical_flattening", "triaxiality"}),
}

#: Required keys of a table, by its "from", each with an example value.
_REQUIRED_KEYS = {
    NOTHING: {"name": '"ceres"', "gm": '"62.6 km3/s2"'},
    LAYERS: {"name": '"ceres"', "spin_period": '"9.07 h"', "interior": "{layers = [...]}"},
}

#: Fields that most questions about a spinning body need, and keys that replace some of them.
SPIN_FIELDS = ("radius", "j2", "dynamical_flattening", "spin_period", "pole")
_INSTEAD = {
    "gm": "mass", "j2": "moments", "dynamical_flattening": "moments", "pole": "obliquity",
}  # fmt: skip


def _missing_fields(start: str, table: Mapping[str, Any]) -> str:
    """Text that lists the required fields that a table or call lacks; empty if it has all."""

    def lacks(name: str) -> bool:
        return {name, _INSTEAD.get(name)}.isdisjoint(table)

    missing = [f"{name} = {e}" for name, e in _REQUIRED_KEYS[start].items() if lacks(name)]
    if not missing:
        return ""
    spin = [name for name in SPIN_FIELDS if lacks(name)]
    spins = f"; a spinning one also needs {', '.join(spin)}" if start == NOTHING and spin else ""
    return f"needs more, like {', '.join(missing)}{spins}"


#: Value of `meridian` of the Earth in scenes before `prime_meridian`, rad.
_EARLIER_MERIDIAN = 4.629755030133973


def _without_meridian(meridian: float, of_the_iau: bool) -> dict[str, float | None]:
    """Fields that replace `meridian` of earlier scenes, rad.

    It was the angle at J2000.0 from the projected x axis of the ICRF to the axis of least moment.
    """
    if of_the_iau:
        meridian = meridian - _EARLIER_MERIDIAN + BODIES["earth"].long_axis
    return {"prime_meridian": None, "long_axis": meridian}


#: Advice for quantities that are no fields where they were given.
_ADVICE = {
    "polar_moment_factor": "set dynamical_flattening = j2/polar_moment_factor",
    "meridian": "give prime_meridian, from the node of the equator, and long_axis",
}

#: Fields omitted from the body's card, and fields shown in its repr.
_HIDDEN_FIELDS = {"name", "relative_uncertainty"}
_IN_REPR = {"gm", "radius", "j2", "dynamical_flattening", "spin_period"}

#: Numbers that determine the free wobble.
_WOBBLE_FIELDS = {"gm", "radius", "j2", "dynamical_flattening", "flattening", "spin_period"}


#: Every built-in body, and the source and uncertainty of its numbers; filled by the body's file.
BODIES: dict[str, Body] = {}
NUMBERS: dict[str, dict[str, c.Constant]] = {}


def body(name: object, where: Where | None = None) -> Body:
    """Return the built-in body with a given name.

    Parameters
    ----------
    name : str
        A key of `BODIES`, in upper or lower case.
    where : Where, optional
        Input that named the body, for the message.

    Raises
    ------
    SceneError
        If the name is unknown; the message suggests the nearest valid name.
    """
    match = BODIES.get(name.lower()) if isinstance(name, str) else None
    if match is None:
        raise (where or Where("body")).error(name, nearest(name, BODIES))
    return match


def _placed(function: Any, where: Where) -> Body:
    """Return the built-in body that a Skyfield function locates, with this as `position`."""
    match = next((body for body in BODIES.values() if function.target in body.naif), None)
    if match is None:
        problem = "its mass is not known; give Body(name=..., gm=..., position=...)"
        raise where.error(function, problem)
    return match.replace(position=function)


def label_of(name: str, bodies: Iterable[Body]) -> str | None:
    """Own name of the first of several bodies that stands for the built-in body `name`, or None."""
    return next((world.name for world in bodies if world.known_as == name), None)


def members(bodies: Iterable[Body]) -> int:
    """Number of ensemble members: product of the lengths of all named dimensions of body fields.

    Parameters
    ----------
    bodies : iterable of Body
    """
    arrays = [array for world in bodies for array in world.arrays.values()]
    return math.prod({dim: n for array in arrays for dim, n in array.sizes.items()}.values())

"""Bodies as data: named, cited, frozen; plain SI floats, or arrays with named dimensions.

The Earth is one of them and the default of a scene; nothing outside this file and the
scenes knows it by name. A body that spins needs its figure (`j2`, `dynamical_flattening`,
`radius`), its `spin_period` and its `pole`; a body that only pulls needs `gm` and `naif`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from dataclasses import replace as _replace
from typing import Any

from earthspin import constants as c
from earthspin.errors import BodyError, SceneError, nearest

#: A float, or an array with named dimensions (anything numpy can read element by element).
Numeric = Any

#: Bounds of sense: more than the mass of all that is seen, and longer than its age.
_LARGEST_GM, _LONGEST_DAY = 1e60, 1e30

#: Word for a pole of date and an ecliptic that follow the IAU 2006 models.
IAU_2006 = "iau2006"


@dataclass(frozen=True, kw_only=True, eq=False)
class Body:
    """A body that spins, pulls, or both.

    Attributes
    ----------
    name : str
        Label in results.
    gm : float
        Gravitational parameter, m3 s-2.
    naif : tuple of int
        Codes by which kernels know it, the preferred one first.
    radius : float
        Equatorial radius a, m; the one that `j2` refers to.
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
    meridian : float
        Angle at J2000.0 TDB from the x axis of the ICRF, projected on the equator, to the axis of
        least moment, rad.
    flattening : float
        (a - c) / a of the figure, the ellipticity epsilon of (I.9.38).
    spin_period : float
        One turn relative to the stars, s; negative if retrograde.
    pole : str or tuple of float
        ``"iau2006"``, or right ascension and declination of the spin axis (ICRF, J2000.0, rad).
    orbit_pole : tuple of float or None
        Right ascension and declination of the orbit's normal (ICRF, rad); not used with
        ``"iau2006"``, which brings its own ecliptic.
    orbital_period : float
        Sidereal, s.
    cycle : float
        Of a perturber: the slowest cycle of its pull that averages must span, s. For the Moon
        the turn of its node; else Jupiter's year, because Jupiter disturbs every orbit.
    slow_swing : float
        Of a perturber: how far its mean pull swings more slowly than any window, half-width of
        95 % over the pull.
    interior : str or None
        Name of what lies under the surface, a word of `earthspin.wobble.named`; None is rigid.
    observed_wobble : Constant or None
        Period of the free wobble as observed, d.
    relative_uncertainty : mapping
        One standard deviation over value, by field name.
    reference : str
        Where the numbers come from.

    Raises
    ------
    BodyError
        If a field is not finite, a mass is negative, C exceeds A + B, or j2 and H differ in sign.
    """

    name: str
    gm: Numeric
    naif: tuple[int, ...] = ()
    radius: Numeric | None = None
    j2: Numeric | None = None
    dynamical_flattening: Numeric | None = None
    triaxiality: Numeric = 0.0
    j3: Numeric = 0.0
    j4: Numeric = 0.0
    j2_rate: Numeric = 0.0
    meridian: float = 0.0
    flattening: Numeric | None = None
    spin_period: Numeric | None = None
    pole: str | tuple[float, float] | None = None
    orbit_pole: tuple[float, float] | None = None
    orbital_period: float | None = None
    cycle: float = c.JUPITER_ORBITAL_PERIOD.value
    slow_swing: float = 2e-7  # measured: `python -m data_tools windows`
    interior: str | None = None
    observed_wobble: c.Constant | None = None
    relative_uncertainty: Mapping[str, float] = field(default_factory=dict)
    reference: str = ""

    def __post_init__(self) -> None:
        for name in _NUMBERS:
            value = getattr(self, name)
            if value is None and name not in ("gm", "cycle"):
                continue
            if not isinstance(value, (int, float)) and not hasattr(value, "dims"):
                raise BodyError(
                    self.name, name, value, "give a number, or a DataArray with named dimensions"
                )
            if not all_of(_is_finite(value)):
                raise BodyError(self.name, name, value, "it must be a finite number")
        self._check_directions()
        self._require("gm", lambda gm: gm >= 0, "a mass is zero or more")
        self._require("gm", lambda gm: gm <= _LARGEST_GM, f"give at most {_LARGEST_GM:g} m3 s-2")
        self._require("cycle", lambda t: t > 0, "a cycle lasts longer than zero")
        self._require("orbital_period", lambda t: t > 0, "a year lasts longer than zero")
        for name, u in self.relative_uncertainty.items():
            if not 0 <= u < math.inf:
                raise BodyError(
                    self.name, f"relative_uncertainty[{name!r}]", u, "it is zero or more, finite"
                )
        if self.radius is not None:
            with_size = self.gm * self.radius * self.radius
            if not all_of(_is_finite(with_size) & ((with_size > 0) | (self.gm == 0))):
                raise BodyError(self.name, "radius", self.radius, "M a2 is out of a float's range")
        self._require("radius", lambda a: a > 0, "a radius is greater than zero")
        self._require("spin_period", lambda p: p != 0, "a period is not zero")
        self._require(
            "spin_period", lambda p: abs(p) <= _LONGEST_DAY, f"give at most {_LONGEST_DAY:g} s"
        )
        self._require("flattening", lambda f: f < 1, "a flattening is less than 1")
        self._require(
            "dynamical_flattening",
            lambda h: h <= 0.5,
            "C cannot exceed A + B, so H = (C - A)/C is at most 0.5 (the thin disc)",
        )
        self._require("triaxiality", lambda t: t >= 0, "(B - A)/(M a2) is zero or more")
        if self.j2 is not None and self.dynamical_flattening is not None:
            same_sign = all_of(self.j2 * self.dynamical_flattening >= 0)
            if not same_sign:
                raise BodyError(
                    self.name,
                    "j2",
                    self.j2,
                    f"it has the sign of dynamical_flattening = {self.dynamical_flattening!r}",
                )

    def _check_directions(self) -> None:
        """A pole is the known word, or a right ascension and a declination."""
        for name in ("pole", "orbit_pole"):
            value = getattr(self, name)
            if value is None or (name == "pole" and value == IAU_2006):
                continue
            allowed = (
                f"write '{IAU_2006}' or right ascension and declination, -90 to 90 deg, in rad"
            )
            if isinstance(value, str) or len(value) != 2:
                raise BodyError(self.name, name, value, allowed)
            ra, dec = value
            if not (math.isfinite(ra) and abs(dec) <= math.pi / 2):
                raise BodyError(self.name, name, value, allowed)

    def _require(self, name: str, holds: Any, allowed: str) -> None:
        value = getattr(self, name)
        if value is not None and not all_of(holds(value)):
            raise BodyError(self.name, name, value, allowed)

    # --- what follows from the fields --------------------------------------------------------

    @property
    def mass(self) -> Numeric:
        """Mass, kg; no better known than G."""
        return self.gm / c.G.value

    @property
    def spin_rate(self) -> Numeric:
        """Angular velocity, rad/s; negative if retrograde."""
        return 2 * math.pi / self.needed("spin_period")

    def relative_uncertainty_of_bulge(self) -> float:
        """One standard deviation of C - A = J2 M a2, over its value; G is the worst known."""
        u = self.relative_uncertainty
        return math.hypot(
            u.get("j2", 0.0),
            u.get("gm", 0.0),
            2 * u.get("radius", 0.0),
            c.G.relative_uncertainty,
        )

    def needed(self, name: str) -> Numeric:
        """Return a field, or say that this body lacks it.

        Raises
        ------
        BodyError
            If the field is not set.
        """
        value = getattr(self, name)
        if value is None:
            raise BodyError(self.name, name, None, f"this question needs it; set {name}")
        return value

    def replace(self, **changes: Any) -> Body:
        """Return a body with some fields changed, the rest kept consistent.

        Parameters
        ----------
        **changes
            Fields of `Body`, and besides ``mass`` (kg) for `gm`, and ``moments`` (three
            principal moments, kg m2, the polar one last) for `j2`, `dynamical_flattening`
            and `triaxiality`. `j2` given without `dynamical_flattening` keeps C / (M a2).

        Raises
        ------
        BodyError
            If the changes contradict each other or make an impossible body.
        """
        if "mass" in changes:
            if "gm" in changes:
                raise BodyError(self.name, "mass", changes["mass"], "gm already gives it; set one")
            changes["gm"] = c.G.value * changes.pop("mass")
        if "moments" in changes:
            changes |= self._figure_from_moments(changes)
        elif "j2" in changes and "dynamical_flattening" not in changes and self.j2 is not None:
            if not all_of(self.j2 != 0):
                raise BodyError(
                    self.name, "j2", changes["j2"], "set dynamical_flattening too: C is not known"
                )
            changes["dynamical_flattening"] = (
                self.needed("dynamical_flattening") * changes["j2"] / self.j2
            )
        unknown = set(changes) - {f.name for f in fields(self)}
        if unknown:
            word = sorted(unknown)[0]
            words = {f.name for f in fields(self)} | {"mass", "moments"}
            raise BodyError(self.name, word, changes[word], nearest(word, words))
        # A changed number is the user's own: what was known about the old one no longer holds.
        known = {k: v for k, v in self.relative_uncertainty.items() if k not in changes}
        return _replace(self, **({"relative_uncertainty": known} | changes))

    def _figure_from_moments(self, changes: dict[str, Any]) -> dict[str, Any]:
        moments = changes.pop("moments")
        clash = {"j2", "dynamical_flattening", "triaxiality"} & set(changes)
        if clash:
            raise BodyError(
                self.name, "moments", moments, f"moments already give {sorted(clash)[0]}; set one"
            )
        small, middle, polar = moments
        if not all_of((small > 0) & (middle > 0) & (polar > 0)):
            raise BodyError(self.name, "moments", moments, "each moment is greater than zero")
        if not all_of(abs(small - middle) <= polar):
            raise BodyError(self.name, "moments", moments, "no moment exceeds the other two's sum")
        difference = polar - (small + middle) / 2
        gm: Numeric = changes.get("gm", self.gm)
        radius: Numeric = changes["radius"] if "radius" in changes else self.needed("radius")
        scale = gm / c.G.value * radius**2
        return {
            "j2": difference / scale,
            "dynamical_flattening": difference / polar,
            "triaxiality": abs(middle - small) / scale,
        }


_NUMBERS = (
    "gm",
    "radius",
    "j2",
    "dynamical_flattening",
    "triaxiality",
    "j3",
    "j4",
    "j2_rate",
    "meridian",
    "flattening",
    "spin_period",
    "orbital_period",
    "cycle",
)

#: What a scene's body table may set, beside `from`.
BODY_KEYS = (
    "mass",
    "radius",
    "moments",
    "j2",
    "dynamical_flattening",
    "flattening",
    "triaxiality",
    "spin_period",
    "pole",
    "orbit_pole",
    "interior",
)


def _is_finite(value: Numeric) -> Numeric:
    """Elementwise: a real number that is neither infinite nor NaN."""
    return (value == value) & (abs(value) != math.inf)


def all_of(condition: Any) -> bool:
    """Truth of a bool, or of every element of an array."""
    return bool(condition.all()) if hasattr(condition, "all") else bool(condition)


EARTH = Body(
    name="earth",
    gm=c.GM_EARTH.value,
    naif=(399,),
    radius=c.EARTH_RADIUS.value,
    j2=c.EARTH_J2.value,
    dynamical_flattening=c.EARTH_H.value,
    triaxiality=c.EARTH_TRIAXIALITY.value,
    j3=c.EARTH_J3.value,
    j4=c.EARTH_J4.value,
    j2_rate=c.EARTH_J2_RATE.value,
    meridian=c.EARTH_MERIDIAN.value,
    flattening=c.EARTH_FLATTENING.value,
    spin_period=c.EARTH_SPIN_PERIOD.value,
    pole=IAU_2006,
    orbital_period=c.SIDEREAL_YEAR.value,
    interior="prem",
    observed_wobble=c.CHANDLER_PERIOD,
    relative_uncertainty={
        "gm": c.GM_EARTH.relative_uncertainty,
        "radius": c.EARTH_RADIUS.relative_uncertainty,
        "j2": c.EARTH_J2.relative_uncertainty,
        "dynamical_flattening": c.EARTH_H.relative_uncertainty,
        "flattening": c.EARTH_FLATTENING.relative_uncertainty,
    },
    reference="IERS Conventions (2010); Mathews, Herring & Buffett 2002; DE440",
)

MARS = Body(
    name="mars",
    gm=c.GM_MARS.value,
    naif=(499, 4),
    radius=c.MARS_RADIUS.value,
    j2=c.MARS_J2.value,
    dynamical_flattening=c.MARS_J2.value / c.MARS_POLAR_MOMENT.value,
    triaxiality=c.MARS_TRIAXIALITY.value,
    flattening=c.MARS_FLATTENING.value,
    spin_period=c.MARS_SPIN_PERIOD.value,
    # Archinal et al. 2011, Celest. Mech. 109, 101, at J2000.0
    pole=(math.radians(317.68143), math.radians(52.88650)),
    # from i = 1.84969142, node = 49.55953891 deg to the ecliptic (Standish & Williams)
    orbit_pole=(math.radians(273.37323), math.radians(65.32299)),
    orbital_period=c.MARS_ORBITAL_PERIOD.value,
    interior="mars-insight",
    observed_wobble=c.MARS_CHANDLER_PERIOD,
    relative_uncertainty={
        "j2": c.MARS_J2.relative_uncertainty,
        "dynamical_flattening": c.MARS_POLAR_MOMENT.relative_uncertainty,
        "flattening": c.MARS_FLATTENING.relative_uncertainty,
    },
    reference="Konopliv et al. 2011; Archinal et al. 2011, 2018; DE440",
)

SUN = Body(
    name="sun",
    gm=c.GM_SUN.value,
    naif=(10,),
    relative_uncertainty={"gm": c.GM_SUN.relative_uncertainty},
    reference=c.GM_SUN.source,
)

MOON = Body(
    name="moon",
    gm=c.GM_MOON.value,
    naif=(301,),
    cycle=c.MOON_NODE_PERIOD.value,
    relative_uncertainty={"gm": c.GM_MOON.relative_uncertainty},
    reference=c.GM_MOON.source,
)


def _planet(name: str, code: int, gm: c.Constant) -> Body:
    """A planet as a perturber: its mean pull swings through centuries by up to 1e-3 of itself."""
    return Body(
        name=name,
        gm=gm.value,
        naif=(100 * code + 99, code),
        slow_swing=1e-3,
        reference=gm.source,
    )


_PLANETS = (
    _planet("mercury", 1, c.GM_MERCURY),
    _planet("venus", 2, c.GM_VENUS),
    _planet("jupiter", 5, c.GM_JUPITER),
    _planet("saturn", 6, c.GM_SATURN),
    _planet("uranus", 7, c.GM_URANUS),
    _planet("neptune", 8, c.GM_NEPTUNE),
)

#: Every named body.
BODIES: dict[str, Body] = {b.name: b for b in (EARTH, MARS, SUN, MOON, *_PLANETS)}

#: Those that circle the Sun: what the effect ``planets`` adds to the perturbers.
PLANETS = ("mercury", "venus", "earth", "mars", "jupiter", "saturn", "uranus", "neptune")


def body(name: str, *, key: str = "body", source: str = "scene") -> Body:
    """Look a body up by name.

    Parameters
    ----------
    name : str
        One of `BODIES`, in any case.
    key, source : str
        What asked, for the message.

    Raises
    ------
    SceneError
        If the name is unknown; it names the nearest valid one.
    """
    found = BODIES.get(name.lower()) if isinstance(name, str) else None
    if found is None:
        raise SceneError(key, name, nearest(name, BODIES), source=source)
    return found

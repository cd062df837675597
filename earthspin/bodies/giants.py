"""Jupiter, Saturn, Uranus and Neptune as built-in bodies, from numbers with sources.

Numbers are those of the planets alone; their large satellites, which contribute more to the
precession than the planet's own bulge, are a field of the bodies. The polar moments of Uranus and
Neptune are not known, so a question that needs H requests it.
"""

from __future__ import annotations

import math

from earthspin import constants as c
from earthspin.bodies.body import Body
from earthspin.bodies.earth_moon_sun import IAU_2015, prime_meridian
from earthspin.bodies.inner import SWING
from earthspin.bodies.orbit import Orbit, Satellite
from earthspin.bodies.shapes import flattening_of
from earthspin.constants import ARCSEC, AU, DAY, JULIAN_YEAR, Constant, Tabulated
from earthspin.sky.poles import Direction, MovingPole

ELEMENTS = "Standish & Williams, approximate elements 1800-2050"
_JUNO = "Durante et al. 2020, Geophys. Res. Lett. 47, e2019GL086572 (Juno)"
_CASSINI = "Iess et al. 2019, Science 364, eaat2965 (Cassini)"
_URANUS = "Jacobson 2014, AJ 148:76"
_NEPTUNE = "Jacobson 2009, AJ 137, 4322"
_CODES = "codes in public repositories that cite the paper: "
POLES = Tabulated("poles of the giant planets", IAU_2015, c.PCK11)


#: Sources of masses and orbits of satellites.
JPL = "JPL Solar System Dynamics, mean elements and GM of satellites"
JPL_READ = (
    "tables of ssd.jpl.nasa.gov/?sat_elem (2020) and gm_Horizons.pck in public copies; GM of the "
    "moons of Jupiter: gm_de431.tpc in mockingbirdnest/Principia"
)
_GM = "JPL, gm_de440.tpc"
_GM_READ = "gm_de440.tpc in public repositories"
_SAT_ELEM = "ssd.jpl.nasa.gov/?sat_elem: mean elements referred to the local Laplace planes"
_ELEMENTS = ("JPL Solar System Dynamics, mean elements of satellites", _SAT_ELEM)
_FITTED = (
    "JPL Horizons, satellite ephemerides SAT441 and NEP097",
    "ellipses in Laplace planes, fitted to SAT441 and NEP097 in a public repository",
)
_OF_URANUS = (
    _ELEMENTS[0],
    "that of Umbriel in a public file of JPL Horizons; the others agree to 5e-4 with GM and the "
    f"rotation in {c.PCK11}",
)


def _moon(
    gm: float,
    a: float,
    i: float,
    elements: tuple[str, str],
    inclination: tuple[str, str] | None = None,
    u: float = 0.0,
) -> dict[str, Constant]:
    """Return a satellite's GM, a and i as constants with source; arguments in km3 s-2, km, deg."""
    return {
        "gm": Constant(gm * 1e9, "m3 s-2", u * 1e9 or None, _GM, _GM_READ),
        "a": Constant(a * 1e3, "m", None, *elements),
        "i": Constant(i, "deg", None, *(inclination or elements)),
    }


_POLES = (f"{IAU_2015}: radius of the circle of the pole of the moon", c.PCK11)
#: Large satellites by planet: GM, semi-major axis, and inclination to the Laplace plane.
SATELLITES = {
    "jupiter": {
        "Io": _moon(5959.915466, 421800.0, 0.036, _ELEMENTS),
        "Europa": _moon(3202.712100, 671100.0, 0.466, _ELEMENTS),
        "Ganymede": _moon(9887.832753, 1070400.0, 0.177, _ELEMENTS),
        "Callisto": _moon(7179.283403, 1882700.0, 0.192, _ELEMENTS),
    },
    "saturn": {
        "Tethys": _moon(41.21352885, 294673.2, 1.0913, _FITTED),
        "Dione": _moon(73.11607172, 377415.1, 0.0279, _FITTED),
        "Rhea": _moon(153.9417519, 527067.6, 0.3321, _FITTED),
        "Titan": _moon(8978.137096, 1221865.1, 0.3237, _FITTED),
        "Iapetus": _moon(120.5151060, 3560852.5, 8.279, _FITTED),
    },
    # standard deviations of GM: from newer values of JPL (4.106, 83.43, 85.40, 222.8 and 214.2),
    # but not less than that of Umbriel in JPL Horizons, 1.9, for Ariel and Umbriel
    "uranus": {
        "Miranda": _moon(4.319516899, 129900.0, 4.25, _OF_URANUS, _POLES, 0.2),
        "Ariel": _moon(83.46344432, 190900.0, 0.28, _OF_URANUS, _POLES, 1.9),
        "Umbriel": _moon(85.09338094, 266000.0, 0.20, _OF_URANUS, _POLES, 1.9),
        "Titania": _moon(226.9437004, 436300.0, 0.28, _OF_URANUS, _POLES, 4.1),
        "Oberon": _moon(205.3234303, 583500.0, 0.16, _OF_URANUS, _POLES, 8.9),
    },
    # about the total angular momentum; the orbit is opposite to the spin
    "neptune": {"Triton": _moon(1428.495463, 354797.7, 180.0 - 23.0764, _FITTED)},
}


def _satellites(planet: str) -> tuple[Satellite, ...]:
    """Return the satellites of a planet as `Satellite` objects, for the field `satellites`."""
    return tuple(
        Satellite(
            name=name,
            gm=moon["gm"].value,
            a=moon["a"].value,
            i=math.radians(moon["i"].value),
            gm_uncertainty=moon["gm"].uncertainty or 0.0,
            reference=f"{moon['gm'].source}; {moon['a'].source}",
        )
        for name, moon in SATELLITES[planet].items()
    )


_JUPITER_INSIDE = (
    "Militzer & Hubbard 2023; uncertainty: half of 0.2629 to 0.2645, Helled et al. 2011"
)
_JUPITER_INSIDE_READ = "abstracts, arXiv:2308.04986 and arXiv:1109.1627"
_SATURN_INSIDE = "Militzer & Hubbard 2023; uncertainty assumed, ten times the published one"
#: C/(M R2) of the planets alone, from interior models.
JUPITER_MOMENT = Constant(0.2639, "", 0.0008, _JUPITER_INSIDE, _JUPITER_INSIDE_READ)
SATURN_MOMENT = Constant(0.2181, "", 0.0020, _SATURN_INSIDE, "abstract, arXiv:2308.04986")
#: Published precession constants (rate divided by cos obliquity), satellites included.
JUPITER_CONSTANT = Constant(
    2.7, "arcsec yr-1", None, "Ward & Canup 2006, ApJ 640, L91", c.UNVERIFIED
)
SATURN_CONSTANT = Constant(
    0.83, "arcsec yr-1", None, "Ward & Hamilton 2004, AJ 128, 2501", c.UNVERIFIED
)


def _year(days: float) -> Constant:
    """Return a sidereal orbital period, given in days, as a `Constant` in seconds with source."""
    read_in = "ephemeris codes in public repositories"
    return Constant(days * DAY, "s", None, "mean sidereal period, rounded", read_in)


def _numbers(
    planet: str, gm: float, radius: float, j2: Constant, spin: float, orbit: Constant, w: float
) -> dict[str, Constant]:
    """Return the numerical fields of a giant planet by field name, each with its source.

    GM, that of planet and satellites, is in km3 s-2, the radius in km, the spin in deg/d, and the
    prime meridian W at J2000.0 in deg.
    """
    alone = gm * 1e9 - sum(moon["gm"].value for moon in SATELLITES[planet].values())
    source = f"{c.DE440}, less the large satellites ({_GM})"
    return {
        "gm": Constant(alone, "m3 s-2", None, source, f"{c.GM_HORIZONS}; {_GM_READ}"),
        "radius": Constant(radius * 1e3, "m", None, j2.source, j2.read_in),
        "j2": j2,
        "spin_period": Constant(360.0 / spin * DAY, "s", None, IAU_2015, c.PCK11),
        "orbital_period": orbit,
        "slow_swing": SWING,
    } | prime_meridian(w)


def _orbit(
    a: float,
    e: float,
    i: float,
    node: float,
    perihelion: float,
    mean: float,
    error: tuple[float, float, float, float, float],
) -> Orbit:
    """Make the mean elliptical orbit of a planet, from a in au and angles in degrees.

    The errors are in arcsec, arcsec per Julian year, m, m per Julian year, and a fraction of the
    mean torque.
    """
    direction, drift, distance, distance_drift, rate = error
    return Orbit(
        a=a * AU,
        e=e,
        i=math.radians(i),
        node=math.radians(node),
        pericentre=math.radians(perihelion - node),
        mean_anomaly=math.radians(mean - perihelion),
        about="sun",
        reference=ELEMENTS,
        direction_error=direction * ARCSEC,
        direction_drift=drift * ARCSEC / JULIAN_YEAR,
        distance_error=distance,
        distance_drift=distance_drift / JULIAN_YEAR,
        rate_error=rate,
    )


ELLIPSES = Tabulated("mean orbits of the giant planets", ELEMENTS, c.STANDISH_READ)
#: Bounds on what the planets of DE440, 1551 to 2646, differ from their ellipses by: angle at
#: J2000.0 (arcsec) and its growth (arcsec/yr), distance (m) and its growth (m/yr), and share of the
#: mean torque. Angles and distances: docs/coverage.md.
_DEPARTURES = {
    "jupiter": (590.0, 4.15, 6.5e8, 2.0e6, 2.2e-4),
    "saturn": (530.0, 23.2, 2.27e9, 2.07e7, 1.9e-3),
    "uranus": (920.0, 10.0, 1.47e9, 8.3e6, 4.0e-3),
    "neptune": (485.0, 4.96, 1.92e9, 5.8e6, 5.0e-4),
}
#: Mean orbits, for averages over intervals longer than kernels cover.
ORBITS = {
    name: _orbit(*elements, _DEPARTURES[name])
    for name, elements in {
        "jupiter": (5.20288700, 0.04838624, 1.30439695, 100.47390909, 14.72847983, 34.39644051),
        "saturn": (9.53667594, 0.05386179, 2.48599187, 113.66242448, 92.59887831, 49.95424423),
        "uranus": (19.18916464, 0.04725744, 0.77263783, 74.01692503, 170.95427630, 313.23810451),
        "neptune": (30.06992276, 0.00859048, 1.77004347, 131.78422574, 44.96476227, -55.12002969),
    }.items()
}


def _normal(planet: str) -> Direction:
    """Return the unit normal of the mean orbit of a planet."""
    return Direction.across(ORBITS[planet].i, ORBITS[planet].node)


_JUPITER = _numbers(
    "jupiter",
    126712764.1,
    71492.0,
    Constant(14696.57e-6, "", 1e-8, _JUNO, _CODES + "14696.5735e-6 at 71,492 km"),
    870.536,
    c.JUPITER_ORBITAL_PERIOD,
    284.95,
)
_SATURN = _numbers(
    "saturn",
    37940584.8418,
    60330.0,
    Constant(16290.57e-6, "", 3e-8, _CASSINI, _CODES + "16290.573e-6 +- 0.028e-6 at 60,330 km"),
    810.7939024,
    _year(10759.22),
    38.90,
)

JUPITER = Body.cited(
    "jupiter",
    _JUPITER | {"dynamical_flattening": flattening_of(_JUPITER["j2"], JUPITER_MOMENT)},
    naif=(599, 5),
    pole=MovingPole.published(
        (268.056595, -0.006499),
        (64.495303, 0.002413),
        [
            (0.000117, 99.360714, 4850.4046),
            (0.000938, 175.895369, 1191.9605),
            (0.001432, 300.323162, 262.5475),
            (0.000030, 114.012305, 6070.2476),
            (0.002150, 49.511251, 64.3000),
        ],
        [
            (0.000050, 99.360714, 4850.4046),
            (0.000404, 175.895369, 1191.9605),
            (0.000617, 300.323162, 262.5475),
            (-0.000013, 114.012305, 6070.2476),
            (0.000926, 49.511251, 64.3000),
        ],
    ),
    orbit_pole=_normal("jupiter"),
    satellites=_satellites("jupiter"),
    reference=f"{_JUNO}; {JUPITER_MOMENT.source}; {IAU_2015}; DE440",
)
_SATURN_POLES = (
    "poles of IAU 2015 and of Jacobson 2007, BAAS 39, 317, at J2000.0: 2.9 arcsec apart, taken as "
    "the half-width of 95 %"
)
_SATURN |= {
    "dynamical_flattening": flattening_of(_SATURN["j2"], SATURN_MOMENT),
    "pole_uncertainty": Constant(
        1.5 * ARCSEC, "rad", None, _SATURN_POLES, f"{c.PCK11}; abstract of the report"
    ),
}
SATURN = Body.cited(
    "saturn",
    _SATURN,
    naif=(699, 6),
    pole=MovingPole.published((40.589, -0.036), (83.537, -0.004)),
    orbit_pole=_normal("saturn"),
    satellites=_satellites("saturn"),
    reference=f"{_CASSINI}; {SATURN_MOMENT.source}; {IAU_2015}; DE440",
)
URANUS = Body.cited(
    "uranus",
    _numbers(
        "uranus",
        5794556.4,
        25559.0,
        Constant(3510.7e-6, "", 7e-7, _URANUS, _CODES + "3510.68e-6 at 25,559 km"),
        -501.1600928,
        _year(30688.5),
        203.81,
    ),
    naif=(799, 7),
    pole=MovingPole.published((257.311, 0.0), (-15.175, 0.0)),
    orbit_pole=_normal("uranus"),
    satellites=_satellites("uranus"),
    reference=f"{_URANUS}; {IAU_2015}; DE440",
)
NEPTUNE = Body.cited(
    "neptune",
    _numbers(
        "neptune",
        6836527.10058,
        25225.0,
        Constant(3408.4e-6, "", 5e-6, _NEPTUNE, _CODES + "3408.43e-6 +- 4.5e-6 at 25,225 km"),
        541.1397757,
        _year(60182.0),
        249.978 - 0.48 * math.sin(math.radians(357.85)),
    ),
    naif=(899, 8),
    pole=MovingPole.published(
        (299.36, 0.0), (43.46, 0.0), [(0.70, 357.85, 52.316)], [(-0.51, 357.85, 52.316)]
    ),
    orbit_pole=_normal("neptune"),
    satellites=_satellites("neptune"),
    reference=f"{_NEPTUNE}; {IAU_2015}; DE440",
)

"""Numbers of Jupiter, Saturn, Uranus and Neptune with sources, and these built-in bodies.

Jupiter and Saturn include the satellites that precess with them (`satellites`); these contribute
more than the planet's own bulge. The polar moments of Uranus and Neptune are not known, so a
question that needs H requests it. Triton, large, inclined and retrograde, is not included in
Neptune.
"""

from __future__ import annotations

import math

from earthspin.bodies.body import Body
from earthspin.bodies.inner import IAU_2015, SWING
from earthspin.bodies.orbit import Orbit
from earthspin.bodies.satellites import JPL, JPL_READ, Satellite, carried
from earthspin.constants import (
    ARCSEC,
    AU,
    DAY,
    DE440,
    GM_HORIZONS,
    JUPITER_ORBITAL_PERIOD,
    PCK11,
    STANDISH_READ,
    UNVERIFIED,
    Constant,
    Tabulated,
)  # fmt: skip
from earthspin.sky.moving_pole import MovingPole
from earthspin.sky.poles import Direction

ELEMENTS = "Standish & Williams, approximate elements 1800-2050"
_JUNO = "Durante et al. 2020, Geophys. Res. Lett. 47, e2019GL086572 (Juno)"
_CASSINI = "Iess et al. 2019, Science 364, eaat2965 (Cassini)"
_URANUS = "Jacobson 2014, AJ 148:76"
_NEPTUNE = "Jacobson 2009, AJ 137, 4322"
_CODES = "codes in public repositories that cite the paper: "
POLES = Tabulated("poles of the giant planets", IAU_2015, PCK11)


def _moon(name: str, gm: float, a: float, days: float) -> Satellite:
    """Make a `Satellite` from GM (km3 s-2), semi-major axis (km) and orbital period (d)."""
    return Satellite(
        name,
        Constant(gm * 1e9, "m3 s-2", None, JPL, JPL_READ),
        Constant(a * 1e3, "m", None, JPL, JPL_READ),
        Constant(days * DAY, "s", None, JPL, JPL_READ),
    )


OF_JUPITER = (
    _moon("Io", 5959.916, 421800.0, 1.769138),
    _moon("Europa", 3202.739, 671100.0, 3.551181),
    _moon("Ganymede", 9887.834, 1070400.0, 7.154553),
    _moon("Callisto", 7179.289, 1882700.0, 16.689017),
)
#: Satellites of Saturn inside its Laplace radius; Iapetus is outside.
OF_SATURN = (
    _moon("Tethys", 41.21, 294672.0, 1.887802),
    _moon("Dione", 73.116, 377415.0, 2.736916),
    _moon("Rhea", 153.94, 527068.0, 4.517503),
    _moon("Titan", 8978.14, 1221865.0, 15.945448),
)
#: C/(M R2) of the planets alone, from interior models.
JUPITER_MOMENT = Constant(
    0.2639,
    "",
    0.0008,
    "Militzer & Hubbard 2023; uncertainty: half of 0.2629 to 0.2645, Helled et al. 2011",
    "abstracts, arXiv:2308.04986 and arXiv:1109.1627",
)
SATURN_MOMENT = Constant(
    0.2181,
    "",
    0.0020,
    "Militzer & Hubbard 2023; uncertainty assumed, ten times theirs",
    "abstract, arXiv:2308.04986",
)
#: Published precession constants (rate divided by cos obliquity), satellites included.
JUPITER_CONSTANT = Constant(2.7, "arcsec yr-1", None, "Ward & Canup 2006, ApJ 640, L91", UNVERIFIED)
SATURN_CONSTANT = Constant(
    0.83, "arcsec yr-1", None, "Ward & Hamilton 2004, AJ 128, 2501", UNVERIFIED
)


def _year(days: float) -> Constant:
    """Return a sidereal orbital period, given in days, as a `Constant` in seconds with source."""
    return Constant(
        days * DAY,
        "s",
        None,
        "mean sidereal period, rounded",
        "ephemeris codes in public repositories",
    )


def _numbers(
    gm: float, radius: float, j2: Constant, spin: float, orbit: Constant
) -> dict[str, Constant]:
    """Return the numerical fields of a giant planet by field name, each with its source.

    GM is in km3 s-2, the radius in km and the spin in deg/d.
    """
    return {
        "gm": Constant(gm * 1e9, "m3 s-2", None, DE440 + ", with the satellites", GM_HORIZONS),
        "radius": Constant(radius * 1e3, "m", None, j2.source, j2.read_in),
        "j2": j2,
        "spin_period": Constant(360.0 / spin * DAY, "s", None, IAU_2015, PCK11),
        "orbital_period": orbit,
        "slow_swing": SWING,
    }


def _orbit(a: float, e: float, i: float, node: float, perihelion: float, mean: float) -> Orbit:
    """Make the mean elliptical orbit of a planet, from a in au and angles in degrees."""
    return Orbit(
        a=a * AU,
        e=e,
        i=math.radians(i),
        node=math.radians(node),
        pericentre=math.radians(perihelion - node),
        mean_anomaly=math.radians(mean - perihelion),
        about="sun",
        reference=ELEMENTS,
    )


ELLIPSES = Tabulated("mean orbits of the giant planets", ELEMENTS, STANDISH_READ)
#: Mean orbits, for averages over intervals longer than kernels cover.
ORBITS = {
    "jupiter": _orbit(5.20288700, 0.04838624, 1.30439695, 100.47390909, 14.72847983, 34.39644051),
    "saturn": _orbit(9.53667594, 0.05386179, 2.48599187, 113.66242448, 92.59887831, 49.95424423),
    "uranus": _orbit(19.18916464, 0.04725744, 0.77263783, 74.01692503, 170.95427630, 313.23810451),
    "neptune": _orbit(30.06992276, 0.00859048, 1.77004347, 131.78422574, 44.96476227, -55.12002969),
}


def _normal(planet: str) -> Direction:
    """Return the direction normal to a planet's mean orbit."""
    return Direction.across(ORBITS[planet].i, ORBITS[planet].node)


_JUPITER = _numbers(
    126712764.1,
    71492.0,
    Constant(14696.57e-6, "", 1e-8, _JUNO, _CODES + "14696.5735e-6 at 71,492 km"),
    870.536,
    JUPITER_ORBITAL_PERIOD,
)
_SATURN = _numbers(
    37940584.8418,
    60330.0,
    Constant(16290.57e-6, "", 3e-8, _CASSINI, _CODES + "16290.573e-6 +- 0.028e-6 at 60,330 km"),
    810.7939024,
    _year(10759.22),
)

JUPITER = Body.cited(
    "jupiter",
    _JUPITER | carried(_JUPITER, JUPITER_MOMENT, OF_JUPITER),
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
    reference=f"{_JUNO}; {JUPITER_MOMENT.source}; {IAU_2015}; DE440",
)
SATURN = Body.cited(
    "saturn",
    _SATURN
    | carried(_SATURN, SATURN_MOMENT, OF_SATURN)
    | {
        "pole_uncertainty": Constant(
            1.5 * ARCSEC,
            "rad",
            None,
            "poles of IAU 2015 and of Jacobson 2007, BAAS 39, 317, at J2000.0: 2.9 arcsec apart, "
            "taken as the half-width of 95 %",
            f"{PCK11}; abstract of the report",
        )
    },
    naif=(699, 6),
    pole=MovingPole.published((40.589, -0.036), (83.537, -0.004)),
    orbit_pole=_normal("saturn"),
    reference=f"{_CASSINI}; {SATURN_MOMENT.source}; {IAU_2015}; DE440",
)
URANUS = Body.cited(
    "uranus",
    _numbers(
        5794556.4,
        25559.0,
        Constant(3510.7e-6, "", 7e-7, _URANUS, _CODES + "3510.68e-6 at 25,559 km"),
        -501.1600928,
        _year(30688.5),
    ),
    naif=(799, 7),
    pole=MovingPole.published((257.311, 0.0), (-15.175, 0.0)),
    orbit_pole=_normal("uranus"),
    reference=f"{_URANUS}; {IAU_2015}; DE440",
)
NEPTUNE = Body.cited(
    "neptune",
    _numbers(
        6836527.10058,
        25225.0,
        Constant(3408.4e-6, "", 5e-6, _NEPTUNE, _CODES + "3408.43e-6 +- 4.5e-6 at 25,225 km"),
        541.1397757,
        _year(60182.0),
    ),
    naif=(899, 8),
    pole=MovingPole.published(
        (299.36, 0.0), (43.46, 0.0), [(0.70, 357.85, 52.316)], [(-0.51, 357.85, 52.316)]
    ),
    orbit_pole=_normal("neptune"),
    reference=f"{_NEPTUNE}; {IAU_2015}; DE440",
)

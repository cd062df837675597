"""Built-in moons in synchronous rotation, except the Moon: Phobos, Titan, Iapetus, Triton.

They occupy Cassini states. J2 and the moments of Iapetus and Triton have not been measured; a
question that needs these numbers requests them from the user.
"""

from __future__ import annotations

import math

from earthspin import constants as c
from earthspin.bodies.body import Body
from earthspin.bodies.earth_moon_sun import IAU_2015, prime_meridian
from earthspin.bodies.giants import JPL, JPL_READ, SATELLITES
from earthspin.bodies.orbit import Orbit
from earthspin.bodies.shapes import flattening_of
from earthspin.constants import DAY, DAYS_PER_CENTURY, JULIAN_YEAR, Constant, Tabulated
from earthspin.mass.figure import homogeneous_ellipsoid
from earthspin.sky.poles import MovingPole

_IESS = "Iess et al. 2012, Science 337, 457 (Cassini)"
#: For the moment of inertia of Titan the relation of Radau and Darwin gives J2 = 33.29e-6 and
#: C22 = 9.99e-6. The measured values differ by 0.9 and 1.4 per cent, and have an uncertainty of 2.
_HYDROSTATIC = f"{_IESS}; uncertainty: difference from hydrostatic equilibrium"
_HYDROSTATIC_READ = (
    "abstract of Iess et al. 2010, Science 327, 1367, hydrostatic equilibrium; its moment of "
    "inertia gives these values within 1.4 per cent, the further digits were not seen"
)
#: Semi-axes of Phobos, km.
_PHOBOS = (13.0, 11.4, 9.1)
_AXES = f"homogeneous ellipsoid of {' x '.join(map(str, _PHOBOS))} km, {IAU_2015}"
_IAU_2011 = "Archinal et al. 2011, Celest. Mech. 109, 101 (IAU 2009)"
POLES = Tabulated("poles of Phobos, Titan and Iapetus", _IAU_2011, c.PCK11)
_TITAN = SATELLITES["saturn"]["Titan"]

_TITAN_J2 = Constant(33.599e-6, "", 0.67e-6, _HYDROSTATIC, _HYDROSTATIC_READ)
_BALAND = "Baland et al. 2011, A&A 530, A141"
_BALAND_READ = "quoted in Baland et al. 2011, aanda.org/articles/aa/full_html/2011/06/aa16578-11"
_MERIGGIOLA = "Meriggiola et al. 2016, Icarus 275, 183"
_MERIGGIOLA_READ = "abstract, doi.org/10.1016/j.icarus.2016.01.019"
#: C/(M R2) of Titan in hydrostatic equilibrium.
TITAN_MOMENT = Constant(0.3414, "", 0.0005, "Iess et al. 2010, Science 327, 1367", _BALAND_READ)
#: Observed obliquity of Titan to its orbit, and the prediction for a solid body.
TITAN_OBLIQUITY = Constant(0.31, "deg", None, _MERIGGIOLA, _MERIGGIOLA_READ)
TITAN_OBLIQUITY_IF_SOLID = Constant(0.113, "deg", None, _BALAND, c.UNVERIFIED)


def _days(days: float, source: str, read_in: str) -> Constant:
    """Convert a sidereal period from days to a `Constant` in seconds, with source."""
    return Constant(days * DAY, "s", None, source, read_in)


_TITAN_PERIOD = _days(15.945448, JPL, JPL_READ)


def _locked(
    gm: Constant, radius: float, period: Constant, source: str, read_in: str
) -> dict[str, Constant]:
    """Numerical fields of a moon in synchronous rotation, from GM, radius (km) and period."""
    return {
        "gm": gm,
        "radius": Constant(radius * 1e3, "m", None, source, read_in),
        "spin_period": period,
        "orbital_period": period,
    }


def _of_phobos() -> dict[str, Constant]:
    j2, h, triaxiality = homogeneous_ellipsoid(*_PHOBOS)
    figure = {"j2": j2, "dynamical_flattening": h, "triaxiality": triaxiality}
    return {name: Constant(value, "", None, _AXES, c.PCK11) for name, value in figure.items()}


#: Phase at J2000.0 (deg) and rate (deg a century) of M1, the node of Phobos.
_M1 = (169.51, -0.4357640 * DAYS_PER_CENTURY)

#: The half-widths of angle and rate contain the terms of W that are not in its mean rate: two
#: librations of 1.1 and 1.4 deg, and 12.7 deg per square century.
_PHOBOS_SPIN = {
    "spin_period": Constant(360 / 1128.84475928 * DAY, "s", 0.0025, IAU_2015, c.PCK11)
} | prime_meridian(35.18774440, (1.42421769, 190.72646643), (-1.143, 189.63271560), half_width=3.0)

PHOBOS = Body.cited(
    "phobos",
    _locked(
        Constant(7.087e5, "m3 s-2", None, JPL, JPL_READ),
        _PHOBOS[0],
        _days(0.31891023, JPL, "asa.hmnao.com, satellite orbital data of 2012"),
        _AXES,
        c.PCK11,
    )
    | _of_phobos()
    | _PHOBOS_SPIN,
    naif=(401,),
    pole=MovingPole.published((317.68, -0.108), (52.90, -0.061), [(1.79, *_M1)], [(-1.08, *_M1)]),
    reference=f"{JPL}; {_AXES}; pole: {_IAU_2011}",
)
TITAN = Body.cited(
    "titan",
    _locked(
        _TITAN["gm"],
        2575.0,
        _TITAN_PERIOD,
        "reference radius of " + _IESS,
        "2575.15, 2574.78 and 2574.47 km in pck00010.tpc, public copies",
    )
    | {
        "j2": _TITAN_J2,
        "dynamical_flattening": flattening_of(_TITAN_J2, TITAN_MOMENT),
        # (B - A)/(M a2) = 4 C22
        "triaxiality": Constant(4 * 10.121e-6, "", 4 * 0.20e-6, _HYDROSTATIC, _HYDROSTATIC_READ),
    }
    | prime_meridian(186.5855),
    naif=(606,),
    pole=MovingPole.published((39.4827, 0.0), (83.4279, 0.0)),
    reference=f"{JPL}; {_IESS}; {TITAN_MOMENT.source}; pole: {_IAU_2011}",
)
IAPETUS = Body.cited(
    "iapetus",
    _locked(
        SATELLITES["saturn"]["Iapetus"]["gm"],
        734.5,
        _days(360 / 4.5379572, IAU_2015, c.PCK11),
        JPL,
        "codes in public repositories",
    )
    | prime_meridian(355.2),
    naif=(608,),
    pole=MovingPole.published((318.16, -3.949), (75.03, -1.143)),
    reference=f"{JPL}; pole: {_IAU_2011}",
)
#: Amplitudes of multiples of N7 in W of Triton, deg.
_TRITON_TERMS = (22.25, 6.73, 2.05, 0.74, 0.28, 0.11, 0.05, 0.02, 0.01)

TRITON = Body.cited(
    "triton",
    _locked(
        SATELLITES["neptune"]["Triton"]["gm"],
        1352.6,
        _days(5.876854, IAU_2015, c.PCK11),
        IAU_2015,
        c.PCK11,
    )
    | prime_meridian(296.53, *((size, 177.85 * (n + 1)) for n, size in enumerate(_TRITON_TERMS))),
    naif=(801,),
    reference=JPL,
)

ELLIPSES = Tabulated("orbits of Phobos, Iapetus and Triton", JPL, JPL_READ)
TITAN_ELLIPSE = Tabulated(
    "orbit of Titan",
    "Vienne & Duriez 1995, A&A 297, 588 (TASS 1.6)",
    "files S06_03.dat and S06_04.dat of TASS 1.7, largest terms: DavidHarper/java-tass17",
)
#: Orbits referred to their Laplace planes; longitudes are not needed.
ORBITS = {
    PHOBOS.name: Orbit(
        period=PHOBOS.number("orbital_period"),
        e=0.0151,
        # amplitude and rate of the main term of its pole
        i=math.radians(1.08),
        node_period=360.0 / _M1[1] * DAYS_PER_CENTURY * DAY,
        about="mars",
        reference=f"{JPL}; {_IAU_2011}",
    ),
    TITAN.name: Orbit(
        period=_TITAN_PERIOD.value,
        e=0.0289,
        i=math.radians(0.3197),
        node_period=-703.51 * JULIAN_YEAR,
        about="saturn",
        reference=TITAN_ELLIPSE.source,
    ),
    IAPETUS.name: Orbit(
        period=IAPETUS.number("orbital_period"),
        e=0.0293,
        i=math.radians(8.298),
        node_period=-3438.73 * JULIAN_YEAR,
        about="saturn",
        reference=JPL,
    ),
    # retrograde orbit: angles are measured about its own orbit normal
    TRITON.name: Orbit(
        period=TRITON.number("orbital_period"),
        i=math.radians(180.0 - 156.865),
        node_period=-687.446 * JULIAN_YEAR,
        about="neptune",
        reference=JPL,
    ),
}

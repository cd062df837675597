"""Mercury, Venus and Mars as built-in bodies, from numbers with sources."""

from __future__ import annotations

import math

from earthspin import constants as c
from earthspin.bodies.body import Body
from earthspin.bodies.earth_moon_sun import IAU_2015, prime_meridian
from earthspin.bodies.orbit import Orbit
from earthspin.bodies.shapes import flattening_of
from earthspin.constants import ARCSEC, DAY, JULIAN_YEAR, Constant, Tabulated
from earthspin.sky.poles import Direction, FixedPole, MovingPole

# --- Mercury and Venus ----------------------------------------------------------------------------

ELEMENTS = "Standish & Williams, approximate elements, sidereal"
POLES = Tabulated("poles of Mercury and Venus", IAU_2015, c.PCK11)
PLANES = Tabulated("planes of the orbits of Mercury and Venus", ELEMENTS, c.STANDISH_READ)
#: Relative variation, over centuries, of the mean torque that a planet exerts on other bodies.
SWING = Constant(1e-3, "", None, "a bound for planets: not measured", c.ASSUMED)

_MARGOT_2012 = "Margot et al. 2012, JGR 117, E00L09"
_MARGOT_2012_READ = "abstract, doi.org/10.1029/2012JE004161"
_MARGOT_2021 = "Margot et al. 2021, Nature Astronomy 5, 676"
_MARGOT_2021_READ = "abstract, arXiv:2103.01504"
_VENUS_SPIN = (
    f"{_MARGOT_2021}: mean of 15 years, within 0.0013 d; uncertainty: the observed days differ by "
    "61 ppm, half of which is taken as the half-width of 95 %"
)
_VERMA = "Verma & Margot 2016, JGR Planets (arXiv:1608.01360)"
_VERMA_READ = "abstract, arXiv:1608.01360"
_GRAVITY_READ = "mockingbirdnest/Principia, astronomy/sol_gravity_model.proto.txt"
_STARK = (
    "obliquity of 2.029 +- 0.085 arcmin: Stark et al. 2015, Geophys. Res. Lett., First MESSENGER "
    "orbital observations of Mercury's librations"
)
_VENUS_YEAR_READ = "ephemeris codes in public repositories: 224.7008001 d"

# J2 = -sqrt(5) C20 and C22 = sqrt(5/12) times the normalised coefficient
_NORM_22 = math.sqrt(5 / 12)
_MERCURY_J2 = Constant(
    2.25100e-5 * math.sqrt(5.0), "", 1.3e-9 * math.sqrt(5.0), _VERMA, _VERMA_READ
)
#: C/(M R2).
MERCURY_MOMENT = Constant(0.346, "", 0.014, _MARGOT_2012, _MARGOT_2012_READ)
_MERCURY_YEAR = Constant(87.96926 * DAY, "s", None, ELEMENTS, c.STANDISH_READ)
_VENUS_J2 = Constant(
    4.404e-6, "", None, "Konopliv et al. 1999, Icarus 139, 3 (MGNP180U), rounded", _GRAVITY_READ
)
VENUS_MOMENT = Constant(0.337, "", 0.024, _MARGOT_2021, _MARGOT_2021_READ)
#: Observed precession rate of the spin axis in the plane of the orbit.
VENUS_PRECESSION = Constant(44.58, "arcsec yr-1", 3.3, _MARGOT_2021, _MARGOT_2021_READ)
#: Amplitudes of the libration in longitude, deg, of multiples of the mean anomaly.
_MERCURY_LIBRATION = (0.01067257, -0.00112309, -0.00011040, -0.00002539, -0.00000571)

MERCURY = Body.cited(
    "mercury",
    {
        "gm": Constant(22031.868551e9, "m3 s-2", None, c.DE440, c.GM_HORIZONS),
        "radius": Constant(2440e3, "m", None, "reference radius of " + _VERMA, _GRAVITY_READ),
        "j2": _MERCURY_J2,
        "dynamical_flattening": flattening_of(_MERCURY_J2, MERCURY_MOMENT),
        # (B - A)/(M a2) = 4 C22
        "triaxiality": Constant(
            4 * 1.24973e-5 * _NORM_22, "", 4 * 1.2e-9 * _NORM_22, _VERMA, _VERMA_READ
        ),
        # 3:2 spin-orbit resonance
        "spin_period": Constant(360 / 6.1385108 * DAY, "s", None, IAU_2015, c.PCK11),
        "orbital_period": _MERCURY_YEAR,
        "slow_swing": SWING,
        "pole_uncertainty": Constant(
            0.085 * 60 * ARCSEC, "rad", None, _STARK, "abstract of the paper"
        ),
    }
    # A bound: the motion starts without the libration in longitude, and in 20 years stays within
    # -0.31 to +0.56 deg of W.
    | prime_meridian(
        329.5988,
        *((size, 174.7910857 * (n + 1)) for n, size in enumerate(_MERCURY_LIBRATION)),
        half_width=0.6,
    ),
    naif=(199, 1),
    pole=MovingPole.published((281.0103, -0.0328), (61.4155, -0.0049)),
    orbit_pole=Direction.across(math.radians(7.00497902), math.radians(48.33076593)),
    reference=f"{_MARGOT_2012}; {_VERMA}; {IAU_2015}; DE440",
)

#: Mercury's orbit referred to its Laplace plane; longitudes are not needed.
MERCURY_ORBIT = Orbit(
    period=_MERCURY_YEAR.value,
    e=0.2056,
    i=math.radians(8.6),
    node_period=-328e3 * JULIAN_YEAR,
    about="sun",
    reference="Yseboodt & Margot 2006, Icarus 181, 327",
)
#: Observed obliquity of Mercury to its orbit.
MERCURY_OBLIQUITY = Constant(2.04, "arcmin", 0.08, _MARGOT_2012, _MARGOT_2012_READ)
MERCURY_PLANE = Tabulated(
    "plane on which the orbit of Mercury precesses",
    MERCURY_ORBIT.reference,
    "follows but for the share of either number: sin(i) times the rate of the node, to 0.1 per "
    f"cent, from the rates of {c.STANDISH_READ}",
)

VENUS = Body.cited(
    "venus",
    {
        "gm": Constant(324858.592e9, "m3 s-2", None, c.DE440, c.GM_HORIZONS),
        "radius": Constant(
            6051e3, "m", None, "reference radius of Konopliv et al. 1999", _GRAVITY_READ
        ),
        "j2": _VENUS_J2,
        "dynamical_flattening": flattening_of(_VENUS_J2, VENUS_MOMENT),
        "spin_period": Constant(-243.0226 * DAY, "s", 0.0035 * DAY, _VENUS_SPIN, _MARGOT_2021_READ),
        "orbital_period": Constant(
            224.70079922 * DAY, "s", None, "mean sidereal period", _VENUS_YEAR_READ
        ),
        "slow_swing": SWING,
    }
    | prime_meridian(160.20),
    naif=(299, 2),
    # Archinal et al. 2011, Celest. Mech. 109, 101: no rates are given
    pole=FixedPole(math.radians(272.76), math.radians(67.16)),
    orbit_pole=Direction.across(math.radians(3.39467605), math.radians(76.67984255)),
    reference=f"{_MARGOT_2021}; Konopliv et al. 1999; Archinal et al. 2011; DE440",
)


# --- Mars -----------------------------------------------------------------------------------------

# Normalised coefficients of degree and order 2.
_C22, _S22 = -8.463591e-5, 4.893449e-5

_KONOPLIV_2016 = "Konopliv et al. 2016, Icarus 274, 253"
_KONOPLIV_2016_READ = "abstract, doi.org/10.1016/j.icarus.2016.02.052"
_MARS_POLES = (
    "poles of IAU 2009 and IAU 2015 at J2000.0: 0.89 arcsec apart without nutation, taken as the "
    "half-width of 95 %"
)
_MARS_ORDER_2 = c.MARS_GRAVITY + ", degree 2, order 2"
_IAU_2009 = "Archinal et al. 2011, Celest. Mech. 109, 101"
_MARS_AXES = "Archinal et al. 2018, Celest. Mech. 130:22, table 4"
_MARS_YEAR_READ = "ephemeris codes in public repositories: 686.9798519 d"
_MARS_WOBBLE = "Konopliv et al. 2020, Geophys. Res. Lett. 47, e2020GL090568; half of the last digit"
#: Rate of precession of the spin axis, geodesic precession included.
MARS_PRECESSION = Constant(-7.6083, "arcsec yr-1", 0.0021, _KONOPLIV_2016, _KONOPLIV_2016_READ)

MARS_POLE = Tabulated(
    "pole of Mars",
    "Kuchynka et al. 2014, Icarus 229, 340; Archinal et al. 2018, Celest. Mech. 130:22 (IAU 2015)",
    c.PCK11,
)
MARS_PLANE = Tabulated(
    "plane of the orbit of Mars", "Standish & Williams, approximate elements", c.STANDISH_READ
)

MARS_NUMBERS = {
    "pole_uncertainty": Constant(0.46 * ARCSEC, "rad", None, _MARS_POLES, c.PCK11),
    "gm": c.MARS_GM,
    "radius": c.MARS_RADIUS,
    "j2": c.MARS_J2,
    "dynamical_flattening": flattening_of(c.MARS_J2, c.MARS_POLAR_MOMENT),
    # (B - A)/(M a2) = 4 sqrt(5/12) |C22 + i S22|
    "triaxiality": Constant(
        4 * _NORM_22 * math.hypot(_C22, _S22), "", None, _MARS_ORDER_2, c.MARS_J2.read_in
    ),
    "flattening": Constant((3396.19 - 3376.20) / 3396.19, "", 4e-5, _MARS_AXES, c.PCK11),
    "spin_period": Constant(360.0 / 350.89198226 * DAY, "s", None, _IAU_2009, c.PCK11),
    "orbital_period": Constant(686.9798 * DAY, "s", None, "mean sidereal period", _MARS_YEAR_READ),
    "long_axis": Constant(
        math.atan2(_S22, _C22) / 2, "rad", None, _MARS_ORDER_2, c.MARS_J2.read_in
    ),
} | prime_meridian(
    176.049863,
    (0.000145, 129.071773),
    (0.000157, 36.352167),
    (0.000040, 56.668646),
    (0.000001, 67.364003),
    (0.000001, 104.792680),
    (0.584542, 95.391654),
    # the angles of IAU 2009 and IAU 2015 differ by this at J2000.0, and by half of it in their
    # rates until 2050
    half_width=0.005,
)

MARS = Body.cited(
    "mars",
    MARS_NUMBERS,
    naif=(499, 4),
    pole=MovingPole.published(  # Kuchynka et al. 2014, Icarus 229, 340, which is IAU 2015
        (317.269202, -0.10927547),
        (54.432516, -0.05827105),
        [
            (0.000068, 198.991226, 19139.4819985),
            (0.000238, 226.292679, 38280.8511281),
            (0.000052, 249.663391, 57420.7251593),
            (0.000009, 266.183510, 76560.6367950),
            (0.419057, 79.398797, 0.5042615),
        ],
        [
            (0.000051, 122.433576, 19139.9407476),
            (0.000141, 43.058401, 38280.8753272),
            (0.000031, 57.663379, 57420.7517205),
            (0.000005, 79.476401, 76560.6495004),
            (1.591274, 166.325722, 0.5042615),
        ],
    ),
    # Standish & Williams, approximate elements
    orbit_pole=Direction.across(math.radians(1.84969142), math.radians(49.55953891)),
    interior="mars-insight",
    observed_wobble=Constant(
        207.0, "d", 0.5, _MARS_WOBBLE, "about 207 d in press reports of the paper"
    ),
    reference="Konopliv et al. 2011; Archinal et al. 2011, 2018; DE440",
)

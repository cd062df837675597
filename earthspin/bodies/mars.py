"""Numbers of Mars with sources and uncertainties, and the built-in body made of them."""

from __future__ import annotations

import math

from earthspin.bodies.body import Body
from earthspin.bodies.figure import flattening_of
from earthspin.constants import (
    ARCSEC,
    DAY,
    MARS_GM,
    MARS_GRAVITY,
    MARS_J2,
    MARS_POLAR_MOMENT,
    MARS_RADIUS,
    PCK11,
    STANDISH_READ,
    Constant,
    Tabulated,
)
from earthspin.sky.moving_pole import MovingPole
from earthspin.sky.poles import Direction

# Normalised coefficients of degree and order 2.
_C22, _S22 = -8.463591e-5, 4.893449e-5

#: Rate of precession of the spin axis, geodesic precession included.
PRECESSION = Constant(
    -7.6083,
    "arcsec yr-1",
    0.0021,
    "Konopliv et al. 2016, Icarus 274, 253",
    "abstract, doi.org/10.1016/j.icarus.2016.02.052",
)

POLE = Tabulated(
    "pole of Mars",
    "Kuchynka et al. 2014, Icarus 229, 340; Archinal et al. 2018, Celest. Mech. 130:22 (IAU 2015)",
    PCK11,
)
ORBIT = Tabulated(
    "plane of the orbit of Mars", "Standish & Williams, approximate elements", STANDISH_READ
)

NUMBERS = {
    "pole_uncertainty": Constant(
        0.46 * ARCSEC,
        "rad",
        None,
        "poles of IAU 2009 and IAU 2015 at J2000.0: 0.89 arcsec apart without nutation, taken as "
        "the half-width of 95 %",
        PCK11,
    ),
    "gm": MARS_GM,
    "radius": MARS_RADIUS,
    "j2": MARS_J2,
    "dynamical_flattening": flattening_of(MARS_J2, MARS_POLAR_MOMENT),
    # (B - A)/(M a2) = 4 sqrt(5/12) |C22 + i S22|
    "triaxiality": Constant(
        4 * math.sqrt(5 / 12) * math.hypot(_C22, _S22),
        "",
        None,
        MARS_GRAVITY + ", degree 2, order 2",
        MARS_J2.read_in,
    ),
    "flattening": Constant(
        (3396.19 - 3376.20) / 3396.19,
        "",
        4e-5,
        "Archinal et al. 2018, Celest. Mech. 130:22, table 4",
        PCK11,
    ),
    "spin_period": Constant(
        360.0 / 350.89198226 * DAY, "s", None, "Archinal et al. 2011, Celest. Mech. 109, 101", PCK11
    ),
    "orbital_period": Constant(
        686.9798 * DAY,
        "s",
        None,
        "mean sidereal period",
        "ephemeris codes in public repositories: 686.9798519 d",
    ),
}

MARS = Body.cited(
    "mars",
    NUMBERS,
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
        207.0,
        "d",
        0.5,
        "Konopliv et al. 2020, Geophys. Res. Lett. 47, e2020GL090568; half of the last digit",
        "about 207 d in press reports of the paper",
    ),
    reference="Konopliv et al. 2011; Archinal et al. 2011, 2018; DE440",
)

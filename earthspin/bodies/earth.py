"""Numbers of the Earth with sources and uncertainties, and the built-in body made of them."""

from __future__ import annotations

import math

from earthspin.bodies.body import Body
from earthspin.constants import (
    ARCSEC,
    DAY,
    DAYS_PER_CENTURY,
    DE440,
    EPSILON_0,
    GM_HORIZONS,
    IERS_2010,
    IERS_TABLE_READ,
    P03,
    SHTOOLS,
    SIDEREAL_YEAR,
    Constant,
)
from earthspin.sky.poles import IAU_2006

_EGM2008 = "Pavlis et al. 2012, JGR 117, B04406 (EGM2008)"
_EGM2008_READ = "coefficient files of EGM2008 in public repositories"
_ROTATION_ANGLE = "Capitaine, Guinot & McCarthy 2000, A&A 355, 398, eq. 14"

# Normalised coefficients of EGM2008, of degree and order 2.
_C22, _S22 = 2.43938357e-6, -1.40027370e-6
#: Earth Rotation Angle, turns: rate per day of UT1, and value at J2000.0 UT1.
_TURNS_A_DAY, _TURNS_AT_START = 1.00273781191135448, 0.7790572732640

NUMBERS = {
    "gm": Constant(
        398600.435507e9, "m3 s-2", 8e5, DE440 + "; uncertainty from " + IERS_2010, GM_HORIZONS
    ),
    "radius": Constant(
        6378136.6, "m", 0.1, IERS_2010 + " (equatorial, zero-tide)", IERS_TABLE_READ
    ),
    "j2": Constant(1.0826359e-3, "", 1e-10, IERS_2010 + " (zero-tide)", IERS_TABLE_READ),
    "dynamical_flattening": Constant(
        0.0032737949,
        "",
        1e-9,
        "Mathews, Herring & Buffett 2002, JGR 107(B4), 2068; uncertainty from " + IERS_2010,
        f"{IERS_TABLE_READ}; uncertainty: {SHTOOLS}Earth.py",
    ),
    # (B - A)/(M a2) = 4 sqrt(5/12) |C22 + i S22|
    "triaxiality": Constant(7.2624e-6, "", None, _EGM2008 + ", degree 2, order 2", _EGM2008_READ),
    # J_n = -sqrt(2n + 1) C_n0 of the normalised coefficients
    "j3": Constant(-9.57161207e-7 * math.sqrt(7.0), "", None, _EGM2008, _EGM2008_READ),
    "j4": Constant(-5.39965866e-7 * 3.0, "", None, _EGM2008, _EGM2008_READ),
    "j2_rate": Constant(
        -3.001e-9 / (DAYS_PER_CENTURY * DAY),
        "s-1",
        None,
        P03 + ": -3.001e-9 a century, sect. 4.1",
        "public code that cites IAU 2006 for it",
    ),
    # Angle of the axis of least moment at J2000.0 TDB from the x axis of the GCRS: the Earth
    # Rotation Angle at UT1 = TDB - 63.83 s, and the longitude atan2(S22, C22)/2 = -14.93 deg.
    "meridian": Constant(
        2 * math.pi * (_TURNS_AT_START - _TURNS_A_DAY * 63.83 / DAY) + math.atan2(_S22, _C22) / 2,
        "rad",
        1e-4,
        f"{_ROTATION_ANGLE}; {_EGM2008}",
        f"ERFA, eraEra00; {_EGM2008_READ}",
    ),
    "pole_uncertainty": Constant(
        (EPSILON_0.uncertainty or 0.0) * ARCSEC, "rad", None, EPSILON_0.source, EPSILON_0.read_in
    ),
    "flattening": Constant(1 / 298.25642, "", 1.1e-10, IERS_2010 + " (zero-tide)", IERS_TABLE_READ),
    "spin_period": Constant(
        DAY / _TURNS_A_DAY,
        "s",
        0.0,
        _ROTATION_ANGLE + " (IAU 2000 Resolution B1.8)",
        "ERFA, eraEra00",
    ),
    "orbital_period": SIDEREAL_YEAR,
}

EARTH = Body.cited(
    "earth",
    NUMBERS,
    naif=(399,),
    pole=IAU_2006,
    interior="prem",
    observed_wobble=Constant(
        430.9,
        "d",
        0.7,
        "Nastula & Gross 2015, JGR Solid Earth 120, 6474",
        "value and uncertainty as quoted in a text on the wobble in a public repository",
    ),
    reference="IERS Conventions (2010); Mathews, Herring & Buffett 2002; DE440",
)

"""Earth, Moon and Sun as built-in bodies, from numbers with sources and uncertainties."""

from __future__ import annotations

import math
from dataclasses import fields

import numpy as np

from earthspin import constants as c
from earthspin.bodies.body import Body
from earthspin.bodies.librations import mean_earth_matrix
from earthspin.constants import ARCSEC, DAY, DAYS_PER_CENTURY, EPSILON_0, Constant, Tabulated
from earthspin.numerics.arrays import FloatArray
from earthspin.sky.poles import IAU_2006, Direction, MovingPole

# --- prime meridians ------------------------------------------------------------------------------
# Angle W of the IAU at J2000.0 TDB, with the periodic terms at that date. Its rate is that of the
# spin period.

IAU_2015 = "Archinal et al. 2018, Celest. Mech. 130:22 (IAU 2015)"


def prime_meridian(
    w: float, *terms: tuple[float, float], half_width: float | None = None, source: str = IAU_2015
) -> dict[str, Constant]:
    """Fields of a body for its prime meridian at J2000.0 TDB, from published angles in degrees.

    Parameters
    ----------
    w : float
        Constant part of W.
    *terms : tuple of float
        Amplitude and phase at J2000.0 of each sine term.
    half_width : float or None
        95 % half-width of the angle, also as the start of a motion.
    source : str
        Publication of W.
    """
    angle = w + sum(size * math.sin(math.radians(phase)) for size, phase in terms)
    numbers = {"prime_meridian": Constant(math.radians(angle), "rad", None, source, c.PCK11)}
    if half_width is not None:
        numbers["prime_meridian_uncertainty"] = Constant(
            math.radians(half_width) / c.NORMAL_95, "rad", None, source, c.PCK11
        )
    return numbers


# --- Earth ----------------------------------------------------------------------------------------

_EGM2008 = "Pavlis et al. 2012, JGR 117, B04406 (EGM2008)"
_EGM2008_READ = "coefficient files of EGM2008 in public repositories"
_ROTATION_ANGLE = "Capitaine, Guinot & McCarthy 2000, A&A 355, 398, eq. 14"
_GM = c.DE440 + "; uncertainty from " + c.IERS_2010
_MHB = "Mathews, Herring & Buffett 2002, JGR 107(B4), 2068; uncertainty from " + c.IERS_2010
_MHB_READ = f"{c.IERS_TABLE_READ}; uncertainty: {c.SHTOOLS}Earth.py"
_REBOUND = c.P03 + ": -3.001e-9 a century, sect. 4.1"
_REBOUND_READ = "public code that cites IAU 2006 for it"
_ZERO_TIDE = c.IERS_2010 + " (zero-tide)"
_DAY_OF_IAU = _ROTATION_ANGLE + " (IAU 2000 Resolution B1.8)"
_WOBBLE = "Nastula & Gross 2015, JGR Solid Earth 120, 6474"
_WOBBLE_READ = "value and uncertainty as quoted in a text on the wobble in a public repository"

# Normalised coefficients of EGM2008, of degree and order 2.
_C22, _S22 = 2.43938357e-6, -1.40027370e-6
#: Earth Rotation Angle, turns: rate per day of UT1, and value at J2000.0 UT1.
_TURNS_A_DAY, _TURNS_AT_START = 1.00273781191135448, 0.7790572732640
#: Angle of the prime meridian at J2000.0 TDB from the x axis of the GCRS, projected on the equator:
#: the Earth Rotation Angle at UT1 = TDB - 63.83 s.
EARTH_ANGLE = Constant(
    2 * math.pi * (_TURNS_AT_START - _TURNS_A_DAY * 63.83 / DAY),
    "rad",
    None,
    _ROTATION_ANGLE,
    "ERFA, eraEra00",
)

EARTH_NUMBERS = {
    "gm": Constant(398600.435507e9, "m3 s-2", 8e5, _GM, c.GM_HORIZONS),
    "radius": Constant(
        6378136.6, "m", 0.1, c.IERS_2010 + " (equatorial, zero-tide)", c.IERS_TABLE_READ
    ),
    "j2": Constant(1.0826359e-3, "", 1e-10, _ZERO_TIDE, c.IERS_TABLE_READ),
    "dynamical_flattening": Constant(0.0032737949, "", 1e-9, _MHB, _MHB_READ),
    # (B - A)/(M a2) = 4 sqrt(5/12) |C22 + i S22|
    "triaxiality": Constant(7.2624e-6, "", None, _EGM2008 + ", degree 2, order 2", _EGM2008_READ),
    # J_n = -sqrt(2n + 1) C_n0 of the normalised coefficients
    "j3": Constant(-9.57161207e-7 * math.sqrt(7.0), "", None, _EGM2008, _EGM2008_READ),
    "j4": Constant(-5.39965866e-7 * 3.0, "", None, _EGM2008, _EGM2008_READ),
    "j2_rate": Constant(-3.001e-9 / (DAYS_PER_CENTURY * DAY), "s-1", None, _REBOUND, _REBOUND_READ),
    "long_axis": Constant(
        math.atan2(_S22, _C22) / 2, "rad", None, f"{_EGM2008}, degree 2, order 2", _EGM2008_READ
    ),
    "pole_uncertainty": Constant(
        (EPSILON_0.uncertainty or 0.0) * ARCSEC, "rad", None, EPSILON_0.source, EPSILON_0.read_in
    ),
    "flattening": Constant(1 / 298.25642, "", 1.1e-10, _ZERO_TIDE, c.IERS_TABLE_READ),
    "spin_period": Constant(DAY / _TURNS_A_DAY, "s", 0.0, _DAY_OF_IAU, "ERFA, eraEra00"),
    "orbital_period": c.SIDEREAL_YEAR,
}

EARTH = Body.cited(
    "earth",
    EARTH_NUMBERS,
    naif=(399,),
    pole=IAU_2006,
    interior="prem",
    observed_wobble=Constant(430.9, "d", 0.7, _WOBBLE, _WOBBLE_READ),
    reference="IERS Conventions (2010); Mathews, Herring & Buffett 2002; DE440",
)


# --- Moon -----------------------------------------------------------------------------------------

_GRAIL = "Williams et al. 2014, JGR Planets 119, 1546 (GRAIL and laser ranging)"
_GRAIL_READ = c.SHTOOLS + "Moon.py"
_MOON_GM = c.DE440 + "; uncertainty: the difference from DE421's 4902.800076"
_NODE = "Simon et al. 1994, A&A 282, 663, sect. 3.5: rate of the mean longitude of the node"
#: Gravity field of DE430, by degree and order.
_DE430_READ = "mockingbirdnest/Principia, astronomy/sol_gravity_model.proto.txt"

_CASSINI = "1.543 to the ecliptic (arXiv:2201.00803) and 5.145 of the orbit"
_CASSINI_READ = "arXiv:2201.00803; page of the Moon of JPL Horizons"
#: Observed obliquity of the Moon to its orbit.
MOON_OBLIQUITY = Constant(6.688, "deg", None, _CASSINI, _CASSINI_READ)
_DE421 = "header of DE421: Folkner, Williams & Boggs 2009, IPN Progress Report 42-178"
_DE421_READ = "constants.npy of the package de421 2008.1 on PyPI"
_DE421_AND_GRAIL = f"{_DE421}; uncertainty: difference from {_GRAIL}, {_GRAIL_READ}"


def _de421(value: float, unit: str = "", uncertainty: float | None = None) -> Constant:
    """Number of the model of the Moon in DE421, one set with the states of `librations`."""
    return Constant(
        value, unit, uncertainty, _DE421 if uncertainty is None else _DE421_AND_GRAIL, _DE421_READ
    )


#: (C - A)/B and (B - A)/C of the undistorted Moon.
MOON_BETA = _de421(6.310022025364629e-4, "", 1.9e-8)
MOON_GAMMA = _de421(2.277305314199142e-4, "", 4.2e-9)
MOON_J2 = _de421(2.032732576370724e-4, "", 5.7e-8)
#: Stokes coefficients of degree 3 and 4, unnormalised.
MOON_FIELD = {
    "c30": -8.404701525941e-06, "c31": 2.8452435e-05, "s31": 5.9008e-06,
    "c32": 4.84638724000903e-06, "s32": 1.6841984741476e-06,
    "c33": 1.674047530039142e-06, "s33": -2.485526e-07,
    "c40": 9.642286e-06, "c41": -5.692687e-06, "s41": 1.574393e-06,
    "c42": -1.5862e-06, "s42": -1.517312e-06, "c43": -8.12041e-08, "s43": -8.027907e-07,
    "c44": -1.273941e-07, "s44": 8.31475e-08,
}  # fmt: skip
MOON_HARMONICS = Tabulated("field of the Moon, degrees 3 and 4", _DE421, _DE421_READ)

# moments in units of C: A = B - gamma and 1 - A = beta B
_B = (1 + MOON_GAMMA.value) / (1 + MOON_BETA.value)
_H = 1 - (_B - MOON_GAMMA.value / 2)

MOON_POLE = Tabulated(
    "pole of the Moon", "Archinal et al. 2011, Celest. Mech. 109, 101 (IAU 2009)", c.PCK11
)
#: Arguments of the IAU: phase at J2000.0 (deg) and rate (deg/d) of E1 to E13.
_POLE_TERMS = {
    1: (125.045, -0.0529921),
    2: (250.089, -0.1059842),
    3: (260.008, 13.0120009),
    4: (176.625, 13.3407154),
    5: (357.529, 0.9856003),
    6: (311.589, 26.4057084),
    7: (134.963, 13.0649930),
    8: (276.617, 0.3287146),
    9: (34.226, 1.7484877),
    10: (15.134, -0.1589763),
    11: (119.743, 0.0036096),
    12: (239.961, 0.1643573),
    13: (25.053, 12.9590088),
}
#: Amplitudes of the terms of W, deg.
_MERIDIAN_TERMS = {
    1: 3.5610, 2: 0.1208, 3: -0.0642, 4: 0.0158, 5: 0.0252, 6: -0.0066, 7: -0.0047, 8: -0.0046,
    9: 0.0028, 10: 0.0052, 11: 0.0040, 12: 0.0019, 13: -0.0044,
}  # fmt: skip

MOON_NUMBERS = {
    "gm": Constant(4902.800118e9, "m3 s-2", 4.2e4, _MOON_GM, c.GM_HORIZONS),
    "radius": Constant(1738.0e3, "m", None, "reference radius of " + _GRAIL, _DE430_READ),
    "j2": MOON_J2,
    "dynamical_flattening": Constant(
        _H, "", 2e-8, f"from beta and gamma: {_DE421_AND_GRAIL}", _DE421_READ
    ),
    "triaxiality": Constant(
        MOON_GAMMA.value * MOON_J2.value / _H, "", None, f"gamma C/(M R2): {_DE421}", _DE421_READ
    ),
    "k2": _de421(0.02163368386360741),
    "tidal_delay": _de421(0.1078586819856588 * DAY, "s"),
    "core_moment": _de421(0.0007),
    "core_flattening": _de421(3.797712936914387e-4),
    "core_friction": _de421(1.493760249305661e-8 / DAY, "s-1"),
    # synchronous rotation
    "spin_period": c.SIDEREAL_MONTH,
    "orbital_period": c.SIDEREAL_MONTH,
    # root mean square of the difference from DE421, 1950 to 2050, at most 18.3 arcsec
    "pole_uncertainty": Constant(9.2 * ARCSEC, "rad", None, _DE421, c.COMPUTED),
    # period of the node, 1296000"/6962890.5431" centuries = 6798.383 d
    "cycle": Constant(
        1296000.0 / 6962890.5431 * DAYS_PER_CENTURY * DAY, "s", 0.0, _NODE, "ERFA, eraFaom03"
    ),
} | prime_meridian(
    38.3213,
    *((size, _POLE_TERMS[n][0]) for n, size in _MERIDIAN_TERMS.items()),
    # the periodic terms at other dates
    half_width=7.0,
)


def _pole_terms(sizes: dict[int, float]) -> list[tuple[float, float, float]]:
    """Periodic terms of the Moon's pole: (amplitude in deg, phase in deg, rate in deg/century)."""
    return [(s, _POLE_TERMS[n][0], _POLE_TERMS[n][1] * DAYS_PER_CENTURY) for n, s in sizes.items()]


class PrincipalPole(MovingPole):
    """Axis of the greatest moment of the Moon, 78.56 arcsec from the pole of the IAU.

    It is fixed in the mean-Earth axes of the IAU, whose third axis is the pole.
    """

    def mean(self, days: FloatArray) -> FloatArray:
        """Unit vectors of the axis on given days, shape (n, 3)."""
        pole = super().mean(days)
        angle = np.full(days.shape, 38.3213) + days * (13.17635815 - 1.4e-12 * days)
        for number, size in _MERIDIAN_TERMS.items():
            phase, rate = _POLE_TERMS[number]
            angle += size * np.sin(np.radians(phase + rate * days))
        node = np.stack([-pole[:, 1], pole[:, 0], np.zeros(days.shape)], axis=1)
        node /= np.linalg.norm(node, axis=1, keepdims=True)
        w = np.radians(angle)[:, np.newaxis]
        x_axis = np.cos(w) * node + np.sin(w) * np.cross(pole, node)
        x, y, z = mean_earth_matrix()[:, 2]
        return np.asarray(x * x_axis + y * np.cross(pole, x_axis) + z * pole)


def with_principal_pole(body: Body) -> Body:
    """Replace the pole of the Moon by its axis of greatest moment; return others unchanged."""
    if body.known_as != "moon" or body.pole != MOON.pole:
        return body
    pole = PrincipalPole(**{f.name: getattr(body.pole, f.name) for f in fields(MovingPole)})
    return body.replace(pole=pole, pole_uncertainty=body.pole_uncertainty)


MOON = Body.cited(
    "moon",
    MOON_NUMBERS,
    harmonics=MOON_FIELD,
    naif=(301,),
    pole=MovingPole.published(
        (269.9949, 0.0031),
        (66.5392, 0.0130),
        _pole_terms(
            {1: -3.8787, 2: -0.1204, 3: 0.0700, 4: -0.0172, 6: 0.0072, 10: -0.0052, 13: 0.0043}
        ),
        _pole_terms(
            {
                1: 1.5419, 2: 0.0239, 3: -0.0278, 4: 0.0068, 6: -0.0029, 7: 0.0009, 10: 0.0008,
                13: -0.0009,
            }
        ),
    ),
    # the orbit precesses about the normal of the ecliptic of J2000.0
    orbit_pole=Direction(math.radians(270.0), math.radians(66.5607)),
    reference=f"{MOON_NUMBERS['gm'].source}; {_DE421}",
)  # fmt: skip


# --- Sun ------------------------------------------------------------------------------------------

_SOLAR_RADIUS = "IAU 2015 Resolution B3: nominal solar radius"
SUN_NUMBERS = {
    "gm": Constant(132712440041.279419e9, "m3 s-2", 1e10, _GM, c.GM_HORIZONS),
    "radius": Constant(6.957e8, "m", 0.0, _SOLAR_RADIUS, "R_sun of astropy.constants"),
}

SUN = Body.cited("sun", SUN_NUMBERS, naif=(10,), reference=SUN_NUMBERS["gm"].source)

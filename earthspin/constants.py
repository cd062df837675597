"""Each physical number once: value, unit, uncertainty, source.

Uncertainties are one standard deviation in the unit of the value; 0 means exact or
defined, None that the source gives none. Plain conversion factors stand at the end.
"""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Constant:
    """A number with its pedigree.

    Attributes
    ----------
    value : float
        In `unit`.
    unit : str
        A string that astropy.units can parse; empty for a pure number.
    uncertainty : float or None
        One standard deviation; 0 if exact or defined, None if the source gives none.
    source : str
        Where the value stands in print.
    """

    value: float
    unit: str
    uncertainty: float | None
    source: str

    @property
    def relative_uncertainty(self) -> float:
        """One standard deviation as a fraction of the value; 0 where none is known."""
        return abs((self.uncertainty or 0.0) / self.value)


SPEED_OF_LIGHT = Constant(299792458.0, "m s-1", 0.0, "SI Brochure, 9th edition: exact")

_IERS = "IERS Conventions (2010), IERS Technical Note 36, table 1.1"
_DE440 = "Park et al. 2021, AJ 161:105; header of DE440"
_P03 = "Capitaine, Wallace & Chapront 2003, A&A 412, 567 (adopted as IAU 2006)"
_P03_TABLE3 = _P03 + ", table 3, after Williams 1994 and Mathews et al. 2002"

# --- gravitation -----------------------------------------------------------------------------
G = Constant(6.67430e-11, "m3 kg-1 s-2", 1.5e-15, "CODATA 2018, 2022")

GM_SUN = Constant(132712440041.279419e9, "m3 s-2", 1e10, _DE440 + "; uncertainty from " + _IERS)
GM_MOON = Constant(
    4902.800118e9,
    "m3 s-2",
    4.2e4,
    _DE440 + "; uncertainty: the difference from DE421's 4902.800076",
)
GM_EARTH = Constant(398600.435507e9, "m3 s-2", 8e5, _DE440 + "; uncertainty from " + _IERS)
GM_MERCURY = Constant(22031.868551e9, "m3 s-2", None, _DE440)
GM_VENUS = Constant(324858.592000e9, "m3 s-2", None, _DE440)
GM_MARS = Constant(42828.375816e9, "m3 s-2", None, _DE440)
GM_JUPITER = Constant(126712764.100000e9, "m3 s-2", None, _DE440)
GM_SATURN = Constant(37940584.841800e9, "m3 s-2", None, _DE440)
GM_URANUS = Constant(5794556.400000e9, "m3 s-2", None, _DE440)
GM_NEPTUNE = Constant(6836527.100580e9, "m3 s-2", None, _DE440)

# --- the Earth -------------------------------------------------------------------------------
EARTH_RADIUS = Constant(6378136.6, "m", 0.1, _IERS + " (equatorial, zero-tide)")
EARTH_J2 = Constant(1.0826359e-3, "", 1e-10, _IERS + " (zero-tide)")
EARTH_FLATTENING = Constant(1 / 298.25642, "", 1.1e-10, _IERS + " (zero-tide)")
EARTH_H = Constant(
    0.0032737949,
    "",
    1e-9,
    "Mathews, Herring & Buffett 2002, JGR 107(B4), 2068; uncertainty from " + _IERS,
)
# (B - A)/(M a2) = 4 sqrt(5/12) |C22 + i S22| with the normalised coefficients of EGM2008,
# C22 = 2.43938357e-6 and S22 = -1.40027370e-6.
EARTH_TRIAXIALITY = Constant(
    7.2624e-6, "", None, "Pavlis et al. 2012, JGR 117, B04406 (EGM2008), degree 2, order 2"
)
# J_n = -sqrt(2n + 1) C_n0 with the normalised C30 = 9.57161207e-7, C40 = 5.39965866e-7.
EARTH_J3 = Constant(
    -9.57161207e-7 * math.sqrt(7.0), "", None, "Pavlis et al. 2012, JGR 117, B04406 (EGM2008)"
)
EARTH_J4 = Constant(-5.39965866e-7 * 3.0, "", None, "Pavlis et al. 2012, JGR 117, B04406 (EGM2008)")
EARTH_J2_RATE = Constant(
    -3.001e-9 / (36525.0 * 86400.0), "s-1", None, _P03 + ": -3.001e-9 a century, sect. 4.1"
)
# Angle of the axis of least moment at J2000.0 TDB from the x axis of the GCRS: the Earth Rotation
# Angle (Capitaine, Guinot & McCarthy 2000, eq. 14) at UT1 = TDB - 63.83 s, and its longitude
# atan2(S22, C22)/2 = -14.93 deg (EGM2008).
EARTH_MERIDIAN = Constant(
    2 * math.pi * (0.7790572732640 - 1.00273781191135448 * 63.83 / 86400.0)
    + math.atan2(-1.40027370e-6, 2.43938357e-6) / 2,
    "rad",
    1e-4,
    "Capitaine, Guinot & McCarthy 2000, A&A 355, 398, eq. 14; Pavlis et al. 2012 (EGM2008)",
)
# One turn relative to the stars, from the Earth Rotation Angle.
EARTH_SPIN_PERIOD = Constant(
    86400.0 / 1.00273781191135448,
    "s",
    0.0,
    "Capitaine, Guinot & McCarthy 2000, A&A 355, 398, eq. 14 (IAU 2000 Resolution B1.8)",
)
SIDEREAL_YEAR = Constant(
    365.256363004 * 86400.0, "s", 0.0, "Simon et al. 1994, A&A 282, 663 (J2000.0)"
)

TROPICAL_YEAR = Constant(
    365.242190402 * 86400.0, "s", 0.0, "Simon et al. 1994, A&A 282, 663 (J2000.0)"
)

JUPITER_ORBITAL_PERIOD = Constant(
    4332.59 * 86400.0, "s", None, "Standish & Williams, approximate elements, sidereal"
)

# --- the orbit of the Moon -------------------------------------------------------------------
# The node goes once round in 1296000"/6962890.5431" centuries = 6798.383 d.
MOON_NODE_PERIOD = Constant(
    1296000.0 / 6962890.5431 * 36525.0 * 86400.0,
    "s",
    0.0,
    "Simon et al. 1994, A&A 282, 663, sect. 3.5: rate of the mean longitude of the node",
)

# --- Mars ------------------------------------------------------------------------------------
MARS_RADIUS = Constant(3396000.0, "m", None, "reference radius of Konopliv et al. 2011")
MARS_J2 = Constant(
    8.7502e-4 * math.sqrt(5.0),
    "",
    1e-9,
    "Konopliv et al. 2011, Icarus 211, 401 (MRO110B, normalised C20 = -8.7502e-4)",
)
MARS_POLAR_MOMENT = Constant(0.3644, "", 0.0005, "C/(M R2), Konopliv et al. 2011, Icarus 211, 401")
# (B - A)/(M a2) = 4 sqrt(5/12) |C22 + i S22|, normalised: C22 = -8.4636e-5, S22 = 4.8935e-5.
MARS_TRIAXIALITY = Constant(
    4 * math.sqrt(5 / 12) * math.hypot(8.4636e-5, 4.8935e-5),
    "",
    None,
    "Konopliv et al. 2011, Icarus 211, 401 (MRO110B), degree 2, order 2",
)
MARS_FLATTENING = Constant(
    (3396.19 - 3376.20) / 3396.19, "", 4e-5, "Archinal et al. 2018, Celest. Mech. 130:22, table 4"
)
MARS_SPIN_PERIOD = Constant(
    360.0 / 350.89198226 * 86400.0, "s", None, "Archinal et al. 2011, Celest. Mech. 109, 101"
)
MARS_ORBITAL_PERIOD = Constant(
    686.9798 * 86400.0, "s", None, "Standish & Williams, approximate elements, sidereal"
)
MARS_PRECESSION = Constant(
    -7.576, "arcsec yr-1", 0.035, "Folkner et al. 1997, Science 278, 1749 (Viking and Pathfinder)"
)

# --- what the IAU adopted, and what others found --------------------------------------------
EPSILON_0 = Constant(84381.406, "arcsec", 0.001, _P03 + ": obliquity at J2000.0")
PSI_A_RATE = Constant(50.38481507, "arcsec yr-1", None, _P03 + ": psi_A, rate at J2000.0")
OMEGA_A_RATE = Constant(-0.00025754, "arcsec yr-1", None, _P03 + ": omega_A, rate at J2000.0")
CHI_A_RATE = Constant(0.10556403, "arcsec yr-1", None, _P03 + ": chi_A, rate at J2000.0")
P_A_RATE = Constant(50.28796195, "arcsec yr-1", None, _P03 + ": p_A, rate at J2000.0")

#: Contributions to the rate of psi_A at J2000.0 that sun and moon on the mean equator do not give.
PUBLISHED_EFFECTS: dict[str, Constant] = {
    "geodesic": Constant(-1919.883e-5, "arcsec yr-1", None, _P03_TABLE3),
    "second-order": Constant(-(33.10 + 13.68) * 1e-5, "arcsec yr-1", None, _P03_TABLE3),
    "planets": Constant(31.367e-5, "arcsec yr-1", None, _P03_TABLE3),
    "nonrigid": Constant(-21.05e-5, "arcsec yr-1", None, _P03_TABLE3),
    "j4": Constant(2.60e-5, "arcsec yr-1", None, _P03_TABLE3),
}

FIRST_ORDER_RATE = Constant(
    54.94062986, "arcsec yr-1", None, "Capitaine et al. 2004: first order, over cos(epsilon_0)"
)
J2_AND_TILT_RATE = Constant(-269.43e-5, "arcsec yr-1", None, _P03_TABLE3 + ": J2, planetary tilt")

PREM_MEAN_MOMENT = Constant(
    0.330799, "", None, "I/(M R2) of PREM, Dziewonski & Anderson 1981, PEPI 25, 297, as published"
)
PREM_RADIUS = Constant(6371000.0, "m", 0.0, "PREM, Dziewonski & Anderson 1981")

CHANDLER_PERIOD = Constant(
    430.9, "d", 0.7, "Nastula & Gross 2015, JGR Solid Earth 120, 6474: observed, with Q = 127"
)

MARS_CHANDLER_PERIOD = Constant(
    206.9, "d", 0.5, "Konopliv et al. 2020, Geophys. Res. Lett. 47, e2020GL090568: observed"
)

# --- conversions -----------------------------------------------------------------------------
DAY = 86400.0
JULIAN_YEAR = 365.25 * DAY
ARCSEC = math.pi / 648000.0
MAS = ARCSEC / 1000.0
ARCSEC_PER_YEAR = ARCSEC / JULIAN_YEAR  # rad/s
J2000_JD = 2451545.0
MJD_0 = 2400000.5  # Julian date of the modified Julian date 0
NORMAL_95 = 1.959963984540054  # half-width of a 95 % interval in standard deviations

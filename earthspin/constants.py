"""Physical constants with value, unit, uncertainty and source.

Each also names the copy of the source in which the value was checked.

Uncertainties are one standard deviation in the unit of the value; 0 means exact or
defined, None that the source gives none. Plain conversion factors stand at the end.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

#: What `Constant.read_in` holds for a number of which no public copy was found.
UNVERIFIED = "not verified"
#: What it holds for a number that was chosen or computed for this package.
ASSUMED, COMPUTED = "assumed by this package", "computed by this package"


@dataclass(frozen=True, slots=True)
class Constant:
    """Physical constant with unit, uncertainty and source.

    Attributes
    ----------
    value : float
        In `unit`.
    unit : str
        A string that astropy.units can parse; empty for a pure number.
    uncertainty : float or None
        One standard deviation; 0 if exact or defined, None if the source gives none. If a copy
        confirms the value less closely than the source states it, the uncertainty contains the
        difference.
    source : str
        Publication and place in it; "(not verified)" is appended if no public copy was found.
    read_in : str
        Copy, abstract or code in which the value was read; `UNVERIFIED` if none was found; empty
        for a number of the user's own.
    """

    value: float
    unit: str
    uncertainty: float | None
    source: str
    read_in: str = ""

    def __post_init__(self) -> None:
        if not self.verified and UNVERIFIED not in self.source:
            object.__setattr__(self, "source", f"{self.source} ({UNVERIFIED})")

    @property
    def verified(self) -> bool:
        """Return True if the value was checked against its published source."""
        return UNVERIFIED not in self.read_in

    @property
    def relative_uncertainty(self) -> float:
        """Relative standard deviation of the constant; NaN if the uncertainty is not known."""
        return math.nan if self.uncertainty is None else abs(self.uncertainty / self.value)


@dataclass(frozen=True, slots=True)
class Tabulated:
    """Source of the numbers in a table, such as the table of poles, orbits or layers.

    Attributes
    ----------
    content : str
        Description of the numbers.
    source, read_in : str
        As in `Constant`.
    """

    content: str
    source: str
    read_in: str


SPEED_OF_LIGHT = Constant(
    299792458.0, "m s-1", 0.0, "SI Brochure, 9th edition: exact", "astropy.constants.c"
)

IERS = "IERS Conventions (2010), IERS Technical Note 36"
IERS_2010 = IERS + ", table 1.1"
DE440 = "Park et al. 2021, AJ 161:105; header of DE440"
P03 = "Capitaine, Wallace & Chapront 2003, A&A 412, 567 (adopted as IAU 2006)"
_SIMON = "Simon et al. 1994, A&A 282, 663 (J2000.0)"
_P03_TABLE3 = P03 + ", table 3, after Williams 1994 and Mathews et al. 2002"

# --- where the numbers were read: public copies, with repository and path for files ---------------
_EOP_PC = "public codes, after hpiers.obspm.fr/eop-pc/models/constants.html"
_TABLE3_READ = "table 3 of the paper, aanda.org/articles/aa/full/2003/48/aa4068/table3.html"
ERFA_P06E = "ERFA, eraP06e"
GM_HORIZONS = "gm_Horizons.pck of JPL, which lists the values of DE440, in a public repository"
PCK11 = "NAIF kernel pck00011.tpc: Mahammad44/liveUmma, kernels/pck00011.tpc"
SHTOOLS = "SHTOOLS/SHTOOLS, pyshtools/constants/"
IERS_TABLE_READ = "values of the table in AHRS (Mayitzin/ahrs, ahrs/common/constants.py) and Orekit"
PREM_READ = "codes of PREM in public repositories: coefficients of table I by layer"
SIMON_READ = "CesiumGS/cesium, Core/Simon1994PlanetaryPositions.js (section 3.4, b.1)"
STANDISH_READ = "p_elem_t1.txt of JPL (table 1), copied in full in a public repository"

# --- gravitation -----------------------------------------------------------------------------
G = Constant(6.67430e-11, "m3 kg-1 s-2", 1.5e-15, "CODATA 2018, 2022", "astropy.constants.G")


# --- time ------------------------------------------------------------------------------------
SIDEREAL_YEAR = Constant(365.256363004 * 86400.0, "s", 0.0, _SIMON, _EOP_PC)

# 1296000" over the rate of the mean longitude W1, 1732559343.73604" a century: 27.321662 d
_ELP = "Chapront-Touze & Chapront 1983, A&A 124, 50 (ELP 2000), rate of W1"
_ELP_READ = "codes of ELP 2000-82B and ELP/MPP02 in public repositories, rate of W1"
_MONTH = 1296000.0 / 1732559343.73604 * 36525.0 * 86400.0
SIDEREAL_MONTH = Constant(_MONTH, "s", 0.0, _ELP, _ELP_READ)

TROPICAL_YEAR = Constant(365.242190402 * 86400.0, "s", 0.0, _SIMON, _EOP_PC)

_FACT_SHEETS = "4332.589 d: planetary fact sheets and ephemeris codes in public repositories"
JUPITER_ORBITAL_PERIOD = Constant(
    4332.59 * 86400.0, "s", None, "mean sidereal period, rounded", _FACT_SHEETS
)

# --- light ----------------------------------------------------------------------------------
_NOMINAL = "IAU 2015 Resolution B3: nominal total solar irradiance at 1 au"
_NOMINAL_READ = "public pages that quote the nominal value on the scale of IAU 2015, 1361 W/m2"
SOLAR_CONSTANT = Constant(1361.0, "W m-2", 0.0, _NOMINAL, _NOMINAL_READ)

# --- what the IAU adopted, and what others found --------------------------------------------
EPSILON_0 = Constant(84381.406, "arcsec", 0.001, P03 + ": obliquity at J2000.0", ERFA_P06E)


def _rate(value: float, source: str, read_in: str) -> Constant:
    """Make a `Constant` from a rate in arcsec/yr without published uncertainty."""
    return Constant(value, "arcsec yr-1", None, source, read_in)


PSI_A_RATE = _rate(50.38481507, P03 + ": psi_A, rate at J2000.0", ERFA_P06E)
OMEGA_A_RATE = _rate(-0.00025754, P03 + ": omega_A, rate at J2000.0", ERFA_P06E)
CHI_A_RATE = _rate(0.10556403, P03 + ": chi_A, rate at J2000.0", ERFA_P06E)
P_A_RATE = _rate(50.28796195, P03 + ": p_A, rate at J2000.0", ERFA_P06E)

#: Contributions to the rate of psi_A at J2000.0 that sun and moon on the mean equator do not give.
PUBLISHED_EFFECTS: dict[str, Constant] = {
    "geodesic": _rate(-1919.883e-5, _P03_TABLE3, _TABLE3_READ),
    "second-order": _rate(-(33.10 + 13.68) * 1e-5, _P03_TABLE3, _TABLE3_READ),
    "planets": _rate(31.367e-5, _P03_TABLE3, _TABLE3_READ),
    "nonrigid": _rate(-21.05e-5, _P03_TABLE3, _TABLE3_READ),
    "j4": _rate(2.60e-5, _P03_TABLE3, _TABLE3_READ),
}

_REST_READ = "follows from the rate of psi_A (ERFA, eraP06e) less the total of " + _TABLE3_READ
_FIRST_ORDER = "Capitaine et al. 2004: first order, over cos(epsilon_0)"
FIRST_ORDER_RATE = _rate(54.94062986, _FIRST_ORDER, _REST_READ)
J2_AND_TILT_RATE = _rate(-269.43e-5, _P03_TABLE3 + ": J2, planetary tilt", _TABLE3_READ)

#: Of the rate of omega_A: the tides that the Earth raises and drags along tilt its axis.
TIDES_IN_OBLIQUITY = _rate(2.4e-5, _P03_TABLE3 + ": tides, in obliquity", _TABLE3_READ)

# --- Mars, whose bulge and whose layers answer to the same numbers -----------------------------
MARS_GM = Constant(42828.375816e9, "m3 s-2", None, DE440, GM_HORIZONS)
_MRO110B_READ = "SHTOOLS/SHTOOLS, examples/ExampleDataFiles/jgmro_110b_sha.tab"
MARS_GRAVITY = "Konopliv et al. 2011, Icarus 211, 401 (MRO110B)"
MARS_RADIUS = Constant(
    3396000.0, "m", None, "reference radius of Konopliv et al. 2011", _MRO110B_READ
)
_C20 = MARS_GRAVITY + ", normalised C20 = -8.7502e-4"
MARS_J2 = Constant(8.7502e-4 * math.sqrt(5.0), "", 1e-9, _C20, _MRO110B_READ)
#: C/(M R2). With it our rate, geodesic precession included, is that observed from the ground.
MARS_POLAR_MOMENT = Constant(
    0.36367,
    "",
    0.00010,
    "C/(M R2) of Baland et al. 2020, Celest. Mech. 132:47 (BMAN20), from the precession observed "
    "by Konopliv et al. 2016",
    "page of the model, lara.oma.be/RigidNutations/BMAN20.html",
)

# --- the Earth inside ------------------------------------------------------------------------
PREM_MEAN_MOMENT = Constant(
    0.330799,
    "",
    5e-7,
    "I/(M R2) of PREM, Dziewonski & Anderson 1981, PEPI 25, 297, as published; half its last digit",
    "follows from the layers of `interior.layers`, which were read",
)
PREM_RADIUS = Constant(6371000.0, "m", 0.0, "PREM, Dziewonski & Anderson 1981", PREM_READ)

# --- conversions -----------------------------------------------------------------------------
AU = 149597870700.0  # m, exact: IAU 2012 resolution B2
DAY = 86400.0
DAYS_PER_YEAR = 365.25  # Julian year
JULIAN_YEAR = DAYS_PER_YEAR * DAY
DAYS_PER_CENTURY = 36525.0
ARCSEC = math.pi / 648000.0
MAS = ARCSEC / 1000.0
UAS = 1e-6 * ARCSEC
ARCSEC_PER_YEAR = ARCSEC / JULIAN_YEAR  # rad/s
J2000_JD = 2451545.0
NORMAL_95 = 1.959963984540054  # half-width of a 95 % interval in standard deviations

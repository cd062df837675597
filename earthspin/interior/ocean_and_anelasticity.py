"""Effects of the ocean and of the anelastic mantle on the wobble and on the tidal k2."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from earthspin.constants import ARCSEC, IERS, Constant, Tabulated
from earthspin.interior.layers import LayeredBody
from earthspin.interior.love import elastic
from earthspin.numerics.arrays import Array, Numeric

# --- anelastic softening of the mantle ------------------------------------------------------------


#: Period up to which the quality factor does not depend on frequency, s.
ABSORPTION_BAND = 200.0


def shear_modulus_change(period: Numeric, exponent: Numeric) -> Numeric:
    """Relative change of the shear modulus from 1 s to a longer period, for quality factor 1.

    For another quality factor, divide the change by that quality factor.

    The loss is independent of the period up to 200 s, and grows as a power of the period beyond:

        -(2/pi) ln(200) + cot(alpha pi/2) (1 - (P/200 s)^alpha) + i (P/200 s)^alpha

    (Liu, Anderson & Kanamori 1976, Geophys. J. R. astr. Soc. 47, 41; Smith & Dahlen 1981;
    Wahr & Bergen 1986, Geophys. J. R. astr. Soc. 87, 633), for exp(+i omega t). Seismic moduli
    refer to 1 s. As alpha tends to 0 the second term becomes -(2/pi) ln(P/200 s).

    Parameters
    ----------
    period : float
        s, 200 or more.
    exponent : float
        alpha, zero or more.
    """
    log = np.log(np.asarray(period) / ABSORPTION_BAND)
    power = np.exp(exponent * log)
    # cot(alpha pi/2) (1 - x^alpha), written as a product that is regular at alpha = 0.
    angle = np.asarray(exponent) * np.pi / 2
    power_excess = np.where(angle == 0, log, _expm1_over(exponent, log))
    cosine = np.cos(angle) / np.sinc(angle / np.pi)
    return -2 / np.pi * (np.log(ABSORPTION_BAND) + cosine * power_excess) + 1j * power


def _expm1_over(exponent: Numeric, log: Numeric) -> Numeric:
    """Compute (x^alpha - 1)/alpha from alpha and ln x, without cancellation; alpha is not 0."""
    safe = np.where(np.equal(exponent, 0), 1.0, exponent)
    return np.expm1(safe * log) / safe


# --- equilibrium ocean ----------------------------------------------------------------------------

# Products of inertia of the ocean over M a2, per radian of wobble: c = -sqrt(5/3) M a2 C21.
_OCEAN_C21 = (2.1778e-10, 0.01724)  # of -C21 per arcsecond: a (m1 - b m2)
_OCEAN_S21 = (1.7232e-10, 0.03365)  # of -S21 per arcsecond: a (m2 - b m1)
OCEAN_SOURCE = (
    "IERS Conventions (2010), eq. 6.24: self-consistent equilibrium ocean pole tide, "
    "after Desai 2002, JGR 107(C11), 3186"
)
POLE_TIDE = Tabulated(
    "ocean pole tide, four coefficients",
    OCEAN_SOURCE,
    "codes of the equation in public repositories, Orekit among them",
)

_SEA_WATER_READ = "pyTMD 3.0.9, compute.py: ocean pole tide"
#: Density of sea water, as the IERS Conventions (2010), sect. 6.5, use it.
SEA_WATER = Constant(1025.0, "kg m-3", None, "IERS Conventions (2010), sect. 6.5", _SEA_WATER_READ)


def ocean_matrix() -> tuple[tuple[float, float], tuple[float, float]]:
    """Products of inertia c13 and c23 of the Earth's ocean per radian of wobble, over M a2.

    Only the symmetric part of the published response is used; the antisymmetric part is due to the
    delay of the mantle's response.
    """
    (a, ab), (d, dc) = _OCEAN_C21, _OCEAN_S21
    unit = math.sqrt(5 / 3) / ARCSEC
    off = -(a * ab + d * dc) / 2
    return (unit * a, unit * off), (unit * off, unit * d)


def global_ocean(layers: LayeredBody, density: float = SEA_WATER.value) -> float:
    """Contribution to the Love number k2 by an equilibrium ocean that covers the whole body.

    The sea surface follows the potential of the wobble, of the deformed body, of the water and of
    the loading by the water. This is one equation of degree two, solved in closed form (Munk &
    MacDonald 1960, The Rotation of the Earth, sect. 5.7, self-attraction
    and loading added).
    """
    love = elastic(layers)
    mean_density = layers.mass / (4 / 3 * math.pi * layers.radius**3)
    load_factor = 3 * density / (5 * mean_density)
    k, h, k_load, h_load = (float(v) for v in (love.k, love.h, love.k_load, love.h_load))
    return (1 + k_load) * load_factor * (1 + k - h) / (1 - load_factor * (1 + k_load - h_load))


# --- diurnal ocean tides --------------------------------------------------------------------------
# A tide model gives the contribution of the ocean to the potential of degree 2 and order 1 for
# single waves; divided by the potential of the same wave, it is a change of the Love number k2
# (IERS Conventions 2010, eq. 6.6 to 6.15). K1 is at rest in space; O1 and Q1 correspond to
# retrograde nutations of 13.7 and 9.1 days.

FES2004_SOURCE = (
    IERS + ", sect. 6.3: FES2004 (Lyard et al. 2006, Ocean Dyn. 56, 394), coefficients of degree "
    "2 and order 1; heights of the equilibrium tide from table 6.5a"
)
FES2004 = Tabulated(
    "three diurnal waves of the ocean",
    FES2004_SOURCE,
    "file fes2004_Cnm-Snm.dat of the Conventions, in a public copy; height of K1 in codes of "
    "table 6.5a; heights of O1 and Q1: -0.262232 and -0.050208 m in HARDISP of the Conventions, in "
    "public copies",
)
#: Normalised coefficient of the potential per metre of equilibrium tide, A_1.
PER_METRE = Constant(
    -3.1274e-8, "m-1", None, IERS + ", eq. 6.8d", "codes of the equation in public repositories"
)
#: Unit of the coefficients below. The file stated 1e-12 until the Conventions Centre corrected it
#: on 23 September 2011 (maia.usno.navy.mil/conv2010/convupdt/convupdt_c6.html).
_UNIT = 1e-11


class Wave(NamedTuple):
    """One diurnal tidal wave: frequency, equilibrium height, and amplitude of the ocean tide.

    Attributes
    ----------
    degrees : float
        Phase rate, degrees per hour.
    height : float
        Height of the equilibrium tide, m.
    cosine, sine : float
        C+ and S+ of the ocean tide, in units of 1e-11.
    """

    degrees: float
    height: float
    cosine: float
    sine: float


#: In order of frequency. P1 is omitted because its row in the file has the opposite sign
#: convention.
WAVES = {
    "Q1": Wave(13.39866, -0.05020, -3.75105, -3.54595),
    "O1": Wave(13.94304, -0.26223, -16.83767, -18.02652),
    "K1": Wave(15.04107, 0.36870, 20.22034, 18.62745),
}


def wave_response(wave: Wave) -> complex:
    """Change of the Love number k2 by the ocean tide of one diurnal wave.

    The phase is that of exp(i sigma Omega t) with sigma near -1.

    The Conventions give the complex conjugate, for a phase that increases with time.
    """
    equilibrium = -1j * PER_METRE.value * wave.height
    return complex(np.conj((wave.cosine - 1j * wave.sine) * _UNIT / equilibrium))


def diurnal_response(sigma: Array) -> Array:
    """Change of the Love number k2 by ocean tides, at diurnal frequencies in cycles per rotation.

    Linear interpolation between the waves; constant beyond the first and the last.

    Parameters
    ----------
    sigma : ndarray
        Frequencies near -1.
    """
    rotation_rate = WAVES["K1"].degrees
    waves = np.array([wave.degrees / rotation_rate for wave in WAVES.values()])
    change = np.array([wave_response(wave) for wave in WAVES.values()])
    rate = np.abs(np.asarray(sigma, dtype=float))
    real, imaginary = (np.interp(rate, waves, part) for part in (change.real, change.imag))
    return np.asarray(real + 1j * imaginary)

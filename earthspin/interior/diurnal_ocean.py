r"""Response of the ocean to diurnal tides, which differs from equilibrium, and its effect on k2.

A tide model gives the contribution of the ocean to the potential of degree 2 and order 1 for single
waves; divided by the potential of the same wave, it is a change of the Love number, \Delta k (IERS
Conventions
2010, eq. 6.6 to 6.15). K1 is at rest in space; O1 and Q1 correspond to retrograde nutations of 13.7
and 9.1 days.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from earthspin.constants import IERS, Constant, Tabulated
from earthspin.numerics.arrays import Array

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
#: on
#: 23 September 2011 (maia.usno.navy.mil/conv2010/convupdt/convupdt_c6.html).
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
    """Change of the Love number k2 by the ocean tide at the frequency of one diurnal wave.

    The phase is that of exp(i sigma Omega t) with sigma near -1.

    The Conventions give the complex conjugate, for a phase that increases with time.
    """
    over = -1j * PER_METRE.value * wave.height
    return complex(np.conj((wave.cosine - 1j * wave.sine) * _UNIT / over))


def diurnal_response(sigma: Array) -> Array:
    """Change of the Love number k2 by the ocean tide at body-fixed diurnal frequencies.

    Linear interpolation between the waves; constant beyond the first and the last.

    Parameters
    ----------
    sigma : ndarray
        Frequencies near -1.
    """
    turn = WAVES["K1"].degrees
    at = np.array([wave.degrees / turn for wave in WAVES.values()])
    change = np.array([wave_response(wave) for wave in WAVES.values()])
    near = np.abs(np.asarray(sigma, dtype=float))
    return np.asarray(np.interp(near, at, change.real) + 1j * np.interp(near, at, change.imag))

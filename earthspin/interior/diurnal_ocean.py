r"""The ocean as it follows a tide of a day: not in equilibrium, as it follows the wobble.

A tide model gives what the sea adds to the potential of degree 2 and order 1 for single waves; over
the potential of the same wave that is a change of the Love number, \Delta k (IERS Conventions
2010, eq. 6.6 to 6.15). K1 is at rest in space; O1 and Q1 are nutations of 13.7 and 9.1 days,
retrograde.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import IERS, UNVERIFIED, Constant, Tabulated

Array = NDArray[Any]

FES2004_SOURCE = (
    IERS + ", sect. 6.3: FES2004 (Lyard et al. 2006, Ocean Dyn. 56, 394), coefficients of degree "
    "2 and order 1; heights of the equilibrium tide from table 6.5a, those of O1 and Q1 "
    + UNVERIFIED
)
FES2004 = Tabulated(
    "three diurnal waves of the ocean",
    FES2004_SOURCE,
    "file fes2004_Cnm-Snm.dat of the Conventions, in a public copy; height of K1 in codes of "
    f"table 6.5a; heights of O1 and Q1 {UNVERIFIED}",
)
#: Normalised coefficient of the potential per metre of equilibrium tide, A_1.
PER_METRE = Constant(
    -3.1274e-8, "m-1", None, IERS + ", eq. 6.8d", "codes of the equation in public repositories"
)
#: Of the coefficients below. The file said 1e-12 until the Conventions Centre corrected it on
#: 23 September 2011 (maia.usno.navy.mil/conv2010/convupdt/convupdt_c6.html).
_UNIT = 1e-11


class Wave(NamedTuple):
    """One diurnal wave.

    Attributes
    ----------
    degrees : float
        Of its phase in an hour.
    height : float
        Of the equilibrium tide, m.
    cosine, sine : float
        C+ and S+ of the ocean, in 1e-11.
    """

    degrees: float
    height: float
    cosine: float
    sine: float


#: From slow to fast. P1 is left out: the sign of its row is that of a tide of the other sign.
WAVES = {
    "Q1": Wave(13.39866, -0.05020, -3.75105, -3.54595),
    "O1": Wave(13.94304, -0.26223, -16.83767, -18.02652),
    "K1": Wave(15.04107, 0.36870, 20.22034, 18.62745),
}


def wave_response(wave: Wave) -> complex:
    """Change of the Love number, for exp(i sigma Omega t) with sigma near -1.

    The Conventions write it for a phase that grows, which is the complex conjugate.
    """
    over = -1j * PER_METRE.value * wave.height
    return complex(np.conj((wave.cosine - 1j * wave.sine) * _UNIT / over))


def diurnal_response(sigma: Array) -> Array:
    """Change of the Love number at frequencies in the body, turns per turn.

    Straight lines between the waves; beyond the first and the last it stays.

    Parameters
    ----------
    sigma : ndarray
        Near -1.
    """
    turn = WAVES["K1"].degrees
    at = np.array([wave.degrees / turn for wave in WAVES.values()])
    found = np.array([wave_response(wave) for wave in WAVES.values()])
    near = np.abs(np.asarray(sigma, dtype=float))
    return np.asarray(np.interp(near, at, found.real) + 1j * np.interp(near, at, found.imag))

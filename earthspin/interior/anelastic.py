"""How much softer the rocks are at long periods than for the waves that measured them."""

from __future__ import annotations

from typing import Any

import numpy as np

Numeric = Any

#: Period up to which the quality factor does not depend on frequency, s.
ABSORPTION_BAND = 200.0


def anelastic_strain(period: Numeric, exponent: Numeric) -> Numeric:
    """Relative change of the shear modulus at quality factor 1, from 1 s to a long period.

    Up to 200 s the loss does not depend on the period, beyond it grows with its power:

        -(2/pi) ln(200) + cot(alpha pi/2) (1 - (P/200 s)^alpha) + i (P/200 s)^alpha

    (Liu, Anderson & Kanamori 1976, Geophys. J. R. astr. Soc. 47, 41; Smith & Dahlen 1981;
    Wahr & Bergen 1986, Geophys. J. R. astr. Soc. 87, 633), for exp(+i omega t). Seismic
    moduli stand at 1 s. As alpha tends to 0 the second term becomes -(2/pi) ln(P/200 s).

    Parameters
    ----------
    period : float
        s, 200 or more.
    exponent : float
        alpha, zero or more.
    """
    log = np.log(np.asarray(period) / ABSORPTION_BAND)
    grown = np.exp(exponent * log)
    # cot(alpha pi/2) (1 - x^alpha), of which both factors fail at alpha = 0.
    angle = np.asarray(exponent) * np.pi / 2
    growth = np.where(angle == 0, log, _expm1_over(exponent, log))
    cosine = np.cos(angle) / np.sinc(angle / np.pi)
    return -2 / np.pi * (np.log(ABSORPTION_BAND) + cosine * growth) + 1j * grown


def _expm1_over(exponent: Numeric, log: Numeric) -> Numeric:
    """(x^alpha - 1)/alpha with a harmless alpha in the place of 0."""
    safe = np.where(np.equal(exponent, 0), 1.0, exponent)
    return np.expm1(safe * log) / safe

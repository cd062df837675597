"""Anelastic softening of the mantle: lower rigidity at long periods than at seismic periods."""

from __future__ import annotations

from typing import Any

import numpy as np

Numeric = Any

#: Period up to which the quality factor does not depend on frequency, s.
ABSORPTION_BAND = 200.0


def anelastic_strain(period: Numeric, exponent: Numeric) -> Numeric:
    """Relative change of the shear modulus from a period of 1 s to a long one, for Q = 1.

    The change is for a material of quality factor 1; for others, divide it by the quality factor.

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
    grown = np.exp(exponent * log)
    # cot(alpha pi/2) (1 - x^alpha), written as a product that is regular at alpha = 0.
    angle = np.asarray(exponent) * np.pi / 2
    growth = np.where(angle == 0, log, _expm1_over(exponent, log))
    cosine = np.cos(angle) / np.sinc(angle / np.pi)
    return -2 / np.pi * (np.log(ABSORPTION_BAND) + cosine * growth) + 1j * grown


def _expm1_over(exponent: Numeric, log: Numeric) -> Numeric:
    """Compute (x^alpha - 1)/alpha from ln x and alpha without cancellation; wrong at alpha = 0."""
    safe = np.where(np.equal(exponent, 0), 1.0, exponent)
    return np.expm1(safe * log) / safe

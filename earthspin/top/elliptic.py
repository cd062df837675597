"""Elliptic functions and integrals by the complementary parameter, whole up to the separatrix.

`scipy.special.ellipj` takes the parameter m itself and so loses 1 - m, which is what counts
near a separatrix; and `scipy.special.elliprj` loses up to three digits of a complete integral
that peaks at its end.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def jacobi_sncndn(
    argument: FloatArray, complement: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The functions sn, cn, dn, each to full relative accuracy up to half a quarter period.

    The descending Gauss transformation, as a recurrence of positive terms (Bulirsch 1965,
    Numer. Math. 7, 78).

    Parameters
    ----------
    argument : ndarray
        Between -K and K. Beyond K/2 cn loses relative accuracy towards its zero at K.
    complement : ndarray
        1 - m, from 0 to 1; broadcasts with `argument`.

    Returns
    -------
    sn, cn, dn : ndarray
    """
    argument, complement = np.broadcast_arrays(argument, complement)
    on_separatrix = complement == 0
    mean, root = np.ones_like(complement), np.sqrt(np.where(on_separatrix, 1.0, complement))
    means = [(mean, root)]
    while np.any(mean - root > 1e-8 * mean):  # the next mean is then right to the last digit
        mean, root = (mean + root) / 2, np.sqrt(mean * root)
        means.append((mean, root))
    mean = (mean + root) / 2

    at_zero = np.abs(argument) < 1e-100  # where sn is the argument
    angle = np.where(at_zero, 1.0, mean * argument)
    cotangent = mean / np.tan(angle)  # of the amplitude, times the mean of its level
    dn = np.ones_like(mean)
    for upper_mean, upper_root in reversed(means):
        square = cotangent**2 / mean
        cotangent = cotangent * dn
        dn = (upper_root + square) / (upper_mean + square)
        mean = upper_mean
    sn = np.sign(angle) / np.hypot(1.0, cotangent)
    cn = sn * cotangent
    sn, cn, dn = (np.where(at_zero, limit, f) for limit, f in ((argument, sn), (1, cn), (1, dn)))
    if not np.any(on_separatrix):
        return sn, cn, dn
    sech = 1 / np.cosh(np.where(on_separatrix, np.clip(argument, -700.0, 700.0), 0.0))
    return (
        np.where(on_separatrix, np.tanh(argument), sn),
        np.where(on_separatrix, sech, cn),
        np.where(on_separatrix, sech, dn),
    )


def complete_third_kind(complement: FloatArray, shape: FloatArray) -> FloatArray:
    """Integral of sn^2/(cn^2 + shape sn^2) from 0 to K.

    It is RJ(0, 1 - m, 1, shape)/3, by Landen's steps on positive terms (Bulirsch 1969,
    Numer. Math. 13, 305: cel with a = 0, b = 1).

    Parameters
    ----------
    complement : ndarray
        1 - m, above 0 and up to 1.
    shape : ndarray
        Above 0.
    """
    complement, shape = np.broadcast_arrays(complement, shape)
    root, product = np.sqrt(complement), np.sqrt(complement)
    mean, p = np.ones_like(root), np.sqrt(shape)
    a, b = np.zeros_like(root), 1 / p
    while True:
        a, b = b / p + a, 2 * (a * product / p + b)
        p = product / p + p
        last, mean = mean, root + mean
        if np.all(last - root <= 1e-8 * last):
            integral: FloatArray = np.pi / 2 * (b + a * mean) / (mean * (mean + p))
            return integral
        root = 2 * np.sqrt(product)
        product = root * mean

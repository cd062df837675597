"""True equator of IAU 2006/2000A in long double, with Skyfield's tables of the series."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from skyfield import nutationlib as tables

from earthspin.constants import DAYS_PER_CENTURY
from earthspin.numerics.arrays import FloatArray

LongArray = NDArray[np.longdouble]
LONG = np.longdouble

#: One arcsecond, rad.
ARCSEC: Any = 4 * np.arctan(LONG(1)) / 648000
#: Fukushima & Williams angles of IAU 2006 with the frame bias, arcsec and Julian centuries:
#: gamma, phi, psi, and the obliquity (Hilton et al. 2006, Celest. Mech. 94, 351).
FUKUSHIMA_WILLIAMS = (
    (-0.052928, 10.556378, 0.4932044, -0.00031238, -0.000002788, 0.0000000260),
    (84381.412819, -46.811016, 0.0511268, 0.00053289, -0.000000440, -0.0000000176),
    (-0.041775, 5038.481484, 1.5584175, -0.00018522, -0.000026452, -0.0000000148),
    (84381.406, -46.836769, -0.0001831, 0.00200340, -0.000000576, -0.0000000434),
)
#: Adjustments of IAU 2000A nutation to IAU 2006: scale, and effect of the J2 rate per century
#: (Wallace & Capitaine 2006, Astron. Astrophys. 459, 981, eq. 5).
SCALE_2006, J2_RATE_2006 = 0.4697e-6, -2.7774e-6


def true_equator(days: FloatArray) -> LongArray:
    """Matrix from GCRS to true equator and equinox of date, shape (n, 3, 3).

    Parameters
    ----------
    days : ndarray, shape (n,)
        From J2000.0 TDB.
    """
    t = days.astype(LONG) / DAYS_PER_CENTURY
    gamma, phi, psi, obliquity = (
        np.polynomial.polynomial.polyval(t, np.array(angle, dtype=LONG)) * ARCSEC
        for angle in FUKUSHIMA_WILLIAMS
    )
    dpsi, deps = _nutation(t)
    matrix = _about(2, gamma)
    for axis, angle in ((0, phi), (2, -(psi + dpsi)), (0, -(obliquity + deps))):
        matrix = np.einsum("tij,tjk->tik", _about(axis, angle), matrix)
    return matrix


def _nutation(t: LongArray) -> tuple[LongArray, LongArray]:
    """Nutation of IAU 2000A adjusted to IAU 2006, rad, at Julian centuries from J2000.0."""
    polynomials = (tables.fa0, tables.fa1, tables.fa2, tables.fa3, tables.fa4)
    moon_and_sun = sum(c[:, 0, np.newaxis].astype(LONG) * t**n for n, c in enumerate(polynomials))
    linear = tables.anomaly_coefficient.astype(LONG)[:, np.newaxis] * t
    planets = linear + tables.anomaly_constant.astype(LONG)[:, np.newaxis]
    planets[-1] *= t  # general precession has linear and quadratic terms, but no constant
    longitude, obliquity = np.zeros_like(t), np.zeros_like(t)
    for first in range(0, t.size, 500):
        part = slice(first, first + 500)
        arguments = tables.nals_t.astype(LONG) @ (moon_and_sun[:, part] * ARCSEC)
        sine, cosine = np.sin(arguments), np.cos(arguments)
        a, b = tables.lunisolar_longitude_coefficients, tables.lunisolar_obliquity_coefficients
        longitude[part] = a[:, 0] @ sine + t[part] * (a[:, 1] @ sine) + a[:, 2] @ cosine
        obliquity[part] = b[:, 0] @ cosine + t[part] * (b[:, 1] @ cosine) + b[:, 2] @ sine
        arguments = tables.napl_t.astype(LONG) @ planets[:, part]
        sine, cosine = np.sin(arguments), np.cos(arguments)
        a, b = tables.nutation_coefficients_longitude, tables.nutation_coefficients_obliquity
        longitude[part] += a[:, 0] @ sine + a[:, 1] @ cosine
        obliquity[part] += b[:, 0] @ sine + b[:, 1] @ cosine
    j2_scale, unit = J2_RATE_2006 * t, LONG(1e-7) * ARCSEC
    return longitude * (1 + SCALE_2006 + j2_scale) * unit, obliquity * (1 + j2_scale) * unit


def _about(axis: int, angle: LongArray) -> LongArray:
    """Rotation matrices of the frame about a coordinate axis, shape (n, 3, 3)."""
    c, s = np.cos(angle), np.sin(angle)
    first, second = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.zeros((angle.size, 3, 3), dtype=LONG)
    matrix[:, axis, axis] = 1
    matrix[:, first, first] = matrix[:, second, second] = c
    matrix[:, first, second], matrix[:, second, first] = s, -s
    return matrix

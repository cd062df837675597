"""Compare error and run time of methods for directions to Sun and Moon at the true equator.

Nutation is interpolated, exact, or neglected.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache, partial
from typing import Any

import erfa
import numpy as np
from numpy.typing import NDArray
from skyfield import nutationlib as tables
from skyfield.api import load
from skyfield.jpllib import SpiceKernel

from tests.reference.sky import CENTRE, CODES, kernel, positions, unit_vectors
from earthspin.checks.work_precision import FloatArray, Ladder, Method, Result, method
from earthspin.constants import DAYS_PER_CENTURY, J2000_JD, MAS
from earthspin.sky import iau
from earthspin.sky.equator import rotate
from earthspin.sky.skyfield import Skyfield

LongArray = NDArray[np.longdouble]

START, YEAR = 8000.25, 366.0  # days from J2000.0 TDB
EPOCHS, FEW_EPOCHS = 10_000, 400
SPACINGS = (16.0, 8.0, 4.0, 2.0, 1.0, 0.5)
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


def ladder(quick: bool) -> Ladder:
    """Return the comparison (`Ladder`) of methods for Sun and Moon at the true equator."""
    days = START + np.linspace(0.0, YEAR, FEW_EPOCHS if quick else EPOCHS)
    ends = float(days[0]), float(days[-1])
    true = reference(days)
    fine, coarse = ((8.0, 1.0), (2.0,)) if quick else (SPACINGS, SPACINGS[2:5])

    def from_nodes(model: str, spacing: float) -> Result:
        nutation = iau.Nutation(*ends, model=model, spacing=spacing)
        return _directions(nutation.true_equator(days), days), days.size

    def at_each(name: str, matrices: Callable[[], FloatArray], bound: float = math.inf) -> Method:
        return method(name, "", lambda: (_directions(matrices(), days), days.size), bound=bound)

    nodes_a, nodes_b = partial(from_nodes, "2000A"), partial(from_nodes, "2000B")
    return Ladder(
        quantity="torque",
        unit="mas",
        problem=f"directions of Sun and Moon at the true equator and equinox of date (IAU "
        f"2006/2000A), positions of DE421, {days.size} epochs in a year; the error is the largest "
        "angle",
        subject=f"Sun and Moon at the true equator of date, {days.size} epochs in a year",
        reference="IAU 2006/2000A summed in long double with Skyfield's tables of the series and "
        "the angles of Fukushima & Williams",
        reference_error=4 * float(np.finfo(np.longdouble).eps),
        methods=[
            method("IAU 2000A from nodes", "every {} d", nodes_a, fine, 8e-12),
            method("IAU 2000B from nodes", "every {} d", nodes_b, coarse, 2 * MAS),
            at_each(
                "IAU 2000A at each epoch", lambda: iau.Nutation(*ends, 1).true_equator(days), 2e-15
            ),
            method('source = "skyfield"', "", _skyfield_source(days), bound=5e-12),
            at_each("IAU 2000B at each epoch", lambda: erfa.pnm00b(J2000_JD, days)),
            at_each("mean equator alone", lambda: iau.mean_equator(days)),
            method("Skyfield, radec of date", "", _skyfield(days)),
        ],
        error=lambda vectors: float(np.max(np.linalg.norm(vectors - true, axis=-1))),
        useful=1e3 * MAS,
    )


def reference(days: FloatArray) -> LongArray:
    """Reference unit vectors to Sun and Moon at the true equator of date, shape (2, n, 3)."""
    matrix = long_matrix(days)
    result = positions(days)
    position = np.stack([result[name] for name in CODES]).astype(np.longdouble)
    vectors = np.sum(matrix * position[:, :, np.newaxis, :], axis=-1)
    return np.asarray(vectors / np.sqrt(np.sum(vectors * vectors, axis=-1))[..., np.newaxis])


def long_matrix(days: FloatArray) -> LongArray:
    """Matrix from GCRS to true equator and equinox of date in long double, shape (n, 3, 3)."""
    t = days.astype(np.longdouble) / DAYS_PER_CENTURY
    gamma, phi, psi, obliquity = (
        np.polynomial.polynomial.polyval(t, np.array(angle, dtype=np.longdouble)) * _arcsec()
        for angle in FUKUSHIMA_WILLIAMS
    )
    dpsi, deps = long_nutation(t)
    matrix = _about(2, gamma)
    for axis, angle in ((0, phi), (2, -(psi + dpsi)), (0, -(obliquity + deps))):
        matrix = np.einsum("tij,tjk->tik", _about(axis, angle), matrix)
    return matrix


def long_nutation(t: LongArray) -> tuple[LongArray, LongArray]:
    """Nutation of IAU 2000A adjusted to IAU 2006, summed in long double, rad.

    Parameters
    ----------
    t : ndarray, shape (n,)
        Julian centuries from J2000.0.
    """
    polynomials = (tables.fa0, tables.fa1, tables.fa2, tables.fa3, tables.fa4)
    moon_and_sun = sum(
        c[:, 0, np.newaxis].astype(np.longdouble) * t**n for n, c in enumerate(polynomials)
    )
    linear = tables.anomaly_coefficient.astype(np.longdouble)[:, np.newaxis] * t
    planets = linear + tables.anomaly_constant.astype(np.longdouble)[:, np.newaxis]
    planets[-1] *= t  # general precession has linear and quadratic terms, but no constant
    longitude = np.zeros_like(t)
    obliquity = np.zeros_like(t)
    for first in range(0, t.size, 500):
        part = slice(first, first + 500)
        arguments = tables.nals_t.astype(np.longdouble) @ (moon_and_sun[:, part] * _arcsec())
        sine, cosine = np.sin(arguments), np.cos(arguments)
        a, b = tables.lunisolar_longitude_coefficients, tables.lunisolar_obliquity_coefficients
        longitude[part] = a[:, 0] @ sine + t[part] * (a[:, 1] @ sine) + a[:, 2] @ cosine
        obliquity[part] = b[:, 0] @ cosine + t[part] * (b[:, 1] @ cosine) + b[:, 2] @ sine
        arguments = tables.napl_t.astype(np.longdouble) @ planets[:, part]
        sine, cosine = np.sin(arguments), np.cos(arguments)
        a, b = tables.nutation_coefficients_longitude, tables.nutation_coefficients_obliquity
        longitude[part] += a[:, 0] @ sine + a[:, 1] @ cosine
        obliquity[part] += b[:, 0] @ sine + b[:, 1] @ cosine
    j2_scale = J2_RATE_2006 * t
    unit = np.longdouble(1e-7) * _arcsec()
    return longitude * (1 + SCALE_2006 + j2_scale) * unit, obliquity * (1 + j2_scale) * unit


def _arcsec() -> Any:
    """One arcsecond in rad, in long double."""
    return 4 * np.arctan(np.longdouble(1)) / 648000


def _about(axis: int, angle: LongArray) -> LongArray:
    """Rotation matrices of the frame about a coordinate axis, shape (n, 3, 3)."""
    c, s = np.cos(angle), np.sin(angle)
    first, second = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.zeros((angle.size, 3, 3), dtype=np.longdouble)
    matrix[:, axis, axis] = 1
    matrix[:, first, first] = matrix[:, second, second] = c
    matrix[:, first, second], matrix[:, second, first] = s, -s
    return matrix


def _directions(matrix: FloatArray, days: FloatArray) -> FloatArray:
    """Unit vectors to Sun and Moon, rotated by one matrix per day, shape (2, n, 3)."""
    result = positions(days)
    vectors = np.stack([rotate(matrix, result[name]) for name in CODES])
    return np.asarray(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))


def _skyfield_source(days: FloatArray) -> Callable[[], Result]:
    """Make a function that returns directions from the package's own Skyfield source."""
    source = Skyfield(kernel())

    def run() -> Result:
        coordinates = source.radec(CODES, CENTRE, days, iau.true_equator).values()
        return np.stack([unit_vectors(ra, dec) for ra, dec, _ in coordinates]), days.size

    return run


@cache
def _skyfield_kernel() -> Any:
    return SpiceKernel(str(kernel().path))


def _skyfield(days: FloatArray) -> Callable[[], Result]:
    """Make a function that returns directions from calls of Skyfield itself."""
    scale = load.timescale(builtin=True)

    def run() -> Result:
        t = scale.tdb_jd(J2000_JD, days)
        here, result = _skyfield_kernel()[CENTRE], []
        for code in CODES.values():
            ra, dec, _ = (_skyfield_kernel()[code] - here).at(t).radec(epoch="date")
            result.append(unit_vectors(ra.radians, dec.radians))
        return np.stack(result), days.size

    return run

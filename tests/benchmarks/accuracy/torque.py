"""Directions of Sun and Moon at the true equator: nutation interpolated, exact, or neglected.

The torque at an epoch follows from these directions and the distances.
"""

from collections.abc import Callable
from functools import cache, partial

import erfa
import numpy as np
import xarray as xr
from scipy.interpolate import make_interp_spline
from skyfield.api import load
from skyfield.jpllib import SpiceKernel

from earthspin.constants import J2000_JD, MAS
from earthspin.numerics.arrays import FloatArray
from earthspin.sky import iau_models
from earthspin.sky.poles import rotate
from earthspin.sky.skyfield import Skyfield
from tests.benchmarks.accuracy.ladder import Ladder, public_call, settings
from tests.reference.equator import true_equator
from tests.reference.sky import CENTRE, CODES, kernel, positions, unit_vectors

#: Epochs, d from J2000.0 TDB: 10,000 in a year, from 2021-11-26T18:00.
DAYS = 8000.25 + 3160 / 86400 * np.arange(10_000)
#: What a user types.
CALL = 'earthspin.torque_series("2021-11-26T18:00", "2022-11-27T10:54", "3160 s", equator="true")'
ENDS = float(DAYS[0]), float(DAYS[-1])
SPACINGS = (16.0, 8.0, 4.0, 2.0, 1.0, 0.5)


def ladder() -> Ladder:
    """Methods for Sun and Moon at the true equator."""
    true = _directions(true_equator(DAYS))
    source, spice = Skyfield(kernel().path, kernel().name), _spice()
    scale = load.timescale(builtin=True)

    def at_each(matrices: Callable[[], FloatArray]) -> tuple[FloatArray, int]:
        return _directions(matrices()), DAYS.size

    def from_nodes(model: str, spacing: float) -> tuple[FloatArray, int]:
        nodes = np.arange(ENDS[0] - 4 * spacing, ENDS[1] + 5 * spacing, spacing)
        series = {"2000A": erfa.nut06a, "2000B": erfa.nut00b}[model]
        angles = make_interp_spline(nodes, np.stack(series(J2000_JD, nodes), axis=-1), k=5)(DAYS)
        nutation = erfa.numat(erfa.obl06(J2000_JD, DAYS), *angles.T)
        return _directions(erfa.rxr(nutation, iau_models.mean_equator(DAYS))), DAYS.size

    def own_source() -> tuple[FloatArray, int]:
        coordinates = source.radec(CODES, CENTRE, DAYS, iau_models.true_equator).values()
        return np.stack([unit_vectors(ra, dec) for ra, dec, _ in coordinates]), DAYS.size

    def called(answer: xr.Dataset) -> FloatArray:
        answer = answer.transpose("perturber", ...)
        return unit_vectors(np.radians(answer.right_ascension), np.radians(answer.declination))

    def skyfield() -> tuple[FloatArray, int]:
        t, result = scale.tdb_jd(J2000_JD, DAYS), []
        for code in CODES.values():
            ra, dec, _ = (spice[code] - spice[CENTRE]).at(t).radec(epoch="date")
            result.append(unit_vectors(ra.radians, dec.radians))
        return np.stack(result), DAYS.size

    return Ladder(
        title="Torque: directions of Sun and Moon at the true equator of date",
        problem="directions of Sun and Moon at the true equator and equinox of date (IAU "
        f"2006/2000A), positions of DE421, {DAYS.size:,} epochs in a year; the error is the "
        "largest angle",
        reference="IAU 2006/2000A summed in long double with Skyfield's tables of the series and "
        "the angles of Fukushima & Williams",
        unit="mas",
        floor=4 * float(np.finfo(np.longdouble).eps) / MAS,
        error=lambda vectors: np.max(np.linalg.norm(vectors - true, axis=-1)) / MAS,
        runs={
            "nutation from nodes, 2000A": settings(
                "every {} d", partial(from_nodes, "2000A"), SPACINGS
            ),
            "nutation from nodes, 2000B": settings(
                "every {} d", partial(from_nodes, "2000B"), SPACINGS[2:5]
            ),
            "nutation at each epoch": {
                "": partial(at_each, lambda: iau_models.NutationSpline(*ENDS, 1).true_equator(DAYS))
            },
            "torque_series(), first and later": public_call(CALL, called),
            'source = "skyfield"': {"": own_source},
            "ERFA, nutation IAU 2000B": {
                "": partial(at_each, partial(erfa.pnm00b, J2000_JD, DAYS))
            },
            "mean equator, no nutation": {
                "": partial(at_each, partial(iau_models.mean_equator, DAYS))
            },
            "Skyfield, radec of date": {"": skyfield},
        },
        bounds={
            "nutation from nodes, 2000A": 8e-12 / MAS,
            "nutation from nodes, 2000B": 2.0,
            "nutation at each epoch": 2e-15 / MAS,
            "torque_series(), first and later": 8e-12 / MAS,
            'source = "skyfield"': 5e-12 / MAS,
        },
    )


@cache
def _spice() -> SpiceKernel:
    return SpiceKernel(str(kernel().path))


def _directions(matrix: FloatArray) -> FloatArray:
    """Unit vectors to Sun and Moon, rotated by one matrix per day, shape (2, n, 3)."""
    place = positions(DAYS)
    vectors = np.stack([rotate(matrix, place[name]) for name in CODES])
    return np.asarray(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))

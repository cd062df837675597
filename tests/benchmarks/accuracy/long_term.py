"""Spin axis of the Earth over a million years: Newton's method in time beside integrators."""

from collections.abc import Callable
from dataclasses import asdict
from functools import cache, partial
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.polynomial import legendre

from earthspin.bodies import MOON
from earthspin.constants import ARCSEC, ARCSEC_PER_YEAR, JULIAN_YEAR
from earthspin.numerics.arrays import FloatArray
from earthspin.secular import trajectory
from earthspin.secular.averaged_torque import PrecessionConstant, Tides, mean_torque
from earthspin.sky.orbit_table import OrbitTable, shipped
from tests.benchmarks.accuracy.ladder import Ladder, settings
from tests.reference.sky import BODY, SPIN
from tests.reference.stepping import integrate
from tests.reference.stored import load

Slope = Callable[[float, FloatArray], FloatArray]

KYR = 1000 * JULIAN_YEAR
#: Span, s, and the number of times.
SPAN, TIMES = 1000 * KYR, 101
#: Precession constants, geodesic precession and tides near those of the Earth.
STRENGTH = PrecessionConstant(
    sun=17.384 * ARCSEC_PER_YEAR,
    moon=37.555 * ARCSEC_PER_YEAR,
    eccentricity=0.0167,
    geodesic=0.0192 * ARCSEC_PER_YEAR,
    tides=Tides.of_the_earth(1.0, SPIN, 2 * np.pi / MOON.number("orbital_period")),
    node_rate=2 * np.pi / MOON.cycle,
)
#: Error of the reference, rad: halving its steps changes it by 6e-14; rounding of the orbit, which
#: is evaluated in double precision, may differ between processors.
FLOOR = 1e-12
TOLERANCES = (1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)


@cache
def orbit() -> OrbitTable:
    """Table of the Earth's orbit that is shipped with the package."""
    result = shipped(BODY.name)
    assert result is not None
    return result


def inputs() -> dict[str, Any]:
    """Inputs of the stored reference, including the checksum of the orbit table."""
    return {"orbit": orbit().sha256, "strength": asdict(STRENGTH), "span": SPAN, "times": TIMES}


def times() -> FloatArray:
    """Times at which spin axes are compared, s, ascending; the last one is J2000.0."""
    return np.linspace(-SPAN, 0.0, TIMES)


def ladder() -> Ladder:
    """Methods for the spin axis over a million years."""
    true = load("long-term", inputs())["axes"]
    start, fitted = true.hi[:, -1], FittedSlope(-SPAN)
    by_scipy, plain = partial(_scipy, fitted, start), partial(_scipy, orbit_slope, start)
    return Ladder(
        title="Spin axis over a million years",
        problem="a million years of the spin axis under averaged torques of Sun and Moon, geodesic "
        f"precession and tides, on the shipped orbit, at {TIMES} times; the error is the largest "
        "angle",
        reference="the midpoint rule, extrapolated to order 14 in steps of 2,000 years",
        unit="arcsec",
        floor=FLOOR / ARCSEC,
        error=lambda axes: np.max(np.linalg.norm((axes - true).hi, axis=0)) / ARCSEC,
        runs={
            "Newton in time": settings("{} nodes", partial(_newton, start, 1), (10, 12, 14, 16)),
            "Newton in time, half windows": settings(
                "{} nodes", partial(_newton, start, 2), (6, 8)
            ),
            "DOP853, orbit at every step": settings("rtol {}", plain, TOLERANCES[:3]),
            "DOP853, fitted equation": settings("rtol {}", by_scipy, TOLERANCES),
        },
        bounds={"Newton in time": 0.02, "Newton in time, half windows": 0.02},
    )


def _newton(start: FloatArray, pieces: int, order: int) -> tuple[FloatArray, int]:
    path = trajectory.solve(STRENGTH, orbit(), start, (-SPAN, 0.0), order=order, pieces=pieces)
    nodes = order * min(len(path.windows.half), trajectory.BLOCK)
    return path.at(times()), path.steps * nodes


def orbit_slope(time: float, s: FloatArray) -> FloatArray:
    """Rate of change of the spin axis, s-1; each call evaluates the orbit table."""
    times = np.array([time])
    torque = mean_torque(STRENGTH, orbit().at(times), times)
    m = torque.axis[:, 0]
    return np.cross(torque.geodesic[:, 0] - torque.constant[0] * (m @ s) * m, s)


class FittedSlope:
    """Rate of change of the spin axis, with torques from polynomials fitted to the orbit table.

    There is one polynomial for each window of the table.
    """

    def __init__(self, begin: float) -> None:
        edges = orbit().edges
        first = int(np.searchsorted(edges, begin, side="right")) - 1
        edges = edges[first : int(np.searchsorted(edges, 0.0)) + 1]
        nodes = legendre.leggauss(20)[0]
        self.start, self.length = float(edges[0]), float(edges[1] - edges[0])
        self.series = []
        for left, right in pairwise(edges):
            t = (left + right) / 2 + (right - left) / 2 * nodes
            torque = mean_torque(STRENGTH, orbit().at(t), t)
            root = np.sqrt(torque.constant) * torque.axis
            fit = legendre.legfit(nodes, np.concatenate([root, torque.geodesic]).T, 19)
            powers = [legendre.leg2poly(column) for column in fit.T]
            self.series.append(np.array([np.pad(p, (0, 20 - p.size)) for p in powers]))
        self.exponents = np.arange(20)

    def __call__(self, time: float, s: FloatArray) -> FloatArray:
        """Rate of change of the spin axis at a time in s, s-1."""
        position = (time - self.start) / self.length
        window = min(max(int(position), 0), len(self.series) - 1)
        x = 2 * (position - window) - 1
        a, b, c, p, q, r = (self.series[window] @ x**self.exponents).tolist()
        u, v, w = s.tolist()
        lift = a * u + b * v + c * w
        p, q, r = p - lift * a, q - lift * b, r - lift * c
        return np.array([q * w - r * v, r * u - p * w, p * v - q * u])


def _scipy(slope: Slope, start: FloatArray, rtol: float) -> tuple[FloatArray, int]:
    states, evaluations = integrate(slope, start, times()[::-1], rtol)
    axes = states[::-1].T
    return axes / np.linalg.norm(axes, axis=0), evaluations

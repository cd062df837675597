"""Compare error and run time of methods for the Earth's spin axis over a million years."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict
from functools import lru_cache, partial
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.polynomial import legendre

from earthspin.bodies import MOON
from tests.reference.sky import BODY, SPIN
from tests.reference.stepping import integrate
from tests.reference.stored import load
from earthspin.checks.work_precision import FloatArray, Ladder, Method, Result, method
from earthspin.constants import ARCSEC, ARCSEC_PER_YEAR, JULIAN_YEAR
from earthspin.secular import lanes, trajectory
from earthspin.secular.orbit import pull
from earthspin.secular.strength import Strength, Tides
from earthspin.sky.orbit_table import OrbitTable, shipped

KYR = 1000 * JULIAN_YEAR
#: Span of a full and of a quick run, s, and the number of times.
SPAN, FEW, TIMES = 1000 * KYR, 100 * KYR, 101
#: Precession constants, geodesic precession and tides near those of the Earth.
STRENGTH = Strength(
    sun=17.384 * ARCSEC_PER_YEAR,
    moon=37.555 * ARCSEC_PER_YEAR,
    eccentricity=0.0167,
    geodesic=0.0192 * ARCSEC_PER_YEAR,
    tides=Tides.of_the_earth(1.0, SPIN, 2 * np.pi / MOON.number("orbital_period")),
    node_rate=2 * np.pi / MOON.cycle,
)
#: Number of axes in one run of lanes. The steps of lanes should divide the windows of the orbit,
#: 20,000 years, at whose ends its derivatives jump; steps of 3,000 years do not.
MEMBERS = 64
#: Change of the reference with steps of half and a quarter of the length, rad. It is caused by
#: rounding, which differs between processors by up to 2.2e-12.
REFERENCE_ERROR = 4e-12
#: Largest errors of the finest settings, rad.
BOUND = 0.02 * ARCSEC


@lru_cache
def orbit() -> OrbitTable:
    """Table of the Earth's orbit that is shipped with the package."""
    result = shipped(BODY.name)
    if result is None:
        raise LookupError(BODY.name)
    return result


def inputs() -> dict[str, Any]:
    """Inputs of the stored reference solution, including the checksum of the orbit table."""
    return {
        "orbit": orbit().sha256,
        "strength": asdict(STRENGTH),
        "spans": [SPAN, FEW],
        "times": TIMES,
    }


def times(span: float) -> FloatArray:
    """Times at which spin axes are compared, s, ascending; the last one is J2000.0."""
    return np.linspace(-span, 0.0, TIMES)


def ladder(quick: bool) -> Ladder:
    """Return the comparison (`Ladder`) of methods for the spin axis over a million years."""
    true = load("long-term", inputs())["quick" if quick else "axes"]
    start, t = true.hi[:, -1], times(FEW if quick else SPAN)
    fitted = FittedSlope(t[0])
    plain = partial(_scipy, orbit_slope)
    words = "100,000 years" if quick else "a million years"
    nodes = (12, 16) if quick else (10, 12, 14, 16)
    steps = (4, 2) if quick else (8, 5, 4, 3, 2)
    loose = (1e-6, 1e-8) if quick else (1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
    hand = (0.5, 0.25) if quick else (1.0, 0.5, 0.25, 0.125)

    def row(name: str, words: str, run: Callable[..., Result], *rest: Any) -> Method:
        return method(name, words, partial(run, start, t), *rest)

    return Ladder(
        quantity="long-term",
        unit="arcsec",
        problem=f"{words} of the spin axis under averaged torques of Sun and Moon, geodesic "
        f"precession and tides, on the shipped orbit, at {TIMES} times; the error is the largest "
        f"angle; lanes are {MEMBERS} members in one run",
        subject=f"{words} of the spin axis",
        reference="the midpoint rule, extrapolated to order 14 in steps of 2,000 years",
        reference_error=REFERENCE_ERROR,
        methods=[
            row("Newton in time", "{} nodes", partial(_newton, 1), nodes, BOUND),
            row("Newton in time, windows halved", "{} nodes", partial(_newton, 2), (6, 8), BOUND),
            row(f"lanes, {MEMBERS} members", "steps of {} kyr", _lanes, steps, BOUND),
            row("DOP853, orbit at every step", "rtol {}", plain, loose[:3]),
            row("DOP853, fitted equation", "rtol {}", partial(_scipy, fitted), loose),
            row("RK4, fitted equation", "steps of {} kyr", partial(_runge_kutta, fitted), hand),
        ],
        error=lambda axes: float(np.max(np.linalg.norm((axes - true).hi, axis=0))),
        useful=1000 * ARCSEC,
    )


# --- methods of the package ----------------------------------------------------------------------


def _newton(pieces: int, start: FloatArray, t: FloatArray, order: int) -> Result:
    path = trajectory.solve(STRENGTH, orbit(), start, (t[0], 0.0), order=order, pieces=pieces)
    return path.at(t), path.steps * order * min(len(path.windows.half), trajectory.BLOCK)


def _lanes(start: FloatArray, t: FloatArray, step: float) -> Result:
    starts = np.repeat(start[:, np.newaxis], MEMBERS, axis=1)
    axes = lanes.solve_many(STRENGTH, orbit(), starts, t, step * KYR)
    return axes[..., 0], 12 * int(np.ceil(-t[0] / KYR / step))


# --- other methods -------------------------------------------------------------------------------

Slope = Callable[[float, FloatArray], FloatArray]


def orbit_slope(time: float, s: FloatArray) -> FloatArray:
    """Rate of change of the spin axis, s-1; each call evaluates the orbit table."""
    times = np.array([time])
    torque = pull(STRENGTH, orbit().at(times), times)
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
            torque = pull(STRENGTH, orbit().at(t), t)
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


def _scipy(slope: Slope, start: FloatArray, t: FloatArray, rtol: float) -> Result:
    states, evaluations = integrate(slope, start, t[::-1], rtol)
    axes = states[::-1].T
    return axes / np.linalg.norm(axes, axis=0), evaluations


def _runge_kutta(slope: Slope, start: FloatArray, times: FloatArray, kyr: float) -> Result:
    """Integrate the spin axis by the classical Runge-Kutta method, with equal steps in kyr."""
    each = max(round(-times[0] / (TIMES - 1) / (kyr * KYR)), 1)
    step = times[0] / (TIMES - 1) / each
    s, axes = start, [start]
    for number in range((TIMES - 1) * each):
        t = number * step
        k1 = slope(t, s)
        k2 = slope(t + step / 2, s + step / 2 * k1)
        k3 = slope(t + step / 2, s + step / 2 * k2)
        k4 = slope(t + step, s + step * k3)
        s = s + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        if (number + 1) % each == 0:
            axes.append(s)
    vectors = np.array(axes[::-1]).T
    return vectors / np.linalg.norm(vectors, axis=0), 4 * (TIMES - 1) * each

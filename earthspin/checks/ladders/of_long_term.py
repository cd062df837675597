"""The spin axis over a million years: Newton in time and lanes against step-by-step solvers."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, partial
from itertools import pairwise

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from earthspin.bodies import MOON
from earthspin.checks.sky import BODY, SPIN
from earthspin.checks.work_precision import Ladder, Method, settings
from earthspin.constants import ARCSEC, ARCSEC_PER_YEAR, JULIAN_YEAR
from earthspin.secular import lanes, trajectory
from earthspin.secular.orbit import pull
from earthspin.secular.strength import Strength, Tides
from earthspin.sky.orbit_table import OrbitTable, shipped

FloatArray = NDArray[np.float64]
#: Axes at the times asked for, shape (3, n), and how often a slope was evaluated.
Found = tuple[FloatArray, int]

KYR = 1000 * JULIAN_YEAR
#: What is followed, s, and how many axes are asked for.
SPAN, FEW, TIMES = 1000 * KYR, 100 * KYR, 101
#: Some arcseconds a year for each, as they turn the Earth's axis.
STRENGTH = Strength(
    sun=17.384 * ARCSEC_PER_YEAR,
    moon=37.555 * ARCSEC_PER_YEAR,
    eccentricity=0.0167,
    geodesic=0.0192 * ARCSEC_PER_YEAR,
    tides=Tides.of_the_earth(1.0, SPIN, 2 * np.pi / MOON.number("orbital_period")),
    node_rate=2 * np.pi / MOON.cycle,
)
#: Members side by side; a run of lanes is of all of them. Their steps should divide the windows of
#: the orbit, 20,000 years, at whose ends it has corners: those of 3,000 years do not.
MEMBERS = 64
#: Steps of the reference, s, and how often each is divided.
REFERENCE_STEP, DIVIDED = 2 * KYR, (2, 4, 6, 8, 10, 12, 14)
#: What steps of half and of a quarter of the length change in the reference, rad: rounding.
REFERENCE_ERROR = 1e-12
#: Largest errors of the finest settings, rad.
BOUND = 0.02 * ARCSEC


@lru_cache
def _orbit() -> OrbitTable:
    result = shipped(BODY.name)
    if result is None:
        raise LookupError(BODY.name)
    return result


@dataclass(frozen=True)
class Motion:
    """What is followed, into the past.

    Attributes
    ----------
    start : ndarray, shape (3,)
    times : ndarray, shape (n,)
        s, ascending; the last is J2000.0.
    """

    start: FloatArray
    times: FloatArray


def ladder(quick: bool) -> Ladder:
    """Return the methods, their settings and the reference."""
    span = FEW if quick else SPAN
    start = np.asarray(BODY.needed("pole").mean(np.zeros(1))[0])
    motion = Motion(start, np.linspace(-span, 0.0, TIMES))
    true, lean = reference(motion, REFERENCE_STEP), Lean(motion)
    plain = partial(_scipy, as_it_stands)
    words = "100,000 years" if quick else "a million years"
    nodes = (12, 16) if quick else (10, 12, 14, 16)
    steps = (4, 2) if quick else (8, 5, 4, 3, 2)
    loose = (1e-6, 1e-8) if quick else (1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
    hand = (0.5, 0.25) if quick else (1.0, 0.5, 0.25, 0.125)
    rows: list[tuple[str, str, Callable[..., Found], tuple[float, ...], float]] = [
        ("Newton in time", "{} nodes", partial(_newton, 1), nodes, BOUND),
        ("Newton in time, windows halved", "{} nodes", partial(_newton, 2), (6, 8), BOUND),
        (f"lanes, {MEMBERS} members", "steps of {} kyr", _lanes, steps, BOUND),
        ("DOP853 on the equation as it stands", "rtol {}", plain, loose[:3], math.inf),
        ("DOP853 on a lean one", "rtol {}", partial(_scipy, lean), loose, math.inf),
        ("RK4 by hand, lean", "steps of {} kyr", partial(_by_hand, lean), hand, math.inf),
    ]
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
            Method(name, settings(setting, partial(run, motion), values), bound)
            for name, setting, run, values, bound in rows
        ],
        error=lambda axes: float(np.max(np.linalg.norm(axes - true, axis=0))),
        useful=1000 * ARCSEC,
    )


# --- ours ----------------------------------------------------------------------------------------


def _newton(pieces: int, motion: Motion, order: int) -> Found:
    path = trajectory.solve(
        STRENGTH, _orbit(), motion.start, (motion.times[0], 0.0), order=order, pieces=pieces
    )
    return path.at(motion.times), path.steps * order * min(len(path.windows.half), trajectory.BLOCK)


def _lanes(motion: Motion, step: float) -> Found:
    starts = np.repeat(motion.start[:, np.newaxis], MEMBERS, axis=1)
    result = lanes.solve_many(STRENGTH, _orbit(), starts, motion.times, step * KYR)
    return result[..., 0], 12 * int(np.ceil(-motion.times[0] / KYR / step))


# --- what one would do ---------------------------------------------------------------------------

Slope = Callable[[float, FloatArray], FloatArray]


def as_it_stands(time: float, s: FloatArray) -> FloatArray:
    """Slope of the axis, the orbit asked for at every step."""
    now = np.array([time])
    on = pull(STRENGTH, _orbit().at(now), now)
    m = on.axis[:, 0]
    return np.cross(on.geodesic[:, 0] - on.constant[0] * (m @ s) * m, s)


class Lean:
    """The same slope from a polynomial for each window, in plain floats."""

    def __init__(self, motion: Motion) -> None:
        edges = _orbit().edges
        first = int(np.searchsorted(edges, motion.times[0], side="right")) - 1
        edges = edges[first : int(np.searchsorted(edges, 0.0)) + 1]
        nodes = legendre.leggauss(20)[0]
        self.start, self.length = float(edges[0]), float(edges[1] - edges[0])
        self.series = []
        for begin, end in pairwise(edges):
            times = (begin + end) / 2 + (end - begin) / 2 * nodes
            on = pull(STRENGTH, _orbit().at(times), times)
            root = np.sqrt(on.constant) * on.axis
            fit = legendre.legfit(nodes, np.concatenate([root, on.geodesic]).T, 19)
            powers = [legendre.leg2poly(column) for column in fit.T]
            self.series.append(np.array([np.pad(p, (0, 20 - p.size)) for p in powers]))
        self.exponents = np.arange(20)

    def __call__(self, time: float, s: FloatArray) -> FloatArray:
        """Slope of the axis."""
        place = (time - self.start) / self.length
        window = min(max(int(place), 0), len(self.series) - 1)
        x = 2 * (place - window) - 1
        a, b, c, p, q, r = (self.series[window] @ x**self.exponents).tolist()
        u, v, w = s.tolist()
        lift = a * u + b * v + c * w
        p, q, r = p - lift * a, q - lift * b, r - lift * c
        return np.array([q * w - r * v, r * u - p * w, p * v - q * u])


def _scipy(slope: Slope, motion: Motion, rtol: float) -> Found:
    done = solve_ivp(
        slope,
        (0.0, motion.times[0]),
        motion.start,
        "DOP853",
        t_eval=motion.times[::-1],
        rtol=rtol,
        atol=rtol,
    )
    result = done.y[:, ::-1]
    return result / np.linalg.norm(result, axis=0), done.nfev


def _by_hand(slope: Slope, motion: Motion, kyr: float) -> Found:
    """Runge and Kutta's rule in equal steps that meet the times."""
    each = max(round(-motion.times[0] / (TIMES - 1) / (kyr * KYR)), 1)
    step = motion.times[0] / (TIMES - 1) / each
    s, result, calls = motion.start, [motion.start], 0
    for number in range((TIMES - 1) * each):
        t = number * step
        k1 = slope(t, s)
        k2 = slope(t + step / 2, s + step / 2 * k1)
        k3 = slope(t + step / 2, s + step / 2 * k2)
        k4 = slope(t + step, s + step * k3)
        s, calls = s + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4), calls + 4
        if (number + 1) % each == 0:
            result.append(s)
    axes = np.array(result[::-1]).T
    return axes / np.linalg.norm(axes, axis=0), calls


# --- the reference -------------------------------------------------------------------------------


def reference(motion: Motion, step: float) -> FloatArray:
    """The axis by Gragg's midpoint rule, extrapolated (Hairer, Norsett & Wanner 1993, II.9).

    Each step lies in one window of the orbit; what the orbit gives is asked for all at once.
    """
    each = max(round(-motion.times[0] / (TIMES - 1) / step), 1)
    h = motion.times[0] / (TIMES - 1) / each
    shares = np.unique(np.concatenate([np.arange(n + 1) / n for n in DIVIDED]))
    count = (TIMES - 1) * each
    # a hair inside, so that both ends of a step belong to the window it lies in
    inside = 1e-12 + (1 - 2e-12) * shares
    times = (h * (np.arange(count)[:, np.newaxis] + inside)).ravel()
    on = pull(STRENGTH, _orbit().at(times), times)
    root = (np.sqrt(on.constant) * on.axis).reshape(3, count, -1)
    geodesic = on.geodesic.reshape(3, count, -1)
    places = [np.searchsorted(shares, np.arange(n + 1) / n - 1e-12) for n in DIVIDED]
    s, result = motion.start, [motion.start]
    for number in range(count):
        m, g = root[:, number].T, geodesic[:, number].T
        s = _extrapolated(s, h, m, g, places)
        if (number + 1) % each == 0:
            result.append(s)
    return np.array(result[::-1]).T


def _extrapolated(
    s: FloatArray, h: float, m: FloatArray, g: FloatArray, places: list[NDArray[np.int_]]
) -> FloatArray:
    """One step: the midpoint rule with each division, extrapolated to none."""
    table: list[FloatArray] = []
    for n, at in zip(DIVIDED, places, strict=True):

        def slope(k: int, u: FloatArray, at: NDArray[np.int_] = at) -> FloatArray:
            a, b, c = m[at[k]].tolist()
            p, q, r = g[at[k]].tolist()
            x, y, z = u.tolist()
            lift = a * x + b * y + c * z
            p, q, r = p - lift * a, q - lift * b, r - lift * c
            return np.array([q * z - r * y, r * x - p * z, p * y - q * x])

        before, now = s, s + h / n * slope(0, s)
        for k in range(1, n):
            before, now = now, before + 2 * h / n * slope(k, now)
        row = [(before + now + h / n * slope(n, now)) / 2]
        for other, above in zip(DIVIDED[len(table) - 1 :: -1] if table else (), table, strict=True):
            row.append(row[-1] + (row[-1] - above) / ((n / other) ** 2 - 1))
        table = row
    return table[-1]

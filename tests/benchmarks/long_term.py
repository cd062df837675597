"""A million years of the spin axis against scipy's DOP853, as ratios in one run.

Run it with `python -m tests.benchmarks.long_term`. All follow the same equation on the same table,
which is loaded before the clock runs, and are held to the same reference. A method counts only
within the error that is named, which is asserted; a time never is. DOP853 is given two forms: the
equation as one writes it, which asks the table at every slope, and a lean one in plain floats with
a polynomial for each window. In one go it steps over the corners of the table, and its error then
falls and rises with the tolerance as luck has it; anew from each corner it falls with it. A form is
within an error from the loosest tolerance on from which all tighter ones are. Only the end is
asked for.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

from earthspin.bodies import EARTH
from earthspin.constants import ARCSEC
from earthspin.secular.trajectory import solve
from earthspin.sky.orbit_table import shipped
from tests.benchmarks.accuracy.long_term import (
    SPAN,
    STRENGTH,
    FittedSlope,
    Slope,
    inputs,
    orbit_slope,
    times,
)
from tests.reference.stored import load

RUNS = 7
#: Error that one axis is followed within, arcsec.
ASKED = 0.05
IMPORTS = "import numpy, scipy, xarray, skyfield.api, astropy.time"
TABLE = shipped("earth")
assert TABLE is not None
START = np.asarray(EARTH.needed("pole").mean(np.zeros(1))[0])


def timed(run: Callable[[], np.ndarray], runs: int = RUNS) -> tuple[float, np.ndarray]:
    """Shortest time of a call after a warm-up, s, and what it gave; others share the machine."""
    found, times = run(), []
    for _ in range(runs):
        begun = time.perf_counter()
        found = run()
        times.append(time.perf_counter() - begun)
    return min(times), found


def dop853(slope: Slope, rtol: float) -> np.ndarray:
    """The end by scipy, from corner to corner of the table."""
    state, now = START, 0.0
    inner = TABLE.edges[(TABLE.edges < 0) & (TABLE.edges > -SPAN)][::-1]  # type: ignore[union-attr]
    for stop in [*inner, -SPAN]:
        done = solve_ivp(slope, (now, stop), state, "DOP853", rtol=rtol, atol=rtol)
        state, now = done.y[:, -1], stop
    return np.asarray(state)


def smooth(slope: Slope, rtol: float) -> np.ndarray:
    """The end by scipy in one go."""
    return np.asarray(
        solve_ivp(slope, (0.0, -SPAN), START, "DOP853", rtol=rtol, atol=rtol).y[:, -1]
    )


def process(arguments: list[str]) -> float:
    """Wall time of one Python process, s."""
    begun = time.perf_counter()
    subprocess.run([sys.executable, *arguments], check=True, capture_output=True)
    return time.perf_counter() - begun


def main() -> None:
    """Print each method's error and time, and the ratios."""
    true = load("long-term", inputs())["axes"].hi

    def off(found: np.ndarray, true: np.ndarray) -> float:
        found = found / np.linalg.norm(found, axis=0)
        return float(np.max(np.linalg.norm(found - true, axis=0)) / ARCSEC)

    ours = {}
    for order in (12, 14, 16):
        ours[order], _ = timed(lambda n=order: solve(STRENGTH, TABLE, START, (-SPAN, 0.0), n).axes)  # type: ignore[misc]
        path = solve(STRENGTH, TABLE, START, (-SPAN, 0.0), order)
        error = off(path.at(times()), true)
        print(f"Newton, {order} nodes: {error:.2g} arcsec everywhere, {ours[order] * 1e3:.2f} ms")
        assert error < ASKED
    lean = FittedSlope(-SPAN)
    for words, slope, run, tolerances, runs in (
        ("as it stands", orbit_slope, smooth, (1e-9,), 1),
        ("lean, in one go", lean, smooth, (1e-9, 3e-10, 1e-10, 3e-11, 1e-11, 3e-12), RUNS),
        ("lean, from corner to corner", lean, dop853, (1e-7, 3e-8, 1e-8, 3e-9, 1e-9), RUNS),
    ):
        within = np.nan
        for rtol in tolerances:
            seconds, found = timed(lambda f=run, s=slope, r=rtol: f(s, r), runs)  # type: ignore[misc]
            error = off(found, true[:, 0])
            within = np.fmin(within, seconds) if error < ASKED else np.nan
            print(
                f"DOP853, {words}, rtol {rtol:g}: {error:.2g} arcsec at the end, "
                f"{seconds * 1e3:.0f} ms; ratio {seconds / ours[12]:.0f} to 12 nodes"
            )
        if within == within:
            print(f"DOP853, {words}, within {ASKED} arcsec: ratio {within / ours[12]:.0f}")
    with tempfile.TemporaryDirectory() as folder:
        command = ["-m", "earthspin", "run", "long-term", "--out", f"{folder}/answer.nc"]
        process(command)
        pairs = [(process(command), process(["-c", IMPORTS])) for _ in range(RUNS)]
    ratios = [ours / bare for ours, bare in pairs]
    print(
        f"earthspin run long-term: {statistics.median(p[0] for p in pairs):.2f} s, bare imports "
        f"{statistics.median(p[1] for p in pairs):.2f} s, ratio {statistics.median(ratios):.2f} "
        f"({min(ratios):.2f} to {max(ratios):.2f})"
    )


if __name__ == "__main__":
    main()

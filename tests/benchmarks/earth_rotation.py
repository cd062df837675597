"""A month of the rotation of the Earth, against SciPy's DOP853 on Euler's equations.

Run it with `python -m tests.benchmarks.earth_rotation`. DOP853 has what one would write: the torque
of Sun and Moon on three moments of inertia, and a cubic spline through Skyfield's positions of each
hour. It starts as the answer does, which has no effects or those that are known. The difference is
the largest angle between the two attitudes: with no effects the error of DOP853, which is 0.1 mas
at the smallest tolerance. Seconds are of the processor, medians of rounds.
"""

import statistics
import time
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from scipy.interpolate import CubicSpline
from skyfield.api import load
from skyfield.jpllib import SpiceKernel

import earthspin
from earthspin.constants import DAY, J2000_JD, MAS
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.double_double import DoubleDouble
from earthspin.numerics.quaternion import conjugate, rotate
from earthspin.sky.ephemeris import find_kernel
from tests.reference.stepping import integrate, quaternion_rate
from tests.reference.stored import attitude_error

MONTH, ROUNDS, RTOL = ("2000-01-01", "2000-01-31", "6 h"), 5, 1e-12
#: The answer, with its errors, by its effects. DOP853 has none.
ANSWERS: dict[str, Callable[[], xr.Dataset]] = {
    "none": lambda: earthspin.rotation(*MONTH, effects=[]),
    "known": lambda: earthspin.rotation(*MONTH),
}


def plain(start: xr.Dataset) -> FloatArray:
    """Attitude from Euler's equations, without errors."""
    since = start.time.values - np.datetime64("2000-01-01T12")
    seconds = since / np.timedelta64(1, "s")
    hours = np.arange(seconds[0] - DAY, seconds[-1] + DAY, 3600.0)
    kernel = SpiceKernel(find_kernel("de421"))
    at = load.timescale(builtin=True).tdb_jd(J2000_JD, hours / DAY)
    pulls = []
    for body, code in ((earthspin.SUN, 10), (earthspin.MOON, 301)):
        places = (kernel[code] - kernel[399]).at(at).position.m.T
        pulls.append((3 * body.number("gm"), CubicSpline(hours, places)))
    moments = earthspin.EARTH.moments / earthspin.EARTH.moments[2]

    def slope(moment: float, state: FloatArray) -> FloatArray:
        omega, attitude = state[:3], state[3:] / np.linalg.norm(state[3:])
        torque = np.cross(moments * omega, omega)
        for strength, place in pulls:
            r = rotate(conjugate(attitude), place(moment))
            torque += strength / np.linalg.norm(r) ** 5 * np.cross(r, moments * r)
        return np.concatenate([torque / moments, quaternion_rate(attitude, omega)])

    first = np.concatenate([start.omega.values[0], start.attitude.values[0]])
    small = RTOL * np.repeat([7e-5, 1.0], [3, 4])
    states, _ = integrate(slope, first, seconds, RTOL, begin=seconds[0], atol=small)
    attitude = states[:, 3:]
    return np.asarray(attitude / np.linalg.norm(attitude, axis=1, keepdims=True))


def timed(run: Callable[[], Any]) -> tuple[Any, float]:
    """Return what a call returns, and its seconds."""
    begun = time.process_time()
    result = run()
    return result, time.process_time() - begun


def main() -> None:
    """Print the table, as Markdown."""
    print("| effects | earthspin, with errors | DOP853 | ratio | difference |")
    print("|---|---|---|---|---|")
    for name, answer in ANSWERS.items():
        ours = answer()
        rounds = [(timed(answer), timed(partial(plain, ours))) for _ in range(ROUNDS)]
        own, other = (statistics.median(run[way][1] for run in rounds) for way in (0, 1))
        true = DoubleDouble(ours.attitude.values, np.zeros_like(ours.attitude.values))
        apart = attitude_error(rounds[0][1][0], true) / MAS
        print(f"| {name} | {own:.2f} s | {other:.2f} s | {other / own:.1f} | {apart:.1g} mas |")


if __name__ == "__main__":
    main()

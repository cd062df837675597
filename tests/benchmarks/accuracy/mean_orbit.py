"""Mean torque over an orbit given by elements: closed form, windowed averages and sums.

Questions use windowed averages if some perturber does not move on a single ellipse about the body.
"""

import math
from functools import partial

import numpy as np

from earthspin.constants import DAY
from earthspin.numerics.arrays import FloatArray
from earthspin.sky.elements import Ellipse
from earthspin.torque.average import (
    Window,
    mean_square_of_normal,
    mean_tide,
    mean_torque,
    precessing_torque,
)
from earthspin.torque.gravity import torque_from_position
from tests.benchmarks.accuracy.elements import ELEMENTS, ORBIT, PLANE
from tests.benchmarks.accuracy.ladder import Ladder, settings
from tests.reference.stored import load

#: GM of the perturber, m3 s-2, and inclination of the axis to the reference normal, rad.
GM, TILT = 4e14, 0.4
#: Inputs of the stored reference.
INPUTS = ELEMENTS | {"gm": GM, "tilt": TILT}
#: Period of the node, s; length of the window in periods of the node, and days between samples.
CYCLE = 2 * math.pi / abs(ORBIT.node_rate)
WINDOWS = ((3, 4), (3, 2), (3, 1), (4, 1), (6, 1), (8, 1))
AXIS = np.array([math.sin(TILT), 0.0, math.cos(TILT)])
NORMAL = np.array([0.0, 0.0, 1.0])


def ladder() -> Ladder:
    """Methods for the mean torque over an orbit."""
    true = load("mean-orbit", INPUTS)["mean"]
    return Ladder(
        title="Mean torque of an orbit",
        problem=f"mean precessing torque of an orbit of eccentricity {ORBIT.e:g}, inclined by "
        f"{math.degrees(ORBIT.i):.3g} deg, whose node and pericentre precess; the error is "
        "relative",
        reference="sum over anomaly and node with 50 digits, stored with 32",
        unit="1",
        floor=1e-28,
        error=lambda mean: abs(float((mean - true).hi / true.hi)),
        runs={
            "closed form": {"": _closed},
            "sin4 window": {
                f"{turns} turns, {step} d": partial(_by_window, "sin4", turns * CYCLE, step)
                for turns, step in WINDOWS
            },
            "sum over anomaly and node": settings("{} anomalies", _by_sum, (8, 16, 32, 64, 120)),
            "plain mean over years": {
                f"{years:.3g} yr, 1 d": partial(_by_window, "plain", years * 365.25 * DAY, 1)
                for years in (1, 10, CYCLE / DAY / 365.25, 5 * CYCLE / DAY / 365.25)
            },
        },
        bounds={"closed form": 2e-15, "sin4 window": 2e-14},
    )


def _precessing(positions: FloatArray) -> FloatArray:
    return precessing_torque(torque_from_position(GM, 1.0, positions, AXIS), AXIS, NORMAL)


def _closed() -> tuple[FloatArray, int]:
    tide = mean_tide(GM, ORBIT.a, ORBIT.e, mean_square_of_normal(NORMAL, ORBIT.i))
    return precessing_torque(mean_torque(tide, AXIS)[np.newaxis], AXIS, NORMAL)[0], 1


def _by_window(taper: str, length: float, step: float) -> tuple[float, int]:
    window = Window(0.0, 1.0, length, taper)
    times = window.sample_times(step * DAY)
    return float(window.mean(times, _precessing(ORBIT.positions(times / DAY)))), times.size


def _by_sum(count: float) -> tuple[float, int]:
    """Mean torque by a sum over mean anomalies, for four positions of the node 90 deg apart."""
    total, mean = 0.0, 2 * np.pi * np.arange(count) / count
    fixed = {"node_rate": 0.0, "pericentre_rate": 0.0, "mean_anomaly": 0.0, "motion": 1 / DAY}
    for node in np.arange(4) * np.pi / 2:
        orbit = Ellipse(**ELEMENTS | fixed | {"node": node}, plane=PLANE)
        total += float(np.mean(_precessing(orbit.positions(mean)))) / 4
    return total, 4 * int(count)

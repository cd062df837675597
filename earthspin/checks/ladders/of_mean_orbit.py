"""Compare error and run time of methods for the mean torque over an orbit given by elements.

Methods: closed form, windowed averages and sums.

Questions use windowed averages if some perturber does not move on a single ellipse about the body.
"""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from earthspin.checks.ladders.of_elements import ELEMENTS, ORBIT, PLANE, ROUNDING
from tests.reference.stored import load
from earthspin.checks.work_precision import FloatArray, Ladder, Method, Result, Setting, method
from earthspin.constants import DAY
from earthspin.sky.elements import Ellipse
from earthspin.torque.average import Window, precessing_torque
from earthspin.torque.gravity import torque_from_position
from earthspin.torque.mean_orbit import mean_square_of_normal, mean_tide, mean_torque

#: GM of the perturber, m3 s-2, and inclination of the axis to the reference normal, rad.
GM, TILT = 4e14, 0.4
#: Inputs of the stored reference.
INPUTS = ELEMENTS | {"gm": GM, "tilt": TILT}
#: Length of the window in periods of the node, and days between samples.
WINDOWS = ((3, 4), (3, 2), (3, 1), (4, 1), (6, 1), (8, 1))
AXIS = np.array([math.sin(TILT), 0.0, math.cos(TILT)])
NORMAL = np.array([0.0, 0.0, 1.0])


def ladder(quick: bool) -> Ladder:
    """Return the comparison (`Ladder`) of methods for the mean torque over an orbit."""
    true = load("mean-orbit", INPUTS)["mean"]
    cycle = 2 * math.pi / abs(ORBIT.node_rate)
    counts = (8, 32) if quick else (8, 16, 32, 64, 120)
    lengths = (cycle,) if quick else (DAY * 365.25, DAY * 3652.5, cycle, 5 * cycle)
    windows = [
        Setting(f"{turns} turns, {step} d", partial(_by_window, turns, cycle, "sin4", step))
        for turns, step in (WINDOWS[2:4] if quick else WINDOWS)
    ]
    plain = [
        Setting(f"{length / DAY / 365.25:.3g} years, 1 d", partial(_by_window, 1, length))
        for length in lengths
    ]
    return Ladder(
        quantity="mean-orbit",
        unit="1",
        problem=f"mean precessing torque of an orbit of eccentricity {ORBIT.e:g}, inclined by "
        f"{math.degrees(ORBIT.i):.3g} deg, whose node and pericentre precess; the error is "
        "relative",
        subject="the mean torque of an orbit by elements",
        reference="sum over anomaly and node with 50 digits, stored with 32",
        reference_error=ROUNDING,
        methods=[
            method("closed form", "", _closed, bound=2e-15),
            Method("sin4 window", windows, 1e-8 if quick else 2e-14),
            method("sum over anomaly and node", "{} anomalies", _by_sum, counts),
            Method("plain mean over years", plain),
        ],
        error=lambda mean: abs(float((mean - true).hi / true.hi)),
        useful=0.1,
    )


def _precessing(positions: FloatArray) -> FloatArray:
    return precessing_torque(torque_from_position(GM, 1.0, positions, AXIS), AXIS, NORMAL)


def _closed() -> Result:
    tide = mean_tide(GM, ORBIT.a, ORBIT.e, mean_square_of_normal(NORMAL, ORBIT.i))
    return precessing_torque(mean_torque(tide, AXIS)[np.newaxis], AXIS, NORMAL)[0], 1


def _by_window(turns: float, cycle: float, taper: str = "plain", step: float = 1.0) -> Result:
    window = Window(0.0, turns, cycle, taper)
    times = window.sample_times(step * DAY)
    return float(window.mean(times, _precessing(ORBIT.positions(times / DAY)))), times.size


def _by_sum(count: float) -> Result:
    """Mean precessing torque by a sum over mean anomalies, for four positions of the node.

    The nodes of the four orbits are 90 degrees apart.
    """
    total, mean = 0.0, 2 * np.pi * np.arange(int(count)) / int(count)
    fixed = {"node_rate": 0.0, "pericentre_rate": 0.0, "mean_anomaly": 0.0, "motion": 1 / DAY}
    for node in np.arange(4) * np.pi / 2:
        orbit = Ellipse(**ELEMENTS | fixed | {"node": node}, plane=PLANE)
        total += float(np.mean(_precessing(orbit.positions(mean)))) / 4
    return total, 4 * int(count)

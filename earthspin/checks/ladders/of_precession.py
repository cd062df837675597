"""Compare error and run time of methods for the mean precession rate.

Methods: tapers, window lengths, steps, plain means.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np

from earthspin.checks.ladders import model_sky
from earthspin.checks.work_precision import FloatArray, Ladder, Method, Result, Setting
from earthspin.constants import DAY, JULIAN_YEAR
from earthspin.torque.average import TAPERS, Window

#: Central epochs of the averages, d from J2000.0, at different phases of the Moon.
EPOCHS: FloatArray = np.asarray(np.arange(-6, 7) * 1237.0)
#: Points along the four angles for the mean over infinite time; fewer change it by 1e-14.
TORUS = (24, 16, 24, 16)
#: Length of the window in periods of the node, and days between samples, from coarse to fine.
WINDOWS = ((3, 6), (3, 3), (3, 2), (4, 2), (5, 2), (6, 2), (7, 2), (8, 2), (8, 1))
QUICK_WINDOWS = ((3, 3), (4, 2))
#: Lengths of plain means, years.
PLAIN_YEARS = (1.0, 18.0, 18.6, 19.0, 150.0)
#: Largest allowed error of each taper with its longest window: for tapers, the claimed long-period
#: variation with the real Moon. The model also has one: 4.1e-8 in 184 years, the period of the
#: perigee relative to twice the node (3D + 3l' - l - 2F), which is longer than any window.
BOUNDS = {"plain": 1e-3, "hann": 2e-7, "sin4": 2e-7, "blackman-harris": 2e-7}
QUICK_BOUND = 1e-3


def ladder(quick: bool) -> Ladder:
    """Return the comparison (`Ladder`) of methods for the mean precession rate."""
    epochs = EPOCHS[::4] if quick else EPOCHS
    true, cycle = model_sky.torus_mean(TORUS), model_sky.node_period()
    windows, years = (QUICK_WINDOWS, PLAIN_YEARS[1:3]) if quick else (WINDOWS, PLAIN_YEARS)
    tapered = [
        Method(
            taper,
            [
                _setting(f"{turns} turns, {step} d", taper, turns * cycle, step, epochs)
                for turns, step in windows
            ],
            QUICK_BOUND if quick else BOUNDS[taper],
        )
        for taper in TAPERS
    ]
    plain = [
        _setting(f"{n:g} year{'s' * (n > 1)}, 1 d", "plain", n * JULIAN_YEAR, 1, epochs)
        for n in years
    ]
    return Ladder(
        quantity="precession",
        unit="1",
        problem="mean rate of precession under a model Sun and Moon (Kepler's ellipse; main terms "
        f"of ELP2000-82), from torques in a window; the error is the largest of {epochs.size} "
        "epochs, relative",
        subject="the mean rate of precession of a model Sun and Moon",
        reference="mean over the torus of the four angles of the model, by the trapezoid rule, "
        "without any window",
        reference_error=1e-14,
        methods=[*tapered, Method("plain mean over years", plain)],
        error=lambda means: float(np.max(np.abs(np.asarray(means) / true - 1))),
        useful=0.1,
    )


def _setting(words: str, taper: str, length: float, step: int, epochs: FloatArray) -> Setting:
    """Make a `Setting` that is timed at one epoch, and whose error is taken at many epochs."""

    def mean_about(
        epoch: float, torque: Callable[[FloatArray], FloatArray] = _daily_torque
    ) -> tuple[float, int]:
        window = Window(epoch * DAY, 1.0, length, taper)
        times = window.sample_times(step * DAY)
        return float(window.mean(times, torque(times))), times.size

    def run() -> Result:
        mean, size = mean_about(0.0, model_sky.precessing_at)
        return [mean], size

    return Setting(words, run, lambda: [mean_about(epoch)[0] for epoch in epochs])


def _daily_torque(times: FloatArray) -> FloatArray:
    """Precessing torque at whole days, looked up in a stored daily series."""
    first, series = _series()
    return np.asarray(series[np.rint(times / DAY).astype(int) - first])


@cache
def _series() -> tuple[int, FloatArray]:
    """Compute a daily series of precessing torques; return its first day and the values."""
    longest = max(turns for turns, _ in WINDOWS) * model_sky.node_period() / DAY
    reach = int(max(longest, max(PLAIN_YEARS) * 365.25) / 2 + np.max(np.abs(EPOCHS))) + 2
    return -reach, model_sky.precessing_at(np.arange(-reach, reach + 1.0) * DAY)

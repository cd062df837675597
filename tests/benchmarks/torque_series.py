"""The torque series against the way a user would write it with Skyfield, as ratios.

Run it with `python tests/benchmarks/torque_series.py`; both ways are timed in one process, in
turn, and the median of the ratios is printed with its spread. Times are of the processor, because
others may share the machine. It asserts the agreement of the numbers, never a time.
"""

from __future__ import annotations

import statistics
import time
import warnings

import numpy as np
import skyfield_data
from skyfield.api import Loader

import earthspin
from earthspin import MOON, SUN
from earthspin.bodies import EARTH

RUNS = 5


def obvious_series(days: np.ndarray, loader: Loader) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """A fresh time for each body, `radec(epoch='date')`, then formula (I.8.7)."""
    kernel, scale = loader("de421.bsp"), loader.timescale(builtin=True)
    bulge = EARTH.j2 * EARTH.mass * EARTH.radius**2
    found = {}
    for name, gm in (("sun", SUN.gm), ("moon", MOON.gm)):
        t = scale.tdb_jd(2451545.0 + days)
        ra, dec, distance = (kernel[name] - kernel["earth"]).at(t).radec(epoch="date")
        size = -3 * gm * bulge / distance.m**3 * np.sin(dec.radians) * np.cos(dec.radians)
        torque = np.stack(
            [-size * np.sin(ra.radians), size * np.cos(ra.radians), 0 * size], axis=-1
        )
        found[name] = dec.radians, torque
    return found


def compare(label: str, size: int, minutes: float, equator: str, sample: int) -> None:
    """Time both ways and say how far the declinations are apart.

    Parameters
    ----------
    label : str
    size : int
        Epochs of our series.
    minutes : float
        Between epochs.
    equator : str
    sample : int
        Epochs of the obvious way, which takes minutes at full size; cost is per epoch.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        loader = Loader(skyfield_data.get_skyfield_data_path(), verbose=False)
    days = np.arange(size) * minutes / 1440
    times = np.datetime64("2000-01-01T12:00", "us") + (days * 86400e6).round().astype("m8[us]")
    earthspin.torque_series(times=times[:2], equator=equator)  # imports and caches
    ratios, ours, theirs = [], [], []
    for _ in range(RUNS):
        begun = time.process_time()
        series = earthspin.torque_series(times=times, equator=equator)
        ours.append((time.process_time() - begun) / size)
        chosen = np.linspace(0, size - 1, sample).round().astype(int)
        begun = time.process_time()
        obvious = obvious_series(days[chosen], loader)
        theirs.append((time.process_time() - begun) / sample)
        ratios.append(theirs[-1] / ours[-1])
    worst = max(
        float(
            np.max(np.abs(np.radians(series.declination.sel(perturber=name).values[chosen]) - dec))
        )
        for name, (dec, _) in obvious.items()
    )
    print(
        f"{label}: ours {statistics.median(ours) * 1e6:.2f} us an epoch, Skyfield "
        f"{statistics.median(theirs) * 1e6:.1f}; ratio {statistics.median(ratios):.0f} "
        f"({min(ratios):.0f} to {max(ratios):.0f}); declinations differ by {worst:.1e} rad"
    )
    if equator == "true":
        assert worst < 1e-8


if __name__ == "__main__":
    compare("mean equator, 1e5 epochs", 100_000, 60, "mean", 100_000)
    compare("true equator, 1e6 epochs at 10 min", 1_000_000, 10, "true", 100_000)

"""Scatter of averages about a smooth rate, by taper and length of the window."""

from __future__ import annotations

import argparse

import numpy as np
from numpy.polynomial import Chebyshev

from earthspin.bodies import EARTH, MOON, SUN
from earthspin.constants import ARCSEC_PER_YEAR, DAY
from earthspin.sky.ephemeris import Ephemeris, open_ephemeris
from earthspin.sky.poles import IAU_2006
from earthspin.torque.average import Window, precessing_torque, window_mean_and_error
from earthspin.torque.gravity import torque_from_position
from earthspin.torque.rates import precession_rate

CASES = (
    ("plain", 2),
    ("hann", 2),
    ("hann", 3),
    ("sin4", 3),
    ("sin4", 4),
    ("sin4", 5),
    ("sin4", 8),
    ("blackman-harris", 5),
    ("sin4", 4.5),
    ("blackman-harris", 4.5),
)
MAS_PER_CENTURY = 1e5 / ARCSEC_PER_YEAR
SPACING = 1500 * DAY
DEGREE = 6  # of the smooth curve through all windows


def rates(kernel: Ephemeris, half_span: float) -> tuple[np.ndarray, np.ndarray]:
    """Daily rates of precession, mas per century, by Sun and Moon, and their times, s."""
    days = np.arange(-half_span, half_span + 1)
    axis = IAU_2006.equator(None, days)[:, 2]
    normal = IAU_2006.orbit_normal(None)
    place = kernel.positions({"sun": 10, "moon": 301}, 399, days)
    precessing = [
        precessing_torque(torque_from_position(b.gm, 1.0, place[b.name], axis), axis, normal)
        for b in (SUN, MOON)
    ]
    rate = precession_rate(
        np.stack(precessing, axis=1), EARTH.dynamical_flattening, EARTH.spin_rate
    )
    return np.asarray(rate) * MAS_PER_CENTURY, days * DAY


def scatter(
    rate: np.ndarray, times: np.ndarray, taper: str, cycles: float, centres: np.ndarray
) -> tuple[float, float, float]:
    """Rms and largest distance from a smooth curve, and the share within the error claimed."""
    cycle = MOON.cycle
    swing = np.array([SUN.slow_swing, MOON.slow_swing])
    means, errors = [], []
    for centre in centres:
        window = Window(float(centre), cycles, cycle, taper)
        inside = np.abs(times - centre) <= window.length / 2
        mean, error = window_mean_and_error(window, times[inside], rate[inside], swing)
        means.append(float(mean[-1]))
        errors.append(float(error[-1]))
    off = np.abs(means - Chebyshev.fit(centres, means, DEGREE)(centres))
    return float(np.sqrt(np.mean(off**2))), float(off.max()), float(np.mean(off <= errors))


def main(arguments: argparse.Namespace) -> int:
    """Print the table."""
    kernel = open_ephemeris(arguments.kernel)
    half_span = min(abs(day) for day in kernel.coverage({10, 301, 399})) - 1
    rate, times = rates(kernel, half_span)
    reach = times[-1] - 4.01 * MOON.cycle
    centres = np.arange(-reach, reach, SPACING)
    print(f"{centres.size} windows, mas per century")
    print("taper             turns        rms    largest   within the error")
    for taper, cycles in CASES:
        rms, largest, share = scatter(rate, times, taper, cycles, centres)
        print(f"{taper:<16} {cycles:>6} {rms:>10.3g} {largest:>10.3g} {share:>10.0%}")
    return 0

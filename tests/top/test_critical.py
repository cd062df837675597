"""Tops near the upright: close to the critical spin, and unstable, let go at rest.

There a^2 - 2 beta, a - 2 phi' and u - u(0) are small differences, although the start determines
them exactly. The reference is the textbook's form at ninety digits.
"""

from collections.abc import Iterator

import mpmath as mp
import numpy as np

from earthspin.top.closed_form import error_bound, heavy_top_motion
from earthspin.top.height import nutation_of, nutation_period
from earthspin.top.start import HeavyTop
from tests.top.families import Start
from tests.top.textbook import Textbook

DIGITS = 90


def near_critical(count: int) -> Iterator[Start]:
    """Spin and phi' off their critical values by 1e-14 to 1e-3, with inclinations from 1e-8."""
    rng = np.random.default_rng(7)
    for _ in range(count):
        axial, weight = rng.choice([1.0, rng.uniform(0.3, 1.9)]), rng.uniform(0.3, 3)
        theta, critical = 10 ** rng.uniform(-8, -1), 2 * np.sqrt(weight)
        first, second = rng.choice([-1, 1], 2) * 10 ** rng.uniform(-14, -3, 2)
        pace = rng.choice([0.0, theta * 10 ** rng.uniform(-6, 0)])
        start = {
            "transverse_moment": 1.0,
            "axial_moment": axial,
            "weight_moment": weight,
            "theta": theta,
            "spin": critical / axial * (1 + first),
            "phi_rate": critical / 2 * (1 + rng.choice([0, first, second])),
            "theta_rate": pace,
        }
        yield {name: float(value) for name, value in start.items()}


def exact_theta(start: Start, times: list[float]) -> tuple[list[mp.mpf], mp.mpf]:
    """Inclination at times, and period of nutation."""
    book = Textbook.with_roots_only(start)
    swing = book.high - book.low
    part = (mp.cos(mp.mpf(start["theta"])) - book.low) / swing
    angle = mp.asin(mp.sqrt(min(max(part, mp.mpf(0)), mp.mpf(1))))
    phase = mp.ellipf(angle, book.m) * (-1 if start["theta_rate"] > 0 else 1)
    heights = [
        book.low + swing * mp.ellipfun("sn", phase + book.rate * mp.mpf(time), m=book.m) ** 2
        for time in times
    ]
    theta = [2 * mp.atan2(mp.sqrt(1 - u), mp.sqrt(1 + u)) for u in heights]
    return theta, 2 * mp.ellipk(book.m) / book.rate


def test_near_the_critical_spin_nothing_cancels() -> None:
    """Measured in 500 cases: theta 1.2e-14 of itself, period 5e-16; before, up to 1e-4 and 5e-5."""
    times = [0.0, 0.7, 5.0, 30.0]
    for start in near_critical(12):
        with mp.workdps(DIGITS):
            exact, period = exact_theta(start, times)
            top = HeavyTop(**start)
            found = heavy_top_motion(top, times).theta
            off = [float(abs(x / y - 1)) for x, y in zip(map(mp.mpf, found), exact, strict=True)]
            assert max(off) < 3e-14, start
            assert abs(float(nutation_period(nutation_of(top)) / period - 1)) < 1e-14, start
        assert error_bound(top, np.array(times)) < 1e-10  # before, up to 2e-4


def test_the_angular_velocity_of_an_unstable_top_at_rest_near_the_upright() -> None:
    """Measured: 1e-14 of the largest up to each time; before, 2e-11."""
    times = np.array([1.0, 4.0, 8.0, 12.0, 16.0])
    for theta, spin in ((1e-6, 1.4), (1e-7, 0.3), (1e-4, 1.9)):
        start = {
            "transverse_moment": 1.0,
            "axial_moment": 1.0,
            "weight_moment": 1.0,
            "theta": theta,
            "spin": spin,
        }
        found = heavy_top_motion(HeavyTop(**start), times).omega_body
        with mp.workdps(DIGITS):
            book = Textbook(start)
            exact = [complex(book.at(time).transverse) for time in times]
        off = np.abs(found[:, 0] + 1j * found[:, 1] - exact)
        assert np.max(off / np.abs(exact)) < 5e-14

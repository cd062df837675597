"""Roots of the cubic, turning points and the effective potential."""

from collections.abc import Mapping
from typing import Any

import mpmath as mp
import numpy as np
import pytest

from earthspin.errors import BodyError
from earthspin.top.azimuth import mean_precession_rate
from earthspin.top.closed_form import heavy_top_motion
from earthspin.top.height import (
    cubic_roots,
    effective_potential,
    nutation_of,
    nutation_period,
    turning_angles,
)
from earthspin.top.start import HeavyTop, top_constants
from tests.top.families import FAMILIES, cases
from tests.top.textbook import DIGITS, Textbook

CASES = 40


def _turning(start: Mapping[str, Any]) -> list[Any]:
    """Turning angles and period, by Viete's formula at many digits."""
    book = Textbook.with_roots_only(start)
    angles = (2 * mp.atan2(mp.sqrt(1 - u), mp.sqrt(1 + u)) for u in (book.high, book.low))
    return [*angles, 2 * mp.ellipk(book.m) / book.rate]


@pytest.mark.parametrize("family", FAMILIES)
def test_turning_angles_and_period_are_as_good_as_the_start(family: str) -> None:
    """1e-13, or the effect of one unit in the last place of the inputs (measured: 0.4 of it)."""
    for start in cases(family, CASES):
        top = HeavyTop(**start)
        found = [
            *map(float, turning_angles(nutation_of(top))),
            float(nutation_period(nutation_of(top))),
        ]
        with mp.workdps(DIGITS):
            exact = _turning(start)
            off = [abs(float(f / e - 1)) for f, e in zip(found, exact, strict=True)]
            if max(off) <= 1e-13:
                continue
            effect = np.zeros(3)
            for name, value in start.items():
                if value:
                    step = mp.mpf(value) + mp.mpf(float(np.spacing(value)))
                    moved = _turning(start | {name: step})
                    effect += [abs(float(m / e - 1)) for m, e in zip(moved, exact, strict=True)]
        assert np.all(off <= np.maximum(1e-13, effect)), (start, off, effect)


@pytest.mark.parametrize("family", ["generic", "cusp", "near-pole", "pendulum"])
def test_roots_solve_the_cubic(family: str) -> None:
    """Vieta's formulas for beta u^3 - (alpha + a^2) u^2 + (2ab - beta) u + alpha - b^2."""
    for start in cases(family, 100):
        top = HeavyTop(**start)
        a, b, alpha, beta = top_constants(top)
        r = cubic_roots(top)
        size = np.prod(1 + np.abs(r))
        assert np.all(np.diff(r) >= 0)
        assert beta * r.sum() == pytest.approx(alpha + a * a, abs=3e-14 * abs(beta) * size)
        pairs = r[0] * r[1] + r[1] * r[2] + r[2] * r[0]
        assert beta * pairs == pytest.approx(2 * a * b - beta, abs=3e-14 * abs(beta) * size)
        assert beta * r.prod() == pytest.approx(b * b - alpha, abs=3e-14 * abs(beta) * size)


def test_without_weight_the_third_root_is_infinite() -> None:
    top = HeavyTop(transverse_moment=1, axial_moment=1, weight_moment=0, theta=1, spin=2)
    assert cubic_roots(top)[2] == np.inf


def test_double_root_of_a_released_hanging_top_is_exact() -> None:
    """At rest straight down: the axis stays, the nutation has its small-swing period."""
    top = HeavyTop(transverse_moment=2, axial_moment=1, weight_moment=3, theta=np.pi, spin=0)
    assert np.array_equal(turning_angles(nutation_of(top)), [np.pi, np.pi])
    # sqrt(m g r/I1) for the pendulum, and theta comes to zero twice in each of its periods
    assert nutation_period(nutation_of(top)) == pytest.approx(
        np.pi / np.sqrt(3 / 2), rel=4e-16, abs=0
    )


def test_turning_points_are_where_the_effective_potential_meets_alpha() -> None:
    for start in cases("generic", 100):
        top = HeavyTop(**start)
        alpha = top_constants(top).alpha
        meets = effective_potential(top, turning_angles(nutation_of(top)))
        away = effective_potential(top, turning_angles(nutation_of(top)) * (1 + 1e-7))
        steepness = np.abs(away - meets) / 1e-7
        # measured 5e-15, close to a pole, where b and a nearly cancel
        assert np.all(np.abs(meets - alpha) <= 3e-14 * (abs(alpha) + steepness)), start


def test_effective_potential_on_the_poles() -> None:
    """Infinite, but for a top that can come there; and no warning."""
    top = HeavyTop(transverse_moment=1, axial_moment=1, weight_moment=1, theta=1, spin=2)
    assert np.all(np.isinf(effective_potential(top, [0.0, np.pi])))
    sleeping = HeavyTop(transverse_moment=1, axial_moment=1, weight_moment=1, theta=0, spin=2)
    assert effective_potential(sleeping, 0.0) == 2.0
    with pytest.raises(BodyError, match=r"theta = -1\.0"):
        effective_potential(top, -1.0)


def test_effective_potential_is_that_of_the_source() -> None:
    top = HeavyTop(
        transverse_moment=1.3, axial_moment=0.9, weight_moment=2.0, theta=1.0, spin=4, phi_rate=0.6
    )
    a, b, _, beta = top_constants(top)
    theta = np.linspace(0.05, 3.1, 50)
    printed = (b - a * np.cos(theta)) ** 2 / np.sin(theta) ** 2 + beta * np.cos(theta)
    np.testing.assert_allclose(effective_potential(top, theta), printed, rtol=1e-14)


@pytest.mark.parametrize("family", ["generic", "cusp", "weightless", "fast", "near-steady"])
def test_phi_advances_by_the_mean_precession_in_each_period(family: str) -> None:
    for start in cases(family, 20):
        top = HeavyTop(**start)
        period = float(nutation_period(nutation_of(top)))
        motion = heavy_top_motion(top, [0.13 * period, 5.13 * period])
        mean = np.diff(motion.phi)[0] / (5 * period)
        assert mean == pytest.approx(
            float(mean_precession_rate(top, nutation_of(top))), rel=3e-14, abs=3e-15 / period
        )  # 2.9e-15 of the rate, and 4e-16 of a radian where there is none

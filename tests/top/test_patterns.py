"""Waves, cusps and loops: each pattern against what the tip of the axis does."""

from dataclasses import replace

import mpmath as mp
import numpy as np
import pytest

import earthspin
from earthspin.top.closed_form import heavy_top_motion
from earthspin.top.patterns import nutation_pattern, steady_precession
from earthspin.top.start import HeavyTop, axis_start, top_constants
from earthspin.views.rendering import tables_for
from tests.top.families import FAMILIES, cases
from tests.top.textbook import DIGITS, Textbook

BODY = {"transverse_moment": 1.25, "axial_moment": 0.75, "weight_moment": 2.0}


def phi_rates(top: HeavyTop) -> np.ndarray:
    """phi' through one nutation, from the angular velocity of the body (I.7.3)."""
    period = float(heavy_top_motion(top, 0.0).nutation_period)
    motion = heavy_top_motion(top, np.linspace(0, period, 1001))
    one, two, _ = motion.omega_body.T
    return (one * np.sin(motion.psi) + two * np.cos(motion.psi)) / np.sin(motion.theta)


@pytest.mark.parametrize("family", [name for name in FAMILIES if name != "cusp"])
def test_loops_have_opposite_precession_at_the_turning_points(family: str) -> None:
    """The sign of b - a u at u1 and u2, but for cusps and steady motion."""
    for start in cases(family, 200):
        found = nutation_pattern(axis_start(HeavyTop(**start)))
        with mp.workdps(DIGITS):
            book = Textbook.with_roots_only(start)
            low, high = (book.b - book.a * u for u in (book.low, book.high))
            size = abs(book.b) + abs(book.a)
            close = min(abs(low), abs(high), abs(book.high - book.low) * abs(book.a)) < 1e-13 * size
        assert found == ("loop" if low * high < 0 else "wave") or close, start


@pytest.mark.parametrize("family", ["generic", "weightless", "pendulum"])
def test_loops_turn_back_and_waves_do_not(family: str) -> None:
    seen = set()
    for start in cases(family, 40):
        top = HeavyTop(**start)
        rates = phi_rates(top)
        turns_back = rates.min() < 0 < rates.max()
        assert nutation_pattern(axis_start(top)) == ("loop" if turns_back else "wave"), start
        seen.add(turns_back)
    assert seen == ({False} if family == "pendulum" else {True, False})


def test_let_go_at_rest_the_tip_draws_cusps_from_its_upper_turning_point() -> None:
    for start in cases("cusp", 40):
        top = HeavyTop(**start)
        motion = heavy_top_motion(top, 0.0)
        assert motion.pattern == "cusp"
        standing = start["weight_moment"] > 0
        assert motion.turning_angle[0 if standing else 1] == pytest.approx(
            start["theta"], rel=1e-15, abs=0
        )
        rates = phi_rates(top)
        assert np.all(
            np.sign(start["spin"] * start["weight_moment"]) * rates >= -1e-12 * rates.max()
        )


@pytest.mark.parametrize("weight", [2.0, -2.0])
@pytest.mark.parametrize("theta_rate", [0.0, 0.1])
def test_patterns_change_at_their_limits_and_only_there(weight: float, theta_rate: float) -> None:
    top = HeavyTop(**BODY | {"weight_moment": weight}, theta=1.1, spin=6.0, theta_rate=theta_rate)
    a, _, _, beta = top_constants(top)
    # Rates for which the tip comes to rest at b = a u, and for which it passes over a pole.
    cusps = np.roots([a, -beta, a * (theta_rate / np.sin(1.1)) ** 2])
    over_poles = [a / (1 + np.cos(1.1)), -a / (1 - np.cos(1.1))]
    marks = np.sort(np.concatenate([cusps, over_poles]))
    names = ["wave", "loop", "wave", "loop", "wave"]
    between = np.concatenate([[marks[0] - 1], (marks[1:] + marks[:-1]) / 2, [marks[-1] + 1]])
    for phi_rate, name in zip(between, names, strict=True):
        one = replace(top, phi_rate=phi_rate)
        rates = phi_rates(one)
        assert nutation_pattern(axis_start(one)) == name
        assert (rates.min() < 0 < rates.max()) == (name == "loop")
    for mark in cusps:
        one = replace(top, phi_rate=mark)
        assert nutation_pattern(axis_start(one)) == "cusp"
        assert np.abs(phi_rates(one)).min() < 1e-4 * np.abs(phi_rates(one)).max()
    for mark, theta in zip(over_poles, (0, 1), strict=True):
        motion = heavy_top_motion(replace(top, phi_rate=mark), 0.0)
        assert motion.turning_angle[theta] == pytest.approx(np.pi * theta, abs=1e-15)


def test_from_the_lower_turning_point_the_cusp_is_at_twice_the_slow_precession() -> None:
    """phi' = 2 m g r/(I3 omega3) there, whatever theta: b = a u2 and alpha = beta u2."""
    for theta in (0.3, 1.2, 2.0):
        top = HeavyTop(**BODY, theta=theta, spin=9.0)
        top = replace(top, phi_rate=2 * 2.0 / (0.75 * 9.0))
        motion = heavy_top_motion(top, 0.0)
        assert motion.pattern == "cusp"
        assert motion.turning_angle[1] == pytest.approx(theta, rel=1e-15, abs=0)
        a, b, alpha, beta = top_constants(top)
        assert np.cos(motion.turning_angle[0]) == pytest.approx(b / a, rel=1e-14, abs=0)
        assert b / a == pytest.approx(alpha / beta, rel=1e-14, abs=0)


@pytest.mark.parametrize("which", ["slow", "fast"])
@pytest.mark.parametrize("theta", [0.2, 1.0, np.pi / 2, 2.3])
def test_steady_precession_is_told_within_rounding(which: str, theta: float) -> None:
    top = HeavyTop(**BODY, theta=theta, spin=20.0)
    if which == "fast" and theta == np.pi / 2:
        theta = 1.57
        top = replace(top, theta=theta)
    steady = replace(top, phi_rate=getattr(steady_precession(top), which))
    assert nutation_pattern(axis_start(steady)) == "steady"
    assert (
        nutation_pattern(axis_start(replace(steady, phi_rate=steady.phi_rate * (1 + 1e-12))))
        != "steady"
    )
    motion = heavy_top_motion(steady, np.linspace(0, 10, 50))
    np.testing.assert_allclose(motion.theta, theta, rtol=3e-15)
    np.testing.assert_allclose(motion.phi, steady.phi_rate * np.linspace(0, 10, 50), rtol=5e-15)


@pytest.mark.parametrize(
    ("weight", "theta", "spin", "stability", "pattern"),
    [  # the critical spin is 2 sqrt(I1 m g r)/I3 (Goldstein, section 5.7): here sqrt(8)
        (2, 0.0, 2.0, "unstable", "steady"),
        (2, 0.0, 8**0.5, "critical", "sleeping"),
        (2, 0.0, 4.0, "stable", "sleeping"),
        (2, np.pi, 0.0, "stable", "sleeping"),
        (-2, np.pi, -2.0, "unstable", "steady"),
        (-2, 0.0, 0.0, "stable", "sleeping"),
        (0, 0.0, 0.0, "stable", "sleeping"),
        (2, 0.5, 2.0, "unstable", "cusp"),
    ],
)
def test_a_top_says_whether_it_stays_upright(
    weight: float, theta: float, spin: float, stability: str, pattern: str
) -> None:
    top = earthspin.heavy_top(
        [0, 1], transverse_moment=1, axial_moment=1, weight_moment=weight, theta=theta, spin=spin
    )
    assert (str(top.stability.values), str(top.pattern.values)) == (stability, pattern)
    falls = weight * np.cos(theta) > 0
    margin = spin**2 / 8 - 1 if falls else np.inf
    assert float(top.stability_margin) == pytest.approx(margin, rel=1e-15, abs=1e-15)
    rows = dict(row for table in tables_for(top) for row in table.rows if len(row) == 2)
    assert any("stability" in name for name in rows)


def test_asleep_on_either_end_whatever_the_spin() -> None:
    for theta in (0.0, np.pi):
        for spin in (0.0, 0.1, 30.0):
            top = HeavyTop(**BODY, theta=theta, spin=spin, phi_rate=0.5)
            motion = heavy_top_motion(top, [0.0, 2.0])
            falls = theta == 0 and spin < 30  # the critical spin
            assert motion.pattern == ("steady" if falls else "sleeping")
            assert np.all(motion.theta == theta)
            assert motion.phi[1] == 1.0
            assert motion.psi[1] == pytest.approx(
                2 * (spin - 0.5 * np.cos(theta)), rel=1e-15, abs=0
            )
            assert np.all(motion.omega_body == [0.0, 0.0, spin])


def test_over_a_pole_and_in_a_plane_there_are_no_loops() -> None:
    assert (
        nutation_pattern(axis_start(HeavyTop(**BODY, theta=0.0, theta_rate=1.0, spin=2.0)))
        == "wave"
    )
    assert nutation_pattern(axis_start(HeavyTop(**BODY, theta=1.0, spin=0.0))) == "wave"

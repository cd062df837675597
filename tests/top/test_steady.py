"""Steady precession and the sleeping top."""

from dataclasses import replace

import mpmath as mp
import numpy as np
import pytest

from earthspin.errors import UndefinedError
from earthspin.top.closed_form import heavy_top_motion
from earthspin.top.height import nutation_of, nutation_period, turning_angles
from earthspin.top.patterns import minimum_spin, sleeping_top, steady_precession
from earthspin.top.start import HeavyTop
from tests.reference.heavy_top import integrate_heavy_top

I1, I3, WEIGHT = 1.25, 0.75, 2.0
BODY = {"transverse_moment": I1, "axial_moment": I3, "weight_moment": WEIGHT}


@pytest.mark.parametrize("weight", [2.0, -2.0, 1e-9, 0.0])
@pytest.mark.parametrize("theta", [0.01, 1.0, 2.0, 3.0])
@pytest.mark.parametrize("spin", [12.0, -12.0, 1e5])
def test_rates_solve_the_condition_of_no_nutation(weight: float, theta: float, spin: float) -> None:
    """I1 cos(theta) phi'^2 - I3 omega3 phi' + m g r = 0, at fifty digits."""
    top = HeavyTop(**BODY | {"weight_moment": weight}, theta=theta, spin=spin)
    slow, fast = steady_precession(top)
    with mp.workdps(50):
        cosine, momentum = mp.cos(mp.mpf(theta)), mp.mpf(I3) * spin
        root = mp.sqrt(momentum**2 - 4 * I1 * mp.mpf(weight) * cosine)
        roots = sorted(((momentum + sign * root) / (2 * I1 * cosine) for sign in (-1, 1)), key=abs)
        assert float(slow) == pytest.approx(float(roots[0]), rel=4e-15, abs=0)
        assert float(fast) == pytest.approx(float(roots[1]), rel=4e-15, abs=0)


def test_a_steady_top_stays_steady_in_the_full_equations() -> None:
    top = HeavyTop(**BODY, theta=0.8, spin=8.0)
    steady = replace(top, phi_rate=steady_precession(top).fast)
    found = integrate_heavy_top(steady, np.linspace(0, 5, 20))
    w, x, y, z = found.attitude.T
    assert np.ptp(w * w + z * z - x * x - y * y) < 1e-11  # measured 1.3e-12


def test_slow_precession_tends_to_its_limit() -> None:
    """The slow rate is m g r/(I3 omega3) (1 + I1 m g r cos/(I3 omega3)^2 + ...)."""
    for spin in (1e2, 1e4, 1e6):
        top = HeavyTop(**BODY, theta=1.0, spin=spin)
        beyond = steady_precession(top).slow / (WEIGHT / (I3 * spin)) - 1
        expected = I1 * WEIGHT * np.cos(1.0) / (I3 * spin) ** 2
        assert beyond == pytest.approx(expected, rel=1e-2, abs=1e-15)


def test_level_tops_have_only_the_slow_precession() -> None:
    top = HeavyTop(**BODY, theta=np.pi / 2, spin=5.0)
    assert steady_precession(top).slow == pytest.approx(WEIGHT / (I3 * 5.0), rel=1e-15, abs=0)
    assert np.abs(steady_precession(top).fast) > 1e15


def test_conical_pendulum_goes_either_way() -> None:
    """phi'^2 = m g r/(I1 |cos(theta)|) without spin."""
    top = HeavyTop(**BODY, theta=2.5, spin=0.0)
    rate = np.sqrt(WEIGHT / (I1 * np.abs(np.cos(2.5))))
    assert steady_precession(top) == pytest.approx((rate, -rate), rel=1e-15, abs=0)
    with pytest.raises(UndefinedError, match="too slow"):
        steady_precession(HeavyTop(**BODY, theta=1.0, spin=0.0))


def test_the_minimum_spin_is_where_slow_and_fast_meet() -> None:
    top = HeavyTop(**BODY, theta=0.7, spin=0.0)
    least = minimum_spin(top)
    assert least**2 == pytest.approx(4 * I1 * WEIGHT * np.cos(0.7) / I3**2, rel=1e-15, abs=0)
    slow, fast = steady_precession(replace(top, spin=least))
    assert slow == pytest.approx(fast, rel=1e-7, abs=0)
    with pytest.raises(UndefinedError, match=f"at least {least:.6g} rad/s"):
        steady_precession(replace(top, spin=least * (1 - 1e-9)))
    assert minimum_spin(replace(top, theta=2.0)) == 0.0
    assert minimum_spin(replace(top, weight_moment=-1.0)) == 0.0


def test_critical_spin_of_the_sleeping_top() -> None:
    critical = sleeping_top(HeavyTop(**BODY, theta=0.0, spin=0.0)).critical_spin
    assert critical**2 == pytest.approx(4 * I1 * WEIGHT / I3**2, rel=1e-15, abs=0)
    hanging = sleeping_top(HeavyTop(**BODY | {"weight_moment": -2.0}, theta=0.0, spin=0.0))
    assert hanging.critical_spin == 0.0
    assert hanging.stable


@pytest.mark.parametrize("below", [0.9, 0.1, 1e-3, 1e-6])
def test_just_below_the_critical_spin_it_falls_so_far(below: float) -> None:
    """From a push of nothing to cos(theta/2) = omega3/critical, growing at the rate given."""
    upright = HeavyTop(**BODY, theta=0.0, spin=0.0)
    spin = sleeping_top(upright).critical_spin * (1 - below)
    fate = sleeping_top(replace(upright, spin=spin))
    assert not fate.stable
    assert fate.fall_angle == pytest.approx(2 * np.arccos(1 - below), rel=2e-10, abs=0)
    push = 1e-9 * fate.growth_rate
    pushed = replace(upright, spin=spin, theta_rate=push)
    assert turning_angles(nutation_of(pushed))[1] == pytest.approx(
        fate.fall_angle, rel=3e-10, abs=0
    )
    # theta = (push/rate) sinh(rate t) while it is small
    times = np.array([1.0, 3.0]) / fate.growth_rate
    found = heavy_top_motion(pushed, times).theta
    np.testing.assert_allclose(found, 1e-9 * np.sinh([1.0, 3.0]), rtol=1e-6)


@pytest.mark.parametrize("above", [1e-6, 1e-3, 0.1, 3.0])
def test_just_above_the_critical_spin_it_nods(above: float) -> None:
    """A small push comes back after one small nutation, at the difference of the two rates."""
    upright = HeavyTop(**BODY, theta=0.0, spin=0.0)
    spin = sleeping_top(upright).critical_spin * (1 + above)
    fate = sleeping_top(replace(upright, spin=spin))
    assert fate.stable
    assert fate.growth_rate == fate.fall_angle == 0.0
    pushed = replace(upright, spin=spin, theta_rate=1e-6 * fate.nutation_rate**2)
    assert nutation_period(nutation_of(pushed)) == pytest.approx(
        2 * np.pi / fate.nutation_rate, rel=5e-10, abs=0
    )
    # xi'' - i a xi' - (beta/2) xi = 0
    a, beta = I3 * spin / I1, 2 * WEIGHT / I1
    for rate in fate.rates:
        assert rate**2 - a * rate + beta / 2 == pytest.approx(0.0, abs=1e-15 * a**2)
    assert fate.rates[1] - fate.rates[0] == pytest.approx(fate.nutation_rate, rel=5e-13, abs=0)


def test_at_the_critical_spin_itself_it_sleeps() -> None:
    upright = HeavyTop(**BODY, theta=0.0, spin=0.0)
    fate = sleeping_top(replace(upright, spin=-sleeping_top(upright).critical_spin))
    assert fate.stable
    assert fate.nutation_rate == fate.growth_rate == fate.fall_angle == 0.0

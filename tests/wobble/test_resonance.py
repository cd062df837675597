"""Excitation and polar motion, an exact pair."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from earthspin import UndefinedError
from earthspin.wobble import excitation as ex

S = ex.chandler_frequency(433.0, 100.0)
DAYS = 60 * 365


def forced(days: int = DAYS) -> np.ndarray:
    """A free wobble and an annual one, mas."""
    t = np.arange(days + 1.0)
    return 150 * np.exp(1j * S * t) + 90 * np.exp(2j * np.pi * t / 365.25) + 3 - 40j


def annual(t: np.ndarray) -> np.ndarray:
    """Exact excitation of `forced`."""
    rate = 2 * np.pi / 365.25
    return 90 * (1 - rate / S) * np.exp(1j * rate * t) + 3 - 40j


def test_there_and_back_over_sixty_years() -> None:
    p = forced()
    back = ex.polar_motion_from(ex.excitation(p, 1.0, S), 1.0, S, p[0])
    assert np.max(abs(back - p)) < 1e-11  # mas; measured 1e-12
    chi = 30 * (np.random.default_rng(1).standard_normal((DAYS, 2)) @ [1, 1j])
    again = ex.excitation(ex.polar_motion_from(chi, 1.0, S), 1.0, S)
    assert np.max(abs(again - chi)) < 3e-11  # measured: 3e-12


@given(st.floats(100, 1000), st.floats(5, 1e4), st.floats(0.1, 50))
def test_a_constant_excitation_against_the_differential_equation(
    period: float, q: float, step: float
) -> None:
    s = ex.chandler_frequency(period, q)
    chi = np.full(6, 7 - 2j)
    found = ex.polar_motion_from(chi, step, s, 1 + 1j)

    def slope(t: float, p: np.ndarray) -> np.ndarray:
        return 1j * s * (p - (7 - 2j))

    exact = solve_ivp(slope, (0, 6 * step), [1 + 1j], rtol=1e-11, atol=1e-11).y[0, -1]
    assert abs(found[-1] - exact) < 4e-9  # 4e-10 measured, the integrator's


def test_a_free_wobble_has_no_excitation() -> None:
    p = 150 * np.exp(1j * S * np.arange(1000.0))
    assert np.max(abs(ex.excitation(p, 1.0, S))) < 1e-10


def test_whole_periods_without_loss_leave_no_trace() -> None:
    lossless = ex.chandler_frequency(433.0, np.inf)
    p = np.array([1.0, 2.0, 3.0], dtype=complex)
    for turns in (1, 2, 7):
        with pytest.raises(UndefinedError, match=f"{turns} free periods"):
            ex.excitation(p, turns * 433.0, lossless)
    for step, s in ((433.0 * 1.001, lossless), (433.0, S), (1e-6, lossless)):
        assert np.all(np.isfinite(ex.excitation(p, step, s)))


def test_the_quality_factor_is_what_a_turn_costs() -> None:
    """The energy, which goes as the square, falls by 2 pi/Q of itself in a turn; slowly lost."""
    s = ex.chandler_frequency(433.0, 1e6)
    left = ex.polar_motion_from(np.zeros(433, complex), 1.0, s, 1 + 0j)[-1]
    assert 1 - abs(left) ** 2 == pytest.approx(2 * np.pi / 1e6, rel=1e-5, abs=0)  # measured: 3e-6
    assert np.angle(left) == pytest.approx(0.0, abs=2e-15)


def test_a_step_of_zero_loss_is_allowed() -> None:
    s = ex.chandler_frequency(433.0, np.inf)
    assert s.imag == 0
    assert abs(abs(ex.polar_motion_from(np.zeros(5, complex), 1.0, s, 1j)[-1]) - 1) < 1e-14


@pytest.mark.parametrize(("step", "error"), [(1, 1.5e-4), (10, 0.015)])
def test_a_smooth_motion(step: int, error: float) -> None:
    """Largest error, mas, by the mean of the excitation over a step."""
    p = forced()[::step]
    t = step * np.arange(p.size - 1.0)
    assert np.max(abs(ex.excitation(p, step, S) - annual(t + step / 2))) < error


@pytest.mark.parametrize(("period", "q"), [(0.0, 100.0), (-433.0, 100.0), (433.0, 0.0)])
def test_impossible_resonances_are_refused(period: float, q: float) -> None:
    with pytest.raises(UndefinedError, match="greater than zero"):
        ex.chandler_frequency(period, q)


@pytest.mark.parametrize("step", [-1.0, 0.0, float("nan")])
def test_time_runs_forwards(step: float) -> None:
    p = np.array([1.0, 2.0, 3.0], dtype=complex)
    for of in (ex.excitation, ex.polar_motion_from):
        with pytest.raises(UndefinedError, match="time runs forwards"):
            of(p, step, S)

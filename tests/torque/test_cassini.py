"""Cassini states: against integration, closed forms, and the Moon and Mercury as observed."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from earthspin.constants import DAY, JULIAN_YEAR
from earthspin.errors import UndefinedError
from earthspin.torque.cassini import Precessing, cassini_states, hansen, strengths

FAST = Precessing(axial=3e-9, locked=0.0, inclination=0.15, node_rate=1e-10)
LOCKED = Precessing(axial=2e-9, locked=4e-10, inclination=0.15, node_rate=1e-10)
STRONGLY_LOCKED = Precessing(axial=5e-10, locked=1e-9, inclination=0.3, node_rate=1e-9)
FORWARD = Precessing(axial=3e-9, locked=0.0, inclination=0.15, node_rate=-1e-10)


@pytest.mark.parametrize("e", [0.0, 0.05, 0.2])
def test_hansens_coefficients_are_the_published_series(e: float) -> None:
    """G_200, G_201 and G_20-1 of Kaula (1966), Theory of Satellite Geodesy, table 3.2."""
    off = 6 * e**6 + 1e-14
    assert hansen(2, e) == pytest.approx(1 - 5 * e**2 / 2 + 13 * e**4 / 16, rel=0, abs=off)
    series = 7 * e / 2 - 123 * e**3 / 16 + 489 * e**5 / 128
    assert hansen(3, e) == pytest.approx(series, rel=0, abs=20 * e**7 + 1e-14)
    assert hansen(1, e) == pytest.approx(-e / 2 + e**3 / 16, rel=0, abs=e**5 + 1e-14)


def rate(of: Precessing, axis: np.ndarray) -> np.ndarray:
    """ds/dt in axes that turn with the orbit, whose normal is z: (grad H) x s, as vectors."""
    pole = np.array([np.sin(of.inclination), 0.0, np.cos(of.inclination)])
    along = 1.5 * (of.axial * axis[2] + of.locked * (1 + axis[2]))
    return np.cross(np.array([0.0, 0.0, -along]) + of.node_rate * pole, axis)


def axis_at(obliquity: float, aside: float = 0.0) -> np.ndarray:
    found = np.array([np.sin(obliquity), aside, np.cos(obliquity)])
    return found / np.linalg.norm(found)


@pytest.mark.parametrize("of", [FAST, LOCKED, STRONGLY_LOCKED, FORWARD])
def test_an_axis_in_a_state_stays_and_one_beside_it_stays_near_or_leaves(of: Precessing) -> None:
    found = cassini_states(of)
    assert found.number.tolist() == [1, 2, 3, 4]
    for obliquity, stable in zip(found.obliquity, found.stable, strict=True):
        assert np.max(np.abs(rate(of, axis_at(obliquity)))) < 1e-24
        start = axis_at(obliquity, aside=1e-4)
        path = solve_ivp(
            lambda _, s: rate(of, s),
            (0, 1500 * JULIAN_YEAR),
            start,
            method="DOP853",
            rtol=1e-8,
            atol=1e-10,
        )
        away = np.max(np.linalg.norm(path.y.T - axis_at(obliquity), axis=1))
        assert (away < 3e-3) == stable


@given(st.floats(0.02, 1.5), st.floats(0.3, 3.0))
def test_two_states_vanish_where_the_orbit_precesses_too_fast(i: float, times: float) -> None:
    """Four states where 3/2 K0/nu exceeds (sin^(2/3) i + cos^(2/3) i)^(3/2) (Ward 1975)."""
    if abs(times - 1) < 1e-3:
        return
    critical = (np.sin(i) ** (2 / 3) + np.cos(i) ** (2 / 3)) ** 1.5
    found = cassini_states(Precessing(critical * times / 1.5 * 1e-10, 0.0, i, 1e-10))
    assert found.number.tolist() == ([1, 2, 3, 4] if times > 1 else [2, 3])
    assert found.stable.tolist() == [number != 4 for number in found.number]


def test_the_moon_is_in_state_2_at_the_tilt_that_is_observed() -> None:
    """6.688 deg (Williams et al. 2014, JGR Planets 119, 1546, not verified); libration left out.

    J2 = 203.3e-6, C22 = 22.4e-6, C/(M R2) = 0.3930 (GRAIL, not verified).
    """
    n = 2 * np.pi / (27.321662 * DAY)
    axial, locked = strengths(n, n, 203.3e-6, 22.4e-6, 0.3930, 0.0549)
    node = 2 * np.pi / (6793.5 * DAY)
    found = cassini_states(Precessing(axial, locked, np.radians(5.145), node))
    assert found.number.tolist() == [2, 3]
    # 6.717 found: the Sun's pull on the Moon's figure and orbit is not in it
    assert np.degrees(found.obliquity[0]) == pytest.approx(6.688, rel=0.005, abs=0)


def test_mercury_is_in_state_1_at_two_minutes_of_arc() -> None:
    """2.04 +- 0.08 arcmin (Margot et al. 2012, JGR 117, E00L09), whose C/(M R2) is 0.346.

    J2 = 5.03216e-5, C22 = 0.80389e-5 (Mazarico et al. 2014), i = 8.533 deg, 325,513 yr (Stark
    et al. 2015); all not verified.
    """
    n = 2 * np.pi / (87.9693 * DAY)
    axial, locked = strengths(n, 1.5 * n, 5.03216e-5, 0.80389e-5, 0.346, 0.20563)
    node = 2 * np.pi / (325_513 * JULIAN_YEAR)
    found = cassini_states(Precessing(axial, locked, np.radians(8.533), node))
    assert found.number.tolist() == [1, 2, 3, 4]
    assert abs(np.degrees(found.obliquity[0])) * 60 == pytest.approx(2.04, rel=0, abs=0.02)


@pytest.mark.parametrize(("i", "nu"), [(0.0, 1e-10), (0.1, 0.0), (np.pi, 0.0)])
def test_an_orbit_that_does_not_move_has_no_states(i: float, nu: float) -> None:
    with pytest.raises(UndefinedError, match="has no Cassini states"):
        cassini_states(Precessing(1e-9, 0.0, i, nu))

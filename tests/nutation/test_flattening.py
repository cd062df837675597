"""H and C from a rate: a relation put in comes out."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from earthspin.constants import PREM_MEAN_MOMENT, PREM_RADIUS
from earthspin.nutation import rate_budget


def rates(rate: float, excess: float, effects: float = 0.0, method: float = 0.0) -> Any:
    """Budget of a rate in proportion to H, with an effect that differs from its published size."""
    return SimpleNamespace(
        psi={"first-order": rate - effects, "planets": effects},
        psi_published={"planets": 0.0},
        closure=excess,
        psi_rate_analysis_error=method,
    )


@given(st.floats(1e-4, 0.3), st.floats(-0.01, 0.01), st.floats(-0.05, 0.05))
def test_the_inferred_h_gives_the_wanted_rate(h: float, wrong: float, other: float) -> None:
    """A rate k H + other, analysed with a wrong H, leads back to the right one."""
    k, used = 16000.0, h * (1 + wrong)
    excess = (k * used + other) - (k * h + other)
    found, _ = rate_budget.inferred_h(rates(k * used, excess), used)
    assert found == pytest.approx(h, rel=1e-11, abs=0)  # of a difference of floats; 3e-12 measured


def test_its_uncertainty_is_what_moving_the_rate_gives() -> None:
    h, rate = 0.003, 50.0
    up, down = (rate_budget.inferred_h(rates(rate, excess), h)[0] for excess in (5e-6, -5e-6))
    # 3 and 4 add up to 5 as squares
    _, found = rate_budget.inferred_h(rates(rate, 0.0, 3e-6, 4e-6), h)
    assert found == pytest.approx(abs(up - down) / 2, rel=1e-8, abs=0)


@given(st.floats(6e6, 7e6), st.floats(0.0, 0.01), st.floats(-0.01, 0.01))
def test_polar_moment_of_prem(radius: float, j2: float, uneven: float) -> None:
    """Three moments A, B, C in units of M a2 have the mean of PREM, and the given J2."""
    c = rate_budget.prem_polar_moment(radius, j2)
    a, b = c - j2 - uneven, c - j2 + uneven
    mean = PREM_MEAN_MOMENT.value * (PREM_RADIUS.value / radius) ** 2
    assert np.isclose((a + b + c) / 3, mean, rtol=2e-15, atol=0)

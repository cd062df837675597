"""H and C from a rate: a relation put in comes out."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from earthspin.nutation import budget


@given(st.floats(1e-4, 0.3), st.floats(-0.01, 0.01), st.floats(-0.05, 0.05))
def test_the_inferred_h_gives_the_wanted_rate(h: float, wrong: float, other: float) -> None:
    """A rate k H + other, analysed with a wrong H, leads back to the right one."""
    k, used = 16000.0, h * (1 + wrong)
    excess = (k * used + other) - (k * h + other)
    found = budget.inferred_h(used, k * used, excess)
    assert found == pytest.approx(h, rel=1e-11, abs=0)  # of a difference of floats; 3e-12 measured


def test_its_uncertainty_is_what_moving_the_rate_gives() -> None:
    h, rate = 0.003, 50.0
    moved = budget.inferred_h(h, rate, 5e-6) - budget.inferred_h(h, rate, -5e-6)
    # 3 and 4 add up to 5 as squares
    found = budget.inferred_h_uncertainty(h, rate, 3e-6, 4e-6)
    assert found == pytest.approx(abs(moved) / 2, rel=1e-8, abs=0)


@given(st.floats(0.2, 0.4), st.floats(0.0, 0.01), st.floats(-0.01, 0.01), st.floats(0.9, 1.0))
def test_polar_moment_from_the_mean(c: float, flat: float, uneven: float, ratio: float) -> None:
    """Three moments A, B, C in units of M a2, their mean and J2."""
    a, b = c - flat - uneven, c - flat + uneven
    mean, j2 = (a + b + c) / 3, c - (a + b) / 2
    found = budget.polar_moment_from_mean(mean / ratio**2, ratio, 1.0, j2)
    assert np.isclose(found, c, rtol=2e-15, atol=0)

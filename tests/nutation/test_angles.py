"""Polynomials of the angles: what was put in comes back, a cubic is cut as theory says; turns."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from earthspin.nutation.analysis import followed, polynomials


def test_a_polynomial_comes_back() -> None:
    t = np.linspace(-0.7, 0.8, 401)
    given = np.array([[1.0, -2.0, 0.5, 0.25], [0.0, 50.0, -1.1, 3e-4]])
    angles = np.stack([np.polyval(row[::-1], t) for row in given], axis=1)
    # measured: 1.4e-14
    assert np.allclose(polynomials(t, angles, 3), given, rtol=0, atol=1.4e-13)


def test_a_cubic_on_a_line_has_the_slope_of_legendre() -> None:
    """On -1 to 1, x3 = (2/5) P3 + (3/5) P1: the line nearest to it has the slope 3/5."""
    t = np.linspace(-1.0, 1.0, 20001)
    constant, slope = polynomials(t, t[:, np.newaxis] ** 3, 1)[0]
    # measured: 4e-17 and 6e-5, the ends of an even grid counting whole
    assert abs(constant) < 4e-16
    assert abs(slope - 0.6) < 1e-4


@given(st.lists(st.floats(-1.5, 1.5), min_size=2, max_size=60), st.integers(-3, 3))
def test_a_longitude_follows_a_guide_that_leaves_no_doubt(steps: list[float], turns: int) -> None:
    guide = np.cumsum(steps) + 2 * np.pi * turns
    near = guide + 0.4
    wrapped = np.arctan2(np.sin(near), np.cos(near))
    assert np.allclose(followed(wrapped, guide), near, rtol=0, atol=1e-12)

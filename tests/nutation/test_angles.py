"""Polynomials of the angles: what was put in comes back, and a cubic is cut as theory says."""

import numpy as np

from earthspin.nutation.angles import polynomials


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

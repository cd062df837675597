"""The numbers that stand for a figure, and the way between them."""

from fractions import Fraction

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from earthspin import EARTH
from earthspin.mass import figure
from earthspin.mass.shape import Shape
from tests.conftest import load_pins

PINS = load_pins("precession")


def test_the_polar_moment() -> None:
    PINS["polar moment"].check(figure.polar_moment_factor(EARTH.j2, EARTH.dynamical_flattening))


@given(st.floats(-0.3, 0.5))
def test_ellipticity_and_h(h: float) -> None:
    equatorial = 1 - Fraction(h)  # where the polar moment is 1
    expected = float((1 - equatorial) / equatorial)
    assert np.isclose(figure.ellipticity_from_h(h), expected, rtol=5e-16, atol=0)


@given(st.floats(1e-12, 1e-1), st.floats(1e20, 1e30), st.floats(1e5, 1e8))
def test_j2_and_back(j2: float, mass: float, radius: float) -> None:
    difference = figure.moment_difference(j2, mass, radius)
    assert np.isclose(
        figure.j2_from_moment_difference(difference, mass, radius), j2, rtol=1e-15, atol=0
    )


def test_a_homogeneous_spheroid_has_both() -> None:
    """To first order in the flattening, J2 = 2/5 f, and both models give the same H."""
    flattening = 1e-6
    h = figure.h_homogeneous(0.4 * flattening)
    assert np.isclose(h, figure.h_maccullagh(flattening), rtol=2e-6, atol=0)


def test_a_homogeneous_ellipsoid_of_small_cells() -> None:
    """Cells whose middle lies inside: 3.7e-3 measured, and falling with their size."""
    a, b, c = 13.0, 11.4, 9.1
    edges = [np.linspace(-axis, axis, 51) for axis in (a, b, c)]
    x, y, z = np.meshgrid(*((e[:-1] + e[1:]) / 2 for e in edges), indexing="ij")
    inside = (x / a) ** 2 + (y / b) ** 2 + (z / c) ** 2 < 1
    shape = Shape.of_density(1.0 * inside, *edges, radius=a)
    found = shape.j2, shape.dynamical_flattening, shape.triaxiality
    np.testing.assert_allclose(figure.homogeneous_ellipsoid(a, b, c), found, rtol=8e-3, atol=0)

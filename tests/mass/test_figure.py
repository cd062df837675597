"""The spheroid's figure: exact forms against mpmath and quadrature, first orders against them."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from earthspin.errors import BodyError
from earthspin.mass import figure
from tests.conftest import load_pins
from tests.mass.closeness import close
from tests.refusals import refused

PINS = load_pins("mass_figure")

FLATTENINGS = st.one_of(
    st.floats(-50.0, 0.999).filter(lambda f: abs(f) > 1e-6),
    st.integers(-(10**6), 10**6).map(lambda n: n * 1e-12),
)
SMALL = st.integers(-(10**7), 10**7).map(lambda n: n * 1e-9)
ANGLES = st.floats(0.0, np.pi)


@given(FLATTENINGS, ANGLES)
def test_the_perimeter_is_an_ellipse(flattening: float, theta: float) -> None:
    """x2/a2 + z2/c2 = 1 in 50 digits (measured: 9e-16)."""
    r = mp.mpf(float(figure.perimeter(3.0, flattening, theta)))
    with mp.workdps(50):
        x, z = r * mp.sin(mp.mpf(theta)), r * mp.cos(mp.mpf(theta))
        level = (x / 3) ** 2 + (z / (3 * (1 - mp.mpf(flattening)))) ** 2
        assert abs(level - 1) < 5e-15


@given(SMALL, ANGLES)
def test_first_order_perimeters_are_off_by_f_squared(flattening: float, theta: float) -> None:
    """(I.9.39) by at most 1.5 f2 a; (I.9.43) from the mean radius likewise."""
    exact = figure.perimeter(1.0, flattening, theta)
    bound = 1.6 * flattening**2 + 1e-15
    assert abs(1 - flattening * np.cos(theta) ** 2 - exact) <= bound
    mean = figure.mean_radius(1.0, flattening)
    assert abs(figure.perimeter_about_mean(mean, flattening, theta) - exact) <= bound
    assert abs(1 - flattening / 3 - mean) <= bound


@pytest.mark.parametrize("flattening", [-40.0, -0.3, -1e-9, 0.0, 1e-12, 1 / 298.257, 0.6, 0.9999])
def test_the_mean_radius_is_the_mean_over_directions(flattening: float) -> None:
    """Quadrature of the perimeter over the sphere at 30 digits (measured: 3e-16)."""
    with mp.workdps(30):
        q = 1 - mp.mpf(flattening)
        mean = mp.quad(lambda mu: q / mp.sqrt(q**2 * (1 - mu**2) + mu**2), [0, 1 / (1 + 1 / q), 1])
        assert abs(mp.mpf(float(figure.mean_radius(1.0, flattening))) / mean - 1) < 2e-15


@given(FLATTENINGS, st.floats(1e-3, 1e3), st.floats(1e-3, 1e3))
def test_moments_of_the_homogeneous_spheroid(flattening: float, mass: float, a: float) -> None:
    """Against the semi-axes at 50 digits (measured: 7e-16)."""
    found = figure.spheroid_moments(mass, a, flattening)
    with mp.workdps(50):
        m, ax = mp.mpf(mass), mp.mpf(a)
        c = ax * (1 - mp.mpf(flattening))
        exact = (m * (ax**2 + c**2) / 5, 2 * m * ax**2 / 5, m * (ax**2 - c**2) / 5)
        for value, reference in zip(found, exact, strict=True):
            assert abs(mp.mpf(float(value)) - reference) <= 3e-15 * abs(reference)


def test_a_sphere_has_two_fifths() -> None:
    moments = figure.spheroid_moments(5.0, 2.0, 0.0)
    assert moments.equatorial == moments.polar == 8.0
    assert moments.difference == 0


@given(SMALL.filter(lambda f: f != 0))
def test_first_order_differences(flattening: float) -> None:
    """(I.9.47) to (I.9.49) beside the exact (1/5) M (a2 - c2): half the flattening apart."""
    exact = figure.spheroid_moments(3.0, 2.0, flattening).difference
    first = 2 / 5 * flattening * 3.0 * 2.0**2
    assert close(first / exact - 1, flattening / 2, abs=flattening**2 + 1e-15)
    density = 3.0 / (4 * np.pi / 3 * 2.0**3 * (1 - flattening))
    by_density = 8 * np.pi / 15 * flattening * density * figure.mean_radius(2.0, flattening) ** 5
    assert close(by_density / exact - 1, 0, abs=2 * abs(flattening) + 1e-15)


def test_maccullagh_beside_the_exact_spheroid() -> None:
    moments = figure.spheroid_moments(1.0, 1.0, 1 / 298.257)
    PINS["Euler's period of a homogeneous Earth"].check(moments.equatorial / moments.difference)


test_bodies_that_cannot_be = refused(
    (lambda: figure.perimeter(-5.0, 0.0, 0.0), BodyError, r"radius = -5\.0"),
    (lambda: figure.spheroid_moments(0.0, 1.0, 0.0), BodyError, r"mass = 0\.0"),
    (lambda: figure.perimeter(1.0, 1.5, 0.0), BodyError, r"flattening = 1\.5.*below 1"),
)

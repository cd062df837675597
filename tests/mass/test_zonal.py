"""Zonal moments: quadrature against closed forms, the exact spheroid, and point masses."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from earthspin.constants import G
from earthspin.errors import AccuracyError, BodyError, UndefinedError
from earthspin.mass import figure, multipoles
from earthspin.mass.figure import j2_from_moment_difference
from earthspin.mass.multipoles import exterior_multipoles
from earthspin.mass.spheroid import spheroid_potential
from tests.mass.closeness import close
from tests.mass.spheroid_reference import spheroid_zonals
from tests.refusals import refused


def _uniform(r: np.ndarray, theta: np.ndarray) -> np.ndarray:
    return np.full_like(r, 5.0)


def _condensed(r: np.ndarray, theta: np.ndarray) -> np.ndarray:
    return 8.0 * (1 - 0.9 * r**2)


@pytest.mark.parametrize("flattening", [-0.5, -1e-3, 1 / 298.257, 0.3])
def test_a_homogeneous_spheroid_by_quadrature(flattening: float) -> None:
    """Z_n, A, C and C - A against the closed forms (measured: 7e-15)."""

    def edge(theta: np.ndarray) -> np.ndarray:
        return figure.perimeter(1.0, flattening, theta)

    mass = 4 * np.pi / 3 * 5.0 * (1 - flattening)
    found = multipoles.zonal_integrals(_uniform, edge, 8, radius=1.0)
    assert close(found[0], mass, rel=2e-14)
    size = max(1.0, (1 - flattening) ** 8)
    expected = spheroid_zonals(flattening, 8)
    assert close(-found / found[0], expected, abs=8e-15 * size)
    moments = multipoles.moments_of_density(_uniform, edge)
    known = figure.spheroid_moments(mass, 1.0, flattening)
    assert close(moments.equatorial, known.equatorial, rel=5e-14)
    assert close(moments.polar, known.polar, rel=3e-14)
    assert close(moments.difference, known.difference, abs=3e-14 * mass)


def test_both_kinds_of_j2() -> None:
    """The source's is G (C - A), geodesy's (C - A)/(M a2) = e2/5."""
    mass, a, f = 6e24, 6.4e6, 1 / 298.257
    difference = figure.spheroid_moments(mass, a, f).difference
    integrals = -mass * spheroid_zonals(f, 4)
    source = multipoles.zonal_moments(integrals, a)
    assert close(source[0], -G.value * mass, rel=1e-15)
    assert close(source[2], G.value * difference, rel=2e-15)
    geodesy = j2_from_moment_difference(difference, mass, a)
    assert close(-integrals[2] / mass, geodesy, rel=2e-15)


@given(st.floats(0.0, np.pi), st.floats(1.05, 20.0), st.sampled_from([-0.2, 1e-9, 0.05, 0.5]))
def test_the_series_is_the_exact_spheroid(theta: float, height: float, flattening: float) -> None:
    """Degree 200 at and beyond 1.05 of a sphere that holds the body (measured: 8e-16)."""
    outer = max(1.0, 1 - flattening)
    integrals = -spheroid_zonals(flattening, 200)
    r = outer * height
    radius = 1.0 if flattening >= 0 else outer
    scaled = integrals / radius ** np.arange(201)
    found = multipoles.zonal_potential(scaled, radius, r, theta) / G.value
    point = [r * np.sin(theta), 0.0, r * np.cos(theta)]
    exact = float(spheroid_potential(1.0, 1.0, flattening, point))
    assert close(found, exact, rel=6e-15)


def test_point_masses_on_a_ring_have_the_zonals_of_the_ring() -> None:
    """Seven masses at colatitude theta: Z_n = M P_n(cos theta)."""
    angle = 2 * np.pi * np.arange(7) / 7
    ring = np.stack([0.6 * np.cos(angle), 0.6 * np.sin(angle), np.full(7, 0.8)], axis=-1)
    found = exterior_multipoles(2.0, ring, 6).zonal
    assert close(found, 14 * np.polynomial.legendre.legval(0.8, np.eye(7)), rel=2e-15)


def test_a_condensed_body_breaks_maccullagh() -> None:
    """rho(r) in a slightly oblate perimeter: the source claims (I.9.52) for it (exercise I.9.1).

    By hand to first order: C - A = (8 pi/15) f rho(a) a5, A = (8 pi/3) int rho r4 dr, so
    (C - A)/A = f rho(a) a5/(5 int rho r4 dr) = f 0.1/(1 - 0.9 5/7) = 0.28 f.
    """
    f = 1e-4

    def edge(theta: np.ndarray) -> np.ndarray:
        return figure.perimeter(1.0, f, theta)

    moments = multipoles.moments_of_density(_condensed, edge)
    ratio = float(moments.difference / moments.equatorial)
    assert close(ratio / f, 0.28, rel=2e-3)


def test_a_density_with_a_direction() -> None:
    """rho = 1 + cos2(theta) in a sphere: Z_2 = 2 pi (4/15)/5, by hand, and a prolate body."""

    def edge(theta: np.ndarray) -> np.ndarray:
        return np.ones_like(theta)

    def density(r: np.ndarray, theta: np.ndarray) -> np.ndarray:
        return np.asarray(1 + np.cos(theta) ** 2)

    found = multipoles.zonal_integrals(density, edge, 3, radius=1.0)
    assert close(found[0], 2 * np.pi * (8 / 3) / 3, rel=1e-14)
    assert close(found[2], 2 * np.pi * (4 / 15) / 5, rel=6e-14)
    assert close(multipoles.moments_of_density(density, edge).difference, -found[2], rel=1e-14)


def test_a_rough_density_says_so() -> None:
    def step(r: np.ndarray, theta: np.ndarray) -> np.ndarray:
        return np.where(r < 0.5, 2.0, 1.0)

    with pytest.raises(AccuracyError, match="smooth density"):
        multipoles.moments_of_density(step, lambda theta: np.ones_like(theta))


test_wrong_input = refused(
    (
        lambda: multipoles.zonal_potential([1.0], 2.0, [3.0, 2.0], 0.1),
        UndefinedError,
        r"r = 2 m; give distances beyond 2 m",
    ),
    (
        lambda: multipoles.zonal_integrals(lambda r, t: -r, np.ones_like, 2, 1.0),
        BodyError,
        "density = -",
    ),
    (lambda: multipoles.zonal_integrals(_uniform, np.cos, 2, 1.0), BodyError, "perimeter = -"),
)

"""Equators of date: axes, angles, and the frames in which they are measured."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from earthspin import EARTH, MARS, UndefinedError
from earthspin.sky import iau_models, poles

angles = st.floats(-np.pi, np.pi)
vectors = arrays(float, 3, elements=st.floats(-1, 1)).filter(lambda v: np.linalg.norm(v) > 1e-3)


@given(angles, st.floats(-np.pi / 2, np.pi / 2), st.floats(1e-3, 1e12))
def test_spherical_and_back(ra: float, dec: float, size: float) -> None:
    found = poles.spherical(size * poles.direction(ra, dec)[np.newaxis])
    assert np.allclose(
        found[2] * np.cos(found[1]) * np.exp(1j * found[0]),
        size * np.cos(dec) * np.exp(1j * ra),
        rtol=0,
        atol=1e-15 * size,
    )
    assert np.isclose(found[1], dec, rtol=0, atol=1e-15)


@pytest.mark.parametrize("tiny", [1e-3, 1e-8, 1e-13])
def test_small_angles_keep_their_digits(tiny: float) -> None:
    a, b = np.array([1.0, 0.0, 0.0]), np.array([np.cos(tiny), np.sin(tiny), 0.0])
    assert np.isclose(poles.angle(a, b), tiny, rtol=1e-15, atol=0)
    assert np.isclose(poles.angle(a, -b), np.pi - tiny, rtol=1e-15, atol=0)


@given(vectors, vectors)
def test_a_fixed_equator_is_a_rotation_with_its_pole(axis: np.ndarray, normal: np.ndarray) -> None:
    axis, normal = (v / np.linalg.norm(v) for v in (axis, normal))
    matrix = poles.fixed_equator(axis, normal)
    assert np.allclose(matrix @ matrix.T, np.eye(3), rtol=0, atol=1e-11)
    assert np.isclose(np.linalg.det(matrix), 1.0, rtol=0, atol=1e-11)
    assert np.array_equal(matrix[2], axis)


def test_the_equinox_is_where_the_orbit_goes_north() -> None:
    """A fixed pole gives the same axes as IAU 2006 at J2000.0."""
    matrix = iau_models.mean_equator(np.array([0.0]))[0]
    ours = poles.fixed_equator(matrix[2], iau_models.ecliptic_pole())
    assert np.allclose(ours, matrix, rtol=0, atol=1e-12)


def test_an_upright_axis_still_has_an_equator() -> None:
    axis = poles.direction(1.0, 0.5)
    matrix = poles.fixed_equator(axis, axis)
    assert np.allclose(matrix @ matrix.T, np.eye(3), rtol=0, atol=1e-15)


def test_one_matrix_or_one_each() -> None:
    many = np.repeat(np.eye(3)[np.newaxis], 4, axis=0)
    points = np.arange(12.0).reshape(4, 3)
    assert np.array_equal(poles.rotate(many, points), points)
    # A quarter turn about z takes x to y and y to -x.
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    turned = np.stack([-points[:, 1], points[:, 0], points[:, 2]], axis=1)
    assert np.array_equal(poles.rotate(quarter, points), turned)
    many[1::2] = quarter
    points[1::2] = turned[1::2]
    assert np.array_equal(poles.rotate(many, np.arange(12.0).reshape(4, 3)), points)


def test_mean_and_true_differ_by_nutation() -> None:
    days = np.linspace(0, 6800, 300)
    mean = EARTH.needed("pole").equator(None, days)
    true = EARTH.needed("pole").equator(None, days, iau_models.NutationSpline(0, 6800))
    apart = np.linalg.norm(mean[:, 2] - true[:, 2], axis=1) * 206264.8
    assert 9 < apart.max() < 11  # 9.2 arcsec of the node's term and the half-yearly one


def test_an_orbit_is_needed() -> None:
    with pytest.raises(UndefinedError, match="orbit_pole"):
        MARS.needed("pole").orbit_normal(None)

"""The torque at an instant: both forms, an independent sum of forces, and its symmetries."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from earthspin.errors import UndefinedError
from earthspin.torque.gravity import (
    cross,
    torque_error,
    torque_from_declination,
    torque_from_position,
)

GM, BULGE = 1.3e20, 2.6e35
unit = st.floats(-1, 1, allow_nan=False)
directions = arrays(float, 3, elements=unit).filter(lambda v: np.linalg.norm(v) > 0.1)


def spherical(v: np.ndarray) -> tuple[np.ndarray, ...]:
    x, y, z = v.T
    return np.arctan2(y, x), np.arctan2(z, np.hypot(x, y)), np.sqrt(x * x + y * y + z * z)


@pytest.mark.parametrize("lanes", [(), (1, 16), (1, 2000)])
def test_vector_products_of_few_and_of_many_have_the_bits_of_numpy(lanes: tuple[int, ...]) -> None:
    a, b = np.random.default_rng(1).normal(size=(2, 3, *lanes))
    b = b * np.ones((3, *(4 for _ in lanes[1:]), *lanes[-1:]))  # several for each of `a`
    np.testing.assert_array_equal(cross(a, b), np.cross(a, b, axis=0), strict=True)


@given(directions, st.floats(1e7, 1e13))
def test_both_forms_agree_to_round_off(direction: np.ndarray, size: float) -> None:
    position = (size * direction)[np.newaxis]
    from_sky = torque_from_declination(GM, BULGE, *spherical(position))
    from_space = torque_from_position(GM, BULGE, position, np.array([0.0, 0.0, 1.0]))
    scale = 3 * GM * BULGE / np.linalg.norm(position) ** 3
    assert np.max(np.abs(from_sky - from_space)) < 2e-15 * scale  # measured: 6e-16


def test_against_a_sum_of_forces_on_masses() -> None:
    """A body of point masses with C - A = 2 m (s2 - h2); the sum holds every degree."""
    # Two rings of 8 masses make it axisymmetric up to degree 7.
    turns = 2 * np.pi * np.arange(8) / 8
    s, h, m = 3.0, 1.0, 5.0
    ring = np.stack([s * np.cos(turns), s * np.sin(turns), 0 * turns], axis=1)
    up = np.array([0.0, 0.0, h])
    masses = np.concatenate([ring + up, ring - up])
    bulge = m * np.sum(masses[:, 0] ** 2 - masses[:, 2] ** 2)
    away = np.array([0.5, -0.3, 0.4]) * 1e4
    pull = away - masses
    force = GM * m * pull / np.linalg.norm(pull, axis=1)[:, np.newaxis] ** 3
    exact = np.sum(np.cross(masses, force), axis=0)
    ours = torque_from_position(GM, bulge, away[np.newaxis], np.array([0.0, 0.0, 1.0]))[0]
    # The next degree is (s/r)2 = 2e-7 smaller; the sum itself loses 1e-10 by cancellation.
    assert np.linalg.norm(ours - exact) < 1.5e-7 * np.linalg.norm(exact)


@given(directions, directions)
def test_torque_is_across_axis_and_mass(position: np.ndarray, axis: np.ndarray) -> None:
    axis = axis / np.linalg.norm(axis)
    torque = torque_from_position(1.0, 1.0, position[np.newaxis], axis)[0]
    scale = 3 / np.linalg.norm(position) ** 3
    assert abs(torque @ axis) < 1e-15 * scale
    assert abs(torque @ position) < 1e-15 * scale * np.linalg.norm(position)


@given(directions)
def test_mirror_images(position: np.ndarray) -> None:
    axis = np.array([0.0, 0.0, 1.0])
    one = torque_from_position(1.0, 1.0, position[np.newaxis], axis)
    opposite = torque_from_position(1.0, 1.0, -position[np.newaxis], axis)
    prolate = torque_from_position(1.0, -1.0, position[np.newaxis], axis)
    assert np.array_equal(one, opposite)
    assert np.array_equal(one, -prolate)


def test_it_pulls_the_equator_towards_the_mass() -> None:
    """A mass north of the equator turns the axis away from it: N x k points to its foot."""
    position = np.array([[1.0, 0.0, 0.5]])
    axis = np.array([0.0, 0.0, 1.0])
    motion = np.cross(torque_from_position(1.0, 1.0, position, axis)[0], axis)
    # Rotating by N moves the axis by N x k; tilting the equator up to the mass tilts k back.
    assert motion[0] < 0


def test_no_torque_on_the_equator_at_the_pole_or_on_a_sphere() -> None:
    axis = np.array([0.0, 0.0, 1.0])
    for position in ([[1.0, 2.0, 0.0]], [[0.0, 0.0, 3.0]]):
        assert not np.any(torque_from_position(GM, BULGE, np.array(position), axis))
    assert not np.any(torque_from_position(GM, 0.0, np.array([[1.0, 2.0, 3.0]]), axis))


@pytest.mark.parametrize("wrong", [0.0, np.nan])
def test_a_mass_in_the_centre_is_refused(wrong: float) -> None:
    places = np.array([[1.0, 0.0, 1.0], [wrong, 0.0, 0.0]])
    with pytest.raises(UndefinedError, match="direction of a mass"):
        torque_from_position(GM, BULGE, places, np.array([0.0, 0.0, 1.0]))
    with pytest.raises(UndefinedError, match="direction of a mass"):
        torque_from_declination(GM, BULGE, np.zeros(2), np.zeros(2), np.array([1.0, wrong]))


def test_the_error_is_what_moving_the_mass_gives() -> None:
    declination, distance = np.array([0.4, 1e-9]), np.array([4e8, 4e8])
    angle, length = 3e-8, 20.0
    zero = np.zeros(2)

    def size(d: np.ndarray, r: np.ndarray) -> np.ndarray:
        return np.linalg.norm(torque_from_declination(GM, BULGE, zero, d, r), axis=-1)

    moved = np.hypot(
        size(declination + angle, distance) - size(declination, distance),
        size(declination, distance - length) - size(declination, distance),
    )
    claimed = torque_error(GM, BULGE, declination, distance, angle, length, 0.0)
    assert np.allclose(claimed, moved, rtol=1e-6, atol=0)

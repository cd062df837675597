"""Quaternions against scipy's rotations."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from earthspin.numerics.quaternion import conjugate, multiply, rotate, rotation_about_z

RNG = np.random.default_rng(1)


def as_scipy(q: np.ndarray) -> Rotation:
    return Rotation.from_quat(np.roll(q, -1, axis=-1))


@pytest.fixture
def turns() -> np.ndarray:
    q = RNG.normal(size=(2, 20, 4))
    return np.asarray(q / np.linalg.norm(q, axis=-1, keepdims=True))


def test_product_and_inverse(turns: np.ndarray) -> None:
    p, q = turns
    wanted = (as_scipy(p) * as_scipy(q)).as_matrix()
    # measured: 6e-16
    np.testing.assert_allclose(as_scipy(multiply(p, q)).as_matrix(), wanted, rtol=0, atol=3e-15)
    wanted = as_scipy(p).inv().as_matrix()
    np.testing.assert_allclose(as_scipy(conjugate(p)).as_matrix(), wanted, rtol=0, atol=3e-15)


def test_rotation_of_vectors(turns: np.ndarray) -> None:
    v = RNG.normal(size=(20, 3))
    np.testing.assert_allclose(rotate(turns[0], v), as_scipy(turns[0]).apply(v), rtol=0, atol=5e-15)


def test_turn_about_z() -> None:
    x = rotate(rotation_about_z(np.array([np.pi / 6])), np.array([[1.0, 0.0, 0.0]]))
    np.testing.assert_allclose(x, [[0.5, np.sqrt(0.75), 0.0]], rtol=0, atol=2e-16)

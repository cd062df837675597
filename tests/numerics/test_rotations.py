"""Turns component first, against the quaternions of scipy."""

import numpy as np
from scipy.spatial.transform import Rotation

from earthspin.numerics import rotations

RNG = np.random.default_rng(3)
P, Q = (Rotation.random(50, rng) for rng in (RNG, RNG))
V = RNG.normal(size=(3, 50))


def rows(rotation: Rotation) -> np.ndarray:
    return np.ascontiguousarray(rotation.as_quat(scalar_first=True).T)


def same_turn(found: np.ndarray, true: Rotation) -> None:
    other = rows(true)
    signed = found * np.sign(np.sum(found * other, axis=0))
    np.testing.assert_allclose(signed, other, rtol=0, atol=1e-15)


def test_products() -> None:
    same_turn(rotations.times(rows(P), rows(Q)), P * Q)
    for by in (
        np.einsum("abm,bm->am", rotations.left(rows(P)), rows(Q)),
        np.einsum("abm,bm->am", rotations.right(rows(Q)), rows(P)),
    ):
        same_turn(by, P * Q)
    same_turn(rotations.conjugate(rows(P)), P.inv())


def test_products_with_vectors() -> None:
    bare = np.concatenate([np.zeros((1, 50)), V])
    np.testing.assert_allclose(
        rotations.times_vector(rows(P), V), rotations.times(rows(P), bare), rtol=0, atol=1e-15
    )
    np.testing.assert_allclose(
        rotations.vector_times(V, rows(P)), rotations.times(bare, rows(P)), rtol=0, atol=1e-15
    )


def test_matrices_turn_vectors() -> None:
    np.testing.assert_allclose(
        np.moveaxis(rotations.matrices(rows(P)), -1, 0), P.as_matrix(), rtol=0, atol=1e-15
    )
    np.testing.assert_allclose(rotations.rotated(rows(P), V), P.apply(V.T).T, rtol=0, atol=2e-15)


def test_a_steady_turn() -> None:
    time = np.linspace(-3.0, 3.0, 50)
    same_turn(rotations.rotation_about(V, time), Rotation.from_rotvec((V * time).T))
    at_rest = rotations.rotation_about(np.zeros((3, 2)), np.ones(2))
    assert np.array_equal(at_rest, [[1, 1], [0, 0], [0, 0], [0, 0]])


def test_angles_keep_their_digits() -> None:
    small = 1e-9
    aside = Rotation.from_rotvec(small * V.T / np.linalg.norm(V, axis=0)[:, np.newaxis])
    found = rotations.angle_between(rows(P), rows(aside * P))
    np.testing.assert_allclose(found, small, rtol=1e-6, atol=0)
    np.testing.assert_allclose(
        rotations.angle_between(rows(P), rows(Q)), (P.inv() * Q).magnitude(), rtol=0, atol=1e-14
    )
    np.testing.assert_allclose(rotations.angle_between(rows(P), -rows(P)), 0, rtol=0, atol=1e-15)

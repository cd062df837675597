"""The inertia tensor: exact sums, parallel axes, turns, and the bodies that cannot be."""

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial.transform import Rotation

from earthspin.errors import BodyError, UndefinedError
from earthspin.mass import tensor
from earthspin.mass.tensor import centre_of_mass
from tests.mass.closeness import close
from tests.refusals import refused

COORDINATES = st.integers(-9000, 9000).map(lambda n: n / 1000)
VECTORS = st.tuples(COORDINATES, COORDINATES, COORDINATES).map(np.array)
MASSES = st.integers(1, 5000).map(lambda n: n / 100)
ROTATIONS = st.tuples(*[st.floats(-3.1, 3.1)] * 3).map(
    lambda angles: Rotation.from_euler("zxz", angles).as_matrix()
)


@st.composite
def bodies(draw: Any) -> tuple[np.ndarray, np.ndarray]:
    count = draw(st.integers(1, 6))
    masses = draw(arrays(float, count, elements=MASSES))
    return masses, draw(arrays(float, (count, 3), elements=COORDINATES))


def _exact_tensor(masses: np.ndarray, positions: np.ndarray) -> list[list[Fraction]]:
    """(I.1.3) in rational numbers."""
    total = [[Fraction(0)] * 3 for _ in range(3)]
    for mass, position in zip(masses, positions, strict=True):
        m, r = Fraction(float(mass)), [Fraction(float(c)) for c in position]
        square = sum(c * c for c in r)
        for i in range(3):
            for j in range(3):
                total[i][j] += m * ((square if i == j else 0) - r[i] * r[j])
    return total


@given(bodies())
def test_against_rational_numbers(body: tuple[np.ndarray, np.ndarray]) -> None:
    """Each component to rounding of its own terms (measured over 600: 2.2e-16)."""
    exact = np.array([[float(c) for c in row] for row in _exact_tensor(*body)])
    found = tensor.inertia_tensor(*body)
    assert close(np.diag(found), np.diag(exact), rel=2e-15)
    assert close(found, exact, abs=1e-15 * np.trace(exact))


@given(bodies(), VECTORS)
def test_parallel_axes(body: tuple[np.ndarray, np.ndarray], point: np.ndarray) -> None:
    masses, positions = body
    centre, mass = centre_of_mass(*body), np.sum(masses)
    about_centre = tensor.inertia_tensor(*body, about=centre)
    direct = tensor.inertia_tensor(*body, about=point)
    scale = mass * (np.max(np.abs(positions)) + np.max(np.abs(point)) + 1e-3) ** 2
    moved = tensor.tensor_about_point(about_centre, mass, point - centre)
    assert close(moved, direct, abs=2e-15 * scale)


@given(bodies(), VECTORS)
def test_momentum_and_energy_are_those_of_the_masses(
    body: tuple[np.ndarray, np.ndarray], omega: np.ndarray
) -> None:
    """Sums over v = omega x r (I.1.1), (I.1.2), (I.1.7)."""
    masses, r = body
    v = np.cross(omega, r)
    inertia = tensor.inertia_tensor(masses, r)
    momentum = np.sum(masses[:, None] * np.cross(r, v), axis=0)
    energy = np.sum(masses * np.sum(v**2, axis=-1)) / 2
    scale = np.trace(inertia) * np.linalg.norm(omega)
    assert close(tensor.angular_momentum(inertia, omega), momentum, abs=2e-15 * scale)
    found = tensor.kinetic_energy(inertia, omega)
    assert close(found, energy, abs=1e-15 * scale * np.linalg.norm(omega))


@given(bodies(), VECTORS.filter(lambda v: np.linalg.norm(v) > 0))
def test_the_moment_about_an_axis_is_the_sum_of_squared_distances(
    body: tuple[np.ndarray, np.ndarray], axis: np.ndarray
) -> None:
    """(I.1.10b), and T = I omega2/2 (I.1.10a)."""
    masses, r = body
    inertia = tensor.inertia_tensor(masses, r)
    n = axis / np.linalg.norm(axis)
    distances = np.linalg.norm(np.cross(r, n), axis=-1)
    found = tensor.moment_about_axis(inertia, axis)
    scale = np.trace(inertia)
    assert close(found, np.sum(masses * distances**2), abs=3e-15 * scale)
    energy = tensor.kinetic_energy(inertia, 3.0 * n)
    assert close(energy, 4.5 * found, abs=1e-14 * scale)


@given(bodies(), ROTATIONS, ROTATIONS, VECTORS)
def test_change_of_frame(
    body: tuple[np.ndarray, np.ndarray], turn: np.ndarray, next_turn: np.ndarray, omega: np.ndarray
) -> None:
    """I' = R I R^T is the tensor of the turned masses; turns compose; energy stays (I.1.9)."""
    masses, r = body
    inertia = tensor.inertia_tensor(masses, r)
    scale = 4e-15 * np.trace(inertia)
    turned = tensor.change_frame(inertia, turn)
    assert close(turned, tensor.inertia_tensor(masses, r @ turn.T), abs=scale)
    twice = tensor.change_frame(turned, next_turn)
    assert close(twice, tensor.change_frame(inertia, next_turn @ turn), abs=scale)
    assert close(tensor.change_frame(turned, turn.T), inertia, abs=2 * scale)
    assert np.array_equal(turned, turned.T)
    energy = tensor.kinetic_energy(inertia, omega)
    assert close(
        tensor.kinetic_energy(turned, turn @ omega), energy, abs=scale * np.dot(omega, omega)
    )


def test_many_bodies() -> None:
    rng = np.random.default_rng(3)
    positions, masses = rng.normal(size=(5, 7, 3)), rng.uniform(1, 2, size=(5, 7))
    many = tensor.inertia_tensor(masses, positions)
    assert many.shape == (5, 3, 3)
    assert np.array_equal(many[2], tensor.inertia_tensor(masses[2], positions[2]))
    assert tensor.check_inertia_tensor(many).shape == (5, 3, 3)
    assert close(tensor.moment_about_axis(many, [0, 0, 1]), many[:, 2, 2], rel=1e-15)


@given(bodies())
def test_every_body_passes_the_check(body: tuple[np.ndarray, np.ndarray]) -> None:
    """But for one point, and masses that coincide: they have no moments, or only two."""
    masses, positions = body
    inertia = tensor.inertia_tensor(masses, positions, about=centre_of_mass(*body))
    if np.max(np.abs(positions - positions[0])) > 0.01:
        assert np.array_equal(tensor.check_inertia_tensor(inertia), inertia)


test_tensors_that_cannot_be = refused(
    ([[2, 1e-3, 0], [0, 2, 0], [0, 0, 3]], r"\[\[2\.0, 0\.001.*symmetric"),
    (np.diag([1.0, 1.0, 2.001]), r"\[1\.0, 1\.0, 2\.001\].*sum of the other two"),
    (np.diag([-1.0, 3.0, 3.0]), r"\[-1\.0, 3\.0, 3\.0\].*above zero"),
    (np.zeros((3, 3)), r"\[0\.0, 0\.0, 0\.0\].*above zero"),
    (np.diag([1.0, np.inf, 2.0]), "inf.*finite"),
    (np.ones((2, 2)), "3 x 3"),
    (np.stack([np.eye(3), np.diag([1.0, 1.0, 5.0])]), r"\[1\.0, 1\.0, 5\.0\]"),
    call=tensor.check_inertia_tensor,
    kind=BodyError,
)


def test_flat_and_straight_bodies_are_bodies() -> None:
    tensor.check_inertia_tensor(np.diag([1.0, 2.0, 3.0]))
    tensor.check_inertia_tensor(np.diag([0.0, 2.0, 2.0]))


def test_wrong_input() -> None:
    with pytest.raises(BodyError, match=r"mass = -2\.0"):
        tensor.inertia_tensor([1.0, -2.0], np.eye(3)[:2])
    with pytest.raises(BodyError, match=r"mass = 0\.0"):
        tensor.tensor_about_point(np.eye(3), 0.0, [1, 2, 3])
    with pytest.raises(UndefinedError, match=r"\(2,\).*\(3, 3\)"):
        tensor.inertia_tensor([1.0, 2.0], np.eye(3))
    with pytest.raises(UndefinedError, match=r"shape \(0, 3\)"):
        tensor.inertia_tensor([], np.zeros((0, 3)))
    with pytest.raises(UndefinedError, match=r"\[0, 0, 0\]"):
        tensor.moment_about_axis(np.eye(3), [0, 0, 0])
    with pytest.raises(UndefinedError, match="orthogonal matrix by 3"):
        tensor.change_frame(np.eye(3), 2 * np.eye(3))

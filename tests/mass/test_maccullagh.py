"""MacCullagh's potential and torque: limits of the sum over the masses, and of each other."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from earthspin.constants import G
from earthspin.errors import BodyError, UndefinedError
from earthspin.mass import figure
from earthspin.mass.multipoles import exterior_multipoles
from earthspin.mass.rings import torque_on_masses
from earthspin.mass.tensor import centre_of_mass, inertia_tensor
from earthspin.torque.gravity import torque_from_position
from tests.mass.accuracy import maccullagh_torque
from tests.mass.closeness import close
from tests.refusals import refused

#: Random bodies; 600 in the full run.
CASES = 60


def _body(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Seven masses about their centre of mass."""
    rng = np.random.default_rng(seed)
    masses, positions = rng.uniform(1, 3, 7), rng.normal(size=(7, 3))
    return masses, positions - centre_of_mass(masses, positions)


@given(st.integers(0, 10**6))
def test_the_potential_is_the_expansion_to_degree_two(seed: int) -> None:
    """Any triaxial body; the degree 1 vanishes about the centre of mass (measured: 6e-16)."""
    masses, r = _body(seed)
    series = exterior_multipoles(masses, r, 2)
    point = np.array([0.36, 0.48, -0.8]) * series.radius * 1.5
    found = figure.maccullagh_potential(np.sum(masses), inertia_tensor(masses, r), point)
    assert close(found, float(series.potential(point)), rel=4e-15)


def test_the_next_term_falls_as_the_fourth_power() -> None:
    masses, r = _body(1)
    inertia, direction = inertia_tensor(masses, r), np.array([0.36, 0.48, -0.8])
    errors = []
    for distance in (50.0, 100.0):
        point = distance * direction
        exact = -G.value * np.sum(masses / np.linalg.norm(point - r, axis=-1))
        errors.append(figure.maccullagh_potential(np.sum(masses), inertia, point) - exact)
    assert close(errors[0] / errors[1], 16, rel=0.2)


@given(st.integers(0, 10**6))
def test_the_torque_is_the_limit_of_the_sum_over_the_masses(seed: int) -> None:
    masses, r = _body(seed)
    inertia = inertia_tensor(masses, r)
    point = 1e7 * np.array([0.36, 0.48, -0.8])
    found = figure.maccullagh_torque(2.0, inertia, point)
    exact = torque_on_masses(2.0, point, masses, r)
    scale = 3 * 2.0 * np.trace(inertia) / 1e21
    # The next order is (size/distance) smaller.
    assert close(found, exact, abs=3e-7 * scale)


def test_torque_against_fifty_digits_for_nearly_spherical_bodies() -> None:
    """Moments that differ by 1e-3 to 1e-9 of themselves, given as differences.

    Measured over 600: 1.1e-15 of the torque's size.
    """
    assert maccullagh_torque(CASES) < 5e-15


def test_the_whole_tensor_of_a_nearly_spherical_body_serves_as_well() -> None:
    """Its moments differ by 1e-9; they are floats, so their differences are exact (1.1e-15)."""
    tensor = np.diag([8e37, 8e37 * (1 + 3e-10), 8e37 * (1 + 1e-9)])
    point = np.array([3.0e9, -2.0e9, 4.0e9])
    differences = np.diag(np.diag(tensor) - tensor[0, 0])
    whole = figure.maccullagh_torque(1.3e20, tensor, point)
    assert close(whole, figure.maccullagh_torque(1.3e20, differences, point), rel=1e-14)


@given(st.floats(0.0, np.pi), st.floats(-3.0, 3.0), st.floats(0.01, 0.5))
def test_the_axisymmetric_forms(theta: float, phi: float, bulge: float) -> None:
    """(I.9.31) and (I.9.34) are the general ones for A = B."""
    axis = np.array([0.0, 0.0, 1.0])
    n = np.array([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])
    tensor = np.diag([1.0, 1.0, 1.0 + bulge])
    general = figure.maccullagh_potential(2.0, tensor, 3.0 * n)
    special = figure.maccullagh_potential_axisymmetric(2.0, bulge, 3.0, theta)
    assert close(special, general, rel=2e-15)
    torque = figure.maccullagh_torque(5.0, np.diag([0.0, 0.0, bulge]), 3.0 * n)
    expected = torque_from_position(5.0, bulge, 3.0 * n[None, :], axis)[0]
    assert close(torque, expected, rel=5e-15, abs=1e-17)


def test_many_points_and_bodies() -> None:
    points = np.random.default_rng(0).normal(size=(6, 3)) * 9
    tensors = np.stack([np.diag([1.0, 1.2, 1.3 + k]) for k in range(6)])
    assert figure.maccullagh_torque(1.0, tensors, points).shape == (6, 3)
    assert figure.maccullagh_potential(np.ones(6), tensors[0], points).shape == (6,)
    assert np.all(figure.maccullagh_torque(1.0, 4.0 * np.eye(3), points) == 0)


test_wrong_input = refused(
    (
        lambda: figure.maccullagh_torque(1.0, np.eye(3), [0.0, 0, 0]),
        UndefinedError,
        r"\[0, 0, 0\] is the centre",
    ),
    (lambda: figure.maccullagh_potential(-1.0, np.eye(3), [1.0, 0, 0]), BodyError, r"mass = -1\.0"),
    (
        lambda: figure.maccullagh_potential_axisymmetric(1.0, 1.0, 0.0, 0.0),
        BodyError,
        r"distance = 0\.0",
    ),
)

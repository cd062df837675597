"""Euler's equations: invariants, stability, and an integrator that knows nothing else."""

from typing import Any

import numpy as np
import pytest

from earthspin.errors import BodyError, EarthspinError
from earthspin.numerics.quaternion import rotate
from earthspin.rotor.euler import axis_stability, euler_rates, integrate_rotation, twice_energy
from earthspin.rotor.triaxial import free_rotation

BODY = [1.0, 2.0, 2.5]
START = [0.3, -0.2, 1.1]


def test_rates_are_those_of_the_vector_equation() -> None:
    """N = I w' + w x I w (I.2.6), the other way round."""
    rng = np.random.default_rng(3)
    omega, torque = rng.normal(size=(2, 50, 3))
    rates = euler_rates(BODY, omega, torque)
    found = BODY * rates + np.cross(omega, BODY * omega)
    np.testing.assert_allclose(found, torque, rtol=0, atol=5e-15)  # measured: 9e-16


def test_free_rates_leave_the_invariants() -> None:
    """The rates are across the gradients of 2T and L2 (I.5.1)."""
    omega = np.random.default_rng(4).normal(size=(50, 3))
    rates, inertia = euler_rates(BODY, omega), np.array(BODY)
    assert np.max(np.abs(np.sum(inertia * omega * rates, axis=-1))) < 5e-15  # measured: 1.8e-15
    assert np.max(np.abs(np.sum(inertia**2 * omega * rates, axis=-1))) < 2e-14
    assert twice_energy(BODY, [1.0, 2.0, 3.0]) == 1 + 8 + 22.5


def test_small_differences_keep_their_digits() -> None:
    """Subtracting rounded moments would leave three digits here."""
    body = {"A": 8e37, "B-A": 8e24 / 3, "C-A": 8e24}
    assert euler_rates(body, [1.0, 1.0, 0.0])[2] == pytest.approx(-1e-13 / 3, rel=1e-12, abs=0)


@pytest.mark.parametrize("moments", [(1.0, 2.0, 2.5), (2.5, 1.0, 2.0), (2.0, 2.5, 1.0)])
def test_stability_is_that_of_the_linearised_equations(moments: Any) -> None:
    """Eigenvalues of the Jacobian, taken numerically."""
    found = axis_stability(moments, 1.3)
    for axis in range(3):
        spin = 1.3 * np.eye(3)[axis]
        step = 1e-6
        jacobian = np.column_stack(
            [
                (euler_rates(moments, spin + step * e) - euler_rates(moments, spin - step * e))
                / (2 * step)
                for e in np.eye(3)
            ]
        )
        values = np.linalg.eigvals(jacobian)
        # measured: 4e-11, of the difference quotient
        assert found.growth_rate[axis] == pytest.approx(np.max(values.real), abs=2e-10)
        assert found.frequency[axis] == pytest.approx(np.max(values.imag), abs=2e-10)
    assert np.argsort(moments)[1] == np.argmax(found.growth_rate)
    assert np.count_nonzero(found.growth_rate) == 1
    assert np.count_nonzero(found.frequency) == 2


def test_equal_moments_neither_grow_nor_swing() -> None:
    found = axis_stability([1.0, 1.0, 1.5], np.array([1.0, 2.0]))
    assert found.growth_rate.tolist() == [[0, 0, 0], [0, 0, 0]]
    assert found.frequency[:, :2].tolist() == [[0, 0], [0, 0]]
    np.testing.assert_allclose(found.frequency[:, 2], [0.5, 1.0], rtol=1e-15)


def test_the_tennis_racket_leaves_its_middle_axis_at_that_rate() -> None:
    """A disturbance along the growing direction multiplies by e per time constant."""
    rate = axis_stability(BODY, 1.0).growth_rate[1]
    rotation = free_rotation(BODY, [1e-9, 1.0, 0.0], np.array([8.0, 9.0]) / rate)
    early, late = np.abs(rotation.omega_body[:, 0])
    assert late / early == pytest.approx(np.e, rel=1e-6, abs=0)  # e^-16 of the decaying part


def test_the_integrator_against_the_closed_form() -> None:
    times = np.array([7.0, -3.0, 0.0, 20.0, 7.0])
    stepped = integrate_rotation(BODY, START, times)
    closed = free_rotation(BODY, START, times)
    # measured: 2.9e-13 and 2.6e-13
    np.testing.assert_allclose(stepped.omega_body, closed.omega_body, rtol=0, atol=2e-12)
    np.testing.assert_allclose(stepped.attitude, closed.attitude, rtol=0, atol=2e-12)
    assert stepped.attitude[2].tolist() == [1, 0, 0, 0]
    assert stepped.evaluations > 500


def test_a_looser_tolerance_costs_less_and_is_worse() -> None:
    closed = free_rotation(BODY, START, [20.0]).omega_body
    runs = [integrate_rotation(BODY, START, [20.0], rtol=r, atol=r) for r in (1e-4, 1e-7, 1e-10)]
    off = [float(np.max(np.abs(run.omega_body - closed))) for run in runs]
    assert off[0] > 10 * off[1] > 100 * off[2]
    assert runs[0].evaluations < runs[1].evaluations < runs[2].evaluations


def test_a_torque_that_is_fixed_in_space_adds_up_in_space() -> None:
    """L(t) = L(0) + N t along inertial axes, whatever the body does."""
    push = np.array([0.3, -0.1, 0.2])

    def torque(_time: float, _omega: Any, attitude: Any) -> Any:
        inverse = attitude * np.array([1.0, -1.0, -1.0, -1.0])
        return rotate(inverse, push)

    times = np.linspace(0.0, 10.0, 6)
    run = integrate_rotation(BODY, START, times, torque=torque)
    momentum = rotate(run.attitude, BODY * run.omega_body)
    wanted = np.array(BODY) * START + np.multiply.outer(times, push)
    np.testing.assert_allclose(momentum, wanted, rtol=0, atol=3e-12)  # measured: 5e-13


def test_a_torque_about_the_axis_of_symmetry_spins_it_up() -> None:
    """Omega3 = t N/I3, and the wobble's phase grows as t^2."""
    run = integrate_rotation(
        [1.0, 1.0, 1.5], [0.1, 0.0, 0.0], [4.0], torque=lambda *_: np.array([0.0, 0.0, 0.3])
    )
    phase = 0.5 * 0.2 * 4.0**2 / 2  # (I3 - I1)/I1 times the integral of omega3
    wanted = [0.1 * np.cos(phase), 0.1 * np.sin(phase), 0.8]
    np.testing.assert_allclose(run.omega_body[0], wanted, rtol=0, atol=1e-13)


def test_what_cannot_be_integrated_is_named() -> None:
    with pytest.raises(BodyError, match=r"omega = \(2, 3\)"):
        integrate_rotation(BODY, np.ones((2, 3)), [1.0])
    with pytest.raises(EarthspinError, match="the integration stopped"):
        integrate_rotation(
            BODY, START, [1.0], torque=lambda t, *_: np.full(3, 0.0 if t < 0.5 else np.nan)
        )

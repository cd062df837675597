"""The symmetric rotor: cones, angles, and the same motion by other ways."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from earthspin.errors import BodyError, UndefinedError
from earthspin.numerics.quaternion import multiply, rotate
from earthspin.rotor.axisymmetric import (
    SymmetricRotor,
    free_wobble_error,
    free_wobble_period,
    speed_and_cone,
    wobble_rate_of_cones,
)
from earthspin.rotor.euler import euler_rates, integrate_rotation
from earthspin.rotor.triaxial import free_rotation

OBLATE = SymmetricRotor(1.2, 0.5, 0.9, 0.7)
PROLATE = SymmetricRotor(1.2, -0.8, 0.9, 0.7)
TIMES = np.linspace(0.0, 30.0, 7)
ROTORS = pytest.mark.parametrize(
    "rotor",
    [OBLATE, PROLATE, SymmetricRotor(1.2, 0.5, 0.9, 2.6), SymmetricRotor(2.0, 0.0, 1.0, 1.0)],
)

rotors = st.builds(
    SymmetricRotor,
    st.floats(0.5, 2.0),
    st.floats(-0.45, 0.5),
    st.floats(0.1, 10.0),
    st.floats(0.01, np.pi - 0.01),
)


def moments(rotor: SymmetricRotor) -> dict[str, Any]:
    return {"A": rotor.equatorial, "B-A": 0.0, "C-A": rotor.difference}


def as_scipy(q: Any) -> Rotation:
    return Rotation.from_quat(np.roll(q, -1, axis=-1))


@ROTORS
def test_omega_solves_eulers_equations(rotor: SymmetricRotor) -> None:
    """The rate by a complex step through the phase, against (I.4.4)."""
    omega, step = rotor.omega_body(TIMES), 1e-6
    rates = (rotor.omega_body(TIMES + step) - rotor.omega_body(TIMES - step)) / (2 * step)
    np.testing.assert_allclose(rates, euler_rates(moments(rotor), omega), rtol=0, atol=1e-9)


@ROTORS
def test_the_full_equations_step_by_step(rotor: SymmetricRotor) -> None:
    run = integrate_rotation(moments(rotor), rotor.omega_body([0.0])[0], TIMES)
    np.testing.assert_allclose(rotor.omega_body(TIMES), run.omega_body, rtol=0, atol=3e-12)
    # The integrator's inertial axes are the body's at t = 0.
    turn = multiply(rotor.attitude([0.0]), run.attitude)
    np.testing.assert_allclose(rotor.attitude(TIMES), turn, rtol=0, atol=3e-12)  # measured: 3e-13


@given(rotors)
def test_jacobis_form_at_equal_moments_is_this_one(rotor: SymmetricRotor) -> None:
    times = np.linspace(-5.0, 5.0, 5) / rotor.speed
    free = free_rotation(moments(rotor), rotor.omega_body([0.0])[0], times)
    turn = multiply(rotor.attitude([0.0]), free.attitude)
    # measured: 2.4e-15
    np.testing.assert_allclose(
        rotor.omega_body(times), free.omega_body, rtol=0, atol=1e-14 * rotor.speed
    )
    np.testing.assert_allclose(rotor.attitude(times), turn, rtol=0, atol=2e-14)


@ROTORS
def test_angular_momentum_is_upright_and_stays(rotor: SymmetricRotor) -> None:
    body = rotor.angular_momentum_body(TIMES)
    inertia = np.array([rotor.equatorial, rotor.equatorial, rotor.polar])
    np.testing.assert_allclose(body, inertia * rotor.omega_body(TIMES), rtol=3e-16, atol=3e-16)
    space = rotate(rotor.attitude(TIMES), body)
    np.testing.assert_allclose(
        space, np.tile([0, 0, rotor.angular_momentum], (7, 1)), rtol=0, atol=5e-15
    )


@ROTORS
def test_omega_in_space(rotor: SymmetricRotor) -> None:
    turned = rotate(rotor.attitude(TIMES), rotor.omega_body(TIMES))
    np.testing.assert_allclose(rotor.omega_inertial(TIMES), turned, rtol=0, atol=5e-15)


@ROTORS
def test_euler_angles_build_the_attitude(rotor: SymmetricRotor) -> None:
    """R = Rz(phi) Rx(theta) Rz(psi)."""
    built = Rotation.from_euler("ZXZ", rotor.euler_angles(TIMES)).as_matrix()
    np.testing.assert_allclose(
        as_scipy(rotor.attitude(TIMES)).as_matrix(), built, rtol=0, atol=5e-15
    )


@ROTORS
def test_tensor_in_space(rotor: SymmetricRotor) -> None:
    r = as_scipy(rotor.attitude(TIMES)).as_matrix()
    wanted = r @ np.diag([rotor.equatorial, rotor.equatorial, rotor.polar]) @ r.transpose(0, 2, 1)
    tensor = rotor.inertia_tensor(TIMES)
    np.testing.assert_allclose(tensor, wanted, rtol=0, atol=5e-15)
    momentum = np.einsum("tij,tj->ti", tensor, rotor.omega_inertial(TIMES))
    np.testing.assert_allclose(momentum[:, 2], rotor.angular_momentum, rtol=5e-15)
    np.testing.assert_allclose(r[..., 2], rotor.figure_axis(TIMES), rtol=0, atol=5e-15)


@given(rotors)
def test_the_cones(rotor: SymmetricRotor) -> None:
    omega, axis = rotor.omega_inertial(np.array([1.7])), rotor.figure_axis(np.array([1.7]))
    unit = omega[0] / rotor.speed
    assert np.dot(unit, axis[0]) == pytest.approx(np.cos(rotor.alpha), abs=5e-15)
    assert unit[2] == pytest.approx(np.cos(rotor.space_cone), abs=5e-15)
    assert axis[0, 2] == pytest.approx(np.cos(rotor.theta), abs=5e-15)
    assert rotor.tilt == pytest.approx(rotor.alpha - rotor.theta, abs=5e-15)
    # omega between figure axis and L in a prolate body, beyond L in an oblate one.
    if abs(rotor.difference) > 1e-9 and abs(rotor.alpha - np.pi / 2) > 1e-3:
        assert rotor.rolling == ("inside" if rotor.difference > 0 else "outside")
        between = abs(rotor.alpha - np.pi / 2) - abs(rotor.theta - np.pi / 2)
        assert np.sign(between) == -np.sign(rotor.difference)


@given(rotors)
def test_identity_of_the_wobbles_rate(rotor: SymmetricRotor) -> None:
    """(I.6.27): the two differ by what alpha - theta loses, an ulp of alpha over sin theta."""
    found = wobble_rate_of_cones(rotor.speed, rotor.alpha, rotor.theta)
    allowed = 3e-15 * rotor.speed / np.sin(rotor.theta)  # measured: 7e-16 at most
    assert abs(found - rotor.wobble_rate) < allowed


@given(rotors)
def test_cones_roll_without_slipping(rotor: SymmetricRotor) -> None:
    """Rims pass the line of contact at the same speed."""
    body = rotor.wobble_rate * np.sin(rotor.alpha)
    space = rotor.precession_rate * np.sin(rotor.tilt)
    assert body == pytest.approx(space, rel=2e-14, abs=1e-15 * rotor.speed)


@given(rotors)
def test_speed_and_cone_come_back_from_energy_and_momentum(rotor: SymmetricRotor) -> None:
    if abs(rotor.difference) < 1e-3:
        return
    speed, alpha = speed_and_cone(
        rotor.equatorial, rotor.difference, rotor.energy, rotor.angular_momentum
    )
    acute = min(rotor.alpha, np.pi - rotor.alpha)
    # An ulp of T moves alpha by ulp (I/(I3 - I1))/sin(2 alpha).
    blur = 1e-14 / abs(rotor.difference) / np.sin(2 * acute) if acute < np.pi / 2 else 1.0
    assert alpha == pytest.approx(acute, abs=min(max(blur, 1e-14), 1e-5))
    assert speed == pytest.approx(rotor.speed, rel=1e-14 / abs(rotor.difference) + 1e-14, abs=0)


def test_speed_and_cone_at_the_ends() -> None:
    for alpha in (0.0, np.pi / 2):
        rotor = SymmetricRotor(1.0, 0.5, 0.3, alpha)
        _, found = speed_and_cone(1.0, 0.5, rotor.energy, rotor.angular_momentum)
        assert found == pytest.approx(alpha, abs=1e-7)
    with pytest.raises(UndefinedError, match=r"1\.0 and .*1\.5"):
        speed_and_cone(1.0, 0.5, 1.0, 2.0)
    with pytest.raises(UndefinedError, match="sphere"):
        speed_and_cone(1.0, 0.0, 1.0, 1.0)
    with pytest.raises(UndefinedError, match="do not determine alpha"):
        speed_and_cone(1.0, 0.0, 0.5, 1.0)


def test_numbers_of_one_oblate_and_one_prolate_body() -> None:
    """By hand: I1 = 2, I3 = 3 or 1, omega = (3, 0, 4)/5."""
    alpha = np.arctan2(3.0, 4.0)
    oblate, prolate = (SymmetricRotor(2.0, d, 1.0, alpha) for d in (1.0, -1.0))
    assert oblate.wobble_rate == pytest.approx(0.4, rel=1e-15, abs=0)
    assert prolate.wobble_rate == pytest.approx(-0.4, rel=1e-15, abs=0)
    assert oblate.angular_momentum == pytest.approx(np.sqrt(36 + 144) / 5, rel=1e-15, abs=0)
    assert prolate.angular_momentum == pytest.approx(np.sqrt(36 + 16) / 5, rel=1e-15, abs=0)
    assert np.tan(oblate.theta) == pytest.approx(0.5, rel=1e-15, abs=0)
    assert np.tan(prolate.theta) == pytest.approx(1.5, rel=1e-15, abs=0)
    assert oblate.energy == pytest.approx((2 * 9 + 3 * 16) / 50, rel=1e-15, abs=0)
    assert np.tan(oblate.space_cone) == pytest.approx((0.75 - 0.5) / (1 + 0.375), rel=1e-15, abs=0)
    assert np.tan(prolate.space_cone) == pytest.approx((1.5 - 0.75) / (1 + 1.125), rel=1e-15, abs=0)
    assert (oblate.rolling, prolate.rolling) == ("inside", "outside")
    assert SymmetricRotor(2.0, 0.0, 1.0, alpha).rolling == "not"
    assert SymmetricRotor(2.0, 1.0, 1.0, 0.0).rolling == "not"


def test_a_nearly_round_body_keeps_the_digits_of_its_space_cone() -> None:
    """Alpha - theta = e sin(alpha) cos(alpha) to first order in e = 1e-9."""
    rotor = SymmetricRotor(1.0, 1e-9, 1.0, 1e-6)
    assert rotor.space_cone == pytest.approx(1e-9 * np.sin(1e-6) * np.cos(1e-6), rel=2e-9, abs=0)


def test_many_rotors() -> None:
    many = SymmetricRotor(np.array([1.2, 1.2]), np.array([0.5, -0.8]), 0.9, 0.7)
    for row, one in enumerate((OBLATE, PROLATE)):
        for name in ("omega_body", "omega_inertial", "euler_angles", "attitude", "inertia_tensor"):
            np.testing.assert_allclose(
                getattr(many, name)(TIMES)[row], getattr(one, name)(TIMES), rtol=1e-15, atol=1e-15
            )
    assert many.rolling.tolist() == ["inside", "outside"]


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ((0.0, 0.1, 1.0, 0.1), "equatorial = 0.0"),
        ((1.0, 1.1, 1.0, 0.1), "difference = 1.1"),
        ((1.0, -1.0, 1.0, 0.1), "difference = -1.0"),
        ((1.0, 0.1, 0.0, 0.1), "speed = 0.0"),
        ((1.0, 0.1, 1.0, -0.1), "alpha = -0.1"),
        ((1.0, 0.1, 1.0, np.nan), "alpha = nan"),
        ((1.0, 0.1, 1.0, np.array([0.1, 4.0])), "alpha = 4.0"),
    ],
)
def test_a_value_outside_its_range_is_named(values: Any, words: str) -> None:
    with pytest.raises(BodyError, match=words.replace(".", r"\.")):
        SymmetricRotor(*values)


def test_no_cone_has_no_rate() -> None:
    with pytest.raises(UndefinedError, match="there is no cone"):
        wobble_rate_of_cones(1.0, 0.0, 0.0)


def test_period_of_the_wobble() -> None:
    assert free_wobble_period(0.01, 1.0) == pytest.approx(100.0, rel=1e-15, abs=0)
    assert free_wobble_period(0.0, 1.0) == np.inf
    rotor = SymmetricRotor(1.0, 0.01, 2 * np.pi, 1e-9)
    assert 2 * np.pi / rotor.wobble_rate == pytest.approx(100.0, rel=1e-15, abs=0)
    # 95 % of a normal distribution lie within 1.96 standard deviations.
    assert free_wobble_error(300.0, 0.0, 1e-3) == pytest.approx(0.588, abs=1e-4)


def test_error_of_the_period_is_what_moving_h_gives() -> None:
    """At a flattening so large that A and C are far apart: P = (1 - H)/H turns."""
    h, u = 0.25, 1e-6
    moved = [free_wobble_period((h * (1 + s * u)) / (1 - h * (1 + s * u)), 1.0) for s in (-1, 1)]
    shift = 1.959963984540054 * (moved[0] - moved[1]) / 2
    # 2e-10 measured, of the difference of two floats
    assert free_wobble_error(3.0, h, u) == pytest.approx(shift, rel=1e-9, abs=0)

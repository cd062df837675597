"""Ellipsoids, polhode and herpolhode."""

from typing import Any

import mpmath as mp
import numpy as np
import pytest
from scipy.optimize import brentq

from earthspin.errors import UndefinedError
from earthspin.rotor.axisymmetric import SymmetricRotor
from earthspin.rotor.euler import twice_energy
from earthspin.rotor.poinsot import (
    herpolhode,
    herpolhode_advance,
    herpolhode_radii,
    inertia_ellipsoid,
    invariable_plane_distance,
    momentum_ellipsoid,
    polhode,
    rescaled_inertia_ellipsoid,
)
from earthspin.rotor.triaxial import free_rotation
from tests.rotor.families import cases
from tests.rotor.textbook import DIGITS, Textbook

BODY = [1.0, 2.0, 2.5]
ABOUT_C, ABOUT_A = [0.3, 0.2, 1.0], [-1.0, 0.2, 0.3]
SEPARATRIX = ([3.0, 4.0, 6.0], [2.0, 0.3, 1.0])
STARTS = pytest.mark.parametrize("omega", [ABOUT_C, ABOUT_A, [0.4, 1.0, -0.1], [0.1, -1.0, 0.5]])


def test_ellipsoids_of_one_body() -> None:
    """By hand: 2T = 18 and L2 = 36 + 36."""
    moments, omega = [3.0, 4.0, 6.0], [2.0, 0.0, 1.0]
    np.testing.assert_allclose(
        inertia_ellipsoid(moments, omega), np.sqrt([6.0, 4.5, 3.0]), rtol=3e-16
    )
    np.testing.assert_allclose(
        momentum_ellipsoid(moments, omega), np.sqrt(72) / [3.0, 4.0, 6.0], rtol=3e-16
    )
    assert invariable_plane_distance(moments, omega) == pytest.approx(
        18 / np.sqrt(72), rel=3e-16, abs=0
    )


@STARTS
def test_the_rescaled_ellipsoid_is_that_of_the_body_alone(omega: Any) -> None:
    """rho = omega/sqrt(2T) stays on it, and rho . I rho = 1, on the whole polhode."""
    rho = polhode(BODY, omega, 50).omega / np.sqrt(np.sum(BODY * np.square(omega)))
    axes = rescaled_inertia_ellipsoid(BODY)
    np.testing.assert_allclose(np.sum((rho / axes) ** 2, axis=-1), 1, rtol=3e-15)
    np.testing.assert_allclose(np.sum(BODY * rho**2, axis=-1), 1, rtol=3e-15)


@STARTS
def test_polhode_is_closed_and_on_both_ellipsoids(omega: Any) -> None:
    path = polhode(BODY, omega, 50)
    assert path.closed
    assert path.omega.shape == (50, 3)
    assert np.array_equal(path.omega[0], path.omega[-1])
    np.testing.assert_allclose(path.omega[0], omega, rtol=0, atol=3e-16)
    for axes in (inertia_ellipsoid(BODY, omega), momentum_ellipsoid(BODY, omega)):
        np.testing.assert_allclose(np.sum((path.omega / axes) ** 2, axis=-1), 1, rtol=3e-15)
    # Once round the axis that it circles, and on the same side of the body.
    momentum_squared = np.sum((np.array(BODY) * omega) ** 2)
    first, third = [0, 2] if momentum_squared > 2 * twice_energy(BODY, omega) else [2, 0]
    assert np.all(np.sign(path.omega[:, third]) == np.sign(omega[third]))
    angle = np.unwrap(np.arctan2(path.omega[:, 1], path.omega[:, first]))
    assert abs(angle[-1] - angle[0]) == pytest.approx(2 * np.pi, rel=1e-14, abs=0)


@STARTS
def test_the_motion_keeps_to_its_polhode(omega: Any) -> None:
    """A period later omega is back, and half of one later at the opposite point."""
    period = float(polhode(BODY, omega).period)
    back = free_rotation(BODY, omega, np.array([0.5, 1.0, 7.0]) * period).omega_body
    np.testing.assert_allclose(back[1:], [omega, omega], rtol=0, atol=3e-14)  # a rounded period
    about = 2 if np.sign(back[0, 2]) == np.sign(omega[2]) else 0
    wanted = -np.array(omega)
    wanted[about] = omega[about]
    np.testing.assert_allclose(back[0], wanted, rtol=0, atol=3e-14)


def test_polhode_of_the_separatrix_is_open() -> None:
    path = polhode(*SEPARATRIX, 41)
    assert not path.closed
    assert path.period == np.inf
    end = np.sqrt((3 * 4 + 4 * 0.09 + 6) / 4)  # 2T = B w^2
    np.testing.assert_allclose(path.omega[[0, -1]], [[0, -end, 0], [0, end, 0]], rtol=0, atol=1e-15)
    # An ellipse in the plane w1 = 2 w3.
    np.testing.assert_allclose(path.omega[:, 0], 2 * path.omega[:, 2], rtol=0, atol=1e-15)
    assert np.all(path.omega[1:-1, 2] > 0)
    np.testing.assert_allclose(twice_energy(SEPARATRIX[0], path.omega), 4 * end**2, rtol=1e-15)


@pytest.mark.parametrize("axis", range(3))
def test_about_an_axis_both_curves_are_points(axis: int) -> None:
    omega = -np.eye(3)[axis]
    path = polhode(BODY, omega, 5)
    assert path.closed
    assert np.array_equal(path.omega, np.tile(omega, (5, 1)))
    assert herpolhode_radii(BODY, omega).tolist() == [0.0, 0.0]
    assert not np.any(herpolhode(BODY, omega, [0.0, 1.0, 5.0]))


@STARTS
def test_omega_runs_in_the_invariable_plane(omega: Any) -> None:
    """At 2T/L from the centre (I.5.7), along the herpolhode."""
    times = np.linspace(0, 40, 200)
    momentum = np.array(BODY) * omega
    up = momentum / np.linalg.norm(momentum)
    points = free_rotation(BODY, omega, times).omega_inertial
    height = points @ up
    np.testing.assert_allclose(height, invariable_plane_distance(BODY, omega), rtol=3e-15)
    across = points - np.outer(height, up)
    first = across[0] / np.linalg.norm(across[0])
    plane = np.column_stack([across @ first, across @ np.cross(up, first)])
    np.testing.assert_allclose(herpolhode(BODY, omega, times), plane, rtol=0, atol=5e-15)


@STARTS
def test_herpolhode_runs_between_its_radii(omega: Any) -> None:
    times = np.linspace(0, 3 * float(polhode(BODY, omega).period), 20000)
    radius = np.linalg.norm(herpolhode(BODY, omega, times), axis=-1)
    low, high = herpolhode_radii(BODY, omega)
    # The extremes fall between two points, of which there are 3000 to a swing.
    assert low * (1 - 1e-14) < np.min(radius) < low * (1 + 1e-5)
    assert high * (1 - 1e-5) < np.max(radius) < high * (1 + 1e-14)


@pytest.mark.parametrize("family", ["generic", "earth-like", "near the sphere"])
def test_radii_and_advance_at_many_digits(family: str) -> None:
    """The textbook's node over one period; |omega|^2 - (2T/L)^2 where sn and cn vanish."""
    for case in cases(family, 10):
        with mp.workdps(DIGITS):
            book = Textbook(*case)
            node = book.node(book.period) - book.node(mp.mpf(0))
            i1, _, i3 = book.moments
            twice = i1 * book.a1**2 + i3 * book.a3**2
            ends = [
                mp.sqrt(book.a1**2 + book.a3**2 - (twice / book.g) ** 2),
                mp.sqrt(book.a2**2 + (1 - book.m) * book.a3**2 - (twice / book.g) ** 2),
            ]
            low, high = sorted(map(float, ends))
            advance = float(node)
        assert herpolhode_advance(*case) == pytest.approx(
            advance, rel=1e-15, abs=0
        )  # measured: 1.2e-16
        # measured: 6e-16
        np.testing.assert_allclose(herpolhode_radii(*case), [low, high], rtol=4e-15)


@STARTS
def test_advance_is_what_the_path_turns_by(omega: Any) -> None:
    period = float(polhode(BODY, omega).period)
    path = herpolhode(BODY, omega, np.linspace(0, period, 500))
    angle = np.unwrap(np.arctan2(path[:, 1], path[:, 0]))
    assert herpolhode_advance(BODY, omega) == pytest.approx(angle[-1], rel=1e-14, abs=0)


def test_a_herpolhode_that_closes() -> None:
    """A start is sought whose polhode turns it by 17/6 of a turn."""

    def off(third: float) -> float:
        return float(herpolhode_advance(BODY, [0.3, 0.2, third])) - 2 * np.pi * 17 / 6

    omega = [0.3, 0.2, brentq(off, 0.4, 3.0, xtol=1e-15)]
    period = float(polhode(BODY, omega).period)
    path = herpolhode(BODY, omega, np.array([0.0, 1.0, 5.0, 6.0]) * period)
    np.testing.assert_allclose(path[3], path[0], rtol=0, atol=1e-12)
    assert np.min(np.linalg.norm(path[1:3] - path[0], axis=-1)) > 0.05


def test_herpolhode_has_no_inflection() -> None:
    """It bends one way only, for every body that can exist (Hess 1880, de Sparre 1884)."""
    for case in cases("generic", 20):
        period = float(polhode(*case).period)
        times, step = np.linspace(0, period, 400), 1e-4 * period
        before, at, after = (herpolhode(*case, t) for t in (times - step, times, times + step))
        first, second = (after - before) / (2 * step), (after - 2 * at + before) / step**2
        bend = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
        assert np.all(bend > 0)


def test_symmetric_bodies_have_circles() -> None:
    for difference in (0.5, -0.6):
        rotor = SymmetricRotor(1.0, difference, 1.1, 0.7)
        moments = {"A": 1.0, "B-A": 0.0, "C-A": difference}
        omega = rotor.omega_body([0.0])[0]
        radius = rotor.speed * np.sin(rotor.space_cone)
        np.testing.assert_allclose(herpolhode_radii(moments, omega), radius, rtol=2e-15)
        period = 2 * np.pi / abs(rotor.wobble_rate)
        assert polhode(moments, omega).period == pytest.approx(period, rel=1e-15, abs=0)
        wanted = rotor.precession_rate * period
        assert herpolhode_advance(moments, omega) == pytest.approx(wanted, rel=2e-15, abs=0)
        across = np.linalg.norm(polhode(moments, omega).omega[:, :2], axis=-1)
        np.testing.assert_allclose(across, rotor.speed * np.sin(rotor.alpha), rtol=1e-15)


def test_the_separatrix_winds_into_the_centre() -> None:
    low, high = herpolhode_radii(*SEPARATRIX)
    radius = np.linalg.norm(herpolhode(*SEPARATRIX, [0.0, 5.0, 20.0, 60.0]), axis=-1)
    assert low == 0
    assert high > radius[0] > radius[1] > 1e3 * radius[2] > 1e6 * radius[3]


@pytest.mark.parametrize(
    ("moments", "omega"), [SEPARATRIX, ([1.0, 1.0, 1.0], ABOUT_C), ([1, 1, 1.5], [1, 1, 0])]
)
def test_without_a_period_there_is_no_advance(moments: Any, omega: Any) -> None:
    with pytest.raises(UndefinedError, match="no period"):
        herpolhode_advance(moments, omega)


def test_many_bodies() -> None:
    moments = np.array([BODY, [3.0, 4.0, 6.0], [1.0, 1.0, 1.0]])
    omega = np.array([ABOUT_A, [2.0, 0.3, 1.0], [1.0, 2.0, 3.0]])
    times = np.linspace(0, 5, 4)
    assert polhode(moments, omega, 9).closed.tolist() == [True, False, True]
    for row in range(3):
        one, start = moments[row], omega[row]
        np.testing.assert_allclose(
            herpolhode(moments, omega, times)[row],
            herpolhode(one, start, times),
            rtol=0,
            atol=3e-15,
        )
        np.testing.assert_allclose(
            polhode(moments, omega, 9).omega[row], polhode(one, start, 9).omega, rtol=0, atol=1e-15
        )

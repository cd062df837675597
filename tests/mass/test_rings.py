"""The toys: dumbbells, rings and ellipses of masses, numerically and in closed form."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from earthspin.errors import BodyError, UndefinedError
from earthspin.mass import rings
from tests.mass.closeness import close
from tests.refusals import refused

#: Random bodies; 600 in the full run.
CASES = 60

ANGLES = st.integers(-3000, 3000).map(lambda k: k / 1000)


def _sum_of_forces(
    gm: float, place: np.ndarray, masses: np.ndarray, positions: np.ndarray
) -> list[mp.mpf]:
    """Sum of s x F about the centre of mass, 60 digits, no trick."""
    with mp.workdps(60):
        r = [[mp.mpf(float(c)) for c in p] for p in positions]
        m = [mp.mpf(float(k)) for k in masses]
        total = mp.fsum(m)
        centre = [mp.fsum(k * p[i] for k, p in zip(m, r, strict=True)) / total for i in range(3)]
        torque = [mp.mpf(0)] * 3
        for k, p in zip(m, r, strict=True):
            apart = [mp.mpf(float(place[i])) - p[i] for i in range(3)]
            cube = mp.sqrt(mp.fsum(a * a for a in apart)) ** 3
            force = [mp.mpf(gm) * k * a / cube for a in apart]
            s = [p[i] - centre[i] for i in range(3)]
            for i, j, n in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
                torque[i] += s[j] * force[n] - s[n] * force[j]
        return torque


def test_against_sixty_digits_near_and_far() -> None:
    """Distances from 0.2 to 10^8 times the size; measured over 1800: 1.3e-16 of the terms."""
    rng = np.random.default_rng(0)
    for _ in range(CASES):
        masses, positions = rng.uniform(1, 2, 5), rng.normal(size=(5, 3))
        size = np.max(np.linalg.norm(positions, axis=-1))
        direction = rng.normal(size=3)
        distance = size * 10 ** rng.uniform(-0.7, 8)
        place = distance * direction / np.linalg.norm(direction)
        found = rings.torque_on_masses(3.0, place, masses, positions)
        exact = _sum_of_forces(3.0, place, masses, positions)
        nearest = np.min(np.linalg.norm(place - positions, axis=-1))
        scale = 3 * 3.0 * np.sum(masses) * size**2 / nearest**3
        error = max(abs(float(mp.mpf(float(f)) - e)) for f, e in zip(found, exact, strict=True))
        assert error <= 1e-15 * scale


@given(ANGLES)
def test_a_dumbbell_turns_towards_the_mass(angle: float) -> None:
    """(I.8.2), up to (5/2) (r/b)^2 (measured: 3e-9 at b = 3e4 r)."""
    positions = rings.ring_positions(2, 2.0, angle)
    exact = rings.torque_on_masses(5.0, [6e4, 0.0, 0.0], 3.0 * np.ones(2), positions)
    closed = rings.ring_torque(5.0, 6e4, 3.0, 2.0, 2, angle)
    scale = 6 * 5.0 * 3.0 * 4.0 / 6e4**3
    assert close(closed, -scale * np.sin(angle) * np.cos(angle), abs=1e-15 * scale)
    assert close(exact[2], float(closed), abs=1e-8 * scale)
    assert np.all(exact[:2] == 0)


@given(ANGLES, st.integers(1, 90), st.integers(1, 90))
def test_two_dumbbells(angle: float, first: int, second: int) -> None:
    """(I.8.3) and (I.8.5): mirrored in the line to the mass they cancel if alike."""
    one, other = first / 10, second / 10
    both = rings.ring_torque(2.0, 1e3, 3.0, one, 2, angle)
    both = both + rings.ring_torque(2.0, 1e3, 3.0, other, 2, -angle)
    expected = 6 * 2.0 * 3.0 / 1e9 * (other**2 - one**2) * np.sin(angle) * np.cos(angle)
    assert close(both, expected, abs=1e-15 * 36e-9 * (one**2 + other**2))
    if first == second:
        assert both == 0


@pytest.mark.parametrize("count", [2, 3, 4, 5, 6, 8])
def test_a_ring_keeps_a_torque_of_the_order_of_its_count(count: int) -> None:
    """Zero at leading order for three or more; the rest as the closed form has it, up to r/b.

    The relative error falls as (r/b)^2, by 100 from 20 to 200 radii (three masses have a term
    in (r/b)^3 beside it); the sum in 60 digits, as a ring of floats is not round enough.
    """
    errors = []
    for distance in (20, 200):
        with mp.workdps(60):
            torque = mp.mpf(0)
            for k in range(count):
                angle = mp.mpf("0.3") + 2 * mp.pi * k / count
                x, y = mp.cos(angle), mp.sin(angle)
                cube = mp.sqrt((distance - x) ** 2 + y**2) ** 3
                torque += (x * (0 - y) - y * (distance - x)) / cube
            closed = rings.ring_torque(1.0, float(distance), 1.0, 1.0, count, 0.3)
            errors.append(float(mp.mpf(float(closed)) / torque - 1))
    assert abs(errors[1]) < 1e-4 * count
    assert close(errors[0] / errors[1], 100, rel=0.25)


def test_four_masses_leave_a_higher_torque_and_the_full_circle_none() -> None:
    """(35/4) GM m r4/b5 sin 4 angle, against the kernel's own sum of forces."""
    ring = rings.ring_positions(4, 1.0, 0.3)
    place = np.array([100.0, 0.0, 0.0])
    exact = rings.torque_on_masses(1.0, place, np.ones(4), ring)[2]
    assert close(exact, -35 / 4 * 1e-10 * np.sin(1.2), rel=2e-4)
    assert abs(exact) < 1e-3 * abs(rings.ring_torque(1.0, 100.0, 1.0, 1.0, 2, 0.3))
    many = rings.torque_on_masses(1.0, place, 1.0, rings.ring_positions(720, 1.0, 0.3))
    # Measured: 1.2e-16 of the terms.
    assert np.max(np.abs(many)) < 1e-15 * 720 * 3e-6


@given(st.integers(3, 12), ANGLES, ANGLES)
def test_an_ellipse_of_masses(count: int, tilt: float, start: float) -> None:
    """The closed form against the sum of forces: 3e-8 at 10^4 (N = 4: next order r2/b2)."""
    positions = rings.ellipse_positions(count, 3.0, 2.0, tilt, start)
    exact = rings.torque_on_masses(7.0, [1e5, 0.0, 0.0], 2.0 * np.ones(count), positions)
    closed = rings.ellipse_torque(7.0, 1e5, 2.0, 3.0, 2.0, count, tilt)
    scale = 1.5 * count * 7.0 * 2.0 * 5.0 / 1e15
    assert close(closed, -scale * np.sin(tilt) * np.cos(tilt), abs=1e-15 * scale)
    # Three masses have a torque of the next order, r/b; more have of r2/b2.
    assert close(exact[2], float(closed), abs=(3e-4 if count == 3 else 1e-8) * scale)


def test_the_ellipse_turns_its_long_axis_towards_the_mass() -> None:
    assert rings.ellipse_torque(1.0, 10.0, 1.0, 2.0, 1.0, 8, 0.3) < 0
    assert rings.ellipse_torque(1.0, 10.0, 1.0, 2.0, 1.0, 8, -0.3) > 0
    assert rings.ellipse_torque(1.0, 10.0, 1.0, 1.5, 1.5, 8, 0.3) == 0


def test_the_torque_is_about_the_centre_of_mass() -> None:
    """Shifting body and mass together changes nothing; one mass alone has no torque."""
    rng = np.random.default_rng(1)
    masses, r, place = rng.uniform(1, 2, 4), rng.normal(size=(4, 3)), np.array([5.0, 6.0, 7.0])
    here = rings.torque_on_masses(1.0, place, masses, r)
    there = rings.torque_on_masses(1.0, place + 10, masses, r + 10)
    assert close(here, there, rel=1e-12)
    assert np.all(rings.torque_on_masses(1.0, place, [2.0], [[1.0, 1.0, 1.0]]) == 0)


def test_at_the_centre_there_is_no_torque() -> None:
    ring = rings.ring_positions(6, 1.0)
    assert close(rings.torque_on_masses(1.0, [0.0, 0.0, 0.0], 1.0, ring), np.zeros(3), abs=1e-15)


def test_many_places() -> None:
    places = np.random.default_rng(0).normal(size=(5, 2, 3)) * 50
    ring = rings.ring_positions(6, 1.0)
    many = rings.torque_on_masses(1.0, places, np.ones(6), ring)
    assert many.shape == (5, 2, 3)
    one = rings.torque_on_masses(1.0, places[3, 1], np.ones(6), ring)
    assert close(many[3, 1], one, rel=2e-15)


test_wrong_input = refused(
    (lambda: rings.ring_torque(1.0, 1.0, 1.0, 1.0, 1, 0.0), UndefinedError, "count = 1"),
    (
        lambda: rings.ellipse_torque(1.0, 9.0, 1.0, 2.0, 1.0, 2, 0.0),
        UndefinedError,
        "count = 2 masses are too few; give 3",
    ),
    (lambda: rings.ring_torque(1.0, 9.0, -1.0, 1.0, 2, 0.0), BodyError, r"mass = -1\.0"),
    (lambda: rings.ring_positions(3, 0.0), BodyError, r"semi-axis = 0\.0"),
    (
        lambda: rings.torque_on_masses(1.0, [1.0, 0, 0], 1.0, [[1.0, 0, 0], [-1.0, 0, 0]]),
        UndefinedError,
        "coincides with one of the masses",
    ),
)

"""The expansion in (n, m): harmonics, 1/R, moments, potentials, where it converges."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation
from scipy.special import lpmv

from earthspin.constants import G
from earthspin.errors import BodyError, UndefinedError
from earthspin.mass import multipoles
from earthspin.mass.multipoles import factorial_ratio
from earthspin.mass.tensor import grid_masses, inertia_tensor
from tests.mass.accuracy import inverse_distance
from tests.mass.closeness import close
from tests.refusals import refused

#: Random pairs of points; 600 in the full run.
CASES = 60


def _angles(r: np.ndarray) -> tuple[Any, Any, Any]:
    return np.linalg.norm(r), np.arctan2(np.hypot(r[0], r[1]), r[2]), np.arctan2(r[1], r[0])


def _racah(n: int, m: int, r: np.ndarray) -> Any:
    """The definition, from scipy's associated Legendre functions."""
    _, theta, phi = _angles(r)
    root = np.sqrt(factorial_ratio(n, -m))
    return root * lpmv(m, n, np.cos(theta)) * np.exp(1j * m * phi)


def _lpmv_knows(point: tuple[float, float, float]) -> bool:
    """Whether the cosine that scipy takes still tells the angle: not next to the axis."""
    across = np.hypot(point[0], point[1])
    return any(point) and (across == 0 or across > 0.05 * abs(point[2]))


@given(st.tuples(*[st.integers(-1000, 1000).map(lambda k: k / 300)] * 3).filter(_lpmv_knows))
def test_solid_harmonics_are_what_they_are_said_to_be(point: tuple[float, float, float]) -> None:
    """Measured: 4.1e-15 r^n, much of it the error of lpmv."""
    r = np.array(point)
    for n, m, value in multipoles.solid_harmonics(r, 8):
        size = np.linalg.norm(r) ** n
        assert close(value, size * _racah(n, m, r), abs=2e-14 * size)


def _random_body(seed: int, count: int = 9) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    return rng.uniform(0.5, 2, count), rng.normal(size=(count, 3))


def test_inverse_distance_against_fifty_digits() -> None:
    """Ratios of the distances up to 0.8, degree 180; measured over 600: 9.1e-15."""
    assert inverse_distance(CASES) < 5e-14


@given(st.integers(0, 10**6), st.integers(0, 20))
def test_inverse_distance_stays_within_its_bound(seed: int, n_max: int) -> None:
    rng = np.random.default_rng(seed)
    one, other = rng.normal(size=(2, 40, 3))
    exact = 1 / np.linalg.norm(one - other, axis=-1)
    error = np.abs(multipoles.inverse_distance(one, other, n_max) - exact)
    bound = multipoles.inverse_distance_bound(one, other, n_max)
    assert np.all(error <= bound + 3e-14 * exact)


def test_the_bound_is_reached_in_line() -> None:
    """On one ray all P_n are 1: the error is the bound itself."""
    bound = multipoles.inverse_distance_bound([0.0, 0, 1], [0.0, 0, 2], 7)
    assert close(1 - multipoles.inverse_distance([0.0, 0, 1], [0.0, 0, 2], 7), bound, rel=1e-14)


def test_the_three_normalisations_agree() -> None:
    """(I.9.12) and (I.9.13) unnormalised, Jackson's (3.70), and the kernel, to degree 6.

    (I.9.19) as printed is Jackson's without its 4 pi/(2n + 1); with the source's own harmonics
    (I.9.16) it lacks f(n, -m).
    """
    one, other = np.array([0.3, -0.5, 0.2]), np.array([1.0, 0.7, -1.1])
    (r1, t1, p1), (r2, t2, p2) = _angles(one), _angles(other)
    unnormalised = neumann = jackson = as_printed = 0.0
    for n in range(7):
        radial = r1**n / r2 ** (n + 1)
        for m in range(-n, n + 1):
            # P_n,-m = (-1)^m f(n, -m) P_nm
            weight = (-1) ** m * factorial_ratio(n, m) if m < 0 else 1.0
            p, q = (
                (weight if m >= 0 else (-1) ** m * factorial_ratio(n, m))
                * lpmv(abs(m), n, np.cos(t))
                for t in (t1, t2)
            )
            term = radial * p * q * np.cos(m * (p1 - p2))
            f = factorial_ratio(n, -m)
            unnormalised += f * term
            as_printed += term
            # Jackson's Y_nm is sqrt((2n + 1)/(4 pi) f(n, -m)) P_nm e^(i m phi).
            y_y = (2 * n + 1) / (4 * np.pi) * f * p * q * np.cos(m * (p1 - p2))
            jackson += 4 * np.pi / (2 * n + 1) * radial * y_y
            if m >= 0:
                neumann += (1 if m == 0 else 2) * f * term
    kernel = multipoles.inverse_distance(one, other, 6)
    assert close(unnormalised, kernel, rel=3e-15)
    assert close(neumann, kernel, rel=3e-15)
    assert close(jackson, kernel, rel=3e-15)
    assert abs(as_printed / kernel - 1) > 0.1


def _direct(masses: np.ndarray, positions: np.ndarray, point: np.ndarray) -> float:
    return float(-G.value * np.sum(masses / np.linalg.norm(point - positions, axis=-1)))


@given(st.integers(0, 10**6), st.integers(0, 25), st.floats(1.2, 50.0))
def test_the_series_is_within_its_bound(seed: int, n_max: int, far: float) -> None:
    masses, positions = _random_body(seed)
    series = multipoles.exterior_multipoles(masses, positions, n_max)
    point = np.array([0.48, -0.6, 0.64]) * series.radius * far
    exact = _direct(masses, positions, point)
    error = abs(float(series.potential(point)) - exact)
    bound = G.value * masses.sum() / far ** (n_max + 1) / (series.radius * (far - 1))
    assert error <= bound + 3e-14 * abs(exact)


def test_the_series_converges_to_the_sum_over_the_masses() -> None:
    """Degree 120 at twice the radius (measured over 600: 6.7e-15)."""
    masses, positions = _random_body(0, 30)
    series = multipoles.exterior_multipoles(masses, positions, 120)
    directions = np.random.default_rng(1).normal(size=(20, 3))
    directions /= np.linalg.norm(directions, axis=-1)[:, None]
    points = directions * series.radius * 2.0
    exact = [_direct(masses, positions, p) for p in points]
    assert close(series.potential(points), exact, rel=3e-14)


def test_low_moments_are_mass_centre_and_inertia() -> None:
    masses, r = _random_body(3)
    series = multipoles.exterior_multipoles(masses, r, 2)
    inertia = inertia_tensor(masses, r)
    x, y, z = np.sum(masses[:, None] * r, axis=0)
    assert close(series.moment(0, 0), np.sum(masses), rel=1e-15)
    assert close(series.moment(1, 0), z, abs=3e-15)
    assert close(series.moment(1, 1), -(x - 1j * y) / np.sqrt(2), abs=3e-15)
    assert close(series.moment(1, -1), (x + 1j * y) / np.sqrt(2), abs=3e-15)
    # -C + (A + B)/2, the triaxiality and the products of inertia.
    a, b, c = np.diag(inertia)
    assert close(series.moment(2, 0), (a + b) / 2 - c, abs=8e-15)
    expected = np.sqrt(3 / 8) * (b - a + 2j * inertia[0, 1])
    assert close(series.moment(2, 2), expected, abs=8e-15)
    expected = np.sqrt(3 / 2) * (inertia[0, 2] - 1j * inertia[1, 2])
    assert close(series.moment(2, 1), expected, abs=8e-15)
    assert close(
        series.zonal, [series.moment(n, 0).real / series.radius**n for n in range(3)], rel=1e-15
    )


@given(st.integers(0, 10**6), st.integers(0, 6))
def test_the_power_of_a_degree_does_not_depend_on_the_frame(seed: int, n: int) -> None:
    masses, r = _random_body(seed)
    turn = Rotation.from_quat(np.random.default_rng(seed).normal(size=4)).as_matrix()
    powers = []
    for positions in (r, r @ turn.T):
        series = multipoles.exterior_multipoles(masses, positions, 6)
        powers.append(sum(abs(series.moment(n, m)) ** 2 for m in range(-n, n + 1)))
    scale = np.sum(masses * np.linalg.norm(r, axis=-1) ** n) ** 2
    assert close(powers[0], powers[1], abs=1e-14 * scale)


def test_a_density_on_a_grid() -> None:
    """A uniform cube: no quadrupole; its hexadecapole against the integral by hand.

    Integral of z4 - 3 z2 (x2 + y2) + 3/8 (x2 + y2)^2 over the cube of half-side 1:
    8 [1/5 - 2/3 + 3/8 (2/5 + 2/9)] = -28/15.
    """
    edge = np.linspace(-1, 1, 4)
    masses, positions = grid_masses(np.ones((3, 3, 3)), edge, edge, edge, points=3)
    series = multipoles.exterior_multipoles(masses, positions, 4, radius=np.sqrt(3))
    assert close(series.moment(0, 0), 8, rel=5e-15)
    assert abs(series.moment(2, 0)) < 1e-14
    assert close(series.moment(4, 0).real, -28 / 15, rel=6e-15)
    # Cubic symmetry ties the m = 4 moment to the zonal one.
    assert close(series.moment(4, 4).real, -28 / 15 * np.sqrt(5 / 14), rel=6e-15)


def test_a_ring_about_the_axis_is_zonal_up_to_its_count() -> None:
    angle = 2 * np.pi * np.arange(7) / 7
    ring = np.stack([np.cos(angle), np.sin(angle), np.full(7, 0.5)], axis=-1)
    moments = multipoles.exterior_multipoles(1.0, ring, 8).moments
    assert np.max(np.abs(moments[:, 1:7])) < 2e-15
    assert abs(moments[7, 7]) > 0.1


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda s: s.potential([0.0, 0.0, 2.0]), r"exterior series.*r = 2 m.*beyond 3 m"),
        (lambda s: s.potential([[0, 0, 9.0], [3.0, 0, 0]]), r"r = 3 m"),
        (lambda s: s.moment(5, 0), r"n = 5, m = 0 is not stored; allowed: n to 4"),
        (lambda s: s.moment(2, 3), "n = 2, m = 3"),
    ],
)
def test_where_the_exterior_series_has_no_value(call: Any, message: str) -> None:
    series = multipoles.exterior_multipoles([1.0, 2.0], [[0, 0, 3.0], [1.0, 0, 0]], 4)
    with pytest.raises(UndefinedError, match=message):
        call(series)


test_wrong_input = refused(
    (
        lambda: multipoles.inverse_distance([1.0, 0, 0], [0, 1.0, 0], 3),
        UndefinedError,
        "both points are 1 m",
    ),
    (lambda: multipoles.exterior_multipoles([-1.0], [[1.0, 0, 0]], 2), BodyError, r"mass = -1\.0"),
    (
        lambda: multipoles.exterior_multipoles(1.0, [[2.0, 0, 0]], 2, radius=1.0),
        UndefinedError,
        "radius = 1 m does not contain the mass at 2 m",
    ),
    (lambda: multipoles.exterior_multipoles(1.0, [[0.0, 0, 0]], 2), UndefinedError, "radius = 0 m"),
    (lambda: multipoles.exterior_multipoles(1.0, [[1.0, 0, 0]], -1), UndefinedError, "n_max = -1"),
    (
        lambda: multipoles.exterior_multipoles(np.ones((2, 1)), np.ones((2, 1, 3)), 2),
        UndefinedError,
        "one body",
    ),
)

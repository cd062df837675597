"""Exact means over ellipses: quadrature, closed forms, and digits of mpmath."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from earthspin.numerics.kepler import true_anomaly
from earthspin.torque.average import (
    mean_square_of_normal,
    mean_tide,
    mean_torque,
    precessing_torque,
    rounding,
)
from earthspin.torque.gravity import torque_from_position

NORTH = np.array([0.0, 0.0, 1.0])
tilts = st.floats(0.05, 3.0)


def normal_at(inclination: float, node: float) -> np.ndarray:
    across = math.sin(inclination)
    return np.array([across * math.sin(node), -across * math.cos(node), math.cos(inclination)])


def places(a: float, e: float, normal: np.ndarray, pericentre: float, count: int) -> np.ndarray:
    """Positions at even steps of the mean anomaly, shape (count, 3)."""
    v = true_anomaly(np.arange(count) * 2 * np.pi / count, np.array(e))
    first = np.cross(normal, [1.0, 0.3, 0.2])
    first /= np.linalg.norm(first)
    angle, r = v + pericentre, a * (1 - e * e) / (1 + e * np.cos(v))
    second = np.cross(normal, first)
    return r[:, np.newaxis] * (np.outer(np.cos(angle), first) + np.outer(np.sin(angle), second))


@given(st.floats(0, 0.6), tilts, st.floats(0, 6), st.floats(0, 6), tilts)
def test_the_mean_of_torques_along_an_ellipse(
    e: float, inclination: float, node: float, pericentre: float, tilt: float
) -> None:
    """Even steps of the mean anomaly converge exponentially: 2000 of them to rounding."""
    axis, normal = normal_at(tilt, 0.0), normal_at(inclination, node)
    sampled = torque_from_position(3.0, 1.0, places(2.0, e, normal, pericentre, 2000), axis)
    found = mean_torque(mean_tide(3.0, 2.0, e, np.outer(normal, normal)), axis)
    np.testing.assert_allclose(found, sampled.mean(axis=0), rtol=0, atol=1e-13)


@given(tilts, st.floats(0, np.pi))
def test_the_mean_over_a_node(tilt: float, inclination: float) -> None:
    """Three even nodes are exact: n n^T has no harmonic beyond the second."""
    pole = normal_at(tilt, 1.0)
    x = np.cross(pole, NORTH) / np.linalg.norm(np.cross(pole, NORTH))
    axes = np.stack([x, np.cross(pole, x), pole])
    sampled = [normal_at(inclination, 2 * np.pi * k / 3) @ axes for k in range(3)]
    mean = np.mean([np.outer(n, n) for n in sampled], axis=0)
    np.testing.assert_allclose(mean_square_of_normal(pole, inclination), mean, rtol=0, atol=1e-15)


@given(st.floats(0, 0.9), tilts, st.floats(0, np.pi))
def test_the_closed_form(e: float, obliquity: float, inclination: float) -> None:
    """(3/2) GM/a^3 (1 - e^2)^(-3/2) cos(eps) (1 - (3/2) sin^2 i)."""
    axis = normal_at(obliquity, 0.0)
    tide = mean_tide(3.0, 2.0, e, mean_square_of_normal(NORTH, inclination))
    found = precessing_torque(mean_torque(tide, axis)[np.newaxis], axis, NORTH)[0]
    circle = 1.5 * 3.0 / 2.0**3 * math.cos(obliquity) * (1 - e * e) ** -1.5
    inclined = circle * (1 - 1.5 * math.sin(inclination) ** 2)
    assert found == pytest.approx(inclined, rel=0, abs=2e-14 * abs(circle / math.cos(obliquity)))


def test_rounding_is_within_its_bound() -> None:
    """Measured over 2000 orbits: 0.73 roundings at most of the 2 that are claimed."""
    rng = np.random.default_rng(5)
    for _ in range(200):
        e, inclination, tilt = rng.uniform(0, 0.95), rng.uniform(0, 3), rng.uniform(0, 3)
        axis = normal_at(tilt, 0.3)
        tide = mean_tide(3.0, 2.0, e, mean_square_of_normal(NORTH, inclination))
        with mpmath.workdps(40):
            s = mpmath.sin(mpmath.mpf(inclination)) ** 2 / 2
            c = mpmath.cos(mpmath.mpf(inclination)) ** 2
            size = mpmath.mpf(3) / (16 * (1 - mpmath.mpf(e) ** 2) ** mpmath.mpf("1.5"))
            k = [mpmath.mpf(float(x)) for x in axis]
            q = [size * (1 - s) * k[0], size * (1 - s) * k[1], size * (1 - c) * k[2]]
            true = [
                float(3 * (q[(j + 1) % 3] * k[(j + 2) % 3] - q[(j + 2) % 3] * k[(j + 1) % 3]))
                for j in range(3)
            ]
        assert np.all(np.abs(mean_torque(tide, axis) - true) <= rounding(tide))

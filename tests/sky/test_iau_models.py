"""Precession and nutation: the interpolated matrices against ERFA's own."""

import erfa
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from earthspin.constants import ARCSEC, EPSILON_0
from earthspin.sky import iau_models

J2000 = 2451545.0


@given(st.floats(-160_000, 230_000))
def test_nutation_between_the_nodes(day: float) -> None:
    days = np.array([day, day + 0.37])
    ours = iau_models.NutationSpline(day, day + 1).true_equator(days)
    # 7e-12 rad measured between nodes
    assert np.max(np.abs(ours - erfa.pnm06a(J2000, days))) < 2e-11


def test_few_epochs_far_apart_are_not_interpolated() -> None:
    days = np.array([-36000.0, 0.25, 19000.0])
    ours = iau_models.NutationSpline(days[0], days[-1], days.size).true_equator(days)
    assert np.max(np.abs(ours - erfa.pnm06a(J2000, days))) < 1e-15


def test_mean_equator_is_a_rotation() -> None:
    matrix = iau_models.mean_equator(np.linspace(-160_000, 230_000, 50))
    assert np.allclose(matrix @ np.swapaxes(matrix, 1, 2), np.eye(3), rtol=0, atol=2e-15)


def test_obliquity_of_the_ecliptic_pole() -> None:
    pole = iau_models.mean_equator(np.array([0.0]))[0, 2]
    tilt = np.arctan2(
        np.linalg.norm(np.cross(pole, iau_models.ecliptic_pole())),
        pole @ iau_models.ecliptic_pole(),
    )
    assert abs(tilt - EPSILON_0.value * ARCSEC) < 1e-14


def test_the_node_goes_backwards() -> None:
    node = np.unwrap(iau_models.mean_longitude_of_node(np.array([0.0, 100.0, 200.0])))
    assert np.all(np.diff(node) < 0)


@pytest.mark.parametrize(("count", "dense"), [(20, False), (4000, True)])
def test_angles_at_dense_days(count: int, *, dense: bool) -> None:
    days = np.linspace(8000.0, 8040.0, count)
    called: list[int] = []

    def angles(at: np.ndarray) -> np.ndarray:
        called.append(at.size)
        return np.stack(erfa.nut06a(J2000, at), axis=-1)

    exact = np.stack(erfa.nut06a(J2000, days), axis=-1)
    assert np.abs(iau_models.at_days(angles, days) - exact).max() <= iau_models.node_error(
        days
    )  # 7.7e-12 here
    assert (iau_models.node_error(days) > 0) == dense
    assert called[0] <= 50


def test_nutation_moves_the_pole_to_the_true_one() -> None:
    """By some 17 and 9 arcsec; what is of second order in them is left out."""
    days = np.linspace(-18000, 18000, 300)
    mean = iau_models.mean_equator(days)[:, 2]
    dpsi, deps = erfa.nut06a(J2000, days)
    eta = dpsi * np.sin(erfa.obl06(J2000, days)) + 1j * deps
    moved = iau_models.moved_by_nutation(mean, eta, days)
    # measured: 0.44 mas
    assert np.max(np.linalg.norm(moved - iau_models.true_pole(days), axis=1)) / ARCSEC < 2e-3


def test_nutation_of_the_true_pole_is_that_of_the_model() -> None:
    days = np.linspace(-18000, 18000, 300)
    expected = np.stack(erfa.nut06a(J2000, days), axis=-1)
    assert (
        np.max(np.abs(iau_models.nutation_of(iau_models.true_pole(days), days) - expected)) < 1e-15
    )


def test_the_shipped_series_is_that_of_the_model() -> None:
    days, pole, nutation = iau_models.pole_and_nutation(-7001.0, 6999.0)
    assert days.size == 3500
    assert days[[0, 1, -1]].tolist() == [-7000.0, -6996.0, 6996.0]
    assert np.allclose(pole, erfa.pnm06a(2451545.0, days)[..., 2, :], rtol=0, atol=1e-17)
    expected = np.stack(erfa.nut00a(2451545.0, days), axis=-1)
    assert np.allclose(nutation, expected, rtol=0, atol=1e-19)
    everywhere, *_ = iau_models.pole_and_nutation(-np.inf, np.inf)
    assert np.array_equal(everywhere, iau_models.SERIES_DAYS)

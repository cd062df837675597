"""Obliquity, climatic precession and the equinox from vectors."""

import erfa
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from earthspin.constants import ARCSEC, J2000_JD
from earthspin.secular.derived_angles import equator_and_equinox, inclined_axis, seasons

NORTH = np.array([[0.0], [0.0], [1.0]])


@given(st.floats(0.01, 3.13), st.floats(0, 0.9), st.floats(-3.1, 3.1))
def test_perihelion_counts_from_the_equinox(obliquity: float, e: float, longitude: float) -> None:
    """The celestial pole stands at ecliptic longitude 90 degrees, the equinox at 0."""
    axis = np.array([[0.0], [np.sin(obliquity)], [np.cos(obliquity)]])
    perihelion = np.array([[np.cos(longitude)], [np.sin(longitude)], [0.0]])
    found = seasons(axis, NORTH, e * perihelion)
    assert found.obliquity == pytest.approx([obliquity], rel=1e-12, abs=0)
    assert found.eccentricity == pytest.approx([e], rel=1e-12, abs=1e-100)
    assert np.allclose(found.climatic_precession, e * np.sin(longitude), rtol=0, atol=1e-13)
    assert np.allclose(found.coprecession, e * np.cos(longitude), rtol=0, atol=1e-13)


def test_an_upright_axis_has_no_perihelion() -> None:
    found = seasons(NORTH, NORTH, 0.1 * np.array([[1.0], [0.0], [0.0]]))
    assert found.obliquity == 0
    assert np.isnan(found.climatic_precession)
    assert np.isnan(found.coprecession)


@pytest.mark.parametrize("years", [-2000.0, 0.0, 1000.0])
def test_the_matrix_of_the_equator_is_that_of_erfa(years: float) -> None:
    """From the poles of equator and ecliptic of IAU 2006, without a formula of angles."""
    days = years * 365.25
    pole = np.asarray(erfa.pmat06(J2000_JD, days)[2])[:, np.newaxis]
    normal = np.asarray(erfa.ecm06(J2000_JD, days)[2])[:, np.newaxis]
    (found,) = equator_and_equinox(pole, normal)
    # erfa puts the equinox where its own angles say; 2e-6 arcsec at 2,000 years
    assert np.max(np.abs(found - erfa.pmat06(J2000_JD, days))) < 1e-4 * ARCSEC


@given(st.floats(1e-3, 3.1), st.floats(-3, 3), st.floats(-4, 4), st.floats(-3, 3))
def test_an_axis_is_leant_and_turned_as_rotations_do_it(
    obliquity: float, longitude: float, more: float, turned: float
) -> None:
    """About the line of the equinox, then about the normal, by scipy; past the normal, too."""
    towards = np.array([np.cos(longitude), np.sin(longitude), 0.0])
    north, axis = NORTH[:, 0], np.sin(obliquity) * towards + np.cos(obliquity) * NORTH[:, 0]
    leant = Rotation.from_rotvec(more * np.cross(north, towards)).apply(axis)
    true = Rotation.from_rotvec(turned * north).apply(leant)
    # 1e-16 over the sine of the obliquity: 9e-14 measured
    assert np.allclose(inclined_axis(axis, north, more, turned), true, rtol=0, atol=1e-12)


def test_an_upright_axis_is_leant_somewhere() -> None:
    found = inclined_axis(NORTH[:, 0], NORTH[:, 0], 0.3, np.array([0.0, 1.0]))
    assert np.allclose(found[2], np.cos(0.3), rtol=0, atol=1e-15)
    assert found[:, 0] @ found[:, 1] == pytest.approx(
        np.cos(0.3) ** 2 + np.sin(0.3) ** 2 * np.cos(1.0), rel=1e-14, abs=0
    )

"""Poles as values: where they point, and what an orbit makes of them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from earthspin import MARS, UndefinedError
from earthspin.sky import iau_models
from earthspin.sky.poles import IAU_2006, UPRIGHT, Direction, FixedPole, pole_of

angles = st.floats(-np.pi, np.pi)
declinations = st.floats(-1.5, 1.5)


@given(angles, declinations, angles, declinations)
def test_the_axes_of_an_orbit_are_a_rotation(
    ra: float, dec: float, ra0: float, dec0: float
) -> None:
    pole, orbit = FixedPole(ra, dec), Direction(ra0, dec0)
    axes = pole.orbit_axes(orbit)
    assert np.allclose(axes @ axes.T, np.eye(3), rtol=0, atol=1e-9)
    assert np.allclose(axes[2], orbit.vector(), rtol=0, atol=1e-15)
    assert np.array_equal(pole.equator(orbit)[2], pole.true(0.0))


@pytest.mark.parametrize(
    ("tilt", "upright"), [(0.0, True), (0.9, True), (1.1, False), (1e6, False)]
)
def test_an_upright_axis_has_no_longitude(tilt: float, upright: bool) -> None:
    orbit = Direction(0.4, 0.7)
    assert FixedPole(0.4, 0.7 + tilt * UPRIGHT).is_upright(orbit) is upright
    assert FixedPole(0.4 + np.pi, -(0.7 + tilt * UPRIGHT)).is_upright(orbit) is upright


def test_the_iaus_pole_brings_its_ecliptic() -> None:
    days = np.array([-3000.0, 0.0, 8000.0])
    assert np.array_equal(IAU_2006.orbit_normal(None), IAU_2006.orbit_axes(None)[2])
    assert np.array_equal(IAU_2006.mean(days), IAU_2006.equator(None, days)[:, 2])
    # nutation is 9.2 arcsec at most in obliquity, and 6.9 across
    apart = np.linalg.norm(IAU_2006.true(8000.0) - IAU_2006.mean(days)[2]) * 206264.8
    assert 1 < apart < 11
    nutation = iau_models.NutationSpline(-3000.0, 8000.0, 3)
    assert np.allclose(
        IAU_2006.equator(None, days, nutation)[2, 2], IAU_2006.true(8000.0), rtol=0, atol=1e-14
    )


def test_what_is_no_pole_is_refused() -> None:
    for wrong in ("north", (0.0, 2.0), (0.0,), (np.nan, 0.0)):
        with pytest.raises((ValueError, TypeError)):
            pole_of(wrong)
    with pytest.raises(UndefinedError, match="orbit_pole"):
        MARS.needed("pole").orbit_axes(None)

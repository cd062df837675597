"""The constant of precession in time: what each term makes of it."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from earthspin.constants import (
    ARCSEC,
    ARCSEC_PER_YEAR,
    JULIAN_YEAR,
    PUBLISHED_EFFECTS,
    SIDEREAL_YEAR,
    SPEED_OF_LIGHT,
)
from earthspin.errors import UndefinedError
from earthspin.secular.averaged_torque import (
    FADES_FROM,
    FADES_TO,
    J2_SHARE,
    PrecessionConstant,
    Tides,
    geodesic_precession,
    mean_torque,
    rebound,
    rebound_error,
    reference_axes,
)
from tests.secular.setting import E0, EARTHS, KYR, NODE_RATE, arcsec, earths

NOW = np.zeros(1)


def test_today_it_is_what_was_put_in() -> None:
    strength = PrecessionConstant(sun=2e-12, moon=5e-12, eccentricity=0.3, geodesic=1e-15)
    assert strength.constant(NOW, np.array([0.09])) == pytest.approx([7e-12], rel=1e-15, abs=0)
    assert strength.geodesic_rate(np.array([0.09])) == pytest.approx([1e-15], rel=1e-15, abs=0)
    assert strength.moon_share == pytest.approx(5 / 7, rel=1e-15, abs=0)


def test_the_suns_share_grows_with_eccentricity_and_the_moons_does_not() -> None:
    """(1 - e^2)^(-3/2), the mean of (a/r)^3; and (1 - e^2)^(-1) of the geodesic term."""
    strength = PrecessionConstant(sun=2e-12, moon=5e-12, geodesic=1e-15)
    e2 = np.array([0.36])
    assert strength.constant(NOW, e2) == pytest.approx([2e-12 / 0.8**3 + 5e-12], rel=1e-15, abs=0)
    assert strength.geodesic_rate(e2) == pytest.approx([1e-15 / 0.64], rel=1e-15, abs=0)
    anomaly = 2 * np.pi * np.arange(4000) / 4000
    radius = 1 - 0.6 * np.cos(anomaly)
    mean = np.mean(radius / radius**3)  # dM = r dE
    assert strength.constant(NOW, e2) - 5e-12 == pytest.approx([2e-12 * mean], rel=1e-12, abs=0)


def test_tides_over_a_million_years() -> None:
    """n' = -4.6e-18 rad/s2 as a share of n, and omega'/omega = 51 n_moon/omega of that."""
    tides = Tides.of_the_earth(1.0, 7.292115e-5, 2.6617e-6)
    million = -1e6 * JULIAN_YEAR
    moon = 1 + 4.6e-18 * 1e6 * 3.15576e7
    spin = 1 + 51 * (2.6617e-6 / 7.292115e-5) * 4.6e-18 * 1e6 * 3.15576e7
    strength = PrecessionConstant(sun=2e-12, moon=5e-12, tides=tides)
    found = strength.constant(np.array([million]), NOW)
    assert found == pytest.approx([spin * (2e-12 + 5e-12 * moon**2)], rel=1e-13, abs=0)


@pytest.mark.parametrize("tides", [Tides(moon=-1e-15), Tides(spin=-1e-15)])
def test_tides_that_would_stop_spin_or_moon_are_refused(tides: Tides) -> None:
    strength = PrecessionConstant(sun=1e-12, moon=1e-12, tides=tides)
    with pytest.raises(UndefinedError, match="smaller factor"):
        strength.constant(np.array([6e14]), NOW)


def test_the_rate_of_j2_fades_from_two_to_ten_thousand_years() -> None:
    years = np.array([0.0, 500.0, 2000.0, 6000.0, 10_000.0, 1e6])
    kept = np.array([0.0, 500.0, 2000.0, 3000.0, 0.0, 0.0])
    assert np.allclose(rebound(years * JULIAN_YEAR) / JULIAN_YEAR, kept, rtol=1e-12, atol=1e-9)
    assert (FADES_FROM, FADES_TO) == (2 * KYR, 10 * KYR)


@given(st.floats(0, 1e6))
def test_the_fade_is_odd_and_never_adds(years: float) -> None:
    time = years * JULIAN_YEAR
    assert rebound(np.array(-time)) == -rebound(np.array(time))
    assert 0 <= rebound(np.array(time)) <= time


def test_the_fade_has_no_corner() -> None:
    years = np.linspace(0, 15_000, 30_001)
    slope = np.diff(rebound(years * JULIAN_YEAR)) / np.diff(years * JULIAN_YEAR)
    assert np.max(np.abs(np.diff(slope))) < 1e-3


def test_the_band_of_j2_is_a_share_today_and_all_that_faded_later() -> None:
    years = np.array([0.0, 1000.0, 10_000.0, 15_000.0, 20_000.0, 1e6])
    found = rebound_error(years * JULIAN_YEAR) / JULIAN_YEAR
    known = [0.0, J2_SHARE * 1000, 10_000.0, 7500.0, 0.0, 0.0]
    assert np.allclose(found, known, rtol=1e-12, atol=1e-9)


def test_the_moons_torque_acts_beside_the_normal() -> None:
    """(n x dn/dt)/|node rate|, of which the Moon's share counts: 1.4 arcsec as measured."""
    normal, _, turning = shape = EARTHS.at(NOW)
    on = mean_torque(earths(), shape, NOW)
    aside = np.cross(normal, turning, axis=0) / NODE_RATE
    assert 1.3 < np.linalg.norm(aside) / ARCSEC < 1.5
    assert np.allclose(on.axis - normal, earths().moon_share * aside, rtol=1e-9, atol=1e-16)
    assert np.allclose(on.geodesic / normal, 1919.883e-5 * ARCSEC_PER_YEAR, rtol=1e-4, atol=0)
    alone = mean_torque(replace(earths(), moon=0.0, node_rate=np.inf), shape, NOW)
    assert np.array_equal(alone.axis, normal)


def test_sun_and_moon_about_one_axis_are_the_two_about_their_own() -> None:
    """To first order in 1.4 arcsec: second order is 1e-11 of the torque."""
    shape = EARTHS.at(NOW)
    normal, _, turning = (of[:, 0] for of in shape)
    s = np.array([0.0, 0.0, 1.0])
    strength = replace(earths(), eccentricity=E0)
    on = mean_torque(strength, shape, NOW)
    moons = normal + np.cross(normal, turning) / NODE_RATE
    e2 = np.sum(shape[1] ** 2, axis=0)
    of_sun = float(replace(strength, moon=0.0).constant(NOW, e2)[0])
    two = of_sun * (normal @ s) * np.cross(s, normal)
    two += strength.moon * (moons @ s) * np.cross(s, moons)
    m = on.axis[:, 0]
    one = on.constant[0] * (m @ s) * np.cross(s, m)
    assert np.linalg.norm(one - two) < 1e-10 * np.linalg.norm(two)


@given(st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: np.linalg.norm(v) > 0.1))
def test_reference_axes_are_right_handed(given_normal: tuple[float, ...]) -> None:
    normal = np.array(given_normal)
    axes = reference_axes(normal)
    assert np.allclose(axes @ axes.T, np.eye(3), rtol=0, atol=1e-14)
    assert np.linalg.det(axes) == pytest.approx(1.0, rel=1e-13, abs=0)
    assert arcsec(axes[2:].T, (normal / np.linalg.norm(normal))[:, np.newaxis]) < 1e-9


def test_geodesic_precession_is_the_published_one() -> None:
    """1919.883e-5 arcsec a year (Capitaine et al. 2003, table 3); Simon et al.'s e at J2000.0.

    The published value holds what the Moon adds, 2 G m n/(c^2 a) or 2.6e-4 of it; 2e-5 is left.
    """
    found = geodesic_precession(1.32712440018e20, 2 * np.pi / SIDEREAL_YEAR.value, 0.0167086)
    by_moon = 2 * 4.9028e12 * 2.6617e-6 / (SPEED_OF_LIGHT.value**2 * 3.844e8)
    published = -PUBLISHED_EFFECTS["geodesic"].value
    assert (found + by_moon) / ARCSEC_PER_YEAR == pytest.approx(published, rel=3e-5, abs=0)

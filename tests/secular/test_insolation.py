"""Daily insolation: published tables, a quadrature of orbit and day, and Kepler's equation."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from earthspin.secular.insolation import (
    Season,
    daily,
    daylight,
    inverse_square,
    mean_longitude,
    true_longitude,
)
from earthspin.secular.insolation_errors import of_product
from earthspin.secular.season_means import over_window

DEGREE = np.pi / 180
#: Orbit that climlab takes for today's: its perigee of the Sun is 281.37 degrees.
CLIMLAB = Season(23.446 * DEGREE, 0.017236, (281.37 - 180) * DEGREE)
#: Orbit of the PMIP, after Berger 1978.
PMIP = Season(23.446 * DEGREE, 0.016724, 102.04 * DEGREE)
#: Monthly means of today, W/m2, of 1365 (Bonfils et al. 1998, documentation of the PMIP models,
#: appendix: a year of 365 days, equinox on 21.0 March), by latitude.
TODAY = {
    60: "40.79 99.47 199.95 320.61 423.31 473.71 449.70 362.23 246.58 135.19 57.36 26.96",
    0: "419.41 433.45 437.87 424.80 402.22 387.51 392.10 411.28 428.62 431.65 421.40 412.83",
    -40: "498.65 439.17 351.32 256.36 183.04 149.47 162.86 220.41 306.54 400.06 476.35 513.42",
    -80: "492.67 308.85 105.78 6.81 .00 .00 .00 .17 47.56 214.03 431.43 542.01",
}
MONTHS = np.array([31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31])

angle = st.floats(-7, 7)
ellipse = st.floats(0, 0.9)
season = st.builds(Season, st.floats(0, np.pi), ellipse, angle)


@pytest.mark.parametrize("latitude", TODAY)
def test_monthly_means_of_the_pmip(latitude: int) -> None:
    """Rounded to 0.01; their 21.0 March is noon in days that count from 1.0 on 1 January."""
    published = np.array([float(word) for word in TODAY[latitude].split()])
    ends = np.cumsum(MONTHS)
    middles = (ends - MONTHS / 2 - 79.5) / 365
    sun = true_longitude(PMIP, 2 * np.pi * middles)
    found = [
        1365 * over_window(PMIP, np.array(latitude * DEGREE), np.array(at), days / 365)
        for at, days in zip(sun, MONTHS, strict=True)
    ]
    assert np.max(np.abs(found - published)) < 0.015  # 0.006 measured


def test_the_largest_daily_insolation_and_the_mean_of_climlab() -> None:
    """562.0333475 and 341.384184481 W/m2 of 1365.2 on its grid of days and latitudes.

    climlab 0.8, tests of insolation; it takes Berger's series from days to longitudes, 1.3e-7 rad
    from Kepler's equation.
    """
    latitude = np.linspace(-90, 90, 500)[:, np.newaxis] * DEGREE
    mean = (np.linspace(0, 365.2422, 365) - 80) * 2 * np.pi / 365.2422
    found = 1365.2 * daily(CLIMLAB, latitude, true_longitude(CLIMLAB, mean))
    assert found.max() == pytest.approx(562.0333475, rel=3e-7, abs=0)
    weight = np.cos(latitude[:, 0])
    over_the_globe = np.sum(found.mean(axis=1) * weight) / np.sum(weight)
    assert over_the_globe == pytest.approx(341.384184481, rel=1e-6, abs=0)


@pytest.mark.parametrize("latitude", [-80.0, -30.0, 0.0, 65.0, 89.0])
@pytest.mark.parametrize("sun", [0.0, 50.0, 90.0, 170.0, 271.0])
def test_a_day_by_quadrature(latitude: float, sun: float) -> None:
    """The cosine of the zenith angle over one turn, where it is above zero."""
    axis = np.array([0.0, -np.sin(0.41), np.cos(0.41)])  # its equinox lies at -x
    towards = -np.array([np.cos(sun * DEGREE), np.sin(sun * DEGREE), 0.0])
    sine = axis @ towards
    e, w = 0.2, 1.0
    distance = (1 - e * e) / (1 + e * np.cos(sun * DEGREE + np.pi - w))

    def height(turn: float) -> float:
        level = np.cos(latitude * DEGREE) * np.sqrt(1 - sine * sine) * np.cos(turn)
        return max(float(np.sin(latitude * DEGREE) * sine + level), 0.0) / distance**2

    whole, _ = quad(height, -np.pi, np.pi, limit=400, epsabs=1e-10, epsrel=1e-10)
    found = daily(Season(0.41, e, w), np.array(latitude * DEGREE), np.array(sun * DEGREE))
    assert found == pytest.approx(whole / (2 * np.pi), rel=1e-7, abs=1e-9)


@given(st.floats(0, np.pi), st.floats(0, 0.9), angle)
def test_a_year_over_the_globe_holds_no_season(
    obliquity: float, e: float, perihelion: float
) -> None:
    """A quarter of the solar constant over sqrt(1 - e^2), whatever obliquity and perihelion."""
    of = Season(obliquity, e, perihelion)
    latitude, weights = np.polynomial.legendre.leggauss(60)
    eccentric = 2 * np.pi * np.arange(4000) / 4000
    true = 2 * np.arctan2(
        np.sqrt(1 + e) * np.sin(eccentric / 2), np.sqrt(1 - e) * np.cos(eccentric / 2)
    )
    sun = true + perihelion + np.pi
    each = daily(of, np.arcsin(latitude)[:, np.newaxis], sun)
    over_year = np.mean(each * (1 - e * np.cos(eccentric)), axis=1)  # dM = (1 - e cos E) dE
    assert over_year @ weights / 2 == pytest.approx(0.25 / np.sqrt(1 - e * e), rel=2e-4, abs=0)


@given(season, angle)
def test_mean_and_true_longitude_agree_at_the_equinox(of: Season, longitude: float) -> None:
    assert true_longitude(of, np.array(0.0)) == pytest.approx(0.0, rel=0, abs=1e-12)
    there = mean_longitude(of, np.array(longitude))
    assert true_longitude(of, there) == pytest.approx(longitude, rel=0, abs=1e-11)


@given(season, st.floats(-1.5, 1.5), angle)
def test_the_other_hemisphere_half_a_turn_later(
    of: Season, latitude: float, longitude: float
) -> None:
    """The Sun half a turn on, and the orbit turned with it, light the other hemisphere alike."""
    other = Season(of.obliquity, of.eccentricity, of.perihelion + np.pi)
    found = daily(of, np.array(latitude), np.array(longitude))
    there = daily(other, np.array(-latitude), np.array(longitude + np.pi))
    assert found == pytest.approx(there, rel=1e-9, abs=1e-12)
    assert found >= 0


def test_polar_night_and_midnight_sun() -> None:
    north, south = np.array(85 * DEGREE), np.array(-85 * DEGREE)
    of = Season(0.41, 0.0, 0.0)
    assert daily(of, south, np.array(np.pi / 2)) == 0.0
    assert daily(of, north, np.array(np.pi / 2)) == pytest.approx(
        np.sin(85 * DEGREE) * np.sin(0.41), rel=1e-14, abs=0
    )


def test_a_short_window_is_its_day_and_a_year_is_the_year() -> None:
    latitude, sun = np.array(65 * DEGREE), np.array(1.2)
    short = over_window(PMIP, latitude, sun, 1e-6)
    assert short == pytest.approx(daily(PMIP, latitude, sun), rel=1e-9, abs=0)
    mean = 2 * np.pi * (np.arange(20_000) + 0.5) / 20_000
    whole = np.mean(daily(PMIP, latitude, true_longitude(PMIP, mean)))
    assert over_window(PMIP, latitude, sun, 1.0) == pytest.approx(whole, rel=1e-8, abs=0)


def test_a_perihelion_that_is_hardly_known_is_sampled_from_a_tenth_of_a_radian() -> None:
    """With the Sun at perihelion, half the difference of the changes on both sides is zero.

    The 95 % half-width is the change at the half-width of the longitude, since the change grows
    with its size on either side.
    """
    half = np.array([0.05, 0.0999, 0.1001, 0.19, 0.6])
    sun, latitude, e = np.array(np.pi / 2), np.array(0.3), 0.04
    season = Season(np.array(0.4), np.array(e), sun - np.pi)
    value, error = of_product(
        lambda obliquity: daylight(obliquity, latitude, sun),
        lambda orbit: inverse_square(orbit, sun),
        season,
        Season(np.zeros(5), np.zeros(5), half),
    )
    assert value == pytest.approx(daily(season, latitude, sun), rel=1e-12, abs=0)
    change = 1 - ((1 + e * np.cos(half)) / (1 + e)) ** 2
    assert error == pytest.approx(np.where(half > 0.1, value * change, 0), rel=0.05, abs=1e-12)


#: Obliquity, e, perihelion, latitude and longitude (deg), and length (years) of windows with polar
#: days and nights: at poles, near and on polar circles, over perihelion, and of seconds.
WINDOWS = [
    (23.4393, 0.0167, 102.95, 90.0, 0.0, 1.0),
    (23.4393, 0.0167, 102.95, 90.0, 0.0, 30 / 365.2422),
    (23.4393, 0.0167, 102.95, 90.0, 270.0, 0.5),
    (23.4393, 0.0167, 102.95, 89.99, 3.0, 0.1),
    (23.4393, 0.0167, 102.95, 85.0, 0.0, 1.0),
    (23.4393, 0.0167, 102.95, -75.0, 40.0, 1.0),
    (23.4393, 0.0167, 102.95, 66.5607, 200.0, 0.9),
    (23.4393, 0.0167, 102.95, 66.6, 90.0, 0.3),
    (23.4393, 0.0167, 102.95, 66.5, 0.0, 1.0),
    (23.4393, 0.0167, 102.95, 65.0, 0.0, 1.0),
    (24.5, 0.05, 300.0, -80.0, 0.0, 20 / 365),
    (60.0, 0.4, 45.0, 40.0, 250.0, 0.7),
    (89.0, 0.3, 10.0, 2.0, 80.0, 0.8),
    (23.4393, 0.0167, 102.95, 75.0, 40.5938, 1e-6),
    (23.4393, 0.0167, 102.95, 75.0, 180 + 40.5938, 60 / 86400 / 365.2422),
    (23.4393, 0.0167, 102.95, 45.0, 10.0, 60 / 86400 / 365.2422),
    (23.4393, 0.0167, 102.95, 66.5607 + 6e-8, 90.0, 0.4),
    (23.4393, 0.0167, 102.95, -66.5607 + 6e-8, 280.0, 0.6),
    (25.0, 0.4, 100.0, 70.0, 280.0, 0.1),
    (0.0, 0.4, 30.0, 40.0, 200.0, 0.3),
    (90.0, 0.2, 30.0, -40.0, 200.0, 0.3),
    (90.0, 0.0, 30.0, 0.0, 80.0, 0.3),
    (120.0, 0.1, 30.0, 90.0, 100.0, 0.6),
    (180.0, 0.1, 30.0, -90.0, 100.0, 0.6),
]
#: Largest error, of the solar constant, of windows, and of those of a minute at the polar night.
CLOSE, AT_EDGE = 1e-13, 5e-11


@pytest.mark.parametrize("window", WINDOWS, ids=str)
def test_windows_with_polar_night_by_quadrature(window: tuple[float, ...]) -> None:
    """The mean over time, integrated by mpmath between the edges of polar day and night."""
    obliquity, e, perihelion, latitude, longitude = map(mp.mpf, window[:5])
    eps, w, phi, sun = (mp.radians(x) for x in (obliquity, perihelion, latitude, longitude))

    def mean_anomaly(true: mp.mpf) -> mp.mpf:
        turns = mp.nint(true / (2 * mp.pi))
        half = (true - 2 * mp.pi * turns) / 2
        eccentric = 2 * mp.atan2(mp.sqrt(1 - e) * mp.sin(half), mp.sqrt(1 + e) * mp.cos(half))
        return eccentric - e * mp.sin(eccentric) + 2 * mp.pi * turns

    def sun_at(mean: mp.mpf) -> mp.mpf:
        bracket = (mean - 2, mean + 2)
        true = mp.findroot(lambda v: mean_anomaly(v) - mean, bracket, solver="anderson", tol=1e-40)
        return true + w + mp.pi

    def light(at: mp.mpf) -> mp.mpf:
        sine = mp.sin(eps) * mp.sin(at)
        high, level = mp.sin(phi) * sine, mp.cos(phi) * mp.sqrt(1 - sine**2) + mp.mpf(1e-40)
        half_day = mp.acos(max(-1, min(1, -high / level)))
        closeness = (1 + e * mp.cos(at - w - mp.pi)) / (1 - e**2)
        time = (1 - e**2) ** 1.5 / (1 + e * mp.cos(at - w - mp.pi)) ** 2 / (2 * mp.pi)
        return closeness**2 * time * (half_day * high + level * mp.sin(half_day)) / mp.pi

    middle, length = mean_anomaly(sun - w - mp.pi), mp.mpf(window[5])
    first, last = (sun_at(middle + side * mp.pi * length) for side in (-1, 1))
    edge = mp.asin(min(1, abs(mp.cos(phi)) / max(abs(mp.sin(eps)), mp.mpf(1e-30))))
    kinks = [n * mp.pi + side * edge for n in range(-4, 5) for side in (-1, 1)]
    cuts = [first, *sorted(kink for kink in kinks if first < kink < last), last]
    exact = float(mp.quad(light, cuts) / length)

    season = Season(*(np.array(float(x)) for x in (eps, e, w)))
    found = over_window(season, np.array(float(phi)), np.array(float(sun)), window[5])
    close = AT_EDGE if window[5] < 1e-5 else CLOSE
    assert float(found) == pytest.approx(exact, rel=0, abs=close)

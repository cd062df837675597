"""Rates and periods: against pins, closed forms, and bodies that are not the usual one."""

import math

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin import EARTH, MARS, MOON, SUN, Body, UndefinedError
from earthspin.bodies import BODIES
from earthspin.constants import ARCSEC, ARCSEC_PER_YEAR, EPSILON_0, JULIAN_YEAR, NORMAL_95
from earthspin.torque.rates import period, period_error, precession_rate, total_uncertainty
from tests.conftest import load_pins

PINS = load_pins("precession")


@pytest.mark.parametrize("label", ["sun", "moon", "total"])
def test_rates_and_periods(precession_result: xr.Dataset, label: str) -> None:
    of = precession_result.sel(perturber=label)
    PINS[f"{label} rate"].check(of.precession_rate)
    PINS[f"period {label}"].check(of.precession_period)


def test_moon_over_sun(precession_result: xr.Dataset) -> None:
    PINS["moon over sun"].check(precession_result.rate_ratio.sel(perturber="moon"))


@pytest.mark.parametrize("label", ["sun", "moon"])
def test_mean_torques(precession_result: xr.Dataset, label: str) -> None:
    PINS[f"mean torque {label}"].check(precession_result.mean_torque.sel(perturber=label))


def test_the_error_is_small_and_holds_the_reference(precession_result: xr.Dataset) -> None:
    total = precession_result.sel(perturber="total")
    assert float(total.precession_rate_error) <= 20e-5  # 20 mas a century
    off = abs(float(total.precession_rate) - PINS["total rate"].value)
    assert off <= float(total.precession_rate_error)
    method, given = total.precession_rate_error_method, total.precession_rate_error_input
    assert np.isclose(total.precession_rate_error, np.hypot(method, given), rtol=1e-12, atol=0)


def test_the_input_error_is_that_of_h(precession_result: xr.Dataset) -> None:
    total = precession_result.sel(perturber="total")
    from_h = NORMAL_95 * EARTH.relative_uncertainty["dynamical_flattening"] * total.precession_rate
    assert np.isclose(total.precession_rate_error_input, from_h, rtol=1e-3, atol=0)


def test_the_closed_form_of_the_sun(precession_result: xr.Dataset) -> None:
    eccentricity, axis = 0.016708634, 149598023e3  # mean orbit at J2000.0, Simon et al. 1994
    geometry = 1.5 * SUN.gm / axis**3 * math.cos(EPSILON_0.value * ARCSEC)
    geometry *= (1 - eccentricity**2) ** -1.5
    rate = precession_rate(geometry, EARTH.dynamical_flattening, EARTH.spin_rate) / ARCSEC_PER_YEAR
    PINS["sun closed form"].check(rate)
    PINS["sun closed form"].check(precession_result.precession_rate.sel(perturber="sun"))


def test_every_window_of_the_last_century_is_within_its_error() -> None:
    """Averages about other epochs agree with a straight drift through all of them."""
    spans = [(f"{1900 + 5 * k}-01-01", f"{1956 + 5 * k}-01-01") for k in range(15)]
    results = [earthspin.precession(span=span).isel(perturber=-1) for span in spans]
    rates = np.array([float(r.precession_rate) for r in results]) * 1e5
    errors = np.array([float(r.precession_rate_error_method) for r in results]) * 1e5
    centuries = np.array(
        [
            (r.reference_epoch.values - np.datetime64("2000-01-01T12")) / np.timedelta64(36525, "D")
            for r in results
        ]
    )
    inside = centuries != 0  # spans that hold J2000.0 with two turns are referred to it
    line = np.polynomial.Polynomial.fit(centuries[inside], rates[inside], 1)
    off = np.abs(rates[inside] - line(centuries[inside]))
    assert inside.sum() >= 8
    assert np.mean(off <= errors[inside]) >= 0.95, (off, errors[inside])
    assert off.max() < 2.5  # mas a century
    # Lieske's t2 term of psi_A, -1.0790069 arcsec/cy2 (IAU 2006), twice
    assert abs(line.deriv()(0.0) / 1e3 + 2.158) < 0.05


@pytest.mark.parametrize(
    ("perturbers", "body"),
    [(["sun"], EARTH), (["sun"], MARS), (["venus"], EARTH), (["jupiter"], EARTH)],
    ids=["sun", "sun on mars", "venus", "jupiter"],
)
def test_short_windows_of_other_pulls_are_within_their_errors(perturbers: list, body: Body) -> None:
    """Three of Jupiter's years, anywhere in the kernel, against a straight drift."""
    spans = [(f"{1900 + 8 * k}-01-01", f"{1936 + 8 * k}-01-01") for k in range(14)]
    parts = [earthspin.precession(body=body, perturbers=perturbers, span=s) for s in spans]
    rates = np.array([float(p.precession_rate[0]) for p in parts])
    errors = np.array([float(p.precession_rate_error_method[0]) for p in parts])
    epochs = np.array([p.reference_epoch.values for p in parts])
    centuries = (epochs - np.datetime64("2000-01-01T12")) / np.timedelta64(36525, "D")
    drift = np.polynomial.Polynomial.fit(centuries, rates, 1)
    assert np.mean(np.abs(rates - drift(centuries)) <= errors) >= 0.92
    assert np.all(errors < 0.02 * np.abs(rates))


def test_labels_of_the_sun_alone() -> None:
    result = earthspin.run("sun-only")
    assert list(result.perturber.values) == ["sun", "total"]
    for rate in result.precession_rate:
        PINS["sun rate"].check(rate)


def test_mars_under_the_sun() -> None:
    result = earthspin.precession(body=MARS, perturbers=["sun"])
    PINS["mars rate"].check(result.precession_rate.sel(perturber="sun"))
    assert abs(float(result.obliquity) - 25.19) < 0.01


def test_mars_turns_as_it_is_observed_to() -> None:
    """C/(M R2) and geodesic precession together give the rate that landers have measured."""
    path = earthspin.pole(
        "1950-01-01", "2050-01-01", "50 d", body="mars", perturbers=["sun"], effects=["geodesic"]
    ).sel(axis="figure")
    years = (path.time - path.time[0]) / np.timedelta64(36525, "D") * 100
    PINS["mars rate with geodesic precession"].check(np.polyfit(years, path.psi, 1)[0])


def test_ten_thousand_bodies_are_one_call() -> None:
    h = xr.DataArray(EARTH.dynamical_flattening * np.linspace(0.9, 1.1, 10_000), dims="draw")
    scene = earthspin.load_scene("precession").replace(body=EARTH.replace(dynamical_flattening=h))
    tree = earthspin.run_tree(scene, "figure_models")
    result = tree.to_dataset()
    assert result.precession_rate.dims == ("perturber", "draw")
    assert tree["figure_models/period_by_model"].dims == ("earth_model", "draw")
    total = result.precession_rate.sel(perturber="total")
    assert np.allclose(total / total[0], h / h[0], rtol=1e-14, atol=0)


def test_mirror_and_rest() -> None:
    flat = earthspin.precession()
    prolate = earthspin.precession(
        body=EARTH.replace(j2=-EARTH.j2, dynamical_flattening=-EARTH.dynamical_flattening)
    )
    assert np.array_equal(prolate.precession_rate, -flat.precession_rate)
    sphere = earthspin.precession(body=EARTH.replace(j2=0.0, dynamical_flattening=0.0))
    assert not np.any(sphere.precession_rate)
    assert np.all(np.isinf(sphere.precession_period))
    assert np.all(np.isinf(sphere.precession_period_error))
    assert not np.any(sphere.mean_torque)


def test_a_mass_of_nothing_and_a_thousandfold_one() -> None:
    from dataclasses import replace

    nothing = earthspin.precession(perturbers=[SUN, replace(MOON, gm=0.0)])
    assert float(nothing.precession_rate.sel(perturber="moon")) == 0
    much = earthspin.precession(perturbers=[SUN, replace(MOON, gm=1000 * MOON.gm)])
    one = earthspin.precession()
    assert np.isclose(
        much.precession_rate.sel(perturber="moon"),
        1000 * one.precession_rate.sel(perturber="moon"),
        rtol=5e-15,
        atol=0,
    )


def test_retrograde_spin_turns_the_precession_round() -> None:
    one = earthspin.precession()
    back = earthspin.precession(body=EARTH.replace(spin_period=-EARTH.spin_period))
    assert np.array_equal(back.precession_rate, -one.precession_rate)
    assert np.all(back.precession_rate_error > 0)


@pytest.mark.parametrize("tilt", [0.0, 180.0])
def test_an_axis_upright_on_the_orbit_is_refused(tilt: float) -> None:
    ra, dec = MARS.orbit_pole
    pole = (ra, dec) if tilt == 0 else (ra - np.pi, -dec)
    with pytest.raises(UndefinedError, match="normal to the orbit"):
        earthspin.precession(body=MARS.replace(pole=pole), perturbers=["sun"])


def test_an_axis_in_the_orbit_does_not_precess() -> None:
    ra, dec = MARS.orbit_pole
    flat = MARS.replace(pole=(ra, dec - np.pi / 2))
    result = earthspin.precession(body=flat, perturbers=["sun"])
    # cos(90 deg) of the mean orbit; its wobble in a century leaves 5e-6 of 7.6 arcsec/yr
    assert abs(float(result.precession_rate[0])) < 5e-5


def test_periods() -> None:
    assert period(np.float64(2 * np.pi)) == 1.0
    assert np.isinf(period(np.float64(0.0)))
    assert period_error(np.float64(2.0), np.float64(0.02)) == pytest.approx(
        np.pi * 0.01, rel=1e-15, abs=0
    )
    rate, error = np.array([0.0, 0.0, 0.0, 1.0, 1.0]), np.array([1.0, 0.0, np.nan, np.nan, 0.0])
    half_widths = period_error(rate, error)
    np.testing.assert_array_equal(half_widths, [np.inf, np.inf, np.inf, np.nan, 0.0])
    for pair, half_width in zip(zip(rate, error, strict=True), half_widths, strict=True):
        np.testing.assert_array_equal(period_error(*pair), half_width)


def test_uncertainties_of_the_masses_add_up_as_squares() -> None:
    precessing = np.array([3.0, -4.0, -1.0])
    # hypot(3 x 0.1, 4 x 0.2) of a total of 1
    found = total_uncertainty(precessing, [0.1, 0.2])
    np.testing.assert_allclose(found, [0.1, 0.2, np.hypot(0.3, 0.8)], rtol=1e-15)
    assert list(total_uncertainty(np.array([3.0, 3.0]), [0.1])) == pytest.approx(
        [0.1, 0.1], abs=1e-16
    )
    # pulls that cancel leave nothing to be a part of
    assert total_uncertainty(np.array([3.0, -3.0, 0.0]), [0.1, 0.2])[-1] == 0.2


def test_planets_pull_a_little() -> None:
    result = earthspin.precession(perturbers=["sun", "venus", "jupiter"])
    assert float(result.precession_rate.sel(perturber="venus")) > 0
    # Capitaine et al. 2003: all planets 31.367e-5 arcsec/yr
    direct = result.precession_rate.sel(perturber=["venus", "jupiter"]).sum()
    assert 2e-4 < float(direct) < 4e-4
    assert set(BODIES) >= {"venus", "jupiter"}
    assert JULIAN_YEAR == 31557600.0

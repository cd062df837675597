"""What the rate means in the sky and in the calendar."""

import datetime

import numpy as np
import pytest
import xarray as xr

from earthspin.constants import (
    ARCSEC,
    ARCSEC_PER_YEAR,
    CHI_A_RATE,
    DAY,
    EPSILON_0,
    JULIAN_YEAR,
    P_A_RATE,
    PSI_A_RATE,
    SIDEREAL_YEAR,
    TROPICAL_YEAR,
)
from earthspin.nutation import rate_budget
from tests.conftest import load_pins

PINS = load_pins("precession")


def test_years_per_degree_and_per_day_of_drift(precession_tree: xr.DataTree) -> None:
    PINS["years per degree"].check(precession_tree["seasons/time_per_degree"])
    PINS["years per day of drift"].check(precession_tree["seasons/time_per_day_of_drift"])


def test_the_iau_rate_gives_the_tropical_year() -> None:
    """p_A of IAU 2006 and the sidereal year give the tropical year of Simon et al. 1994."""
    year = rate_budget.tropical_year(P_A_RATE.value * ARCSEC_PER_YEAR, 365.256363004 * DAY)
    assert abs(year - TROPICAL_YEAR.value) < 0.05  # s; measured: 0.006, between the two models


def test_the_gregorian_calendar_drifts_by_a_day_in_three_thousand_years() -> None:
    """Its mean year from the days of 400 years; the tropical year of Meeus & Savoie (1992)."""
    cycle = datetime.date(2400, 1, 1) - datetime.date(2000, 1, 1)
    assert cycle.days * DAY / 400 == rate_budget.GREGORIAN_YEAR
    drift = rate_budget.time_per_day_of_drift(365.24219 * DAY, rate_budget.GREGORIAN_YEAR)
    assert drift / JULIAN_YEAR == pytest.approx(1 / (365.2425 - 365.24219), rel=1e-9, abs=0)


def test_the_motion_of_the_ecliptic_is_taken_off() -> None:
    chi = CHI_A_RATE.value * ARCSEC_PER_YEAR
    eps = EPSILON_0.value * ARCSEC
    general = rate_budget.general_precession(PSI_A_RATE.value * ARCSEC_PER_YEAR, chi, eps)
    assert abs(general / ARCSEC_PER_YEAR - P_A_RATE.value) < 1e-8


def test_results_are_near_the_iaus(precession_tree: xr.DataTree) -> None:
    seasons_there = precession_tree["seasons"]
    # 3.8e-5 arcsec/yr and 0.007 s measured, with the published effects that the torques leave out
    assert abs(float(seasons_there.general_precession) - P_A_RATE.value) < 1e-4
    assert abs(float(seasons_there.tropical_year) * DAY - TROPICAL_YEAR.value) < 0.02
    drift = float(seasons_there.time_per_day_of_gregorian_drift)
    assert drift * (365.2425 - float(seasons_there.tropical_year)) == pytest.approx(1, abs=1e-9)
    assert float(precession_tree["free_wobble/observed_period"]) == 430.9
    longest = precession_tree["convergence/window_length"].max()
    assert abs(float(longest) - 5 * 18.6129) < 1e-3


def test_errors_of_seasons_and_calendar(precession_tree: xr.DataTree) -> None:
    """The rate is changed by its half-width, and everything computed again from it."""
    there = precession_tree["seasons"]
    error = float(there.general_precession_error)
    days = SIDEREAL_YEAR.value / DAY

    def derived(rate: float) -> dict[str, float]:
        year = 1 / (1 / days + rate / 1296000 / 365.25)
        return {
            "general_precession_period": 1296000 / rate,
            "time_per_degree": 3600 / rate,
            "tropical_year": year,
            "time_per_day_of_drift": 1 / (365.25 - year),
            "time_per_day_of_gregorian_drift": 1 / (365.2425 - year),
        }

    rate = float(there.general_precession)
    low, middle, high = (derived(rate + by) for by in (-error, 0.0, error))
    for name, value in middle.items():
        assert float(there[name]) == pytest.approx(value, rel=1e-9, abs=0), name
        change = abs(high[name] - low[name]) / 2
        assert float(there[f"{name}_error"]) == pytest.approx(change, rel=1e-3, abs=0), name


def test_no_precession_no_drift_between_years() -> None:
    assert rate_budget.tropical_year(0.0, JULIAN_YEAR) == JULIAN_YEAR
    assert np.isclose(rate_budget.time_per_degree(np.radians(1.0)), 1.0, rtol=1e-15, atol=0)


def test_the_seasons_come_early() -> None:
    assert rate_budget.tropical_year(1e-12, JULIAN_YEAR) < JULIAN_YEAR

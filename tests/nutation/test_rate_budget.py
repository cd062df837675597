"""The budget against ERFA's own polynomial, and against the published sum."""

import erfa
import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin.constants import (
    ARCSEC,
    ARCSEC_PER_YEAR,
    CHI_A_RATE,
    EPSILON_0,
    OMEGA_A_RATE,
    P_A_RATE,
    PSI_A_RATE,
)
from earthspin.nutation import rate_budget
from earthspin.sky.iau_models import precession_rates
from tests import shipped

#: Place of each angle in what erfa.p06e returns.
PLACE = {"psi_a": 1, "omega_a": 2, "chi_a": 8, "p_a": 12}


def test_rates_at_j2000_are_the_published_constants() -> None:
    rates = precession_rates(0.0)
    for ours, constant in (
        (rates.psi_a, PSI_A_RATE),
        (rates.omega_a, OMEGA_A_RATE),
        (rates.chi_a, CHI_A_RATE),
    ):
        # measured: 2e-10 arcsec/yr, rounding of an angle over a week
        assert abs(ours / ARCSEC_PER_YEAR - constant.value) < 1e-9


def rate_at_j2000(angle: str) -> float:
    """Derivative of an angle of IAU 2006, arcsec/yr, by central differences over +-0.01 cy."""
    step = 0.01
    forward, backward = (erfa.p06e(2451545.0, s * step * 36525)[PLACE[angle]] for s in (1, -1))
    return (forward - backward) / (2 * step * 100) / ARCSEC


@pytest.mark.parametrize(
    ("angle", "constant"),
    [("psi_a", PSI_A_RATE), ("omega_a", OMEGA_A_RATE), ("chi_a", CHI_A_RATE), ("p_a", P_A_RATE)],
)
def test_rates_are_erfas(angle: str, constant: object) -> None:
    # The cubic term of omega_A adds 8e-9 arcsec/yr at a hundredth of a century.
    assert abs(rate_at_j2000(angle) - constant.value) < 2e-8  # type: ignore[attr-defined]


def test_identity_of_the_general_precession() -> None:
    sum_ = PSI_A_RATE.value - CHI_A_RATE.value * np.cos(EPSILON_0.value * ARCSEC)
    assert abs(sum_ - P_A_RATE.value) < 1e-8


def test_the_published_effects_close_the_difference(precession_tree: xr.DataTree) -> None:
    """To 5 mas a century, which is 1 ppm of H."""
    beside = precession_tree["iau_2006"]
    assert abs(float(beside.closure)) < 5e-5
    # Without them the difference is four hundred times larger.
    assert float(beside.difference_from_iau) > 1.9e-2


def test_the_period_without_the_observed_precession(precession_tree: xr.DataTree) -> None:
    """From I/(M R2) = 0.330799 and R = 6371 km of PREM, with the published effects."""
    earth = earthspin.EARTH
    moment = 0.330799 * (6371e3 / earth.radius) ** 2 + 2 / 3 * earth.j2
    prem = earth.replace(dynamical_flattening=earth.j2 / moment)
    alone = float(earthspin.precession(body=prem).precession_rate[-1])
    effects = (-1919.883 - 46.78 + 31.367 - 21.05 + 2.60) * 1e-5
    period = float(precession_tree["iau_2006"].period_from_prem)
    # 1e-7 measured: the effects grow with H, too
    assert period == pytest.approx(360 * 3600 / (alone + effects), rel=2e-7, abs=0)


def test_the_closure_is_a_sum() -> None:
    """Of the five published effects, in 1e-5 arcsec/yr (Capitaine et al. 2003, table 3)."""
    total = (-1919.883 - 46.78 + 31.367 - 21.05 + 2.60) * 1e-5 * ARCSEC_PER_YEAR
    assert rate_budget.closure(0.0, 0.0) == pytest.approx(total, rel=1e-15, abs=0)
    assert rate_budget.closure(2e-12, 5e-12) == pytest.approx(total - 3e-12, rel=1e-15, abs=0)


def test_the_published_first_order() -> None:
    """54.94062986 cos(eps0) less what J2's rate and the tilt take, 269.43e-5 arcsec/yr."""
    shares = rate_budget.published_contributions(["first-order", "geodesic", "j3"])
    # cos(84381.406 arcsec) = 0.917482143065
    expected = 54.94062986 * 0.917482143065 - 269.43e-5
    assert shares["first-order"] / ARCSEC_PER_YEAR == pytest.approx(expected, rel=1e-12, abs=0)
    assert shares["geodesic"] / ARCSEC_PER_YEAR == pytest.approx(-0.01919883, rel=1e-15, abs=0)
    assert shares["j3"] == 0.0


def test_the_iau_rate_is_that_of_the_same_epoch() -> None:
    """In 1929 both rates are 1.5 arcsec/cy larger, and still close."""
    scene = earthspin.load_scene("precession", {"span": ("1900-01-01", "1958-01-01")})
    result = earthspin.run_tree(scene, "iau_2006")["iau_2006"]
    assert float(result.iau_rate) > PSI_A_RATE.value + 1e-2
    assert abs(float(result.closure)) < 2e-4  # measured: 1.1e-4, where the drifts differ


def test_each_rate_lies_within_its_error_of_the_published_one() -> None:
    of = shipped.answer("iau")
    for effect in ("planets", "j4", "geodesic", "second-order"):
        one = of.sel(effect=effect)
        assert abs(float(one.psi_rate - one.psi_rate_published)) < float(one.psi_rate_error), effect
    # 95 % half-width of H, 1.96 * 1e-9 / 0.0032737949, of the whole rate, and the analysis
    total = float(of.psi_rate_total_error)
    assert total == pytest.approx(np.hypot(3.02e-5, 1.14e-5), rel=0.01, abs=0)
    assert abs(float(of.closure)) < 2 * total

"""Constants: every unit parses, every value is used in the unit it claims."""

import math

import astropy.constants
import astropy.units as u
import numpy as np
import pytest
import xarray as xr

import earthspin
from data_tools import constants as constants_page
from earthspin import EARTH, MOON, SUN
from earthspin import constants as c
from earthspin.engine.labels import FROM_SI


def test_each_constant_has_a_source_and_says_where_it_was_read() -> None:
    for name, number in constants_page.cited().items():
        assert len(number.source) > 10, name
        assert len(number.read_in) > 8, name
        if isinstance(number, c.Constant):
            u.Unit(number.unit)
            assert number.uncertainty is None or number.uncertainty >= 0, name
            assert number.verified == (c.UNVERIFIED not in number.source), name


def test_an_unverified_number_says_so_in_its_source() -> None:
    number = c.Constant(1.0, "", None, "a paper", c.UNVERIFIED)
    assert number.source == f"a paper ({c.UNVERIFIED})"
    assert not number.verified
    assert c.Constant(1.0, "", None, "a paper").source == "a paper"


def test_the_page_of_constants_is_made_by_the_command() -> None:
    assert constants_page.PAGE.read_text(encoding="utf-8") == constants_page.page()


def test_against_astropy() -> None:
    assert astropy.constants.G.si.value == c.G.value
    assert astropy.constants.G.uncertainty == c.G.uncertainty
    # The IAU's nominal values are rounded to 5 or 8 digits.
    assert np.isclose(SUN.gm, astropy.constants.GM_sun.si.value, rtol=3e-9, atol=0)
    assert np.isclose(EARTH.gm, astropy.constants.GM_earth.si.value, rtol=1e-7, atol=0)
    assert np.isclose(EARTH.radius, astropy.constants.R_earth.si.value, rtol=1e-5, atol=0)


def test_spin_period_is_the_erfa_rotation_angle() -> None:
    import erfa

    day = 1.0  # UT1; the angle's excess over a whole turn in one day
    excess = (erfa.era00(2451545.0, day) - erfa.era00(2451545.0, 0.0)) % (2 * math.pi)
    turns = 1 + excess / (2 * math.pi)
    assert np.isclose(86400 / turns, EARTH.spin_period, rtol=1e-15, atol=0)


def test_node_period_is_the_erfa_argument() -> None:
    import erfa

    rate = (erfa.faom03(1e-4) - erfa.faom03(-1e-4)) / 2e-4  # rad a Julian century
    period = 2 * math.pi / abs(rate) * 36525 * 86400
    # The same rate of Simon et al. 1994 in both; the difference is the quadratic term's rounding.
    assert np.isclose(period, MOON.cycle, rtol=5e-14, atol=0)


@pytest.mark.parametrize("unit", FROM_SI)
def test_factors_from_si_agree_with_astropy(unit: str) -> None:
    si = u.rad if u.Unit(unit).is_equivalent(u.rad) else u.Unit(unit).si
    si = u.rad / u.s if u.Unit(unit).is_equivalent(u.rad / u.s) else si
    base = u.s if u.Unit(unit).physical_type == "time" else u.Unit(si.to_string())
    assert np.isclose(FROM_SI[unit], (1 * base).to_value(unit), rtol=1e-15, atol=0)


def test_the_perigee_turns_from_the_node_as_the_arguments_of_erfa() -> None:
    """Rate of the argument of the perigee, F - l, arcsec a century; measured: 3e-6 of them."""
    import erfa

    from earthspin.bodies.mean_orbits import NODE_RATE, PERIGEE_RATE

    expected = PERIGEE_RATE.value - NODE_RATE.value
    t = 0.01
    ends = [erfa.faf03(k * t) - erfa.fal03(k * t) for k in (-1, 1)]
    turned = (ends[1] - ends[0]) * 648000 / math.pi
    turned += 1296000 * round((2 * t * expected - turned) / 1296000)
    assert turned / (2 * t) == pytest.approx(expected, rel=0, abs=2e-3)


def test_mars_has_the_triaxiality_of_its_field() -> None:
    """MRO110B, jgmro_110b_sha.tab: C22 = -8.463591e-5, S22 = 4.893449e-5."""
    mars = 4 * math.sqrt(5 / 12) * math.hypot(8.4635914577e-5, 4.8934489648e-5)
    assert earthspin.MARS.triaxiality == pytest.approx(mars, rel=8e-7, abs=0)


def words_of(answer: object) -> str:
    """All attributes and words of an answer."""
    assert isinstance(answer, xr.Dataset)
    words = [str(answer.attrs)]
    for variable in answer.variables.values():
        words.append(str(variable.attrs))
        if variable.dtype.kind in "OU":
            words.append(str(variable.values))
    return " ".join(words)


@pytest.mark.parametrize(
    ("call", "body", "marked"),
    [
        ("cassini_states", "titan", True),
        ("cassini_states", "mercury", True),
        ("cassini_states", "moon", False),
        ("wobble_ladder", "earth", True),
        ("wobble_ladder", "mars", True),
        ("precession", "earth", False),
    ],
)
def test_an_answer_says_which_of_its_numbers_are_not_verified(
    call: str, body: str, marked: bool
) -> None:
    answer = getattr(earthspin, call)(body=body)
    assert (c.UNVERIFIED in words_of(answer)) == marked


def test_a_predicted_pole_says_which_of_its_numbers_are_not_verified() -> None:
    answer = earthspin.pole(times=["2000-01-01T12:00"], effects=["nonrigid"], response="predicted")
    assert c.UNVERIFIED in words_of(answer)

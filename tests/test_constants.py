"""Constants: every unit parses, every value is used in the unit it claims."""

import math
from dataclasses import replace

import astropy.constants
import astropy.units as u
import numpy as np
import pytest
import xarray as xr

import earthspin
from data_tools import constants as constants_page
from earthspin import EARTH, MOON, SUN
from earthspin import constants as c
from earthspin.bodies import BODIES
from earthspin.bodies.moons import TITAN_MOMENT
from earthspin.bodies.planets import PRECESSING_ORBITS
from earthspin.engine.variables import FROM_SI
from earthspin.interior import mars
from earthspin.interior.love import elastic
from earthspin.interior.named import MARS_K2
from earthspin.interior.ocean_and_anelasticity import WAVES


def test_each_constant_has_a_source_and_says_where_it_was_read() -> None:
    for name, number in constants_page.cited().items():
        assert len(number.source) > 10, name
        assert len(number.read_in) > 8, name
        if isinstance(number, c.Constant):
            u.Unit(number.unit)
            assert number.uncertainty is None or number.uncertainty >= 0, name
            assert number.verified == (c.UNVERIFIED not in number.source), name


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
    whole = u.Unit(unit.replace("cy", "hyr"))  # a century
    si = u.rad if whole.is_equivalent(u.rad) else whole.si
    si = u.rad / u.s if whole.is_equivalent(u.rad / u.s) else si
    base = u.s if whole.physical_type == "time" else u.CompositeUnit(1, si.bases, si.powers)
    assert np.isclose(FROM_SI[unit], (1 * base).to_value(whole), rtol=1e-15, atol=0)


def test_the_perigee_turns_from_the_node_as_the_arguments_of_erfa() -> None:
    """Rate of the argument of the perigee, F - l, arcsec a century; measured: 3e-6 of them."""
    import erfa

    from earthspin.bodies.planets import NODE_RATE, PERIGEE_RATE

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


def test_titan_is_near_hydrostatic_equilibrium() -> None:
    """By Radau and Darwin from C/(M R2) = 0.3414 (Iess et al. 2010) within the uncertainties.

    C/(M R2) = (2/3) (1 - (2/5) sqrt((4 - k)/(1 + k))), J2 = 5/6 k q and C22 = k q/4.
    """
    titan = BODIES["titan"]
    q = titan.spin_rate**2 * titan.radius**3 / titan.gm
    root = (2.5 * (1 - 1.5 * TITAN_MOMENT.value)) ** 2
    k = (4 - root) / (1 + root)
    u = titan.relative_uncertainty
    # measured: 0.9 and 1.4 per cent
    assert abs(5 / 6 * k * q / titan.j2 - 1) < u["j2"] < 0.025
    assert abs(k * q / titan.triaxiality - 1) < u["triaxiality"] < 0.025


def test_titan_has_the_orbit_of_tass() -> None:
    """Largest terms of TASS 1.7: e = 0.0289265, sin(i/2) = 0.0027899, node -0.0089312 rad/yr."""
    orbit = PRECESSING_ORBITS["titan"]
    assert orbit.e == pytest.approx(0.0289265, rel=0, abs=5e-5)
    assert orbit.i == pytest.approx(2 * math.asin(0.0027899429), rel=1e-4, abs=0)
    years = orbit.node_period / c.JULIAN_YEAR
    assert years == pytest.approx(-2 * math.pi / 0.0089312396, rel=1e-5, abs=0)


def test_the_orbit_of_mercury_turns_as_its_elements() -> None:
    """Rates of the mean elements (Standish, JPL p_elem_t1.txt), deg a century.

    The obliquity depends on sin(i) times the rate of the node, the speed of the orbit's pole.
    """
    node_rate, i_rate, i = -0.12534081, -0.00594749, math.radians(7.00497902)
    speed = math.radians(math.hypot(math.sin(i) * node_rate, i_rate)) / 100
    orbit = PRECESSING_ORBITS["mercury"]
    turned = math.sin(orbit.i) * 2 * math.pi / abs(orbit.node_period / c.JULIAN_YEAR)
    assert turned == pytest.approx(speed, rel=2e-3, abs=0)  # measured: 6e-4


def test_heights_of_the_diurnal_tides() -> None:
    """Cartwright and Edden's, m, in HARDISP of the IERS Conventions."""
    for name, height in {"K1": 0.368645, "O1": -0.262232, "Q1": -0.050208}.items():
        assert WAVES[name].height == pytest.approx(height, rel=2e-4, abs=0)


def test_the_love_number_of_mars_carries_its_layers(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each number of the model moved by its uncertainty; together 2.6 per cent of k2."""
    nominal = float(elastic(mars.four_layers()).k)
    crust, above, below = mars.SHEAR_SPEEDS
    changes = []
    for name, value in {
        "CRUST_DENSITY": raised(mars.CRUST_DENSITY),
        "CRUST": raised(mars.CRUST),
        "TRANSITION_RADIUS": raised(mars.TRANSITION_RADIUS),
        "SPEED_RATIO": raised(mars.SPEED_RATIO),
        "CORE_SPEED": raised(mars.CORE_SPEED),
        "SHEAR_SPEEDS": (raised(crust), raised(above), raised(below)),
    }.items():
        with monkeypatch.context() as patch:
            patch.setattr(mars, name, value)
            changes.append(float(elastic(mars.four_layers()).k) / nominal - 1)
    assert 0.02 < math.hypot(*changes) < MARS_K2.relative_uncertainty


def raised(number: c.Constant) -> c.Constant:
    """A constant that is larger by its uncertainty."""
    assert number.uncertainty is not None
    return replace(number, value=number.value + number.uncertainty)


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
        ("cassini_states", "titan", False),
        ("cassini_states", "mercury", False),
        ("cassini_states", "moon", False),
        ("wobble_ladder", "earth", True),
        ("wobble_ladder", "mars", False),
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

"""Constants: every unit parses, every value is used in the unit it claims."""

import math

import astropy.constants
import astropy.units as u
import numpy as np
import pytest

from earthspin import EARTH, MOON, SUN
from earthspin import constants as c
from earthspin.bodies import NUMBERS
from earthspin.engine.labels import FROM_SI

CONSTANTS = {name: value for name, value in vars(c).items() if isinstance(value, c.Constant)} | {
    f"{body} {name}": number for body, table in NUMBERS.items() for name, number in table.items()
}


@pytest.mark.parametrize("name", CONSTANTS)
def test_unit_parses_and_source_is_given(name: str) -> None:
    constant = CONSTANTS[name]
    u.Unit(constant.unit)
    assert len(constant.source) > 10
    assert constant.uncertainty is None or constant.uncertainty >= 0


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
    si = u.rad / u.s if unit == "arcsec/yr" else si
    base = u.s if u.Unit(unit).physical_type == "time" else u.Unit(si.to_string())
    assert np.isclose(FROM_SI[unit], (1 * base).to_value(unit), rtol=1e-15, atol=0)

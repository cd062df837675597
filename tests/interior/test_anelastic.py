"""The softening of the rocks with the period."""

import numpy as np
import pytest

from earthspin.interior.ocean_and_anelasticity import shear_modulus_change


def test_an_exponent_of_zero_is_the_limit() -> None:
    year = 3e7
    near, at = (shear_modulus_change(year, a) for a in (1e-9, 0.0))
    assert abs(near - at) < 4e-7
    assert at == pytest.approx(-2 / np.pi * np.log(year) + 1j, rel=1e-15, abs=0)
    x = (year / 200) ** 0.15
    growth = (1 - x) / np.tan(0.075 * np.pi)
    expected = -2 / np.pi * np.log(200) + growth + 1j * x
    assert shear_modulus_change(year, 0.15) == pytest.approx(expected, rel=1e-14, abs=0)

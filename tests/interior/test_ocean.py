"""An ocean all over, and waves of the tides, beside independent counterparts."""

import numpy as np
import pytest

from earthspin.interior.layers import PREM
from earthspin.interior.ocean_and_anelasticity import SEA_WATER, WAVES, global_ocean
from tests.conftest import load_pins

PINS = load_pins("wobble")


def test_global_ocean() -> None:
    PINS["global ocean"].check(global_ocean(PREM))
    assert global_ocean(PREM, density=0.0) == 0


#: FES2004 as heights of the tide: amplitude (cm) and phase (deg) of the prograde coefficient of
#: degree 2 and order 1, and the shift of the phase in the Conventions, table 6.6. From the file
#: fes2004.dat, in the test data of Orekit; the coefficients of the potential are its other file.
HEIGHTS = {"Q1": (0.4240, 316.610, 270), "O1": (2.0262, 313.047, 270), "K1": (2.2583, 317.348, 90)}


@pytest.mark.parametrize("name", list(HEIGHTS))
def test_waves_of_the_potential_are_those_of_the_heights(name: str) -> None:
    """IERS Conventions (2010), eq. 6.21: F (sin, cos)(phase + shift), with F for degree 2."""
    amplitude, phase, shift = HEIGHTS[name]
    factor = 4 * np.pi * 6.67428e-11 * SEA_WATER.value / 9.7803278 * (1 - 0.3075) / 5
    angle = np.radians(phase + shift)
    expected = factor * amplitude / 100 / 1e-11 * np.array([np.sin(angle), np.cos(angle)])
    found = WAVES[name].cosine, WAVES[name].sine
    np.testing.assert_allclose(found, expected, rtol=3e-6, atol=0)  # measured: 1.3e-6

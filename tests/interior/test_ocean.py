"""An ocean all over, beside the independent calculation."""

from earthspin.interior.layers import PREM
from earthspin.interior.ocean_and_anelasticity import global_ocean
from tests.conftest import load_pins

PINS = load_pins("wobble")


def test_global_ocean() -> None:
    PINS["global ocean"].check(global_ocean(PREM))
    assert global_ocean(PREM, density=0.0) == 0

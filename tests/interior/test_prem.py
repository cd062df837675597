"""PREM beside what was published of it."""

from earthspin.interior.layers import PREM, PREM_WITH_OCEAN
from tests.conftest import load_pins

PINS = load_pins("wobble")


def test_moments_of_prem() -> None:
    PINS["prem moment"].check(PREM_WITH_OCEAN.moment_factor)
    PINS["prem core fraction"].check(PREM_WITH_OCEAN.core_fraction)
    PINS["prem moment, ocean filled"].check(PREM.moment_factor)
    PINS["prem core fraction, ocean filled"].check(PREM.core_fraction)

"""PREM beside what was published of it."""

from earthspin.interior.layers import PREM
from tests.conftest import load_pins
from tests.interior.prem import PREM_WITH_OCEAN

PINS = load_pins("wobble")


def test_moments_of_prem() -> None:
    PINS["prem moment"].check(PREM_WITH_OCEAN.moment_factor)
    PINS["prem core fraction"].check(PREM_WITH_OCEAN.core_fraction)
    PINS["prem moment, ocean filled"].check(PREM.moment_factor)
    PINS["prem core fraction, ocean filled"].check(PREM.core_fraction)

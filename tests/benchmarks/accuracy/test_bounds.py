"""Each method of the package holds its bound at its finest setting; run times are not tested."""

import pytest

from tests.benchmarks.accuracy import LADDERS

#: Ladders whose errors are taken from many records, seeds or epochs.
SLOW = {"chandler", "ensemble", "forecast-30", "forecast-90", "precession", "torque"}


@pytest.mark.parametrize(
    "quantity",
    [pytest.param(name, marks=[pytest.mark.slow] * (name in SLOW)) for name in LADDERS],
)
def test_finest_settings_hold_their_bounds(quantity: str) -> None:
    ladder = LADDERS[quantity]()
    for method, bound in ladder.bounds.items():
        *_, finest = ladder.runs[method].values()
        assert ladder.error_of(finest) <= bound, method

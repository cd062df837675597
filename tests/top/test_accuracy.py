"""The closed form against the textbook's at eighty digits, over families of random tops."""

import pytest

from tests.top.accuracy import FRACTIONS, GOOD, LATE, errors
from tests.top.families import FAMILIES, cases

#: Tops per family; 500 of each were tried once.
CASES = 4
#: Tops per family after ten thousand nutations, where every input of every case is moved.
LATE_CASES = 1
#: Errors beyond 1e-13 stay below this many units in the last place of the inputs, added up.
ULPS, LATE_ULPS = 2.0, 4.0


@pytest.mark.parametrize(
    ("count", "times", "ulps"), [(CASES, FRACTIONS, ULPS), (LATE_CASES, (LATE,), LATE_ULPS)]
)
@pytest.mark.parametrize("family", FAMILIES)
def test_thirteen_digits_or_what_the_start_tells(
    family: str, count: int, times: tuple[float, ...], ulps: float
) -> None:
    for start in cases(family, count):
        found = errors(start, times)
        assert found.error <= GOOD or found.ulps <= ulps, (start, found)

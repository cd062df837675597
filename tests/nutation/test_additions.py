"""What IAU 2000A adds to a response: as its authors have it, and as it is found in the series."""

import numpy as np
import pytest

from data_tools import core_resonance as resonance
from earthspin.constants import UAS
from earthspin.nutation.additions import ADDITIONS, added_to
from earthspin.nutation.circles import MULTIPLES, phases


def test_additions_stand_at_their_circles() -> None:
    circles = np.concatenate([MULTIPLES, -MULTIPLES])
    found = added_to(circles)
    assert np.count_nonzero(found) == len(ADDITIONS)
    in_phase, out_of_phase = phases(found[circles.tolist().index([0, -1, 0, 0, 0])] / UAS)
    np.testing.assert_allclose([in_phase, out_of_phase], [-86.6, 107.2], rtol=1e-12, atol=0)


@pytest.mark.parametrize(
    ("term", "within"),
    # measured: 7.3, 16.8, 1.7 and 5.9 uas
    [("retrograde year", 10), ("prograde year", 20), ("prograde 18.6 years", 4), ("", 8)],
)
def test_a_response_that_is_blind_to_them_finds_them(term: str, within: float) -> None:
    """Fitted to other terms, with the published mode, it leaves what the authors say they added."""
    multiple = resonance.ADDED_TO.get(term, resonance.HALF_YEAR)
    added = phases(added_to(np.array([multiple])) / UAS)
    found = resonance.left_by(resonance.held(resonance.BUILT_IN), multiple)
    assert abs(found - complex(added[0][0], added[1][0])) < within


@pytest.mark.parametrize("multiple", list(resonance.REN_2000))
def test_rigid_terms_beside_the_resonance_are_those_of_ren_2000(multiple: tuple[int, ...]) -> None:
    assert resonance.beside_ren_2000(multiple) < 3  # measured: 1.6, 1.9 and 0.9 uas

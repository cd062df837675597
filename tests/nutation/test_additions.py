"""What IAU 2000A adds to a response: as its authors have it, and as it is found in the series."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

import earthspin
from earthspin import EARTH
from earthspin.constants import UAS
from earthspin.engine.run import Run
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.nutation.analysis import MULTIPLES, phases
from earthspin.nutation.response import (
    ADDITIONS,
    CORE_NUTATION_START,
    Response,
    added_to,
    fit_response,
)

#: The mode that is built into IAU 2000A, as IERS Conventions (2010), table 6.4, have it.
BUILT_IN = complex(*CORE_NUTATION_START)
#: The half year, retrograde.
HALF_YEAR = (0, 0, -2, 2, -2)
#: The terms to which most is added.
ADDED_TO = {
    "prograde year": (0, 1, 0, 0, 0),
    "retrograde year": (0, -1, 0, 0, 0),
    "prograde 18.6 years": (0, 0, 0, 0, -1),
}
#: Rigid terms of REN-2000 (Souchay et al. 1999) as a public VLBI code has them (SGDASS,
#: vtd/include/ren2000_heo.i), with what a century and a half does not part from them, at J2000.0:
#: in phase and out of phase, uas.
REN_2000: dict[tuple[int, ...], complex] = {
    (0, -1, 0, 0, 0): complex(-25235.1, 164.8),
    (0, 1, 0, 0, 0): complex(17060.4, -3865.5),
    (0, 0, -2, 2, -2): complex(-22311.7, 134.3),
}
#: Its dynamical flattening, of which ours is so many times as large.
OVER_REN_2000 = 1.00001225


@dataclass(frozen=True)
class Terms:
    """Circular terms without geodesic nutation.

    Attributes
    ----------
    multiples : ndarray, shape (k, 5)
    frequency : ndarray, shape (k,)
        In space, rad/s.
    rigid, iau : ndarray, shape (k,), complex
        Of torques on a rigid Earth, and of IAU 2000A, rad.
    added : ndarray, shape (k,), complex
        What the authors of IAU 2000A add to a response, rad.
    """

    multiples: NDArray[np.int64]
    frequency: FloatArray
    rigid: ComplexArray
    iau: ComplexArray
    added: ComplexArray

    def place(self, multiple: Sequence[int]) -> int:
        """Where a term stands."""
        return int(np.flatnonzero(np.all(self.multiples == multiple, axis=1))[0])

    def all_but(self, without: Sequence[Sequence[int]]) -> NDArray[np.bool_]:
        """Which terms are left if some are left out."""
        there = np.ones(len(self.frequency), dtype=bool)
        there[[self.place(multiple) for multiple in without]] = False
        return there


@cache
def terms() -> Terms:
    """Those of the comparison with the IAU."""
    run = Run(earthspin.load_scene("iau"))
    apart, circles = run["response_fit"], run["comparison"].computed_circles
    iau = apart.residual + apart.response.transfer(circles.frequency) * apart.rigid
    return Terms(circles.multiples, circles.frequency, apart.rigid, iau, apart.added)


def blind() -> Response:
    """Response fitted to IAU 2000A without the terms to which most is added."""
    known = terms()
    used = known.all_but(list(ADDED_TO.values()))
    h, spin = EARTH.number("dynamical_flattening"), float(EARTH.spin_rate)
    return fit_response(known.frequency[used], known.rigid[used], known.iau[used], h, spin)


def held(
    mode: complex,
    without: Sequence[Sequence[int]] = tuple(ADDED_TO.values()),
    iau: ComplexArray | None = None,
) -> Response:
    """The same with the mode of the core held, or without other terms, or of other amplitudes."""
    known = terms()
    iau = known.iau if iau is None else iau
    columns = []
    for strength in np.eye(4, dtype=complex):
        response = replace(blind(), core_nutation=mode, strengths=strength)
        columns.append(response.transfer(known.frequency))
    base = replace(blind(), core_nutation=mode, strengths=np.zeros(4, dtype=complex))
    none = base.transfer(known.frequency)
    design = (np.array(columns).T - none[:, np.newaxis]) * known.rigid[:, np.newaxis]
    left = iau - none * known.rigid
    used = known.all_but(without)
    strengths = np.linalg.lstsq(design[used], left[used], rcond=None)[0]
    return replace(base, strengths=np.asarray(strengths, dtype=np.complex128))


def beside_ren_2000(multiple: Sequence[int]) -> float:
    """How far our rigid term is from that of REN-2000, uas."""
    known = terms()
    own = 1j * known.rigid[known.place(multiple)] / OVER_REN_2000 / UAS
    return float(abs(own - REN_2000[tuple(multiple)]))


def left_by(response: Response, multiple: Sequence[int]) -> complex:
    """What a response leaves of a term of IAU 2000A, in phase and out of phase, uas."""
    known = terms()
    left = known.iau - response.transfer(known.frequency) * known.rigid
    return complex(1j * left[known.place(multiple)] / UAS)


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
    multiple = ADDED_TO.get(term, HALF_YEAR)
    added = phases(added_to(np.array([multiple])) / UAS)
    found = left_by(held(BUILT_IN), multiple)
    assert abs(found - complex(added[0][0], added[1][0])) < within


@pytest.mark.parametrize("multiple", list(REN_2000))
def test_rigid_terms_beside_the_resonance_are_those_of_ren_2000(multiple: tuple[int, ...]) -> None:
    assert beside_ren_2000(multiple) < 3  # measured: 1.6, 1.9 and 0.9 uas


#: The nutation series MHB2000 by Herring less the resonance form (SGDASS, vtd/include,
#: mhb2000_heo.i and mhb2000_transf_heo.i), uas, in the order of `ADDITIONS`. The additions were
#: read in a third file, by another author.
HERRING = (
    -58.25 + 107.36j, -25.64 + 115.05j, -36.86 + 0.43j, -22.81 + 23.02j, -6.06 + 7.30j,
    0.83 - 6.37j, -17.28 - 0.91j, -2.10 + 2.60j, 0.72 - 1.90j, 1.44 - 2.52j, -1.84 - 0.08j,
    -1.01 + 1.20j, -1.01 + 1.03j, -0.72 + 0.97j, 0.02 - 1.26j, -0.72 + 0.93j,
)  # fmt: skip
#: Differences of the two authors, uas, where they are larger than 0.6: in the three terms that
#: other tests find in IAU 2000A; in retrograde 18.6 years, a term of 8 arcsec, whose addition of
#: 3.5 uas is too small to be found; and in fortnights, of which the first has the opposite sign.
DIFFERENT = {
    (0, -1, 0, 0, 0): 29.0,
    (0, 1, 0, 0, 0): 18.0,
    (0, 0, 0, 0, -1): 2.7,
    (0, 0, 0, 0, 1): 21.0,
    (0, 0, -2, 0, -2): 2.0,
    (1, 0, 2, 0, 2): 1.1,
}


def test_additions_are_those_of_the_whole_series() -> None:
    for (multiple, added), other in zip(ADDITIONS.items(), HERRING, strict=True):
        assert abs(added - other) < DIFFERENT.get(multiple, 0.6), multiple


def test_the_other_terms_tell_the_sign_in_retrograde_18_6_years() -> None:
    """Fitted to all other terms, a response leaves 8.1 + 9.1i uas of this one of 8 arcsec.

    This is nearer to +3.5 than to -3.5 uas; the two authors differ by more.
    """
    multiple = (0, 0, 0, 0, 1)
    known = terms()
    left = left_by(held(BUILT_IN, [multiple], known.iau - known.added), multiple)
    published = ADDITIONS[multiple]
    assert abs(left - published) < min(12, abs(left + published))


def test_the_retrograde_fortnight_is_that_of_the_fit() -> None:
    left = left_by(held(BUILT_IN), (0, 0, -2, 0, -2))
    assert abs(left - ADDITIONS[0, 0, -2, 0, -2]) < 0.5  # measured: 0.34

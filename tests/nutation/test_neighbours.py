"""Amplitudes of nutation against the series itself, as Skyfield carries it."""

import numpy as np
import pytest
from skyfield.functions import load_bundled_npy

from earthspin.constants import ARCSEC, EPSILON_0, MAS
from earthspin.nutation.analysis import (
    LEFT_OUT,
    MULTIPLES,
    amplitude_error,
    circles_of,
    neighbours_of,
)
from earthspin.sky import iau_models
from tests import shipped

RATES, AT_EPOCH = iau_models.delaunay_rates(), iau_models.delaunay_arguments(np.zeros(1))[:, 0]
SINE = np.sin(EPSILON_0.value * ARCSEC)


def series() -> dict[tuple[int, ...], complex]:
    """Circular amplitudes of the luni-solar terms of IAU 2000A at J2000.0, mas."""
    table = load_bundled_npy("nutation.npz")
    longitude = table["lunisolar_longitude_coefficients"] * 1e-4 * SINE
    obliquity = table["lunisolar_obliquity_coefficients"] * 1e-4
    found: dict[tuple[int, ...], complex] = {}
    for multiple, (sine, _, cosine), (deps_cos, _, deps_sin) in zip(
        table["nals_t"].astype(int), longitude, obliquity, strict=True
    ):
        in_cosine, in_sine = cosine + 1j * deps_cos, sine + 1j * deps_sin
        for own, size in (
            (multiple, (in_cosine - 1j * in_sine) / 2),
            (-multiple, (in_cosine + 1j * in_sine) / 2),
        ):
            found[tuple(own)] = found.get(tuple(own), 0j) + size
    return found


IAU_2000A = series()


@pytest.mark.parametrize("term", LEFT_OUT, ids=lambda term: str(term.multiples))
def test_terms_left_out_are_those_of_the_series(term: object) -> None:
    forward, backward = circles_of(term)  # type: ignore[arg-type]
    multiple = term.multiples  # type: ignore[attr-defined]
    # half a unit of the last tabulated digit, 5e-5 mas, is all that may differ
    assert abs(forward / MAS - IAU_2000A[multiple]) < 5e-5
    assert abs(backward / MAS - IAU_2000A[tuple(-m for m in multiple)]) < 5e-5


def test_no_other_large_term_stands_beside_one_that_is_found() -> None:
    every = np.concatenate([MULTIPLES, -MULTIPLES])
    known = {tuple(m) for m in every.tolist()}
    known |= {tuple(s * m for m in t.multiples) for t in LEFT_OUT for s in (1, -1)}
    frequency = every @ RATES
    resolved = 2 * np.pi / (150 * 365.25 * 86400)
    for multiple, size in IAU_2000A.items():
        own = np.array(multiple) @ RATES
        if multiple not in known and abs(own) > resolved and abs(size) > 0.06:
            assert np.min(np.abs(frequency - own)) > resolved, multiple


def test_each_amplitude_is_that_of_the_series_and_of_its_neighbour() -> None:
    """The analysis of the pole of IAU 2000A gives back the amplitudes that it is made of."""
    table = shipped.tree("iau")["nutation"].to_dataset(inherit=False)
    worst = 0.0
    for number, name in enumerate(table.term.values):
        of = table.isel(term=number)
        found = complex(of.iau_in_phase, of.iau_out_of_phase)
        beside = complex(of.neighbour_in_phase, of.neighbour_out_of_phase)
        true = 1j * IAU_2000A[tuple(int(m) for m in name.split())]
        used = abs(found - beside - true) / float(of.amplitude_error)
        worst = max(worst, used)
        assert used < 1, name
    assert worst > 0.5  # measured: 0.75; a bound ten times too wide would be no bound


def test_the_prograde_year_holds_a_third_of_itself_of_its_neighbour() -> None:
    table = shipped.tree("iau")["nutation"].to_dataset(inherit=False)
    year = table.sel(term="+0 +1 +0 +0 +0")
    assert str(year.neighbour.values) == "+0 -1 +2 -2 +2"
    # IAU 2000A: 25.660 mas for itself, 9.089 mas for the neighbour, 206 degrees ahead
    assert abs(complex(year.neighbour_in_phase, year.neighbour_out_of_phase)) == pytest.approx(
        9.089, abs=1e-3
    )
    alone = float(year.iau_in_phase - year.neighbour_in_phase)
    assert alone == pytest.approx(25.660, abs=0.01)
    assert list(table.neighbour.values[[3, 9]]) == ["", ""]


def test_neighbours_are_found_by_frequency() -> None:
    every = np.concatenate([MULTIPLES, -MULTIPLES])
    names, _ = neighbours_of(every, every @ RATES, RATES, AT_EPOCH)
    beside = {tuple(m): name for m, name in zip(every.tolist(), names, strict=True) if name}
    assert beside == {
        (0, 1, 0, 0, 0): "+0 -1 +2 -2 +2", (0, -1, 0, 0, 0): "+0 +1 -2 +2 -2",
        (0, 0, 2, -2, 2): "+0 +2 +0 +0 +0", (0, 0, -2, 2, -2): "+0 -2 +0 +0 +0",
        (0, 0, 0, 0, 1): "+0 +2 -2 +2 -1", (0, 0, 0, 0, -1): "+0 -2 +2 -2 +1",
        # beside twice the node as well, but nearer still to this one
        (1, -1, 0, -1, 0): "+1 +0 -1 +0 -1", (-1, 1, 0, 1, 0): "-1 +0 +1 +0 +1",
        (0, 1, 0, 0, -1): "+0 -1 +2 -2 +1", (0, -1, 0, 0, 1): "+0 +1 -2 +2 -1",
    }  # fmt: skip
    assert np.all(amplitude_error(every @ RATES) > 0)

"""Sums of Chebyshev series by records, against jplephem and numpy, bit for bit in any layout."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from jplephem.spk import SPK
from numpy.polynomial.chebyshev import chebval

from earthspin.constants import J2000_JD
from earthspin.sky.ephemeris import find_kernel
from earthspin.sky.kernel import Epochs, Grid, Records, SegmentSeries

RECORDS, DAYS_EACH = 40, 4.0


def table(terms: int, records: int = RECORDS) -> SegmentSeries:
    """Series that fall off as those of a kernel do, in records of four days from day -10."""
    rng = np.random.default_rng(terms)
    fall = np.tile(0.2 ** np.arange(terms), 3)
    series = 4e5 * fall * rng.standard_normal((records, 3 * terms))
    return SegmentSeries(series, Grid(-10.0 * 86400.0, DAYS_EACH * 86400.0, records))


@pytest.mark.parametrize("terms", [1, 2, 3, 13])
def test_against_numpys_own_sums(terms: int) -> None:
    tables, days = table(terms), np.random.default_rng(1).uniform(-10.0, 150.0, 500)
    record = np.floor((days + 10.0) / DAYS_EACH).astype(int)
    place = 2 * ((days + 10.0) / DAYS_EACH - record) - 1
    series = tables.series[record].reshape(-1, 3, terms)
    expected = [[chebval(x, one) for one in each] for x, each in zip(place, series, strict=True)]
    # 4e5 times what the place loses when days of -10 are counted from the start: 2e-15
    np.testing.assert_allclose(tables.at(Epochs(days)), np.transpose(expected), rtol=0, atol=1e-8)


def test_both_ends_belong_to_the_table() -> None:
    tables = table(5)
    ends = tables.at(Epochs(np.array([-10.0, -10.0 + RECORDS * DAYS_EACH])))
    signs = (-1.0) ** np.arange(5)
    first, last = tables.series[0].reshape(3, 5), tables.series[-1].reshape(3, 5)
    np.testing.assert_allclose(ends[:, 0], first @ signs, rtol=1e-14, atol=1e-9)
    np.testing.assert_allclose(ends[:, 1], last.sum(axis=1), rtol=1e-14, atol=1e-9)


def test_positions_of_a_kernel_are_those_of_jplephem() -> None:
    """Every segment, times in order and not: 5e-16 of the distance (measured 3.8e-16)."""
    path = find_kernel("de421")
    in_order = np.arange(0.0, 3000.0, 0.11)
    anywhere = np.random.default_rng(2).uniform(-36000.0, 19000.0, 20_000)
    kernel = SPK.open(path)
    try:
        for segment in kernel.segments:
            ours = Records(segment, path).table()
            for days in (in_order, anywhere):
                theirs = segment.compute(J2000_JD, days)[:3]
                off = np.linalg.norm(ours.at(Epochs(days)) - theirs, axis=0)
                assert np.all(off <= 5e-16 * np.linalg.norm(theirs, axis=0))
                del theirs  # views into the file, which closes
    finally:
        kernel.close()


@given(
    step=st.floats(0.001, 6.0),
    first=st.floats(-10.0, 100.0),
    size=st.integers(1, 400),
    seed=st.integers(0, 2**32 - 1),
)
def test_a_time_has_the_same_bits_in_any_company(
    step: float, first: float, size: int, seed: int
) -> None:
    """In order, out of order, alone: blocks and regions of a series cannot differ."""
    tables = table(13)
    days = np.minimum(first + step * np.arange(size), -10.0 + RECORDS * DAYS_EACH)
    together = tables.at(Epochs(days))
    order = np.random.default_rng(seed).permutation(size)
    np.testing.assert_array_equal(tables.at(Epochs(days[order])), together[:, order])
    some = np.sort(order[: size // 2 + 1])
    np.testing.assert_array_equal(tables.at(Epochs(days[some])), together[:, some])
    np.testing.assert_array_equal(tables.at(Epochs(days[:1])), together[:, :1])


def test_no_times_have_no_positions() -> None:
    assert table(13).at(Epochs(np.empty(0))).shape == (3, 0)

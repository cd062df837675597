"""Tables of orbits: what is shipped, what is fitted, and what they are held against."""

import io
from dataclasses import replace
from pathlib import Path

import erfa
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.polynomial import legendre

import earthspin
from earthspin import CoverageError
from earthspin.constants import ARCSEC, J2000_JD, JULIAN_YEAR
from earthspin.errors import OutputError
from earthspin.sky.orbit_table import OrbitTable, fitted, load, shipped, write

KYR = 1000 * JULIAN_YEAR
WORLDS = ("earth", "mars")


def table(name: str) -> OrbitTable:
    found = shipped(name)
    assert found is not None
    return found


@pytest.mark.parametrize("name", ["venus", "nobody", "../orbits/earth", "a b"])
def test_there_is_no_other(name: str) -> None:
    assert shipped(name) is None


@pytest.mark.parametrize("name", WORLDS)
def test_windows_meet(name: str) -> None:
    """Values jump by what the units of 1e-9 and their sum allow, rates by little."""
    of = table(name)
    before, after = of.coefficients[:, :-1], of.coefficients[:, 1:]
    ends = np.ones(of.coefficients.shape[-1])
    starts = (-1.0) ** np.arange(ends.size)
    jump = np.abs(before @ ends - after @ starts)
    assert jump.max() < 2e-8  # 0.004 arcsec


@pytest.mark.parametrize("name", WORLDS)
@given(st.floats(-1, 1))
def test_vectors_are_what_they_are_called(name: str, share: float) -> None:
    time = np.array([share * 10e6 * JULIAN_YEAR])
    normal, eccentricity, turning = (of[:, 0] for of in table(name).at(time))
    assert np.linalg.norm(normal) == pytest.approx(1.0, rel=1e-14, abs=0)
    assert abs(normal @ eccentricity) < 1e-15
    assert abs(normal @ turning) < 1e-26
    assert 0 <= np.linalg.norm(eccentricity) < 0.15


@pytest.mark.parametrize("name", WORLDS)
def test_the_rate_is_that_of_the_normal(name: str) -> None:
    times = np.array([-7.013e6, -123.4e3, 5.0, 2.505e6]) * JULIAN_YEAR
    h = 1 * JULIAN_YEAR
    slope = (table(name).at(times + h)[0] - table(name).at(times - h)[0]) / (2 * h)
    assert np.allclose(table(name).at(times)[2], slope, rtol=1e-5, atol=1e-19)


@pytest.mark.parametrize(
    ("years", "bound"), [(0, 0.15), (-1000, 0.15), (1000, 0.15), (-2000, 0.15), (2000, 0.15)]
)
def test_the_ecliptic_of_iau_2006(years: int, bound: float) -> None:
    """0.06 to 0.11 measured: 0.06 arcsec rms of terms near 900 years are smoothed away."""
    normal = table("earth").at(np.array([years * JULIAN_YEAR]))[0][:, 0]
    true = np.asarray(erfa.ecm06(J2000_JD, years * 365.25)[2])
    assert np.linalg.norm(normal - true) / ARCSEC < bound


def test_the_ecliptic_of_the_long_term_model_of_erfa() -> None:
    """Vondrak, Capitaine & Wallace 2011: 5 arcsec apart at 10,000 years."""
    for years in (-10_000, 10_000):
        normal = table("earth").at(np.array([years * JULIAN_YEAR]))[0][:, 0]
        true = np.asarray(erfa.ltpecl(2000.0 + years))
        frame = np.asarray(erfa.ltpb(2000.0)).T @ np.asarray(erfa.ltp(2000.0))  # bias alone
        assert np.linalg.norm(normal - frame @ true) / ARCSEC < 10


@pytest.mark.parametrize(
    ("name", "eccentricity", "measured"),
    [("earth", 0.0167086342, 2e-5), ("mars", 0.0934006477, 2e-5)],
)
def test_the_mean_eccentricity_of_j2000(name: str, eccentricity: float, measured: float) -> None:
    """Simon et al. 1994, A&A 282, 663, sect. 5.8: mean elements of Earth (barycentre) and Mars."""
    _, e, _ = table(name).at(np.zeros(1))
    assert abs(np.linalg.norm(e) - eccentricity) < 1.5 * measured


def test_stored_and_read_again_is_the_same(tmp_path: Path) -> None:
    for name in WORLDS:
        path = tmp_path / f"{name}.npz"
        table(name).to_file(path)
        again = earthspin.read_orbit(path)
        assert np.array_equal(again.coefficients, table(name).coefficients)
        assert np.array_equal(again.edges, table(name).edges)
        assert np.array_equal(again.errors, table(name).errors)
        assert (again.name, again.source) == (table(name).name, table(name).source)


def test_samples_of_a_table_give_it_again() -> None:
    """Of every 200 years by least squares, and of every 1,000 by splines."""
    of = table("earth")
    # splines round off what corners there are between windows
    for step, off in ((0.2, (1e-9, 1e-9)), (1.0, (1e-6, 2e-5))):
        times = np.arange(-200, 200.5 * (1 + 1e-9), step) * KYR
        times = times[times <= 200 * KYR]
        n, e, _ = of.at(times)
        again = fitted("earth", times, n.T, e.T, of.axes, "itself")
        at = np.linspace(-199, 199, 797) * KYR
        for found, true, bound in zip(again.at(at)[:2], of.at(at)[:2], off, strict=True):
            assert np.max(np.linalg.norm(found - true, axis=0)) < bound
            assert np.median(np.linalg.norm(found - true, axis=0)) < bound / 10
        assert again.edges[0] == times[0]
        assert again.edges[-1] == times[-1]
        assert 0.0 in again.edges
        assert np.max(again.errors) < off[1]


def test_what_is_left_out_shows_in_the_error() -> None:
    """A wave of 300 years and 2e-6 in the normal, twice its rms."""
    of = table("earth")
    times = np.arange(-100, 100.01, 0.02) * KYR
    n, e, _ = of.at(times)
    n = n + 2e-6 * np.sin(2 * np.pi * times / (0.3 * KYR)) * of.axes[0][:, np.newaxis]
    n = n / np.linalg.norm(n, axis=0)
    again = fitted("earth", times, n.T, e.T, of.axes, "with a wave")
    assert np.median(again.errors[0]) == pytest.approx(2 * 2e-6 / np.sqrt(2), rel=0.05, abs=0)
    at = np.linspace(-99, 99, 500) * KYR
    # but for the ends of windows, which lie on samples
    off = np.linalg.norm(again.at(at)[0] - of.at(at)[0], axis=0)
    assert np.median(off) < 3e-7
    assert np.max(off) < 2e-6


@pytest.mark.parametrize("share", [-1.0000001, 1.0000001])
def test_times_outside_are_refused_by_name(share: float) -> None:
    with pytest.raises(CoverageError, match=r"orbit of mars.*-10000 kyr to 10000 kyr"):
        table("mars").at(np.array([share * 10e6 * JULIAN_YEAR]))


def test_the_error_is_read_between_the_middles_of_windows() -> None:
    of = replace(table("earth"), errors=np.vstack([np.arange(1000.0), np.ones(1000)]))
    middles = (of.edges[:-1] + of.edges[1:]) / 2
    assert np.allclose(of.error(middles[3:5]), [[3.0, 4.0], [1.0, 1.0]], rtol=1e-12, atol=0)
    assert np.allclose(of.error(of.edges[4:5]), [[3.5], [1.0]], rtol=1e-12, atol=0)


def test_a_table_needs_the_ending_that_numpy_gives(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"end in \.npz"):
        table("mars").to_file(tmp_path / "mars.txt")
    with pytest.raises(OutputError, match="cannot be written"):
        table("mars").to_file(tmp_path / "no" / "mars.npz")


def test_series_are_legendre_series(tmp_path: Path) -> None:
    """Evaluated by numpy itself."""
    of = table("earth")
    write(tmp_path / "earth.npz", of)
    with np.load(io.BytesIO((tmp_path / "earth.npz").read_bytes())) as file:
        stored = file["coefficients"] * 1e-9
    assert np.array_equal(load(tmp_path / "earth.npz").coefficients, stored)
    time = of.edges[500] + 0.3 * (of.edges[501] - of.edges[500])
    n1 = legendre.legval(-0.4, stored[0, 500])
    assert of.axes[0] @ of.at(np.array([time]))[0][:, 0] == pytest.approx(n1, rel=1e-9, abs=0)


#: Eccentricities every 100 kyr: kyr; La2010a, La2010d, La2004 of the Earth; La2004 of Mars.
ECCENTRICITIES = Path(__file__).parent.parent / "data" / "eccentricities-excerpt.txt"


@pytest.mark.parametrize(
    ("column", "name"), [(1, "earth"), (2, "earth"), (3, "earth"), (4, "mars")]
)
def test_half_widths_of_eccentricities_contain_the_solutions_of_others(
    column: int, name: str
) -> None:
    rows = np.loadtxt(ECCENTRICITIES)
    times, theirs = rows[:, 0] * KYR, rows[:, column]
    apart = np.abs(np.linalg.norm(table(name).at(times)[1], axis=0) - theirs)
    half_width = table(name).error(times)[1]
    for first, last in ((0, 5000), (5000, 10_001)):
        at = (-rows[:, 0] >= first) & (-rows[:, 0] < last)
        assert np.mean(apart[at] <= half_width[at]) >= 0.9
        # not wider than they have to be: 1.96 standard deviations would be a ratio of 0.51
        assert np.sqrt(np.mean((apart[at] / half_width[at]) ** 2)) > 0.3


def test_half_widths_of_a_table_that_is_read_do_not_grow(tmp_path: Path) -> None:
    """An orbit that is given is taken at its word; one of ours that was written keeps its own."""
    times = np.arange(-9000.0, 1.0, 1.0) * KYR
    normal, eccentricity, _ = table("earth").at(times)
    given_ = fitted("earth", times, normal.T, eccentricity.T, table("earth").axes, "test")
    assert given_.error(np.array([-8e6 * JULIAN_YEAR]))[1] < 1e-5
    table("earth").to_file(tmp_path / "own.npz")
    assert np.array_equal(load(tmp_path / "own.npz").errors, table("earth").errors)


def test_arrays_of_a_table_are_read_only() -> None:
    """Answers are stored by the hash of a table, which a changed array does not change."""
    earth = table("earth")
    for name in ("edges", "coefficients", "axes", "errors"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(earth, name)[...] = 0

"""Observed celestial pole offsets as answers, and the models beside the observed pole."""

import numpy as np
import pytest
import xarray as xr
from astropy.utils.iers import IERS_B

import earthspin
from earthspin import SceneError
from earthspin.constants import MAS
from earthspin.nutation import core_nutation
from earthspin.sky.eop import read_pole_offsets


@pytest.fixture(scope="module")
def tree() -> xr.DataTree:
    return earthspin.run_tree("pole-offsets", sections=["core_nutation", "period"])


def test_the_answer_in_mas_with_95_percent() -> None:
    offsets = earthspin.pole_offsets(file="finals", span=("2000-05-20", "2000-06-20"))
    assert offsets.time.size == 32
    first = offsets.isel(time=0)
    # the row of MJD 51684: -0.211 0.213 -0.118 0.146
    assert float(first.dX) == pytest.approx(-0.211, abs=1e-12)
    assert float(first.dX_error) == pytest.approx(1.96 * 0.213, rel=1e-4, abs=0)
    assert float(first.dY) == pytest.approx(-0.118, abs=1e-12)
    assert float(first.dY_error) == pytest.approx(1.96 * 0.146, rel=1e-4, abs=0)


#: Amplitudes of windows about the middle of a year with their half-widths, uas, by an independent
#: fit that took the noise for autoregressive.
AMPLITUDES = {
    1990: (145, 33), 1998: (73, 19), 2006: (173, 20), 2012: (265, 22), 2018: (218, 22),
    2020: (107, 20), 2022: (25, 26), 2024: (24, 21),
}  # fmt: skip


@pytest.mark.parametrize("year", AMPLITUDES)
def test_amplitudes_by_window(tree: xr.DataTree, year: int) -> None:
    fit = tree["core_nutation"].to_dataset()
    window = fit.sel(middle=f"{year}-07-02", method="nearest")
    size, error = AMPLITUDES[year]
    assert float(window.core_nutation_amplitude) == pytest.approx(size, abs=3)
    assert 0.6 * error < float(window.core_nutation_amplitude_error) < 1.6 * error
    assert bool(window.detected) == (year < 2022)


def test_it_is_not_seen_since_2022(tree: xr.DataTree) -> None:
    fit = tree["core_nutation"].to_dataset().sel(middle=slice("2022-06-01", None))
    assert fit.middle.size > 30
    assert not fit.detected.any()
    assert (fit.core_nutation_amplitude < fit.detection_limit).all()


def test_the_period_with_an_honest_error(tree: xr.DataTree) -> None:
    """Random excitation limits it: the published one is a hundred times better, and inside."""
    fit = tree["period"].to_dataset()
    period, error = float(fit.core_nutation_period), float(fit.core_nutation_period_error)
    assert abs(period + 430.0) < error
    # phases that a walk changes as observed tell a period to 13 d in 42 years, not to tenths
    assert 5 < error < 25


@pytest.mark.slow
def test_the_period_of_simulated_series() -> None:
    """Six series of known period, all inside intervals of 95 %, or five."""
    from earthspin.wobble.observed import fit
    from tests.nutation.simulated_offsets import excited

    inside = 0
    for seed in range(6):
        days, eta = excited(seed)
        mode = fit(days, np.conj(eta), "likelihood")
        inside += int(abs(-mode.period - core_nutation.PERIOD) <= mode.period_error)
    assert inside >= 5


@pytest.fixture(scope="module")
def sizes() -> xr.Dataset:
    scene = earthspin.load_scene("iau", {"span": ["1990-01-01", "2025-12-31"]})
    return earthspin.run_tree(scene, sections=["observed"])["observed"].to_dataset()


def test_iau_against_the_sky_by_astropy_and_numpy(sizes: xr.Dataset) -> None:
    """The rms of the daily offsets themselves, a line removed by numpy: 2,630 of 13,149 days."""
    table = IERS_B.open()
    mjd = table["MJD"].value
    inside = (mjd >= 47892) & (mjd <= 61040)
    for direction, column in (("dpsi_sineps", "dX_2000A"), ("deps", "dY_2000A")):
        offset = table[column].to_value("mas")[inside]
        line = np.polyval(np.polyfit(mjd[inside] - 54000, offset, 1), mjd[inside] - 54000)
        row = sizes.sel(model="iau", direction=direction)
        assert float(row.observed_rms) == pytest.approx(np.std(offset - line), rel=0.02, abs=0)
        plain = np.sqrt(np.mean(offset**2))
        assert float(row.observed_rms_unfitted) == pytest.approx(plain, rel=0.02, abs=0)


def test_the_fitted_response_is_as_near_to_the_sky(sizes: xr.Dataset) -> None:
    rms = sizes.observed_rms
    assert abs(rms.sel(model="nonrigid") - rms.sel(model="iau")).max() < 0.003
    assert (rms.sel(model="predicted") < 0.65).all()
    assert (rms.sel(model="rigid") > 20).all()


def test_the_core_nutation_is_part_of_what_is_left(sizes: xr.Dataset) -> None:
    for model in ("iau", "nonrigid", "predicted"):
        row = sizes.sel(model=model)
        assert (row.observed_rms_without_core < row.observed_rms).all()
    # what windows of three years take away is the variance of the core nutation itself
    table = read_pole_offsets()
    time = table.mjd - 51544.5
    core = core_nutation.fit(time, table.offsets / MAS).at(time[(time > -3652) & (time < 9496)])
    iau = sizes.sel(model="iau")
    taken = iau.observed_rms**2 - iau.observed_rms_without_core**2
    assert taken.values == pytest.approx([np.var(core.real), np.var(core.imag)], rel=0.15, abs=0)


@pytest.mark.parametrize(
    "span",
    [("1960-01-01", "1970-01-01"), ("1989-12-01", "1990-01-20"), ("2030-01-01", "2040-01-01")],
)
def test_spans_without_observations(span: tuple[str, str]) -> None:
    scene = earthspin.load_scene("iau", {"span": list(span)})
    with pytest.raises(SceneError, match="10 dates"):
        earthspin.plan(scene, sections=["observed"])
    assert "fewer than 10 dates" in str(earthspin.plan(scene, sections="all"))

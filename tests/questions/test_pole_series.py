"""The pole by region: stretches of a series that are the series, with errors of the whole."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin import EARTH, SUN, SceneError
from earthspin.engine.question import Block, Question
from earthspin.engine.run import Run
from earthspin.motion.effects import EFFECTS
from earthspin.scenes import load_scene, run, series_length, write_series
from tests.blocks import run_blocks

YEAR = {"span": ["2000-01-01", "2001-01-01"], "step": "4 min"}


def _stretches(scene: Question, blocks: list[Block]) -> Iterator[xr.Dataset]:
    shared = Run(scene, block=blocks[0])
    return (shared.again(block=block).answer() for block in blocks)


def test_stretches_are_the_series() -> None:
    """Directions, angles, errors: to the last bit or two; the path behind them is one."""
    scene = load_scene("pole", YEAR)
    blocks, whole = list(run_blocks(scene)), run(scene)
    assert series_length(scene) == 131_761 == whole.sizes["time"]
    assert len(blocks) == 2
    for name, variable in whole.data_vars.items():
        joined = np.concatenate([block[name].values for block in blocks])
        np.testing.assert_allclose(joined, variable.values, rtol=4e-16, atol=1e-18)
    np.testing.assert_array_equal(np.concatenate([b.time for b in blocks]), whole.time)


def test_a_pole_series_is_written_and_read(tmp_path: Path) -> None:
    path = write_series(load_scene("pole", YEAR), tmp_path / "pole.zarr")
    stored = earthspin.open(path)
    assert stored.X.dims == ("time", "axis")
    some = earthspin.pole(times=stored.time.values[[0, 70_000, 131_072, 131_760]])
    for name in ("X", "Y", "Z", "psi", "eps"):
        np.testing.assert_allclose(
            stored[name].isel(time=[0, 70_000, 131_072, 131_760]), some[name], rtol=0, atol=1e-9
        )


def test_psi_goes_on_through_whole_turns_from_stretch_to_stretch() -> None:
    """Under ten Suns once round in 70 years: a stretch alone would begin anew at 180 deg."""
    flat = EARTH.replace(dynamical_flattening=0.45, j2=0.15, triaxiality=0.0)
    heavy = SUN.replace(gm=10 * SUN.gm)
    years = {"span": ["1905-01-01", "2050-01-01"], "step": "100 d", "effects": ["second-order"]}
    scene = load_scene("pole", years).replace(body=flat, perturbers=(heavy,))
    whole = run(scene)
    assert float(np.ptp(whole.psi.values)) > 1.5 * 360 * 3600
    assert float(abs(whole.psi.diff("time")).max()) < 5 * 3600
    assert float(abs(whole.psi[0]).max()) <= 180 * 3600
    np.testing.assert_allclose(
        whole.psi, np.unwrap(whole.psi.values, axis=0, period=360 * 3600), rtol=1e-14, atol=0
    )
    again = _stretches(scene, [Block(0, 200), Block(200, whole.sizes["time"])])
    joined = np.concatenate([block.psi for block in again])
    np.testing.assert_allclose(joined, whole.psi, rtol=1e-14, atol=0)


def test_errors_are_those_of_the_whole_series() -> None:
    """The error of positions depends on the farthest time of the whole series."""
    scene = load_scene("pole", {"span": ["1950-01-01", "2040-01-01"]})
    whole = run(scene)
    half = whole.sizes["time"] // 2
    near, far = _stretches(scene, [Block(0, half), Block(half, whole.sizes["time"])])
    for block, stretch in ((near, slice(0, half)), (far, slice(half, None))):
        np.testing.assert_allclose(
            block.direction_error, whole.direction_error[stretch], rtol=1e-14, atol=0
        )


def test_what_does_not_fit_into_memory_is_told_how_to_be_written() -> None:
    with pytest.raises(SceneError, match=r"write_series\(scene, 'pole.zarr'\)"):
        earthspin.pole("2000-01-01", "2050-01-01", "1 s")


def test_all_effects_by_one_word() -> None:
    names = list(EFFECTS)
    few = {"span": ["2000-01-01", "2000-02-01"], "step": "10 d"}
    listed, all_of_them = (
        earthspin.run(earthspin.load_scene("pole", few | {"effects": effects}))
        for effects in (names, "all")
    )
    xr.testing.assert_identical(listed, all_of_them)
    with pytest.raises(SceneError, match="effects"):
        earthspin.rotation("2000-01-01", "2000-01-02", "1 d", effects="all")

"""The scene of an answer stays with its own data alone."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin import SceneError


@pytest.fixture(scope="module")
def winter() -> xr.Dataset:
    return earthspin.torque_series("2026-01-01", "2026-04-01", "6 h")


@pytest.fixture(scope="module")
def spring() -> xr.Dataset:
    return earthspin.torque_series("2026-04-01T06:00", "2026-07-01", "6 h")


def joined(first: xr.Dataset, second: xr.Dataset) -> xr.Dataset:
    plain = {"data_vars": "minimal", "coords": "minimal", "compat": "override"}
    return xr.concat([first, second], "time", combine_attrs="override", **plain)


OTHERS: dict[str, Callable[[xr.Dataset], xr.Dataset]] = {
    "means of days": lambda data: data.resample(time="1D").mean(keep_attrs=True),
    "half": lambda data: data.isel(time=slice(None, None, 2)),
    "reversed": lambda data: data.isel(time=slice(None, None, -1)),
    "one body": lambda data: data.sel(perturber="sun"),
    "mean": lambda data: data.mean("time", keep_attrs=True),
    "in other units": lambda data: data.map(lambda array: array * 1000, keep_attrs=True),
    "other numbers": lambda data: data.assign(torque=data.torque.copy(data=data.torque + 1e22)),
}


@pytest.mark.parametrize("ending", [".nc", ".zarr"])
@pytest.mark.parametrize("name", OTHERS)
def test_other_data_lose_the_scene(
    name: str, ending: str, winter: xr.Dataset, tmp_path: Path
) -> None:
    data = OTHERS[name](winter)
    assert "scene" in data.attrs  # xarray keeps it
    for call in (earthspin.run, earthspin.plan, lambda data: data.earthspin.scene):
        with pytest.raises(SceneError, match="the scene makes"):
            call(data)
    path = earthspin.verify(earthspin.write(data, tmp_path / f"data{ending}"))
    stored = earthspin.open(path)
    assert "scene" not in stored.attrs
    assert stored.attrs["history"] == winter.attrs["history"]
    assert stored.torque.attrs["units"] == "N m"
    xr.testing.assert_equal(stored, data)
    with pytest.raises(SceneError, match="it has no scene"):
        earthspin.run(path)


def test_joined_answers_are_not_the_answer_to_the_first(
    winter: xr.Dataset, spring: xr.Dataset, tmp_path: Path
) -> None:
    both = joined(winter, spring)
    assert both.sizes["time"] == 725
    with pytest.raises(SceneError, match="361 labels along 'time', the data have 725"):
        earthspin.run(both)
    winter.to_zarr(tmp_path / "both.zarr", zarr_format=2)
    assert earthspin.run(tmp_path / "both.zarr").sizes["time"] == 361
    spring.to_zarr(tmp_path / "both.zarr", append_dim="time")
    assert "scene" not in earthspin.open(tmp_path / "both.zarr").attrs
    with pytest.raises(SceneError, match="364 labels along 'time', the data have 725"):
        earthspin.run(xr.open_zarr(tmp_path / "both.zarr"))


@pytest.mark.parametrize("ending", [".nc", ".zarr"])
def test_whole_answers_keep_the_scene(winter: xr.Dataset, ending: str, tmp_path: Path) -> None:
    path = earthspin.write(winter, tmp_path / f"whole{ending}")
    opened = xr.open_dataset(path) if ending == ".nc" else xr.open_zarr(path)
    for data in (winter, winter.transpose(), winter.copy(deep=True), path, opened):
        xr.testing.assert_identical(earthspin.run(data), winter)


def test_series_in_blocks_and_ensembles_know_their_labels(tmp_path: Path) -> None:
    scene = earthspin.load_scene("torque", {"span": ["2000-01-01", "2000-03-01"], "step": "1 h"})
    series = earthspin.open(earthspin.write_series(scene, tmp_path / "series.zarr"))
    assert earthspin.run(series).sizes == series.sizes
    with pytest.raises(SceneError, match="1441 labels along 'time', the data have 10"):
        earthspin.run(series.isel(time=slice(10)))
    members = earthspin.ensemble("precession", 20)
    xr.testing.assert_identical(earthspin.run(members), members)
    for part in (members.isel(member=slice(5)), members.earthspin.quantiles()):
        with pytest.raises(SceneError, match="20 labels along 'member'"):
            earthspin.run(part)


def test_only_files_state_a_convention(winter: xr.Dataset, tmp_path: Path) -> None:
    """UDUNITS has neither deg nor mas, and its yr is the tropical year of 365.242198781 d."""
    past = earthspin.long_term("-2 kyr", "0 kyr", "1 kyr")
    assert "Conventions" not in past.attrs
    past.to_netcdf(tmp_path / "plain.nc")
    plain = xr.load_dataset(tmp_path / "plain.nc")
    assert "Conventions" not in plain.attrs
    assert plain.precession_period.units == "yr"
    for ending in (".nc", ".zarr"):
        path = earthspin.write(past, tmp_path / f"own{ending}")
        own = xr.open_dataset(path, engine="netcdf4" if ending == ".nc" else "zarr")
        assert own.Conventions == "CF-1.11"
        assert own.precession_period.units == "365.25 d"
        assert own.obliquity.units == "degree"
        xr.testing.assert_identical(earthspin.open(path), past)


def test_a_file_opened_by_xarray_is_read_in_every_method(tmp_path: Path) -> None:
    past = earthspin.long_term("-20 kyr", "0 kyr", "1 kyr")
    own = xr.load_dataset(earthspin.write(past, tmp_path / "past.nc"))
    assert len(own.earthspin.plot()) == 4
    written = own.earthspin.to_csv(tmp_path / "own.csv").read_text()
    assert written == past.earthspin.to_csv(tmp_path / "past.csv").read_text()
    sunlight = [earthspin.daily_insolation(data, "65N", "90 deg") for data in (own, past)]
    np.testing.assert_array_equal(*(answer.insolation for answer in sunlight))
    offsets = earthspin.pole_offsets(span=("2000-01-01", "2020-01-01"))
    given = xr.load_dataset(earthspin.write(offsets, tmp_path / "offsets.nc"))
    again = earthspin.pole_offsets(file=given)
    np.testing.assert_allclose(again.dX, offsets.dX, rtol=0, atol=1e-14)

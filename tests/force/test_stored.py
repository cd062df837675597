"""Stored results that were damaged: nothing is read that is not what was written."""

import gc
import os
import shutil
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Literal

import netCDF4
import numcodecs
import numpy as np
import pytest
import xarray as xr
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import earthspin
from earthspin import OutputError, scenes
from earthspin.engine import store
from tests import shipped
from tests.engine.work import bytes_of

SEED = 20261121
DATA = Path(__file__).parents[1] / "data"
#: An answer with sections, words and dates, and a plain series.
SCENES = ("precession", "torque")


def small_series() -> xr.Dataset:
    scene = earthspin.load_scene("torque")
    return earthspin.run(scene.replace(span=("2000-01-01", "2000-03-01")))


def same(one: xr.Dataset | xr.DataTree, other: xr.Dataset | xr.DataTree) -> bool:
    return type(one) is type(other) and one.identical(other)


@contextmanager
def flipped(path: Path, place: int) -> Iterator[None]:
    """A file with one of its bits the other way."""
    with path.open("r+b", buffering=0) as file:

        def flip() -> None:
            file.seek(place // 8)
            (byte,) = file.read(1)
            file.seek(place // 8)
            file.write(bytes([byte ^ 1 << place % 8]))

        flip()
        yield
        flip()


def read_or_refused(path: Path, answer: xr.Dataset | xr.DataTree) -> bool:
    """Return True if a damaged file is refused; if it is read, nothing may differ."""
    try:
        back = store.open(path)
    except OutputError:
        return True
    assert same(back, answer)
    return False


@pytest.mark.slow
def test_no_flipped_bit_of_the_numbers_or_attributes_of_a_netcdf_file_is_read(
    tmp_path: Path,
) -> None:
    """Of an answer with sections, words and dates: each found by reading the file."""
    answer = shipped.tree("precession")
    path = store.write(answer, tmp_path / "r.nc")
    content = path.read_bytes()
    rate, obliquity = (answer[name].values.tobytes() for name in ("precession_rate", "obliquity"))
    places = [content.index(word) for word in (rate, obliquity, b"arcsec s-1", b"dynamical_flat")]
    for bit in (bit for place in places for bit in range(8 * place, 8 * place + 64, 7)):
        with flipped(path, bit):
            assert read_or_refused(path, answer)
            with pytest.raises(OutputError):
                earthspin.verify(path)
    assert same(store.open(path), answer)


def test_a_netcdf_file_that_was_cut_short_is_refused(tmp_path: Path) -> None:
    path = store.write(small_series(), tmp_path / "r.nc")
    whole = path.read_bytes()
    rng = np.random.default_rng(SEED)
    for size in (0, 1, *rng.integers(0, len(whole), 20).tolist(), len(whole) - 1):
        path.write_bytes(whole[:size])
        with pytest.raises(OutputError, match="cannot be read"):
            store.open(path)


def test_a_file_that_another_program_opened_for_writing_keeps_its_checksum(tmp_path: Path) -> None:
    answer = small_series()
    path = store.write(answer, tmp_path / "r.nc")
    with netCDF4.Dataset(path, "a"):
        pass
    assert same(store.open(path), answer)
    assert earthspin.verify(path) == path


def test_xarray_and_zarr_open_a_store_without_a_warning(tmp_path: Path) -> None:
    """In all ways that read a group, and with all numbers."""
    import zarr

    answer = shipped.tree("precession")
    path = store.write(answer, tmp_path / "r.zarr")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with xr.open_zarr(path) as raw:
            assert np.array_equal(raw.load().obliquity, answer.obliquity)
        with xr.open_zarr(path, group="seasons") as raw:
            raw.load()
        with xr.open_datatree(path, engine="zarr") as tree:
            assert set(tree.children) == set(answer.children)
        assert zarr.open_group(path, mode="r")["obliquity"][()] == answer.obliquity


@pytest.mark.parametrize("rows", [30, 90])
def test_a_whole_chunk_of_another_size_is_refused(tmp_path: Path, rows: int) -> None:
    path = store.write(small_series(), tmp_path / "r.zarr")  # 241 rows
    chunk = path / "torque_magnitude" / "0.0"
    codec = numcodecs.Zstd(level=0, checksum=True)
    chunk.write_bytes(codec.encode(np.zeros((rows, 2))))
    for read in (lambda p: store.open(p).load(), earthspin.verify):
        with pytest.raises(OutputError, match="do not match the stored checksum"):
            read(path)


def test_a_number_that_another_program_changed_is_noticed(tmp_path: Path) -> None:
    path = store.write(small_series(), tmp_path / "r.nc")
    with netCDF4.Dataset(path, "a") as raw:
        raw["torque"][0] *= 2
    for read in (store.open, earthspin.verify):
        with pytest.raises(OutputError, match="checksum"):
            read(path)


# --- files of earlier versions --------------------------------------------------------------------


# The libraries may be newer or older than those that wrote the file, which the answer says.
@pytest.mark.filterwarnings("ignore:made with:earthspin.VersionWarning")
def test_a_file_of_an_earlier_version_opens_and_runs() -> None:
    """Its scene has `uncertainty = "linear"`, a key of that version."""
    path = DATA / "format2.nc"
    assert earthspin.verify(path) == path
    answer = store.open(path).load()
    assert 'uncertainty = "linear"' in answer.attrs["scene"]
    assert answer.earthspin.to_frame().shape[0] == 3
    again = earthspin.run(path)
    assert set(again.variables) == set(answer.variables)
    for name, values in again.data_vars.items():
        assert values.attrs == answer[name].attrs
        if values.dtype.kind == "f":
            # other processors round differently; errors are differences of nearby numbers
            np.testing.assert_allclose(values, answer[name], rtol=1e-6, atol=0, err_msg=str(name))
    scene = answer.attrs["scene"].replace('"linear"', '"sample"\nn = 1000', 1)
    sampled = answer.assign_attrs(scene=scene, sampled="1000 members in body.gm")
    with pytest.warns(earthspin.VersionWarning, match="made with .*sampled 1000 members"):
        xr.testing.assert_identical(earthspin.run(sampled), again)


@pytest.mark.parametrize("kind", ["nc", "zarr"])
def test_files_in_the_first_format_open_and_are_not_verified(tmp_path: Path, kind: str) -> None:
    path = DATA / f"format1.{kind}"
    answer = store.open(path)
    assert isinstance(answer, xr.Dataset)
    # The Moon's torque on the Earth is at most 2.2e22 N m.
    assert answer.torque.shape == (9, 2, 3)
    assert np.all(np.abs(answer.torque) < 2.5e22)
    assert answer.identical(store.open(DATA / "format1.nc"))
    with pytest.raises(OutputError, match="format 1"):
        earthspin.verify(path)
    again = store.write(answer, tmp_path / f"r.{kind}")
    assert earthspin.verify(again) == again
    assert same(store.open(again).load(), answer)


def test_a_killed_run_in_the_first_format_is_refused_and_left_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(scenes, "BLOCK", 3)
    scene = earthspin.load_scene("torque").replace(span=("2000-01-01", "2000-01-03"), step="6 h")
    shutil.copytree(DATA / "format1-killed.zarr.partial", tmp_path / "r.zarr.partial")
    before = bytes_of(tmp_path)
    with pytest.raises(OutputError, match="format of files"):
        earthspin.write_series(scene, tmp_path / "r.zarr")
    assert bytes_of(tmp_path) == before
    shutil.rmtree(tmp_path / "r.zarr.partial")
    path = earthspin.write_series(scene, tmp_path / "r.zarr")
    back, whole = earthspin.open(path), earthspin.run(scene)
    assert back.identical(whole)


@pytest.mark.parametrize("kind", ["nc", "zarr"])
def test_a_file_in_a_format_of_the_future_is_refused(tmp_path: Path, kind: str) -> None:
    answer = small_series().assign_attrs(earthspin_format=3)
    path = tmp_path / f"r.{kind}"
    if kind == "nc":
        answer.to_netcdf(path)
    else:
        answer.to_zarr(path, zarr_format=2)
    for read in (store.open, earthspin.verify):
        with pytest.raises(OutputError, match=r"format is 3.*update earthspin"):
            read(path)


# --- damaged, changed, and of others --------------------------------------------------------------


def test_a_pipe_is_refused(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "r.nc")
    with pytest.raises(OutputError, match="it is a pipe"):
        store.open(tmp_path / "r.nc")


def test_no_flipped_bit_of_a_zarr_store_passes_verify(tmp_path: Path) -> None:
    """Bits of chunks, and of metadata; a few change nothing, such as one of the level of zstd."""
    answer = small_series()
    path = store.write(answer, tmp_path / "r.zarr")
    files = sorted(p for p in path.rglob("*") if p.is_file())
    rng = np.random.default_rng(SEED)
    noticed = 0
    for number in range(3 * len(files)):
        file = files[number // 3]
        with flipped(file, int(rng.integers(0, 8 * file.stat().st_size))):
            try:
                earthspin.verify(path)
            except OutputError:
                noticed += 1
            else:
                assert same(store.open(path).load(), answer), file
    assert noticed > 2.9 * len(files)
    earthspin.verify(path)


def test_a_damaged_chunk_is_found_by_reading(tmp_path: Path) -> None:
    path = store.write(small_series(), tmp_path / "r.zarr")
    chunk = path / "torque" / "0.0.0"
    with flipped(chunk, 4 * chunk.stat().st_size):
        with pytest.raises(OutputError, match="its numbers or words"):
            store.open(path).load()
        with pytest.raises(RuntimeError, match="Zstd decompression error"):
            xr.open_zarr(path).load()
    chunk.write_bytes(chunk.read_bytes()[:-7])
    with pytest.raises(OutputError, match="its numbers or words"):
        store.open(path).load()


def test_a_whole_chunk_in_the_place_of_another_does_not_pass_verify(tmp_path: Path) -> None:
    path = store.write(shipped.answer("precession"), tmp_path / "r.zarr")
    rate = path / "precession_rate" / "0"
    written = rate.read_bytes()
    shutil.copy(path / "precession_period" / "0", rate)
    with pytest.raises(OutputError, match="its numbers or words"):
        earthspin.verify(path)
    rate.write_bytes(written)
    earthspin.verify(path)


@pytest.mark.parametrize("name", [".zattrs", ".zgroup", ".zmetadata", "torque/.zarray"])
def test_a_store_without_some_of_its_metadata_is_refused(tmp_path: Path, name: str) -> None:
    path = store.write(small_series(), tmp_path / "r.zarr")
    (path / name).unlink()
    for read in (store.open, earthspin.verify):
        with pytest.raises(OutputError, match="names, sizes"):
            read(path)


def test_a_chunk_that_is_gone_is_missed(tmp_path: Path) -> None:
    for name in ("torque/0.0.0", "time/0"):
        path = store.write(small_series(), tmp_path / "r.zarr")
        (path / name).unlink()
        with pytest.raises(OutputError, match=f"'{name}'"):
            earthspin.verify(path)
        with pytest.raises(OutputError, match=f"'{name}'"):
            store.open(path).load()


def test_other_readers_see_no_number_in_a_missing_chunk(tmp_path: Path) -> None:
    path = store.write(small_series(), tmp_path / "r.zarr")
    (path / "torque" / "0.0.0").unlink()
    (path / "time" / "0").unlink()
    with xr.open_dataset(path, engine="zarr", consolidated=False) as raw:
        assert np.isnan(raw.torque).all()
        assert np.isnat(raw.time).all()


@pytest.mark.parametrize("kind", ["nc", "zarr"])
def test_verify_accepts_what_was_written(tmp_path: Path, kind: str) -> None:
    for scene in ("precession", "polar-motion", "sleeping-top", "torque"):
        path = store.write(shipped.tree(scene), tmp_path / f"{scene}.{kind}")
        assert earthspin.verify(path) == path


def test_a_series_in_blocks_carries_checksums(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(scenes, "BLOCK", 100)
    scene = earthspin.load_scene("torque").replace(span=("2000-01-01", "2000-03-01"))
    path = earthspin.write_series(scene, tmp_path / "blocks.zarr")
    assert earthspin.verify(path) == path
    back, whole = earthspin.open(path), earthspin.run(scene)
    assert back.identical(whole)
    (path / "torque" / "2.0.0").unlink()
    with pytest.raises(OutputError, match=r"'torque/2\.0\.0' is missing"):
        earthspin.verify(path)


@pytest.mark.parametrize("kind", ["nc", "zarr"])
def test_an_attribute_that_was_changed_is_noticed(tmp_path: Path, kind: str) -> None:
    path = store.write(small_series(), tmp_path / f"r.{kind}")
    if kind == "nc":
        with netCDF4.Dataset(path, "a") as raw:
            raw["torque"].units = "kg"
    else:
        import zarr

        zarr.open_group(path, mode="r+")["torque"].attrs["units"] = "kg"
    for read in (store.open, earthspin.verify):
        with pytest.raises(OutputError, match=r"attributes .*xarray.open_dataset"):
            read(path)


@pytest.mark.parametrize("kind", ["nc", "zarr"])
def test_a_file_of_others_is_read_but_not_verified(tmp_path: Path, kind: str) -> None:
    answer, path = small_series(), tmp_path / f"plain.{kind}"
    if kind == "nc":
        answer.to_netcdf(path)
    else:
        answer.to_zarr(path, zarr_format=2)
    assert same(store.open(path).load(), answer)
    with pytest.raises(OutputError, match="has no checksum"):
        earthspin.verify(path)


@pytest.mark.parametrize("version", [2, 3])
def test_damage_of_several_arrays_is_one_line(
    tmp_path: Path, version: Literal[2, 3], caplog: pytest.LogCaptureFixture
) -> None:
    """Of a store of others, whose arrays Zarr opens at the same time."""
    path = tmp_path / "r.zarr"
    answer = xr.Dataset({name: ("n", [1.0]) for name in "abc"})
    answer.to_zarr(path, zarr_format=version, consolidated=False)
    for file in (*path.rglob(".zarray"), *path.glob("?/zarr.json")):
        file.write_bytes(file.read_bytes()[:-9])
    with pytest.raises(OutputError, match="it cannot be read"):
        store.open(path)
    gc.collect()  # a task is told of when it is deleted
    assert not caplog.records


def test_what_was_read_carries_no_checksum(tmp_path: Path) -> None:
    """A part of it, written by other means, would otherwise carry a wrong one."""
    answer = small_series()
    back = store.open(store.write(answer, tmp_path / "r.nc"))
    assert back.attrs == answer.attrs


def test_a_store_that_is_replaced_while_it_is_read_says_so(tmp_path: Path) -> None:
    path = store.write(small_series(), tmp_path / "r.zarr")
    lazy = store.open(path)
    store.write(small_series(), path)
    with pytest.raises(OutputError, match=r"replaced.*open it again"):
        lazy["torque"].load()
    shutil.rmtree(path)
    with pytest.raises(OutputError, match="replaced"):
        lazy["declination"].load()


ARRAYS = st.one_of(
    hnp.arrays(np.float64, 3, elements=st.floats(allow_nan=False)),
    hnp.arrays(np.int64, 3),
    hnp.arrays(np.bool_, 3),
    st.lists(
        st.text(st.characters(exclude_characters="\0", exclude_categories=["Cs"]), max_size=5),
        min_size=3,
        max_size=3,
    ).map(lambda words: np.array(words, dtype="U5")),
    hnp.arrays(
        "M8[us]", 3, elements=st.integers(-(10**16), 10**16).map(lambda n: np.datetime64(n, "us"))
    ),
)
ATTRIBUTES = st.dictionaries(
    st.sampled_from(["note", "number", "list"]),
    st.one_of(
        st.text(st.characters(exclude_characters="\0", exclude_categories=["Cs"]), max_size=9),
        st.integers(-(2**40), 2**40),
        st.floats(allow_nan=False, allow_infinity=False),
        st.lists(st.floats(-1e9, 1e9), min_size=1, max_size=4),
    ),
)


@pytest.mark.parametrize("kind", ["nc", "zarr"])
@settings(max_examples=30)
@given(values=ARRAYS, attrs=ATTRIBUTES)
def test_nothing_sound_is_refused(
    tmp_path_factory: pytest.TempPathFactory, kind: str, values: np.ndarray, attrs: dict
) -> None:
    """Whatever is written is read back under its checksum, in both formats."""
    result = xr.Dataset({"x": ("n", values, attrs)}, attrs=attrs)
    path = store.write(result, tmp_path_factory.mktemp("r") / f"r.{kind}")
    back = store.open(path)
    assert earthspin.verify(path) == path
    assert np.array_equal(back["x"].values, values)

"""Stored results that were damaged: nothing is read that is not what was written."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import xarray as xr
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import earthspin
from earthspin import OutputError, scenes
from earthspin.engine import checksums, store
from tests import shipped

SEED = 20261121
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


def refused(path: Path) -> bool:
    try:
        store.open(path)
    except OutputError as error:
        return "its bytes are not what was written" in str(error)
    return False


def test_every_bit_of_a_netcdf_file_counts(tmp_path: Path) -> None:
    """Each of a short file: HDF5, which some keep busy without end, sees a file with none."""
    answer = xr.Dataset({"x": ("n", np.arange(3.0), {"units": "m"})}, attrs={"title": "short"})
    path = store.write(answer, tmp_path / "r.nc")
    passed = []
    for place in range(8 * path.stat().st_size):
        with flipped(path, place):
            if checksums.line_holds(path) is not False:
                passed.append(place)
    assert passed == []
    assert same(store.open(path), answer)


def refused_with(path: Path, place: int) -> bool:
    with flipped(path, place):
        return refused(path)


def test_no_flipped_bit_of_a_netcdf_file_is_read(tmp_path: Path) -> None:
    """Of answers with sections, words and dates: 1,000 bits anywhere, 534 at the end."""
    rng = np.random.default_rng(SEED)
    for answer in (shipped.tree("precession"), small_series()):
        path = store.write(answer, tmp_path / "r.nc")
        bits = 8 * path.stat().st_size
        places = [*rng.integers(0, bits, 1000).tolist(), *range(bits - 1600, bits, 3)]
        assert [place for place in places if not refused_with(path, place)] == []
        assert same(store.open(path), answer)


def test_a_netcdf_file_that_was_cut_short_is_refused_or_whole(tmp_path: Path) -> None:
    """Cut within its last line, it holds all that was written."""
    answer = small_series()
    path = store.write(answer, tmp_path / "r.nc")
    whole = path.read_bytes()
    rng = np.random.default_rng(SEED)
    inside = len(whole) - checksums.LENGTH
    for size in (0, 1, *rng.integers(0, inside, 20).tolist(), inside - 1):
        path.write_bytes(whole[:size])
        with pytest.raises(OutputError, match="cannot be read"):
            store.open(path)
    for size in range(inside, len(whole), 7):
        path.write_bytes(whole[:size])
        assert refused(path) or same(store.open(path), answer)


def test_many_bytes_damaged_at_the_end_are_not_taken_for_another_program(tmp_path: Path) -> None:
    path = store.write(small_series(), tmp_path / "r.nc")
    whole = path.read_bytes()
    for damage in (b"\0" * 64, b"\xff" * 75):
        path.write_bytes(whole[: -len(damage)] + damage)
        assert refused(path)


def test_the_last_line_is_the_checksum_of_what_stands_before_it(tmp_path: Path) -> None:
    """By hand: ``head -c -110 r.nc | sha256sum; tail -n 1 r.nc``."""
    path = store.write(shipped.tree("precession"), tmp_path / "r.nc")
    whole = path.read_bytes()
    assert checksums.LENGTH == 110
    line = f"\nearthspin: SHA-256 of all before this line: {sha256(whole[:-110]).hexdigest()}\n"
    assert whole[-110:] == line.encode()


def test_a_file_that_another_program_changed_has_no_last_line(tmp_path: Path) -> None:
    """HDF5 cuts off what it did not write; the checksums inside stay, and hold."""
    answer = small_series()
    path = store.write(answer, tmp_path / "r.nc")
    with netCDF4.Dataset(path, "a"):
        pass
    assert b"SHA-256 of all" not in path.read_bytes()
    assert same(store.open(path), answer)
    assert earthspin.verify(path) == path


def test_the_ledger_of_a_zarr_store_is_what_sha256sum_reads(tmp_path: Path) -> None:
    path = store.write(shipped.tree("precession"), tmp_path / "r.zarr")
    (ledger,) = path.rglob(checksums.LEDGER)
    rows = [line.split("  ", 1) for line in ledger.read_text().splitlines()]
    files = {str(p.relative_to(path)) for p in path.rglob("*") if p.is_file() and p != ledger}
    assert {name for _, name in rows} == files
    assert all(sha256((path / name).read_bytes()).hexdigest() == digest for digest, name in rows)
    with xr.open_dataset(path, engine="zarr", consolidated=False) as raw:  # without a warning
        assert checksums.LEDGER not in raw.variables


def test_a_number_that_another_program_changed_is_noticed(tmp_path: Path) -> None:
    path = store.write(small_series(), tmp_path / "r.nc")
    with netCDF4.Dataset(path, "a") as raw:
        raw["torque"][0] *= 2
    for read in (store.open, earthspin.verify):
        with pytest.raises(OutputError, match="are not what was written"):
            read(path)


@pytest.mark.parametrize("kind", ["nc", "zarr"])
def test_files_of_the_version_before_are_read_and_verify_says_what_it_cannot_check(
    tmp_path: Path, kind: str
) -> None:
    """Their checksums of content have other names; only the last line is still held to."""
    answer = small_series()
    old = answer.assign_attrs(header_sha256="0" * 64, data_sha256="0" * 64, made_in_blocks="time 9")
    path = tmp_path / f"r.{kind}"
    if kind == "nc":
        old.to_netcdf(path, engine="netcdf4")
    else:
        from numcodecs import CRC32, Shuffle

        filters = {"filters": [Shuffle(8), CRC32()]}
        old.to_zarr(path, consolidated=False, zarr_format=2, encoding={"torque": filters})
    back = store.open(path)
    assert isinstance(back, xr.Dataset)
    assert same(back.load(), answer)
    with pytest.raises(OutputError, match="earlier version"):
        earthspin.verify(path)
    if kind == "nc":
        checksums.append_line(path)
        assert earthspin.verify(path) == path


def test_a_pipe_is_refused(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "r.nc")
    with pytest.raises(OutputError, match="it is a pipe"):
        store.open(tmp_path / "r.nc")


def test_no_flipped_bit_of_a_zarr_store_passes_verify(tmp_path: Path) -> None:
    answer = small_series()
    path = store.write(answer, tmp_path / "r.zarr")
    earthspin.verify(path)
    files = sorted(p for p in path.rglob("*") if p.is_file())
    rng = np.random.default_rng(SEED)
    noticed = 0
    for file in rng.choice(len(files), 60).tolist():
        whole = files[file].read_bytes()
        place = int(rng.integers(0, 8 * len(whole)))
        bits = bytearray(whole)
        bits[place // 8] ^= 1 << (place % 8)
        files[file].write_bytes(bits)
        try:
            earthspin.verify(path)
        except OutputError:
            noticed += 1
        else:
            back = store.open(path)
            assert isinstance(back, xr.Dataset)
            assert same(back.load(), answer), files[file]
        files[file].write_bytes(whole)
    print(noticed)
    assert noticed >= 30
    earthspin.verify(path)


def test_a_chunk_that_is_gone_is_missed(tmp_path: Path) -> None:
    for name in ("torque/0.0.0", "time/0"):
        path = store.write(small_series(), tmp_path / "r.zarr")
        (path / name).unlink()
        with pytest.raises(OutputError, match=f"chunk '{name}' is missing"):
            earthspin.verify(path)
        with pytest.raises(OutputError, match=f"chunk '{name}' is missing"):
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
    assert earthspin.open(path).identical(earthspin.run(scene))
    third = path / "torque" / "2.0.0"
    third.write_bytes((path / "torque" / "1.0.0").read_bytes())  # whole, and of another block
    with pytest.raises(OutputError, match="are not what was written"):
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
        with pytest.raises(OutputError, match=r"attributes are not .*xarray.open_dataset"):
            read(path)


def test_a_file_of_others_is_read_but_not_verified(tmp_path: Path) -> None:
    answer = small_series()
    answer.to_netcdf(tmp_path / "plain.nc")
    assert same(store.open(tmp_path / "plain.nc"), answer)
    with pytest.raises(OutputError, match="has no checksum"):
        earthspin.verify(tmp_path / "plain.nc")


def test_what_was_read_carries_no_checksum(tmp_path: Path) -> None:
    """A part of it, written by other means, would otherwise carry a wrong one."""
    answer = small_series()
    back = store.open(store.write(answer, tmp_path / "r.nc"))
    assert back.attrs == answer.attrs


def test_a_store_that_is_replaced_while_it_is_read_says_so(tmp_path: Path) -> None:
    path = store.write(small_series(), tmp_path / "r.zarr")
    lazy = store.open(path)
    store.write(small_series(), path)
    with pytest.raises(OutputError, match="was replaced while it was read; open it again"):
        lazy["torque"].load()
    shutil.rmtree(path)
    with pytest.raises(OutputError, match="was replaced while it was read"):
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

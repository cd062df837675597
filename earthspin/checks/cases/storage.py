"""Stiff and extreme cases of results on disk."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from pathlib import Path

import numpy as np
import xarray as xr

from earthspin.checks.case import Distances, holds, refused, without_folder
from earthspin.engine import drafts, store
from earthspin.engine.labels import Variable, build
from earthspin.errors import OutputError

TIMES = np.array(
    ["1550-01-01T00:00:00.000001", "2000-02-29", "2650-12-31T23:59:59.999999"], "M8[us]"
)


def _small(value: float = 1.0) -> xr.Dataset:
    return xr.Dataset(
        {"x": ("time", np.full(TIMES.size, value), {"units": "m"})}, {"time": ("time", TIMES)}
    )


@contextmanager
def _folder() -> Iterator[Path]:
    with tempfile.TemporaryDirectory() as folder:
        yield Path(folder)


class _HalfWayError(Exception):
    """What goes wrong in the middle of a write."""


@holds(bound=0.0, unit="us")
def _far_epochs() -> Distances:
    """epochs of 1550 and 2650 on disk

    Hard because: nanoseconds since 1970 wrap around: 1550 would come back as 2134
    Held against: the microsecond that was written
    """
    with _folder() as folder:
        back = store.read(store.write(_small(), folder / "r.nc"))
    yield (back.time.values - TIMES).astype(np.int64)


@holds(bound=0.0)
def _odd_numbers() -> Distances:
    """infinity, the least and the largest float on disk

    Hard because: fill values stand for missing ones, and some are such numbers
    Held against: the number that was written, bit for bit
    """
    for value in (np.inf, 5e-324, 9.969209968386869e36, 1.7976931348623157e308):
        with _folder() as folder:
            back = store.read(store.write(_small(value), folder / "r.nc"))
        yield back.x.values != value


@holds(bound=0.0)
def _half_netcdf() -> Distances:
    """a write to netCDF that fails half-way

    Hard because: half a file looks like a file
    Held against: the old result, whole, and nothing beside it
    """
    with _folder() as folder:
        path = store.write(_small(1.0), folder / "r.nc")
        with suppress(_HalfWayError), drafts.replacing(path) as draft:
            draft.write_bytes(path.read_bytes()[:100])
            raise _HalfWayError
        yield len({p.name for p in folder.iterdir()} ^ {"r.nc"})
        yield store.read(path).x.values != 1.0


@holds(bound=0.0)
def _half_zarr() -> Distances:
    """a write to a Zarr folder that fails half-way

    Hard because: a store is many files, replaced as one
    Held against: the old files, and nothing beside them
    """
    with _folder() as folder:
        old = folder / "r.zarr"
        old.mkdir()
        (old / ".zgroup").write_text("old")
        with suppress(_HalfWayError), drafts.replacing(old) as draft:
            draft.mkdir()
            (draft / ".zgroup").write_text("new")
            raise _HalfWayError
        yield len({p.name for p in folder.iterdir()} ^ {"r.zarr"})
        yield (old / ".zgroup").read_text() != "old"


@refused("has no value here")
def _hole() -> None:
    """a result with a hole in it

    Hard because: NaN on disk is read as missing, and plotted as nothing
    """
    build({"x": Variable(("n",), "m", "a length")}, {"x": np.array([1.0, np.nan])})


@refused("it cannot be read")
def _cut_file() -> None:
    """a file cut in half

    Hard because: its head is whole and promises the rest
    """
    with _folder() as folder:
        whole = store.write(_small(), folder / "r.nc").read_bytes()
        (folder / "cut.nc").write_bytes(whole[: len(whole) // 2])
        with without_folder(folder / "cut.nc"):
            store.read(folder / "cut.nc")


@refused("cannot be written")
def _blocked() -> None:
    """a place where a file stands in the way of a folder

    Hard because: some of the path exists, and none of it can be written
    """
    with _folder() as folder:
        (folder / "file").write_text("in the way")
        with without_folder(folder / "file"):
            store.write(_small(), folder / "file" / "r.nc")


@refused("neither .nc nor .zarr")
def _other_ending() -> None:
    """a file of another kind

    Hard because: it would be written in a format that its name denies
    """
    with _folder() as folder, without_folder(folder / "r.txt"):
        store.write(_small(), folder / "r.txt")


def _answer() -> xr.DataTree:
    """A small answer with a section."""
    n = np.arange(500)
    root = _small().assign_attrs(title="t", note="µ")
    return xr.DataTree.from_dict({"/": root, "more": xr.Dataset({"y": ("n", n * 1.5)}, {"n": n})})


def _same(found: xr.Dataset | xr.DataTree, wanted: xr.Dataset | xr.DataTree) -> bool:
    return type(found) is type(wanted) and found.identical(wanted)  # type: ignore[arg-type]


def _flipped(path: Path, place: int) -> None:
    """Flip one bit of a file."""
    bits = bytearray(path.read_bytes())
    place %= 8 * len(bits)
    bits[place // 8] ^= 1 << (place % 8)
    path.write_bytes(bits)


@holds(bound=0.0)
def _flipped_netcdf() -> Distances:
    """120 flipped bits in a netCDF file, one at a time

    Hard because: the format guards its numbers alone, and damaged tables can keep HDF5 busy for
        ever
    Held against: a refusal of each, and of the file as it was the answer: which are not
    """
    rng = np.random.default_rng(1)
    with _folder() as folder:
        answer = _answer()
        path = store.write(answer, folder / "r.nc")
        for place in rng.integers(0, 8 * path.stat().st_size, 120).tolist():
            _flipped(path, place)
            with suppress(OutputError):
                store.open(path)
                yield 1.0
            _flipped(path, place)
        yield not _same(store.open(path), answer)


@holds(bound=0.0)
def _threads() -> Distances:
    """threads that write and read netCDF

    Hard because: the library underneath is not made for more than one, and ends the process
    Held against: what each of four threads has written, ten times
    """

    def work(number: int) -> list[bool]:
        turns = [float(number * 10 + turn) for turn in range(10)]
        path = folder / f"{number}.nc"
        return [not _same(store.open(store.write(_small(n), path)), _small(n)) for n in turns]

    with _folder() as folder, ThreadPoolExecutor(4) as pool:
        yield from pool.map(work, range(4))


@holds(bound=0.0)
def _two_writers() -> Distances:
    """a writer of another container at work on the same file

    Hard because: process ids say nothing there: the other would pass for dead, and lose its draft
    Held against: the last to finish, whole, and nothing beside it
    """
    with _folder() as folder:
        path = folder / "r.zarr"
        with drafts.replacing(path) as draft:
            store.write(_small(1.0), path)
            store.write(_small(2.0), draft)
        yield not _same(store.open(path), _small(2.0))
        yield len({p.name for p in folder.iterdir()} ^ {"r.zarr"})


@refused("is missing")
def _lost_chunk() -> None:
    """a Zarr store that has lost a chunk

    Hard because: the format reads what is not there as zeros, and dates as of the year 2000
    """
    with _folder() as folder, without_folder(folder / "r.zarr"):
        path = store.write(_answer(), folder / "r.zarr")
        (path / "more" / "y" / "0").unlink()
        store.verify(path)


@refused("are not what was written")
def _flipped_chunk() -> None:
    """a Zarr store with a bit flipped in a chunk

    Hard because: most bits of a number change nothing that one would see
    """
    with _folder() as folder, without_folder(folder / "r.zarr"):
        path = store.write(_answer(), folder / "r.zarr")
        _flipped(path / "more" / "y" / "0", 4001)
        store.verify(path)


@refused("not what was written")
def _changed_unit() -> None:
    """a unit that was changed in a stored result

    Hard because: it is an attribute, which no format guards
    """
    with _folder() as folder, without_folder(folder / "r.zarr"):
        path = store.write(_small(), folder / "r.zarr")
        attributes = path / "x" / ".zattrs"
        attributes.write_text(attributes.read_text().replace('"m"', '"km"'))
        store.open(path)


@refused("open it again")
def _replaced_store() -> None:
    """a Zarr store that is replaced while it is read

    Hard because: half of the numbers would be of the one, half of the other
    """
    with _folder() as folder, without_folder(folder / "r.zarr"):
        path = store.write(_small(1.0), folder / "r.zarr")
        before = store.open(path)
        store.write(_small(2.0), path)
        before["x"].load()

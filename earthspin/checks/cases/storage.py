"""Stiff and extreme cases of results on disk."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import numpy as np
import xarray as xr

from earthspin.checks.case import (
    Cases,
    Distances,
    hard_because,
    held_against,
    refused,
    without_folder,
)
from earthspin.engine import drafts, store
from earthspin.engine.labels import Variable, build

CASES = Cases("storage")

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


@CASES.case("epochs of 1550 and 2650 on disk")
@hard_because("nanoseconds since 1970 wrap around: 1550 would come back as 2134")
@held_against("the microsecond that was written", bound=0.0, unit="us")
def _far_epochs() -> Distances:
    with _folder() as folder:
        back = store.read(store.write(_small(), folder / "r.nc"))
    yield (back.time.values - TIMES).astype(np.int64)


@CASES.case("infinity, the least and the largest float on disk")
@hard_because("fill values stand for missing ones, and some are such numbers")
@held_against("the number that was written, bit for bit", bound=0.0)
def _odd_numbers() -> Distances:
    for value in (np.inf, 5e-324, 9.969209968386869e36, 1.7976931348623157e308):
        with _folder() as folder:
            back = store.read(store.write(_small(value), folder / "r.nc"))
        yield back.x.values != value


@CASES.case("a write to netCDF that fails half-way")
@hard_because("half a file looks like a file")
@held_against("the old result, whole, and nothing beside it", bound=0.0)
def _half_netcdf() -> Distances:
    with _folder() as folder:
        path = store.write(_small(1.0), folder / "r.nc")
        with suppress(_HalfWayError), drafts.replacing(path) as draft:
            draft.write_bytes(path.read_bytes()[:100])
            raise _HalfWayError
        yield len({p.name for p in folder.iterdir()} ^ {"r.nc"})
        yield store.read(path).x.values != 1.0


@CASES.case("a write to a Zarr folder that fails half-way")
@hard_because("a store is many files, replaced as one")
@held_against("the old files, and nothing beside them", bound=0.0)
def _half_zarr() -> Distances:
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


@CASES.case("a result with a hole in it")
@hard_because("NaN on disk is read as missing, and plotted as nothing")
@refused("has no value here")
def _hole() -> None:
    build({"x": Variable(("n",), "m", "a length")}, {"x": np.array([1.0, np.nan])})


@CASES.case("a file cut in half")
@hard_because("its head is whole and promises the rest")
@refused("it cannot be read")
def _cut_file() -> None:
    with _folder() as folder:
        whole = store.write(_small(), folder / "r.nc").read_bytes()
        (folder / "cut.nc").write_bytes(whole[: len(whole) // 2])
        with without_folder(folder / "cut.nc"):
            store.read(folder / "cut.nc")


@CASES.case("a place where a file stands in the way of a folder")
@hard_because("some of the path exists, and none of it can be written")
@refused("cannot be written")
def _blocked() -> None:
    with _folder() as folder:
        (folder / "file").write_text("in the way")
        with without_folder(folder / "file"):
            store.write(_small(), folder / "file" / "r.nc")


@CASES.case("a file of another kind")
@hard_because("it would be written in a format that its name denies")
@refused("neither .nc nor .zarr")
def _other_ending() -> None:
    with _folder() as folder, without_folder(folder / "r.txt"):
        store.write(_small(), folder / "r.txt")

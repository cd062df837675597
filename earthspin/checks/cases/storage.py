"""Stiff and extreme cases of results on disk."""

from __future__ import annotations

from contextlib import suppress

import numpy as np
import xarray as xr

from earthspin.checks.case import Distances, holds, temporary
from earthspin.engine import drafts, store

TIMES = np.array(
    ["1550-01-01T00:00:00.000001", "2000-02-29", "2650-12-31T23:59:59.999999"], "M8[us]"
)


def _small(value: float = 1.0) -> xr.Dataset:
    return xr.Dataset(
        {"x": ("time", np.full(TIMES.size, value), {"units": "m"})}, {"time": ("time", TIMES)}
    )


class _HalfWayError(Exception):
    """What goes wrong in the middle of a write."""


@holds(bound=0.0)
def _odd_numbers() -> Distances:
    """infinity, the least and the largest float on disk

    Hard because: fill values stand for missing ones, and some are such numbers
    Held against: the number that was written, bit for bit
    """
    for value in (np.inf, 5e-324, 9.969209968386869e36, 1.7976931348623157e308):
        with temporary("r.nc") as path:
            back = store.read(store.write(_small(value), path))
        yield back.x.values != value


@holds(bound=0.0)
def _half_netcdf() -> Distances:
    """a write to netCDF that fails half-way

    Hard because: half a file looks like a file
    Held against: the old result, whole, and nothing beside it
    """
    with temporary("r.nc") as path:
        store.write(_small(1.0), path)
        with suppress(_HalfWayError), drafts.replacing(path) as draft:
            draft.write_bytes(path.read_bytes()[:100])
            raise _HalfWayError
        yield len({path} ^ set(path.parent.iterdir()))
        yield store.read(path).x.values != 1.0


@holds(bound=0.0)
def _half_zarr() -> Distances:
    """a write to a Zarr folder that fails half-way

    Hard because: a store is many files, replaced as one
    Held against: the old files, and nothing beside them
    """
    with temporary("r.zarr") as old:
        old.mkdir()
        (old / ".zgroup").write_text("old")
        with suppress(_HalfWayError), drafts.replacing(old) as draft:
            draft.mkdir()
            (draft / ".zgroup").write_text("new")
            raise _HalfWayError
        yield len({old} ^ set(old.parent.iterdir()))
        yield (old / ".zgroup").read_text() != "old"

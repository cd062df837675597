"""Results on disk."""

from __future__ import annotations

from contextlib import suppress

import numpy as np
import xarray as xr

from earthspin.engine import drafts, store
from tests.extreme import Distances, holds, temporary

TIMES = np.array(
    ["1550-01-01T00:00:00.000001", "2000-02-29", "2650-12-31T23:59:59.999999"], "M8[us]"
)


def _small(value: float = 1.0) -> xr.Dataset:
    return xr.Dataset(
        {"x": ("time", np.full(TIMES.size, value), {"units": "m"})}, {"time": ("time", TIMES)}
    )


class _InterruptionError(Exception):
    """Error raised by a test case to interrupt the writing of a file."""


@holds(bound=0.0)
def test_odd_numbers() -> Distances:
    """writing and reading of infinity and extreme floats

    Hard because: files mark missing values by fill values, and some of these are such numbers
    Compared with: the written number, bit for bit
    """
    for value in (np.inf, 5e-324, 9.969209968386869e36, 1.7976931348623157e308):
        with temporary("r.nc") as path:
            back = store.read(store.write(_small(value), path))
        yield back.x.values != value


@holds(bound=0.0)
def test_half_netcdf() -> Distances:
    """writing of a netCDF file that fails halfway

    Hard because: half a file looks like a file
    Compared with: the complete old result, and no other file in the folder
    """
    with temporary("r.nc") as path:
        store.write(_small(1.0), path)
        with suppress(_InterruptionError), drafts.replacing(path) as draft:
            draft.write_bytes(path.read_bytes()[:100])
            raise _InterruptionError
        yield len({path} ^ set(path.parent.iterdir()))
        yield store.read(path).x.values != 1.0


@holds(bound=0.0)
def test_half_zarr() -> Distances:
    """writing of a Zarr store that fails halfway

    Hard because: a store consists of many files, which are replaced together
    Compared with: the old files, and no other file in the folder
    """
    with temporary("r.zarr") as old:
        old.mkdir()
        (old / ".zgroup").write_text("old")
        with suppress(_InterruptionError), drafts.replacing(old) as draft:
            draft.mkdir()
            (draft / ".zgroup").write_text("new")
            raise _InterruptionError
        yield len({old} ^ set(old.parent.iterdir()))
        yield (old / ".zgroup").read_text() != "old"

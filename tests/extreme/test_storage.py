"""Results on disk."""

import numpy as np
import xarray as xr

from earthspin.engine import store
from tests.extreme import Distances, holds, temporary

TIMES = np.array(
    ["1550-01-01T00:00:00.000001", "2000-02-29", "2650-12-31T23:59:59.999999"], "M8[us]"
)


def _small(value: float = 1.0) -> xr.Dataset:
    return xr.Dataset(
        {"x": ("time", np.full(TIMES.size, value), {"units": "m"})}, {"time": ("time", TIMES)}
    )


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

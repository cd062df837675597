"""Read the input values of ensemble members from a Dataset, a file or a scene (input file).

The values are finite numbers, or names without gaps.
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from earthspin.errors import OutputError, Where
from earthspin.units import unpack

if TYPE_CHECKING:
    import xarray as xr

#: Name of the dimension of an ensemble.
MEMBER = "member"


def read_file(path: Path) -> xr.Dataset:
    """Read input values of ensemble members from a CSV, netCDF or Zarr file.

    Parameters
    ----------
    path : Path
        Path that ends in ``.csv``, ``.nc`` or ``.zarr``.

    Raises
    ------
    OutputError, SceneError
        If the file cannot be read.
    """
    import xarray as xr

    # os.path.exists is false for a name that is too long, where Path.exists raises an error
    if not os.path.exists(path):
        raise OutputError(path, "there is no such file", "give a .csv, .nc or .zarr, or a number")
    try:
        if path.suffix == ".csv":
            import pandas as pd

            with warnings.catch_warnings():
                # rows that are longer than the header would shift the columns
                warnings.simplefilter("error", pd.errors.ParserWarning)
                frame = pd.read_csv(path, skipinitialspace=True, index_col=False)
            columns = {name: (MEMBER, frame[name].to_numpy()) for name in frame if name != MEMBER}
            return xr.Dataset(columns)
        if path.suffix in (".nc", ".zarr"):
            with xr.open_dataset(path, **({} if path.suffix == ".nc" else _ZARR)) as dataset:
                return dataset.load()
    except Exception as error:  # pandas and xarray raise many types for damaged files
        raise OutputError(path, f"it cannot be read: {error}") from None
    raise OutputError(
        path, "it is not a file of members", "its name must end in .csv, .nc or .zarr"
    )


_ZARR: dict[str, Any] = {"engine": "zarr", "consolidated": False}


def values_from_dataset(dataset: Any, where: Where) -> dict[str, NDArray[Any]]:
    """Return the input values of the members, by input name, from a Dataset along `member`.

    The Dataset may be the answer of an ensemble.
    """
    values: dict[str, NDArray[Any]] = {}
    for name, array in _inputs(dataset):
        inner = where.at(name)
        if not array.dims or array.dims[0] != MEMBER:
            problem = f"the first dimension must be '{MEMBER}'"
            raise inner.error(f"dimensions {', '.join(map(str, array.dims)) or 'none'}", problem)
        values[name] = _checked(array.values, inner)
    if not values or not all(len(array) for array in values.values()):
        raise where.error("a Dataset", f"it has no members; give variables along '{MEMBER}'")
    return values


def units_from_dataset(dataset: Any) -> dict[str, str]:
    """Return the units of the numbers of the members, by input name, for those that have one."""
    return {
        name: str(array.attrs["units"])
        for name, array in _inputs(dataset)
        if "units" in array.attrs and array.dtype.kind in "fiu"
    }


def _inputs(dataset: Any) -> Iterator[tuple[str, Any]]:
    """Yield the input name and the variable of each input of the members in a Dataset."""
    labels = dataset.coords.values()
    is_answer = any("input" in array.attrs for array in labels)  # take its inputs, not its results
    for name, array in {**({} if is_answer else dataset.data_vars), **dataset.coords}.items():
        if name != MEMBER and (name in dataset.data_vars or "input" in array.attrs):
            yield str(array.attrs.get("input", name)), array


def values_from_scene(values: Any, where: Where) -> NDArray[Any]:
    """Read the values of one input for all members from the table in a scene file."""
    if isinstance(values, Mapping):
        return unpack(values, where)
    return _names(np.array(values, dtype=object), where)


def _checked(values: NDArray[Any], where: Where) -> NDArray[Any]:
    """Return the values of one input for all members; refuse all but finite numbers and names."""
    if values.dtype.kind not in "fiu":
        return _names(values.astype(object), where)
    if not np.isfinite(values).all():
        whole = np.isfinite(values.reshape(len(values), -1)).all(axis=1)
        raise where.error(f"member {int(np.argmin(whole))}", "give finite numbers")
    return values.astype(float)


def _names(values: NDArray[Any], where: Where) -> NDArray[Any]:
    """Return the values of one input for all ensemble members as text; refuse all but names."""
    if values.ndim != 1 or not values.size:
        raise where.error(f"shape {values.shape}", "give one name for each member")
    for index, name in enumerate(values):
        if not isinstance(name, str):
            raise where.error(f"member {index}", "give finite numbers, or a name for each member")
    return values.astype(str)

"""Values that are given member by member: in a Dataset, a file, or the text of a scene.

Numbers that are finite, or words that are all there.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from earthspin.errors import OutputError, Where
from earthspin.units import unpack

if TYPE_CHECKING:
    import xarray as xr

#: The dimension of an ensemble.
MEMBER = "member"


def read_file(path: Path) -> xr.Dataset:
    """Read values of members from a file: a table with a line of names, or netCDF or Zarr.

    Parameters
    ----------
    path : Path
        Ends in ``.csv``, ``.nc`` or ``.zarr``.

    Raises
    ------
    OutputError, SceneError
        If it cannot be read.
    """
    import xarray as xr

    # os.path.exists is false for a name that is too long, where Path.exists raises an error
    if not os.path.exists(path):
        raise OutputError(path, "there is no such file", "give a .csv, .nc or .zarr, or a number")
    try:
        if path.suffix == ".csv":
            import pandas as pd

            frame = pd.read_csv(path, skipinitialspace=True)
            columns = {name: (MEMBER, frame[name].to_numpy()) for name in frame if name != MEMBER}
            return xr.Dataset(columns)
        if path.suffix in (".nc", ".zarr"):
            with xr.open_dataset(path, **({} if path.suffix == ".nc" else _ZARR)) as dataset:
                return dataset.load()
    except Exception as error:  # whatever the libraries say of a file that is none
        raise OutputError(path, f"it cannot be read: {error}") from None
    raise OutputError(path, "it is no file of members", "its name ends in .csv, .nc or .zarr")


_ZARR: dict[str, Any] = {"engine": "zarr", "consolidated": False}


def of_dataset(given: Any, where: Where) -> dict[str, NDArray[Any]]:
    """Values by name, from a Dataset along `member`; those of an ensemble that was made, too."""
    values: dict[str, NDArray[Any]] = {}
    for name, array in {**given.data_vars, **given.coords}.items():
        if name == MEMBER or (name in given.coords and "input" not in array.attrs):
            continue
        if name in given.data_vars and any("input" in c.attrs for c in given.coords.values()):
            continue  # an answer: its inputs are what is asked again
        inner = where.at(str(array.attrs.get("input", name)))
        if not array.dims or array.dims[0] != MEMBER:
            words = f"its first dimension is '{MEMBER}'"
            raise inner.error(f"dimensions {', '.join(map(str, array.dims)) or 'none'}", words)
        values[str(array.attrs.get("input", name))] = _checked(array.values, inner)
    if not values or not all(len(array) for array in values.values()):
        raise where.error("a Dataset", f"it holds no member; give variables along '{MEMBER}'")
    return values


def from_scene(values: Any, where: Where) -> NDArray[Any]:
    """Values of one input as `Members.write` gives them: bytes of numbers, or a list of words."""
    if isinstance(values, Mapping):
        return unpack(values, where)
    return _words(np.array(values, dtype=object), where)


def _checked(values: NDArray[Any], where: Where) -> NDArray[Any]:
    """Numbers that are finite, or words that are all there."""
    if values.dtype.kind not in "fiu":
        return _words(values.astype(object), where)
    if not np.isfinite(values).all():
        whole = np.isfinite(values.reshape(len(values), -1)).all(axis=1)
        raise where.error(f"member {int(np.argmin(whole))}", "give finite numbers")
    return values.astype(float)


def _words(values: NDArray[Any], where: Where) -> NDArray[Any]:
    """Words along `member`, all of one width, as a store keeps them."""
    if values.ndim != 1 or not values.size:
        raise where.error(f"shape {values.shape}", "give one word for each member")
    for place, word in enumerate(values):
        if not isinstance(word, str):
            words = "give finite numbers, or a word for each member"
            raise where.error(f"member {place}", words)
    return values.astype(str)

"""Write a result as JSON text piece by piece, so that the full text is never in memory."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from datetime import datetime
from typing import Any, TextIO, TypeVar

import numpy as np
import xarray as xr

T = TypeVar("T")

#: Numbers that become text at once.
AT_ONCE = 1 << 16


def write_json(tree: xr.DataTree, stream: TextIO) -> None:
    """Write a result and its sections as JSON, in the layout of `Dataset.to_dict`.

    Dates are text in ISO 8601, and so are infinity and what is no number, for which JSON has none.

    Parameters
    ----------
    tree : DataTree
    stream : text file
    """
    _write_node(tree, stream)
    sections = {name: node for name, node in tree.children.items() if name != "plan"}
    if sections:
        _write_members("sections", sections, _write_node, stream)
    stream.write("}\n")


def _write_members(
    title: str, members: Mapping[Any, T], write: Callable[[T, TextIO], None], stream: TextIO
) -> None:
    """Write several named items as one JSON object; `write` writes each of the items."""
    stream.write(f',\n"{title}": {{')
    for number, (name, member) in enumerate(members.items()):
        stream.write(f"{',' if number else ''}\n{json.dumps(str(name))}: ")
        write(member, stream)
        stream.write("}")
    stream.write("\n}")


def _write_node(node: xr.DataTree, stream: TextIO) -> None:
    data = node.to_dataset()
    stream.write(f'{{"attrs": {_text(data.attrs)},\n"dims": {_text(data.sizes)}')
    _write_members("coords", data.coords, _write_array, stream)
    _write_members("data_vars", data.data_vars, _write_array, stream)


def _write_array(array: xr.DataArray, stream: TextIO) -> None:
    values = array.values
    stream.write(f'{_text({"dims": array.dims, "attrs": array.attrs})[:-1]}, "data": ')
    if values.ndim == 0:
        stream.write(_text(values))
        return
    rows = max(1, AT_ONCE * values.shape[0] // max(1, values.size))
    stream.write("[")
    for first in range(0, values.shape[0], rows):
        stream.write(("," if first else "") + _text(values[first : first + rows])[1:-1])
    stream.write("]")


def _text(value: Any) -> str:
    return json.dumps(_plain(value), default=str)


def _plain(value: Any) -> Any:
    """Convert arrays, dates and infinite numbers to types that JSON can represent."""
    if isinstance(value, Mapping):
        return {str(key): _plain(inner) for key, inner in value.items()}
    if isinstance(value, (np.ndarray, np.generic)):
        if value.dtype.kind == "f" and np.isfinite(value).all():
            return value.tolist()
        value = value.astype("M8[us]").tolist() if value.dtype.kind == "M" else value.tolist()
    if isinstance(value, (list, tuple)):
        return [_plain(inner) for inner in value]
    if isinstance(value, datetime):
        return value.isoformat()
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value

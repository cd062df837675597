"""An answer as JSON, written as it is made, so that a long one never stands in memory as text."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any, TextIO

import numpy as np
import xarray as xr

#: Numbers that become text at once.
AT_ONCE = 1 << 16


def write_json(tree: xr.DataTree, stream: TextIO) -> None:
    """Write an answer with its sections, laid out as by `Dataset.to_dict`.

    Dates are text in ISO 8601, and so are infinity and what is no number, for which JSON has none.

    Parameters
    ----------
    tree : DataTree
    stream : text file
    """
    _write_node(tree.to_dataset(), stream)
    sections = {name: node for name, node in tree.children.items() if name != "plan"}
    if sections:
        stream.write(',\n"sections": {')
        for number, (name, node) in enumerate(sections.items()):
            stream.write(f"{',' if number else ''}\n{json.dumps(name)}: ")
            _write_node(node.to_dataset(), stream)
            stream.write("}")
        stream.write("\n}")
    stream.write("}\n")


def _write_node(node: xr.Dataset, stream: TextIO) -> None:
    """Write a Dataset, its last brace left open."""
    stream.write('{"attrs": ')
    stream.write(_text(dict(node.attrs)))
    stream.write(f',\n"dims": {_text({str(dim): size for dim, size in node.sizes.items()})}')
    for what, variables in (("coords", node.coords), ("data_vars", node.data_vars)):
        stream.write(f',\n"{what}": {{')
        for number, (name, array) in enumerate(variables.items()):
            head = {"dims": list(array.dims), "attrs": array.attrs}
            stream.write(f"{',' if number else ''}\n{json.dumps(str(name))}: ")
            stream.write(f'{_text(head)[:-1]}, "data": ')
            _write_values(array.values, stream)
            stream.write("}")
        stream.write("\n}")


def _write_values(values: np.ndarray[Any, Any], stream: TextIO) -> None:
    if values.ndim == 0:
        stream.write(_text(_plain(values)))
        return
    rows = max(1, AT_ONCE * values.shape[0] // max(1, values.size))
    stream.write("[")
    for first in range(0, values.shape[0], rows):
        listed = _text(_plain(values[first : first + rows]))
        stream.write(("," if first else "") + listed[1:-1])
    stream.write("]")


def _plain(values: np.ndarray[Any, Any]) -> Any:
    """Numbers, words and dates as JSON holds them."""
    if values.dtype.kind == "M":
        seconds = values.astype("M8[us]").ravel().tolist()
        told = np.array([str(t) if t is None else t.isoformat() for t in seconds], dtype=object)
        return told.reshape(values.shape).tolist()
    if values.dtype.kind == "f" and not np.isfinite(values).all():
        told = values.astype(object)
        told[~np.isfinite(values)] = [str(float(v)) for v in values[~np.isfinite(values)]]
        return told.tolist()
    return values.tolist()


def _text(value: Any) -> str:
    return json.dumps(_finite(value) if isinstance(value, Mapping) else value, default=_listed)


def _finite(value: Any) -> Any:
    """Attributes whose numbers JSON has."""
    if isinstance(value, Mapping):
        return {str(key): _finite(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple, np.ndarray, np.generic)):
        return _finite_list(value)
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


def _finite_list(value: Any) -> Any:
    listed = value.tolist() if hasattr(value, "tolist") else list(value)
    return [_finite(one) for one in listed] if isinstance(listed, list) else _finite(listed)


def _listed(value: Any) -> Any:
    return value.tolist() if hasattr(value, "tolist") else str(value)

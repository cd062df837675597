"""Write a result as JSON text."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from datetime import datetime
from typing import Any, TextIO

import xarray as xr


def write_json(tree: xr.DataTree, stream: TextIO) -> None:
    """Write a result and its sections as JSON, in the layout of `Dataset.to_dict`.

    Dates are text in ISO 8601, and so are infinity and what is no number, for which JSON has none.

    Parameters
    ----------
    tree : DataTree
    stream : text file
    """
    nodes = {name: node for name, node in tree.children.items() if name != "plan"}
    whole = tree.to_dataset().to_dict()
    if nodes:
        whole["sections"] = {name: node.to_dataset().to_dict() for name, node in nodes.items()}
    stream.write(json.dumps(_plain(whole), default=str) + "\n")


def _plain(value: Any) -> Any:
    """Convert dates and infinite numbers to types that JSON can represent."""
    if isinstance(value, Mapping):
        return {str(key): _plain(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(inner) for inner in value]
    if isinstance(value, datetime):
        return value.isoformat()
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value

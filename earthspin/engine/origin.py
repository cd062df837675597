"""Scene of an answer, with the labels and numbers that it made, and comparison with the data.

xarray copies attributes to selected, joined and averaged data, so that a scene may reach data that
are not its answer. The last line of a scene, a comment in TOML, has the size and a hash of the
labels of each dimension, and the smallest and largest value of each variable.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from typing import Any, TypeVar

import numpy as np

from earthspin._lazy import xr
from earthspin.engine.question import SCENE

T = TypeVar("T", "xr.Dataset", "xr.DataTree")

#: Beginning of the last line of a scene.
_MADE = "\n# made: "
#: Numbers this many times larger than all numbers of the answer have another unit.
_LARGER = 10.0


def with_labels(answer: T, blocks: Iterable[xr.Dataset] = ()) -> T:
    """Add the labels and ranges of an answer to its scene, if it has one, in place.

    Parameters
    ----------
    answer : Dataset or DataTree
    blocks : iterable of Dataset
        Blocks of an answer in a store, whose numbers are not in memory.
    """
    made = _labels(answer) | _ranges(answer)
    for name, (low, high) in (entry for block in blocks for entry in _ranges(block).items()):
        least, most = made.get(name, (low, high))
        made[name] = [min(least, low), max(most, high)]
    if scene := answer.attrs.get(SCENE):
        text = json.dumps(made, sort_keys=True)
        answer.attrs[SCENE] = f"{scene.partition(_MADE)[0]}{_MADE}{text}\n"
    return answer


def scene_of(answer: Any) -> str:
    """Text of the scene of a result; empty if it has none, or if the data are not its answer."""
    return "" if difference(answer) else _stored(answer)


def without_lost_scene(data: xr.Dataset) -> xr.Dataset:
    """Return data without a scene whose answer they no longer are."""
    if SCENE in data.attrs and difference(data):
        data = data.copy()
        del data.attrs[SCENE]
    return data


def is_whole(answer: Any) -> bool:
    """Return True if data are the answer to their scene, with all labels and numbers."""
    names = {*answer.variables, *answer.sizes}
    return bool(_made(answer)) and _made(answer).keys() <= names and not difference(answer)


def difference(answer: Any) -> str:
    """Say in words how data differ from the answer to their scene; empty if they do not."""
    was, now = _made(answer), _labels(answer)
    for name in {**was, **now} if was else ():
        if name in now or isinstance(was[name][-1], str):
            old, new = was.get(name, [0]), now.get(name, [0])
            if old != new[: len(old)]:
                sizes = f"{old[0]} labels along '{name}', the data have {new[0]}"
                return f"the scene makes {sizes}{', others' * (old[0] == new[0])}"
    changed = (name for name, ends in _ranges(answer).items() if was.get(name, ends) != ends)
    return next((f"the scene makes other values of '{name}'" for name in changed), "")


def without_lost_units(data: xr.Dataset) -> xr.Dataset:
    """Return data without the units of variables whose numbers were multiplied."""
    was, now = _made(data), _ranges(data)
    lost = [name for name in now if name in was and _is_multiple(was[name], now[name])]
    return data.assign({name: data[name].drop_attrs() for name in lost}) if lost else data


def _is_multiple(was: list[float], now: list[float]) -> bool:
    before, after = np.sort(np.abs(was)), np.sort(np.abs(now))
    factor = after[-1] / before[-1] if before[-1] else 1.0
    scaled = bool(np.allclose(after, factor * before, 1e-9, 0)) and abs(factor - 1) > 1e-9
    return scaled or factor > _LARGER


def _stored(answer: Any) -> str:
    """Text of the scene; a netCDF file holds it as a variable, so that ``ncdump -h`` is short."""
    text = answer.attrs.get(SCENE)
    if text is None and SCENE in getattr(answer, "data_vars", ()):
        text = answer[SCENE].values.tolist()
    return text if isinstance(text, str) else ""


def _made(answer: Any) -> dict[str, Any]:
    """Read the labels and ranges in a scene; empty if it has none, as those of earlier versions."""
    try:
        return dict(json.loads(_stored(answer).partition(_MADE)[2] or "{}"))
    except ValueError:
        return {}


def _labels(answer: Any) -> dict[str, list[Any]]:
    """Size of each dimension, and a hash of its labels if it has any; words in any order."""
    labels = {}
    for dim, size in answer.sizes.items():
        values = answer.coords[dim].values if dim in answer.coords else np.empty(0)
        values = np.sort(values) if values.dtype.kind in "OUST" else values
        content = plain_bytes(values)[1]
        labels[str(dim)] = [size, hashlib.blake2b(content, digest_size=8).hexdigest()]
    return labels


def _ranges(answer: Any) -> dict[str, list[float]]:
    """Smallest and largest finite value of each variable of numbers in memory."""
    ranges, labels = {}, {*answer.coords}
    for name, variable in answer.variables.items():
        if name not in labels and variable.dtype.kind == "f" and variable._in_memory:
            values = variable.values
            if values.size and not np.isfinite([values.min(), values.max()]).all():
                values = values[np.isfinite(values)]
            if values.size:
                ranges[str(name)] = [float(values.min()), float(values.max())]
    return ranges


def plain_bytes(values: np.ndarray[Any, Any]) -> tuple[str, bytes]:
    """Type and bytes of an array, in a form that does not depend on machine or file format."""
    kind = values.dtype.kind
    if kind in "OUST":
        words = [
            w.decode("utf-8", "replace") if isinstance(w, bytes) else str(w) for w in values.flat
        ]
        return "words", repr(words).encode()
    if kind == "M":
        values = values.astype("M8[us]").astype(np.int64)
    ordered = np.ascontiguousarray(values, values.dtype.newbyteorder("<"))
    return f"{kind}{ordered.itemsize}", ordered.tobytes()

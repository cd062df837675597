"""The checksum that a file carries of all that it says: every label, number and attribute.

A file format guards some of its bytes (Fletcher-32 in netCDF, CRC-32 in our Zarr stores), but
neither attributes nor the names and lengths of dimensions. Two attributes of the file guard the
rest: SHA-256 of the header (names, dimensions, kinds of numbers, attributes), which costs nothing
to check, and of the data. Both are of what is read, not of bytes on disk, so that both formats
have the same.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import xarray as xr

#: Attributes of the root of a file.
HEADER, DATA = "header_sha256", "data_sha256"
#: Attribute of a store that was made block by block: the dimension and the length of a block. The
#: data along it are summed up by block, so that blocks may be made in any order.
BLOCKS = "made_in_blocks"

#: Numbers that are read at once to be summed up, of a store that may be larger than memory.
AT_ONCE = 1 << 22


class Checksum:
    """Sums up a result, whole or block by block.

    Examples
    --------
    >>> summed = Checksum()
    >>> summed.add("/", dataset)                        # doctest: +SKIP
    >>> summed.attributes()                             # doctest: +SKIP
    """

    def __init__(self) -> None:
        self._told: dict[str, list[str]] = {}
        self._sums: dict[tuple[str, str], bytes] = {}
        self._sizes: dict[tuple[str, str], dict[str, int]] = {}
        self._kinds: dict[tuple[str, str], str] = {}

    def add(
        self,
        group: str,
        node: xr.Dataset,
        *,
        data: bool = True,
        blocks: Iterable[Mapping[str, str]] | None = None,
    ) -> None:
        """Add a node.

        Parameters
        ----------
        group : str
            Path of the node, ``"/"`` for the root.
        node : Dataset
            As a file has it.
        data : bool
            Whether the numbers count; the header alone opens no chunk.
        blocks : iterable of mapping of str to str, optional
            What `of_block` gave for each block, in order, of a node that was made in blocks; its
            own numbers are not read then.
        """
        self._told[group] = list(_attributes(node.attrs))
        along, length = blocks_of(node)
        summed = None if blocks is None else [*blocks]
        for name, variable in node.variables.items():
            place = (group, str(name))
            self._sizes[place] = {str(d): n for d, n in variable.sizes.items()}
            self._kinds[place] = _kind(variable.dtype)
            self._told[group] += [f"{name} {line}" for line in _attributes(variable.attrs)]
            total = hashlib.sha256()
            if not data:
                pass
            elif along not in variable.dims:
                for stretch in _stretches(variable):
                    total.update(stretch)
            elif summed is None:
                for first in range(0, variable.sizes[along], length):
                    block = variable.isel({along: slice(first, first + length)})
                    total.update(_sum(block, along).digest())
            else:
                for sums in summed:
                    total.update(bytes.fromhex(sums[str(name)]))
            self._sums[place] = total.digest()

    def attributes(self) -> dict[str, str]:
        """Give the two checksums by the names of their attributes."""
        header = hashlib.sha256()
        for group in sorted(self._told):
            for line in (group, *sorted(self._told[group])):
                _put(header, line)
        data = hashlib.sha256()
        for place in sorted(self._sums):
            for line in (*place, str(sorted(self._sizes[place].items())), self._kinds[place]):
                _put(header, line)
            data.update(self._sums[place])
        return {HEADER: header.hexdigest(), DATA: data.hexdigest()}


def blocks_of(node: xr.Dataset) -> tuple[str, int]:
    """Dimension and length of the blocks that a node was made in; empty if it was made whole."""
    along, _, length = str(node.attrs.get(BLOCKS, "")).partition(" ")
    return (along, int(length)) if length.isdecimal() and int(length) else ("", 0)


def of_block(block: xr.Dataset, along: str) -> dict[str, str]:
    """Sum up each variable of a block that grows along a dimension."""
    return {
        str(name): _sum(variable, along).hexdigest()
        for name, variable in block.variables.items()
        if along in variable.dims
    }


def _sum(block: xr.Variable, along: str) -> Any:
    return hashlib.sha256(_bytes(block.transpose(along, ...).values))


def checksums(groups: Mapping[str, xr.Dataset], *, data: bool = True) -> dict[str, str]:
    """Sum up the nodes of a file.

    Parameters
    ----------
    groups : mapping of str to Dataset
        By path, ``"/"`` for the root.
    data : bool
        Whether the numbers count; without them the second checksum means nothing.

    Returns
    -------
    dict of str to str
        The attributes `HEADER` and `DATA`.
    """
    summed = Checksum()
    for group, node in groups.items():
        summed.add(group, node, data=data)
    return summed.attributes()


def _put(total: Any, line: str) -> None:
    """Add a text with its length, so that no two lists of texts are alike."""
    coded = line.encode("utf-8", "surrogatepass")
    total.update(b"%d:" % len(coded))
    total.update(coded)


def _attributes(attrs: Mapping[Any, Any]) -> Iterator[str]:
    """A line for each attribute but the checksums themselves.

    Formats differ in what they make of lists of one and of kinds of numbers; what is said is the
    same.
    """
    for name, value in attrs.items():
        if name not in (HEADER, DATA):
            listed = value if isinstance(value, str) else np.ravel(value).tolist()
            yield f"{name} = {[listed] if isinstance(listed, str) else listed!r}"


def _kind(dtype: np.dtype[Any]) -> str:
    if dtype.kind in "OUST":
        return "words"
    return "date" if dtype.kind == "M" else f"{dtype.kind}{dtype.itemsize}"


def _stretches(variable: xr.Variable) -> Iterator[bytes]:
    """Bytes of the numbers in order, time first, no more at once than fit into memory."""
    if "time" in variable.dims:
        variable = variable.transpose("time", ...)
    if variable.ndim == 0:
        yield _bytes(variable.values)
        return
    along = variable.dims[0]
    rows = max(1, AT_ONCE * variable.shape[0] // max(1, variable.size))
    for first in range(0, variable.shape[0], rows):
        yield _bytes(variable.isel({along: slice(first, first + rows)}).values)


def _bytes(values: np.ndarray[Any, Any]) -> bytes:
    """The same bytes for the same numbers, on any machine and from any file."""
    kind = _kind(values.dtype)
    if kind == "words":
        words = [_text(one).encode("utf-8", "surrogatepass") for one in np.ravel(values).tolist()]
        return b"".join(b"%d:%s" % (len(word), word) for word in words)
    if kind == "date":
        values = values.astype("M8[us]").astype(np.int64)
    return np.ascontiguousarray(values, values.dtype.newbyteorder("<")).tobytes()


def _text(word: object) -> str:
    return word.decode("utf-8", "replace") if isinstance(word, bytes) else str(word)

"""Zarr stores in a folder: write, read and verify.

Each chunk is shuffled and compressed by zstd with its checksum, which every reader compares. The
metadata of a store (names, sizes, types and attributes) are written twice, in the files of each
array and together in ``.zmetadata``, and an attribute of the root holds their SHA-256. Chunks with
fill values only are written too, so a missing chunk always means a loss of data; Zarr itself reads
such a chunk as the fill value.
"""

from __future__ import annotations

import hashlib
import json
import math
import os
import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from itertools import product
from pathlib import Path
from typing import Any

import numcodecs
import numpy as np
import zarr
from zarr.storage import LocalStore

from earthspin._lazy import xr
from earthspin.engine.atomic_writes import check_identity, identity, mismatch_error
from earthspin.errors import OutputError

#: Attribute of the root: SHA-256 of all other metadata.
METADATA = "metadata_sha256"
#: Entry of ``.zmetadata`` in a complete store: SHA-256 of all chunks with their places.
CHUNKS = "chunks_sha256"
#: Attribute in which xarray stores the names of the dimensions of an array.
DIMENSIONS = "_ARRAY_DIMENSIONS"
#: Options for writing. Version 3 of Zarr has no standard for arrays of text.
OPTIONS: dict[str, Any] = {"consolidated": False, "zarr_format": 2, "write_empty_chunks": True}
#: Codec of every chunk.
_CODEC = numcodecs.Zstd(level=0, checksum=True)
#: Files of the metadata of a group or an array.
_METADATA_FILES = (".zattrs", ".zgroup", ".zarray")
#: Name of the file of a chunk.
_CHUNK = re.compile(r"\d+(\.\d+)*")


# --- write ---------------------------------------------------------------------------------------


def write(groups: Mapping[str, xr.Dataset], path: Path, encoding: Mapping[str, Any]) -> None:
    """Write Datasets to the groups of a new Zarr store.

    Parameters
    ----------
    groups : mapping of str to Dataset
        Datasets by the path of their group, ``"/"`` first.
    path : Path
    encoding : mapping of str to dict
        Encoding of the variables of each group, by path; the codec is added.
    """
    for number, (group, node) in enumerate(groups.items()):
        coded = {}
        for name, entry in encoding[group].items():
            # Shuffled, the bytes of equal weight of all numbers stand side by side.
            kind, size = node.variables[name].dtype.kind, node.variables[name].dtype.itemsize
            filters = (numcodecs.Shuffle(size),) if kind in "fiuM" else ()
            coded[name] = entry | {"compressors": (_CODEC,), "filters": filters}
        mode: Any = "a" if number else "w"
        with zarr.config.set({"threading.max_workers": 1}):
            node.to_zarr(path, mode=mode, group=group, encoding=coded, **OPTIONS)


def write_region(node: xr.Dataset, store: Path, region: Mapping[str, slice]) -> None:
    """Write a Dataset into the part of a Zarr store that index ranges along dimensions select.

    Raises
    ------
    ValueError
        If the Dataset does not fit.
    """
    with zarr.config.set({"threading.max_workers": 1}):
        node.to_zarr(store, mode="r+", region=dict(region), **OPTIONS)


def lengthen(store: Path, along: str, size: int) -> None:
    """Resize all arrays of a store that have the dimension `along`, without writing data."""
    group = zarr.open_group(store, mode="r+")
    for _, array in group.arrays():
        dimensions: Any = array.attrs[DIMENSIONS]
        if along in dimensions:
            array.resize((size, *array.shape[1:]))


def seal(store: Path, attributes: Mapping[Any, Any] | None = None) -> None:
    """Set attributes of the root of a Zarr store, and store a hash of all metadata."""
    metadata = _metadata_files(store)
    metadata[".zattrs"] |= attributes or {}
    metadata[".zattrs"][METADATA] = _digest(metadata)
    _replace(store / ".zattrs", metadata[".zattrs"])


def close(store: Path) -> None:
    """Write all metadata of a complete store, and a hash of its chunks, into one file.

    The checksum of a chunk shows damage, but not that the chunk stands in another place.
    """
    metadata = metadata_of(store, closed=False)
    consolidated = {"metadata": metadata, "zarr_consolidated_format": 1}
    _replace(store / ".zmetadata", consolidated | {CHUNKS: _chunk_digest(store, metadata)})


def _replace(file: Path, content: Mapping[str, Any]) -> None:
    draft = file.with_name(f"{file.name}.partial")
    draft.write_text(json.dumps(content, indent=2))
    os.replace(draft, file)


def _metadata_files(store: Path) -> dict[str, Any]:
    """Contents of the metadata files of all groups and arrays of a store, by file name."""
    files = sorted(path for name in _METADATA_FILES for path in store.rglob(name))
    return {path.relative_to(store).as_posix(): json.loads(path.read_bytes()) for path in files}


def _chunk_digest(store: Path, metadata: Mapping[str, Any]) -> str:
    """SHA-256 of all chunks and their paths.

    Raises
    ------
    OutputError
        If a chunk is missing.
    """
    total = hashlib.sha256()
    for name in sorted(_arrays(metadata)):
        for chunk in _chunks(metadata[f"{name}/.zarray"]):
            try:
                content = (store / name / chunk).read_bytes()
            except FileNotFoundError:
                raise _missing(store, f"{name}/{chunk}") from None
            total.update(f"{name}/{chunk} {hashlib.sha256(content).hexdigest()}\n".encode())
    return total.hexdigest()


def _digest(metadata: Mapping[str, Any]) -> str:
    """SHA-256 of all metadata of a store, without the attribute that stores this hash."""
    root = {name: value for name, value in metadata[".zattrs"].items() if name != METADATA}
    return hashlib.sha256(_text({**metadata, ".zattrs": root}).encode()).hexdigest()


def _text(metadata: Mapping[str, Any]) -> str:
    return json.dumps(metadata, sort_keys=True)


# --- verify --------------------------------------------------------------------------------------


def attributes(store: Path) -> dict[str, Any]:
    """Attributes of the root group of a Zarr store, as a dict; empty if there are none."""
    if (store / ".zmetadata").exists():
        return dict(json.loads((store / ".zmetadata").read_bytes())["metadata"].get(".zattrs", {}))
    store.stat()  # raises an error if there is no store
    own = store / ".zattrs"
    return dict(json.loads(own.read_bytes())) if own.exists() else {}


def check_nodes(store: Path) -> None:
    """Open each group and array of a store that has no hash, so that a damaged one raises an error.

    Zarr opens them at the same time, reports the error of one, and logs those of others later.
    """
    for name in (".zgroup", ".zarray", "zarr.json"):
        for file in store.rglob(name):
            zarr.open(file.parent, mode="r")


def metadata_of(store: Path, *, closed: bool = True) -> dict[str, Any]:
    """Read the metadata of a store as a dict by file name, and compare them with the stored hash.

    Parameters
    ----------
    store : Path
    closed : bool
        Whether the store is complete, so that one file holds all metadata, too.

    Raises
    ------
    OutputError
        If they do not match the stored hash.
    """
    try:
        files = metadata = {} if closed else _metadata_files(store)
        if closed:
            metadata = json.loads((store / ".zmetadata").read_bytes())["metadata"]
            files = {name: json.loads((store / name).read_bytes()) for name in metadata}
        intact = _text(files) == _text(metadata) and metadata[".zattrs"][METADATA] == _digest(files)
    except (OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError):
        intact = False
    if not intact:
        raise mismatch_error(store, "its names, sizes or attributes")
    return dict(metadata)


def verify(store: Path) -> None:
    """Compare all metadata and all chunks of a complete store with their hashes.

    One chunk at a time is in memory.

    Raises
    ------
    OutputError
        If anything is missing, damaged or in another place.
    """
    digest = _chunk_digest(store, metadata_of(store))
    if json.loads((store / ".zmetadata").read_bytes()).get(CHUNKS) != digest:
        raise mismatch_error(store, "its numbers or words")


def missing_blocks(store: Path, along: str) -> set[int]:
    """Return the numbers of missing or damaged blocks of a store, and remove damaged chunks.

    Parameters
    ----------
    store : Path
    along : str
        Dimension that is divided into blocks, the first of every array that has it.

    Returns
    -------
    set of int
        Numbers of the blocks.

    Raises
    ------
    OutputError
        If what all blocks share is damaged: metadata, or arrays without blocks.
    """
    metadata, missing = metadata_of(store, closed=False), set[int]()
    for name in _arrays(metadata):
        array, in_blocks = metadata[f"{name}/.zarray"], metadata[f"{name}/.zattrs"][DIMENSIONS]
        for chunk in _chunks(array):
            file, coded = store / name / chunk, b""
            with suppress(OSError):
                coded = file.read_bytes()
            if not _is_intact(coded, array):
                if along not in in_blocks:
                    raise mismatch_error(store, "its numbers or words")
                file.unlink(missing_ok=True)
                missing.add(int(chunk.partition(".")[0]))
    return missing


def _arrays(metadata: Mapping[str, Any]) -> list[str]:
    """Paths of all arrays of a Zarr store, from the metadata of the store."""
    return [file.removesuffix("/.zarray") for file in metadata if file.endswith("/.zarray")]


def _chunks(array: Mapping[str, Any]) -> Iterator[str]:
    """Yield the file name of each chunk of an array."""
    sizes = zip(array["shape"], array["chunks"], strict=True)
    for index in product(*(range(-(-size // max(chunk, 1))) for size, chunk in sizes)):
        yield ".".join(map(str, index)) or "0"


def _is_intact(coded: bytes, array: Mapping[str, Any]) -> bool:
    """Return True if the bytes of a chunk match their checksum and have the size of a chunk."""
    length = math.prod(array["chunks"]) * np.dtype(array["dtype"]).itemsize
    try:
        decoded = numcodecs.get_codec(array["compressor"]).decode(coded)
    except Exception:  # a decoder raises many types for damaged bytes
        return False
    return bool(len(decoded) == length or array["dtype"] == "|O")


def _missing(store: Path, chunk: str) -> OutputError:
    return OutputError(store, f"the chunk '{chunk}' is missing", "write it again")


# --- read ----------------------------------------------------------------------------------------


class ZarrFolder(LocalStore):
    """Read-only Zarr store that raises an error if a chunk is missing or the store was replaced.

    Parameters
    ----------
    root : Path
    read_only : bool
        Always True; Zarr passes it when it copies a store.
    """

    def __init__(self, root: Path, *, read_only: bool = True) -> None:
        super().__init__(root, read_only=read_only)
        self._opened = identity(root)
        self._metadata = json.loads((self.root / ".zmetadata").read_bytes())["metadata"]

    async def get(self, key: str, prototype: Any = None, byte_range: Any = None) -> Any:
        """Read a file of the store; check that a chunk exists, can be decoded and has its size.

        Raises
        ------
        OutputError
            If it is a chunk that is missing or damaged, or the store was replaced.
        """
        content = await super().get(key, prototype, byte_range)
        check_identity(self.root, self._opened)
        name, _, chunk = key.rpartition("/")
        if _CHUNK.fullmatch(chunk):
            if content is None:
                raise _missing(self.root, key)
            if not _is_intact(content.to_bytes(), self._metadata[f"{name}/.zarray"]):
                raise mismatch_error(self.root, "its numbers or words")
        return content

"""Checksums (SHA-256) of result files: of all their bytes, and of their content.

Bytes: a netCDF file ends with a line that holds the checksum of every byte before it, and a Zarr
store holds a ledger of its files in the format of ``sha256sum``. Both can be checked without
earthspin::

    head -c -110 answer.nc | sha256sum; tail -n 1 answer.nc
    cd answer.zarr && sha256sum --check --quiet */SHA256SUMS

The bytes are checked before the netCDF library opens the file, because damaged tables in a file can
make that library run without end. The line follows the end of the file as the format defines it,
so other readers ignore it. The ledger is in the folder of the first array, because Zarr warns of
unknown files next to the arrays.

Content: a program that changes a netCDF file removes the line. An attribute holds a checksum of the
content, which remains in the file.
"""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np

from earthspin.errors import OutputError

if TYPE_CHECKING:
    import xarray as xr

#: Attribute of the root of a netCDF file.
CONTENT = "content_sha256"
#: Attributes with checksums of earlier versions, which are no longer checked.
EARLIER = ("header_sha256", "data_sha256", "made_in_blocks")
#: Name of the ledger in a Zarr store.
LEDGER = "SHA256SUMS"

_PREFIX = b"\nearthspin: SHA-256 of all before this line: "
#: Bytes of the last line of a netCDF file.
LENGTH = len(_PREFIX) + 64 + 1
#: Number of bytes that are read in one call.
_AT_ONCE = 1 << 20
_ENTRY = re.compile(r"([0-9a-f]{64})  (.+)")


# --- the last line of a netCDF file --------------------------------------------------------------


def append_line(path: Path) -> None:
    """Append a line to a complete file, with the checksum of all bytes before this line."""
    with path.open("r+b") as file:
        size = file.seek(0, os.SEEK_END)
        line = _line(file, size)
        file.seek(size)
        file.write(line)


def line_holds(path: Path) -> bool | None:
    """Return True if the checksum in the last line of a file matches the bytes before it.

    Parameters
    ----------
    path : Path

    Returns
    -------
    bool or None
        None if the file has no such line, because another program wrote or changed it.
    """
    with path.open("rb") as file:
        size = file.seek(0, os.SEEK_END) - LENGTH
        if size < 0:
            return None
        file.seek(size)
        line = file.read(LENGTH)
        # A line of which three quarters agree is a damaged line, not bytes of another program.
        agree = sum(byte == expected for byte, expected in zip(line, _PREFIX, strict=False))
        return line == _line(file, size) if agree > 3 * len(_PREFIX) // 4 else None


def _line(file: BinaryIO, size: int) -> bytes:
    """Make the line of text with the checksum of the first `size` bytes of a file."""
    total = hashlib.sha256()
    file.seek(0)
    while size and (piece := file.read(min(size, _AT_ONCE))):
        total.update(piece)
        size -= len(piece)
    return _PREFIX + total.hexdigest().encode("ascii") + b"\n"


# --- the ledger of a Zarr store ------------------------------------------------------------------


def files_in(store: Path) -> list[str]:
    """Sorted relative paths of all files in a Zarr store, except its checksum list."""
    files = (path for path in store.rglob("*") if path.is_file() and path.name != LEDGER)
    return sorted(path.relative_to(store).as_posix() for path in files)


def of_files(store: Path, names: Iterable[str]) -> dict[str, str]:
    """SHA-256 of files in a Zarr store, by path; empty text for a missing file."""
    sums = dict.fromkeys(names, "")
    for name in sums:
        with suppress(FileNotFoundError, NotADirectoryError), (store / name).open("rb") as file:
            sums[name] = hashlib.file_digest(file, "sha256").hexdigest()
    return sums


def entries(sums: Mapping[str, str]) -> bytes:
    """Format checksums of files as a checksum list: text with one line for each file."""
    lines = "".join(f"{digest}  {path}\n" for path, digest in sums.items())
    return lines.encode("utf-8", "surrogateescape")


def read_entries(ledger: Path) -> dict[str, str]:
    """Read the SHA-256 of each file from a checksum list; later lines replace earlier ones."""
    lines = ledger.read_bytes().decode("utf-8", "surrogateescape").split("\n")
    return {entry[2]: entry[1] for entry in filter(None, map(_ENTRY.fullmatch, lines))}


def ledger_of(store: Path) -> dict[str, str] | None:
    """Read the checksum list of a Zarr store: SHA-256 by file name; None if it has no list."""
    ledger = min(store.rglob(LEDGER), default=None)
    return None if ledger is None else read_entries(ledger)


def write_ledger(store: Path, sums: Mapping[str, str]) -> None:
    """Write the checksum list of a complete Zarr store into the folder of its first array."""
    first = min(store.rglob(".zarray"), default=None)
    if first is not None:
        first.with_name(LEDGER).write_bytes(entries(dict(sorted(sums.items()))))


def check_file(store: Path, name: str, digest: str, ledger: Mapping[str, str]) -> None:
    """Raise an error if a file of a Zarr store does not match its SHA-256 in the checksum list.

    Parameters
    ----------
    store : Path
    name : str
        Path of the file in the store.
    digest : str
        SHA-256 of the file; empty if the file is missing.
    ledger : mapping of str to str

    Raises
    ------
    OutputError
    """
    if digest == ledger.get(name, ""):
        return
    if Path(name).name.startswith("."):
        raise mismatch_error(store, "its names, sizes or attributes")
    if not digest:
        raise OutputError(store, f"the chunk '{name}' is missing", "write it again")
    raise mismatch_error(store, "its numbers or words")


def mismatch_error(path: Path, what: str) -> OutputError:
    """Make the error for a file that does not match a checksum."""
    remedy = "if they were changed on purpose, read the file with xarray.open_dataset"
    return OutputError(path, f"{what} are not what was written", remedy)


# --- content -------------------------------------------------------------------------------------


def of_content(groups: Mapping[str, xr.Dataset]) -> str:
    """SHA-256 of the values and attributes of a result, the same before writing and after reading.

    Parameters
    ----------
    groups : mapping of str to Dataset
        Groups by path, ``"/"`` for the root, whose attribute `CONTENT` is ignored.
    """
    total = hashlib.sha256()
    for group, node in sorted(groups.items()):
        _add(total, group, *_attributes(node.attrs))
        for name, variable in sorted(node.variables.items(), key=lambda item: str(item[0])):
            _add(total, str(name), str(dict(variable.sizes)), _kind(variable.dtype))
            _add(total, *_attributes(variable.attrs))
            _add(total, _bytes(variable.values))
    return total.hexdigest()


def _add(total: Any, *pieces: str | bytes) -> None:
    """Add pieces of text or bytes to a hash, together with their number and lengths."""
    total.update(b"%d;" % len(pieces))
    for piece in pieces:
        coded = piece if isinstance(piece, bytes) else piece.encode("utf-8", "surrogatepass")
        total.update(b"%d:" % len(coded))
        total.update(coded)


def _attributes(attrs: Mapping[Any, Any]) -> Iterator[str]:
    """Yield each attribute of a variable or Dataset as a line of text, sorted by name.

    A number gives the same line as a list of length one, which netCDF reads as a number.
    """
    for name, value in sorted(attrs.items()):
        if name != CONTENT:
            listed = [value] if isinstance(value, str) else np.ravel(value).tolist()
            yield f"{name} = {listed!r}"


def _kind(dtype: np.dtype[Any]) -> str:
    if dtype.kind in "OUST":
        return "words"
    return "date" if dtype.kind == "M" else f"{dtype.kind}{dtype.itemsize}"


def _bytes(values: np.ndarray[Any, Any]) -> bytes:
    """Encode values as bytes that do not depend on the machine or the file format."""
    kind = _kind(values.dtype)
    if kind == "words":
        return repr([_text(word) for word in np.ravel(values).tolist()]).encode()
    if kind == "date":
        values = values.astype("M8[us]").astype(np.int64)
    return np.ascontiguousarray(values, values.dtype.newbyteorder("<")).tobytes()


def _text(word: object) -> str:
    return word.decode("utf-8", "replace") if isinstance(word, bytes) else str(word)

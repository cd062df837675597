"""Checksums of what is stored: SHA-256 of all bytes, and of all that a file says.

Of bytes: a netCDF file of ours ends in a line with the checksum of every byte before it, and a Zarr
store holds a ledger of its files as ``sha256sum`` writes it. Both can be checked by hand::

    head -c -110 answer.nc | sha256sum; tail -n 1 answer.nc
    cd answer.zarr && sha256sum --check --quiet */SHA256SUMS

The library that reads netCDF trusts the tables of a file: damaged ones can keep it busy without
end. So the bytes are checked before it opens them. The line stands behind what the format counts as
the file, where other readers do not look; the ledger stands in the folder of the first array, since
Zarr takes a file beside the arrays for a mistake and warns of it.

Of content: another program that writes to a netCDF file cuts the line off. An attribute holds a
checksum of what is read, which remains.
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
#: Attributes of files of earlier versions, whose checksums of content are not checked any more.
EARLIER = ("header_sha256", "data_sha256", "made_in_blocks")
#: Name of the ledger in a Zarr store.
LEDGER = "SHA256SUMS"

_WORDS = b"\nearthspin: SHA-256 of all before this line: "
#: Bytes of the last line of a netCDF file.
LENGTH = len(_WORDS) + 64 + 1
#: Bytes that are read at once.
_AT_ONCE = 1 << 20
_ENTRY = re.compile(r"([0-9a-f]{64})  (.+)")


# --- the last line of a netCDF file --------------------------------------------------------------


def append_line(path: Path) -> None:
    """Append the checksum of its bytes to a file that is complete."""
    with path.open("r+b") as file:
        size = file.seek(0, os.SEEK_END)
        line = _line(file, size)
        file.seek(size)
        file.write(line)


def line_holds(path: Path) -> bool | None:
    """Whether the last line of a file matches the bytes before it.

    Parameters
    ----------
    path : Path

    Returns
    -------
    bool or None
        None for a file without such a line: another program's, or one that it has written to.
    """
    with path.open("rb") as file:
        size = file.seek(0, os.SEEK_END) - LENGTH
        if size < 0:
            return None
        file.seek(size)
        line = file.read(LENGTH)
        # Damaged words are ours still: by chance three of them in four agree nowhere.
        agree = sum(one == other for one, other in zip(line, _WORDS, strict=False))
        return line == _line(file, size) if agree > 3 * len(_WORDS) // 4 else None


def _line(file: BinaryIO, size: int) -> bytes:
    """The line that belongs behind the first `size` bytes of a file."""
    total = hashlib.sha256()
    file.seek(0)
    while size and (piece := file.read(min(size, _AT_ONCE))):
        total.update(piece)
        size -= len(piece)
    return _WORDS + total.hexdigest().encode("ascii") + b"\n"


# --- the ledger of a Zarr store ------------------------------------------------------------------


def files_in(store: Path) -> list[str]:
    """Paths of all files in a Zarr store but its ledger, in order."""
    files = (path for path in store.rglob("*") if path.is_file() and path.name != LEDGER)
    return sorted(path.relative_to(store).as_posix() for path in files)


def of_files(store: Path, names: Iterable[str]) -> dict[str, str]:
    """SHA-256 of files in a Zarr store by their paths; empty for one that is not there."""
    sums = dict.fromkeys(names, "")
    for name in sums:
        with suppress(FileNotFoundError, NotADirectoryError), (store / name).open("rb") as file:
            sums[name] = hashlib.file_digest(file, "sha256").hexdigest()
    return sums


def entries(sums: Mapping[str, str]) -> bytes:
    """Lines of a ledger."""
    lines = "".join(f"{digest}  {path}\n" for path, digest in sums.items())
    return lines.encode("utf-8", "surrogateescape")


def read_entries(ledger: Path) -> dict[str, str]:
    """SHA-256 of each file by its path, as the lines of a ledger say; of two lines, the last."""
    lines = ledger.read_bytes().decode("utf-8", "surrogateescape").split("\n")
    return {entry[2]: entry[1] for entry in filter(None, map(_ENTRY.fullmatch, lines))}


def ledger_of(store: Path) -> dict[str, str] | None:
    """SHA-256 of each file of a Zarr store as its ledger says; None if it has no ledger."""
    ledger = min(store.rglob(LEDGER), default=None)
    return None if ledger is None else read_entries(ledger)


def write_ledger(store: Path, sums: Mapping[str, str]) -> None:
    """Write the ledger of a complete store into the folder of its first array."""
    first = min(store.rglob(".zarray"), default=None)
    if first is not None:
        first.with_name(LEDGER).write_bytes(entries(dict(sorted(sums.items()))))


def check_file(store: Path, name: str, digest: str, ledger: Mapping[str, str]) -> None:
    """Refuse a file of a Zarr store that is not the one in its ledger.

    Parameters
    ----------
    store : Path
    name : str
        Path of the file in the store.
    digest : str
        Its SHA-256; empty if it is not there.
    ledger : mapping of str to str

    Raises
    ------
    OutputError
    """
    if digest == ledger.get(name, ""):
        return
    if Path(name).name.startswith("."):
        raise changed(store, "its names, sizes or attributes")
    if not digest:
        raise OutputError(store, f"the chunk '{name}' is missing", "write it again")
    raise changed(store, "its numbers or words")


def changed(path: Path, what: str) -> OutputError:
    """What is said of a file that does not match a checksum."""
    remedy = "if they were changed on purpose, read it with xarray.open_dataset"
    return OutputError(path, f"{what} are not what was written", remedy)


# --- content -------------------------------------------------------------------------------------


def of_content(groups: Mapping[str, xr.Dataset]) -> str:
    """SHA-256 of all that a file says, the same before it is written and after it is read.

    Parameters
    ----------
    groups : mapping of str to Dataset
        By path, ``"/"`` for the root; an attribute `CONTENT` of it does not count.
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
    """Add pieces with their number and lengths, so that no two lists of pieces are alike."""
    total.update(b"%d;" % len(pieces))
    for piece in pieces:
        coded = piece if isinstance(piece, bytes) else piece.encode("utf-8", "surrogatepass")
        total.update(b"%d:" % len(coded))
        total.update(coded)


def _attributes(attrs: Mapping[Any, Any]) -> Iterator[str]:
    """A line for each attribute, in order of names; lists of one are what netCDF makes of them."""
    for name, value in sorted(attrs.items()):
        if name != CONTENT:
            listed = [value] if isinstance(value, str) else np.ravel(value).tolist()
            yield f"{name} = {listed!r}"


def _kind(dtype: np.dtype[Any]) -> str:
    if dtype.kind in "OUST":
        return "words"
    return "date" if dtype.kind == "M" else f"{dtype.kind}{dtype.itemsize}"


def _bytes(values: np.ndarray[Any, Any]) -> bytes:
    """The same bytes for the same numbers, on any machine and from any file."""
    kind = _kind(values.dtype)
    if kind == "words":
        return repr([_text(word) for word in np.ravel(values).tolist()]).encode()
    if kind == "date":
        values = values.astype("M8[us]").astype(np.int64)
    return np.ascontiguousarray(values, values.dtype.newbyteorder("<")).tobytes()


def _text(word: object) -> str:
    return word.decode("utf-8", "replace") if isinstance(word, bytes) else str(word)

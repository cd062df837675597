"""Unfinished Zarr stores: blocks are written in any order, and interrupted runs are resumed.

While a store ``X.zarr`` is not complete, a folder ``X.zarr.partial`` next to it holds the store,
whose arrays have their full length from the beginning; the request that it answers (`REQUEST`); and
two ledgers in the format of ``sha256sum``: one of the files that no block writes (`FRAME`), one of
the files of all blocks that are written and on the disk (`LEDGER`). A run of the same request
continues with the blocks that are not in the ledger. A run of another request is refused, and
nothing is changed. Before blocks are added, and before the store is moved to ``X.zarr``, all files
are compared with the ledgers, and blocks whose bytes do not match are made again. The complete
store holds both ledgers as one.

A block is a chunk of every variable along one dimension, so no two writers share a chunk, and a
block that is made again has the same bytes. The store holds no date, no run time and no path.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING

from filelock import FileLock, Timeout

from earthspin.engine import drafts
from earthspin.engine.checksums import entries, files_in, of_files, read_entries, write_ledger
from earthspin.engine.store import MADE_OF, ZARR, encoding_of, spelled, zarr_of
from earthspin.errors import OutputError, one_line

if TYPE_CHECKING:
    import xarray as xr

#: Suffix of the folder of an unfinished store.
PARTIAL = ".partial"
#: Names in the folder: the store, the request, the lock of the running process, the ledger of the
#: finished blocks, and the ledger of the files that no block writes.
STORE, REQUEST, OWNER, LEDGER, FRAME = "store", "asked.json", "owner", "ledger", "frame"


@dataclass(frozen=True)
class Layout:
    """Division of a Zarr store into blocks along one dimension.

    Attributes
    ----------
    along : str
        The dimension that is divided, the first of every variable that has it.
    size : int
        Length of this dimension.
    block : int
        Length of a block; the last block may be shorter.
    """

    along: str
    size: int
    block: int

    @property
    def count(self) -> int:
        """Number of blocks into which the store is divided."""
        return -(-self.size // self.block)

    def bounds(self, number: int) -> tuple[int, int]:
        """Index at which a block begins, and index after its end, along the divided dimension."""
        return number * self.block, min((number + 1) * self.block, self.size)

    def length(self, number: int) -> int:
        """Length of a block along the divided dimension."""
        first, last = self.bounds(number)
        return last - first


class Unfinished:
    """A partly written Zarr store, which one process has locked.

    Parameters
    ----------
    folder : Path
        Folder whose name ends in `PARTIAL`.
    layout : Layout

    Attributes
    ----------
    done : dict of int to dict of str to str
        SHA-256 of the files of each finished block, by number of the block and path of the file.

    Raises
    ------
    OutputError
        If a file that no block writes is not what `begin` wrote.
    """

    def __init__(self, folder: Path, layout: Layout) -> None:
        self.folder, self.layout, self.store = folder, layout, folder / STORE
        self.check_frame()
        grown, written = (
            _variables_in_blocks(self.store, layout.along),
            _read_ledger(folder / LEDGER),
        )
        blocks = {number: _files(grown, number) for number in range(layout.count)}
        self.done = {
            number: {name: written[name] for name in files}
            for number, files in blocks.items()
            if written.keys() >= set(files)
        }

    @property
    def missing(self) -> list[int]:
        """Numbers of the blocks of the store that are not yet finished."""
        return [n for n in range(self.layout.count) if n not in self.done]

    @property
    def length(self) -> int:
        """Number of finished epochs or members: total length of the finished blocks."""
        return sum(map(self.layout.length, self.done))

    def note(self, number: int, sums: Mapping[str, str]) -> None:
        """Record that a block is on the disk, with the checksums of its files."""
        if number not in self.done:
            self.done[number] = dict(sums)
            _append_to_ledger(self.folder / LEDGER, sums)

    def check_frame(self) -> None:
        """Raise an error if files outside the blocks have changed since `begin` wrote them.

        Raises
        ------
        OutputError
        """
        try:
            frame = entries(_frame_checksums(self.store, self.layout.along))
            intact = (self.folder / FRAME).read_bytes() == frame
        except (OSError, ValueError, AttributeError, TypeError):
            intact = False
        if not intact:
            raise _damaged(self.folder, "its names, sizes or attributes are")

    def drop_damaged(self) -> list[int]:
        """Discard blocks whose files do not match their checksums; return their numbers.

        Raises
        ------
        OutputError
            If a file that no block writes is damaged.
        """
        self.check_frame()
        damaged = [
            number
            for number, sums in sorted(self.done.items())
            if not all(sums.values()) or of_files(self.store, sums) != sums
        ]
        for number in damaged:
            for name in self.done.pop(number):
                (self.store / name).unlink(missing_ok=True)
        return damaged

    def finish(self, place: Path) -> None:
        """Complete the store: write its checksum list, and move it to `place`."""
        for stray in self.store.rglob("*.partial"):  # a chunk whose writer was killed
            stray.unlink()
        sums = _frame_checksums(self.store, self.layout.along)
        for block in self.done.values():
            sums |= block
        write_ledger(self.store, sums)
        with drafts.box_of(place) as box:
            drafts.put_in_place(self.store, place, box)
        shutil.rmtree(self.folder)


def write_block(folder: Path, layout: Layout, number: int, block: xr.Dataset) -> dict[str, str]:
    """Write one block into an unfinished store; return when it is safely on the disk.

    Parameters
    ----------
    folder : Path
        Folder whose name ends in `PARTIAL`.
    layout : Layout
    number : int
    block : Dataset

    Returns
    -------
    dict of str to str
        SHA-256 of each of its files, for the ledger.

    Raises
    ------
    OutputError
        If the folder does not exist, or the block does not fit into the store.
    """
    zarr, store = zarr_of(), folder / STORE
    if not store.is_dir():
        raise OutputError(folder, "it was removed while it was written", "run it again")
    constant = [n for n, variable in block.variables.items() if layout.along not in variable.dims]
    # With an index, to_zarr would not write the coordinate along the region.
    grown = block.drop_vars(constant).drop_indexes(layout.along, errors="ignore")
    region = {layout.along: slice(*layout.bounds(number))}
    try:
        with zarr.config.set({"threading.max_workers": 1}):
            grown.to_zarr(store, mode="r+", region=region, **ZARR)
    except ValueError as error:
        raise OutputError(folder, f"block {number} does not fit: {one_line(error)}") from None
    files = _files(_variables_in_blocks(store, layout.along), number)
    for name in files:
        drafts.sync_one(store / name)
    return of_files(store, files)


def _variables_in_blocks(store: Path, along: str) -> dict[str, int]:
    """Number of dimensions, by name, of each variable that is written in blocks."""
    dims = {
        path.parent.name: json.loads(path.read_bytes()).get("_ARRAY_DIMENSIONS", ())
        for path in sorted(store.glob("*/.zattrs"))
    }
    return {name: len(names) for name, names in dims.items() if along in names}


def _files(grown: Mapping[str, int], number: int) -> list[str]:
    """Paths of the files that hold one block, in an unfinished store."""
    return [f"{name}/{number}{'.0' * (dims - 1)}" for name, dims in grown.items()]


def _frame_checksums(store: Path, along: str) -> dict[str, str]:
    """SHA-256 of those files of a store that do not belong to any block."""
    grown = _variables_in_blocks(store, along)
    paths = map(PurePosixPath, files_in(store))
    frame = [p for p in paths if p.name.startswith(".") or p.parent.name not in grown]
    return of_files(store, map(str, frame))


@contextmanager
def locked_folder(place: Path, request: Mapping[str, str]) -> Iterator[Path | None]:
    """Lock and yield the folder of a partly written Zarr store; yield None if it is missing.

    Parameters
    ----------
    place : Path
        Path of the complete store.
    request : mapping of str to str
        Record of the question and of the versions.

    Yields
    ------
    Path or None
        None if there is no unfinished store.

    Raises
    ------
    OutputError
        If the store was begun for another request, or another run has locked it.
    """
    folder = place.with_name(place.name + PARTIAL)
    if not folder.exists():
        yield None
        return
    lock = FileLock(folder / OWNER, blocking=False)
    try:
        lock.acquire()
    except Timeout:
        remedy = "wait for that run, or stop it"
        raise OutputError(place, "another run is writing it", remedy) from None
    try:
        _refuse_another(folder, dict(request))
        yield folder
    finally:
        lock.release()


def _refuse_another(folder: Path, request: dict[str, str]) -> None:
    """Raise an error if a store was begun for another question, version or layout."""
    try:
        begun = json.loads((folder / REQUEST).read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        begun = None
    if not isinstance(begun, dict):
        raise _damaged(folder, f"its {REQUEST} is")
    differ = [name for name in request | begun if request.get(name) != begun.get(name)]
    if differ:
        what = " and ".join(name.replace("_", " ") for name in differ)
        problem = f"it was begun with another {what}"
        raise OutputError(folder, problem, "finish that run, or move the folder away")


def _damaged(folder: Path, what: str) -> OutputError:
    return OutputError(folder, f"{what} not what was written", "remove it and run it again")


def begin(place: Path, request: Mapping[str, str], layout: Layout, first: xr.Dataset) -> None:
    """Create a Zarr store of full length, in which only the first block is written.

    Parameters
    ----------
    place : Path
    request : mapping of str to str
    layout : Layout
    first : Dataset
        Block 0, with the attributes of the whole result.

    Raises
    ------
    OutputError
        If the complete store does not fit on the disk.
    """
    whole = first.nbytes / layout.length(0) * layout.size
    drafts.refuse_what_does_not_fit(place, whole, f"{layout.size} {layout.along}s")
    zarr = zarr_of()
    node = spelled(first).assign_attrs({MADE_OF: digest(request)})
    with drafts.box_of(place) as box:
        folder = box / "begun"
        folder.mkdir()
        store = folder / STORE
        with zarr.config.set({"threading.max_workers": 1}):
            encoding = encoding_of(node, chunked=layout.along)
            node.to_zarr(store, mode="w", encoding=encoding, **ZARR)
            group, grown = (
                zarr.open_group(store, mode="r+"),
                _variables_in_blocks(store, layout.along),
            )
            for name in grown:
                group[name].resize((layout.size, *group[name].shape[1:]))
        (folder / REQUEST).write_text(json.dumps(dict(request), indent=1), encoding="utf-8")
        (folder / FRAME).write_bytes(entries(_frame_checksums(store, layout.along)))
        _append_to_ledger(folder / LEDGER, of_files(store, _files(grown, 0)))
        drafts.sync(folder)
        partial = place.with_name(place.name + PARTIAL)
        if not partial.exists():  # another run may have created it since
            os.rename(folder, partial)
            drafts.sync_one(place.parent)


def digest(request: Mapping[str, str]) -> str:
    """SHA-256 of the texts that identify a run; a complete store holds it as an attribute."""
    return hashlib.sha256(json.dumps(dict(request), sort_keys=True).encode()).hexdigest()


def _append_to_ledger(ledger: Path, sums: Mapping[str, str]) -> None:
    """Append the checksums of a block to the list of finished blocks, safely on the disk."""
    with ledger.open("ab") as file:
        file.write(entries(sums))
        file.flush()
        os.fsync(file.fileno())


def _read_ledger(ledger: Path) -> dict[str, str]:
    """Read the SHA-256 of the finished files of an unfinished store, by path.

    A last line that is incomplete because its writer was ended is removed. Damaged lines are
    ignored, so their blocks are made again.
    """
    ledger.touch()
    os.truncate(ledger, ledger.read_bytes().rfind(b"\n") + 1)
    return read_entries(ledger)

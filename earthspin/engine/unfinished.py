"""Unfinished Zarr stores: blocks are written in any order, and interrupted runs are resumed.

While a store ``X.zarr`` is not complete, a folder ``X.zarr.partial`` next to it holds the store,
whose arrays have their full length from the beginning, the request that it answers (`REQUEST`), and
the lock of the process that writes it. A run of the same request continues with the blocks that are
not done; a run of another request is refused, and nothing is changed.

A block is a chunk of every variable along one dimension, so no two writers share a chunk. Zarr
writes a chunk in one step, with its checksum. So the chunks show which blocks are done: those whose
chunks are present and match their checksums. A block that is made again has the same bytes. The
store holds no date, no run time and no path.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from earthspin.engine import drafts
from earthspin.engine.store import FORMAT, MADE_OF, VERSION, encoding_of, spelled
from earthspin.errors import OutputError, one_line

if TYPE_CHECKING:
    import xarray as xr

#: Suffix of the folder of an unfinished store.
PARTIAL = ".partial"
#: Names in the folder: the store, the request, and a store whose first block is being written.
STORE, REQUEST, _DRAFT = "store", "asked.json", "begun"


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
    """A partly written Zarr store, in a folder that this process has locked.

    Parameters
    ----------
    folder : Path
        Folder whose name ends in `PARTIAL`.
    layout : Layout

    Attributes
    ----------
    missing : list of int
        Numbers of the blocks that are not done. Their damaged chunks are removed.
    length : int
        Number of finished epochs or members: total length of the finished blocks.

    Raises
    ------
    OutputError
        If the metadata, or a variable that is not written in blocks, is damaged.
    """

    def __init__(self, folder: Path, layout: Layout) -> None:
        from earthspin.engine import zarr_folder

        self.folder, self.layout, self.store = folder, layout, folder / STORE
        try:
            metadata = zarr_folder.verify(self.store, besides=layout.along)
        except OutputError:
            raise _damaged(folder, "what its blocks share is") from None
        self.missing = list[int]()
        for number in range(layout.count):
            damaged = zarr_folder.damaged_chunks(self.store, metadata, layout.along, number)
            for chunk in damaged:
                (self.store / chunk).unlink(missing_ok=True)
            if damaged:
                self.missing.append(number)
        self.length = layout.size - sum(map(layout.length, self.missing))

    def finish(self, target: Path) -> None:
        """Verify the complete store, and move it to its target.

        Raises
        ------
        OutputError
            If a file differs from what was written; the next run makes its block again.
        """
        from earthspin.engine import zarr_folder

        for stray in self.store.rglob("*.partial"):  # a chunk whose writer was killed
            stray.unlink()
        try:
            zarr_folder.verify(self.store)
        except OutputError:
            problem = "a block differs from what was just written"
            raise OutputError(self.folder, problem, "check the disk and run it again") from None
        drafts.put_in_place(self.store, target, self.folder)
        drafts.remove(self.folder)


def write_block(folder: Path, layout: Layout, number: int, block: xr.Dataset) -> None:
    """Write one block into an unfinished store.

    Parameters
    ----------
    folder : Path
        Folder whose name ends in `PARTIAL`.
    layout : Layout
    number : int
    block : Dataset

    Raises
    ------
    OutputError
        If the folder does not exist, or the block does not fit into the store.
    """
    from earthspin.engine import zarr_folder

    store = folder / STORE
    if not store.is_dir():
        raise OutputError(folder, "it was removed while it was written", "run it again")
    constant = [n for n, variable in block.variables.items() if layout.along not in variable.dims]
    # With an index, to_zarr would not write the coordinate along the region.
    grown = block.drop_vars(constant).drop_indexes(layout.along, errors="ignore")
    try:
        zarr_folder.write_region(grown, store, {layout.along: slice(*layout.bounds(number))})
    except ValueError as error:
        raise OutputError(folder, f"block {number} does not fit: {one_line(error)}") from None


@contextmanager
def claimed(target: Path) -> Iterator[Path]:
    """Lock and yield the folder of an unfinished store; remove it at the end if none was begun.

    Parameters
    ----------
    target : Path
        Path of the complete store.

    Raises
    ------
    OutputError
        If another run has locked it.
    """
    folder = target.with_name(target.name + PARTIAL)
    with drafts.claimed(folder, target):
        try:
            yield folder
        finally:
            if not _is_begun(folder):
                drafts.remove(folder)


def _is_begun(folder: Path) -> bool:
    """Return True if a folder holds more than the lock and the draft of a store."""
    return folder.exists() and not {path.name for path in folder.iterdir()} <= {drafts.LOCK, _DRAFT}


def refuse_another(folder: Path, request: Mapping[str, str]) -> None:
    """Raise an error if a store was begun for another question, version or layout.

    Raises
    ------
    OutputError
    """
    if not _is_begun(folder):
        return
    try:
        begun = json.loads((folder / REQUEST).read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        begun = None
    if not isinstance(begun, dict):
        raise _damaged(folder, f"its {REQUEST} is")
    differ = [name for name in {**request, **begun} if request.get(name) != begun.get(name)]
    if differ:
        what = " and ".join(name.replace("_", " ") for name in differ)
        problem = f"it was begun with another {what}"
        raise OutputError(folder, problem, "finish that run, or move the folder away")


def _damaged(folder: Path, what: str) -> OutputError:
    return OutputError(folder, f"{what} not what was written", "remove it and run it again")


def begin(folder: Path, request: Mapping[str, str], layout: Layout, first: xr.Dataset) -> None:
    """Create a Zarr store of full length, in which only the first block is written.

    Parameters
    ----------
    folder : Path
        Folder whose name ends in `PARTIAL`.
    request : mapping of str to str
    layout : Layout
    first : Dataset
        Block 0, with the attributes of the whole result.

    Raises
    ------
    OutputError
        If the complete store does not fit on the disk.
    """
    from earthspin.engine import zarr_folder

    whole = first.nbytes / layout.length(0) * layout.size
    drafts.refuse_what_does_not_fit(folder, whole, f"{layout.size} {layout.along}s")
    node = spelled(first).assign_attrs({FORMAT: VERSION, MADE_OF: digest(request)})
    encoding = encoding_of(node)
    for name, variable in node.variables.items():
        if layout.along in variable.dims:
            encoding[str(name)]["chunks"] = variable.shape
    draft = folder / _DRAFT
    drafts.remove(draft)
    zarr_folder.write({"/": node}, draft, {"/": encoding})
    zarr_folder.lengthen(draft, layout.along, layout.size)
    zarr_folder.seal(draft)
    (folder / REQUEST).write_text(json.dumps(dict(request), indent=1), encoding="utf-8")
    os.rename(draft, folder / STORE)


def digest(request: Mapping[str, str]) -> str:
    """SHA-256 of the texts that identify a run; a complete store holds it as an attribute."""
    return hashlib.sha256(json.dumps(dict(request), sort_keys=True).encode()).hexdigest()

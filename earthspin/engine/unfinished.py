"""A store in the making: block by block, in any order, gone on with after any end.

Beside the place of the store, ``X.zarr``, stands the folder ``X.zarr.partial`` as long as it is not
complete. In it are the store, whose arrays have their full length from the beginning; what it is
the answer to (`ASKED`); and two ledgers as ``sha256sum`` writes them: of the files that no block
writes (`FRAME`), and of those of each block that is written and on the disk (`LEDGER`). Whoever
asks the same again goes on with the blocks that are not in the ledger; whoever asks something else
is refused, and nothing is touched. Before anything is added, and before the store takes its place,
all of it is compared with the ledgers: a block whose bytes do not match is made again. The complete
store holds both as its ledger.

A block is a chunk of every variable along one dimension, so that no two writers share a chunk, and
a block that is made again is the same bytes again. The store holds no date, no seconds and no path.
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

#: Ending of the folder of a store that is not complete.
PARTIAL = ".partial"
#: What it holds: the store, what it answers, the lock of its owner, and the ledgers of the blocks
#: that are done and of the files that no block writes.
STORE, ASKED, OWNER, LEDGER, FRAME = "store", "asked.json", "owner", "ledger", "frame"


@dataclass(frozen=True)
class Layout:
    """How a store is cut.

    Attributes
    ----------
    along : str
        The dimension that grows, the first of every variable that has it.
    size : int
        Its length.
    block : int
        Length of a block; the last one may be shorter.
    """

    along: str
    size: int
    block: int

    @property
    def count(self) -> int:
        """How many blocks there are."""
        return -(-self.size // self.block)

    def bounds(self, number: int) -> tuple[int, int]:
        """First index of a block, and the first after it."""
        return number * self.block, min((number + 1) * self.block, self.size)

    def length(self, number: int) -> int:
        """Length of a block."""
        first, last = self.bounds(number)
        return last - first


class Unfinished:
    """A store in the making, held by one writer.

    Parameters
    ----------
    folder : Path
        That ends in `PARTIAL`.
    layout : Layout

    Attributes
    ----------
    done : dict of int to dict of str to str
        SHA-256 of the files of each block that is written, by its number and their paths.

    Raises
    ------
    OutputError
        If a file that no block writes is not what `begin` wrote.
    """

    def __init__(self, folder: Path, layout: Layout) -> None:
        self.folder, self.layout, self.store = folder, layout, folder / STORE
        self.check_frame()
        grown, written = _grown(self.store, layout.along), _read_ledger(folder / LEDGER)
        blocks = {number: _files(grown, number) for number in range(layout.count)}
        self.done = {
            number: {name: written[name] for name in files}
            for number, files in blocks.items()
            if written.keys() >= set(files)
        }

    @property
    def missing(self) -> list[int]:
        """Numbers of the blocks that are still to be made."""
        return [n for n in range(self.layout.count) if n not in self.done]

    @property
    def length(self) -> int:
        """Length of the blocks that are written."""
        return sum(map(self.layout.length, self.done))

    def note(self, number: int, sums: Mapping[str, str]) -> None:
        """Put a block that is written and on the disk into the ledger."""
        if number not in self.done:
            self.done[number] = dict(sums)
            _append(self.folder / LEDGER, sums)

    def check_frame(self) -> None:
        """Refuse a store in which a file that no block writes is not what `begin` wrote.

        Raises
        ------
        OutputError
        """
        try:
            frame = entries(_frame(self.store, self.layout.along))
            intact = (self.folder / FRAME).read_bytes() == frame
        except (OSError, ValueError, AttributeError, TypeError):
            intact = False
        if not intact:
            raise _damaged(self.folder, "its names, sizes or attributes are")

    def drop_damaged(self) -> list[int]:
        """Drop the blocks whose bytes do not match the ledger, and return their numbers.

        Raises
        ------
        OutputError
            If more than blocks is damaged.
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
        """Give the store its ledger and put it in its place."""
        for stray in self.store.rglob("*.partial"):  # a chunk whose writer was killed
            stray.unlink()
        sums = _frame(self.store, self.layout.along)
        for block in self.done.values():
            sums |= block
        write_ledger(self.store, sums)
        with drafts.box_of(place) as box:
            drafts.put_in_place(self.store, place, box)
        shutil.rmtree(self.folder)


def write_block(folder: Path, layout: Layout, number: int, block: xr.Dataset) -> dict[str, str]:
    """Write one block into a store in the making, and see it to the disk.

    Parameters
    ----------
    folder : Path
        That ends in `PARTIAL`.
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
        If the folder is gone, or the block does not fit into the store.
    """
    zarr, store = zarr_of(), folder / STORE
    if not store.is_dir():
        raise OutputError(folder, "it was taken away while it was written", "run it again")
    apart = [n for n, variable in block.variables.items() if layout.along not in variable.dims]
    grown = block.drop_vars(apart).drop_indexes(layout.along, errors="ignore")  # else left out
    region = {layout.along: slice(*layout.bounds(number))}
    try:
        with zarr.config.set({"threading.max_workers": 1}):
            grown.to_zarr(store, mode="r+", region=region, **ZARR)
    except ValueError as error:
        raise OutputError(folder, f"block {number} does not fit: {one_line(error)}") from None
    files = _files(_grown(store, layout.along), number)
    for name in files:
        drafts.sync_one(store / name)
    return of_files(store, files)


def _grown(store: Path, along: str) -> dict[str, int]:
    """Number of dimensions of each variable that blocks write, by its name."""
    dims = {
        path.parent.name: json.loads(path.read_bytes()).get("_ARRAY_DIMENSIONS", ())
        for path in sorted(store.glob("*/.zattrs"))
    }
    return {name: len(names) for name, names in dims.items() if along in names}


def _files(grown: Mapping[str, int], number: int) -> list[str]:
    """Paths of the files of a block."""
    return [f"{name}/{number}{'.0' * (dims - 1)}" for name, dims in grown.items()]


def _frame(store: Path, along: str) -> dict[str, str]:
    """SHA-256 of the files of a store that no block writes."""
    grown = _grown(store, along)
    paths = map(PurePosixPath, files_in(store))
    frame = [p for p in paths if p.name.startswith(".") or p.parent.name not in grown]
    return of_files(store, map(str, frame))


@contextmanager
def held(place: Path, asked: Mapping[str, str]) -> Iterator[Path | None]:
    """Hold the folder of the store in the making that belongs to a place, if there is one.

    Parameters
    ----------
    place : Path
        Where the complete store shall stand.
    asked : mapping of str to str
        What is asked, and of which versions.

    Yields
    ------
    Path or None
        None if nothing was begun.

    Raises
    ------
    OutputError
        If something else was asked there, or another run holds it.
    """
    folder = place.with_name(place.name + PARTIAL)
    if not folder.exists():
        yield None
        return
    lock = FileLock(folder / OWNER, blocking=False)
    try:
        lock.acquire()
    except Timeout:
        raise OutputError(place, "another run is writing it", "let it end, or stop it") from None
    try:
        _refuse_another(folder, dict(asked))
        yield folder
    finally:
        lock.release()


def _refuse_another(folder: Path, asked: dict[str, str]) -> None:
    """Refuse to go on with a store of another question, another version or another layout."""
    try:
        begun = json.loads((folder / ASKED).read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        begun = None
    if not isinstance(begun, dict):
        raise _damaged(folder, f"its {ASKED} is")
    differ = [name for name in asked | begun if asked.get(name) != begun.get(name)]
    if differ:
        what = " and ".join(name.replace("_", " ") for name in differ)
        words = f"it was begun with another {what}"
        raise OutputError(folder, words, "finish that, or move it away")


def _damaged(folder: Path, what: str) -> OutputError:
    return OutputError(folder, f"{what} not what was written", "take it away and run it again")


def begin(place: Path, asked: Mapping[str, str], layout: Layout, first: xr.Dataset) -> None:
    """Lay out a store in the making around its first block.

    Parameters
    ----------
    place : Path
    asked : mapping of str to str
    layout : Layout
    first : Dataset
        Block 0, with the attributes of the whole.

    Raises
    ------
    OutputError
        If the disk has no room for it.
    """
    whole = first.nbytes / layout.length(0) * layout.size
    drafts.refuse_what_does_not_fit(place, whole, f"{layout.size} {layout.along}s")
    zarr = zarr_of()
    node = spelled(first).assign_attrs({MADE_OF: digest(asked)})
    with drafts.box_of(place) as box:
        folder = box / "begun"
        folder.mkdir()
        store = folder / STORE
        with zarr.config.set({"threading.max_workers": 1}):
            encoding = encoding_of(node, chunked=layout.along)
            node.to_zarr(store, mode="w", encoding=encoding, **ZARR)
            group, grown = zarr.open_group(store, mode="r+"), _grown(store, layout.along)
            for name in grown:
                group[name].resize((layout.size, *group[name].shape[1:]))
        (folder / ASKED).write_text(json.dumps(dict(asked), indent=1), encoding="utf-8")
        (folder / FRAME).write_bytes(entries(_frame(store, layout.along)))
        _append(folder / LEDGER, of_files(store, _files(grown, 0)))
        drafts.sync(folder)
        partial = place.with_name(place.name + PARTIAL)
        if not partial.exists():  # another run may have been faster
            os.rename(folder, partial)
            drafts.sync_one(place.parent)


def digest(asked: Mapping[str, str]) -> str:
    """One word for what is asked, which a complete store carries."""
    return hashlib.sha256(json.dumps(dict(asked), sort_keys=True).encode()).hexdigest()


def _append(ledger: Path, sums: Mapping[str, str]) -> None:
    """Add the lines of a block, and see them to the disk."""
    with ledger.open("ab") as file:
        file.write(entries(sums))
        file.flush()
        os.fsync(file.fileno())


def _read_ledger(ledger: Path) -> dict[str, str]:
    """SHA-256 of the files that the ledger has, by their paths.

    A last line that was cut short by the end of its writer is taken away. A line that is damaged
    counts for nothing, so that its block is made again.
    """
    ledger.touch()
    os.truncate(ledger, ledger.read_bytes().rfind(b"\n") + 1)
    return read_entries(ledger)

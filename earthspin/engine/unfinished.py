"""A store in the making: block by block, in any order, gone on with after any end.

Beside the place of the store, ``X.zarr``, stands the folder ``X.zarr.partial`` as long as it is not
complete. In it are the store, whose arrays have their full length from the beginning; what it is
the answer to (`ASKED`); and a ledger with a line for each block that is written and on the disk.
Whoever asks the same again goes on with the blocks that are not in the ledger; whoever asks
something else is refused, and nothing is touched. When the last block is in the ledger, the store
gets its checksums and takes its place in one step.

A block is a chunk of every variable along one dimension, so that no two writers share a chunk, and
a block that is made again is the same bytes again. The store holds no date, no seconds and no path.
"""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from earthspin.engine import drafts
from earthspin.engine.checksums import BLOCKS, Checksum, of_block
from earthspin.engine.store import MADE_OF, TIME_ENCODING, ZARR, spelled, zarr_encoding, zarr_of
from earthspin.errors import OutputError

if TYPE_CHECKING:
    import xarray as xr

#: Ending of the folder of a store that is not complete.
PARTIAL = ".partial"
#: What it holds: the store, what it answers, the blocks that are done, and the lock of its owner.
STORE, ASKED, LEDGER, OWNER = "store", "asked.json", "ledger", "owner"


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
        Checksum of each of its variables, for the ledger.

    Raises
    ------
    OutputError
        If the folder is gone, or the block does not fit into the store.
    """
    zarr, store = zarr_of(), folder / STORE
    if not store.is_dir():
        raise OutputError(folder, "it was taken away while it was written", "run it again")
    first, last = layout.bounds(number)
    with zarr.config.set({"threading.max_workers": 1, "array.write_empty_chunks": True}):
        group = zarr.open_group(store, mode="r+", zarr_format=ZARR["zarr_format"])
        for name, variable in block.variables.items():
            if layout.along not in variable.dims:
                continue
            array = group[str(name)]
            if variable.shape[1:] != array.shape[1:]:
                raise OutputError(folder, f"block {number} has another shape of '{name}'")
            array[first:last] = _as_stored(variable.values)
            chunk = ".".join([str(number), *["0"] * (variable.ndim - 1)])
            drafts.sync_one(store / str(name) / chunk)
    return of_block(block, layout.along)


def _as_stored(values: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """Numbers as the store holds them: dates as microseconds from the date of `TIME_ENCODING`."""
    if values.dtype.kind != "M":
        return values
    begin = np.datetime64(str(TIME_ENCODING["units"]).split()[-1], "us")
    return (values.astype("M8[us]") - begin).astype(np.int64)


class Unfinished:
    """A store in the making, held by one writer.

    Attributes
    ----------
    folder : Path
    layout : Layout
    done : dict of int to dict
        Checksums of each block that is written, by its number.
    """

    def __init__(self, folder: Path, layout: Layout) -> None:
        self.folder, self.layout = folder, layout
        self.done = _read_ledger(folder / LEDGER)

    @property
    def missing(self) -> list[int]:
        """Numbers of the blocks that are still to be made."""
        return [n for n in range(self.layout.count) if n not in self.done]

    def note(self, number: int, sums: Mapping[str, str]) -> None:
        """Put a block that is written and on the disk into the ledger."""
        if number not in self.done:
            self.done[number] = dict(sums)
            _append(self.folder / LEDGER, number, sums)

    def finish(self, place: Path) -> None:
        """Give the store its checksums and put it in its place."""
        store, zarr = self.folder / STORE, zarr_of()
        for stray in store.rglob("*.partial"):  # a chunk whose writer was killed
            stray.unlink()
        summed = Checksum()
        with _unread(store, self.layout.along) as node:
            summed.add("/", node, blocks=[self.done[n] for n in range(self.layout.count)])
        zarr.open_group(store, mode="r+", zarr_format=2).attrs.update(summed.attributes())
        drafts.put_in_place(store, place, self.folder)
        shutil.rmtree(self.folder)


@contextmanager
def _unread(store: Path, along: str) -> Iterator[xr.Dataset]:
    """Open a store without reading the labels along a dimension: at 10^8 they take gigabytes."""
    import xarray as xr

    found = zarr_of().open_group(store, mode="r", zarr_format=ZARR["zarr_format"])
    options: dict[str, Any] = {"consolidated": False, "chunks": None, "zarr_format": 2}
    with xr.open_zarr(store, drop_variables=[along], **options) as node:
        if along not in found:
            yield node
            return
        labels = found[along]
        attributes = {n: of for n, of in labels.attrs.items() if n != "_ARRAY_DIMENSIONS"}
        first = np.broadcast_to(labels[:1], labels.shape)  # takes no memory
        stands_for = xr.conventions.decode_cf_variable(
            along, xr.Variable((along,), first, attributes)
        )
        yield node.assign_coords(xr.Coordinates({along: stands_for}, indexes={}))


@contextmanager
def held(place: Path, asked: Mapping[str, str], layout: Layout) -> Iterator[Unfinished | None]:
    """Hold the store in the making that belongs to a place, if there is one.

    Parameters
    ----------
    place : Path
        Where the complete store shall stand.
    asked : mapping of str to str
        What is asked, and of which versions.
    layout : Layout

    Yields
    ------
    Unfinished or None
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
    lock = os.open(folder / OWNER, os.O_CREAT | os.O_RDWR, 0o600)
    try:
        if not drafts.take_lock(lock):
            raise OutputError(place, "another run is writing it", "let it end, or stop it")
        _refuse_another(folder, dict(asked))
        yield Unfinished(folder, layout)
    finally:
        os.close(lock)


def _refuse_another(folder: Path, asked: dict[str, str]) -> None:
    """Refuse to go on with a store of another question, another version or another layout."""
    try:
        begun = json.loads((folder / ASKED).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        begun = {}
    differ = [name for name in asked | begun if asked.get(name) != begun.get(name)]
    if differ:
        what = " and ".join(name.replace("_", " ") for name in differ)
        raise OutputError(
            folder, f"it was begun with another {what}", "finish that, or move it away"
        )


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
    node = spelled(first).assign_attrs(
        {BLOCKS: f"{layout.along} {layout.block}", MADE_OF: digest(asked)}
    )
    grown = [str(n) for n, of in node.variables.items() if layout.along in of.dims]
    with drafts.box_of(place) as box:
        drafts.clear_up_after_the_dead(place, box)
        folder = box / "begun"
        folder.mkdir()
        store = folder / STORE
        with zarr.config.set({"threading.max_workers": 1}):
            node.to_zarr(
                store, mode="w", encoding=zarr_encoding(node, chunked=layout.along), **ZARR
            )
            group = zarr.open_group(store, mode="r+", zarr_format=ZARR["zarr_format"])
            for name in grown:
                group[name].resize((layout.size, *group[name].shape[1:]))
        (folder / ASKED).write_text(json.dumps(dict(asked), indent=1), encoding="utf-8")
        _append(folder / LEDGER, 0, of_block(first, layout.along))
        drafts.sync(folder)
        there = place.with_name(place.name + PARTIAL)
        if not there.exists():  # another run may have been faster
            os.rename(folder, there)
            drafts.sync_one(place.parent)


def digest(asked: Mapping[str, str]) -> str:
    """One word for what is asked, which a complete store carries."""
    import hashlib

    return hashlib.sha256(json.dumps(dict(asked), sort_keys=True).encode()).hexdigest()


# --- the ledger ----------------------------------------------------------------------------------


def _append(ledger: Path, number: int, sums: Mapping[str, str]) -> None:
    """Add a line, and see it to the disk."""
    with ledger.open("ab") as file:
        file.write(json.dumps([number, dict(sums)]).encode() + b"\n")
        file.flush()
        os.fsync(file.fileno())


def _read_ledger(ledger: Path) -> dict[int, dict[str, str]]:
    """Lines of the ledger; one that was cut short by the end of its writer is taken away."""
    try:
        lines = ledger.read_bytes().splitlines(keepends=True)
    except FileNotFoundError:
        return {}
    whole = [line for line in lines if line.endswith(b"\n")]
    if whole != lines:
        os.truncate(ledger, sum(map(len, whole)))
    return dict(json.loads(line) for line in whole)

"""A store in the making: block by block, in any order, gone on with after any end.

Beside the place of the store, ``X.zarr``, stands the folder ``X.zarr.partial`` as long as it is not
complete. In it are the store, whose arrays have their full length from the beginning; what it is
the answer to (`ASKED`); and a ledger with a line for each block that is written and on the disk.
Whoever asks the same again goes on with the blocks that are not in the ledger; whoever asks
something else is refused, and nothing is touched. When the last block is in the ledger, the store
gets its checksums and takes its place in one step. Before that, all of it is read and compared
with the ledger: a block whose bytes do not match is made again.

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
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from earthspin.engine import drafts
from earthspin.engine.checksums import BLOCKS, DATA, HEADER, Checksum, of_block
from earthspin.engine.store import MADE_OF, TIME_ENCODING, ZARR, spelled, zarr_encoding, zarr_of
from earthspin.errors import OutputError

if TYPE_CHECKING:
    import xarray as xr

#: Ending of the folder of a store that is not complete.
PARTIAL = ".partial"
#: Attribute by which `xarray` knows the dimensions of an array in a Zarr store.
_DIMS = "_ARRAY_DIMENSIONS"
#: What it holds: the store, what it answers, the blocks that are done, the lock of its owner, and
#: the checksum of the frame: all files of the store that no block writes.
STORE, ASKED, LEDGER, OWNER, FRAME = "store", "asked.json", "ledger", "owner", "frame"


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
        self.done = _read_ledger(folder / LEDGER, layout.count)

    @property
    def missing(self) -> list[int]:
        """Numbers of the blocks that are still to be made."""
        return [n for n in range(self.layout.count) if n not in self.done]

    def note(self, number: int, sums: Mapping[str, str]) -> None:
        """Put a block that is written and on the disk into the ledger."""
        if number not in self.done:
            self.done[number] = dict(sums)
            _append(self.folder / LEDGER, number, sums)

    def check_frame(self) -> None:
        """Refuse a store in which a file that no block writes is not what `begin` wrote.

        Raises
        ------
        OutputError
        """
        try:
            written = (self.folder / FRAME).read_text(encoding="ascii")
            intact = written == _frame(self.folder / STORE, self.layout.along)
        except (OSError, ValueError, AttributeError, TypeError):
            intact = False
        if not intact:
            words = "its names, sizes or attributes are not what was written"
            raise OutputError(self.folder, words, "take it away and run it again")

    def drop_damaged(self) -> list[int]:
        """Drop the blocks whose bytes do not match the ledger, and return their numbers.

        Raises
        ------
        OutputError
            If more than blocks is damaged.
        """
        self.check_frame()
        store, along = self.folder / STORE, self.layout.along
        group, grown = _group(store), _grown(store, along)
        arrays = {name: group[name] for name in grown}
        damaged = [number for number in sorted(self.done) if not self._matches(number, arrays)]
        for number in damaged:
            del self.done[number]
            for name in grown:
                for path in (store / name).glob(f"{number}*"):
                    if path.name.partition(".")[0] == str(number):
                        path.unlink()
        return damaged

    def _matches(self, number: int, arrays: Mapping[str, Any]) -> bool:
        """Whether the store has the block that the ledger has."""
        import xarray as xr

        first, last = self.layout.bounds(number)
        try:
            block = {name: _decoded(array, array[first:last]) for name, array in arrays.items()}
            return of_block(xr.Dataset(block), self.layout.along) == self.done[number]
        except Exception:  # of a codec whose own checksum failed, or of a chunk that is not there
            return False

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


def _grown(store: Path, along: str) -> list[str]:
    """Names of the variables that blocks write."""
    dims = {
        path.parent.name: json.loads(path.read_bytes()).get(_DIMS, ())
        for path in store.glob("*/.zattrs")
    }
    return [name for name, names in dims.items() if along in names]


def _frame(store: Path, along: str) -> str:
    """Checksum of all files of a store that no block writes.

    The checksums of a store that is about to take its place do not count.
    """
    grown, total = _grown(store, along), hashlib.sha256()
    for path in sorted(store.rglob("*")):
        of_block = path.parent.name in grown and not path.name.startswith(".")
        if of_block or path.name.endswith(".partial") or path.is_dir():
            continue
        content = path.read_bytes()
        if path == store / ".zattrs":
            said = json.loads(content).items()
            own = {name: value for name, value in said if name not in (HEADER, DATA)}
            content = json.dumps(own, sort_keys=True).encode()
        for part in (path.relative_to(store).as_posix().encode(), content):
            total.update(b"%d:" % len(part) + part)
    return total.hexdigest()


def _group(store: Path) -> Any:
    """The group of a store that is only read, and says which chunk is missing."""
    from earthspin.engine.zarr_folder import ZarrFolder

    return zarr_of().open_group(ZarrFolder(store), mode="r", zarr_format=ZARR["zarr_format"])


@contextmanager
def _unread(store: Path, along: str) -> Iterator[xr.Dataset]:
    """Open a store without reading the labels along a dimension: at 10^8 they take gigabytes.

    Zero stands for every label.
    """
    import xarray as xr

    group = _group(store)
    options: dict[str, Any] = {"consolidated": False, "chunks": None, "zarr_format": 2}
    with xr.open_zarr(store, drop_variables=[along], decode_times=_coder(), **options) as node:
        if along not in group:
            yield node
            return
        labels = group[along]
        zeros = np.broadcast_to(np.zeros(1, labels.dtype), labels.shape)  # takes no memory
        stands_for = _decoded(labels, zeros)
        yield node.assign_coords(xr.Coordinates({along: stands_for}, indexes={}))


def _decoded(array: Any, values: np.ndarray[Any, Any]) -> xr.Variable:
    """Some numbers of an array in a store as `xarray` reads them."""
    import xarray as xr

    attributes = dict(array.attrs)
    dims = attributes.pop(_DIMS)
    if array.fill_value is not None:
        attributes["_FillValue"] = array.fill_value
    return xr.conventions.decode_cf_variable(
        array.basename, xr.Variable(dims, values, attributes), decode_times=_coder()
    )


def _coder() -> Any:
    import xarray as xr

    return xr.coders.CFDatetimeCoder(time_unit="us")


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
    except (OSError, ValueError, RecursionError):
        begun = None
    if not isinstance(begun, dict):
        raise OutputError(
            folder, f"its {ASKED} is not what was written", "take it away and run it again"
        )
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
        (folder / FRAME).write_text(_frame(store, layout.along), encoding="ascii")
        _append(folder / LEDGER, 0, of_block(first, layout.along))
        drafts.sync(folder)
        there = place.with_name(place.name + PARTIAL)
        if not there.exists():  # another run may have been faster
            os.rename(folder, there)
            drafts.sync_one(place.parent)


def digest(asked: Mapping[str, str]) -> str:
    """One word for what is asked, which a complete store carries."""
    return hashlib.sha256(json.dumps(dict(asked), sort_keys=True).encode()).hexdigest()


# --- the ledger ----------------------------------------------------------------------------------


def _append(ledger: Path, number: int, sums: Mapping[str, str]) -> None:
    """Add a line, and see it to the disk."""
    with ledger.open("ab") as file:
        file.write(json.dumps([number, dict(sums)]).encode() + b"\n")
        file.flush()
        os.fsync(file.fileno())


def _read_ledger(ledger: Path, count: int) -> dict[int, dict[str, str]]:
    """Checksums of each block that the ledger has.

    A last line that was cut short by the end of its writer is taken away. A line that is damaged
    counts for nothing, so that its block is made again.
    """
    try:
        content = ledger.read_bytes()
    except FileNotFoundError:
        return {}
    *lines, rest = content.split(b"\n")
    if rest:
        os.truncate(ledger, len(content) - len(rest))
    entries = {}
    for line in lines:
        try:
            number, sums = json.loads(line)
        except (ValueError, TypeError, RecursionError):
            continue
        if type(number) is int and 0 <= number < count and isinstance(sums, dict):
            entries[number] = sums
    return entries

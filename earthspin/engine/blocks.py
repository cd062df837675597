"""Compute long time series and ensembles block by block, in this process or on several workers.

A `Work` holds the request, the division of the result into blocks, and a method that makes a block.
Blocks are independent. Without a client, they are made one after the other; with a client of
``dask.distributed``, its workers make and write them.

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
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from itertools import chain, islice
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from earthspin._lazy import xr
from earthspin._version import __version__, version
from earthspin.engine import atomic_writes, store
from earthspin.engine.origin import with_labels
from earthspin.engine.question import BLOCK, Block, Question, scene_text
from earthspin.engine.run import Run
from earthspin.engine.variables import spelled
from earthspin.errors import MissingExtraError, OutputError, SceneError, Where, one_line
from earthspin.progress import progress
from earthspin.units import Whole

if TYPE_CHECKING:
    from distributed import Client

# --- unfinished stores ----------------------------------------------------------------------------

#: Suffix of the folder of an unfinished store.
PARTIAL = ".partial"
#: Names in the folder: the store, the request, and a store whose first block is being written.
STORE, REQUEST, _DRAFT = "store", "asked.json", "begun"


@dataclass(frozen=True)
class Layout:
    """Division of a long result into blocks along one dimension.

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
        """Number of blocks into which the result is divided."""
        return -(-self.size // self.block)

    def bounds(self, number: int) -> tuple[int, int]:
        """Index of the first element of a block, and index after its last element."""
        return number * self.block, min((number + 1) * self.block, self.size)

    def length(self, number: int) -> int:
        """Length of a block along the divided dimension."""
        first, last = self.bounds(number)
        return last - first


def missing_blocks(folder: Path, layout: Layout) -> list[int]:
    """Return the numbers of missing or damaged blocks of a store, and remove damaged chunks.

    Parameters
    ----------
    folder : Path
        Folder whose name ends in `PARTIAL`, which this process has locked.
    layout : Layout

    Raises
    ------
    OutputError
        If the metadata, or a variable that is not written in blocks, is damaged.
    """
    try:
        return sorted(store.zarr_of().missing_blocks(folder / STORE, layout.along))
    except OutputError:
        raise _damaged(folder, "the part that its blocks share is") from None


def finish(folder: Path, layout: Layout, target: Path) -> None:
    """Check that no block of a Zarr store is missing or damaged; move the store to its target path.

    The scene is completed with the labels and ranges of all blocks.

    Raises
    ------
    OutputError
        If a file does not match its checksum; the next run makes its block again.
    """
    path = folder / STORE
    for stray in path.rglob("*.partial"):  # a chunk whose writer was killed
        stray.unlink()
    if missing_blocks(folder, layout):
        problem = "a block differs from what was just written"
        raise OutputError(folder, problem, "check the disk and run it again")
    whole = store.open_groups(path, engine="zarr", consolidated=False)["/"]
    parts = (slice(*layout.bounds(number)) for number in range(layout.count))
    with_labels(whole, (whole.isel({layout.along: part}).load() for part in parts))
    store.zarr_of().seal(path, whole.attrs)
    store.zarr_of().close(path)
    atomic_writes.put_in_place(path, target, folder)
    atomic_writes.remove(folder)


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
    path = folder / STORE
    if not path.is_dir():
        raise OutputError(folder, "it was removed while it was written", "run it again")
    constant = [n for n, variable in block.variables.items() if layout.along not in variable.dims]
    # With an index, to_zarr would not write the coordinate along the region.
    grown = block.drop_vars(constant).drop_indexes(layout.along, errors="ignore")
    try:
        store.zarr_of().write_region(grown, path, {layout.along: slice(*layout.bounds(number))})
    except ValueError as error:
        raise OutputError(folder, f"block {number} does not fit: {one_line(error)}") from None


@contextmanager
def claimed(target: Path) -> Iterator[Path]:
    """Lock and yield the folder of an unfinished store; remove it at the end if no store was begun.

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
    with atomic_writes.claimed(folder, target):
        try:
            yield folder
        finally:
            if not _is_begun(folder):
                atomic_writes.remove(folder)


def _is_begun(folder: Path) -> bool:
    """Return True if a folder holds files other than the lock file and the draft of a store."""
    return folder.exists() and not {path.name for path in folder.iterdir()} <= {
        atomic_writes.LOCK,
        _DRAFT,
    }


def refuse_another(folder: Path, request: Mapping[str, str]) -> None:
    """Raise an error if an unfinished store belongs to another question, version or layout.

    Raises
    ------
    OutputError
    """
    if not _is_begun(folder):
        return
    try:
        begun = dict(json.loads((folder / REQUEST).read_text(encoding="utf-8")).items())
    except (OSError, ValueError, AttributeError, RecursionError):
        raise _damaged(folder, f"its {REQUEST} is") from None
    differ = [name for name in {**request, **begun} if request.get(name) != begun.get(name)]
    if differ:
        what = " and ".join(name.replace("_", " ") for name in differ)
        problem = f"it was begun with another {what}"
        raise OutputError(folder, problem, "finish that run, or move the folder away")


def _damaged(folder: Path, what: str) -> OutputError:
    return OutputError(folder, f"{what} damaged", "remove it and run it again")


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
    zarr_folder = store.zarr_of()
    whole = first.nbytes / layout.length(0) * layout.size
    atomic_writes.refuse_what_does_not_fit(folder, whole, f"{layout.size} {layout.along}s")
    node = spelled(first).assign_attrs(store.OF_FILES | {store.MADE_OF: digest(request)})
    encoding = store.encoding_of(node)
    for name, variable in node.variables.items():
        if layout.along in variable.dims:
            encoding[str(name)]["chunks"] = variable.shape
    draft = folder / _DRAFT
    atomic_writes.remove(draft)
    zarr_folder.write({"/": node}, draft, {"/": encoding})
    zarr_folder.lengthen(draft, layout.along, layout.size)
    zarr_folder.seal(draft)
    (folder / REQUEST).write_text(json.dumps(dict(request), indent=1), encoding="utf-8")
    os.rename(draft, folder / STORE)


def digest(request: Mapping[str, str]) -> str:
    """SHA-256 of the texts that identify a run; a complete store has this hash as an attribute."""
    return hashlib.sha256(json.dumps(dict(request), sort_keys=True).encode()).hexdigest()


# --- the loop over blocks -------------------------------------------------------------------------

#: Time limit for the answer of a scheduler, s.
TIMEOUT = 10
#: Time without a single worker after which a run ends, s; a cluster may restart them.
PATIENCE = 60
#: The only address on which a local cluster listens, also for its dashboard.
LOCAL_HOST = "127.0.0.1"
#: Blocks submitted for each thread of a cluster, so that no thread is idle.
QUEUED = 3


class Work(Protocol):
    """Interface of a result that is computed in blocks, such as a long series or an ensemble."""

    @property
    def what(self) -> str:
        """Name of the computation, for the progress bar."""

    @property
    def layout(self) -> Layout:
        """Division of the result into blocks along one dimension."""

    @property
    def request(self) -> Mapping[str, str]:
        """Texts that identify the result, by name: question, versions and file checksums."""

    def make(self, number: int) -> xr.Dataset:
        """Compute and return one block of the result, by block number.

        The dimension of the layout is the first dimension of every variable that has it. Block 0
        has the attributes of the whole result.
        """


def write(work: Work, path: str | Path, *, client: object = None, replace: bool = False) -> Path:
    """Compute a result block by block into a Zarr store, or resume an unfinished store.

    Parameters
    ----------
    work : Work
    path : str or Path
        Path that ends in ``.zarr``. Until the result is complete, a store at this path is not
        changed, and the blocks are in a folder next to it whose name ends in ``.partial``.
    client : Client, int or str, optional
        A client of ``dask.distributed``, the number of local workers to start, or the address of a
        scheduler whose workers see the same folder. By default this process makes all blocks.
    replace : bool
        Whether a complete store of another question is replaced.

    Returns
    -------
    Path

    Raises
    ------
    OutputError
        If the store cannot be written, another run writes it, it belongs to another question, or
        it is damaged.
    MissingExtraError
        If zarr is not installed; or distributed, if `client` needs it.
    """
    client = _checked(client)
    place = atomic_writes.as_path(path)
    if place.suffix != ".zarr":
        remedy = "long results can only be written to Zarr"
        raise OutputError(place, "its name does not end in .zarr", remedy)
    store.zarr_of()
    target, layout = atomic_writes.prepared(place), work.layout
    size = f"{layout.size} along {layout.along} by {layout.block}"
    request = dict(work.request) | {"size": size, "format of files": str(store.VERSION)}
    stay = f"finished blocks stay in {target.name}{PARTIAL}"
    remedy = f"{stay}: free some space and run it again"
    with atomic_writes.output_errors(place, remedy), claimed(target) as folder:
        existing = _digest_of_store(target)
        complete = existing == digest(request)
        if existing is not None and not complete and not replace:
            raise OutputError(place, "a store of another question exists there", "move it away")
        refuse_another(folder, request)
        if complete:
            # a run that was killed after its last block can have left it
            atomic_writes.remove(folder)
            return store.verify(place)
        if not (folder / STORE).exists():
            begin(folder, request, layout, work.make(0))
        _complete(work, folder, target, client)
    return place


def hold(work: Work, *, client: object = None) -> xr.Dataset:
    """Compute a result block by block, and return it in memory.

    Parameters
    ----------
    work : Work
    client : Client, int or str, optional
        See `write`.
    """
    client = _checked(client)
    layout, blocks = work.layout, dict[int, Any]()
    with progress(work.what, layout.size) as advance:
        others = _blocks(work, list(range(1, layout.count)), client)
        for number, block in chain([(0, work.make(0))], others):
            blocks[number] = block
            advance(layout.length(number))
    whole: xr.Dataset = xr.concat(
        [blocks[n] for n in range(layout.count)], layout.along, data_vars="minimal",
        coords="minimal", compat="override", join="override", combine_attrs="override",
    )  # fmt: skip
    return with_labels(whole.assign_attrs(blocks[0].attrs))


def _complete(work: Work, folder: Path, target: Path, client: object) -> None:
    """Compute the missing blocks of an unfinished store; then move the store to its target path."""
    layout, done = work.layout, 0
    try:
        missing = missing_blocks(folder, layout)
        done = layout.size - sum(map(layout.length, missing))
        with progress(work.what, layout.size, done) as advance:
            for number, _ in _blocks(work, missing, client, folder):
                done += layout.length(number)
                advance(layout.length(number))
        finish(folder, layout, target)
    except BaseException as ended:
        # interrupted from outside, as by Ctrl-C
        if not isinstance(ended, Exception) and (folder / STORE).exists():
            state = f"{done or 'some'} of {layout.size} are stored in {folder.name}"
            ended.add_note(f"{state}; run the same command to continue")
        raise


def _blocks(
    work: Work, numbers: list[int], client: object, folder: Path | None = None
) -> Iterator[tuple[int, Any]]:
    """Compute blocks; yield pairs of block number and data (None for data written to a folder)."""
    if client is None:
        yield from (_make_block(work, number, folder) for number in numbers)
    elif numbers:
        with _cluster(client) as cluster:
            yield from _blocks_from_cluster(work, numbers, cluster, folder)


def _make_block(work: Work, number: int, folder: Path | None) -> tuple[int, Any]:
    """Compute a block; return its number and data (data are None if written to a folder)."""
    block = work.make(number)
    if folder is None:
        return number, block
    write_block(folder, work.layout, number, block)
    return number, None


def _blocks_from_cluster(
    work: Work, numbers: list[int], client: Client, folder: Path | None
) -> Iterator[tuple[int, Any]]:
    from distributed import as_completed

    with _lost_workers(client, folder):
        sent = client.scatter(work, broadcast=True, hash=False)
        threads = sum(client.nthreads().values()) or 1
        submitted = (client.submit(_make_block, sent, n, folder, pure=False) for n in numbers)
        running = as_completed([*islice(submitted, QUEUED * threads)], loop=client.loop)
        while not running.is_empty():
            begun = time.monotonic()
            while not running.has_ready():
                time.sleep(0.01)
                if time.monotonic() - begun > PATIENCE and not client.nthreads():
                    raise TimeoutError(f"it has no workers, and no block came for {PATIENCE} s")
            yield next(running).result()
            running.update(islice(submitted, 1))


@contextmanager
def _lost_workers(client: Client, folder: Path | None) -> Iterator[None]:
    """Convert the errors of a cluster without workers or scheduler to a `SceneError`."""
    try:
        yield
    except Exception as error:
        cluster = type(error).__module__.partition(".")[0] == "distributed"
        if not (cluster or isinstance(error, TimeoutError)):
            raise
        remedy = "start its workers, and run the same again"
        remedy += f", which continues with the blocks in {folder.name}" if folder else ""
        problem = f"the cluster lost a block: {one_line(error)}; {remedy}"
        raise SceneError("client", str(client.scheduler), problem) from None


@contextmanager
def _cluster(client: object) -> Iterator[Client]:
    """Yield a client of a Dask cluster; a local cluster is started and closed if needed."""
    try:
        import dask
        import distributed
    except ImportError:
        raise MissingExtraError("distributed", "scale", "work by many processes") from None
    if isinstance(client, distributed.Client):
        yield client
        return
    options: dict[str, Any] = {"address": client, "timeout": TIMEOUT}
    if isinstance(client, int):
        options = {"n_workers": client, "threads_per_worker": 1, "silence_logs": 50}
        options |= {"host": LOCAL_HOST, "dashboard_address": f"{LOCAL_HOST}:0"}
    quiet = {"distributed.admin.log-format": "", "logging.distributed": "critical"}
    with dask.config.set(quiet if isinstance(client, int) else {}):
        try:
            connected = distributed.Client(**options, set_as_default=False)
        except Exception as error:  # wrong address, network error or another version
            if isinstance(client, int):
                raise
            problem = f"no scheduler answers there within {TIMEOUT} s: {one_line(error)}"
            raise SceneError("scheduler", client, problem) from None
        with connected:
            if not connected.nthreads():
                raise SceneError("scheduler", client, "it has no workers; start at least one")
            yield connected


def _checked(client: object) -> object:
    """Check and return a Dask client, a scheduler address or a number of workers.

    Raises
    ------
    SceneError
        If it has a wrong type, or no scheduler answers at the address.
    """
    if client is None or hasattr(client, "scatter"):
        return client
    if isinstance(client, str):
        with _cluster(client):
            return client
    others = " (of workers), the address of a scheduler, or a Client of distributed"
    return Whole(others=others).read(client, Where("client"))


def _digest_of_store(target: Path) -> str | None:
    """Hash that identifies the computation of a complete store; None if there is no store."""
    if not target.exists():
        return None
    try:
        return str(json.loads((target / ".zattrs").read_bytes())[store.MADE_OF])
    except (OSError, ValueError, LookupError, TypeError):  # treat it as another store
        return ""


# --- a long series --------------------------------------------------------------------------------


@dataclass(frozen=True)
class BlockSeries:
    """Long time series that a question computes, divided into blocks of consecutive times.

    Attributes
    ----------
    question : Question
        Question with a part that takes ``block``.
    size, length : int
        Number of times in total and in a block.
    """

    question: Question
    size: int
    length: int

    @property
    def what(self) -> str:
        """Name of the series, which the progress bar shows."""
        return f"{self.question.word} series"

    @property
    def layout(self) -> Layout:
        """Division of the series into blocks of consecutive times."""
        return Layout("time", self.size, self.length)

    @cached_property
    def _run(self) -> Run:
        """The `Run` of the first block; other blocks reuse what does not depend on the block."""
        return Run(self.question, block=Block(*self.layout.bounds(0)))

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in vars(self).items() if name != "_run"}

    @cached_property
    def request(self) -> Mapping[str, str]:
        """Texts that identify the run: question, software versions and checksums of files."""
        sources = self._run.provenance(self.question.graph.ends, without=[BLOCK])
        return request_of(self.question, sources)

    def make(self, number: int) -> xr.Dataset:
        """Compute and return one block of consecutive times, by block number."""
        return self._run.again(block=Block(*self.layout.bounds(number))).answer()


def request_of(question: Question, provenance: Mapping[str, str]) -> dict[str, str]:
    """Texts that identify a run, by name: question, software versions and checksums of files.

    An unfinished store is resumed only if its texts are the same.

    Parameters
    ----------
    question : Question
    provenance : mapping of str to str
        Further versions, and checksums of the files that are read.
    """
    return {
        "question": scene_text(question),
        "version of earthspin": __version__,
        "version of numpy": version("numpy"),
    } | dict(provenance)

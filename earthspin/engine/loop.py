"""Compute a long series or an ensemble in blocks, in this process or on several workers.

A `Work` holds the request, the division of the result into blocks, and a method that makes a block.
Blocks are independent, and an ended run can be resumed. Without a client, blocks are made one after
the other; with a client of ``dask.distributed``, its workers make and write them. How blocks are
stored is described in `earthspin.engine.unfinished`.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from earthspin.engine import drafts, unfinished
from earthspin.engine.store import MADE_OF, VERSION, verify, zarr_of
from earthspin.engine.unfinished import STORE, Layout, Unfinished, write_block
from earthspin.errors import EarthspinError, MissingExtraError, OutputError, SceneError, one_line
from earthspin.progress import progress

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client

#: Time limit for the answer of a scheduler, s.
TIMEOUT = 10
#: The only address on which a local cluster listens, also for its dashboard.
LOCAL_HOST = "127.0.0.1"
#: Blocks submitted for each thread of a cluster, so that no thread is idle.
QUEUED = 3


class Work(Protocol):
    """Interface of a result that is computed in blocks, such as a long series or an ensemble."""

    @property
    def what(self) -> str:
        """Name of the computed result, which the progress bar shows."""

    @property
    def layout(self) -> Layout:
        """Division of the result into blocks along one dimension."""

    @property
    def request(self) -> Mapping[str, str]:
        """Texts that determine the result: the question and the software versions, by name."""

    def first(self) -> xr.Dataset:
        """Compute the first block (number 0), with the attributes of the whole result."""

    def make(self, number: int) -> xr.Dataset:
        """Compute one block of the result, given the number of the block.

        The dimension of the layout is the first dimension of every variable that has it.
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
    _check_client(client)
    place = drafts.as_path(path)
    if place.suffix != ".zarr":
        problem = "its name does not end in .zarr"
        raise OutputError(place, problem, "long results can only be written to Zarr")
    zarr_of()
    target, layout = drafts.prepared(place), work.layout
    size = f"{layout.size} along {layout.along} by {layout.block}"
    request = dict(work.request) | {"size": size, "format of files": str(VERSION)}
    stay = f"finished blocks stay in {target.name}{unfinished.PARTIAL}"
    remedy = f"{stay}: free some space and run it again"
    with drafts.output_errors(place, remedy), unfinished.claimed(target) as folder:
        existing = _digest_of_store(target)
        complete = existing == unfinished.digest(request)
        if existing is not None and not complete and not replace:
            raise OutputError(place, "a store of another question exists there", "move it away")
        unfinished.refuse_another(folder, request)
        if complete:
            drafts.remove(folder)  # a run that was killed after its last block can have left it
            return verify(place)
        if not (folder / STORE).exists():
            unfinished.begin(folder, request, layout, work.first())
        _complete(work, Unfinished(folder, layout), target, client)
    return place


def hold(work: Work, *, client: object = None) -> xr.Dataset:
    """Compute a result block by block, and return it in memory.

    Parameters
    ----------
    work : Work
    client : Client, int or str, optional
        See `write`.
    """
    import xarray as xr

    _check_client(client)
    layout = work.layout
    with progress(work.what, layout.size) as advance:
        blocks = {0: work.first()}
        advance(layout.length(0))
        for number, block in _blocks(work, list(range(1, layout.count)), client):
            blocks[number] = block
            advance(layout.length(number))
    first, *others = (blocks[n] for n in range(layout.count))
    if not others:
        return first
    whole = xr.concat(
        [first, *others], layout.along, data_vars="minimal", coords="minimal", compat="override",
        join="override", combine_attrs="override",
    )  # fmt: skip
    return whole.assign_attrs(first.attrs)


# --- the loop ------------------------------------------------------------------------------------


def _complete(work: Work, store: Unfinished, target: Path, client: object) -> None:
    """Compute the missing blocks of an unfinished store; then finish the store."""
    layout, done = work.layout, store.length
    try:
        with progress(work.what, layout.size, done) as advance:
            for number, _ in _blocks(work, store.missing, client, store.folder):
                done += layout.length(number)
                advance(layout.length(number))
    except BaseException as ended:
        if not isinstance(ended, Exception):  # interrupted from outside, as by Ctrl-C
            state = f"{done} of {layout.size} are stored in {store.folder.name}"
            ended.add_note(f"{state}; run the same command to continue")
        raise
    store.finish(target)


def _blocks(
    work: Work, numbers: list[int], client: object, folder: Path | None = None
) -> Iterator[tuple[int, Any]]:
    """Compute blocks; yield each number with its data, or None if there is a folder for them."""
    if client is None:
        yield from (_make_block(work, number, folder) for number in numbers)
    elif numbers:
        with _cluster(client) as cluster:
            yield from _blocks_from_cluster(work, numbers, cluster, folder)


def _make_block(work: Work, number: int, folder: Path | None) -> tuple[int, Any]:
    """Compute one block of the result, and write it if a folder is given."""
    block = work.make(number)
    if folder is None:
        return number, block
    write_block(folder, work.layout, number, block)
    return number, None


def _blocks_from_cluster(
    work: Work, numbers: list[int], client: Client, folder: Path | None
) -> Iterator[tuple[int, Any]]:
    from distributed import as_completed

    sent = client.scatter(work, broadcast=True, hash=False)
    threads = sum(client.nthreads().values()) or 1
    submitted = (client.submit(_make_block, sent, n, folder, pure=False) for n in numbers)
    running = as_completed([*islice(submitted, QUEUED * threads)], loop=client.loop)
    for future in running:
        try:
            yield future.result()
        except EarthspinError:
            raise
        except Exception as error:
            if type(error).__module__.partition(".")[0] != "distributed":
                raise
            problem = f"the cluster lost a block: {one_line(error)}"
            raise SceneError("client", str(client.scheduler), problem) from None
        running.update(islice(submitted, 1))


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


def _check_client(client: object) -> None:
    """Raise an error if `client` has a wrong type, before anything is computed.

    Raises
    ------
    SceneError
    """
    counted = isinstance(client, int) and not isinstance(client, bool) and client > 0
    if not (client is None or counted or isinstance(client, str) or hasattr(client, "scatter")):
        allowed = "give a number of workers, the address of a scheduler, or a Client of distributed"
        raise SceneError("client", client, allowed)


# --- existing stores -----------------------------------------------------------------------------


def _digest_of_store(target: Path) -> str | None:
    """Hash that identifies the computation in a complete store; None without a store."""
    if not target.exists():
        return None
    try:
        return str(json.loads((target / ".zattrs").read_bytes())[MADE_OF])
    except (OSError, ValueError, LookupError, TypeError):  # treat it as another store
        return ""

"""One loop for many: blocks of a long series, or of many members, made independently and resumed.

What is to be done is a `Work`: it knows what is asked, how the result is cut into blocks, and how
to make any one of them. A plain loop makes one after the other; with a client of
``dask.distributed`` its workers make them, and write them themselves. Only whoever holds the store
keeps its ledger (`earthspin.engine.unfinished`).
"""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from earthspin.engine import drafts, unfinished
from earthspin.engine.store import MADE_OF, verify, zarr_of
from earthspin.engine.unfinished import Layout, Unfinished, write_block
from earthspin.errors import EarthspinError, MissingExtraError, OutputError, SceneError, one_line
from earthspin.progress import progress

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client

#: Seconds that a scheduler has to answer.
PATIENCE = 10
#: The only address on which a cluster started here listens, also for its pages in the browser.
HERE = "127.0.0.1"
#: Blocks that wait for each thread of a cluster, so that none is idle.
WAITING = 3


class Work(Protocol):
    """A result that can be made in blocks, on any machine that it is sent to."""

    @property
    def what(self) -> str:
        """What is made, for people."""

    @property
    def layout(self) -> Layout:
        """How it is cut."""

    @property
    def asked(self) -> Mapping[str, str]:
        """What is asked and of which versions, by name; the same for the same result."""

    def first(self) -> xr.Dataset:
        """Make block 0, with the attributes of the whole."""

    def make(self, number: int) -> xr.Dataset:
        """Make a block, its growing dimension first in every variable that has it."""


def write(work: Work, path: str | Path, *, client: object = None, replace: bool = False) -> Path:
    """Make a result block by block into a Zarr store, or go on where another run was ended.

    Parameters
    ----------
    work : Work
    path : str or Path
        Ends in ``.zarr``. Until all is there, it is as it was, and the blocks that are made stand
        beside it in a folder that ends in ``.partial``.
    client : Client, int or str, optional
        Of ``dask.distributed``: one that there is, the number of workers to start here, or the
        address of a scheduler, whose workers see the same folder. A plain loop without.
    replace : bool
        Whether a complete store of another question is replaced.

    Returns
    -------
    Path

    Raises
    ------
    OutputError
        If it cannot be written, another run writes it, something else was asked there, or what
        stands there is damaged.
    MissingExtraError
        If zarr is not installed; or distributed, if it is wanted.
    """
    _check_client(client)
    place = drafts.as_path(path)
    if place.suffix != ".zarr":
        problem = "its name does not end in .zarr"
        raise OutputError(place, problem, "what is long goes to Zarr alone")
    zarr_of()
    target, layout = drafts.prepared(place), work.layout
    asked = dict(work.asked) | {"size": f"{layout.size} along {layout.along} by {layout.block}"}
    existing = _made_of(target)
    if existing is not None and existing != unfinished.digest(asked) and not replace:
        raise OutputError(place, "a store of something else stands there", "move it away")
    if existing == unfinished.digest(asked):
        with unfinished.held(target, asked) as left:  # by a run that was ended when all was done
            if left is not None:
                shutil.rmtree(left)
        return verify(place)
    remedy = f"what is done stays in {target.name}{unfinished.PARTIAL}: make room and run it again"
    with drafts.output_errors(place, remedy):
        while True:
            with unfinished.held(target, asked) as folder:
                if folder is not None:
                    _go_on(work, Unfinished(folder, layout), target, client)
                    return place
            unfinished.begin(target, asked, layout, work.first())


def hold(work: Work, *, client: object = None) -> xr.Dataset:
    """Make a result block by block in memory.

    Parameters
    ----------
    work : Work
    client : Client, int or str, optional
        As `write` takes it.
    """
    import xarray as xr

    _check_client(client)
    layout = work.layout
    with progress(work.what, layout.size) as advance:
        blocks = {0: work.first()}
        advance(layout.length(0))
        for number, block in _made(work, list(range(1, layout.count)), client):
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


def _go_on(work: Work, store: Unfinished, target: Path, client: object) -> None:
    """Make what is missing, and again what is damaged, until all is as the ledger says."""
    layout, own = work.layout, set[int]()
    try:
        store.drop_damaged()
        while True:
            with progress(work.what, layout.size, store.length) as advance:
                for number, sums in _made(work, store.missing, client, store.folder):
                    store.note(number, sums)
                    own.add(number)
                    advance(layout.length(number))
            if not (damaged := store.drop_damaged()):
                break
            if own.intersection(damaged):
                words = f"block {damaged[0]} is not what was just written"
                raise OutputError(store.folder, words, "check the disk and run it again")
    except BaseException as ended:
        if not isinstance(ended, Exception):  # from outside
            kept = f"{store.length} of {layout.size} are kept in {store.folder.name}"
            ended.add_note(f"{kept}; the same command goes on from there")
        raise
    store.finish(target)


def _made(
    work: Work, numbers: list[int], client: object, folder: Path | None = None
) -> Iterator[tuple[int, Any]]:
    """Blocks by their numbers, as they come; with a folder, the checksums of their files."""
    if client is None:
        yield from (_one(work, number, folder) for number in numbers)
    elif numbers:
        with _cluster(client) as cluster:
            yield from _by_cluster(work, numbers, cluster, folder)


def _one(work: Work, number: int, folder: Path | None) -> tuple[int, Any]:
    """Make a block, and write it if there is a folder for it; runs on workers, too."""
    block = work.make(number)
    return number, block if folder is None else write_block(folder, work.layout, number, block)


def _by_cluster(
    work: Work, numbers: list[int], client: Client, folder: Path | None
) -> Iterator[tuple[int, Any]]:
    from distributed import as_completed

    sent = client.scatter(work, broadcast=True, hash=False)
    threads = sum(client.nthreads().values()) or 1
    submitted = (client.submit(_one, sent, n, folder, pure=False) for n in numbers)
    running = as_completed([*islice(submitted, WAITING * threads)], loop=client.loop)
    for future in running:
        try:
            yield future.result()
        except EarthspinError:
            raise
        except Exception as error:
            if type(error).__module__.partition(".")[0] != "distributed":
                raise
            words = f"the cluster lost it: {one_line(error)}"
            raise SceneError("client", str(client.scheduler), words) from None
        running.update(islice(submitted, 1))


@contextmanager
def _cluster(client: object) -> Iterator[Client]:
    """A client of a cluster that there is, or of one that lives as long as it is needed."""
    try:
        import dask
        import distributed
    except ImportError:
        raise MissingExtraError("distributed", "scale", "work by many processes") from None
    if isinstance(client, distributed.Client):
        yield client
        return
    options: dict[str, Any] = {"address": client, "timeout": PATIENCE}
    if isinstance(client, int):
        options = {"n_workers": client, "threads_per_worker": 1, "silence_logs": 50}
        options |= {"host": HERE, "dashboard_address": f"{HERE}:0"}
    quiet = {"distributed.admin.log-format": "", "logging.distributed": "critical"}
    with dask.config.set(quiet if isinstance(client, int) else {}):
        try:
            connected = distributed.Client(**options, set_as_default=False)
        except Exception as error:  # of the address, the network or another version
            if isinstance(client, int):
                raise
            words = f"no scheduler answers there within {PATIENCE} s: {one_line(error)}"
            raise SceneError("scheduler", client, words) from None
        with connected:
            if not connected.nthreads():
                raise SceneError("scheduler", client, "it has no workers; start some")
            yield connected


def _check_client(client: object) -> None:
    """Refuse what is no client, before anything is computed.

    Raises
    ------
    SceneError
    """
    counted = isinstance(client, int) and not isinstance(client, bool) and client > 0
    if not (client is None or counted or isinstance(client, str) or hasattr(client, "scatter")):
        words = "give a number of workers, the address of a scheduler, or a Client of distributed"
        raise SceneError("client", client, words)


# --- what there is already -----------------------------------------------------------------------


def _made_of(target: Path) -> str | None:
    """What a complete store was made of, in a word; None where there is no store."""
    drafts.put_back(target)
    if not target.exists():
        return None
    try:
        return str(zarr_of().open_group(target, mode="r", zarr_format=2).attrs.get(MADE_OF, ""))
    except Exception:  # whatever zarr says of a folder that is damaged: it is another store
        return ""

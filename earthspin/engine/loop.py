"""One loop for many: blocks of a long series, or of many members, made independently and resumed.

What is to be done is a `Work`: it knows what is asked, how the result is cut into blocks, and how
to make any one of them. A plain loop makes one after the other; with a client of
``dask.distributed`` its workers make them, and write them themselves. Only whoever holds the store
keeps its ledger (`earthspin.engine.unfinished`).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from earthspin.engine import drafts
from earthspin.engine.store import MADE_OF, verify, zarr_of
from earthspin.engine.unfinished import (
    PARTIAL,
    Layout,
    Unfinished,
    begin,
    digest,
    held,
    write_block,
)
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
        raise OutputError(
            place, "its name does not end in .zarr", "what is long goes to Zarr alone"
        )
    zarr_of()
    target = drafts.made_ready(place)
    there, asked = _made_of(target), _asked(work)
    if there is not None and there != digest(asked) and not replace:
        raise OutputError(place, "a store of something else stands there", "move it away")
    if there == digest(asked):
        _clear_up(target, work)
        return verify(place)
    with drafts.told_as_output_error(place, _remedy(target)):
        while True:
            with held(target, asked, work.layout) as unfinished:
                if unfinished is not None:
                    _go_on(work, unfinished, target, client)
                    return place
            begin(target, asked, work.layout, work.first())


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


def _go_on(work: Work, unfinished: Unfinished, target: Path, client: object) -> None:
    layout, own = work.layout, set[int]()
    unfinished.check_frame()
    with _interrupts_told(unfinished):
        while True:
            before = sum(map(layout.length, unfinished.done))
            with progress(work.what, layout.size, before) as advance:
                for number, sums in _made(work, unfinished.missing, client, unfinished.folder):
                    unfinished.note(number, sums)
                    own.add(number)
                    advance(layout.length(number))
            damaged = unfinished.drop_damaged()
            if own.intersection(damaged):
                words = f"block {damaged[0]} is not what was just written"
                raise OutputError(unfinished.folder, words, "check the disk and run it again")
            if not damaged:
                break
    unfinished.finish(target)


def _made(
    work: Work, numbers: list[int], client: object, folder: Path | None = None
) -> Iterator[tuple[int, Any]]:
    """Blocks by their numbers, as they come; with a folder, the checksums of what is in it."""
    if client is None:
        for number in numbers:
            yield number, _one(work, number, folder)
    elif numbers:
        with _client(client) as of:
            yield from _by_cluster(work, numbers, of, folder)


def _one(work: Work, number: int, folder: Path | None) -> Any:
    """Make a block, and write it if there is a folder for it; runs on workers, too."""
    block = work.make(number)
    return block if folder is None else write_block(folder, work.layout, number, block)


def _by_cluster(
    work: Work, numbers: list[int], client: Client, folder: Path | None
) -> Iterator[tuple[int, Any]]:
    from distributed import as_completed

    sent = client.scatter(work, broadcast=True, hash=False)
    threads = sum(client.nthreads().values()) or 1
    waiting = iter(numbers)
    numbered: dict[Any, int] = {}

    def submit(number: int) -> Any:
        future = client.submit(_one, sent, number, folder, pure=False)
        numbered[future] = number
        return future

    first = [submit(n) for _, n in zip(range(WAITING * threads), waiting, strict=False)]
    done = as_completed(first, loop=client.loop)
    for future in done:
        try:
            yield numbered.pop(future), future.result()
        except EarthspinError:
            raise
        except Exception as error:
            if type(error).__module__.partition(".")[0] != "distributed":
                raise
            words = f"the cluster lost it: {one_line(error)}"
            raise SceneError("client", str(client.scheduler), words) from None
        for number in waiting:
            done.add(submit(number))
            break


@contextmanager
def _client(given: object) -> Iterator[Client]:
    """A client of a cluster that there is, or of one that lives as long as it is needed."""
    try:
        import distributed
    except ImportError:
        raise MissingExtraError("distributed", "scale", "work by many processes") from None
    if isinstance(given, distributed.Client):
        yield given
    elif isinstance(given, str):
        try:
            found = distributed.Client(given, timeout=PATIENCE, set_as_default=False)
        except Exception as error:  # of the address, the network or another version
            words = f"no scheduler answers there within {PATIENCE} s: {one_line(error)}"
            raise SceneError("scheduler", given, words) from None
        with found:
            if not found.nthreads():
                raise SceneError("scheduler", given, "it has no workers; start some")
            yield found
    elif isinstance(given, int):
        import dask

        quiet = {"distributed.admin.log-format": "", "logging.distributed": "critical"}
        with (
            dask.config.set(quiet),
            distributed.LocalCluster(
                n_workers=given,
                threads_per_worker=1,
                dashboard_address=f"{HERE}:0",
                silence_logs=50,
                host=HERE,
            ) as cluster,
            distributed.Client(cluster, set_as_default=False) as made,
        ):
            yield made


def _check_client(given: object) -> None:
    """Refuse what is no client, before anything is computed.

    Raises
    ------
    SceneError
    """
    counted = isinstance(given, int) and not isinstance(given, bool) and given > 0
    if not (given is None or counted or isinstance(given, str) or hasattr(given, "scatter")):
        words = "give a number of workers, the address of a scheduler, or a Client of distributed"
        raise SceneError("client", given, words)


# --- what there is already -----------------------------------------------------------------------


def _asked(work: Work) -> dict[str, str]:
    """What is asked, of which versions, and how it is cut."""
    layout = work.layout
    return dict(work.asked) | {"size": f"{layout.size} along {layout.along} by {layout.block}"}


def _made_of(target: Path) -> str | None:
    """What a complete store was made of, in a word; None where there is no store."""
    from earthspin.engine.drafts import put_back

    put_back(target)
    if not target.exists():
        return None
    try:
        return str(zarr_of().open_group(target, mode="r", zarr_format=2).attrs.get(MADE_OF, ""))
    except Exception:  # whatever zarr says of a folder that is damaged: it is another store
        return ""


def _clear_up(target: Path, work: Work) -> None:
    """Take away what is left beside a store that is complete."""
    import shutil

    with held(target, _asked(work), work.layout) as left:
        if left is not None:
            shutil.rmtree(left.folder)


def _remedy(target: Path) -> str:
    there = target.with_name(target.name + PARTIAL)
    return f"what is done stays in {there.name}: make room and run it again"


@contextmanager
def _interrupts_told(unfinished: Unfinished) -> Iterator[None]:
    """Add to whatever ends the loop from outside how to go on."""
    try:
        yield
    except Exception:
        raise
    except BaseException as ended:
        layout = unfinished.layout
        done = sum(map(layout.length, unfinished.done))
        ended.add_note(
            f"{done} of {layout.size} are kept in {unfinished.folder.name}; "
            "the same command goes on from there"
        )
        raise

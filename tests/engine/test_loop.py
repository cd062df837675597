"""One loop for many: whole or to be gone on with, and always the same bytes."""

from __future__ import annotations

import errno
import itertools
import os
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import pytest
import xarray as xr
import zarr

import earthspin
from earthspin import EarthspinError, OutputError, SceneError
from earthspin.engine import atomic_writes, blocks
from tests.engine.work import Squares, bytes_of
from tests.processes import printed


@pytest.fixture
def undisturbed(tmp_path: Path) -> Path:
    """A store that was made in one go."""
    return blocks.write(Squares(), tmp_path / "undisturbed.zarr")


class _EndError(BaseException):
    """An end from outside."""


@dataclass
class Ends(Squares):
    """Work that is ended when a block is reached."""

    at: int = 3
    error: BaseException = field(default_factory=_EndError)

    def make(self, number: int):  # type: ignore[no-untyped-def]
        if number == self.at:
            raise self.error
        return super().make(number)


def ended(path: Path, at: int = 3) -> Path:
    """A store whose writer ended before a block."""
    with pytest.raises(_EndError) as end:
        blocks.write(Ends(at=at), path)
    kept = f"{3 * at} of 20 are stored in {path.name}.partial"
    assert end.value.__notes__ == [f"{kept}; run the same command to continue"]
    return path.with_name(path.name + ".partial")


def test_a_store_holds_what_was_made(undisturbed: Path) -> None:
    answer = earthspin.open(undisturbed)
    assert np.array_equal(answer.square.sel(column="plus"), np.arange(20) ** 2.0)
    assert answer.day[19] == np.datetime64("2000-01-20")
    assert answer.identical(blocks.hold(Squares()))
    assert earthspin.verify(undisturbed) == undisturbed
    assert [p.name for p in undisturbed.parent.iterdir()] == ["undisturbed.zarr"]


def test_a_store_holds_no_date_and_no_path(undisturbed: Path, tmp_path: Path) -> None:
    time.sleep(1.1)
    (tmp_path / "elsewhere").mkdir()
    again = blocks.write(Squares(), tmp_path / "elsewhere" / "other.zarr")
    assert bytes_of(again) == bytes_of(undisturbed)


@pytest.mark.parametrize("at", [1, 3, 6])
@pytest.mark.parametrize("error", [_EndError(), RuntimeError("half-way")])
def test_it_goes_on_where_it_was_ended(
    tmp_path: Path, undisturbed: Path, at: int, error: BaseException
) -> None:
    path, work = tmp_path / "r.zarr", Squares()
    with pytest.raises(type(error)):
        blocks.write(Ends(at=at, error=error), path)
    assert path.with_name("r.zarr.partial").is_dir()
    assert not path.exists()
    blocks.write(work, path)
    assert work.made == list(range(at, 7))
    assert bytes_of(path) == bytes_of(undisturbed)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["r.zarr", "undisturbed.zarr"]


def test_a_complete_store_is_not_made_again(undisturbed: Path) -> None:
    work = Squares()
    assert blocks.write(work, undisturbed) == undisturbed
    assert work.made == []


@pytest.mark.parametrize("done", [False, True])
@pytest.mark.parametrize(
    ("other", "words"),
    [
        (Squares(question="cubes"), "another question"),
        (Squares(version="2"), "another version"),
        (Squares(size=21), "another size"),
        (Squares(block=4), "another size"),
    ],
)
def test_a_store_of_something_else_is_left_alone(
    tmp_path: Path, other: Squares, words: str, done: bool
) -> None:
    path = tmp_path / "r.zarr"
    if done:
        blocks.write(Squares(), path)
    else:
        ended(path)
    before = bytes_of(tmp_path)
    with pytest.raises(OutputError, match="another question" if done else words):
        blocks.write(other, path)
    assert bytes_of(tmp_path) == before
    assert other.made == []


def test_a_series_replaces_what_stands_there(tmp_path: Path) -> None:
    path = blocks.write(Squares(size=4), tmp_path / "r.zarr")
    blocks.write(Squares(), path, replace=True)
    assert earthspin.open(path).sizes["member"] == 20
    assert [p.name for p in tmp_path.iterdir()] == ["r.zarr"]


def test_two_runs_on_one_store(tmp_path: Path, undisturbed: Path) -> None:
    path, refused, second = tmp_path / "r.zarr", list[str](), Squares()

    class First(Squares):
        def make(self, number: int) -> xr.Dataset:
            if number in (0, 2):
                with pytest.raises(OutputError) as error:
                    blocks.write(second, path)
                refused.append(str(error.value))
            return super().make(number)

    blocks.write(First(), path)
    assert len(refused) == 2
    assert all("another run is writing it" in complaint for complaint in refused)
    assert second.made == []
    assert bytes_of(path) == bytes_of(undisturbed)


def test_a_disk_that_is_full(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, undisturbed: Path
) -> None:
    path, written = tmp_path / "r.zarr", itertools.count()
    real = zarr.Array.__setitem__

    def full(array: zarr.Array, where: object, values: object) -> None:
        if next(written) > 6:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        real(array, where, values)

    with monkeypatch.context() as patched:
        patched.setattr(zarr.Array, "__setitem__", full)
        with pytest.raises(OutputError) as error:
            blocks.write(Squares(), path)
    assert "No space left" in str(error.value)
    assert "r.zarr.partial: free some space and run it again" in str(error.value)
    work = Squares()
    blocks.write(work, path)
    assert 1 < len(work.made) < 7
    assert bytes_of(path) == bytes_of(undisturbed)


def test_a_disk_without_room_is_refused_at_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    usage = (100, 90, 10)
    monkeypatch.setattr(
        atomic_writes.shutil, "disk_usage", lambda at: type("U", (), {"free": usage[2]})
    )
    work = Squares()
    with pytest.raises(OutputError, match=r"20 members take .* 10 B of the disk are free"):
        blocks.write(work, tmp_path / "r.zarr")
    assert work.made == [0]
    assert list(tmp_path.iterdir()) == []


def test_places_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    (tmp_path / "folder.zarr").mkdir()
    for place in ("r.nc", "file/r.zarr", "folder.zarr"):
        work = Squares()
        with pytest.raises(OutputError):
            blocks.write(work, tmp_path / place)
        assert work.made == []


def test_a_folder_of_others_is_left_alone(tmp_path: Path) -> None:
    folder = tmp_path / "r.zarr.partial"
    folder.mkdir()
    (folder / "letter.txt").write_text("not of this program")
    with pytest.raises(OutputError, match=r"asked\.json"):
        blocks.write(Squares(), tmp_path / "r.zarr")
    assert (folder / "letter.txt").read_text() == "not of this program"


# --- damaged while it was unfinished -------------------------------------------------------------


def flip(path: Path) -> None:
    """Turn one bit of a file."""
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 4
    path.write_bytes(content)


@pytest.mark.parametrize(
    ("chunk", "damage"),
    [
        *(("square/0.0", damage) for damage in (flip, Path.unlink, lambda p: p.write_bytes(b""))),
        *((chunk, flip) for chunk in ("square/2.0", "member/1", "day/2")),
        ("square/2.0", lambda p: p.write_bytes(b"half a chu")),
    ],
)
def test_a_damaged_block_is_made_again(
    tmp_path: Path, undisturbed: Path, chunk: str, damage: Callable[[Path], object]
) -> None:
    path, work = tmp_path / "r.zarr", Squares()
    damage(ended(path) / blocks.STORE / chunk)
    blocks.write(work, path)
    assert work.made == sorted([3, 4, 5, 6, int(chunk.partition("/")[2][0])])
    assert bytes_of(path) == bytes_of(undisturbed)
    assert earthspin.verify(path) == path


@pytest.mark.parametrize("name", ["square/6.0", "day/6"])
def test_a_damaged_block_where_none_is_missing(
    tmp_path: Path, undisturbed: Path, name: str
) -> None:
    path, work = tmp_path / "r.zarr", Squares()
    folder = ended(path, 6)
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(blocks, "finish", lambda *_: None)
        blocks.write(Squares(), path)
    flip(folder / blocks.STORE / name)
    blocks.write(work, path)
    assert work.made == [6]
    assert bytes_of(path) == bytes_of(undisturbed)


@pytest.mark.parametrize("damage", [flip, Path.unlink])
@pytest.mark.parametrize(
    "file",
    [
        f"store/{name}"
        for name in (
            ".zattrs", ".zgroup", "square/.zarray", "square/.zattrs",
            "member/.zattrs", "constant/0", "constant/.zattrs", "column/0",
        )
    ] + [blocks.REQUEST],
)  # fmt: skip
def test_a_damaged_frame_is_refused(
    tmp_path: Path, file: str, damage: Callable[[Path], object]
) -> None:
    path = tmp_path / "r.zarr"
    folder = ended(path)
    damage(folder / file)
    work = Squares()
    with pytest.raises(OutputError):
        blocks.write(work, path)
    assert work.made == []
    assert not path.exists()


def test_a_damaged_finished_store_is_refused(undisturbed: Path) -> None:
    flip(undisturbed / "square" / "1.0")
    with pytest.raises(OutputError):
        blocks.write(Squares(), undisturbed)


def test_a_disk_that_changes_what_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_block = blocks.write_block

    def damaging(folder: Path, layout: blocks.Layout, number: int, block: xr.Dataset):  # type: ignore[no-untyped-def]
        write_block(folder, layout, number, block)
        flip(folder / blocks.STORE / "square" / f"{number}.0")

    monkeypatch.setattr(blocks, "write_block", damaging)
    with pytest.raises(OutputError, match="differs"):
        blocks.write(Squares(), tmp_path / "r.zarr")
    monkeypatch.undo()
    blocks.write(Squares(), tmp_path / "r.zarr")
    earthspin.verify(tmp_path / "r.zarr")


# --- killed --------------------------------------------------------------------------------------

KILLED = """
import os, random, signal, sys, time
from pathlib import Path
import xarray, zarr, numcodecs                    # loaded once; each child is a copy
from earthspin.engine import blocks
from tests.engine.work import Squares, blocks_in
path, times = Path(sys.argv[1]), int(sys.argv[2])
partial, chance = path.with_name(path.name + ".partial"), random.Random(int(sys.argv[3]))
for _ in range(times):
    child = os.fork()
    if not child:
        blocks.write(Squares(size=150, seconds=0.004), path)
        os._exit(0)
    time.sleep(chance.uniform(0.02, 0.35))
    os.kill(child, signal.SIGKILL)
    _, status = os.waitpid(child, 0)
    print(int(os.WIFSIGNALED(status)), blocks_in(partial))
    if path.exists():
        path.rename(f"{path}.{_}")                # and once more from the beginning
"""


@pytest.mark.parametrize(
    "times",
    [pytest.param(10, marks=pytest.mark.slow), pytest.param(100, marks=pytest.mark.every_kill)],
)
def test_killed_again_and_again(tmp_path: Path, times: int) -> None:
    """Kill a run again and again; what comes out must be what an undisturbed run gives."""
    path = tmp_path / "killed.zarr"
    out = printed(KILLED, str(path), str(times), "20")
    rows = [tuple(map(int, line.split())) for line in out.splitlines()]
    assert len(rows) == times
    assert sum(was for was, _ in rows) >= times / 2  # most were killed on their way
    work = Squares(size=150)
    had = rows[-1][1] if path.with_name("killed.zarr.partial").exists() else 0
    blocks.write(work, path)
    assert len(work.made) == work.layout.count - had  # no block that was done
    straight = bytes_of(blocks.write(Squares(size=150), tmp_path / "straight.zarr"))
    made = sorted(tmp_path.glob("killed.zarr*"))
    assert path in made
    for store in made:
        assert bytes_of(store) == straight


@pytest.mark.parametrize("step", ["missing_blocks", "finish"])
def test_an_end_beside_the_blocks_says_what_is_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, step: str
) -> None:
    """While what is stored is read again, or compared at the end."""

    def end(*_: object) -> None:
        raise _EndError

    monkeypatch.setattr(blocks, step, end)
    with pytest.raises(_EndError) as error:
        blocks.write(Squares(), tmp_path / "r.zarr")
    (kept,) = error.value.__notes__
    assert "stored in r.zarr.partial; run the same command" in kept


# --- by a cluster --------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_cluster_of_two_makes_the_same_bytes(tmp_path: Path, undisturbed: Path) -> None:
    path = blocks.write(Squares(), tmp_path / "r.zarr", client=np.int64(2))
    assert bytes_of(path) == bytes_of(undisturbed)


def _connections(process: psutil.Process) -> list[Any]:
    """All of a process: the method has another name before psutil 6."""
    method = getattr(process, "net_connections", None) or process.connections
    return list(method("all"))


def test_a_cluster_listens_to_this_machine_only() -> None:
    with blocks._cluster(1):
        own = psutil.Process()
        connections = [
            connection
            for process in (own, *own.children(recursive=True))
            for connection in _connections(process)
            if connection.status == psutil.CONN_LISTEN
        ]
    assert len(connections) >= 3  # of the scheduler, the worker and its nurse
    assert {connection.laddr.ip for connection in connections} == {"127.0.0.1"}


def test_a_scheduler_that_does_not_answer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(blocks, "TIMEOUT", 1)
    with pytest.raises(SceneError, match="within 1 s"):
        blocks.write(Squares(), tmp_path / "r.zarr", client="tcp://127.0.0.1:9")
    blocks.write(Squares(), tmp_path / "r.zarr")


@pytest.mark.parametrize("client", [0, -1, True, 2.5, "nonsense://x"])
def test_what_is_no_client(tmp_path: Path, client: object, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(blocks, "TIMEOUT", 1)
    with pytest.raises(EarthspinError):
        blocks.write(Squares(), tmp_path / "r.zarr", client=client)

"""Two writers, readers and threads at once, and writers that are killed: whole or not at all."""

from __future__ import annotations

import os
import subprocess
import sys
import textwrap
import threading
import time
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from earthspin import OutputError
from earthspin.engine import drafts, store

ROOT = Path(__file__).parents[2]


def small(value: float = 1.0, size: int = 50) -> xr.Dataset:
    times = np.datetime64("2000-01-01", "us") + np.arange(size) * np.timedelta64(1, "h")
    return xr.Dataset(
        {"x": ("time", np.full(size, value)), "y": ("time", np.full(size, -value))},
        {"time": times},
        {"title": f"all {value}"},
    )


def python(program: str, *arguments: str) -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(program), *arguments],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        cwd=ROOT,
    )


#: Writes when it is told to, under a process id that means nothing here: another container's.
ELSEWHERE = """
    import os, sys
    import distributed  # xarray imports it when it writes, and it asks what process this is
    os.getpid = lambda: 4_194_000
    from earthspin.engine import drafts, store
    from tests.force.test_two_at_once import small
    with drafts.replacing(sys.argv[1]) as draft:
        print("begun", flush=True)
        sys.stdin.readline()
        store.write(small(2.0), draft)
    print("done", flush=True)
"""


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["nc", "zarr"])
def test_a_writer_in_another_container_keeps_its_draft(tmp_path: Path, kind: str) -> None:
    path = tmp_path / f"r.{kind}"
    other = python(ELSEWHERE, str(path))
    assert other.stdin is not None
    assert other.stdout is not None
    assert other.stdout.readline() == b"begun\n"
    (draft,) = tmp_path.glob(".*.draft")
    store.write(small(1.0), path)
    assert store.open(path).identical(small(1.0))
    assert draft.exists()
    out, complaint = other.communicate(b"\n", timeout=60)
    assert (out, complaint, other.returncode) == (b"done\n", b"", 0)
    assert store.open(path).identical(small(2.0))
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["nc", "zarr"])
def test_readers_find_the_old_or_the_new(tmp_path: Path, kind: str) -> None:
    path = store.write(small(0.0), tmp_path / f"r.{kind}")
    seen: list[float] = []
    trouble: list[BaseException] = []
    done = threading.Event()

    def read_all_the_time() -> None:
        while not done.is_set():
            try:
                found = store.open(path).load()
                value = float(found.x[0])
                assert found.identical(small(value))
                seen.append(value)
            except OutputError as error:
                if "was replaced while it was read" not in str(error):
                    trouble.append(error)
            except BaseException as error:
                trouble.append(error)

    reader = threading.Thread(target=read_all_the_time)
    reader.start()
    for number in range(1, 26):
        store.write(small(float(number)), path)
    while not (seen or trouble):  # on a busy machine each read so far may have met a writer
        time.sleep(0.01)
    done.set()
    reader.join()
    assert not trouble


def test_a_store_whose_writer_was_killed_between_two_moves_is_found(tmp_path: Path) -> None:
    path = store.write(small(1.0), tmp_path / "r.zarr")
    program = """
        import os, signal, sys
        from earthspin.engine import drafts, store
        from tests.force.test_two_at_once import small
        drafts._exchange = lambda draft, target: False   # a system that cannot
        move = os.replace
        def move_and_die(source, target):
            move(source, target)
            if os.path.basename(target) == "old":
                os.kill(os.getpid(), signal.SIGKILL)
        os.replace = move_and_die
        store.write(small(2.0), sys.argv[1])
    """
    process = python(program, str(path))
    process.communicate()
    assert process.returncode == -9
    assert not path.exists()
    found = store.open(path)
    assert isinstance(found, xr.Dataset)
    assert found.load().identical(small(1.0))
    assert list(tmp_path.iterdir()) == [path]


def test_a_store_is_never_absent_where_folders_can_change_places(tmp_path: Path) -> None:
    one, other = tmp_path / "one", tmp_path / "other"
    for folder in (one, other):
        folder.mkdir()
        (folder / folder.name).touch()
    if not drafts._exchange(one, other):
        pytest.fail("this system cannot exchange folders; the tests are made for one that can")
    assert [p.name for p in one.iterdir()] == ["other"]
    assert [p.name for p in other.iterdir()] == ["one"]


def test_a_reader_waits_for_a_store_that_is_being_replaced(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Between the two moves, as long as the writer lives."""
    path = store.write(small(1.0), tmp_path / "r.zarr")
    moved, real = threading.Event(), os.replace

    def slow(source: Path, target: Path) -> None:
        real(source, target)
        if Path(target).name == "old":
            moved.set()
            time.sleep(0.3)

    monkeypatch.setattr(drafts, "_exchange", lambda draft, target: False)  # a system that cannot
    monkeypatch.setattr(os, "replace", slow)
    writer = threading.Thread(target=store.write, args=(small(2.0), path))
    writer.start()
    moved.wait()
    assert not path.exists()
    found = store.open(path)
    writer.join()
    assert found.load().identical(small(2.0))


@pytest.mark.parametrize("kind", ["nc", "zarr"])
def test_what_takes_its_place_is_on_the_disk(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str
) -> None:
    """Every file before the move, the folder that names it after."""
    synced: list[str] = []
    real = os.fsync

    def fsync(file: int) -> None:
        synced.append(os.readlink(f"/proc/self/fd/{file}"))
        real(file)

    monkeypatch.setattr(os, "fsync", fsync)
    path = store.write(small(), tmp_path / f"r.{kind}")
    assert synced[-1] == str(tmp_path)
    written = {p.relative_to(path) for p in path.rglob("*")} if path.is_dir() else {Path()}
    drafted = {name.partition(f".draft/{path.name}")[2].lstrip("/") for name in synced[:-1]}
    assert {str(p) for p in written} - {"."} <= drafted | {"."}
    assert len(synced) > len(written)


def test_a_disk_that_fails_to_keep_it_leaves_the_old_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = store.write(small(1.0), tmp_path / "r.nc")

    def full(file: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OutputError, match="No space left"):
        store.write(small(2.0), path)
    assert store.open(path).identical(small(1.0))
    assert list(tmp_path.iterdir()) == [path]


def test_drafts_without_a_lock_are_given_time(tmp_path: Path) -> None:
    """One that is being made has no lock yet; one that has been there for a while has no owner."""
    young, old = tmp_path / ".r.nc.young.draft", tmp_path / ".r.nc.old.draft"
    young.mkdir()
    old.mkdir()
    os.utime(old, (1e9, 1e9))
    store.write(small(), tmp_path / "r.nc")
    assert young.exists()
    assert not old.exists()


@pytest.mark.slow
def test_threads_read_and_write_netcdf(tmp_path: Path) -> None:
    """In a process of its own: without a lock the library ends it."""
    program = """
        import sys, threading
        from pathlib import Path
        from earthspin.engine import store
        from tests.force.test_two_at_once import small
        def work(number):
            path = Path(sys.argv[1], f"{number}.nc")
            for turn in range(75):
                store.write(small(float(turn)), path)
                assert store.open(path).identical(small(float(turn)))
            whole.append(number)
        whole = []
        threads = [threading.Thread(target=work, args=(n,)) for n in range(4)]
        [t.start() for t in threads]
        [t.join() for t in threads]
        print(sorted(whole))
    """
    process = python(program, str(tmp_path))
    out, complaint = process.communicate()
    assert (process.returncode, complaint) == (0, b"")
    assert out == b"[0, 1, 2, 3]\n"


@pytest.mark.parametrize("path", [3, None, 1.5, ["r.nc"], b"r.nc"])
def test_what_is_no_path_is_named(path: object) -> None:
    for call in (store.open, store.verify, lambda p: store.write(small(), p)):
        with pytest.raises(TypeError, match="path is of type"):
            call(path)  # type: ignore[operator]


def test_a_name_that_no_file_can_have() -> None:
    for name in ("a\0b.nc", "\ud800.nc"):
        for call in (store.open, store.verify, lambda p: store.write(small(), p)):
            with pytest.raises(OutputError, match="no file can have such a name"):
                call(name)

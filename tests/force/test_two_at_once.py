"""Two writers, readers and threads at once, and writers that are killed: whole or not at all."""

import asyncio
import multiprocessing
import subprocess
import sys
import textwrap
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin import OutputError
from earthspin.cli import main
from earthspin.engine import atomic_writes, store

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
    from earthspin.engine import atomic_writes, store
    from tests.force.test_two_at_once import small
    with atomic_writes.replacing(sys.argv[1]) as draft:
        print("begun", flush=True)
        sys.stdin.readline()
        store.write(small(2.0), draft)
    print("done", flush=True)
"""


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["nc", "zarr"])
def test_a_second_writer_is_refused(tmp_path: Path, kind: str) -> None:
    path = store.write(small(0.0), tmp_path / f"r.{kind}")
    other = python(ELSEWHERE, str(path))
    assert other.stdin is not None
    assert other.stdout is not None
    assert other.stdout.readline() == b"begun\n"
    with pytest.raises(OutputError, match="another run"):
        store.write(small(1.0), path)
    assert store.open(path).identical(small(0.0))
    out, complaint = other.communicate(b"\n", timeout=60)
    assert (out, complaint, other.returncode) == (b"done\n", b"", 0)
    assert store.open(path).identical(small(2.0))
    store.write(small(1.0), path)
    assert store.open(path).identical(small(1.0))
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
                # A store is missing for a moment, between two moves.
                expected = ["was replaced while it was read"]
                expected += ["No such file", "does not exist"] * (kind == "zarr")
                if not any(words in str(error) for words in expected):
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


@pytest.mark.slow
def test_a_store_whose_writer_was_killed_between_two_moves_is_restored(tmp_path: Path) -> None:
    """By the next writer, even if that one fails."""
    path = store.write(small(1.0), tmp_path / "r.zarr")
    program = """
        import os, signal, sys
        from earthspin.engine import atomic_writes, store
        from tests.force.test_two_at_once import small
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
    with pytest.raises(RuntimeError, match="half-way"), atomic_writes.replacing(path):
        raise RuntimeError("half-way")
    assert store.open(path).identical(small(1.0))
    assert list(tmp_path.iterdir()) == [path]


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


def digests(_: int = 0) -> list[str]:
    """Return the hashes of all numbers and attributes of four answers."""
    scenes = ("precession", "torque", "wobble", "long-term")
    return [store.content_hash({"/": earthspin.run(scene)}) for scene in scenes]


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
def test_threads_asyncio_and_forks_give_the_same_bits() -> None:
    expected = digests()
    with ThreadPoolExecutor(16) as pool:
        assert all(each == expected for each in pool.map(digests, range(16)))

    async def together() -> list[list[str]]:
        return await asyncio.gather(*(asyncio.to_thread(digests) for _ in range(3)))

    assert asyncio.run(together()) == 3 * [expected]
    with multiprocessing.get_context("fork").Pool(2) as processes:
        assert processes.map(digests, range(2)) == 2 * [expected]


@pytest.mark.parametrize("name", ["loop.nc", "loop.zarr", "loop/r.nc", "loop/r.zarr"])
def test_a_loop_of_links_is_one_line(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    first = tmp_path / Path(name).parts[0]
    first.symlink_to(tmp_path / "other")
    (tmp_path / "other").symlink_to(first)
    scene = earthspin.load_scene("torque", {"span": ["2000-01-01", "2000-01-03"]})
    calls = [store.open, store.verify, lambda p: store.write(small(), p)]
    if path.suffix == ".zarr":
        calls += [lambda p: earthspin.write_series(scene, p)]
        calls += [lambda p: earthspin.ensemble("precession", 2, path=p)]
    for call in calls:
        with pytest.raises(OutputError, match="symbolic links"):
            call(path)
    assert main(["run", "torque", "--out", str(path)]) == 2
    assert {p.name for p in tmp_path.iterdir()} == {first.name, "other"}


def test_a_name_that_no_file_can_have() -> None:
    for name in ("a\0b.nc", "\ud800.nc"):
        for call in (store.open, store.verify, lambda p: store.write(small(), p)):
            with pytest.raises(OutputError, match="name"):
                call(name)

"""Kills of a worker, of the scheduler, of everything: nothing is lost, nothing left running."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import psutil
import pytest

from earthspin import SceneError
from earthspin.engine import blocks
from tests.engine.work import Squares, blocks_in, bytes_of

ROOT = Path(__file__).parents[2]
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(ROOT)}
#: Seconds after which no process may be left.
MINUTE = 60

RUN = """
import sys
from earthspin.engine import blocks
from tests.engine.work import Squares

if __name__ == "__main__":
    client = int(sys.argv[2]) if sys.argv[2].isdecimal() else sys.argv[2]
    blocks.write(Squares(size=150, seconds=0.05), sys.argv[1], client=client)
"""


#: After how many of its fifty blocks a run is killed, the first of which is made before there is a
#: worker. The three tests together kill 102 times beside what the slow tests do.
AFTER = pytest.mark.parametrize(
    "blocks",
    [
        pytest.param(5, marks=pytest.mark.slow),
        *(pytest.param(n, marks=pytest.mark.every_kill) for n in range(2, 37) if n != 5),
    ],
)


#: Store, cluster and blocks to the process that makes it.
Start = Callable[[Path, str, int], subprocess.Popen[bytes]]


@pytest.fixture
def undisturbed(tmp_path: Path) -> dict[str, str]:
    """What an undisturbed run gives."""
    return bytes_of(blocks.write(Squares(size=150), tmp_path / "undisturbed.zarr"))


@pytest.fixture
def started(tmp_path: Path) -> Iterator[Start]:
    """Start the program by a cluster, and wait until some blocks are done."""
    processes, program = [], tmp_path / "program.py"
    program.write_text(RUN)

    def start(path: Path, client: str, blocks: int) -> subprocess.Popen[bytes]:
        process = subprocess.Popen(
            [sys.executable, str(program), str(path), client],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, cwd=ROOT, env=ENVIRONMENT,
        )  # fmt: skip
        processes.append(process)
        partial = path.with_name(path.name + ".partial")
        until(lambda: blocks_in(partial) >= blocks)
        return process

    yield start
    for process in processes:
        process.kill()
        process.wait()
        assert process.stderr
        process.stderr.close()


def until(holds: object, seconds: float = MINUTE) -> None:
    """Wait until something holds."""
    assert callable(holds)
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end, "it does not come"
        time.sleep(0.02)


def gone(processes: list[psutil.Process]) -> bool:
    """Whether processes have ended."""
    return not any(p.is_running() and p.status() != psutil.STATUS_ZOMBIE for p in processes)


def finished(path: Path, undisturbed: dict[str, str]) -> None:
    """Go on with what was left, and compare."""
    partial = path.with_name(path.name + ".partial")
    had = blocks_in(partial)
    work = Squares(size=150)
    blocks.write(work, path)
    assert len(work.made) == work.layout.count - had
    assert bytes_of(path) == undisturbed
    assert not partial.exists()


@AFTER
def test_everything_killed(
    tmp_path: Path, started: Start, undisturbed: dict[str, str], blocks: int
) -> None:
    path = tmp_path / "r.zarr"
    process = started(path, "2", blocks)
    children = psutil.Process(process.pid).children(recursive=True)
    assert len(children) >= 2
    process.send_signal(signal.SIGKILL)
    process.communicate()
    until(lambda: gone(children))
    finished(path, undisturbed)


@AFTER
def test_a_worker_killed(
    tmp_path: Path, started: Start, undisturbed: dict[str, str], blocks: int
) -> None:
    path = tmp_path / "r.zarr"
    process = started(path, "2", blocks)
    children = psutil.Process(process.pid).children()
    workers = [c for c in children if "spawn_main" in " ".join(c.cmdline())]
    workers[0].kill()
    _, said = process.communicate(timeout=MINUTE)
    assert process.returncode == 0, said
    assert bytes_of(path) == undisturbed
    until(lambda: gone(children))


@pytest.fixture
def scheduler(tmp_path: Path) -> Iterator[tuple[subprocess.Popen[bytes], str]]:
    """A scheduler with two workers, each a process of its own."""
    file = tmp_path / "scheduler.json"

    def dask(*words: str) -> subprocess.Popen[bytes]:
        common = ["-m", "dask", *words, "--scheduler-file", str(file), "--no-dashboard"]
        quiet: dict[str, Any] = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        return subprocess.Popen([sys.executable, *common], env=ENVIRONMENT, **quiet)

    made = [dask("scheduler", "--port", "0")]
    until(file.exists)
    worker = ("worker", "--nthreads", "1", "--no-nanny", "--death-timeout", str(MINUTE))
    made += [dask(*worker), dask(*worker)]
    yield made[0], json.loads(file.read_text())["address"]
    for process in made:
        process.kill()
        process.wait()


@AFTER
def test_a_scheduler_killed(
    tmp_path: Path,
    started: Start,
    undisturbed: dict[str, str],
    scheduler: tuple[subprocess.Popen[bytes], str],
    blocks: int,
) -> None:
    path = tmp_path / "r.zarr"
    its_process, address = scheduler
    process = started(path, address, blocks)
    its_process.kill()
    _, said = process.communicate(timeout=MINUTE)
    assert process.returncode != 0
    assert b"the cluster lost a block" in said
    finished(path, undisturbed)


@pytest.mark.parametrize("folder", [None, Path("a.zarr.partial")])
def test_a_cluster_without_workers_says_how_to_continue(folder: Path | None) -> None:
    """Scatter of dask raises a TimeoutError, which was taken for a full disk."""
    client: Any = SimpleNamespace(scheduler="tcp://10.0.0.1:8786")
    with pytest.raises(SceneError) as error, blocks._lost_workers(client, folder):
        raise TimeoutError("No valid workers found")
    words = str(error.value)
    assert "lost a block: No valid workers found; start its workers" in words
    assert ("a.zarr.partial" in words) is (folder is not None)
    with pytest.raises(OSError, match="full"), blocks._lost_workers(client, folder):
        raise OSError("the disk is full")

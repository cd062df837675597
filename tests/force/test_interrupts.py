"""Interrupts at random moments of writing and reading: none hangs, none leaves a wrong file."""

import os
import random
import select
import signal
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

#: Signals that end a command, and the seconds after which an interrupted process counts as hung.
#: Python drops an exception that is raised in a destructor, so one signal in some hundreds is lost;
#: it is sent again, as a person would.
ENDINGS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
HUNG, AGAIN = 60, 20
#: Writes and reads one file again and again; a signal ends a turn, after which the file is checked.
WRITER = """
    import signal, sys
    from pathlib import Path
    import earthspin
    path = Path(sys.argv[1])
    tree = earthspin.run_tree("precession")
    def interrupt(number, frame):
        raise KeyboardInterrupt(number)
    for name in ("SIGINT", "SIGTERM", "SIGHUP"):
        signal.signal(getattr(signal, name), interrupt)
    while True:
        try:
            print("begun", flush=True)
            while True:
                assert earthspin.open(earthspin.write(tree, path)).identical(tree)
        except KeyboardInterrupt:
            pass
        if path.exists():
            assert earthspin.open(path).identical(tree)
        print("ended", flush=True)
"""


def interrupted(turns: int, folder: Path, seed: int) -> None:
    """Interrupt a process that writes a file, and demand that it ends each turn with a whole file.

    Raises
    ------
    AssertionError
        If the process hangs, or the file is wrong.
    """
    draw = random.Random(seed)
    command = [sys.executable, "-c", textwrap.dedent(WRITER), str(folder / "r.nc")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, bufsize=0) as writer:
        assert writer.stdout is not None
        try:
            for turn in range(turns):
                assert writer.stdout.readline() == b"begun\n", turn
                select.select([], [], [], draw.uniform(0, 0.3))
                for _ in range(0, HUNG, AGAIN):
                    os.kill(writer.pid, draw.choice(ENDINGS))
                    if select.select([writer.stdout], [], [], AGAIN)[0]:
                        break
                else:
                    raise AssertionError(f"it hangs after the interrupt {turn}")
                assert writer.stdout.readline() == b"ended\n", turn
        finally:
            writer.kill()


@pytest.mark.slow
def test_no_interrupt_of_a_file_hangs_or_leaves_a_wrong_one(tmp_path: Path) -> None:
    interrupted(50, tmp_path, 20261128)

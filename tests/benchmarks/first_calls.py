"""First and later calls of a process, and commands, with what numpy and xarray alone take.

Run it with `python -m tests.benchmarks.first_calls`; it writes the table of docs/how_fast.md.
Seconds are of the processor, from the start of the process, medians of fresh processes.
"""

import os
import resource
import statistics
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

PAGE = Path(__file__).parents[2] / "docs" / "measured" / "first-calls.inc"
ROUNDS = 5

#: Arguments of the command, and the call in Python.
CALLS = {
    "run torque": "torque_series()",
    "run wobble": "wobble_ladder()",
    "run precession": "precession()",
    "run long-term": "long_term('-1 Myr', '0 kyr', '1 kyr')",
    "run pole": "pole()",
    "run iau": "compare_iau()",
    "run nutation": "nutation_ladder()",
    "report": None,
}
#: Prints the seconds until a call has ended, and those of the same call again.
PROGRAM = """
import time
import earthspin
earthspin.{0}
first = time.process_time()
earthspin.{0}
print(first, time.process_time() - first)
"""
FLOOR = "import numpy, xarray"


def seconds_of(words: list[str]) -> float:
    """Seconds of the processor that a command takes, with its children."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with TemporaryDirectory() as folder:
        subprocess.run(words, cwd=folder, capture_output=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def first_and_later(call: str) -> tuple[float, float]:
    """Seconds of a process until a call has ended, and of the same call again."""
    words = [sys.executable, "-c", PROGRAM.format(call)]
    printed = subprocess.run(words, capture_output=True, check=True, text=True).stdout
    first, later = map(float, printed.split()[-2:])
    return first, later


def main() -> None:
    """Measure, and write the table."""
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    command = [sys.executable, "-m", "earthspin"]
    lines = ["| | command | first call | later call |", "| --- | ---: | ---: | ---: |"]
    for words, call in CALLS.items():
        took = statistics.median(seconds_of([*command, *words.split()]) for _ in range(ROUNDS))
        cells = [f"`earthspin {words}`", f"{took:.2f} s", "", ""]
        if call is not None:
            columns = zip(*(first_and_later(call) for _ in range(ROUNDS)), strict=True)
            cells[2:] = [f"{statistics.median(column):.2g} s" for column in columns]
        lines.append(f"| {' | '.join(cells)} |")
        print(lines[-1], flush=True)
    floor = statistics.median(seconds_of([sys.executable, "-c", FLOOR]) for _ in range(ROUNDS))
    lines.append(f"| numpy and xarray alone | {floor:.2f} s | | |")
    PAGE.write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(f"{PAGE}: written")


if __name__ == "__main__":
    main()

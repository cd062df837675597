"""Later calls of a process against its first ones, and long series against short ones.

Run it with `python -m tests.benchmarks.repeated`. The two calls of a row are made one after the
other in a new process, after a short rotation. Seconds are of the processor, medians of five
processes.
"""

import json
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np

import earthspin

ROUNDS = 5
YEARS = [(f"{year}-01-01", f"{year + 1}-01-01", "1 d") for year in (1990, 1991)]
MONTH = ("2000-01-01", "2000-01-31")
TIMES = np.datetime64("1990-01-01", "s") + 900 * np.arange(100_000)

#: The two calls of each row.
PAIRS: dict[str, tuple[Callable[[], Any], Callable[[], Any]]] = {
    "pole in a year, then in another": (
        lambda: earthspin.pole(*YEARS[0]),
        lambda: earthspin.pole(*YEARS[1]),
    ),
    "pole with all effects, twice": (
        lambda: earthspin.pole(effects="all"),
        lambda: earthspin.pole(effects="all"),
    ),
    "compare_iau, twice": (earthspin.compare_iau, earthspin.compare_iau),
    "nutation_ladder, twice": (earthspin.nutation_ladder, earthspin.nutation_ladder),
    "rotation in a month at 31 times, then at 99,693": (
        lambda: earthspin.rotation(*MONTH, "1 d"),
        lambda: earthspin.rotation(*MONTH, "26 s"),
    ),
    "torques at 100,000 times: by a step, then listed": (
        lambda: earthspin.torque_series(str(TIMES[0]), str(TIMES[-1]), "15 min"),
        lambda: earthspin.torque_series(times=TIMES),
    ),
}


def measured(name: str) -> list[float]:
    """Seconds of the processor of both calls of a row."""
    seconds = []
    earthspin.rotation("2000-01-01", "2000-01-02", "1 d")  # imports
    for call in PAIRS[name]:
        begun = time.process_time()
        call()
        seconds.append(time.process_time() - begun)
    return seconds


def main() -> None:
    """Print the table, as Markdown."""
    print("| calls | first | second | ratio |\n|---|---|---|---|")
    for name in PAIRS:
        command = [sys.executable, "-m", __spec__.name, name]
        runs = [
            json.loads(subprocess.run(command, capture_output=True, check=True).stdout)
            for _ in range(ROUNDS)
        ]
        first, second = (statistics.median(column) for column in zip(*runs, strict=True))
        print(f"| {name} | {first:.2f} s | {second:.2f} s | {first / second:.1f} |")


if __name__ == "__main__":
    if len(sys.argv) > 1:
        print(json.dumps(measured(sys.argv[1])))
    else:
        main()

"""Positions by Chebyshev sums of our own against jplephem's, as ratios in one run.

Run it with `python tests/benchmarks/chebyshev.py`; the segment from the Earth-Moon barycentre to
the Moon of DE421, 13 terms. Both are given blocks that stay in the processor's cache. Times are of
the processor, the median of several rounds; the agreement is asserted, never a time.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

import numpy as np
from jplephem.spk import SPK

from earthspin.constants import J2000_JD
from earthspin.sky.ephemeris import find_kernel
from earthspin.sky.kernel import BLOCK, Epochs, Records

ROUNDS, SIZE = 9, 200_000
RNG = np.random.default_rng(0)
TIMES = {
    "every 10 minutes": np.arange(SIZE) / 144,
    "every hour": np.arange(SIZE) / 24,
    "every day, 30 times": np.tile(np.arange(SIZE // 30) * 1.0, 30),
    "any times of 150 years": RNG.uniform(-36000, 19000, SIZE),
}


def seconds(positions: Callable[[np.ndarray], np.ndarray], days: np.ndarray) -> float:
    """Processor time of one round, block by block."""
    begun = time.process_time()
    for first in range(0, days.size, BLOCK):
        positions(days[first : first + BLOCK])
    return time.process_time() - begun


def main() -> None:
    """Print the table, as Markdown."""
    path = find_kernel("de421")
    segment = next(s for s in SPK.open(path).segments if s.target == 301)
    table = Records(segment, path).table()

    def ours(days: np.ndarray) -> np.ndarray:
        return table.at(Epochs(days))

    def theirs(days: np.ndarray) -> np.ndarray:
        return np.asarray(segment.compute(J2000_JD, days)[:3])

    print("| times | ours, ns a position | jplephem | ratio |\n|---|---|---|---|")
    for name, days in TIMES.items():
        off = np.linalg.norm(ours(days) - theirs(days), axis=0)
        assert np.all(off <= 5e-16 * np.linalg.norm(theirs(days), axis=0))
        rounds = [(seconds(ours, days), seconds(theirs, days)) for _ in range(ROUNDS)]
        mine, other = (
            1e9 * statistics.median(column) / SIZE for column in zip(*rounds, strict=True)
        )
        ratio = statistics.median(b / a for a, b in rounds)
        print(f"| {name} | {mine:.0f} | {other:.0f} | {ratio:.1f} |")


if __name__ == "__main__":
    main()

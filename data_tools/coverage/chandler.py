"""Coverage of period, quality factor and amplitude of the free wobble, from simulated poles.

The seeds are other than those of the tables of docs/wobble.md. The red excitation has 30 or 60 % of
the power at the wobble.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from data_tools.coverage import Row
from data_tools.free_wobble import Cell
from earthspin.wobble.record import NEAR, YEAR, envelope, shortest_span, turning
from tests.wobble.test_observed import driven

#: Memories of the red excitation, d.
MEMORIES = (100.0, 365.0, 1096.0, 1826.0)
QUALITY, YEARS, SHARES = (50.0, 180.0), (65.0, 130.0), (0.3, 0.6)
#: Records of each truth, by method, and the first seed.
DRAWS, FIRST = {"burg": 60, "likelihood": 20}, 10_000
#: Records of 25 years for the amplitudes.
RECORDS = 60


def rows() -> Iterator[Row]:
    """Yield the rows of the topic."""
    yield from amplitudes()
    yield from periods()


def amplitudes() -> Iterator[Row]:
    """Coverage of the amplitudes of free and annual wobble in windows, with a driven wobble."""
    time = np.arange(0.0, 25 * 365.25, 10.0)
    parts: list[list[np.ndarray]] = [[], [], []]
    for seed in range(FIRST, FIRST + RECORDS):
        wobble, background = driven(time, NEAR, seed)
        p = wobble + background + 94 * turning(time, YEAR) + 4.5 * turning(time, -YEAR)
        seen, phasor = envelope(time, p, NEAR), wobble * turning(time, -NEAR)
        inside = [abs(time - middle) <= shortest_span() / 2 for middle in seen.time]
        truth = np.abs([phasor[window].mean() for window in inside])
        parts[0].append((abs(seen.chandler) - truth) / seen.error)
        parts[1].append((abs(seen.annual) - 94) / seen.annual_error)
        parts[2].append((abs(seen.annual_retrograde) - 4.5) / seen.error)
    names = ("free wobble", "annual wobble", "retrograde annual wobble")
    for name, ratios in zip(names, parts, strict=True):
        span = f"windows of {RECORDS} records of 25 yr"
        yield Row.comparing(f"amplitude of the {name}", span, "truth", np.concatenate(ratios), 1.0)


def periods() -> Iterator[Row]:
    """Coverage of the period and of Q, by method and memory."""
    for method, count in DRAWS.items():
        for memory in MEMORIES:
            fits = [
                (quality, row)
                for quality in QUALITY
                for years in YEARS
                for share in SHARES
                for row in Cell(method, quality, years, share, memory).fits(
                    range(FIRST, FIRST + count)
                )
            ]
            truth = np.array([quality for quality, _ in fits])
            period, error, q, low, high = np.array([row for _, row in fits]).T
            span = f"65 and 130 yr, memory {memory:.0f} d"
            yield Row.comparing(f"period, {method}", span, "truth", period - NEAR, error)
            # Q has an interval of two ends: the ratio is that of the logarithms.
            side = np.where(truth > q, np.log(high / q), np.log(q / np.maximum(low, 1e-9)))
            offset = abs(np.log(truth / q)) / side
            inside = float(((low <= truth) & (truth <= high)).mean())
            width = 1 / float(np.quantile(offset, 0.95))
            yield Row(
                f"quality factor, {method}", span, "truth", offset.max(), inside, width, q.size
            )

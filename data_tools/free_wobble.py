"""How well the free wobble is found: simulated poles of known truth, for docs/wobble.md.

Each cell of a grid of quality factors, spans, and shares and memories of red excitation is drawn
many times with fixed seeds, and each method is judged by bias, scatter and how often its 95 %
intervals hold the truth.
"""

from __future__ import annotations

import itertools
import os
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import FloatArray
from earthspin.wobble.observed import fit
from earthspin.wobble.record import NEAR
from tests.reference.simulation import RED_MEMORY, red_size, simulate

QUALITY = {"burg": (50.0, 100.0, 180.0, 400.0), "likelihood": (50.0, 180.0)}
YEARS = (25.0, 65.0, 130.0)
#: Share of red noise in the power of the excitation at the wobble, and its memory in days.
RED = (
    (0.0, RED_MEMORY),
    (0.3, 100.0),
    (0.3, 500.0),
    (0.3, 1096.0),
    (0.3, 1826.0),
    (0.6, 100.0),
    (0.6, 1826.0),
)
#: Records that are drawn in each cell, by method; their seeds are 0, 1, 2, ...
DRAWS = {"burg": 400, "likelihood": 20}
PAGE = Path(__file__).parent.parent / "docs" / "measured" / "free-wobble.inc"


@dataclass(frozen=True)
class Cell:
    """One truth, one span, one method."""

    method: str
    quality: float
    years: float
    share: float
    memory: float

    def row(self, draws: int) -> str:
        """A line of the table."""
        period, error, quality, low, high = self.fits(range(draws)).T
        off = period - NEAR
        columns = (
            f"{self.quality:.0f}",
            f"{self.years:.0f}",
            f"{self.share:.0%}",
            f"{self.memory:.0f}" if self.share else "",
            f"{off.mean():+.1f} ± {off.std() / np.sqrt(off.size):.1f}",
            f"{off.std():.1f}",
            f"{np.median(error):.1f}",
            percent(abs(off) <= error),
            f"{np.median(quality):.0f}",
            percent((low <= self.quality) & (self.quality <= high)),
            percent(low > self.quality),
            percent(high < self.quality),
            f"{draws - off.size}",
        )
        return f"| {' | '.join(columns)} |"

    def fits(self, seeds: Iterable[int]) -> FloatArray:
        """Return period, its error, Q and its bounds, a row for each record with a wobble."""
        red = red_size(NEAR, self.quality, self.share, self.memory)
        rows = []
        for seed in seeds:
            record = simulate(
                self.years, NEAR, self.quality, red=red, memory=self.memory, seed=seed
            )
            try:
                wobble = fit(*record, self.method)
            except UndefinedError:
                continue
            rows.append(
                (wobble.period, wobble.period_error, wobble.quality_factor, *wobble.quality_bounds)
            )
        return np.array(rows)


def percent(holds: NDArray[np.bool_]) -> str:
    """Return the percentage of true elements."""
    return f"{100 * np.mean(holds):.0f}"


HEAD = """
**`"{method}"`**, {draws} records in each row

| Q | years | red | memory, d | bias, d | scatter, d | half-width, d | T held | median Q | Q held \
| below | above | refused |
|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|
"""


def page(draws: dict[str, int]) -> str:
    """The tables of all methods."""
    text = []
    with ProcessPoolExecutor(os.cpu_count()) as workers:
        for method, count in draws.items():
            cells = [
                Cell(method, quality, years, *red)
                for quality, years, red in itertools.product(QUALITY[method], YEARS, RED)
            ]
            text.append(HEAD.format(method=method, draws=count))
            for row in workers.map(Cell.row, cells, itertools.repeat(count)):
                text.append(f"{row}\n")
    return "".join(text).lstrip()


def main() -> int:
    """Write the page."""
    PAGE.write_text(page(DRAWS), encoding="utf-8")
    return 0

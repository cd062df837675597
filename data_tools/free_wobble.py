"""How well the free wobble is found: simulated poles of known truth, for docs/wobble.md.

Each cell of a grid of quality factors, spans and shares of red excitation is drawn many times with
fixed seeds, and each method is judged by bias, scatter and how often its 95 % intervals hold the
truth.
"""

from __future__ import annotations

import argparse
import itertools
import os
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from earthspin.errors import UndefinedError
from earthspin.wobble.observed import fit
from earthspin.wobble.record import NEAR
from earthspin.wobble.simulation import red_share, simulate

QUALITY = (50.0, 100.0, 180.0, 400.0)
YEARS = (25.0, 65.0, 130.0)
RED = (0.0, 12.0, 25.0)  # mas
#: Records that are drawn in each cell, by method; their seeds are 0, 1, 2, ...
DRAWS = {"burg": 400, "likelihood": 60}
PAGE = Path(__file__).parent.parent / "docs" / "measured" / "free-wobble.inc"


@dataclass(frozen=True)
class Cell:
    """One truth, one span, one method."""

    method: str
    quality: float
    years: float
    red: float

    def row(self, draws: int) -> str:
        """A line of the table."""
        found = np.array([one for seed in range(draws) if (one := self.fitted(seed)) is not None])
        period, error, quality, low, high = found.T
        off = period - NEAR
        columns = (
            f"{self.quality:.0f}",
            f"{self.years:.0f}",
            f"{red_share(NEAR, self.quality, self.red):.0%}",
            f"{off.mean():+.1f} ± {off.std() / np.sqrt(off.size):.1f}",
            f"{off.std():.1f}",
            share(abs(off) <= error),
            f"{np.median(quality):.0f}",
            share((low <= self.quality) & (self.quality <= high)),
            share(low > self.quality),
            share(high < self.quality),
            f"{draws - off.size}",
        )
        return f"| {' | '.join(columns)} |"

    def fitted(self, seed: int) -> tuple[float, ...] | None:
        """Period, its error, Q and its bounds; None where a wobble is refused."""
        record = simulate(self.years, NEAR, self.quality, red=self.red, seed=seed)
        try:
            found = fit(*record, self.method)
        except UndefinedError:
            return None
        return (found.period, found.period_error, found.quality_factor, *found.quality_bounds)


def share(of: NDArray[np.bool_]) -> str:
    """Per cent of what is true."""
    return f"{100 * np.mean(of):.0f}"


HEAD = """
**`"{method}"`**, {draws} records in each row

| Q | years | red | bias, d | scatter, d | T held | median Q | Q held | below | above | refused |
|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|
"""


def page(draws: dict[str, int]) -> str:
    """The tables of all methods."""
    text = []
    with ProcessPoolExecutor(os.cpu_count()) as workers:
        for method, count in draws.items():
            cells = [Cell(method, *one) for one in itertools.product(QUALITY, YEARS, RED)]
            text.append(HEAD.format(method=method, draws=count))
            for row in workers.map(Cell.row, cells, itertools.repeat(count)):
                print(method, row, flush=True)
                text.append(f"{row}\n")
    return "".join(text).lstrip()


def main(given: argparse.Namespace) -> int:
    """Write the page."""
    PAGE.write_text(page(DRAWS), encoding="utf-8")
    print(f"wrote {PAGE.name}")
    return 0

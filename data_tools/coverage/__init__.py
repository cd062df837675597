"""Coverage of the claimed errors: the share of independent counterparts inside the half-widths.

The width of a claim is the claimed half-width divided by the one that 95 % of the cases need.

Each module of this package measures one topic: its function `rows` compares what public calls
return, as returned, with independent counterparts. `python -m data_tools coverage` writes one table
for each topic, for docs/coverage.md.
"""

from __future__ import annotations

import importlib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

#: Topics, each a module of this package.
TOPICS: tuple[str, ...] = (
    "pole", "orbits", "moons", "forecast", "chandler", "rotation", "worlds", "long_term"
)  # fmt: skip
FOLDER = Path(__file__).parents[2] / "docs" / "measured"
HEAD = """| quantity | span or case | compared with | largest ratio | inside | width | cases |
|---|---|---|---:|---:|---:|---:|
"""
#: Fewest cases that show which half-width 95 % of them need.
FEWEST = 20


@dataclass(frozen=True)
class Row:
    """Coverage of one quantity over one span.

    Attributes
    ----------
    quantity, span, counterpart : str
        What is compared, over which span or in which case, and with what.
    ratio : float
        Largest difference over claimed half-width.
    inside : float
        Share of cases with a difference of at most the claimed half-width.
    width : float
        Claimed half-width divided by the needed one: the inverse of the 95th percentile of the
        ratio of difference and half-width.
    count : int
        Number of cases.
    is_bound : bool
        Whether the claim is a bound on the error, not a 95 % half-width.
    """

    quantity: str
    span: str
    counterpart: str
    ratio: float
    inside: float
    width: float
    count: int
    is_bound: bool = False

    @classmethod
    def comparing(
        cls,
        quantity: str,
        span: str,
        counterpart: str,
        differences: ArrayLike,
        errors: ArrayLike,
        *,
        is_bound: bool = False,
    ) -> Row:
        """Compare differences with the claimed half-widths, or with the claimed bounds."""
        ratio = np.abs(differences) / np.asarray(errors)
        inside, width = float(np.mean(ratio <= 1)), 1 / float(np.quantile(ratio, 0.95))
        return cls(
            quantity, span, counterpart, float(ratio.max()), inside, width, ratio.size, is_bound
        )

    def line(self) -> str:
        """Return the row as a line of a Markdown table."""
        width = f"{self.width:.2g}" if self.count >= FEWEST else ""
        words = " (bound)" if self.is_bound else ""
        numbers = f"{self.ratio:.2g} | {100 * self.inside:.0f} % | {width} | {self.count}"
        return f"| {self.quantity}{words} | {self.span} | {self.counterpart} | {numbers} |\n"


def table(rows: Iterable[Row]) -> str:
    """Return the table of a topic in Markdown."""
    return HEAD + "".join(row.line() for row in rows)


def main(*topics: str) -> int:
    """Measure the named topics, or all, and write their tables."""
    for topic in topics or TOPICS:
        rows = importlib.import_module(f"data_tools.coverage.{topic}").rows()
        path = FOLDER / f"coverage-{topic.replace('_', '-')}.inc"
        path.write_text(table(rows), encoding="utf-8")
    return 0

"""Coverage of the claimed errors: the share of independent counterparts inside the half-widths.

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
TOPICS: tuple[str, ...] = ("pole", "long_term", "worlds", "chandler", "rotation")
FOLDER = Path(__file__).parents[2] / "docs" / "measured"
HEAD = """| quantity | span or case | compared with | largest ratio | inside | cases |
|---|---|---|---:|---:|---:|
"""


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
    count : int
        Number of cases.
    """

    quantity: str
    span: str
    counterpart: str
    ratio: float
    inside: float
    count: int

    @classmethod
    def comparing(
        cls, quantity: str, span: str, counterpart: str, differences: ArrayLike, errors: ArrayLike
    ) -> Row:
        """Compare differences with the claimed half-widths."""
        ratio = np.abs(differences) / np.asarray(errors)
        inside = float(np.mean(ratio <= 1))
        return cls(quantity, span, counterpart, float(ratio.max()), inside, ratio.size)

    def line(self) -> str:
        """Return the row as a line of a Markdown table."""
        numbers = f"{self.ratio:.2g} | {100 * self.inside:.0f} % | {self.count}"
        return f"| {self.quantity} | {self.span} | {self.counterpart} | {numbers} |\n"


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

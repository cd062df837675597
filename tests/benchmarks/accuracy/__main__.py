"""Measure ladders, and write the tables and figures of docs/work_precision.md and the README.

`python -m tests.benchmarks.accuracy [QUANTITY ...]`; the picture of the README needs all.
"""

import sys
from pathlib import Path

from earthspin.views.drawing import style
from tests.benchmarks.accuracy import LADDERS
from tests.benchmarks.accuracy.figures import PANELS, picture, svg, table
from tests.benchmarks.accuracy.ladder import measured

DOCS = Path(__file__).parents[3] / "docs"


def main(quantities: list[str]) -> int:
    """Measure and write; 1 if a method exceeds its bound."""
    ladders = {quantity: LADDERS[quantity]() for quantity in quantities or LADDERS}
    rows, failed = {}, 0
    for quantity, ladder in ladders.items():
        rows[quantity] = measured(ladder)
        path = DOCS / "measured" / f"accuracy-{quantity}"
        path.with_suffix(".inc").write_text(table(ladder, rows[quantity]), encoding="utf-8")
        with style():
            path.with_suffix(".svg").write_text(
                svg(ladder, rows[quantity]) + "\n", encoding="utf-8"
            )
        print(f"wrote {path.name}", flush=True)
        finest = rows[quantity].groupby("method").error.last()
        for method, bound in ladder.bounds.items():
            if not finest[method] <= bound:
                failed = 1
                print(f"FAILS: {quantity}, {method}: error {finest[method]:.2g}, bound {bound:.2g}")
    if rows.keys() >= PANELS.keys():
        with style():
            picture(ladders, rows).savefig(DOCS / "_static" / "error-against-run-time.png", dpi=100)
    return failed


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

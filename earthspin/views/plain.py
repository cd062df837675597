"""Plain table for a result whose question has no module of tables and figures."""

from __future__ import annotations

from earthspin.views.reading import Result, answer_of
from earthspin.views.table import Table

#: Longer answers are cut here.
ROWS = 40


def numbers(tree: Result) -> Table:
    """Table of a result with one column for each variable."""
    answer = answer_of(tree)
    frame = answer.earthspin.to_frame()
    units = {name: variable.attrs.get("units", "") for name, variable in answer.variables.items()}
    headers = tuple(n if units.get(n, "") in ("", "1") else f"{n}, {units[n]}" for n in frame)
    rows = [
        tuple(f"{cell:.9g}" if isinstance(cell, float) else str(cell) for cell in row)
        for row in frame.head(ROWS).itertuples(index=False)
    ]
    note = "" if len(frame) <= ROWS else f"The first {ROWS} of {len(frame)} rows."
    return Table(answer.attrs["title"], headers, rows, note)


TABLES = [("", numbers)]

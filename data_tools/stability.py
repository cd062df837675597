"""Run the stiff and extreme cases, and put their tables into docs/stability.md."""

from __future__ import annotations

import argparse
from pathlib import Path

import xarray as xr

from earthspin.checks.case import FAILS
from earthspin.checks.stability import stability
from earthspin.views.stability_tables import rows_by_part, tally, tally_line

PAGE = Path(__file__).parents[1] / "docs" / "stability.md"
BEGIN, END = "<!-- measured: begin -->", "<!-- measured: end -->"


def with_tables(page: str, tables: str) -> str:
    """A page whose measured part is replaced.

    Parameters
    ----------
    page : str
        With one line that begins and one that ends the measured part.
    tables : str
    """
    before, rest = page.split(BEGIN)
    after = rest.split(END)[1]
    return f"{before}{BEGIN}\n\n{tables}\n{END}{after}"


def markdown(result: xr.Dataset) -> str:
    """Return the tables in markdown, with the reference of each case.

    Parameters
    ----------
    result : Dataset
        As `stability` gives it.
    """
    lines = []
    for part, rows in rows_by_part(result):
        answered = [
            (
                *(row[name] for name in ("case", "hard_because", "held_against")),
                *(f"{row[name]} {row['unit']}".strip() for name in ("measured", "bound")),
                row["verdict"],
            )
            for row in rows
            if row["verdict"] != "refused"
        ]
        refused = [
            (row["case"], row["hard_because"], row["reason"])
            for row in rows
            if row["verdict"] == "refused"
        ]
        lines.append(f"### {part}\n")
        for head, cells in (
            (("case", "hard because", "compared with", "measured", "bound", "verdict"), answered),
            (("refused", "hard because", "message"), refused),
        ):
            if cells:
                rule = f"|{'---|' * len(head)}"
                lines += [_line(head), rule, *(_line(row) for row in cells), ""]
    return "\n".join([*lines, tally_line(result), ""])


def _line(cells: tuple[str, ...]) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def main(arguments: argparse.Namespace) -> int:
    """Write the page unless a case fails."""
    result = stability()
    print(tally_line(result))
    if tally(result)[FAILS]:
        return 1
    PAGE.write_text(with_tables(PAGE.read_text(encoding="utf-8"), markdown(result)), "utf-8")
    print(f"wrote {PAGE.name}")
    return 0

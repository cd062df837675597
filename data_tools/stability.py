"""Run the stiff and extreme cases, and put their tables into docs/stability.md."""

from __future__ import annotations

import argparse
from pathlib import Path

from earthspin.checks.case import FAILS
from earthspin.checks.stability import stability
from earthspin.views.stability_tables import markdown, tally, tally_line

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


def main(given: argparse.Namespace) -> int:
    """Write the page unless a case fails."""
    result = stability()
    print(tally_line(result))
    if tally(result)[FAILS]:
        return 1
    PAGE.write_text(with_tables(PAGE.read_text(encoding="utf-8"), markdown(result)), "utf-8")
    print(f"wrote {PAGE.name}")
    return 0

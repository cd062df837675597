"""Measure ladders and write what docs/work_precision.md shows: tables and figures."""

from __future__ import annotations

import argparse
from pathlib import Path

import xarray as xr

from earthspin.checks.work_precision import QUANTITIES, accuracy
from earthspin.views.work_precision_views import accuracy_table, svg_of

FOLDER = Path(__file__).parents[1] / "docs" / "measured"


def markdown(result: xr.Dataset) -> str:
    """Sentence, table and note of a quantity, for MyST.

    Parameters
    ----------
    result : Dataset
        As `earthspin.accuracy` gives it.
    """
    table = accuracy_table(result)
    rule = ["---" if n in table.words else "---:" for n in range(len(table.headers))]
    rows = [table.headers, tuple(rule), *table.rows]
    lines = [f"| {' | '.join(row)} |" for row in rows]
    return "\n".join([f"**{result.attrs['sentence']}**", "", *lines, "", table.note, ""])


def main(arguments: argparse.Namespace) -> int:
    """Write a fragment and a figure for one quantity, or for all; 1 if a method fails."""
    FOLDER.mkdir(exist_ok=True)
    failed = 0
    for quantity in [arguments.only] if arguments.only else QUANTITIES:
        result = accuracy(quantity)
        (FOLDER / f"accuracy-{quantity}.inc").write_text(markdown(result), encoding="utf-8")
        (FOLDER / f"accuracy-{quantity}.svg").write_text(svg_of(result) + "\n", encoding="utf-8")
        failed += int((~result.holds).sum())
        print(result.attrs["sentence"], flush=True)
    return int(failed > 0)

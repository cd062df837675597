"""Tables of the numerical stability tests, for the terminal."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import xarray as xr

from earthspin.views.table import Table

HEADERS = ("case", "measured", "bound", "unit", "verdict")


def verdict_tables(result: xr.Dataset) -> list[Table]:
    """Tables of test cases and verdicts, one for each part of the package.

    Parameters
    ----------
    result : Dataset
        As `stability` gives it.
    """
    tables = []
    for part, rows in rows_by_part(result):
        note = f"{len(rows)} cases, {sum(row['run_time'] for row in rows):.1f} s"
        cells = [tuple(row[name] for name in HEADERS) for row in rows]
        tables.append(Table(part, HEADERS, cells, note))
    return tables


def rows_by_part(result: xr.Dataset) -> Iterator[tuple[str, list[dict[str, Any]]]]:
    """For each part of the package, yield the rows of its stability tests, with numbers as text.

    Parameters
    ----------
    result : Dataset
        As `stability` gives it.
    """
    frame = result.to_dataframe().reset_index()
    frame["unit"] = frame["unit"].replace("1", "")
    for name in ("measured", "bound"):
        frame[name] = ["0" if value == 0 else f"{abs(value):.1e}" for value in frame[name]]
    frame.loc[frame["verdict"] == "refused", ["measured", "bound", "unit"]] = ""
    for part, rows in frame.groupby("case_part", sort=False):
        yield part, rows.to_dict("records")


def tally(result: xr.Dataset) -> dict[str, int]:
    """Count the stability tests by verdict: "holds", "refused" and "fails"."""
    return {word: int((result.verdict == word).sum()) for word in ("holds", "refused", "fails")}


def tally_line(result: xr.Dataset) -> str:
    """Sentence with the number of stability tests for each verdict."""
    count = tally(result)
    must = int(result.must_hold.sum())
    return (
        f"{result.sizes['case']} cases, {must} of which must hold: {count['holds']} hold, "
        f"{count['refused']} are refused as they should be, {count['fails']} fail; "
        f"{float(result.run_time.sum()):.1f} s"
    )


def print_verdicts(result: xr.Dataset) -> None:
    """Print the tables of stability tests, the reasons of failures, and the counts.

    Parameters
    ----------
    result : Dataset
        As `stability` gives it.
    """
    from earthspin.views.terminal import Terminal

    console = Terminal()
    for table in verdict_tables(result):
        console.print_table(table)
    for name in result.case.values[result.verdict.values == "fails"]:
        console.print(f"fails: {name}: {result.reason.sel(case=name).item()}", markup=False)
    console.print(tally_line(result), markup=False)

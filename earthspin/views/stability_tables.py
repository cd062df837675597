"""The stiff and extreme cases as tables: for the terminal, and for a page of the docs."""

from __future__ import annotations

import xarray as xr

from earthspin.views.table import Table

HEADERS = ("case", "measured", "bound", "unit", "verdict")


def verdict_tables(result: xr.Dataset) -> list[Table]:
    """One table for each part of the package that has cases in the result.

    Parameters
    ----------
    result : Dataset
        As `stability` gives it.
    """
    return [_of_part(result, part) for part in _parts(result)]


def _parts(result: xr.Dataset) -> list[str]:
    """Parts of the package that have cases, in their order."""
    return list(dict.fromkeys(result.case_part.values.tolist()))


def tally(result: xr.Dataset) -> dict[str, int]:
    """How many cases hold, are refused, and fail."""
    return {word: int((result.verdict == word).sum()) for word in ("holds", "refused", "fails")}


def tally_line(result: xr.Dataset) -> str:
    """Number of cases that hold, are refused and fail, in one line."""
    count = tally(result)
    must = int(result.must_hold.sum())
    return (
        f"{result.sizes['case']} cases, {must} of which must hold: {count['holds']} hold, "
        f"{count['refused']} are refused as they should be, {count['fails']} fail; "
        f"{float(result.run_time.sum()):.1f} s"
    )


def print_verdicts(result: xr.Dataset) -> None:
    """Print the tables, the reasons of failures, and the tally.

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


def markdown(result: xr.Dataset) -> str:
    """The tables in markdown, with what each case is held against.

    Parameters
    ----------
    result : Dataset
        As `stability` gives it.
    """
    pieces = []
    for part in _parts(result):
        rows = result.isel(case=result.case_part.values == part)
        held = rows.isel(case=rows.verdict.values != "refused")
        refused = rows.isel(case=rows.verdict.values == "refused")
        pieces.append(f"### {part}\n")
        if held.sizes["case"]:
            pieces += ["| case | hard because | held against | measured | bound | verdict |"]
            pieces += ["|---|---|---|---|---|---|"]
            pieces += [_row(held.isel(case=n)) for n in range(held.sizes["case"])]
            pieces.append("")
        if refused.sizes["case"]:
            pieces += ["| refused | hard because | the line |", "|---|---|---|"]
            pieces += [
                _cells(one.case.item(), one.hard_because.item(), one.reason.item())
                for one in (refused.isel(case=n) for n in range(refused.sizes["case"]))
            ]
            pieces.append("")
    return "\n".join([*pieces, tally_line(result), ""])


def _of_part(result: xr.Dataset, part: str) -> Table:
    rows = result.isel(case=result.case_part.values == part)
    lines = [_line(rows.isel(case=n)) for n in range(rows.sizes["case"])]
    seconds = float(rows.run_time.sum())
    return Table(part, HEADERS, lines, f"{rows.sizes['case']} cases, {seconds:.1f} s")


def _line(one: xr.Dataset) -> tuple[str, ...]:
    verdict = one.verdict.item()
    if verdict == "refused":
        return one.case.item(), "", "", "", verdict
    return (
        one.case.item(),
        _number(one.measured.item()),
        _number(one.bound.item()),
        _unit(one),
        verdict,
    )


def _row(one: xr.Dataset) -> str:
    return _cells(
        one.case.item(),
        one.hard_because.item(),
        one.held_against.item(),
        f"{_number(one.measured.item())} {_unit(one)}".strip(),
        f"{_number(one.bound.item())} {_unit(one)}".strip(),
        one.verdict.item(),
    )


def _cells(*words: str) -> str:
    return "| " + " | ".join(word.replace("|", "\\|") for word in words) + " |"


def _number(value: float) -> str:
    return "0" if value == 0 else f"{abs(value):.1e}"


def _unit(one: xr.Dataset) -> str:
    unit = str(one.unit.item())
    return "" if unit == "1" else unit

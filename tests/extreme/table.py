"""Plugin of pytest that writes the table of all extreme cases after a run without a failure."""

from itertools import groupby
from pathlib import Path

import pytest

TABLE = Path(__file__).parents[2] / "docs" / "measured" / "extreme.inc"
HEAD = ("| case | hard because | compared with | measured | bound |", "|---|---|---|---|---|")


def pytest_sessionfinish(session: pytest.Session, exitstatus: int) -> None:
    """Write the table, with one part for each module."""
    if exitstatus == pytest.ExitCode.OK:
        lines = []
        for title, items in groupby(session.items, lambda item: item.module.__doc__):
            lines += [f"### {title.splitlines()[0].rstrip('.')}", "", *HEAD, *map(row, items), ""]
        TABLE.write_text("\n".join(lines), encoding="utf-8")


def row(item: pytest.Function) -> str:
    """Row of the table: parts of the docstring, and the properties that the test recorded."""
    name, _, rest = item.function.__doc__.partition("Hard because:")
    reason, _, reference = rest.partition("Compared with:")
    result = dict(item.user_properties)
    if "refusal" in result:
        reference = f"refused: {result['refusal']}"
    cells = (name, reason, reference, result.get("measured", ""), result.get("bound", ""))
    return "| " + " | ".join(" ".join(cell.split()).replace("|", "\\|") for cell in cells) + " |"

"""Plan of a run: functions (parts) that a question needs, in order, and those left out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from earthspin.card import card
from earthspin.engine.part import Part
from earthspin.engine.question import Question

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

#: Row of the run time for importing modules; the run times of parts exclude it.
IMPORTS = "imports"
#: Status of a part whose result of an earlier run was used.
REUSED = "reused"
#: Reason for leaving out a part that could run.
NOT_REQUESTED = "its section was not requested"


@dataclass(frozen=True)
class Row:
    """One row in the table of a plan: part (function), status, reason and run time in s."""

    part: str
    status: str
    reason: str
    seconds: float | None = None

    @property
    def run_time(self) -> str:
        """Run time of the part as text; empty before the run."""
        if self.status == REUSED:
            return REUSED
        return "" if self.seconds is None else f"{self.seconds * 1e3:.1f} ms"


@dataclass(frozen=True)
class Plan:
    """Plan of a run: functions (parts) that run, and those left out, with the reasons.

    Attributes
    ----------
    question : Question
    parts : tuple of Part
        Parts in the order in which they run.
    sections : tuple of str
        Sections that are computed besides the answer.
    left_out : dict of str to str
        Reasons for leaving out the other parts, by title of the part.
    seconds : mapping of str to float
        Run time of each part by name, without imports, and that of imports under `IMPORTS`; empty
        before the run.
    reused : frozenset of str
        Names of parts whose result of an earlier run was reused.
    """

    question: Question
    parts: tuple[Part[..., Any], ...]
    sections: tuple[str, ...]
    left_out: dict[str, str]
    seconds: Mapping[str, float]
    reused: frozenset[str]

    @property
    def rows(self) -> list[Row]:
        """Rows of the plan's table: imports and the parts that run, then those left out."""
        status, keys = "ran" if self.seconds else "runs", self.question.keys()
        rows = []
        if IMPORTS in self.seconds:
            note = "modules loaded on first use, once in each process"
            rows.append(Row(IMPORTS, status, note, self.seconds[IMPORTS]))
        for part in self.parts:
            seconds, is_reused = self.seconds.get(part.name), part.name in self.reused
            does = part.description(keys)
            rows.append(Row(part.title, REUSED if is_reused else status, does, seconds))
        return rows + [Row(title, "left out", why) for title, why in self.left_out.items()]

    def to_frame(self) -> pd.DataFrame:
        """Return the table of this plan as a pandas DataFrame."""
        import pandas as pd

        return pd.DataFrame([vars(row) for row in self.rows])

    def dataset(self) -> xr.Dataset:
        """Return the table of this plan as a Dataset along `part`."""
        import xarray as xr

        rows = self.rows
        why = "description of the part, or reason for leaving it out"
        seconds = {"units": "s", "long_name": "run time of the part"}
        status = {"long_name": "whether the part ran"}
        return xr.Dataset(
            {
                "status": ("part", [row.status for row in rows], status),
                "reason": ("part", [row.reason for row in rows], {"long_name": why}),
                "run_time": ("part", [row.seconds or 0.0 for row in rows], seconds),
            },
            {"part": ("part", [row.part for row in rows], {"long_name": "part of the plan"})},
        )

    def __str__(self) -> str:
        width = max(len(row.part) for row in self.rows)
        lines = [f"{self.question.title}: compute = {self.question.word}"]
        shown = ""
        for row in self.rows:
            ran = "ran" if self.seconds else "runs"
            heading = "left out" if row.status == "left out" else f"{ran}, in this order"
            if heading != shown:
                lines += ["", heading]
                shown = heading
            cost = f"  [{row.run_time}]" if row.run_time else ""
            lines.append(f"  {row.part:<{width}}  {row.reason}{cost}")
        return "\n".join(lines)

    __repr__ = __str__

    def _repr_html_(self) -> str:
        return card(
            self.question.title,
            [(row.part, row.status, row.reason, row.run_time) for row in self.rows],
        )

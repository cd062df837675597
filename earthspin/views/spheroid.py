"""Table of the gravity field of a spheroid at given points."""

from __future__ import annotations

import numpy as np

from earthspin.views.reading import Result, answer_of
from earthspin.views.table import Column, Table, listed, table_along


def field(tree: Result) -> Table:
    """Table of potential, attraction and torque of a spheroid at each point."""
    columns = (
        Column("position", lambda row: listed(row.position.values)),
        "potential:.10e",
        Column("attraction", lambda row: listed(row.attraction.values)),
        Column("torque", lambda row: f"{float(np.linalg.norm(row.torque)):.6e}"),
    )
    note = "The spheroid is homogeneous and has the mass, radius and flattening of the body."
    return table_along(answer_of(tree), "point", "Field of the spheroid", columns, note, first="")


TABLES = [("", field)]

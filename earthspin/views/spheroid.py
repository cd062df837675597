"""The field of a spheroid at the points that were asked for."""

from __future__ import annotations

import numpy as np

from earthspin.views.reading import Result, answer_of
from earthspin.views.table import Table, listed


def tables(tree: Result) -> list[Table]:
    """Field of a spheroid at each point."""
    answer = answer_of(tree)
    table = Table(
        "Field of the spheroid",
        ("position, m", "potential, J/kg", "attraction, m/s2", "torque, N m"),
        [
            (
                listed(of.position.values),
                f"{float(of.potential):.10e}",
                listed(of.attraction.values),
                f"{float(np.linalg.norm(of.torque)):.6e}",
            )
            for of in (answer.isel(point=number) for number in range(answer.sizes["point"]))
        ],
        "The spheroid is homogeneous and has the mass, radius and flattening of the body.",
    )
    return [table]

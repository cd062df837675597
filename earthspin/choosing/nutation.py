"""Ways to the true equator: which series of nutation, and how far apart its nodes."""

from __future__ import annotations

import math
from dataclasses import dataclass

from earthspin.choosing.choice import Choice, models

#: Days from J2000.0 within which the short series of nutation was measured, and what another phase
#: of the nodes may add to an error.
NUTATION_MEASURED, NUTATION_PHASE = 36525.0, 1.1


@dataclass(frozen=True)
class NutationNodes:
    """A series of nutation, evaluated at nodes.

    Attributes
    ----------
    model : str
        ``"2000A"`` or ``"2000B"``.
    spacing : float
        Between two nodes, d.
    """

    model: str
    spacing: float


def nutation_choices(first: float, last: float, size: int) -> list[Choice[NutationNodes | None]]:
    """Ways to the true equator with their errors.

    Parameters
    ----------
    first, last : float
        Days from J2000.0 TDB.
    size : int
        How many epochs lie between them.

    Returns
    -------
    list of Choice of NutationNodes
        The first one leaves nutation out.
    """
    choices: list[Choice[NutationNodes | None]] = []
    measured = max(abs(first), abs(last)) <= NUTATION_MEASURED
    for row in models()["nutation"]:
        if row["model"] == "2000B" and not measured:
            continue  # a series for our time
        nodes = math.ceil((last - first) / row["step"]) + 9 if row["step"] else 0
        words = (
            f"IAU {row['model']} nutation, a node each {row['step']:g} d"
            if row["terms"]
            else "no nutation: the mean equator is near enough"
        )
        choices.append(
            Choice(
                words=words,
                settings=NutationNodes(row["model"], row["step"]) if row["terms"] else None,
                error=NUTATION_PHASE * 10.0 ** row["error"],
                evaluations=row["terms"] * min(nodes, size),
            )
        )
    return choices

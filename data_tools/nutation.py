"""Write the nutation of IAU 2000A on the days on which it is analysed, which the package ships."""

from __future__ import annotations

import erfa
import numpy as np

from earthspin.constants import J2000_JD
from earthspin.sky.iau_models import SERIES, SERIES_DAYS


def main() -> int:
    """Write the file."""
    np.save(SERIES, np.stack(erfa.nut00a(J2000_JD, SERIES_DAYS)))
    print(f"{SERIES}: written")
    return 0

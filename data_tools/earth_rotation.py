"""Departures of the Earth from an even spin about its figure axis, by finals2000A of the IERS.

The largest changes of UT1 (less the spin of `EARTH`) and of the pole over intervals of each length
are the sizes in `earthspin.bodies.beyond_rigid`.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path

import erfa
import numpy as np
import skyfield_data
from numpy.typing import NDArray

from earthspin import EARTH
from earthspin.bodies.beyond_rigid import DAYS
from earthspin.constants import ARCSEC, DAY

FloatArray = NDArray[np.float64]

#: Angle of rotation in a day of UT1, rad: IAU 2000 resolution B1.8.
TURN = 2 * math.pi * 1.00273781191135448
#: Columns of the file, after its description by the IERS: MJD, pole (arcsec), UT1 - UTC (s).
_COLUMNS = (slice(7, 15), slice(18, 27), slice(37, 46), slice(58, 68))
#: What stands where UT1 - UTC was observed, not predicted.
_OBSERVED = (57, "I")


def observed(file: Path) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Modified Julian dates, pole (arcsec, shape (t, 2)), and UT1 - TAI (s)."""
    place, mark = _OBSERVED
    rows = [
        [float(line[column]) for column in _COLUMNS]
        for line in file.read_text("ascii").splitlines()
        if line[place : place + 1] == mark
    ]
    mjd, x, y, ut1 = np.array(rows).T
    year, month, day, _ = erfa.jd2cal(2400000.5, mjd)
    return mjd, np.stack([x, y], axis=-1), ut1 - erfa.dat(year, month, day, 0.0)


def main(arguments: argparse.Namespace) -> int:
    """Print the largest changes over each length, arcsec."""
    folder = Path(skyfield_data.get_skyfield_data_path())
    mjd, pole, ut1 = observed(folder / "finals2000A.all")
    days = mjd - mjd[0]
    angle = (TURN * (days + ut1 / DAY) - float(EARTH.spin_rate) * DAY * days) / ARCSEC
    print(f"MJD {mjd[0]:g} to {mjd[-1]:g}; days:", *(f"{length:g}" for length in DAYS))
    steps = [int(length) for length in DAYS]
    rotation = np.array([np.max(np.abs(angle[n:] - angle[:-n])) for n in steps])
    wander = np.array([np.max(np.linalg.norm(pole[n:] - pole[:-n], axis=1)) for n in steps])
    for name, sizes in (("rotation", rotation), ("pole", wander)):
        print(f"{name}:", *(f"{size:.3g}" for size in np.maximum.accumulate(sizes)))
    print(f"largest distance of the pole: {np.max(np.linalg.norm(pole, axis=1)):.2g}")
    return 0

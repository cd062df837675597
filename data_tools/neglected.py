"""How far the response of the interior moves the axis of the Earth.

This is `RESPONSE` of `earthspin.motion.effects`. The figure axis is followed under Sun and
Moon from 1950 to 2050 with every effect of a rigid Earth, and again with the response; what lies
between the two paths is bounded at every epoch by

    swing + rate |t|       (t from J2000.0)

with the smallest mean over all epochs that such a bound can have: a linear programme.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from scipy.optimize import linprog

from earthspin.constants import DAY, JULIAN_YEAR, MAS
from earthspin.dates import days
from earthspin.errors import Where
from earthspin.motion.effects import NONRIGID, RESPONSE, RIGID, AngleBound
from earthspin.numerics.arrays import FloatArray
from earthspin.questions.pole import pole

#: The response is fitted to IAU 2000A, which is held to observations of our time.
SPAN = ("1950-01-01", "2050-01-01")
#: Close enough for what swings twice a day; no period of the sky is a multiple of it.
STEP = "0.37 d"


def figure_axis(effects: Iterable[str]) -> tuple[FloatArray, FloatArray]:
    """Julian years from J2000.0, and the figure axis, shape (t, 3), with some effects."""
    path = pole(*SPAN, STEP, effects=tuple(effects)).sel(axis="figure")
    years = days(path.time, Where("time")) * DAY / JULIAN_YEAR
    return years, np.stack([path.X, path.Y, path.Z], axis=-1)


def moved_by_response() -> tuple[FloatArray, FloatArray]:
    """Julian years from J2000.0, and how far the response moves the figure axis, mas."""
    years, rigid = figure_axis(RIGID)
    _, whole = figure_axis((*RIGID, NONRIGID.name))
    return years, np.asarray(np.linalg.norm(whole - rigid, axis=1) / MAS)


def tightest(years: FloatArray, moved: FloatArray) -> AngleBound:
    """The bound with the least mean that lies nowhere below what was measured.

    Parameters
    ----------
    years : ndarray, shape (t,)
        From J2000.0.
    moved : ndarray, shape (t,)
        mas.
    """
    columns = np.stack([np.ones_like(years), np.abs(years)], axis=1)
    solution = linprog(columns.mean(axis=0), A_ub=-columns, b_ub=-moved, method="highs")
    return AngleBound(*(rounded_up(float(value)) for value in solution.x))


def rounded_up(value: float) -> float:
    """Three digits that are no less than the value."""
    if value <= 0:
        return 0.0
    unit = 10.0 ** (math.floor(math.log10(value)) - 2)
    return float(f"{math.ceil(value / unit) * unit:.3g}")


def bound(growth: AngleBound, years: FloatArray) -> FloatArray:
    """What is claimed at these times, mas."""
    return growth.swing + growth.rate * np.abs(years)


def main() -> int:
    """Print the bound beside the stated one; return 1 if the stated one is too small anywhere."""
    years, moved = moved_by_response()
    growth = tightest(years, moved)
    over = float(np.max(moved / bound(RESPONSE, years)))
    print("swing, rate, largest over what is stated")
    print(f"{growth.swing:g} {growth.rate:g} {over:.4f}")
    return int(over > 1)

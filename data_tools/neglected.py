"""How far each effect moves the axis of the Earth: the sizes in `earthspin.motion.effects`.

The figure axis is followed under Sun and Moon from 1901 to 2050 with every effect of a rigid Earth,
and again with one of them off; what lies between the two paths is bounded at every epoch by

    swing + rate |t| + bend t2        (t from J2000.0)

with the smallest mean over all epochs that such a bound can have: a linear programme. The response
of the interior is measured from 1950 to 2050.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from scipy.optimize import linprog

from earthspin.constants import DAY, JULIAN_YEAR, MAS
from earthspin.dates import days
from earthspin.errors import Where
from earthspin.motion.effects import EFFECTS, NONRIGID, RIGID, Growth
from earthspin.numerics.arrays import FloatArray
from earthspin.questions.pole import pole

Span = tuple[str, str]

SPAN: Span = ("1901-01-01", "2050-01-01")
#: The response is fitted to IAU 2000A, which is held to observations of our time.
SPAN_OF_RESPONSE: Span = ("1950-01-01", "2050-01-01")
#: Close enough for what swings twice a day; no period of the sky is a multiple of it.
STEP = "0.37 d"
#: What bends in time: the torque grows with J2, and the path with its integral.
BENT = "j2-rate"


def figure_axis(span: Span, step: str, effects: Iterable[str]) -> tuple[FloatArray, FloatArray]:
    """Julian years from J2000.0, and the figure axis, shape (t, 3).

    Parameters
    ----------
    span : tuple of str
        First and last date.
    step : str
    effects : iterable of str
        Those that are switched on.
    """
    path = pole(*span, step, effects=tuple(effects)).sel(axis="figure")
    years = days(path.time, Where("time")) * DAY / JULIAN_YEAR
    return years, np.stack([path.X, path.Y, path.Z], axis=-1)


def moved_by(
    effects: Iterable[str], step: str, span: Span = SPAN
) -> tuple[FloatArray, dict[str, FloatArray]]:
    """Julian years from J2000.0, and how far each effect moves the figure axis, mas.

    Parameters
    ----------
    effects : iterable of str
        Of those of a rigid Earth.
    step, span
        As `figure_axis` takes them.
    """
    years, whole = figure_axis(span, step, RIGID)
    moved = {}
    for effect in effects:
        _, without = figure_axis(span, step, (e for e in RIGID if e != effect))
        moved[effect] = np.linalg.norm(whole - without, axis=1) / MAS
    return years, moved


def moved_by_response(step: str, span: Span = SPAN_OF_RESPONSE) -> tuple[FloatArray, FloatArray]:
    """Julian years from J2000.0, and how far the response moves the figure axis, mas."""
    years, rigid = figure_axis(span, step, RIGID)
    _, whole = figure_axis(span, step, (*RIGID, NONRIGID.name))
    return years, np.asarray(np.linalg.norm(whole - rigid, axis=1) / MAS)


def tightest(years: FloatArray, moved: FloatArray, *, bent: bool) -> Growth:
    """The bound with the least mean that lies nowhere below what was measured.

    Parameters
    ----------
    years : ndarray, shape (t,)
        From J2000.0.
    moved : ndarray, shape (t,)
        mas.
    bent : bool
        Whether it grows as the square of the time, or as the time.
    """
    power = 2 if bent else 1
    columns = np.stack([np.ones_like(years), np.abs(years) ** power], axis=1)
    solution = linprog(columns.mean(axis=0), A_ub=-columns, b_ub=-moved, method="highs")
    swing, growth = (rounded_up(float(value)) for value in solution.x)
    return Growth(swing, 0.0, growth) if bent else Growth(swing, growth)


def rounded_up(value: float) -> float:
    """Three digits that are no less than the value."""
    if value <= 0:
        return 0.0
    unit = 10.0 ** (math.floor(math.log10(value)) - 2)
    return float(f"{math.ceil(value / unit) * unit:.3g}")


def bound(growth: Growth, years: FloatArray) -> FloatArray:
    """What is claimed at these times, mas."""
    return growth.swing + growth.rate * np.abs(years) + growth.bend * years**2


def main() -> int:
    """Print the bounds beside the stated ones; return 1 if a stated one is too small anywhere."""
    years, moved = moved_by(RIGID, STEP)
    measured = {effect: (years, distance) for effect, distance in moved.items()}
    measured[NONRIGID.name] = moved_by_response(STEP)
    print("effect, swing, rate, bend, largest over what is stated")
    over = []
    for effect, (at, distance) in measured.items():
        growth = tightest(at, distance, bent=effect == BENT)
        over.append(float(np.max(distance / bound(EFFECTS[effect].size, at))))
        print(f"{effect:<13} {growth.swing:g} {growth.rate:g} {growth.bend:g} {over[-1]:.4f}")
    return int(max(over) > 1)

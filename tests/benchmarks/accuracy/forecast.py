"""Forecasts of polar motion: this package and common methods."""

from collections.abc import Callable
from functools import cache, partial

import numpy as np

from earthspin.constants import MAS
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.sky.eop import read_polar_motion
from earthspin.wobble.forecast import OBSERVATION, PERIOD, SHIPPED, FastExcitation, fit, forecast
from earthspin.wobble.record import YEAR
from earthspin.wobble.state_space import burg
from tests.benchmarks.accuracy.ladder import Ladder, settings

#: Function that returns a forecast, of a record (x - i y, mas), the days ahead and the years used.
Predictor = Callable[[ComplexArray, int, float], ComplexArray]

#: Bounds on the mean absolute error of the last setting of this package by days ahead, mas: 1.5
#: times the errors measured for 2014 to 2025 with many origins.
BOUNDS = {30: 7.3, 90: 15.0}
#: Modified Julian date of the first origin (2014-01-01), days between origins, their number.
FIRST, EVERY, ORIGINS = 56658, 61, 70
YEARS, USUAL_YEARS = (5.0, 10.0, 15.0), (5.0, 8.0, 15.0)
#: Order of the autoregression after least squares.
USUAL_ORDER = 40


def ladder(days: int) -> Ladder:
    """Methods that forecast polar motion some days ahead."""
    p, ends = observed()

    def scored(predictor: Predictor, years: float, case: int = 0) -> tuple[FloatArray, int]:
        end = int(ends[case])
        off = complex(predictor(p[:end], days, years)[-1] - p[end + days - 1])
        return np.array([off.real, off.imag]), max(1, round(years * YEAR))

    def fitted(case: int = 0) -> tuple[FloatArray, int]:
        """Fit before the first origin; forecasts from later ones use the same fit."""
        fast = _fitted() if case else fit(p[: ends[0]])
        return scored(partial(_ours, fast), YEARS[-1], case)

    return Ladder(
        title=f"The pole {days} days ahead",
        problem=f"x and y of the pole {days} days after {ORIGINS} origins from 2014 to 2025; "
        "the error is the mean absolute error of one coordinate, known to "
        f"{100 * 0.75 / np.sqrt(2 * ORIGINS):.0f} per cent; parameters are fitted before "
        "the first origin; run times are those of one forecast",
        reference="C04, as observed later",
        unit="mas",
        floor=OBSERVATION,
        error=lambda values: np.mean(np.abs(values)),
        runs={
            "shipped parameters": settings(
                "{} years", partial(scored, partial(_ours, SHIPPED)), YEARS
            ),
            "fitted parameters": {f"{YEARS[-1]:g} years": fitted},
            "least squares + AR": settings("{} years", partial(scored, usual), USUAL_YEARS),
            "last value": {"": partial(scored, _last_value, 0.0)},
        },
        bounds={"shipped parameters": BOUNDS[days], "fitted parameters": BOUNDS[days]},
        cases=ORIGINS,
    )


@cache
def observed() -> tuple[ComplexArray, np.ndarray]:
    """Observed pole x - i y of IERS C04, mas, and the row numbers at which forecasts begin."""
    table = read_polar_motion("c04")
    ends = np.searchsorted(table.mjd, FIRST + EVERY * np.arange(ORIGINS)) + 1
    return np.asarray((table.x - 1j * table.y) / MAS, dtype=complex), ends


@cache
def _fitted() -> FastExcitation:
    """Fit the excitation model to the data before the first forecast."""
    p, ends = observed()
    return fit(p[: ends[0]])


def _ours(fast: FastExcitation, p: ComplexArray, days: int, years: float) -> ComplexArray:
    return forecast(p, days, fast, round(years * YEAR)).pole


def usual(p: ComplexArray, days: int, years: float) -> ComplexArray:
    """Predict polar motion by a common method: least squares and autoregression of the residual.

    The fit has a free wobble, annual and semiannual circles, a constant and a trend.
    """
    count = round(years * YEAR)
    t = np.arange(-count + 1, days + 1) / YEAR
    rates = 2j * np.pi * np.array([1, -1, 2, -2, YEAR / PERIOD])
    columns = np.column_stack([np.exp(np.outer(t, rates)), np.ones_like(t), t])
    past, future = columns[:count], columns[count:]
    fitted = np.linalg.lstsq(past, p[-count:], rcond=None)[0]
    residual = list(p[-count:] - past @ fitted)
    filter_ = burg(np.array(residual), USUAL_ORDER)
    for _ in range(days):
        residual.append(-np.dot(filter_[1:], residual[: -USUAL_ORDER - 1 : -1]))
    return np.asarray(future @ fitted + np.array(residual[count:]))


def _last_value(p: ComplexArray, days: int, years: float) -> ComplexArray:
    return np.full(days, p[-1])

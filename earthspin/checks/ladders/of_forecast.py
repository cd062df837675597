"""Compare error and run time of forecasts of polar motion, by this package and common methods."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial

import numpy as np
from numpy.typing import NDArray

from earthspin.checks.work_precision import FloatArray, Ladder, Method, Setting
from earthspin.constants import MAS
from earthspin.sky.eop import read_polar_motion
from earthspin.wobble.burg import burg
from earthspin.wobble.forecast import OBSERVATION, PERIOD, SHIPPED, FastExcitation, fit, forecast
from earthspin.wobble.record import YEAR

Complex = NDArray[np.complex128]
#: Function that returns a forecast, of a record (x - i y, mas), the days ahead and the years used.
Predictor = Callable[[Complex, int, float], Complex]

#: Days ahead, and bounds on the mean absolute error of the last setting of this package, mas: 1.5
#: times the errors measured for 2014 to 2025 with many origins.
BOUNDS = {30: 7.3, 90: 15.0}
#: Modified Julian date of the first origin (2014-01-01), days between origins, number of origins,
#: and interval of the origins that a quick ladder uses.
FIRST, EVERY, ORIGINS, QUICK = 56658, 61, 70, 10
QUICK_EXCESS = 2.0  # a few origins determine a mean error to a third
YEARS, USUAL_YEARS = (5.0, 10.0, 15.0), (5.0, 8.0, 15.0)
#: Order of the autoregression after least squares.
USUAL_ORDER = 40


def ladder(quick: bool) -> Ladder:
    """Return the comparison (`Ladder`) of methods that forecast polar motion."""
    ends = origins()[:: QUICK if quick else 1]
    methods: list[Method] = []
    for days, bound in BOUNDS.items():
        bound *= MAS * (QUICK_EXCESS if quick else 1.0)

        def method(
            name: str, settings: list[Setting], bound: float = np.inf, days: int = days
        ) -> Method:
            return Method(f"{name}, {days} d", settings, bound, f"the pole {days} days ahead")

        methods += [
            method("shipped parameters", [_setting(_ours, y, days, ends) for y in YEARS], bound),
            method("least squares + AR", [_setting(usual, y, days, ends) for y in USUAL_YEARS]),
            method("last value", [_setting(_last_value, 0.0, days, ends)]),
        ]
        if not quick:
            fitted = _setting(_fitted, YEARS[-1], days, ends, partial(_with, _fitted_once()))
            methods.append(method("fitted parameters", [fitted], bound))
    return Ladder(
        quantity="forecast",
        unit="mas",
        problem=f"x and y of the pole 30 and 90 days after {ends.size} origins from 2014 to 2025; "
        "the error is the mean absolute error of one coordinate, known to "
        f"{100 * 0.75 / np.sqrt(2 * ends.size):.0f} per cent; parameters are fitted before "
        "the first origin; run times are those of one forecast",
        subject="the pole",
        reference="C04, as observed later",
        reference_error=OBSERVATION * MAS,
        methods=methods,
        error=lambda values: float(np.mean(np.abs(values))) * MAS,
        skipped="fitted parameters, which take seconds" if quick else "",
    )


def usual(p: Complex, days: int, years: float) -> Complex:
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


def _ours(p: Complex, days: int, years: float) -> Complex:
    return _with(SHIPPED, p, days, years)


def _with(fast: FastExcitation, p: Complex, days: int, years: float) -> Complex:
    return forecast(p, days, fast, round(years * YEAR)).pole


def _fitted(p: Complex, days: int, years: float) -> Complex:
    return _with(fit(p), p, days, years)


def _last_value(p: Complex, days: int, years: float) -> Complex:
    return np.full(days, p[-1])


@cache
def _observed() -> tuple[FloatArray, Complex]:
    """Modified Julian dates, and observed pole coordinates x - i y of IERS C04 in mas."""
    table = read_polar_motion("c04")
    return table.mjd, np.asarray((table.x - 1j * table.y) / MAS, dtype=complex)


def origins() -> NDArray[np.intp]:
    """Row numbers at which the forecasts begin; each forecast uses only the rows before it."""
    return np.searchsorted(_observed()[0], FIRST + EVERY * np.arange(ORIGINS)) + 1


@cache
def _fitted_once() -> FastExcitation:
    """Fit the excitation model to the data before the first forecast; all forecasts use it."""
    return fit(_observed()[1][: origins()[0]])


def _setting(
    predictor: Predictor,
    years: float,
    days: int,
    ends: NDArray[np.intp],
    scored: Predictor | None = None,
) -> Setting:
    p = _observed()[1]

    def error(predictor: Predictor, end: int) -> FloatArray:
        off = complex(predictor(p[:end], days, years)[-1] - p[end + days - 1])
        return np.array([off.real, off.imag])

    return Setting(
        f"{years:g} years" if years else "",
        lambda: (error(predictor, int(ends[0])), max(1, round(years * YEAR))),
        error_values=lambda: np.array([error(scored or predictor, int(end)) for end in ends]),
    )

"""Forecast of polar motion: driven free wobble, annual and semiannual motion, slow mean pole.

With p = x - i y in mas,

    p' = i s (p - chi),   chi = fast + slow,   s = 2 pi / T (1 + i / 2 Q),

where the slow part of the excitation has the correlation time `SLOW_MEMORY` and the fast part is
noise, unequal and correlated in the two coordinates, after two filters of first order. Circles of
a year and of half a year, forward and backward, change their amplitudes at random, and so do the
level and the slope of the slow pole. A Kalman filter follows all of it through the last 15 years.

If part of the excitation is known (of air, water and ground), the pole that it drives is computed
exactly, and the rest of the pole is forecast in the same way.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.wobble.excitation import chandler_frequency, polar_motion_from
from earthspin.wobble.record import YEAR
from earthspin.wobble.state_space import Filter, StateSpace, burg, side_by_side

# --- innovations: their autoregression, and forecast errors ---------------------------------------
# The innovations (differences of each observation from its prediction) are not white: what the
# model of the excitation and the smoothing of the tables leave is correlated over some days. With
#
#     nu[k] = -sum_j a[j] nu[k - j] + e[k],
#
# the error of a forecast h days ahead is sum_j M[j] e[h - j] over 0 <= j < h, where M[j] is the
# response of the observed pole to e after j days. Its covariance follows from that of e, which is
# estimated in x and y separately, so that the correlation of x and y depends on the horizon.
#
# Source: Anderson & Moore (1979), Optimal Filtering, section 9.1, for the innovations form.

#: Order of the autoregression, days from which it is estimated (the noise of the tables changes
#: within years), and days that it extrapolates.
ORDER, FITTED_OVER, EXTRAPOLATED = 20, 730, 40


@dataclass(frozen=True)
class Autoregression:
    """Autoregressive model of complex innovations, with the residuals' covariance matrix.

    Attributes
    ----------
    coefficients : complex array, shape (ORDER,)
        a[1], a[2] and so on.
    residual : complex
        Last e, mas.
    covariance : array, shape (2, 2)
        Covariance of the real and imaginary part of e, mas squared.
    """

    coefficients: ComplexArray
    residual: complex
    covariance: FloatArray

    @classmethod
    def fitted(cls, innovations: ComplexArray) -> Autoregression:
        """Fit the autoregression to the last days of a series of innovations."""
        recent = innovations[-FITTED_OVER:]
        filter_ = burg(recent, ORDER)
        residuals = np.convolve(recent, filter_, mode="valid")
        components = np.array([residuals.real, residuals.imag])
        # a fit of so many coefficients leaves too small a residual
        covariance = components @ components.T / residuals.size * (1 + ORDER / residuals.size)
        return cls(filter_[1:], complex(residuals[-1]), covariance)

    def extended(self, series: ComplexArray, days: int) -> ComplexArray:
        """Predict the innovations of the next days, with all future residuals set to zero."""
        values = list(series[-ORDER:])
        for _ in range(days):
            values.append(-np.dot(self.coefficients, values[: -ORDER - 1 : -1]))
        return np.array(values[ORDER:], dtype=complex)

    def without_error(self, variance: float) -> tuple[complex, FloatArray]:
        """Most probable last residual, with covariance, if the last observation is less accurate.

        Parameters
        ----------
        variance : float
            Variance of the error in each coordinate, beyond that of other observations, mas
            squared.
        """
        gain = self.covariance @ np.linalg.inv(self.covariance + variance * np.eye(2))
        real, imaginary = gain @ [self.residual.real, self.residual.imag]
        return complex(real, imaginary), self.covariance - gain @ self.covariance


def forecast_covariance(
    kalman: Filter, autoregression: Autoregression, last: FloatArray, days: int
) -> FloatArray:
    """Covariance of the forecast pole (real and imaginary part), mas2, shape (days, 2, 2).

    Parameters
    ----------
    kalman : Filter
    autoregression : Autoregression
        Autoregression of the innovations.
    last : array, shape (2, 2)
        Covariance of the last e; zero if the last observation is as good as the others.
    days : int
    """
    start = np.zeros(ORDER, dtype=complex)
    start[-1] = 1
    impulse = np.concatenate([start[-1:], autoregression.extended(start, days)])
    model, gain = kalman.model, kalman.gains[-1]
    response, state = np.empty((days + 1, 2, 2)), np.zeros((len(model.transition), 2))
    for day, value in enumerate(impulse):
        innovation = side_by_side(np.array([[value]]))
        response[day] = model.observed @ state + innovation
        state = model.transition @ (state + gain @ innovation)
    transposed = np.swapaxes(response, 1, 2)
    residual_part = np.cumsum(response @ autoregression.covariance @ transposed, axis=0)[:-1]
    return np.asarray(residual_part + response[1:] @ last @ transposed[1:])


# --- the model and its forecast -------------------------------------------------------------------

#: Measured skill; `python -m data_tools forecast` writes it.
SKILL = Path(__file__).with_name("forecast_skill.json")
#: Days of observations that a forecast uses.
RECORD = 5478
#: Horizon up to which skill was measured, d.
LONGEST = 730
#: Periods of the free wobble, d, and its quality factor.
PERIOD, QUALITY = 433.0, 80.0
#: Slow part of the excitation: standard deviation, mas, and memory, d.
SLOW, SLOW_MEMORY = 10.0, 300.0
#: Random walks of the amplitudes of a year and of half a year, of the level, mas/sqrt(d), and of
#: the slope, mas/d/sqrt(d).
ANNUAL_WALK, SEMIANNUAL_WALK, LEVEL_WALK, SLOPE_WALK = 0.01, 0.005, 0.1, 1e-6
#: Standard deviation of an observation, mas.
OBSERVATION = 0.03
#: Standard deviations before the first observation, mas: free wobble, the two states of the fast
#: excitation, the slow one, circles of a year and of half a year, level; and slope, mas/d.
BEFORE = np.array([200.0, 50.0, 50.0, SLOW, 100.0, 100.0, 20.0, 20.0, 500.0, 0.05])
#: Bias, x - i y, and standard deviation of the newest row of finals2000A, compared with the values
#: to which it is revised later, mas. Measured on the 28 releases of June to December 2023:
#: +0.065 +- 0.006 in y, -0.003 +- 0.007 in x; `python -m data_tools forecast` measures them again.
NEWEST_BIAS, NEWEST_DEVIATION = -0.065j, 0.035
#: Horizon at which the covariance of the model takes over from that of the innovations, d.
TAKEN_OVER = 90.0
#: Days between observations in a fit of the fast excitation, and its largest number of iterations.
THINNED, ITERATIONS = 10, 12
#: White part of the excitation at which a fit starts, mas/sqrt(d), and its bounds.
WHITE, WHITE_BOUNDS = 10.0, (0.5, 60.0)
#: Weights of the running mean of a known excitation: from one day to the next, models of air and
#: water vary more than the tables of the pole, which are smoothed.
SMOOTHING = np.array([0.25, 0.5, 0.25])
#: Smallest number of days that a known excitation covers up to the origin: ten years.
SHORTEST_EXCITATION = 3653

#: What is observed: free wobble, circles and level.
_OBSERVED = np.array([[1, 0, 0, 0, 1, 1, 1, 1, 1, 0]], dtype=complex)
#: Which states belong to which component.
COMPONENTS = {"Chandler": [0], "annual": [4, 5], "semiannual": [6, 7], "slow pole": [8]}


@dataclass(frozen=True)
class FastExcitation:
    """Parameters of the fast part of the excitation: noise that passes two first-order filters.

    Attributes
    ----------
    first_decay, second_decay : float
        1/d.
    first_turn, second_turn : float
        Rates at which the states of the filters turn, rad/d.
    x, y : float
        Noise that enters the first filter, mas/sqrt(d).
    correlation : float
        Of the noise in x and y.
    white : float
        White part of the excitation, which passes no filter, mas/sqrt(d).
    """

    first_decay: float
    first_turn: float
    second_decay: float
    second_turn: float
    x: float
    y: float
    correlation: float
    white: float = 0.0

    @property
    def density(self) -> FloatArray:
        """Spectral density of the x and -y noise that drives the first filter, mas2/d, (2, 2)."""
        across = -self.correlation * self.x * self.y
        return np.array([[self.x**2, across], [across, self.y**2]])

    @property
    def free(self) -> FloatArray:
        """The eight parameters, transformed to unbounded numbers for an optimiser, shape (8,).

        Positive ones become their logarithms, and the correlation its inverse hyperbolic tangent.
        The white part must be greater than zero.
        """
        logs = np.log([self.first_decay, self.second_decay, self.x, self.y])
        turns = [self.first_turn, self.second_turn, np.arctanh(self.correlation)]
        return np.array([*logs, *turns, np.log(self.white)])

    @classmethod
    def from_free(cls, free: FloatArray) -> FastExcitation:
        """Build the fast excitation from unbounded parameters, the inverse of `free`."""
        first, second, x, y, white = map(float, np.exp(free[[0, 1, 2, 3, 7]]))
        first_turn, second_turn = map(float, free[4:6])
        correlation = float(np.tanh(free[6]))
        return cls(first, first_turn, second, second_turn, x, y, correlation, white)


#: Chosen on C04 from 2005 to 2013 by the likelihood of forecasts 1 to 365 days ahead.
SHIPPED = FastExcitation(0.2755, -0.33, 0.3524, 0.09, 32.0, 47.0, 0.535)


def model(fast: FastExcitation = SHIPPED) -> StateSpace:
    """State-space model of daily polar motion: wobble, excitation, seasons, drift (10 states).

    The states are complex, in the order of `BEFORE`.
    """
    wobble_rate = 1j * chandler_frequency(PERIOD, QUALITY)
    annual_rate = 2j * np.pi / YEAR
    diagonal = [
        wobble_rate,
        -fast.first_decay + 1j * fast.first_turn,
        -fast.second_decay + 1j * fast.second_turn,
        -1 / SLOW_MEMORY,
        *(annual_rate, -annual_rate, 2 * annual_rate, -2 * annual_rate),
        *(0, 0),
    ]
    rates = np.diag(np.array(diagonal, dtype=complex))
    rates[0, 2:4] = -wobble_rate
    rates[2, 1] = fast.second_decay
    rates[8, 9] = 1
    slow = SLOW * np.sqrt(2 / SLOW_MEMORY)
    white_walk = abs(wobble_rate) * fast.white
    walks = [white_walk, 0, 0, slow, ANNUAL_WALK, ANNUAL_WALK, SEMIANNUAL_WALK, SEMIANNUAL_WALK]
    half_size = len(BEFORE)
    density = np.diag(np.tile([*walks, LEVEL_WALK, SLOPE_WALK], 2) ** 2)
    density[np.ix_([1, 1 + half_size], [1, 1 + half_size])] = fast.density
    error = OBSERVATION**2 * np.eye(2)
    return StateSpace.sampled(rates, density, _OBSERVED, error, np.diag(np.tile(BEFORE, 2) ** 2))


@cache
def _filter(fast: FastExcitation, count: int) -> Filter:
    """Kalman filter of the model of polar motion, for a number of daily observations."""
    return Filter.of(model(fast), count)


@dataclass(frozen=True)
class PredictedPole:
    """Predicted polar motion and its covariance, for each day after the last observation.

    Attributes
    ----------
    pole : complex array, shape (n,)
        x - i y, mas.
    covariance : array, shape (n, 2, 2)
        Covariance of x and y, mas squared, with the error of observation.
    model_covariance : array, shape (n, 2, 2)
        The same by the Kalman filter alone.
    components : mapping of str to complex array, shape (n,)
        Parts of the pole, mas.
    component_variance : mapping of str to array, shape (n, 2)
        Variances of x and y of each part, mas squared.
    fast : FastExcitation
        Parameters that were used.
    """

    pole: ComplexArray
    covariance: FloatArray
    model_covariance: FloatArray
    components: Mapping[str, ComplexArray]
    component_variance: Mapping[str, FloatArray]
    fast: FastExcitation


def forecast(
    p: ComplexArray,
    days: int,
    fast: FastExcitation = SHIPPED,
    used: int = RECORD,
    newest: bool = False,
) -> PredictedPole:
    """Forecast polar motion, with a covariance, from daily values of observed polar motion.

    The covariance is that of the observed innovations in the first weeks, and that of the model
    after some months: the innovations of two years do not show the slow part of the excitation.

    Parameters
    ----------
    p : complex array, shape (n,)
        x - i y, mas, daily.
    days : int
        Number of days ahead.
    fast : FastExcitation
    used : int
        Number of days that are used, from the end of the record.
    newest : bool
        Whether the last day is the newest observed row of finals2000A, which is biased.

    Raises
    ------
    UndefinedError
        If the record is too short.
    """
    record = last_of(p, used)
    if newest:
        record = np.append(record[:-1], record[-1] - NEWEST_BIAS)
    kalman = _filter(fast, used)
    state, innovations = kalman.run(np.column_stack([record.real, record.imag]))
    system, gain, covariance = kalman.model, kalman.gains[-1], kalman.covariance
    series = innovations @ np.array([1, 1j])
    autoregression = Autoregression.fitted(series)
    last_covariance = np.zeros((2, 2))
    if newest:
        residual, last_covariance = autoregression.without_error(NEWEST_DEVIATION**2)
        change = residual - autoregression.residual
        series[-1] += change
        state = state + gain @ [change.real, change.imag]
    extended = autoregression.extended(series, min(days, EXTRAPOLATED))
    future = np.column_stack([extended.real, extended.imag])
    rows = {name: _rows(states) for name, states in COMPONENTS.items()}
    pole, spread = np.empty((days, 2)), np.empty((days, 2, 2))
    poles = {name: np.empty((days, 2)) for name in rows}
    variances = {name: np.empty((days, 2)) for name in rows}
    for day in range(days):
        state = system.transition @ state
        covariance = system.propagated(covariance)
        pole[day], spread[day] = system.observed @ state, system.of_observation(covariance)
        if day < len(future):
            pole[day] += future[day]
            state = state + gain @ future[day]
        for name, row in rows.items():
            poles[name][day] = row @ state
            variances[name][day] = np.diag(row @ covariance @ row.T)
    by_innovations = forecast_covariance(kalman, autoregression, last_covariance, days)
    weight = np.exp(-((np.arange(1, days + 1) / TAKEN_OVER) ** 2))[:, None, None]
    signs = np.array([[1, -1], [-1, 1]])  # of x and y, not of x and -y
    spread *= signs
    combined = weight * by_innovations * signs + (1 - weight) * spread
    complex_parts = {name: part @ np.array([1, 1j]) for name, part in poles.items()}
    return PredictedPole(pole @ np.array([1, 1j]), combined, spread, complex_parts, variances, fast)


Daily = TypeVar("Daily", ComplexArray, FloatArray)


def last_of(p: Daily, used: int = RECORD) -> Daily:
    """Return the last `used` days of daily values; refuse a shorter record.

    Raises
    ------
    UndefinedError
        If the record is shorter.
    """
    if p.size < used:
        raise UndefinedError(
            f"the record up to the origin has {p.size} days; a forecast needs {used} "
            f"({used / YEAR:.0f} years)"
        )
    return p[-used:]


def _rows(states: list[int]) -> FloatArray:
    """Matrix that sums chosen states of the model to the real and imaginary part of the pole."""
    row = np.zeros(len(BEFORE))
    row[states] = 1
    return np.asarray(np.kron(np.eye(2), row), dtype=float)


def fit(p: ComplexArray, used: int = RECORD) -> FastExcitation:
    """Fit the fast excitation by maximum likelihood, from every tenth day of a record.

    Parameters
    ----------
    p : complex array, shape (n,)
        See `forecast`.
    used : int
        Number of days at the end of the record that are used.
    """
    from scipy.optimize import minimize

    record = last_of(p, used)[::-1][::THINNED][::-1]
    data = np.column_stack([record.real, record.imag])

    def minus_twice_log(free: FloatArray) -> float:
        system = model(FastExcitation.from_free(free)).every(THINNED)
        kalman = Filter.of(system, len(data))
        return kalman.minus_twice_log(kalman.run(data)[1])

    start = replace(SHIPPED, white=WHITE).free
    bounds = [*((v - 1, v + 1) for v in start[:-1]), tuple(np.log(WHITE_BOUNDS))]
    options: dict[str, Any] = {"maxiter": ITERATIONS, "eps": 1e-4}
    best = minimize(minus_twice_log, start, method="L-BFGS-B", bounds=bounds, options=options)
    return FastExcitation.from_free(best.x)


def forecast_with_excitation(
    p: ComplexArray, chi: ComplexArray, days: int, newest: bool = False
) -> PredictedPole:
    """Forecast polar motion from past polar motion and past (perhaps also future) excitation.

    The pole that the known excitation drives is computed exactly up to a day before its end. The
    rest of the record is forecast with parameters that are fitted to it, and so is the driven pole
    beyond that day. The errors of both are taken as independent; their covariances are those of the
    fitted models. The forecast is not separated into components.

    Parameters
    ----------
    p : complex array, shape (n,)
        x - i y, mas, daily.
    chi : complex array, shape (m,)
        chi1 + i chi2, mas: means from each day of the record to the next, and as many beyond the
        record as are known; m is at least n.
    days : int
        Number of days ahead.
    newest : bool
        See `forecast`.

    Raises
    ------
    UndefinedError
        If the record or the excitation is too short.
    """
    if chi.size < p.size:
        raise UndefinedError(
            f"the excitation ends {p.size - chi.size} d too early; it must include the day of "
            "the origin"
        )
    if p.size < SHORTEST_EXCITATION:
        raise UndefinedError(
            f"pole and excitation have {p.size} days up to the origin in common; a forecast needs "
            f"{SHORTEST_EXCITATION} ({SHORTEST_EXCITATION / YEAR:.0f} years)"
        )
    smoothed = np.concatenate([chi[:1], np.convolve(chi, SMOOTHING, mode="valid")])
    driven = polar_motion_from(smoothed, 1.0, chandler_frequency(PERIOD, QUALITY))
    driven_pole, length = driven[: p.size + days], min(p.size, RECORD)
    known = driven_pole.size - p.size
    residual_pole = p - driven_pole[: p.size]
    remainder = forecast(residual_pole, days, fit(residual_pole, length), length, newest)
    pole, covariance = remainder.pole.copy(), remainder.model_covariance.copy()
    pole[:known] += driven_pole[p.size :]
    if known < days:
        later = forecast(driven_pole, days - known, fit(driven_pole, length), length)
        pole[known:] += later.pole
        covariance[known:] += later.model_covariance
    return PredictedPole(pole, covariance, covariance, {}, {}, remainder.fast)

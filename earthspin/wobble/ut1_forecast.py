"""Forecast of UT1 and of the length of day: slow and fast changes of the rotation, and seasons.

With u = UT1 - TAI without the zonal tides, in ms,

    u' = -(l + f + s) + n,   g' = -g / a + m,   f' = (g - f) / b,

where the slow part l of the length of day changes at random (core, and slow changes of the air),
the fast part f is noise m after two filters of first order (winds), s is the sum of circles of a
year, half and a third of it, and n is white noise. A Kalman filter follows all of it through the
last 15 years.

Bulletin A has forecasts of the air, which no table of UT1 replaces. Where its prediction of seven
days is given, these days are its own, and the filter takes the seventh as an observation. The
errors of successive days are almost the same, so that the other days would add nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from earthspin.constants import NORMAL_95
from earthspin.numerics.arrays import FloatArray
from earthspin.wobble.forecast import EXTRAPOLATED, ORDER, RECORD, Autoregression, last_of
from earthspin.wobble.record import YEAR
from earthspin.wobble.state_space import Filter, StateSpace

#: Measured skill; `python -m data_tools forecast` writes it.
SKILL = Path(__file__).with_name("ut1_forecast_skill.json")
#: White noise of UT1, ms/sqrt(d), standard deviation of the fast part of the length of day, ms, and
#: the memories of its two filters, d. Maximum likelihood on every fourth day of C04 from 1997 to
#: 2020; from all days the likelihood would learn the smoothing of the table.
WHITE, FAST, FIRST_MEMORY, SECOND_MEMORY = 0.0417, 0.2337, 5.64, 5.23
#: Random walk of the slow part of the length of day, ms/sqrt(d): 0.0118 by the same likelihood,
#: raised for the coverage of hindcasts at 180 and 365 days.
SLOW_WALK = 0.014
#: Random walk of the amplitudes of the seasons, ms/sqrt(d).
SEASON_WALK = 1e-5
#: Smallest standard deviation of an observation, ms.
OBSERVATION = 0.012
#: Standard deviations before the first observation: UT1, ms, and slow part, fast part (two
#: states), and seasons, ms.
BEFORE = np.array([1e3, 3.0, FAST, FAST, 0.5, 0.5, 0.5, 0.5, 0.2, 0.2])
#: Standard deviations of the last rows of finals2000A, the newest last, from the values to which
#: they are revised later, ms; those stated are three times smaller.
NEWEST = np.array([0.009, 0.014, 0.020, 0.027, 0.023, 0.044])
#: Days that are taken from Bulletin A. Standard deviations of its UT1 and of its length of day (of
#: which the last depends on day 8, too), ms; of UT1 of day 7 minus that of day 6, ms, and its
#: correlation with UT1 of day 7. Measured on 89 releases of 2023 to 2026;
#: `python -m data_tools forecast` measures them again.
DAYS = 7
BULLETIN_A_ERRORS = np.array(
    [
        [0.073, 0.102, 0.137, 0.181, 0.229, 0.287, 0.351],
        [0.044, 0.055, 0.059, 0.061, 0.069, 0.081, 0.100],
    ]
)
BULLETIN_A_CHANGE, BULLETIN_A_CORRELATION = 0.081, 0.83
#: Horizon at which the variance of the model takes over from that of the innovations, d, and the
#: factor by which this one's standard deviation was raised for the coverage of hindcasts.
TAKEN_OVER, RAISED = 10.0, 1.1

#: What is observed.
_OBSERVED = np.eye(1, BEFORE.size)
#: Length of day without tides: slow and fast part and seasons.
_DAY = np.array([[0.0, 1, 0, 1, 1, 0, 1, 0, 1, 0]])


def model() -> StateSpace:
    """State-space model of daily UT1 without tides (10 real states, in the order of `BEFORE`)."""
    rates, walks = np.zeros((BEFORE.size, BEFORE.size)), np.full(BEFORE.size, SEASON_WALK)
    rates[0] = -_DAY
    rates[2, 2], rates[3, 2:4] = -1 / FIRST_MEMORY, np.array([1, -1]) / SECOND_MEMORY
    for number, place in enumerate((4, 6, 8), start=1):
        rates[place + 1, place] = 2 * np.pi * number / YEAR
        rates[place, place + 1] = -rates[place + 1, place]
    walks[:4] = WHITE, SLOW_WALK, FAST * np.sqrt(2 / FIRST_MEMORY), 0
    error = np.array([[OBSERVATION**2]])
    return StateSpace.sampled(rates, np.diag(walks**2), _OBSERVED, error, np.diag(BEFORE**2))


@lru_cache(maxsize=4)
def _filter(errors: bytes) -> Filter:
    """Kalman filter of the model for rows with standard deviations, ms, given as bytes."""
    return Filter.of(model(), RECORD, np.frombuffer(errors)[:, None, None] ** 2)


@dataclass(frozen=True)
class PredictedRotation:
    """Predicted UT1 and length of day without zonal tides, for each day after the last observation.

    Attributes
    ----------
    ut1, length_of_day : array, shape (2, n)
        UT1 - TAI, and the excess of the length of day over 86400 s as a mean of the day before and
        the day after, each with its 95 % half-width, ms.
    """

    ut1: FloatArray
    length_of_day: FloatArray


def forecast(
    u: FloatArray,
    errors: FloatArray,
    days: int,
    later: int = NEWEST.size,
    bulletin_a: FloatArray | None = None,
) -> PredictedRotation:
    """Forecast UT1 and the length of day from daily values of observed UT1, without zonal tides.

    Parameters
    ----------
    u : array, shape (n,)
        UT1 - TAI without zonal tides, ms, daily.
    errors : array, shape (n,)
        Standard deviations, ms.
    days : int
        Number of days ahead.
    later : int
        Number of observed rows of finals2000A after the last day; the newest are less accurate.
    bulletin_a : array, shape (7,), optional
        The same as `u` for the next seven days, predicted by Bulletin A.

    Raises
    ------
    UndefinedError
        If the record is too short.
    """
    record, errors = last_of(u), np.fmax(last_of(errors), OBSERVATION)
    if later < NEWEST.size:
        errors[later - NEWEST.size :] = np.fmax(NEWEST[: NEWEST.size - later], OBSERVATION)
    system = (kalman := _filter(errors.tobytes())).model
    state, innovations = kalman.run((record - record[0])[:, None])
    series = innovations[:, 0].astype(complex)
    covariance, gain, future = kalman.covariance, kalman.gains[-1], np.empty((0, 1))
    last = max(days, DAYS) + 1
    if later >= NEWEST.size:
        autoregression = Autoregression.fitted(series)
        future = autoregression.extended(series, min(last, EXTRAPOLATED)).real[:, None]
    two_days = system.every(2)
    change, noise = two_days.transition[:1] - _OBSERVED, two_days.noise[0, 0]
    path, variance = np.full(last + 1, state[0]), np.zeros((2, last + 1))
    for day in range(1, last + 1):
        variance[1, day] = ((change @ covariance @ change.T)[0, 0] + noise) / 4
        state, covariance = system.transition @ state, system.propagated(covariance)
        if bulletin_a is not None and day == DAYS:
            state, covariance = _with_seventh_day(system, state, covariance, bulletin_a - record[0])
        path[day], variance[0, day] = state[0], system.of_observation(covariance)[0, 0]
        if day <= len(future):
            path[day] += future[day - 1, 0]
            state = state + gain @ future[day - 1]
    if later >= NEWEST.size:
        weight = np.exp(-((np.arange(last + 1) / TAKEN_OVER) ** 2))
        by_innovations = _by_innovations(kalman, autoregression, last + 1)
        variance = weight * by_innovations + (1 - weight) * variance
    half_width = NORMAL_95 * np.sqrt(variance)
    ut1, seven = path + record[0], slice(1, DAYS + 1)
    if bulletin_a is not None:
        ut1[seven], half_width[:, seven] = bulletin_a, NORMAL_95 * BULLETIN_A_ERRORS
        path[1:DAYS] = bulletin_a[:-1] - record[0]
    rows, length_of_day = slice(1, days + 1), (path[:-2] - path[2:]) / 2
    return PredictedRotation(
        np.array([ut1[rows], half_width[0, rows]]),
        np.array([length_of_day[:days], half_width[1, rows]]),
    )


def _with_seventh_day(
    system: StateSpace, state: FloatArray, covariance: FloatArray, predicted: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Update the state of day 7 by UT1 that Bulletin A predicts for it, and by its last change."""
    change = _OBSERVED - np.linalg.inv(system.transition)[:1]
    rows, deviation = (
        np.vstack([_OBSERVED, change]),
        np.array([BULLETIN_A_ERRORS[0, -1], BULLETIN_A_CHANGE]),
    )
    correlation = np.array([[1, BULLETIN_A_CORRELATION], [BULLETIN_A_CORRELATION, 1]])
    error = correlation * np.outer(deviation, deviation)
    gain = np.linalg.solve(rows @ covariance @ rows.T + error, rows @ covariance).T
    data = np.array([predicted[-1], predicted[-1] - predicted[-2]])
    updated = covariance - gain @ rows @ covariance
    return state + gain @ (data - rows @ state), (updated + updated.T) / 2


def _by_innovations(kalman: Filter, autoregression: Autoregression, count: int) -> FloatArray:
    """Variances of UT1 and of the length of day for days from 0, ms2, from those of innovations."""
    unit = np.eye(1, ORDER, ORDER - 1, dtype=complex)[0]
    impulse = np.append(1.0, autoregression.extended(unit, count).real)
    response, state = np.zeros(count + 2), np.zeros(BEFORE.size)
    for day, value in enumerate(impulse[:count]):
        response[day + 2] = state[0] + value
        state = kalman.model.transition @ (state + kalman.gains[-1][:, 0] * value)
    ut1, day = np.cumsum([response[1:-1] ** 2, ((response[2:] - response[:-2]) / 2) ** 2], axis=1)
    return np.asarray(RAISED**2 * autoregression.covariance[0, 0] * np.array([ut1, day]))

"""Celestial pole offsets predicted up to two years ahead from observed ones.

A constant and the free core nutation are fitted with weights that halve in half a year, so that
both follow the last observations. What the fit leaves of the last days fades: its mean slowly, and
the departure of the last day from that mean quickly. The half-widths come from the same
prediction made from every earlier day of the series itself.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from earthspin.constants import DAYS_PER_YEAR, NORMAL_95
from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.nutation.core_nutation import circle

#: Time in which weights halve, d.
HALF_LIFE = 0.5 * DAYS_PER_YEAR
#: Days over which the residuals of the last days are averaged, by weights that fall by e.
RECENT = 10.0
#: Times in which the mean residual and the last departure from it fall by e, d.
SLOW_FADE, FAST_FADE = 40.0, 4.0
#: Part of the variance of an offset that its stated error does not hold, rad^2: (0.2 mas)^2.
FLOOR = (0.2e-3 / 3600 * np.pi / 180) ** 2
#: Longest prediction, d: two years after the last observed pole, weeks after the last offset.
LONGEST = 800
#: Days before the origin whose predictions measure the half-widths, and the fewest of them.
JUDGED, FEWEST = round(8 * DAYS_PER_YEAR), 2 * 365
#: Days in which the fit comes to rest, before its predictions count.
STARTING = 2 * 365


@dataclass(frozen=True)
class Fits:
    """Constant and free core nutation, fitted for each day to all earlier days of a series.

    Attributes
    ----------
    constant, amplitude : ndarray, shape (t,), complex
        Constant, and factor of exp(2 pi i t/T), from the days up to each one.
    slow, fast : ndarray, shape (t,), complex
        Mean of the recent residuals, and departure of the last from it.
    """

    time: FloatArray
    constant: ComplexArray
    amplitude: ComplexArray
    slow: ComplexArray
    fast: ComplexArray

    def ahead(self, horizon: float, days: slice | int) -> ComplexArray:
        """Predict celestial pole offsets `horizon` days after each of the selected days."""
        then = circle(np.atleast_1d(self.time[days]) + horizon)
        slow, fast = np.exp(-horizon / SLOW_FADE), np.exp(-horizon / FAST_FADE)
        return np.asarray(
            self.constant[days]
            + self.amplitude[days] * then
            + self.slow[days] * slow
            + self.fast[days] * fast
        )


def predict(
    mjd: FloatArray,
    dx: FloatArray,
    dy: FloatArray,
    dx_error: FloatArray,
    dy_error: FloatArray,
    target_mjd: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Predict celestial pole offsets after the last observed day.

    Parameters
    ----------
    mjd : ndarray, shape (t,)
        Modified Julian dates of the observed offsets, one a day; the last is the origin.
    dx, dy : ndarray, shape (t,)
        dX, dY from IAU 2006/2000A, rad.
    dx_error, dy_error : ndarray, shape (t,)
        One standard deviation, rad.
    target_mjd : ndarray, shape (n,)
        Dates that are predicted, after the origin by `LONGEST` days at most.

    Returns
    -------
    values, half_widths : ndarray, shape (n, 2)
        dX and dY, and their 95 % half-widths, rad.

    Raises
    ------
    UndefinedError
        If the series has gaps or is too short, or a date lies outside what can be predicted.
    """
    target = np.atleast_1d(np.asarray(target_mjd, dtype=float))
    horizon = target - mjd[-1]
    _check(np.asarray(mjd, dtype=float), np.stack([dx, dy, dx_error, dy_error]), horizon)
    eta = dx + 1j * dy
    fits = fit_each_day(mjd, eta, 1 / (dx_error**2 + dy_error**2 + 2 * FLOOR))
    values = np.array([fits.ahead(h, mjd.size - 1)[0] for h in horizon])
    whole = np.ceil(horizon).astype(int)
    widths = {h: half_width(fits, eta, h) for h in np.unique(whole)}
    return (
        np.stack([values.real, values.imag], axis=1),
        np.array([widths[h] for h in whole]),
    )


def fit_each_day(time: FloatArray, eta: ComplexArray, weight: FloatArray) -> Fits:
    """Fit constant and free core nutation to the pole offsets up to each day of a series.

    Weights decrease exponentially with the age of the data.

    Parameters
    ----------
    time : ndarray, shape (t,)
        d, one a day.
    eta : ndarray, shape (t,), complex
        dX + i dY.
    weight : ndarray, shape (t,)
        Weight of each day by its error, before it fades.
    """
    from scipy.signal import lfilter

    turned = circle(time)

    def total(values: ComplexArray | FloatArray, fall: float) -> ComplexArray:
        return np.asarray(lfilter([1.0], [1.0, -fall], values.astype(complex)))

    fall = 0.5 ** (1 / HALF_LIFE)
    both, mixed = total(weight, fall), total(weight * turned, fall)
    of_one, of_turned = total(weight * eta, fall), total(weight * np.conj(turned) * eta, fall)
    determinant = both * both - np.abs(mixed) ** 2
    # The first days alone determine nothing; no use is made of them.
    determinant[determinant == 0] = np.inf
    constant = (both * of_one - mixed * of_turned) / determinant
    amplitude = (both * of_turned - np.conj(mixed) * of_one) / determinant
    residual = eta - constant - amplitude * turned
    recent = np.exp(-1 / RECENT)
    slow = total(weight * residual, recent) / total(weight, recent)
    return Fits(time, constant, amplitude, slow, residual - slow)


def half_width(fits: Fits, eta: ComplexArray, horizon: int) -> FloatArray:
    """95 % half-widths of dX and dY predicted a given number of days ahead, shape (2,).

    The root mean square of the errors of the same prediction from earlier days, whose targets were
    observed by the last day.
    """
    last = eta.size - horizon
    days = slice(max(STARTING, last - JUDGED), last)
    error = fits.ahead(horizon, days) - eta[days.start + horizon : days.stop + horizon]
    return NORMAL_95 * np.sqrt([np.mean(error.real**2), np.mean(error.imag**2)])


def _check(mjd: FloatArray, values: FloatArray, horizon: FloatArray) -> None:
    """Refuse a series with gaps, missing numbers or too few days; refuse dates too far ahead."""
    if not (np.all(np.isfinite(values)) and np.all(np.isfinite(mjd))):
        raise UndefinedError("offsets or errors are not finite; leave out those days")
    if mjd.size < 2 or np.max(abs(np.diff(mjd) - 1)) > 1e-3:
        raise UndefinedError("days are missing between the offsets; give one row a day")
    longest = float(np.max(horizon, initial=0.0))
    if not np.all((horizon > 0) & (horizon <= LONGEST)):
        raise UndefinedError(
            f"a date {float(horizon[np.argmax(abs(horizon))]):.0f} d after the last offset cannot "
            f"be predicted; dates from 1 to {LONGEST} d after it can"
        )
    if problem := too_short(mjd.size, longest):
        raise UndefinedError(problem)


def too_short(size: int, longest: float) -> str | None:
    """Return the reason (text) to omit a prediction if `size` days are too few, else None."""
    needed = STARTING + FEWEST + int(np.ceil(longest))
    if size >= needed:
        return None
    return f"{size} days of offsets are too few for {longest:.0f} d ahead; give {needed}"

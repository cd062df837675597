"""Free core nutation in observed celestial pole offsets, and prediction of the offsets."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import DAYS_PER_YEAR, NORMAL_95
from earthspin.errors import UndefinedError
from earthspin.interior.named import OBSERVED_CORE_NUTATION
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.numerics.sampling import in_blocks

# --- amplitude and phase of the free core nutation ------------------------------------------------
# The offsets are one complex number, eta = dX + i dY. The free core nutation is a retrograde circle
# in space, a exp(2 pi i t/T) with a negative period T, and its complex amplitude a changes from
# year to year. It is fitted with a constant and a line in sliding windows.

#: Period in space, d.
PERIOD = OBSERVED_CORE_NUTATION.value
#: Length of a window and time between two, d.
WINDOW, STEP = 3 * DAYS_PER_YEAR, 30.0
#: Days that are averaged before the fit.
BLOCK = 10.0
#: Shortest window, in periods: the neighbours below are then separate from constant and line.
SHORTEST = 2.0
#: Frequencies at which the noise of a window is measured: prograde, where no free nutation is, at
#: the absolute frequency of the free core nutation plus these numbers of turns in the window.
NEIGHBOURS = (-1, 0, 1, 2)
#: Factor on the noise of the neighbours, from simulations with red noise: noise falls with
#: frequency, and the fit itself removes some.
EXCESS = 1.15
#: Chance that noise alone passes for a free core nutation in a window.
FALSE_ALARM = 1e-2


@dataclass(frozen=True)
class CoreNutationAmplitudes:
    """Amplitudes of the free core nutation in sliding time windows, with errors.

    Attributes
    ----------
    time : ndarray, shape (w,)
        Middles of the windows, d.
    amplitude : ndarray, shape (w,), complex
        Factor of exp(2 pi i t/T).
    error : ndarray, shape (w,)
        95 % half-width of the absolute value.
    limit : ndarray, shape (w,)
        Detection limit, which noise alone passes with the probability `FALSE_ALARM`.
    period : float
        T, d.
    """

    time: FloatArray
    amplitude: ComplexArray
    error: FloatArray
    limit: FloatArray
    period: float

    @property
    def detected(self) -> NDArray[np.bool_]:
        """True for each time window whose amplitude exceeds the detection limit, shape (w,)."""
        return np.asarray(np.abs(self.amplitude) > self.limit)

    @property
    def phase_error(self) -> FloatArray:
        """95 % half-width of the phase, rad; half a turn for windows without detection."""
        ratio = self.error / np.abs(self.amplitude)
        return np.where(self.detected, np.arcsin(np.minimum(ratio, 1.0)), np.pi)

    def at(self, time: FloatArray) -> ComplexArray:
        """Free core nutation at given days; the amplitude is interpolated between window centres.

        The amplitude of the first or last window is used before the first or after the last centre.
        """
        parts = (self.amplitude.real, self.amplitude.imag)
        real, imaginary = (np.interp(time, self.time, part) for part in parts)
        return np.asarray((real + 1j * imaginary) * circle(time, self.period))


def circle(time: FloatArray, period: float = PERIOD) -> ComplexArray:
    """Circular motion of unit amplitude and period T at times t: exp(2 pi i t/T)."""
    return np.asarray(np.exp(2j * np.pi * time / period))


def fit(
    time: FloatArray,
    eta: ComplexArray,
    window: float = WINDOW,
    step: float = STEP,
    period: float = PERIOD,
) -> CoreNutationAmplitudes:
    """Fit free core nutation, constant and trend to pole offsets in sliding time windows.

    The noise is not white, so its power is measured where it matters: at the same frequency in
    the other sense, and at neighbours of it, in what the fit leaves of the window. The ratio of
    the two powers then has Fisher's distribution whatever the colour of the noise.

    Parameters
    ----------
    time : ndarray, shape (t,)
        d, evenly spaced.
    eta : ndarray, shape (t,), complex
        dX + i dY in any unit, without gaps.
    window, step : float
        Length of a window, and time between two, d.
    period : float
        Period of the free core nutation in space, d; negative.

    Raises
    ------
    UndefinedError
        If the window is shorter than `SHORTEST` periods, or longer than the series.
    """
    from scipy.special import fdtri, stdtrit

    spacing = (time[-1] - time[0]) / (time.size - 1)
    middles, means, length = in_blocks(time, eta, BLOCK)
    count, width = means.size, round(window / length)
    if window < SHORTEST * abs(period) or width > count:
        raise UndefinedError(
            f"a window of {window:.0f} d is not possible; it lies between "
            f"{SHORTEST * abs(period):.0f} d, {SHORTEST:g} periods of the free core nutation, and "
            f"the series' {count * length:.0f} d"
        )
    offsets = (np.arange(width, dtype=float) - (width - 1) / 2) * length
    # A mean over a block shortens a circle.
    factor = np.sinc(length / period) / np.sinc(spacing / period)
    columns = np.column_stack([np.ones(width), offsets / window, circle(offsets, period) * factor])
    starts = np.arange(0, count - width + 1, max(1, round(step / length)))
    series = np.lib.stride_tricks.sliding_window_view(means, width)[starts]
    # Plain sums: a BLAS rounds otherwise with another number of threads.
    coefficients = np.einsum("ws,ks->wk", series, np.linalg.pinv(columns))
    residual = series - np.einsum("wk,sk->ws", coefficients, columns)
    frequencies = 1 / abs(period) + np.array(NEIGHBOURS) / (width * length)
    neighbours = np.exp(2j * np.pi * np.outer(offsets, frequencies))
    noise = np.einsum("ws,ks->wk", residual, np.linalg.pinv(neighbours))
    power = EXCESS**2 * np.mean(np.abs(noise) ** 2, axis=1)
    freedom = 2 * len(NEIGHBOURS)
    limit, noise_alone = (
        np.sqrt(power * fdtri(2, freedom, chance)) for chance in (1 - FALSE_ALARM, 0.95)
    )
    middle = middles[starts] + offsets[-1]
    amplitude = coefficients[:, 2] / circle(middle, period)
    half_width = np.sqrt(power / 2) * stdtrit(freedom, 0.975)
    # Below what noise alone gives, the true amplitude may be zero, and the estimate is too large.
    error = np.where(np.abs(amplitude) > noise_alone, half_width, noise_alone)
    return CoreNutationAmplitudes(middle, amplitude, error, limit, period)


# --- prediction of celestial pole offsets, up to two years ahead ----------------------------------
# A constant and the free core nutation are fitted with weights that halve in half a year, so that
# both follow the last observations. What the fit leaves of the last days fades: its mean slowly,
# and the departure of the last day from that mean quickly. The half-widths come from the same
# prediction made from every earlier day of the series itself.

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
    """Constant and free core nutation, fitted for each day to the offsets up to that day.

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
        circle_ahead = circle(np.atleast_1d(self.time[days]) + horizon)
        slow_factor, fast_factor = np.exp(-horizon / SLOW_FADE), np.exp(-horizon / FAST_FADE)
        return np.asarray(
            self.constant[days]
            + self.amplitude[days] * circle_ahead
            + self.slow[days] * slow_factor
            + self.fast[days] * fast_factor
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
    whole_days = np.ceil(horizon).astype(int)
    widths = {h: half_width(fits, eta, h) for h in np.unique(whole_days)}
    return np.stack([values.real, values.imag], axis=1), np.array([widths[h] for h in whole_days])


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

    circles = circle(time)

    def total(values: ComplexArray | FloatArray, decay: float) -> ComplexArray:
        return np.asarray(lfilter([1.0], [1.0, -decay], values.astype(complex)))

    decay = 0.5 ** (1 / HALF_LIFE)
    weight_sum, circle_sum = total(weight, decay), total(weight * circles, decay)
    eta_sum, turned_sum = (total(w * eta, decay) for w in (weight, weight * np.conj(circles)))
    determinant = weight_sum * weight_sum - np.abs(circle_sum) ** 2
    # The first days alone determine nothing; no use is made of them.
    determinant[determinant == 0] = np.inf
    constant = (weight_sum * eta_sum - circle_sum * turned_sum) / determinant
    amplitude = (weight_sum * turned_sum - np.conj(circle_sum) * eta_sum) / determinant
    residual = eta - constant - amplitude * circles
    recent = np.exp(-1 / RECENT)
    slow = total(weight * residual, recent) / total(weight, recent)
    return Fits(time, constant, amplitude, slow, residual - slow)


def half_width(fits: Fits, eta: ComplexArray, horizon: int) -> FloatArray:
    """95 % half-widths of dX and dY predicted a given number of days ahead, shape (2,).

    The root mean square of the errors of the same prediction from earlier days, whose targets were
    observed by the last day.
    """
    count = eta.size - horizon
    days = slice(max(STARTING, count - JUDGED), count)
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

"""Amplitude and phase of the free core nutation in observed celestial pole offsets.

The offsets are one complex number, eta = dX + i dY. The free core nutation is a retrograde circle
in space, a exp(2 pi i t/T) with a negative period T, and its complex amplitude a changes from year
to year. It is fitted with a constant and a line in sliding windows.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import DAYS_PER_YEAR
from earthspin.errors import UndefinedError
from earthspin.interior.published import OBSERVED_CORE_NUTATION
from earthspin.numerics.arrays import ComplexArray, FloatArray

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
class CoreNutation:
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
        """Free core nutation at given days; its amplitude is interpolated between window centres.

        The amplitude of the first or last window is used before the first or after the last centre.
        """
        amplitude = np.interp(time, self.time, self.amplitude.real) + 1j * np.interp(
            time, self.time, self.amplitude.imag
        )
        return np.asarray(amplitude * circle(time, self.period))


def circle(time: FloatArray, period: float = PERIOD) -> ComplexArray:
    """Circular motion of unit amplitude and period T at times t: exp(2 pi i t/T)."""
    return np.asarray(np.exp(2j * np.pi * time / period))


def fit(
    time: FloatArray,
    eta: ComplexArray,
    window: float = WINDOW,
    step: float = STEP,
    period: float = PERIOD,
) -> CoreNutation:
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
    block = max(1, round(BLOCK / spacing))
    count = time.size // block
    means = eta[: count * block].reshape(count, block).mean(axis=1)
    middles = time[: count * block].reshape(count, block).mean(axis=1)
    length = block * spacing
    size = round(window / length)
    if window < SHORTEST * abs(period) or size > count:
        raise UndefinedError(
            f"a window of {window:.0f} d is not possible; it lies between "
            f"{SHORTEST * abs(period):.0f} d, {SHORTEST:g} periods of the free core nutation, and "
            f"the series' {count * length:.0f} d"
        )
    local = (np.arange(size) - (size - 1) / 2) * length
    # A mean over a block shortens a circle.
    shortened = np.sinc(length / period) / np.sinc(spacing / period)
    columns = np.column_stack([np.ones(size), local / window, circle(local, period) * shortened])
    starts = np.arange(0, count - size + 1, max(1, round(step / length)))
    series = np.lib.stride_tricks.sliding_window_view(means, size)[starts]
    # Plain sums: a BLAS rounds otherwise with another number of threads.
    coefficients = np.einsum("ws,ks->wk", series, np.linalg.pinv(columns))
    residual = series - np.einsum("wk,sk->ws", coefficients, columns)
    frequencies = 1 / abs(period) + np.array(NEIGHBOURS) / (size * length)
    neighbours = np.exp(2j * np.pi * np.outer(local, frequencies))
    noise = np.einsum("ws,ks->wk", residual, np.linalg.pinv(neighbours))
    power = EXCESS**2 * np.mean(np.abs(noise) ** 2, axis=1)
    freedom = 2 * len(NEIGHBOURS)
    limit, noise_alone = (
        np.sqrt(power * fdtri(2, freedom, chance)) for chance in (1 - FALSE_ALARM, 0.95)
    )
    middle = middles[starts] + local[-1]
    amplitude = coefficients[:, 2] / circle(middle, period)
    half_width = np.sqrt(power / 2) * stdtrit(freedom, 0.975)
    # Below what noise alone gives, the true amplitude may be zero, and the estimate is too large.
    error = np.where(np.abs(amplitude) > noise_alone, half_width, noise_alone)
    return CoreNutation(middle, amplitude, error, limit, period)

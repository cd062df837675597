"""Records of polar motion: checks, drift and seasonal terms, amplitudes in windows, and spectra.

Polar motion is complex, p = x - i y, so that the free wobble turns with exp(+i omega t).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from earthspin.constants import DAYS_PER_YEAR, NORMAL_95
from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.numerics.sampling import in_blocks

# --- checks, drift and seasonal terms -------------------------------------------------------------

YEAR = 365.2422  # d, the tropical year of the seasons
#: Seasonal terms that are fitted and removed, d; negative ones turn backwards.
SEASONS = (YEAR, -YEAR, YEAR / 2, -YEAR / 2)
#: Periods among which the free wobble is looked for, d.
BAND = (400.0, 470.0)
#: Where the search starts, d.
NEAR = 433.0
#: Degree of the slow drift.
DRIFT = 3
#: Longest step between samples, d: a tenth of a year, as in the oldest tables.
LONGEST_STEP = 37.0


def shortest_span(period: float = NEAR) -> float:
    """Shortest record that separates free and annual wobble: one beat period of both, d."""
    return 1 / (1 / YEAR - 1 / period)


def check(time: FloatArray, p: ComplexArray) -> None:
    """Refuse polar motion with invalid values, uneven steps or a span too short for a fit.

    Parameters
    ----------
    time : array, shape (n,)
        d.
    p : complex array, shape (n,)

    Raises
    ------
    UndefinedError
        If shapes differ, values are no numbers, steps are uneven or too long, or the span is short.
    """
    if np.shape(time) != np.shape(p) or np.ndim(p) != 1:
        raise UndefinedError(f"{np.shape(time)} times for {np.shape(p)} positions; give as many")
    if not (np.all(np.isfinite(time)) and np.all(np.isfinite(p))):
        raise UndefinedError("polar motion has values that are no numbers; leave those days out")
    steps = np.diff(time)
    if steps.size == 0 or np.any(abs(steps - steps.mean()) > 1e-3 * abs(steps.mean())):
        raise UndefinedError("times are not evenly spaced; fill the gaps or take another span")
    if not 0 < steps.mean() <= LONGEST_STEP:
        raise UndefinedError(
            f"a step of {steps.mean():.3g} d is not possible; it lies between 0 and "
            f"{LONGEST_STEP:g} d"
        )
    span, needed = time[-1] - time[0], 2 * shortest_span()
    if span < needed:
        raise UndefinedError(
            f"a span of {span / DAYS_PER_YEAR:.1f} years is too short to separate {YEAR:.0f} from "
            f"{NEAR:.0f} days; it takes {needed / DAYS_PER_YEAR:.0f} years, "
            "two beats of the two wobbles"
        )


def turning(time: Any, period: float) -> ComplexArray:
    """Values of exp(2 pi i time/period), a prograde circular motion of unit amplitude."""
    return np.asarray(np.exp(2j * np.pi * time / period))


def drift_terms(time: FloatArray, degree: int = DRIFT) -> ComplexArray:
    """Powers of time scaled to -1 to 1, for a drift polynomial, shape (n, degree + 1)."""
    centre, half = (time[-1] + time[0]) / 2, (time[-1] - time[0]) / 2
    scaled = (time - centre) / half
    return np.column_stack([scaled**k for k in range(degree + 1)]).astype(complex)


def known_terms(time: FloatArray, drift: int = DRIFT) -> ComplexArray:
    """Values of the drift and seasonal terms at given times, shape (n, drift + 5)."""
    seasons = [turning(time, period) for period in SEASONS]
    return np.column_stack([drift_terms(time, drift), *seasons])


def least_squares(columns: ComplexArray, values: ComplexArray) -> ComplexArray:
    """Fit a linear combination of given columns to a series; return its coefficients."""
    return np.asarray(np.linalg.lstsq(columns, values, rcond=None)[0])


def without_known_terms(time: FloatArray, p: ComplexArray) -> ComplexArray:
    """Remove drift and seasonal terms from polar motion; the free wobble is fitted, but kept."""
    columns = known_terms(time)
    sizes = least_squares(np.column_stack([columns, turning(time, NEAR)]), p)
    return np.asarray(p - columns @ sizes[:-1])


@dataclass(frozen=True)
class WobbleFit:
    """Period and quality factor of the free wobble, as fitted by one method.

    Attributes
    ----------
    method : str
    period, period_error : float
        Value and 95 % half-width, d.
    quality_factor : float
        Q.
    quality_bounds : tuple of float
        Ends of the 95 % interval of Q.
    """

    method: str
    period: float
    period_error: float
    quality_factor: float
    quality_bounds: tuple[float, float]


# --- amplitude and phase in sliding windows -------------------------------------------------------

WINDOW_BLOCK = WINDOW_STEP = 30.0  # d
#: How far amplitudes scatter beyond the noise that is left in a window, from simulations: the
#: fit takes some of it away.
AMPLITUDE_EXCESS = 1.3
#: The same of the annual amplitude beside that: the excitation of the free wobble within a window
#: is near the year, and is fitted as a part of the annual wobble.
ANNUAL_EXCESS = 1.6


@dataclass(frozen=True)
class Envelope:
    """Amplitudes and phases of the free and annual wobbles in sliding time windows.

    Attributes
    ----------
    time : array, shape (w,)
        Middles of the windows, d.
    chandler, annual, annual_retrograde : complex array
        Sizes and phases at time 0: terms a exp(2 pi i time/T).
    error, annual_error : array
        95 % half-widths of the mean amplitude of the free wobble in the window (and of the
        retrograde annual amplitude), and of the amplitude of a steady annual wobble.
    drift : complex array
        Mean position in the window.
    """

    time: FloatArray
    chandler: ComplexArray
    annual: ComplexArray
    annual_retrograde: ComplexArray
    drift: ComplexArray
    error: FloatArray
    annual_error: FloatArray


def envelope(
    time: FloatArray, p: ComplexArray, period: float, window: float | None = None
) -> Envelope:
    """Fit free wobble, annual wobble and linear drift of the pole in sliding time windows.

    Parameters
    ----------
    time : array
        d, evenly spaced.
    p : complex array
    period : float
        Period of the free wobble, d.
    window : float, optional
        Length, d; one beat of the two wobbles by default, the shortest that parts them.

    Raises
    ------
    UndefinedError
        If the window is shorter than a beat, or longer than the series.
    """
    beat = shortest_span(period)
    length = beat if window is None else window
    sample = (time[-1] - time[0]) / (time.size - 1)
    time, p, spacing = in_blocks(time, p, WINDOW_BLOCK)
    size = round(length / spacing) + 1
    if length < 0.9 * beat or size > time.size:
        raise UndefinedError(
            f"a window of {length:.0f} d is not possible; it lies between one beat of the wobbles, "
            f"{beat:.0f} d, and the series' {time[-1] - time[0]:.0f} d"
        )
    offsets = (np.arange(size) - (size - 1) / 2) * spacing
    periods = (period, YEAR, -YEAR, YEAR / 2)
    # The mean over m samples in a block B reduces the amplitude of a sinusoid with the period T by
    # the factor sin(pi B/T)/(m sin(pi B/(m T))).
    factors = [np.sinc(spacing / term) / np.sinc(sample / term) for term in periods]
    waves = [turning(offsets, term) * factor for term, factor in zip(periods, factors, strict=True)]
    columns = np.column_stack([np.ones(size), offsets / length, *waves])
    solver = np.linalg.pinv(columns)
    starts = np.arange(0, time.size - size + 1, max(1, round(WINDOW_STEP / spacing)))
    series = np.lib.stride_tricks.sliding_window_view(p, size)[starts]
    # Plain sums: a BLAS rounds otherwise with another number of threads.
    sizes = np.einsum("ws,ks->wk", series, solver)
    middle = time[starts] + offsets[-1]
    residuals = series - np.einsum("wk,sk->ws", sizes, columns)
    to_time_zero = np.exp(-2j * np.pi * middle[:, None] / np.array(periods[:3]))
    amplitudes = sizes[:, 2:5] * to_time_zero
    chandler, annual, retrograde = amplitudes.T
    # The free wobble is prograde only: what excites it within the window changes its mean and is no
    # error of it. The noise is that at the opposite frequency.
    rate = 2 * np.pi / period
    error = _amplitude_error(residuals, spacing, -rate)
    annual_error = ANNUAL_EXCESS * _amplitude_error(residuals, spacing, rate)
    return Envelope(middle, chandler, annual, retrograde, sizes[:, 0], error, annual_error)


def _amplitude_error(residuals: ComplexArray, spacing: float, rate: float) -> FloatArray:
    """95 % half-width of wobble amplitudes in time windows, from residuals with correlated noise.

    The errors of neighbouring months are correlated: the noise is taken as autoregressive of first
    order, with the power of its spectrum at the frequency of the wobble.
    """
    power = np.mean(abs(residuals) ** 2, axis=1)
    # Over as many samples as the power: the size of the correlation then never exceeds 1.
    products = np.sum(residuals[:, 1:] * residuals[:, :-1].conj(), axis=1)
    correlation = products / (residuals.shape[1] * power)
    whitening = abs(1 - correlation * np.exp(-1j * rate * spacing)) ** 2
    density = power * (1 - abs(correlation) ** 2) / whitening
    return np.asarray(AMPLITUDE_EXCESS * NORMAL_95 * np.sqrt(density / (2 * residuals.shape[1])))


# --- amplitude spectra ----------------------------------------------------------------------------

#: Points of the spectrum for each one that is independent.
PADDING = 4


def spectrum(time: FloatArray, p: ComplexArray) -> tuple[FloatArray, FloatArray]:
    """Compute the prograde and retrograde amplitude spectra of polar motion.

    Parameters
    ----------
    time : array
        d, evenly spaced.
    p : complex array
        Polar motion in any unit; a cubic drift is removed and a Hann window is applied.

    Returns
    -------
    frequency : array
        Cycles per unit of time, ascending; negative is retrograde.
    amplitude : array
        Amplitude of a single sinusoid, in the unit of p.
    """
    step = (time[-1] - time[0]) / (time.size - 1)
    drift = drift_terms(time)
    rest = p - drift @ least_squares(drift, p)
    taper = np.hanning(time.size)
    padded = PADDING * time.size
    amplitude = abs(np.fft.fftshift(np.fft.fft(rest * taper, padded))) / taper.sum()
    frequency = np.fft.fftshift(np.fft.fftfreq(padded, step))
    return frequency, amplitude

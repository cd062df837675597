"""Amplitude and phase of the free and annual wobbles over time, from sliding windows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from earthspin.constants import NORMAL_95
from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.wobble.record import YEAR, in_blocks, shortest_span, turning

BLOCK = 30.0  # d
#: How far amplitudes scatter beyond the noise that is left in a window, from simulations: the
#: fit takes some of it away.
AMPLITUDE_EXCESS = 1.3


@dataclass(frozen=True)
class Envelope:
    """Amplitudes and phases of the free and annual wobbles in sliding time windows.

    Attributes
    ----------
    time : array, shape (w,)
        Middles of the windows, d.
    chandler, annual, annual_retrograde : complex array
        Sizes and phases at time 0: terms a exp(2 pi i time/T).
    error : array
        95 % half-width of the amplitudes.
    drift : complex array
        Mean position in the window.
    """

    time: FloatArray
    chandler: ComplexArray
    annual: ComplexArray
    annual_retrograde: ComplexArray
    drift: ComplexArray
    error: FloatArray


def envelope(
    time: FloatArray,
    p: ComplexArray,
    period: float,
    window: float | None = None,
    step: float = 30.0,
) -> Envelope:
    """Fit free wobble, annual wobble and linear drift of the pole in sliding time windows.

    Parameters
    ----------
    time : array
        d, evenly spaced.
    p : complex array
    period : float
        Of the free wobble, d.
    window : float, optional
        Length, d; one beat of the two wobbles by default, the shortest that parts them.
    step : float
        Between windows, d.

    Raises
    ------
    UndefinedError
        If the window is shorter than a beat, or longer than the series.
    """
    beat = shortest_span(period)
    length = beat if window is None else window
    sample = (time[-1] - time[0]) / (time.size - 1)
    time, p, spacing = in_blocks(time, p, BLOCK)
    size = round(length / spacing) + 1
    if length < 0.9 * beat or size > time.size:
        raise UndefinedError(
            f"a window of {length:.0f} d is not possible; it lies between one beat of the wobbles, "
            f"{beat:.0f} d, and the series' {time[-1] - time[0]:.0f} d"
        )
    local = (np.arange(size) - (size - 1) / 2) * spacing
    terms = (period, YEAR, -YEAR, YEAR / 2)
    # The mean over m samples in a block B reduces the amplitude of a sinusoid with the period T by
    # the factor sin(pi B/T)/(m sin(pi B/(m T))).
    factors = [np.sinc(spacing / term) / np.sinc(sample / term) for term in terms]
    waves = [turning(local, term) * factor for term, factor in zip(terms, factors, strict=True)]
    columns = np.column_stack([np.ones(size), local / length, *waves])
    solver = np.linalg.pinv(columns)
    starts = np.arange(0, time.size - size + 1, max(1, round(step / spacing)))
    series = np.lib.stride_tricks.sliding_window_view(p, size)[starts]
    # Plain sums: a BLAS rounds otherwise with another number of threads.
    found = np.einsum("ws,ks->wk", series, solver)
    middle = time[starts] + local[-1]
    left = series - np.einsum("wk,sk->ws", found, columns)
    back = np.exp(-2j * np.pi * middle[:, None] / np.array(terms[:3]))
    turned = found[:, 2:5] * back
    return Envelope(
        middle,
        turned[:, 0],
        turned[:, 1],
        turned[:, 2],
        found[:, 0],
        _amplitude_error(left, spacing, 2 * np.pi / period),
    )


def _amplitude_error(left: ComplexArray, spacing: float, rate: float) -> FloatArray:
    """95 % half-width of wobble amplitudes in time windows, from residuals with correlated noise.

    Neighbouring months err alike: the noise is taken for an autoregressive one of first
    order, and its spectrum read off at the wobble's frequency.
    """
    power = np.mean(abs(left) ** 2, axis=1)
    alike = np.mean(left[:, 1:] * left[:, :-1].conj(), axis=1) / power
    turned = abs(1 - alike * np.exp(-1j * rate * spacing)) ** 2
    density = power * (1 - abs(alike) ** 2) / turned
    return np.asarray(AMPLITUDE_EXCESS * NORMAL_95 * np.sqrt(density / (2 * left.shape[1])))

"""Fit of the free wobble by Burg's autoregressive method."""

from __future__ import annotations

import numpy as np

from earthspin.constants import NORMAL_95
from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.wobble.record import BAND, WobbleFit, in_blocks, without_known_terms

BLOCK = 30.0  # d
ORDER = 12

#: How far the scatter of Burg's periods exceeds the best possible one, from simulations.
PERIOD_EXCESS = 1.2
#: The same of the decay, downwards and upwards: noise makes it too fast rather than too slow.
DECAY_EXCESS = (2.1, 0.65)


def burg(x: ComplexArray, order: int) -> ComplexArray:
    """Compute the prediction-error filter 1, a1, ... of a complex series, by Burg's method.

    Forward and backward errors are shortened by reflection coefficients of least mean
    error (Burg 1967; Marple 1987, Digital Spectral Analysis, sect. 8.5).

    Parameters
    ----------
    x : complex array
        Of mean zero.
    order : int
    """
    forward, backward = x[1:], x[:-1]
    filter_ = np.ones(1, dtype=complex)
    for _ in range(order):
        power = np.vdot(forward, forward).real + np.vdot(backward, backward).real
        reflection = -2 * np.vdot(backward, forward) / power
        longer = np.append(filter_, 0)
        filter_ = longer + reflection * longer[::-1].conj()
        forward, backward = (
            (forward + reflection * backward)[1:],
            (backward + np.conj(reflection) * forward)[:-1],
        )
    return filter_


def fit_burg(time: FloatArray, p: ComplexArray) -> WobbleFit:
    """Fit the free wobble to monthly means of polar motion, by Burg's autoregressive method.

    Drift and seasonal terms are removed first.
    """
    span = time[-1] - time[0]
    time, p, step = in_blocks(time, p, BLOCK)
    poles = np.roots(burg(without_known_terms(time, p), ORDER))
    s = np.log(poles) / (1j * step)
    inside = s[(s.real > 2 * np.pi / BAND[1]) & (s.real < 2 * np.pi / BAND[0])]
    if inside.size == 0:
        raise UndefinedError(
            f"no free wobble between {BAND[0]:.0f} and {BAND[1]:.0f} d stands out; take a longer "
            "or quieter span"
        )
    wobble = inside[np.argmin(abs(inside.imag))]
    period, decay = 2 * np.pi / wobble.real, abs(wobble.imag)
    error = PERIOD_EXCESS * period * np.sqrt(decay / span) / wobble.real
    low, high = _decay_interval(decay, span)
    quality, *bounds = (float(wobble.real / (2 * v)) for v in (decay, high, low))
    half_width = float(NORMAL_95 * error)
    return WobbleFit("burg", float(period), half_width, quality, (bounds[0], bounds[1]))


def _decay_interval(decay: float, span: float) -> tuple[float, float]:
    """95 % interval of the wobble's decay rate d, from its estimate and the span of the data."""
    low, high = ((NORMAL_95 * excess) ** 2 / span for excess in DECAY_EXCESS)
    return (
        float(decay + low / 2 - np.sqrt(decay * low + low**2 / 4)),
        float(decay + high / 2 + np.sqrt(decay * high + high**2 / 4)),
    )

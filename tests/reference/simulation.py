"""Simulated polar motion with a known free wobble, for tests of estimation methods."""

import numpy as np
from scipy.signal import lfilter

from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.wobble.excitation import chandler_frequency
from earthspin.wobble.record import NEAR, YEAR, turning
from earthspin.wobble.state_space import DrivenOscillator

#: Default correlation time of the red excitation, d.
RED_MEMORY = 500.0
#: Correlation times of the slow and the fast background, d, and their sizes relative to the wobble.
BACKGROUND = ((365.0, 0.08), (15.0, 0.06))


def simulate(
    years: float,
    period: float = NEAR,
    quality_factor: float = 100.0,
    *,
    step: float = 10.0,
    amplitude: float = 128.0,
    red: float = 0.0,
    memory: float = RED_MEMORY,
    seed: int | None = None,
) -> tuple[FloatArray, ComplexArray]:
    """Simulate polar motion: free wobble driven by noise, with seasonal terms and a trend.

    Parameters
    ----------
    years : float
        Length of the series, Julian years.
    period, quality_factor : float
        Period (d) and quality factor of the free wobble.
    step : float
        Time step, d.
    amplitude : float
        Root mean square of the wobble that white noise excites, mas.
    red : float
        Root mean square of an additional red excitation, mas.
    memory : float
        Correlation time of the red excitation, d.
    seed : int, optional

    Returns
    -------
    time : array
        Times, d.
    p : complex array
        Polar motion, mas. The level of the background is that of the observed motion.
    """
    generator = np.random.default_rng(seed)
    time = np.arange(0.0, years * 365.25, step)

    def process(rate: complex, size: float) -> ComplexArray:
        """Draw complex noise of rms `size` whose autocorrelation is exp(rate |time lag|)."""
        kick = generator.standard_normal((time.size, 2)) @ np.array([1, 1j]) / np.sqrt(2)
        keep = np.exp(rate * step)
        kick[1:] *= np.sqrt(1 - abs(keep) ** 2)
        return np.asarray(size * lfilter([1.0], [1.0, -keep], kick))

    rate = 2 * np.pi / period
    p = process(1j * rate - rate / (2 * quality_factor), amplitude)
    for correlation_time, share in BACKGROUND:
        p += process(-1 / correlation_time, share * amplitude)
    p += 94 * turning(time, YEAR) + 4.5 * turning(time, -YEAR) + 5 * turning(time, YEAR / 2)
    if red:
        driven = DrivenOscillator(chandler_frequency(period, quality_factor), memory, red=red**2)
        p += sampled(driven, time.size, step, generator)
    return time, p + (30 - 300j) + (1.6 - 3.4j) * time / 365.25


def red_size(
    period: float, quality_factor: float, share: float, memory: float, amplitude: float = 128.0
) -> float:
    """Rms (mas) of red noise, from its share of the excitation power at the wobble frequency.

    Parameters
    ----------
    period, quality_factor, memory, amplitude : float
        See `simulate`.
    share : float
        Share of red noise in the power of the excitation at the frequency of the wobble.
    """
    s = chandler_frequency(period, quality_factor)
    white = 2 * s.imag * amplitude**2 / abs(s) ** 2  # power of the white excitation, mas2 d
    red_of_unit_size = 2 * memory / (1 + (s.real * memory) ** 2)
    return float(np.sqrt(share / (1 - share) * white / red_of_unit_size))


def sampled(
    oscillator: DrivenOscillator, count: int, step: float, generator: np.random.Generator
) -> ComplexArray:
    """Draw polar motion at even times from the stationary distribution of an oscillator."""
    keep, stationary = np.exp(oscillator.rates * step), oscillator.covariance
    kicks = stationary - keep[:, None] * stationary * keep.conj()
    drawn = generator.standard_normal((count, 2, 2)) @ np.array([1, 1j]) / np.sqrt(2)
    pushed = drawn @ _root(kicks).T
    pushed[0] = _root(stationary) @ drawn[0]
    return np.asarray(sum(lfilter([1], [1, -keep[i]], pushed[:, i]) for i in (0, 1)))


def _root(covariance: ComplexArray) -> ComplexArray:
    """Square root R of a covariance matrix, R R^H, which may be singular."""
    values, vectors = np.linalg.eigh(covariance)
    return np.asarray(vectors * np.sqrt(np.maximum(values, 0)))

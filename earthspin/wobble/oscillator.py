"""Damped oscillator driven by white and red noise, as a model of polar motion.

Polar motion obeys p' = i s (p - chi). An excitation chi with the correlation time tau adds
a second mode of rate -1/tau to the free one of rate i s. With z the amplitudes of the two modes,

    z' = L z + n,   p = z1 + z2,   cov(n) = N,   cov(z) = P_ij = -N_ij/(l_i + conj l_j),

and the covariance of p at a lag t > 0 is the sum of g_i exp(l_i t), g = P (1, 1).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.signal import lfilter

from earthspin.numerics.arrays import ComplexArray


@dataclass(frozen=True)
class DrivenOscillator:
    """Model of polar motion: a damped wobble and a slowly varying part, driven by noise.

    Attributes
    ----------
    s : complex
        Frequency of the free mode and, as its imaginary part, its decay; rad/d.
    memory : float
        Correlation time of red excitation and background, d.
    white : float
        Variance that white noise adds to p in a day.
    red : float
        Variance of the red excitation chi.
    background : float
        Variance of a red part of p that is not excited by anything; in the unit of p, squared.
    """

    s: complex
    memory: float
    white: float = 0.0
    red: float = 0.0
    background: float = 0.0

    @property
    def rates(self) -> ComplexArray:
        """Complex rates (1/d) of the wobble and of the slowly varying part of polar motion."""
        return np.array([1j * self.s, -1 / self.memory])

    @property
    def covariance(self) -> ComplexArray:
        """Stationary covariance of wobble and slowly varying part of polar motion, shape (2, 2)."""
        rates = self.rates
        # chi' = -chi/tau + n puts c chi into the slow mode and leaves p - c chi to the free one.
        share = rates[0] / (rates[0] - rates[1])
        into = np.array([-share, share])
        noise = 2 / self.memory * self.red * np.outer(into, into.conj())
        noise += np.diag([self.white, 2 / self.memory * self.background])
        return np.asarray(-noise / (rates[:, None] + rates.conj()))

    def of_means(self, length: float, reference: float) -> tuple[ComplexArray, ComplexArray]:
        """Covariance of block means of polar motion in this model, for lags of 0, 1 and 2 blocks.

        The rotation at the reference frequency is removed first.

        Parameters
        ----------
        length : float
            Of a block, d.
        reference : float
            rad/d.

        Returns
        -------
        factors : complex array, shape (2,)
            By which the modes change from one block to the next.
        lags : complex array, shape (3,)
            Covariance at lags of none, one and two blocks.
        """
        x = (self.rates - 1j * reference) * length
        size, factors = self.covariance.sum(axis=1), np.exp(x)
        apart = size * (np.sinh(x / 2) / (x / 2)) ** 2
        same = 2 * np.sum(size * (np.expm1(x) - x) / x**2).real
        return factors, np.array([same, apart @ factors, apart @ factors**2])

    def sampled(self, count: int, step: float, generator: np.random.Generator) -> ComplexArray:
        """Simulate polar motion at evenly spaced times, shape (count,), with random noise.

        The simulation starts from the stationary distribution.
        """
        keep, stationary = np.exp(self.rates * step), self.covariance
        kicks = stationary - keep[:, None] * stationary * keep.conj()
        drawn = generator.standard_normal((count, 2, 2)) @ np.array([1, 1j]) / np.sqrt(2)
        pushed = drawn @ _root(kicks).T
        pushed[0] = _root(stationary) @ drawn[0]
        return np.asarray(sum(lfilter([1], [1, -keep[i]], pushed[:, i]) for i in (0, 1)))


def _root(covariance: ComplexArray) -> ComplexArray:
    """Square root R of a covariance matrix, such that R R^H is the matrix; it may be singular."""
    values, vectors = np.linalg.eigh(covariance)
    return np.asarray(vectors * np.sqrt(np.maximum(values, 0)))

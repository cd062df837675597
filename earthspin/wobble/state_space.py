"""Linear Gaussian models in discrete time: Kalman filter, driven oscillator and autoregression.

A state z obeys z' = A z + n with complex A, and is observed at even steps with an error. The noise
may be unequal and correlated in the real and the imaginary part, which a complex covariance alone
cannot say, so that everything is computed with the real and the imaginary parts side by side:

    z[k + 1] = F z[k] + n[k],   d[k] = H z[k] + e[k],   cov(n) = Q,   cov(e) = R.

Source: Anderson & Moore (1979), Optimal Filtering, sections 3.1 and 6.2; Van Loan (1978), IEEE
Transactions on Automatic Control 23, 395, for F and Q.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from earthspin.numerics.arrays import ComplexArray, FloatArray

# --- Kalman filter, likelihood and autoregression -------------------------------------------------


def side_by_side(matrix: ComplexArray | FloatArray) -> FloatArray:
    """Real matrix that acts like a complex matrix on real parts followed by imaginary parts."""
    return np.block([[matrix.real, -matrix.imag], [matrix.imag, matrix.real]])


@dataclass(frozen=True)
class StateSpace:
    """Linear Gaussian state-space model in discrete time, with real matrices.

    Attributes
    ----------
    transition : array, shape (m, m)
        F, from one step to the next.
    noise : array, shape (m, m)
        Q, covariance of what is added in a step.
    observed : array, shape (k, m)
        H, from the state to what is observed.
    error : array, shape (k, k)
        R, covariance of the errors of observation.
    start : array, shape (m, m)
        Covariance of the state before the first observation; its mean is zero.
    """

    transition: FloatArray
    noise: FloatArray
    observed: FloatArray
    error: FloatArray
    start: FloatArray

    @classmethod
    def sampled(
        cls,
        rates: ComplexArray | FloatArray,
        density: FloatArray,
        observed: ComplexArray | FloatArray,
        error: FloatArray,
        start: FloatArray,
    ) -> StateSpace:
        """Convert a linear model in continuous time to a model with steps of one day.

        A model with real matrices stays as it is: n and 1 replace 2 n and 2 below.

        Parameters
        ----------
        rates : complex or real array, shape (n, n)
            A, 1/d.
        density : array, shape (2 n, 2 n)
            Covariance that the noise adds in a day, real parts before imaginary ones.
        observed : complex or real array, shape (1, n)
        error : array, shape (2, 2)
        start : array, shape (2 n, 2 n)
        """
        from scipy.linalg import expm

        matrix, row = (
            side_by_side(m) if np.iscomplexobj(m) else np.asarray(m, dtype=float)
            for m in (rates, observed)
        )
        size = len(matrix)
        block_matrix = np.block([[-matrix, density], [np.zeros_like(matrix), matrix.T]])
        exponential = expm(block_matrix)
        transition = exponential[size:, size:].T
        noise = transition @ exponential[:size, size:]
        return cls(transition, (noise + noise.T) / 2, row, error, start)

    def every(self, steps: int) -> StateSpace:
        """Return this model with a time step that is longer by a whole factor (`steps`)."""
        transition, noise = self.transition, self.noise
        for _ in range(steps - 1):
            transition = self.transition @ transition
            noise = self.transition @ noise @ self.transition.T + self.noise
        return StateSpace(transition, noise, self.observed, self.error, self.start)

    def propagated(self, covariance: FloatArray) -> FloatArray:
        """Covariance of the state after one more step, from the present covariance."""
        return np.asarray(self.transition @ covariance @ self.transition.T + self.noise)

    def of_observation(self, covariance: FloatArray) -> FloatArray:
        """Covariance of the predicted observation, from the covariance of the state."""
        return np.asarray(self.observed @ covariance @ self.observed.T + self.error)


@dataclass(frozen=True)
class Filter:
    """Kalman filter of a state-space model, with gains computed in advance.

    Attributes
    ----------
    model : StateSpace
    gains : array, shape (n, m, k)
    innovation : array, shape (n, k, k)
        Covariances of the innovations.
    covariance : array, shape (m, m)
        Covariance of the state after the last observation.
    """

    model: StateSpace
    gains: FloatArray
    innovation: FloatArray
    covariance: FloatArray

    @classmethod
    def of(cls, model: StateSpace, count: int, errors: FloatArray | None = None) -> Filter:
        """Build the Kalman filter of a state-space model, with a gain for each observation.

        Parameters
        ----------
        model : StateSpace
        count : int
            Number of observations.
        errors : array, shape (count, k, k), optional
            Covariance of the error of each observation; that of the model by default.
        """
        predicted, updated = model.start, model.start
        gains = np.empty((count, len(predicted), len(model.observed)))
        innovation = np.empty((count, len(model.observed), len(model.observed)))
        for k in range(count):
            cross_covariance = predicted @ model.observed.T
            error = model.error if errors is None else errors[k]
            innovation[k] = model.observed @ cross_covariance + error
            gains[k] = np.linalg.solve(innovation[k], cross_covariance.T).T
            updated = predicted - gains[k] @ cross_covariance.T
            updated = (updated + updated.T) / 2
            predicted = model.propagated(updated)
        return cls(model, gains, innovation, updated)

    def run(self, data: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Filter observations: return the final state and the prediction errors (innovations).

        Parameters
        ----------
        data : array, shape (n, k)
            Observations, one for each gain.

        Returns
        -------
        state : array, shape (m,)
        innovations : array, shape (n, k)
        """
        state, updated = np.zeros(len(self.model.start)), np.zeros(len(self.model.start))
        innovations = np.empty_like(data)
        for k, (gain, row) in enumerate(zip(self.gains, data, strict=True)):
            innovations[k] = row - self.model.observed @ state
            updated = state + gain @ innovations[k]
            state = self.model.transition @ updated
        return updated, innovations

    def minus_twice_log(self, innovations: FloatArray) -> float:
        """Minus twice the logarithm of the likelihood, from the prediction errors of `run`."""
        weighted = np.linalg.solve(self.innovation, innovations[..., None])[..., 0]
        constant = innovations.size * np.log(2 * np.pi)
        determinants = np.linalg.slogdet(self.innovation)[1].sum()
        return float(constant + determinants + np.sum(innovations * weighted))


def burg(x: ComplexArray, order: int) -> ComplexArray:
    """Compute the prediction-error filter 1, a1, ... of a complex series, by Burg's method.

    Forward and backward errors are shortened by reflection coefficients of least mean
    error (Burg 1967; Marple 1987, Digital Spectral Analysis, sect. 8.5).

    Parameters
    ----------
    x : complex array
        Series with mean zero.
    order : int
    """
    forward, backward = x[1:], x[:-1]
    filter_ = np.ones(1, dtype=complex)
    for _ in range(order):
        power = np.vdot(forward, forward).real + np.vdot(backward, backward).real
        reflection = -2 * np.vdot(backward, forward) / power
        padded = np.append(filter_, 0)
        filter_ = padded + reflection * padded[::-1].conj()
        forward, backward = (
            (forward + reflection * backward)[1:],
            (backward + np.conj(reflection) * forward)[:-1],
        )
    return filter_


# --- damped oscillator driven by white and red noise ----------------------------------------------
# Polar motion obeys p' = i s (p - chi). An excitation chi with the correlation time tau adds a
# second mode of rate -1/tau to the free one of rate i s. With z the amplitudes of the two modes,
#
#     z' = L z + n,   p = z1 + z2,   cov(n) = N,   cov(z) = P_ij = -N_ij/(l_i + conj l_j),
#
# and the covariance of p at a lag t > 0 is the sum of g_i exp(l_i t), g = P (1, 1).


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
        slow_share = rates[0] / (rates[0] - rates[1])
        mode_shares = np.array([-slow_share, slow_share])
        noise = 2 / self.memory * self.red * np.outer(mode_shares, mode_shares.conj())
        noise += np.diag([self.white, 2 / self.memory * self.background])
        return np.asarray(-noise / (rates[:, None] + rates.conj()))

    def of_means(self, length: float, reference: float) -> tuple[ComplexArray, ComplexArray]:
        """Factors by which modes change per block, and covariance of block means at lags 0, 1, 2.

        The rotation at the reference frequency is removed first.

        Parameters
        ----------
        length : float
            Length of a block, d.
        reference : float
            rad/d.

        Returns
        -------
        factors : complex array, shape (2,)
            Factors by which the modes change from one block to the next.
        lags : complex array, shape (3,)
            Covariance at lags of none, one and two blocks.
        """
        x = (self.rates - 1j * reference) * length
        mode_covariance, factors = self.covariance.sum(axis=1), np.exp(x)
        lagged = mode_covariance * (np.sinh(x / 2) / (x / 2)) ** 2
        zero_lag = 2 * np.sum(mode_covariance * (np.expm1(x) - x) / x**2).real
        return factors, np.array([zero_lag, lagged @ factors, lagged @ factors**2])

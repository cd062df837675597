"""Linear Gaussian models in discrete time: Kalman filter, likelihood and forecast.

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


def side_by_side(matrix: ComplexArray) -> FloatArray:
    """Real matrix for a complex one, acting on real parts followed by imaginary parts."""
    return np.block([[matrix.real, -matrix.imag], [matrix.imag, matrix.real]])


@dataclass(frozen=True)
class StateSpace:
    """Linear Gaussian model in discrete time.

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
        rates: ComplexArray,
        density: FloatArray,
        observed: ComplexArray,
        error: FloatArray,
        start: FloatArray,
    ) -> StateSpace:
        """Convert a linear model in continuous time to one with steps of a day.

        Parameters
        ----------
        rates : complex array, shape (n, n)
            A, 1/d.
        density : array, shape (2 n, 2 n)
            Covariance that the noise adds in a day, real parts before imaginary ones.
        observed : complex array, shape (1, n)
        error : array, shape (2, 2)
        start : array, shape (2 n, 2 n)
        """
        from scipy.linalg import expm

        matrix = side_by_side(rates)
        size = len(matrix)
        block = np.block([[-matrix, density], [np.zeros_like(matrix), matrix.T]])
        exponential = expm(block)
        transition = exponential[size:, size:].T
        noise = transition @ exponential[:size, size:]
        return cls(transition, (noise + noise.T) / 2, side_by_side(observed), error, start)

    def every(self, steps: int) -> StateSpace:
        """Model whose step is a given number of steps of this model."""
        transition, noise = self.transition, self.noise
        for _ in range(steps - 1):
            transition = self.transition @ transition
            noise = self.transition @ noise @ self.transition.T + self.noise
        return StateSpace(transition, noise, self.observed, self.error, self.start)

    def propagated(self, covariance: FloatArray) -> FloatArray:
        """Covariance of the state one step later."""
        return np.asarray(self.transition @ covariance @ self.transition.T + self.noise)

    def of_observation(self, covariance: FloatArray) -> FloatArray:
        """Covariance of the predicted observation, from the covariance of the state."""
        return np.asarray(self.observed @ covariance @ self.observed.T + self.error)


@dataclass(frozen=True)
class Filter:
    """Kalman filter of a model, with gains computed in advance.

    Attributes
    ----------
    model : StateSpace
    gains : array, shape (n, m, k)
    innovation : array, shape (n, k, k)
        Covariances of the innovations.
    covariance : array, shape (m, m)
        Of the state after the last observation.
    """

    model: StateSpace
    gains: FloatArray
    innovation: FloatArray
    covariance: FloatArray

    @classmethod
    def of(cls, model: StateSpace, count: int) -> Filter:
        """Build the Kalman filter of a model for a number of observations; compute its gains."""
        predicted, after = model.start, model.start
        gains = np.empty((count, len(predicted), len(model.observed)))
        innovation = np.empty((count, len(model.observed), len(model.observed)))
        for k in range(count):
            across = predicted @ model.observed.T
            innovation[k] = model.observed @ across + model.error
            gains[k] = np.linalg.solve(innovation[k], across.T).T
            after = predicted - gains[k] @ across.T
            after = (after + after.T) / 2
            predicted = model.propagated(after)
        return cls(model, gains, innovation, after)

    def run(self, data: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Filter observations: return the final state and the prediction errors (innovations).

        Parameters
        ----------
        data : array, shape (n, k)
            As many observations as there are gains.

        Returns
        -------
        state : array, shape (m,)
        innovations : array, shape (n, k)
        """
        state, after = np.zeros(len(self.model.start)), np.zeros(len(self.model.start))
        innovations = np.empty_like(data)
        for k, (gain, row) in enumerate(zip(self.gains, data, strict=True)):
            innovations[k] = row - self.model.observed @ state
            after = state + gain @ innovations[k]
            state = self.model.transition @ after
        return after, innovations

    def minus_twice_log(self, innovations: FloatArray) -> float:
        """Minus twice the logarithm of the likelihood of the observations, from `run`."""
        weighted = np.linalg.solve(self.innovation, innovations[..., None])[..., 0]
        size = innovations.size * np.log(2 * np.pi)
        determinants = np.linalg.slogdet(self.innovation)[1].sum()
        return float(size + determinants + np.sum(innovations * weighted))

"""Innovations of the Kalman filter of polar motion: their autoregression, and forecast errors.

The innovations (differences of each observation from its prediction) are not white: what the model
of the excitation and the smoothing of the tables leave is correlated over some days. With

    nu[k] = -sum_j a[j] nu[k - j] + e[k],

the error of a forecast h days ahead is sum_j M[j] e[h - j] over 0 <= j < h, where M[j] is the
response of the observed pole to e after j days. Its covariance follows from that of e, which is
estimated in x and y separately, so that the correlation of x and y depends on the horizon.

Source: Anderson & Moore (1979), Optimal Filtering, section 9.1, for the innovations form.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.wobble.burg import burg
from earthspin.wobble.state_space import Filter, side_by_side

#: Order of the autoregression, days from which it is estimated (the noise of the tables changes
#: within years), and days that it extrapolates.
ORDER, FITTED_OVER, EXTRAPOLATED = 20, 730, 40


@dataclass(frozen=True)
class Autoregression:
    """Autoregression of complex innovations, with residuals that are unequal in both coordinates.

    Attributes
    ----------
    coefficients : complex array, shape (ORDER,)
        a[1], a[2] and so on.
    residual : complex
        Last e, mas.
    covariance : array, shape (2, 2)
        Of the real and imaginary part of e, mas squared.
    """

    coefficients: ComplexArray
    residual: complex
    covariance: FloatArray

    @classmethod
    def fitted(cls, innovations: ComplexArray) -> Autoregression:
        """Fit the autoregression to the last days of a series of innovations."""
        last = innovations[-FITTED_OVER:]
        filter_ = burg(last, ORDER)
        residuals = np.convolve(last, filter_, mode="valid")
        parts = np.array([residuals.real, residuals.imag])
        # a fit of so many coefficients leaves too small a residual
        covariance = parts @ parts.T / residuals.size * (1 + ORDER / residuals.size)
        return cls(filter_[1:], complex(residuals[-1]), covariance)

    def extended(self, series: ComplexArray, days: int) -> ComplexArray:
        """Extend a series of innovations by some days, with e = 0."""
        values = list(series[-ORDER:])
        for _ in range(days):
            values.append(-np.dot(self.coefficients, values[: -ORDER - 1 : -1]))
        return np.array(values[ORDER:], dtype=complex)

    def without_error(self, variance: float) -> tuple[complex, FloatArray]:
        """Most probable last e, if the last observation has an error, and its covariance.

        Parameters
        ----------
        variance : float
            Of the error in each coordinate, beyond that of other observations, mas squared.
        """
        share = self.covariance @ np.linalg.inv(self.covariance + variance * np.eye(2))
        real, imaginary = share @ [self.residual.real, self.residual.imag]
        return complex(real, imaginary), self.covariance - share @ self.covariance


def forecast_covariance(
    kalman: Filter, autoregression: Autoregression, last: FloatArray, days: int
) -> FloatArray:
    """Covariance of the forecast, shape (days, 2, 2), real and imaginary part of the pole.

    Parameters
    ----------
    kalman : Filter
    autoregression : Autoregression
        Of its innovations.
    last : array, shape (2, 2)
        Covariance of the last e; zero if the last observation is as good as the others.
    days : int
    """
    start = np.zeros(ORDER, dtype=complex)
    start[-1] = 1
    impulse = np.concatenate([start[-1:], autoregression.extended(start, days)])
    model, gain = kalman.model, kalman.gains[-1]
    response, state = np.empty((days + 1, 2, 2)), np.zeros((len(model.transition), 2))
    for day, value in enumerate(impulse):
        innovation = side_by_side(np.array([[value]]))
        response[day] = model.observed @ state + innovation
        state = model.transition @ (state + gain @ innovation)
    turned = np.swapaxes(response, 1, 2)
    later = np.cumsum(response @ autoregression.covariance @ turned, axis=0)[:-1]
    return np.asarray(later + response[1:] @ last @ turned[1:])

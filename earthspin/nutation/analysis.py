"""Separation of a pole's motion into slow precession and circular nutation terms.

The same least-squares fit is applied to the computed pole and to the IAU pole, so that errors of
the method affect both equally.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from earthspin.constants import ARCSEC, DAYS_PER_CENTURY, EPSILON_0, JULIAN_YEAR
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.nutation.angles import on_fixed_ecliptic, pole_from
from earthspin.nutation.circles import Circles, FrequencyAnalysis

CENTURY = 100 * JULIAN_YEAR


@dataclass(frozen=True)
class Secular:
    """Secular longitude psi and inclination omega of a pole on the ecliptic of J2000.0.

    They are polynomials in Julian centuries from J2000.0.

    Attributes
    ----------
    psi, omega : ndarray, shape (SLOW_DEGREE + 1,)
        Coefficients, rad.
    """

    psi: FloatArray
    omega: FloatArray

    @property
    def psi_rate(self) -> float:
        """Rate of the longitude psi of the mean pole at J2000.0, rad/s."""
        return float(self.psi[1]) / CENTURY

    @property
    def omega_rate(self) -> float:
        """Rate of the inclination omega of the mean pole at J2000.0, rad/s."""
        return float(self.omega[1]) / CENTURY

    def at(self, centuries: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Mean longitude psi and inclination omega, rad, at Julian centuries from J2000.0."""
        powers = centuries[:, np.newaxis] ** np.arange(len(self.psi))
        return powers @ self.psi, powers @ self.omega


class PoleAnalysis:
    """Separate the motion of poles at given times into a secular part and circular terms.

    Parameters
    ----------
    days : ndarray, shape (t,)
        Times, days from J2000.0.
    arguments : ndarray, shape (5, t)
        Delaunay arguments, rad.
    rates : ndarray, shape (5,)
        Their rates at J2000.0, rad/s.
    ecliptic : ndarray, shape (3, 3)
        Rotation from the frame of the poles to the ecliptic and equinox of J2000.0.
    """

    def __init__(
        self, days: FloatArray, arguments: FloatArray, rates: FloatArray, ecliptic: FloatArray
    ) -> None:
        self.ecliptic = ecliptic
        self._least_squares = FrequencyAnalysis(days / DAYS_PER_CENTURY, arguments, rates)
        self._sine = float(np.sin(EPSILON_0.value * ARCSEC))

    def secular(self, pole: FloatArray) -> Secular:
        """Fit the secular longitude psi and inclination omega to pole vectors, shape (t, 3)."""
        psi, omega = on_fixed_ecliptic(pole, self.ecliptic).T
        slow = self._least_squares(psi * self._sine + 1j * omega).slow
        return Secular(slow.real / self._sine, slow.imag.copy())

    def circles(self, eta: ComplexArray) -> Circles:
        """Fit circular terms to the nutation eta = dpsi sin(eps0) + i deps, and return them."""
        return self._least_squares(eta)


def shifted_start(
    start: FloatArray, ours: Secular, wanted: Secular, ecliptic: FloatArray, epoch: float
) -> FloatArray:
    """Correct the initial axis of an integration so that the mean pole follows a wanted motion.

    Parameters
    ----------
    start : ndarray, shape (3,)
        Initial axis of the previous integration.
    ours, wanted : Secular
        Secular motion that `start` led to, and the motion to match.
    ecliptic : ndarray, shape (3, 3)
    epoch : float
        Time of the start, Julian centuries from J2000.0.
    """
    psi, omega = on_fixed_ecliptic(start[np.newaxis], ecliptic)[0]
    our_psi, our_omega = ours.at(np.array([epoch]))
    wanted_psi, wanted_omega = wanted.at(np.array([epoch]))
    pole = pole_from(psi + wanted_psi - our_psi, omega + wanted_omega - our_omega)
    return np.asarray(pole[0] @ ecliptic)

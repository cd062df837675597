"""Free wobble and free core nutation of an elastic mantle with a fluid core.

Liouville's equation of the whole body and Sasao's of its core (Sasao, Okubo & Saito 1980,
IAU Symp. 78, 165; Mathews, Buffett, Herring & Shapiro 1991, JGR 96, 8219), in units of the
spin, in all three axes:

    d/dt (M m + X n) = J (D m - X n)                  M = T + K,  D = E - K
    d/dt (a m + b n) = -f J n                         a = 1 + gamma,  b = 1 + beta,  f = 1 + e_f

m is the wobble of the mantle, n of the core relative to it, J a quarter turn, T and E the
moments and their differences, K what the body's products of inertia answer to a wobble,
X = A_f/A + xi the core's share. It is the system of `earthspin.interior.modes` with the inner
core counted with the fluid, and with three axes. Without three axes and ocean the roots are those
of [s - e + (1+s) kappa][1 + s b + e_f] = (1+s) X s a.

In closed form: with n from the second equation, and because M + D is a multiple of 1, the
odd powers of s cancel, and y = s^2 are the roots of

    (f^2 - b^2 y)(|D| - y |M|) + X a y [(f - b y) tr M + (f - b) tr D] - X^2 a^2 y (1 - y) = 0.

Fifty products a body, in the place of a matrix of four by four and its eigenvalues.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import Array

Numeric = Any


def over(numerator: Numeric, denominator: Numeric) -> Numeric:
    """Quotient of two numbers; infinite if the denominator is zero."""
    with np.errstate(divide="ignore"):
        return np.divide(numerator, denominator)


@dataclass(frozen=True)
class Roots:
    """Complex frequencies of free wobble and free core nutation, in cycles per rotation.

    Attributes
    ----------
    wobble : float or complex array
        s, turns of the wobble per turn of the body; exp(i s Omega t), so Im s > 0 decays.
    core : float or complex array
        The same of the free core nutation, near -1.
    """

    wobble: Array
    core: Array

    @property
    def turns(self) -> Array:
        """Period of the free wobble in rotations of the body."""
        return np.asarray(1 / self.wobble.real)

    @property
    def quality_factor(self) -> Array:
        """Quality factor of the free wobble; infinite without dissipation."""
        loss = self.wobble.imag
        return np.asarray(over(self.wobble.real, 2 * loss))

    @property
    def core_turns_in_space(self) -> Array:
        """Period of the free core nutation in space, in rotations; negative if retrograde."""
        return np.asarray(1 / (1 + self.core.real))


@dataclass(frozen=True)
class Mantle:
    """Coefficients of the mantle's equation of motion; floats or arrays of one shape.

    Attributes
    ----------
    ellipticity : float
        e = (C - (A + B)/2)/((A + B)/2).
    half : float
        (B - A)/(A + B).
    kappa : float or complex
        Products of inertia over (A + B)/2 per radian of wobble.
    ocean : array, shape (..., 2, 2), optional
        The same of the ocean, symmetric.
    """

    ellipticity: Numeric
    half: Numeric
    kappa: Numeric
    ocean: Array | None = None

    def traces_and_determinants(self) -> tuple[Numeric, Numeric, Numeric, Numeric]:
        """Return the traces and determinants of the matrices M and D in the mantle's equation.

        The order is tr M, |M|, tr D, |D|.
        """
        water = np.zeros((2, 2)) if self.ocean is None else self.ocean
        first, second, off = water[..., 0, 0], water[..., 1, 1], water[..., 0, 1]
        m1 = 1 - self.half + self.kappa + first
        m2 = 1 + self.half + self.kappa + second
        d1 = self.ellipticity + self.half - self.kappa - first
        d2 = self.ellipticity - self.half - self.kappa - second
        return m1 + m2, m1 * m2 - off**2, d1 + d2, d1 * d2 - off**2


@dataclass(frozen=True)
class Core:
    """Coefficients of the core's equation of motion; floats or arrays of one shape.

    Attributes
    ----------
    fraction : float
        A_f/A; zero for a body without a core.
    ellipticity : float
        (C_f - A_f)/A_f.
    gamma, beta : float or complex
        How the core yields to the wobble of the mantle and to its own, over A_f.
    xi : float or complex
        How the body yields to the wobble of the core, over A.
    """

    fraction: Numeric
    ellipticity: Numeric
    gamma: Numeric = 0.0
    beta: Numeric = 0.0
    xi: Numeric = 0.0


def solve(mantle: Mantle, core: Core) -> Roots:
    """Solve the equations of mantle and core for the wobble and core nutation frequencies.

    Raises
    ------
    UndefinedError
        If one of the bodies would turn over in the place of wobbling.
    """
    trace_m, det_m, trace_d, det_d = mantle.traces_and_determinants()
    a, b, f = 1 + core.gamma, 1 + core.beta, 1 + core.ellipticity
    pull = (core.fraction + core.xi) * a  # X a
    constant = f**2 * det_d
    linear = pull * (f * trace_m + (f - b) * trace_d - pull) - f**2 * det_m - b**2 * det_d
    square = b**2 * det_m - pull * (b * trace_m - pull)
    # The sum of the larger root first: the smaller one then follows without cancellation.
    larger = -linear + np.sqrt(linear**2 - 4 * constant * square)
    wobble, nutation = 2 * constant / larger, larger / (2 * square)
    if np.any(wobble.real < 0):
        raise UndefinedError(
            "the body yields by more than its bulge about one of its axes: it would turn over, "
            "not wobble; take a body with a larger H or a smaller triaxiality"
        )
    return Roots(wobble=np.asarray(np.sqrt(wobble)), core=np.asarray(-np.sqrt(nutation)))

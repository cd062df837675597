r"""Resonance formula for the transfer function from rigid to non-rigid nutation.

The ratio of the nutation of the real body to that of a rigid one, at frequency sigma in the
rotating frame (in units of the spin; sigma = -1 is at rest in space), is (Mathews, Herring
& Buffett 2002, eq. 42)

    T(\sigma) = (e - \sigma)/(e + 1) [1 + (1 + \sigma) (Q_0 + \sum_a Q_a/(\sigma - s_a))]

with e = H/(1 - H) and the free modes s_a: Chandler wobble, free core nutation, free inner-core
nutation. The strengths Q and the frequency of the free core nutation are *fitted* to the ratio of
IAU 2000A to the computed rigid amplitudes. IAU 2000A is itself such a response times a rigid
series, so the fit recovers its parameters and is not an independent measurement.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from earthspin.constants import DAY, UAS
from earthspin.numerics.arrays import ComplexArray, FloatArray

# --- resonance formula and its fit ----------------------------------------------------------------

#: Chandler wobble and free inner-core nutation, IERS Conventions (2010), table 6.4, in the sign
#: convention of this module, where retrograde is negative. They are not fitted.
CHANDLER_WOBBLE = 0.0026010 - 0.0001361j
INNER_CORE_NUTATION = -0.999026 + 0.000780j
#: Multiples of the only term excluded from the fit, the prograde annual term: IAU 2000A adds 0.11
#: mas from the Sun-synchronous atmospheric tide (Mathews, Herring & Buffett 2002), which is no
#: response of the body.
SUN_SYNCHRONOUS = (0, 1, 0, 0, 0)

#: Initial estimate of the free core nutation (same table).
CORE_NUTATION_START = (-1.0023181, 0.000025)

#: 95 % half-widths of the fitted period of the free core nutation, s, and of its quality factor,
#: relative: twice what was measured against the parameters of IAU 2000A (`interior.named`), after
#: subtracting geodesic nutation and the added terms (`ADDITIONS`): 0.02 d and 0.4 %; with the
#: amplitudes of REN-2000 instead of the computed ones 0.03 d and 0.3 %.
PERIOD_ERROR, QUALITY_ERROR = 0.05 * DAY, 0.008


@dataclass(frozen=True)
class Response:
    """Fitted resonance formula for the ratio of non-rigid to rigid nutation (transfer function).

    Attributes
    ----------
    h : float
        Dynamical flattening.
    spin_rate : float
        rad/s.
    core_nutation : complex
        Body-fixed frequency s of the free core nutation, cycles per rotation.
    strengths : ndarray, shape (4,), complex
        Q_0, and Q of Chandler wobble, free core and inner-core nutation.
    """

    h: float
    spin_rate: float
    core_nutation: complex
    strengths: ComplexArray

    @property
    def period(self) -> float:
        """Period of the free core nutation in space, s; negative if it is retrograde."""
        return float(2 * np.pi / (self.spin_rate * (self.core_nutation.real + 1)))

    @property
    def period_error(self) -> float:
        """95 % half-width of the period of the free core nutation, s."""
        return PERIOD_ERROR

    @property
    def quality_error(self) -> float:
        """95 % half-width of the quality factor of the free core nutation."""
        return QUALITY_ERROR * self.quality

    @property
    def quality(self) -> float:
        """Quality factor of the free core nutation."""
        return float(abs(self.core_nutation.real / (2 * self.core_nutation.imag)))

    def transfer(self, frequency: FloatArray) -> ComplexArray:
        """Transfer function T (non-rigid over rigid nutation) at frequencies in space, rad/s."""
        base, columns = _form(frequency, self.h, self.spin_rate, self.core_nutation)
        return np.asarray(base + columns @ self.strengths)


def added_half_width(response: Response, frequency: FloatArray, rigid: ComplexArray) -> FloatArray:
    """95 % half-width of nutation terms due to the uncertain period of free core nutation, rad.

    Parameters
    ----------
    response : Response
    frequency : ndarray, shape (k,)
        Frequencies in space, rad/s.
    rigid : ndarray, shape (k,), complex
        Rigid amplitudes, rad.
    """
    shifted = 2 * np.pi / (response.spin_rate * (response.period + response.period_error))
    other = replace(response, core_nutation=complex(shifted - 1, response.core_nutation.imag))
    change = other.transfer(frequency) - response.transfer(frequency)
    return np.asarray(np.abs(change * rigid))


def _form(
    frequency: FloatArray, h: float, spin_rate: float, core_nutation: complex
) -> tuple[FloatArray, ComplexArray]:
    """Non-resonant part of the transfer function, and factors of the fitted resonance strengths.

    There is one term for each strength, shape (k, 4).
    """
    in_space = frequency / spin_rate
    sigma = in_space - 1
    e = h / (1 - h)
    base = (e - sigma) / (e + 1)
    modes = (CHANDLER_WOBBLE, core_nutation, INNER_CORE_NUTATION)
    columns = [base * in_space + 0j] + [base * in_space / (sigma - mode) for mode in modes]
    return base, np.stack(columns, axis=-1)


def fit_response(
    frequency: FloatArray, rigid: ComplexArray, real: ComplexArray, h: float, spin_rate: float
) -> Response:
    """Fit a resonance formula to the ratios of non-rigid to rigid amplitudes of nutation terms.

    Free parameters are the resonance strengths, and the frequency of the free core nutation.

    Parameters
    ----------
    frequency : ndarray, shape (k,)
        Frequencies in space, rad/s.
    rigid, real : ndarray, shape (k,), complex
        Rigid and non-rigid amplitudes; the fit minimises real - T rigid.
    h : float
    spin_rate : float
        rad/s.
    """

    def solve(mode: complex) -> tuple[ComplexArray, ComplexArray]:
        base, columns = _form(frequency, h, spin_rate, mode)
        weighted = columns * rigid[:, np.newaxis]
        residual = real - base * rigid
        strengths = np.linalg.lstsq(weighted, residual, rcond=None)[0]
        return np.asarray(strengths), residual - weighted @ strengths

    def misfit(mode: FloatArray) -> FloatArray:
        residual = solve(complex(*mode))[1] / np.max(np.abs(rigid))
        return np.concatenate([residual.real, residual.imag])

    best = least_squares(misfit, CORE_NUTATION_START, x_scale=1e-6, xtol=1e-12, ftol=1e-12)
    mode = complex(*best.x)
    return Response(h, spin_rate, mode, solve(mode)[0])


# --- amplitudes that IAU 2000A adds besides the response ------------------------------------------
# Mathews, Herring & Buffett (2002) multiply a rigid series by a resonance form (above) and add
# a few terms: the Sun-synchronous atmospheric tide in the prograde annual term, second-order
# effects at 18.6 years, and corrections to the form itself, largest near the resonance of the core.
# If a form is fitted to the sum, these terms bias the frequency and the damping of the resonance.
# Source: their paper (JGR 107(B4), 2068), as applied in a public VLBI code (SGDASS, vtd/include,
# series of 2003-12-27): REN-2000 times the resonance form with its corrections,
# mhb2000_addon_heo.i, less the same without, mhb2000_transf_heo.i; geodesic nutation is in neither.

#: Additions of 1 uas or more to the analysed luni-solar terms, in uas: in-phase and, as imaginary
#: part, out-of-phase amplitude in the convention of `analysis.phases`, by the multiples of l, l',
#: F, D and the node, which are negated for the circular term of opposite sense.
ADDITIONS = {
    (0, -1, 0, 0, 0): -86.6 + 107.2j,
    (0, 1, 0, 0, 0): -9.8 + 107.5j,
    (0, 0, 0, 0, -1): -34.3 + 0.9j,
    (0, 0, 2, -2, 2): -22.3 + 23.1j,
    (0, 0, -2, 2, -2): -6.4 + 7.3j,
    (0, 0, 2, 0, 2): 1.0 - 6.4j,
    (0, 0, 0, 0, 1): 3.5 + 0.0j,
    (-1, 0, 0, 0, 0): -2.0 + 2.6j,
    (1, 0, 2, 0, 2): 0.8 - 2.9j,
    (-1, 0, 0, 1, 0): 1.3 - 2.4j,
    (0, 0, 0, 0, 2): -2.1 - 0.1j,
    (0, -1, 0, 0, 1): -1.0 + 1.2j,
    (0, 1, 2, -2, 2): -1.0 + 1.0j,
    (0, 0, -2, 0, -2): -0.7 - 1.0j,
    (0, 0, 2, 0, 1): 0.2 - 1.2j,
    (0, -1, 0, 0, -1): -0.7 + 0.9j,
}


def added_to(multiples: NDArray[np.int64]) -> ComplexArray:
    """Amplitudes of circular terms that IAU 2000A adds to the resonance formula; mostly zero.

    Parameters
    ----------
    multiples : ndarray, shape (k, 5)
        Multiples of the Delaunay arguments.

    Returns
    -------
    ndarray, shape (k,), complex
        Factor of exp(i phi), rad.
    """
    amplitudes = [ADDITIONS.get(tuple(multiple), 0j) for multiple in multiples.tolist()]
    return -1j * UAS * np.array(amplitudes)

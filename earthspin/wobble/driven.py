"""Polar motion driven by a known excitation, fitted to observed polar motion."""

from __future__ import annotations

import numpy as np

from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.wobble.record import known_terms, least_squares
from earthspin.wobble.resonance import polar_motion_from


def fitted_start(time: FloatArray, p: ComplexArray, chi: ComplexArray, s: complex) -> complex:
    """Fit the initial pole position of driven polar motion to observations, by least squares.

    Drift and seasonal terms, which are the least accurate part of excitation models, are fitted at
    the same time and are not part of the result.

    Parameters
    ----------
    time : array, shape (n,)
        Even steps.
    p : complex array, shape (n,)
        Observed, x - i y.
    chi : complex array, shape (n - 1,)
        Means over the steps, in the unit of p.
    s : complex
        As `chandler_frequency` gives it.
    """
    step = float((time[-1] - time[0]) / (time.size - 1))
    left = p - polar_motion_from(chi, step, s)
    free = np.exp(1j * s * (time - time[0]))
    return complex(least_squares(np.column_stack([known_terms(time), free]), left)[-1])

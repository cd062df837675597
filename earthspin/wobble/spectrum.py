"""Prograde and retrograde amplitude spectra of polar motion."""

from __future__ import annotations

import numpy as np

from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.wobble.record import drift_terms, least_squares

#: Points of the spectrum for each one that is independent.
PADDING = 4


def spectrum(time: FloatArray, p: ComplexArray) -> tuple[FloatArray, FloatArray]:
    """Compute the prograde and retrograde amplitude spectra of polar motion.

    Parameters
    ----------
    time : array
        d, evenly spaced.
    p : complex array
        In any unit; a cubic drift is removed and a Hann window applied.

    Returns
    -------
    frequency : array
        Cycles per unit of time, ascending; negative is retrograde.
    amplitude : array
        Of a sinusoid that stands alone, in the unit of p.
    """
    step = (time[-1] - time[0]) / (time.size - 1)
    drift = drift_terms(time)
    rest = p - drift @ least_squares(drift, p)
    taper = np.hanning(time.size)
    padded = PADDING * time.size
    amplitude = abs(np.fft.fftshift(np.fft.fft(rest * taper, padded))) / taper.sum()
    frequency = np.fft.fftshift(np.fft.fftfreq(padded, step))
    return frequency, amplitude

"""Quick fit of the free wobble as a sinusoid of constant amplitude.

A driven wobble is no sinusoid, so this says nothing about the quality factor; its error comes
from the scatter that a driven wobble of a usual quality factor would have.
"""

from __future__ import annotations

import numpy as np

from earthspin.constants import NORMAL_95
from earthspin.errors import UndefinedError
from earthspin.wobble.estimate import WobbleFit
from earthspin.wobble.record import BAND, Array, Complex, in_blocks, known_terms

BLOCK = 30.0  # d
#: Quality factor that stands for the unknown one.
USUAL_Q = 100.0
#: How far the best sinusoid's period scatters beyond the best possible, from simulations: a driven
#: wobble wanders in phase.
EXCESS = 2.4


def fit_least_squares(time: Array, p: Complex) -> WobbleFit:
    """Fit the free wobble as a sinusoid, with drift and seasonal terms, by least squares."""
    span = time[-1] - time[0]
    t, means, _ = in_blocks(time, p, BLOCK)
    columns = np.linalg.qr(known_terms(t))[0]
    rest = means - columns @ (columns.conj().T @ means)

    def explained(period: Array) -> Array:
        """Power in polar motion that a sinusoid of each of the given periods explains.

        Drift and seasonal terms are fitted as well, and not counted.
        """
        waves = np.exp(2j * np.pi * t[:, None] / period)
        waves = waves - columns @ (columns.conj().T @ waves)
        return np.asarray(abs(waves.conj().T @ rest) ** 2 / np.sum(abs(waves) ** 2, axis=0))

    coarse = np.linspace(*BAND, 71)
    centre = coarse[np.argmax(explained(coarse))]
    if centre in BAND:
        raise UndefinedError(
            f"no free wobble: the best sinusoid between {BAND[0]:.0f} and {BAND[1]:.0f} d lies at "
            f"the edge, {centre:.0f} d"
        )
    fine = np.linspace(centre - 1, centre + 1, 41)
    period = float(fine[np.argmax(explained(fine))])
    error = EXCESS * period * np.sqrt(period / (4 * np.pi * USUAL_Q * span))
    return WobbleFit("least-squares", period, float(NORMAL_95 * error))

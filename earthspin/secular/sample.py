"""Random variation of all error sources together, and quantiles of the resulting deviations.

If the phase of precession is uncertain by a large fraction of a turn, a solution with one cause
changed may coincide with the nominal one, so its deviation is no half-width. Then the half-width is
a quantile of the deviations of many solutions, each with all causes drawn independently.

The draws are a rank-1 lattice: member m has cause k at the median of stratum (m A^k + k B) mod N,
of N strata of equal probability. N is prime, so that each cause has one member in each stratum.
A and B were chosen by the scatter of the 95 % quantile of weighted sums of up to seven normal
causes: 6 % (rms) with arbitrary weights, and 1.4 % if one cause dominates, as it does far from the
present.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from earthspin.constants import NORMAL_95
from earthspin.numerics.arrays import FloatArray

#: Members N, a prime, and the numbers A and B of the lattice.
MEMBERS, FACTOR, OFFSET = 61, 36, 57
#: Probability of the half-widths.
PROBABILITY = 0.95


def draws(causes: int) -> FloatArray:
    """Random changes of all error sources in each member, in half-widths, (MEMBERS, causes).

    They are normally distributed, and reproducible.
    """
    from scipy.special import ndtri  # imported here because it takes 0.1 s

    member, cause = np.arange(MEMBERS)[:, np.newaxis], np.arange(causes)
    factors = np.array([pow(FACTOR, int(k), MEMBERS) for k in cause])
    stratum = (member * factors + cause * OFFSET) % MEMBERS
    return np.asarray(ndtri((stratum + 0.5) / MEMBERS) / NORMAL_95)


class Quantiles:
    """Quantiles of the deviations of random solutions, which are added one at a time.

    Only the largest deviations are stored.

    The k-th smallest of N has the probability (k - 1/2)/N, with linear interpolation in between, as
    in numpy's method "hazen".
    """

    def __init__(self) -> None:
        place = PROBABILITY * MEMBERS - 0.5
        self._share = place - math.floor(place)
        self._count = MEMBERS - math.floor(place)
        self._largest: dict[str, FloatArray] = {}

    def add(self, distances: Mapping[str, FloatArray]) -> None:
        """Add the deviations of one random solution from the nominal one, by quantity."""
        for name, distance in distances.items():
            if name not in self._largest:
                self._largest[name] = np.zeros((self._count + 1, *distance.shape))
            # the smallest is first and is replaced
            self._largest[name][0] = np.abs(distance)
            self._largest[name].sort(axis=0)

    def at_probability(self) -> dict[str, FloatArray]:
        """Return the quantile of the deviations of each quantity, for `PROBABILITY`."""
        return {
            name: largest[1] + self._share * (largest[2] - largest[1])
            for name, largest in self._largest.items()
        }

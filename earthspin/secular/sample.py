"""Solutions with all causes of error changed at once, and quantiles over them.

Where the phase of precession is uncertain by a good part of a turn, a solution with one cause
changed may come back to the answer, so that its distance is no half-width. There the half-width is
a quantile of the distances of many solutions, each with every cause drawn anew.

The draws are a lattice of rank 1: member m has cause k in stratum (m A^k + k B) mod N of N strata
of equal probability, at its median. N is prime, so that each cause has one member in each stratum.
A and B were chosen by the scatter of the 95 % quantile of weighted sums of up to seven normal
causes: 6 % (rms) with weights of all kinds, and 1.4 % where one cause outweighs the others, as far
from the present.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import NORMAL_95

FloatArray = NDArray[np.float64]

#: Members N, a prime, and the numbers A and B of the lattice.
MEMBERS, FACTOR, OFFSET = 61, 36, 57
#: Probability of the half-widths.
PROBABILITY = 0.95


def draws(causes: int) -> FloatArray:
    """Half-widths by which each member has each cause changed, shape (MEMBERS, causes)."""
    from scipy.special import ndtri  # 0.1 s, which spans without a sample need not wait for

    member, cause = np.arange(MEMBERS)[:, np.newaxis], np.arange(causes)
    factors = np.array([pow(FACTOR, int(k), MEMBERS) for k in cause])
    stratum = (member * factors + cause * OFFSET) % MEMBERS
    return np.asarray(ndtri((stratum + 0.5) / MEMBERS) / NORMAL_95)


class Quantiles:
    """Quantiles of distances of members that come one after another; the largest alone are stored.

    The k-th smallest of N stands for the probability (k - 1/2)/N, and values in between are
    interpolated, as in numpy's method "hazen".
    """

    def __init__(self) -> None:
        place = PROBABILITY * MEMBERS - 0.5
        self._share = place - math.floor(place)
        self._count = MEMBERS - math.floor(place)
        self._largest: dict[str, FloatArray] = {}

    def add(self, distances: Mapping[str, FloatArray]) -> None:
        """Take the distances of a member by name, each of any shape."""
        for name, distance in distances.items():
            if name not in self._largest:
                self._largest[name] = np.zeros((self._count + 1, *distance.shape))
            # the smallest stands first, and gives way
            self._largest[name][0] = np.abs(distance)
            self._largest[name].sort(axis=0)

    def at_probability(self) -> dict[str, FloatArray]:
        """Quantiles by name, once all members were added."""
        return {
            name: largest[1] + self._share * (largest[2] - largest[1])
            for name, largest in self._largest.items()
        }

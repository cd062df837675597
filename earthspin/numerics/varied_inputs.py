"""Half-widths of quantities from random values of all their inputs together.

Models are not computed for every random sample if each quantity can be interpolated in each input:
the models are computed with one input changed at a time, and the changes are added.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np

from earthspin.constants import NORMAL_95
from earthspin.numerics.arrays import Array, FloatArray
from earthspin.numerics.polynomials import lagrange

#: Probability of the half-widths.
PROBABILITY = 0.95


def half_width(changes: Array, axis: int = 0) -> FloatArray:
    """95 % quantile of the absolute changes over the random samples, along an axis."""
    return np.asarray(np.quantile(np.abs(changes), PROBABILITY, axis=axis))


def normal_medians(strata: Array, count: int) -> FloatArray:
    """Medians of strata of equal probability of a normal distribution, in standard deviations.

    Parameters
    ----------
    strata : ndarray of int
        Numbers of the strata, from 0.
    count : int
        Number of all strata.
    """
    from scipy.special import ndtri  # imported here because it takes 0.1 s

    return np.asarray(ndtri((strata + 0.5) / count))


# --- one input at a time --------------------------------------------------------------------------

#: Nodes of the parabola in a normal input, in standard deviations: those of Gauss's rule of three
#: points, by which mean and variance of a parabola are exact.
NORMAL_NODES = np.array([-np.sqrt(3.0), 0.0, np.sqrt(3.0)])


def one_at_a_time(
    samples: Mapping[str, FloatArray],
    nodes: Mapping[str, FloatArray],
    centre: Mapping[str, float] | None = None,
) -> Iterator[tuple[str, float, FloatArray]]:
    """Yield the inputs to change one at a time, from which changes by random samples follow.

    The change of a quantity in each sample is the sum over the yielded cases of the weight times
    the change that this case alone causes.

    Parameters
    ----------
    samples : mapping of str to ndarray, shape (samples,)
        Random values of each input.
    nodes : mapping of str to ndarray
        Nodes of the interpolation of inputs that are not normally distributed.
    centre : mapping of str to float, optional
        Nominal values of these inputs, if the interpolated change is to be zero there.

    Yields
    ------
    name : str
        Input to change.
    node : float
        Its changed value; in standard deviations from the nominal value for a normal input.
    weight : ndarray, shape (samples,)
    """
    centre = centre or {}
    for name, values in samples.items():
        points = nodes.get(name, NORMAL_NODES)
        weights = lagrange(points, values)
        if name in centre:
            weights -= lagrange(points, np.array([centre[name]]))
        for point, weight in zip(points, weights, strict=True):
            if point != centre.get(name, 0.0):
                yield name, float(point), weight


# --- all inputs together --------------------------------------------------------------------------
# If the changes are too large to be added, the models are computed for every sample.
#
# The draws are a rank-1 lattice: member m has input k at the median of stratum (m A^k + k B) mod N,
# of N strata of equal probability. N is prime, so that each input has one member in each stratum. A
# and B were chosen by the scatter of the 95 % quantile of weighted sums of up to seven normal
# inputs: 6 % (rms) with arbitrary weights, and 1.4 % if one input dominates, as it does for a spin
# axis far from the present.

#: Members N, a prime, and the numbers A and B of the lattice.
MEMBERS, FACTOR, OFFSET = 61, 36, 57


def draws(inputs: int) -> FloatArray:
    """Random changes of all inputs, in units of their half-widths, shape (MEMBERS, inputs).

    They are normally distributed, and reproducible.
    """
    member, number = np.arange(MEMBERS)[:, np.newaxis], np.arange(inputs)
    factors = np.array([pow(FACTOR, int(k), MEMBERS) for k in number])
    return normal_medians((member * factors + number * OFFSET) % MEMBERS, MEMBERS) / NORMAL_95


class Quantiles:
    """Quantile of deviations from a nominal value; random cases are added one at a time.

    Only the largest deviations are stored.

    The k-th smallest of N has the probability (k - 1/2)/N, with linear interpolation in between, as
    in numpy's method "hazen".
    """

    def __init__(self) -> None:
        rank = PROBABILITY * MEMBERS - 0.5
        self._share = rank - math.floor(rank)
        self._count = MEMBERS - math.floor(rank)
        self._largest: dict[str, FloatArray] = {}

    def add(self, deviations: Mapping[str, FloatArray]) -> None:
        """Add the deviations of one random solution from the nominal one, by quantity."""
        for name, deviation in deviations.items():
            if name not in self._largest:
                self._largest[name] = np.zeros((self._count, *deviation.shape))
            remainder = np.abs(deviation)
            for row in self._largest[name]:  # the largest first; faster than to sort them
                previous_row = row.copy()
                np.maximum(row, remainder, out=row)
                remainder = np.fmin(previous_row, remainder)  # NaN counts as the largest

    def at_probability(self) -> dict[str, FloatArray]:
        """Return the quantile at `PROBABILITY` of the deviations of each quantity, by name."""
        return {
            name: largest[-1] + self._share * (largest[-2] - largest[-1])
            for name, largest in self._largest.items()
        }

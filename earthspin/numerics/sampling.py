"""What many samples tell: quantiles, and how much each input has to do with an output.

An input is a number, or a class: one of several that have no order.

Plain numpy; samples lie along the first axis.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def quantiles(samples: FloatArray, shares: FloatArray) -> FloatArray:
    """Quantiles of samples along their first axis, between two samples by a straight line.

    Parameters
    ----------
    samples : ndarray, shape (n, ...)
        Infinite numbers are taken for what they are, and not drawn into straight lines.
    shares : ndarray, shape (q,)
        Of the samples below, 0 to 1.

    Returns
    -------
    ndarray, shape (q, ...)
    """
    ordered = np.sort(samples, axis=0)
    place = shares * (len(samples) - 1)
    below = np.minimum(place.astype(int), max(len(samples) - 2, 0))
    low, high = ordered[below], ordered[np.minimum(below + 1, len(samples) - 1)]
    part = (place - below).reshape(-1, *(1,) * (samples.ndim - 1))
    rise = np.subtract(high, low, out=np.zeros_like(low), where=low != high)
    return np.asarray(low + np.multiply(part, rise, out=np.zeros_like(rise), where=part > 0))


class Shares(NamedTuple):
    """How outputs depend on inputs.

    Attributes
    ----------
    slope : ndarray, shape (k + c, ...)
        Change of the output per unit of each of k numbers, the others held; NaN for c classes.
    share : ndarray, shape (k + c, ...)
        Share of the variance of the output that each input accounts for.
    unexplained : ndarray, shape (...)
        What is left of the variance beside straight lines and means of the classes.
    """

    slope: FloatArray
    share: FloatArray
    unexplained: FloatArray


def columns_of(labels: NDArray[Any]) -> FloatArray:
    """Columns of a class, of 0 and 1, one for each label but the last, shape (n, labels - 1).

    Parameters
    ----------
    labels : ndarray, shape (n,)
        Of each sample.
    """
    return np.asarray(labels[:, np.newaxis] == np.unique(labels)[:-1], dtype=float)


def shares_of_variance(
    inputs: FloatArray, outputs: FloatArray, classes: Sequence[NDArray[Any]] = ()
) -> Shares:
    """Fit outputs by straight lines in all inputs together, and share out their variance.

    The share of input j is b_j cov(x_j, y) / var(y), with the slopes b of the fit. For inputs that
    are independent it is that of the first order; for any inputs the shares and the rest add up to
    1. One of an input that is correlated with others may be negative. That of a class is the sum
    over its columns of 0 and 1: alone, the variance between the means of the classes over the whole
    variance.

    Parameters
    ----------
    inputs : ndarray, shape (n, k)
    outputs : ndarray, shape (n, ...)
        One that does not vary, or is not finite, has nothing to share out: zeros.
    classes : sequence of ndarray, shape (n,)
        Labels of each sample, for each input that is no number.

    Returns
    -------
    Shares
    """
    numbers = inputs.shape[1]
    coded = [columns_of(labels) for labels in classes]
    inputs = np.concatenate([inputs, *coded], axis=1)
    spread = inputs.std(axis=0)
    varies = spread > 0
    scaled = (inputs - inputs.mean(axis=0))[:, varies] / spread[varies]
    flat = outputs.reshape(len(outputs), -1)
    flat = np.where(np.isfinite(flat).all(axis=0), flat, 0.0)
    middle = flat.mean(axis=0)
    size = np.max(np.abs(flat - middle), axis=0)
    moving = size > 4 * np.finfo(float).eps * np.abs(middle)  # more than rounding
    unit = np.where(moving, size, 1.0)
    offset = np.where(moving, flat - middle, 0.0) / unit
    fitted = np.linalg.lstsq(scaled, offset, rcond=None)[0]
    variance = np.where(moving, np.mean(offset**2, axis=0), 1.0)
    share, slope = np.zeros((2, inputs.shape[1], flat.shape[1]))
    share[varies] = fitted * (scaled.T @ offset) / len(flat) / variance
    slope[varies] = fitted * unit / spread[varies, np.newaxis]
    rest = np.where(moving, 1 - share.sum(axis=0), 0.0)
    ends = np.cumsum([numbers, *(of.shape[1] for of in coded)])
    of_classes = [share[first:last].sum(axis=0) for first, last in pairwise(ends)]
    share = np.stack([*share[:numbers], *of_classes])
    slope = np.stack([*slope[:numbers], *(np.full_like(of, np.nan) for of in of_classes)])
    shape = outputs.shape[1:]
    return Shares(slope.reshape(-1, *shape), share.reshape(-1, *shape), rest.reshape(shape))

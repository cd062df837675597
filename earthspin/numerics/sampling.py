"""Statistics of samples: quantiles, and the contribution of each input to the variance.

An input is a number, or a class without order, such as a name. Samples are along the first axis.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.numerics.arrays import FloatArray


def quantiles(samples: FloatArray, shares: FloatArray) -> FloatArray:
    """Quantiles of samples along the first axis, with linear interpolation between samples.

    Parameters
    ----------
    samples : ndarray, shape (n, ...)
        Samples, which may be infinite; equal infinite neighbours give an infinite quantile.
    shares : ndarray, shape (q,)
        Shares of the samples below the quantiles, 0 to 1.

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
    """Linear fit of outputs by inputs: slopes, and contribution of each input to the variance.

    Attributes
    ----------
    slope : ndarray, shape (k + c, ...)
        Change of the output per unit of each of k numbers with the others fixed; NaN for c classes.
    share : ndarray, shape (k + c, ...)
        Share of each input in the variance of the output.
    unexplained : ndarray, shape (...)
        Share of the variance that the linear fit does not explain.
    """

    slope: FloatArray
    share: FloatArray
    unexplained: FloatArray


def columns_of(labels: NDArray[Any]) -> FloatArray:
    """Indicator columns (0 or 1) for the label of each sample; the last label has none.

    The shape is (n, labels - 1).

    Parameters
    ----------
    labels : ndarray, shape (n,)
        Label of each sample.
    """
    return np.asarray(labels[:, np.newaxis] == np.unique(labels)[:-1], dtype=float)


def shares_of_variance(
    inputs: FloatArray, outputs: FloatArray, classes: Sequence[NDArray[Any]] = ()
) -> Shares:
    """Fit outputs by a linear function of all inputs; return slopes and shares of variance.

    The share of input j is b_j cov(x_j, y) / var(y), with the slopes b of the fit. For independent
    inputs it is the first-order sensitivity index. The shares and the unexplained part always have
    the sum 1, and the share of a correlated input may be negative. The share of a class is the sum
    over its columns of 0 and 1; for a single class it is the variance between the class means,
    divided by the total variance.

    Parameters
    ----------
    inputs : ndarray, shape (n, k)
    outputs : ndarray, shape (n, ...)
        Outputs; the shares of a constant or non-finite output are zero.
    classes : sequence of ndarray, shape (n,)
        Labels of the samples, for each input that is a class.

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
    moving = size > 4 * np.finfo(float).eps * np.abs(middle)  # larger than rounding errors
    unit = np.where(moving, size, 1.0)
    offset = np.where(moving, flat - middle, 0.0) / unit
    fitted = np.linalg.lstsq(scaled, offset, rcond=None)[0]
    variance = np.where(moving, np.mean(offset**2, axis=0), 1.0)
    share, slope = np.zeros((2, inputs.shape[1], flat.shape[1]))
    share[varies] = fitted * (scaled.T @ offset) / len(flat) / variance
    slope[varies] = fitted * unit / spread[varies, np.newaxis]
    rest = np.where(moving, 1 - share.sum(axis=0), 0.0)
    ends = np.cumsum([numbers, *(columns.shape[1] for columns in coded)])
    class_shares = [share[first:last].sum(axis=0) for first, last in pairwise(ends)]
    share = np.stack([*share[:numbers], *class_shares])
    slope = np.stack([*slope[:numbers], *(np.full_like(row, np.nan) for row in class_shares)])
    shape = outputs.shape[1:]
    return Shares(slope.reshape(-1, *shape), share.reshape(-1, *shape), rest.reshape(shape))

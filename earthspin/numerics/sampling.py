"""Statistics of samples: quantiles, block means, and contributions of inputs to the variance.

An input is a number, or a class without order, such as a name. Samples are along the first axis.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import NORMAL_95
from earthspin.numerics.arrays import BoolArray, ComplexArray, FloatArray

#: Standard errors by which the correlation of two inputs must differ from zero to be used.
SIGNIFICANT = 4.0


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
    index = np.minimum(place.astype(int), max(len(samples) - 2, 0))
    low, high = ordered[index], ordered[np.minimum(index + 1, len(samples) - 1)]
    share = (place - index).reshape(-1, *(1,) * (samples.ndim - 1))
    rise = np.subtract(high, low, out=np.zeros_like(low), where=low != high)
    return np.asarray(low + np.multiply(share, rise, out=np.zeros_like(rise), where=share > 0))


def block_means(values: Any, size: int) -> Any:
    """Means of consecutive blocks along the first axis; an incomplete last block is dropped."""
    count = len(values) // size
    return values[: count * size].reshape(count, size, *values.shape[1:]).mean(axis=1)


def in_blocks(
    time: FloatArray, p: ComplexArray, length: float
) -> tuple[FloatArray, ComplexArray, float]:
    """Means of times and of values in consecutive blocks, and the block length in units of `time`.

    Blocks have about the given length, in the same unit. A sinusoid stays one and is shortened by
    sinc(block/T).
    """
    step = (time[-1] - time[0]) / (time.size - 1)
    size = max(1, round(length / step))
    return block_means(time, size), block_means(p, size), size * float(step)


class Shares(NamedTuple):
    """Linear fit of outputs to inputs: slopes, and the fraction of variance due to each input.

    Attributes
    ----------
    slope : ndarray, shape (k + c, ...)
        Change of the output per unit of each of k numbers with the others fixed; NaN for c classes.
    share : ndarray, shape (k + c, ...)
        Share of each input in the variance of the output.
    error : ndarray, shape (k + c, ...)
        95 % half-width of each share, from the number of samples, for inputs drawn at random.
    unexplained : ndarray, shape (...)
        Share of the variance that the linear fit does not explain.
    """

    slope: FloatArray
    share: FloatArray
    error: FloatArray
    unexplained: FloatArray


def shares_of_variance(
    inputs: FloatArray, outputs: FloatArray, classes: Sequence[NDArray[Any]] = ()
) -> Shares:
    """Fit outputs by a linear function of inputs; return slopes and each input's share of variance.

    With the slopes b of the fit the explained variance is the sum of b_j b_k cov(x_j, x_k) over all
    pairs of inputs, and the share of input j is the part with that j. A covariance that may be
    chance is left out (`SIGNIFICANT`): otherwise a small share would have an error of the root
    of its product with the largest one, divided by the root of n. For independent inputs a share is
    the square of the standardized slope, the first-order sensitivity index. The shares are scaled
    so that the shares and the unexplained part have the sum 1. The share of a correlated input may
    be negative. The share of a class is the sum over its columns of 0 and 1; for a single class it
    is the variance between the class means, divided by the total variance.

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
    # Indicator columns (0 or 1) for the labels of each class; the last label has none.
    coded = [
        np.asarray(labels[:, np.newaxis] == np.unique(labels)[:-1], dtype=float)
        for labels in classes
    ]
    owner = np.repeat(
        np.arange(numbers + len(coded)), [1] * numbers + [columns.shape[1] for columns in coded]
    )
    inputs = np.concatenate([inputs, *coded], axis=1)
    spread = inputs.std(axis=0)
    varies = spread > 0
    scaled = (inputs - inputs.mean(axis=0))[:, varies] / spread[varies]
    owner_varying = owner[varies]
    flat = outputs.reshape(len(outputs), -1)
    flat = np.where(np.isfinite(flat).all(axis=0), flat, 0.0)
    middle = flat.mean(axis=0)
    size = np.max(np.abs(flat - middle), axis=0)
    moving = size > 4 * np.finfo(float).eps * np.abs(middle)  # larger than rounding errors
    unit = np.where(moving, size, 1.0)
    offset = np.where(moving, flat - middle, 0.0) / unit
    fitted = np.linalg.lstsq(scaled, offset, rcond=None)[0]
    slope = np.full((numbers + len(coded), flat.shape[1]), np.nan)
    slope[:numbers] = 0.0
    slope[np.flatnonzero(varies[:numbers])] = (
        fitted[: varies[:numbers].sum()] * unit / spread[:numbers][varies[:numbers], np.newaxis]
    )
    covariance = scaled.T @ scaled / len(scaled)
    members = np.equal.outer(np.arange(len(slope)), owner_varying)  # columns of each input
    known = np.where(_related(covariance, owner_varying, len(scaled)), covariance, 0.0)
    share, error = np.zeros((2, *slope.shape))
    rest = np.zeros(flat.shape[1])
    for column in np.flatnonzero(moving) if varies.any() else ():
        share[:, column], error[:, column], rest[column] = _shares(
            scaled, offset[:, column], fitted[:, column], covariance, known, members
        )
    if not varies.any():
        rest[moving] = 1.0
    shape = outputs.shape[1:]
    slope, share, error = (array.reshape(-1, *shape) for array in (slope, share, error))
    return Shares(slope, share, error, rest.reshape(shape))


def _related(covariance: FloatArray, owner: NDArray[Any], n: int) -> BoolArray:
    """Matrix that is True for two columns that correlate significantly or belong to one input."""
    correlation = np.clip(np.abs(covariance), 0.0, 1 - 1e-15)
    # Fisher's transformation of a correlation has the standard error 1/sqrt(n - 3)
    significant = np.arctanh(correlation) * np.sqrt(max(n - 3, 0)) > SIGNIFICANT
    return np.asarray(significant | np.equal.outer(owner, owner))


def _shares(
    x: FloatArray,
    y: FloatArray,
    b: FloatArray,
    covariance: FloatArray,
    known: FloatArray,
    members: BoolArray,
) -> tuple[FloatArray, FloatArray, float]:
    """Share of each input in one output's variance, errors of shares, and unexplained share.

    The standard errors follow from the influence of each sample on the shares (infinitesimal
    jackknife). The error of a square, b2, has a second term, without which it would vanish at
    b = 0: |b2 - beta2| <= d (2 |b| + d) if |b - beta| <= d.

    Parameters
    ----------
    x : ndarray, shape (n, k)
        Inputs of zero mean and unit variance.
    y : ndarray, shape (n,)
        Output of zero mean.
    b : ndarray, shape (k,)
        Slopes.
    covariance, known : ndarray, shape (k, k)
        Covariances of the inputs, and those that are used.
    members : ndarray, shape (inputs, k), bool
        Columns of each input.
    """
    n, variance = len(y), float(np.mean(y**2))
    residual = y - x @ b
    rest = float(np.mean(residual**2)) / variance
    column, scale = b * (known @ b), float(b @ known @ b)
    if not scale > 0:
        return np.zeros(len(members)), np.zeros(len(members)), 1.0
    inverse = np.linalg.pinv(covariance)
    # influence of each sample on the slopes, on the parts of the variance, and on their sum
    slopes = (x * residual[:, np.newaxis]) @ inverse
    nonzero = known != 0
    products = b * (x * ((x * b) @ nonzero)) - column
    columns = slopes * (known @ b) + b * (slopes @ known) + products
    parts, changes = members @ column, columns @ members.T
    explained = 1 - rest
    influence = explained * (changes / scale - np.outer(changes.sum(axis=1), parts / scale**2))
    influence -= np.outer((residual**2 - rest * y**2) / variance, parts / scale)
    standard_error = np.sqrt(np.mean(influence**2, axis=0) / n)
    freedom = max(n - 1 - int(np.linalg.matrix_rank(covariance)), 1)
    of_square = members @ (np.diag(inverse) * np.sum(residual**2) / freedom / n) / scale
    half_width = NORMAL_95 * standard_error + NORMAL_95**2 * explained * of_square
    return explained * parts / scale, half_width, rest

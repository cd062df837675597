"""Maximum-likelihood fit of the free wobble: an oscillator driven by white and red noise.

Beside what drives it the record holds a red background, white noise, drift and seasons. With an
excitation that is known (of air, water and ground) its own effect on the pole is taken away
first, with the same period and quality factor, and what is left is driven at random.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
from scipy.linalg import LinAlgError, cholesky_banded, solve_banded
from scipy.optimize import brentq, minimize

from earthspin.constants import NORMAL_95
from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.wobble.oscillator import DrivenOscillator
from earthspin.wobble.record import (
    BAND,
    NEAR,
    YEAR,
    WobbleFit,
    block_means,
    in_blocks,
    known_terms,
    turning,
)
from earthspin.wobble.resonance import polar_motion_from

BLOCK = 120.0  # d
SAMPLE = 10.0  # d, over which a record is averaged before it is turned back
MIDDLE = 2 * np.pi / NEAR

#: Where the search starts: rate, and the logarithms of decay, red, background, white and memory.
START = np.array([0.0, -9.5, -2.0, -3.0, -4.0, np.log(365.0)])
#: What the search takes for a step of one.
UNIT = np.array([1e-4, 1.0, 1.0, 1.0, 1.0, 1.0])
LOWEST = np.array([2 * np.pi / BAND[1] - MIDDLE, -13.5, -6.0, -8.0, -8.0, np.log(60.0)])
HIGHEST = np.array([2 * np.pi / BAND[0] - MIDDLE, -5.0, 4.0, 5.0, 3.0, np.log(4000.0)])
#: Relative steps in the likelihood at which a search ends: for its peak, and for its sides.
FINE, COARSE = 1e-10, 1e-7
#: How near an end of the band is its edge, d.
EDGE = 0.5
#: Minus twice the logarithm of a likelihood that rounding has lost.
IMPOSSIBLE = 1e12


class Likelihood:
    """Likelihood of a record of polar motion: driven wobble, red background and fitted terms.

    Series and columns are turned back by the expected wobble before they are averaged, so
    that the wobble stands nearly still in blocks of months. What is known is integrated
    out (restricted likelihood, Patterson & Thompson 1971, Biometrika 58, 545), the scale of
    all power as well.

    The covariance of the means is a sum of two powers, a^k and b^k, from the first lag on. A mean
    less (a + b) of its last and plus a b of its last but one is then correlated with two
    neighbours alone: the covariance has five diagonals, and the likelihood takes a time in
    proportion to the number of blocks.

    Parameters
    ----------
    time : array, shape (n,)
        d, evenly spaced.
    p : complex array, shape (n,)
    """

    def __init__(self, time: FloatArray, p: ComplexArray) -> None:
        self.terms = self._averaged(time, known_terms(time))
        self.record = self._averaged(time, p[:, None])
        self.span = float(time[-1] - time[0])
        step = self.span / (time.size - 1)
        sample = max(1, round(SAMPLE / step))
        self.size = sample * max(1, round(BLOCK / (sample * step))) * step

    @staticmethod
    def _averaged(time: FloatArray, columns: ComplexArray) -> ComplexArray:
        """Block means of series after removal of the rotation at the expected wobble frequency."""
        t, means, step = in_blocks(time, columns, SAMPLE)
        return np.asarray(
            block_means(means * turning(t, -NEAR)[:, None], max(1, round(BLOCK / step)))
        )

    def data(self, s: complex) -> ComplexArray:
        """Matrix with a column for each term to fit, with the polar motion record as the last."""
        return np.column_stack([self.terms, self.record])

    def __call__(
        self, rate: float, decay: float, red: float, background: float, white: float, memory: float
    ) -> float:
        """Minus twice the logarithm of the likelihood for given parameters of wobble and noise.

        Parameters
        ----------
        rate : float
            Frequency less that of `NEAR`, rad/d.
        decay, red, background, white, memory : float
            Logarithms: of the decay, 1/d; of the red noise that drives the wobble over the
            white, at its frequency; of the variances of background and of white noise in a
            block, over what drives the wobble in a year; of the correlation time of red excitation
            and background, d.
        """
        s, tau = complex(MIDDLE + rate, np.exp(decay)), float(np.exp(memory))
        flat = abs(1j * s.real + 1 / tau) ** 2 / abs(s) ** 2
        oscillator = DrivenOscillator(
            s,
            tau,
            white=1 / YEAR,
            red=float(np.exp(red)) * flat * tau / (2 * YEAR),
            background=float(np.exp(background)),
        )
        factors, lags = oscillator.of_means(self.size, MIDDLE)
        lags[0] += np.exp(white)
        return _minus_twice_log(self.data(s), factors, lags)


class LikelihoodWithExcitation(Likelihood):
    """Likelihood of a driven wobble after the effect of a known excitation is subtracted.

    Where the pole stood at the start is a column more, exp(i s t).

    Parameters
    ----------
    time, p
        As of `Likelihood`.
    chi : complex array, shape (n - 1,)
        Mean excitation of each step, in the unit of p.
    """

    def __init__(self, time: FloatArray, p: ComplexArray, chi: ComplexArray) -> None:
        super().__init__(time, p)
        self.time, self.chi = time, chi
        self.step = float((time[-1] - time[0]) / (time.size - 1))

    def data(self, s: complex) -> ComplexArray:
        """Matrix with a column for each term to fit, with record minus driven pole as the last."""
        start = np.exp(1j * s * (self.time - self.time[0]))
        driven = polar_motion_from(self.chi, self.step, s)
        moving = self._averaged(self.time, np.column_stack([start, driven]))
        return np.column_stack([self.terms, moving[:, :1], self.record - moving[:, 1:]])


def _minus_twice_log(data: ComplexArray, factors: ComplexArray, lags: ComplexArray) -> float:
    """Minus twice the logarithm of the restricted likelihood of the record, the last column.

    A complex number counts as two real ones: the density is that of circular complex noise.

    Parameters
    ----------
    data : complex array, shape (n, k)
    factors : complex array, shape (2,)
        a and b.
    lags : complex array, shape (3,)
        Covariance at lags of none, one and two.
    """
    none, one, two = lags
    first, second = -factors.sum(), factors.prod()
    # Covariance of a shortened mean with the mean itself, the last, and the last but one.
    with_two = two + first * one + second * none
    with_one = one + first * none + second * np.conj(one)
    with_none = none + first * np.conj(one) + second * np.conj(two)
    diagonals = np.zeros((3, len(data)), dtype=complex)
    diagonals[0, :2] = none
    diagonals[0, 2:] = with_none + np.conj(first) * with_one + np.conj(second) * with_two
    diagonals[1, :2] = one, with_one
    diagonals[1, 2:] = with_one + np.conj(first) * with_two
    diagonals[2] = with_two
    try:
        lower = cholesky_banded(diagonals, lower=True, check_finite=False)
    except LinAlgError:
        return IMPOSSIBLE
    short = data.copy()
    short[2:] += first * data[1:-1] + second * data[:-2]
    white = solve_banded((2, 0), lower, short, check_finite=False)
    # The last diagonal element of R is the length of what the columns do not explain.
    triangle = abs(np.diag(np.linalg.qr(white, mode="r")))
    rows, columns = data.shape
    return float(
        4 * (rows - columns + 1) * np.log(triangle[-1])
        + 4 * np.log(lower[0].real).sum()
        + 4 * np.log(triangle[:-1]).sum()
    )


def fit_likelihood(time: FloatArray, p: ComplexArray) -> WobbleFit:
    """Fit the free wobble by maximum likelihood, with 95 % intervals from the profile."""
    return largest(Likelihood(time, p), "likelihood")


def lowest(
    likelihood: Likelihood, start: FloatArray = START, fixed: int | None = None
) -> tuple[FloatArray, float]:
    """Find the parameters of maximum likelihood, and minus twice the logarithm of that maximum.

    Parameters
    ----------
    likelihood : Likelihood
    start : array, shape (6,)
        Where the search starts.
    fixed : int, optional
        Number of a parameter that stays as it is.
    """
    bounds = np.column_stack([LOWEST, HIGHEST])
    if fixed is not None:
        bounds[fixed] = start[fixed]
    best = minimize(
        lambda z: likelihood(*(z * UNIT)),
        start / UNIT,
        method="L-BFGS-B",
        bounds=bounds / UNIT[:, None],
        options={"ftol": FINE if fixed is None else COARSE},
    )
    return best.x * UNIT, float(best.fun)


def largest(likelihood: Likelihood, method: str, widening: float = 1.0) -> WobbleFit:
    """Fit the free wobble at the maximum of a likelihood, with 95 % intervals.

    Parameters
    ----------
    likelihood : Likelihood
    method : str
        Name of the method, for the result.
    widening : float
        Factor by which the intervals are made wider than those of the profile.
    """
    at, least = lowest(likelihood)
    period = 2 * np.pi / (MIDDLE + at[0])
    if min(abs(period - end) for end in BAND) < EDGE:
        raise UndefinedError(
            f"no free wobble: the likelihood is largest at the edge of what is looked through, "
            f"{BAND[0]:.0f} to {BAND[1]:.0f} d"
        )

    # The best possible scatter of the rate is sqrt(decay/span); that of the decay is as large.
    scatter = NORMAL_95 * np.exp(-at[1] / 2) / np.sqrt(likelihood.span)

    def ends(of: int, reach: float) -> tuple[float, float]:
        """Ends of the 95 % interval of one parameter, from the profile of the likelihood."""
        nearby = at.copy()

        def profile(value: float) -> float:
            """Square root of the increase of -2 log(likelihood) if one parameter is fixed."""
            nonlocal nearby
            starts = [nearby.copy(), at.copy()]
            for start in starts:
                start[of] = value
            # the last search may have ended far from this value
            start = min(starts, key=lambda z: likelihood(*z))
            nearby, height = lowest(likelihood, start, fixed=of)
            return float(np.sqrt(max(height - least, 0.0)))

        def side(limit: float) -> float:
            nonlocal nearby
            nearby = at.copy()
            return _risen(profile, float(at[of]), limit, reach, widening * NORMAL_95)

        return side(LOWEST[of]), side(HIGHEST[of])

    slow, fast = (2 * np.pi / (MIDDLE + rate) for rate in ends(0, np.exp(at[1]) * scatter))
    decays = np.exp(ends(1, min(scatter, 1.0)))
    slowest, fastest = decays
    if slowest == np.exp(LOWEST[1]):  # even a wobble without any loss is likely enough
        slowest = 0.0
    with np.errstate(divide="ignore"):
        quality = np.pi / period / np.array([np.exp(at[1]), fastest, slowest])
    best, low, high = map(float, quality)
    return WobbleFit(method, float(period), float((slow - fast) / 2), best, (low, high))


def _risen(
    of: Callable[[float], float], best: float, limit: float, reach: float, target: float
) -> float:
    """Find where a function that increases from zero at `best` reaches a target value.

    If it stays below the target up to `limit`, the limit is returned.
    """

    @cache
    def height(value: float) -> float:
        # A new search at the same value may end at another maximum, so none is repeated; the
        # height at the best value is zero by definition.
        return 0.0 if value == best else of(value)

    room, sign, tolerance = abs(limit - best), np.sign(limit - best), 1e-2 * reach
    near = best
    while reach < room and height(best + sign * reach) < target:
        near = best + sign * reach
        reach *= 2
    far = best + sign * min(reach, room)
    if height(far) <= target:
        return limit
    return float(brentq(lambda v: height(v) - target, near, far, xtol=tolerance))

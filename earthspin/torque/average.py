"""Torques averaged over orbits, for rates and periods of precession.

An unweighted mean over whole periods of the node has an error of 0.1 %, because the perturbers do
not return to their initial positions. A taper that falls smoothly to zero at both ends reduces this
error. The family used here,

    w(t) = cos^(2p)(pi t / L)        p = 0 plain, 1 Hann, 2 "sin4", ...

has spectral zeros at p+1, p+2, ... cycles per window. A window of L = m periods of the slowest
cycle, m > p, therefore removes that cycle and all its harmonics *exactly*, and attenuates higher
frequencies as (frequency)^-(2p+1). For three periods of the node or more, the error with p = 2 is
below 2 mas per century.

The rate refers to the middle of the window; its drift of -2.1 arcsec per century squared does not
affect a symmetric window.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from earthspin.constants import JULIAN_YEAR
from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import FloatArray

# --- windows --------------------------------------------------------------------------------------

#: Blackman-Harris: minimum four-term window, Harris 1978, Proc. IEEE 66, 51, table 1.
_BLACKMAN_HARRIS = (0.35875, 0.48829, 0.14128, 0.01168)

#: Tapers by name: weights as cosine series in 2 pi t/L.
TAPERS: dict[str, tuple[float, ...]] = {
    "plain": (1.0,),
    "hann": (1 / 2, 1 / 2),
    "sin4": (3 / 8, 1 / 2, 1 / 8),
    "blackman-harris": _BLACKMAN_HARRIS,
}

#: Longest window of more than `FEWEST_CYCLES` cycles, s, to limit the effect of the secular drift's
#: curvature (measured with DE440: 0.1 mas/cy over 150 years, 0.6 over 450, 4 over 870).
LONGEST_WINDOW = 150 * JULIAN_YEAR

#: Sine of the obliquity below which the longitude of an axis is undefined.
UPRIGHT = 1e-12

#: Smallest number of cycles in a window; with two, the error of the mean cannot be estimated.
FEWEST_CYCLES = 3


@dataclass(frozen=True)
class Window:
    """Time window for an average: centre, length in cycles, and taper (weight function).

    Attributes
    ----------
    centre : float
        Middle, s.
    cycles : float
        Length in periods of the slowest cycle; a whole number removes that cycle.
    cycle : float
        Period of the slowest cycle, s.
    taper : str
        One of `TAPERS`.
    """

    centre: float
    cycles: float
    cycle: float
    taper: str

    @property
    def length(self) -> float:
        """Length of the time window, s."""
        return self.cycles * self.cycle

    def sample_times(self, step: float) -> FloatArray:
        """Times (s) over the window, evenly spaced by `step` (s)."""
        half = math.floor(self.length / 2 / step)
        return np.asarray(self.centre + step * np.arange(-half, half + 1.0))

    def weights(self, times: FloatArray) -> FloatArray:
        """Weights of the taper at evenly spaced times in the window, with the sum 1.

        Parameters
        ----------
        times : ndarray, shape (n,)
            s. Times outside the window have weight zero.
        """
        x = (times - self.centre) / self.length
        # Both ends of an untapered window have the same phase of the cycle, so each has half
        # weight.
        inside = (np.abs(x) < 0.5) + 0.5 * (np.abs(x) == 0.5)
        cosine = np.cos(2 * np.pi * x)
        w = inside * np.polynomial.chebyshev.chebval(cosine, TAPERS[self.taper])
        return np.asarray(w / np.sum(w))

    def mean(self, times: FloatArray, values: FloatArray) -> FloatArray:
        """Weighted mean over the window of an array whose first axis is time.

        Parameters
        ----------
        times : ndarray, shape (n,)
            Evenly spaced, s.
        values : ndarray, shape (n, ...)
        """
        half = self.length / 2
        first = np.searchsorted(times, self.centre - half)
        last = np.searchsorted(times, self.centre + half, side="right")
        # time last: numpy then sums pairwise, independent of the number of threads
        in_time = np.ascontiguousarray(np.moveaxis(values[first:last], 0, -1))
        return np.asarray(np.sum(self.weights(times[first:last]) * in_time, axis=-1))


def best_window(start: float, end: float, cycle: float) -> Window:
    """Choose the time window whose mean converges fastest: a sin4 taper over whole cycles.

    It is centred on J2000.0 if three cycles fit around it, otherwise on the middle of the span.

    Parameters
    ----------
    start, end : float
        Time span of the data, s from J2000.0.
    cycle : float
        Period of the slowest cycle to remove, s.

    Raises
    ------
    UndefinedError
        If fewer than three cycles are available.
    """
    centre, room = 0.0, 2 * min(-start, end)
    if not room >= FEWEST_CYCLES * cycle:
        centre, room = (start + end) / 2, end - start
    most_turns = max(FEWEST_CYCLES, math.floor(LONGEST_WINDOW / cycle))
    turns = min(math.floor(room / cycle), most_turns)
    if turns < FEWEST_CYCLES:
        raise UndefinedError(
            f"an average over orbits needs three turns of the slowest cycle or orbit, "
            f"{FEWEST_CYCLES * cycle / JULIAN_YEAR:.2f} years; the span has "
            f"{room / JULIAN_YEAR:.2f}; choose a longer span or kernel, like de440, or give an "
            "orbit by elements, like .replace(orbit={'a': '19.2 au', 'about': 'sun'})"
        )
    return Window(centre, turns, cycle, "sin4")


def neighbours(window: Window) -> list[Window]:
    """Return slightly different windows, to estimate the error of a mean by comparison."""
    shorter = window.cycles - 1
    others = [(window.cycles, "hann"), (shorter, "hann")]
    if shorter >= FEWEST_CYCLES:
        others.append((shorter, "sin4"))
    return [Window(window.centre, turns, window.cycle, taper) for turns, taper in others]


def window_mean_and_error(
    window: Window,
    times: FloatArray,
    values: FloatArray,
    slow_swing: FloatArray,
    gm_factors: FloatArray | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Weighted means of each torque and of the sum of all torques, with 95 % half-widths.

    Parameters
    ----------
    window : Window
    times : ndarray, shape (n,)
        Evenly spaced, s.
    values : ndarray, shape (n, perturber, ...)
    slow_swing : ndarray, shape (perturber,)
        Relative variation of each torque on time scales longer than any window, which no comparison
        of windows can detect.
    gm_factors : ndarray, shape (perturber, m), optional
        Factors of the torques in m cases that are otherwise equal. The means are linear in them, so
        each window is computed only once.

    Returns
    -------
    mean, error : ndarray, shape (label, ...) or (label, ..., m)
        The total is last. The error is a 95 % half-width: the
        largest difference from the neighbouring windows and from the same window on every second
        sample, combined with the slow variation.
    """
    if gm_factors is not None:
        return _means_of_many(window, times, values, slow_swing, gm_factors)
    all_values = with_total(values)
    mean = window.mean(times, all_values)
    shape = (-1, *(1,) * (values.ndim - 2))
    others = [w.mean(times, all_values) for w in neighbours(window)]
    others.append(window.mean(times[::2], all_values[::2]))
    spread = np.max(np.abs(np.stack(others) - mean), axis=0)
    size = window.mean(times, np.abs(values))  # the plain mean may vanish by symmetry
    swing = slow_swing.reshape(shape) * size
    return mean, spread + with_total(swing[np.newaxis])[0]


def _means_of_many(
    window: Window,
    times: FloatArray,
    values: FloatArray,
    slow_swing: FloatArray,
    gm_factors: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Mean torques and errors for several cases, in which each torque is scaled by a factor."""
    means = [window.mean(times, values), *(w.mean(times, values) for w in neighbours(window))]
    means.append(window.mean(times[::2], values[::2]))
    factor = gm_factors.reshape(len(gm_factors), *(1,) * (values.ndim - 2), -1)
    scaled = with_total(np.stack(means)[..., np.newaxis] * factor)
    spread = np.max(np.abs(scaled[1:] - scaled[0]), axis=0)
    shape = (-1, *(1,) * (values.ndim - 1))
    size = window.mean(times, np.abs(values))[..., np.newaxis] * np.abs(factor)
    swing = slow_swing.reshape(shape) * size
    return scaled[0], spread + with_total(swing[np.newaxis])[0]


def with_total(values: FloatArray) -> FloatArray:
    """Append the sum over all perturbers as a last element along axis 1."""
    return np.concatenate([values, values.sum(axis=1, keepdims=True)], axis=1)


def convergence_curve(
    window: Window, times: FloatArray, values: FloatArray, cycles: FloatArray
) -> dict[str, FloatArray]:
    """Mean of a time series as a function of the window length, for each taper.

    Parameters
    ----------
    window : Window
        Source of the centre and the cycle.
    times : ndarray, shape (n,)
        Evenly spaced, s.
    values : ndarray, shape (n,)
    cycles : ndarray, shape (m,)
        Lengths in cycles, not necessarily whole.

    Returns
    -------
    dict of str to ndarray, shape (m,)
        By taper.
    """
    return {
        taper: np.array(
            [Window(window.centre, m, window.cycle, taper).mean(times, values) for m in cycles]
        )
        for taper in TAPERS
    }


def precessing_torque(torque: FloatArray, axis: FloatArray, normal: FloatArray) -> FloatArray:
    """Torque component that causes precession in longitude, divided by sine of obliquity.

    It is N . (k x n)/sin2(obliquity) for the torque N.

    Divided by the angular momentum, it is the rate of precession in longitude, positive if the
    longitude of the axis decreases.

    Parameters
    ----------
    torque : ndarray, shape (n, 3)
        N m, or per unit of C - A, s-2.
    axis : ndarray, shape (3,) or (n, 3)
        Unit vector of the spin axis k.
    normal : ndarray, shape (3,) or (n, 3)
        Unit normal n of the orbit, in the frame of the torque.

    Returns
    -------
    ndarray, shape (n,)
        In the unit of the torque.

    Raises
    ------
    UndefinedError
        If the axis is normal to the orbit, so that its longitude is undefined.
    """
    equinox = np.cross(axis, normal)  # towards the equinox, of length sin(obliquity)
    sine_squared = np.sum(equinox * equinox, axis=-1)
    if np.any(sine_squared < UPRIGHT**2):
        raise UndefinedError(
            "the spin axis is normal to the orbit: its longitude and its rate of precession are "
            "not defined"
        )
    return np.asarray(np.sum(torque * equinox, axis=-1) / sine_squared)


# --- Keplerian orbits -----------------------------------------------------------------------------
# The mean over the mean anomaly of an ellipse with semi-major axis a, eccentricity e and normal n
# is
#
#     < r r^T/r^5 > = (I - n n^T) / (2 a^3 (1 - e^2)^(3/2)),
#
# for any pericentre. For a node that precesses uniformly about the pole p of a plane, at the
# inclination i,
#
#     < n n^T > = (sin^2(i)/2) (I - p p^T) + cos^2(i) p p^T.
#
# The mean torque per unit of C - A on an axis k is 3 (Q k) x k, where Q is the mean of GM r
# r^T/r^5. For a circle in the plane of reference it is (3/2) GM/a^3 cos(eps) sin(eps) (`rates`);
# for an inclined orbit with precessing node it is 1 - (3/2) sin^2(i) times that.

#: Bound on the error of a mean in units of its rounding; measured: 0.73 at most, for 2000 orbits
#: against 40-digit arithmetic.
ROUNDINGS = 2


def mean_square_of_normal(pole: FloatArray, inclination: float) -> FloatArray:
    """Tensor n n^T of an orbit normal n, averaged over a period of the node, shape (3, 3).

    Parameters
    ----------
    pole : ndarray, shape (3,)
        Unit vector about which the normal precesses.
    inclination : float
        Angle between the two, rad.
    """
    projector = np.outer(pole, pole)
    perpendicular = math.sin(inclination) ** 2 / 2
    return perpendicular * (np.eye(3) - projector) + math.cos(inclination) ** 2 * projector


def mean_tide(gm: float, a: float, e: float, square: FloatArray) -> FloatArray:
    """Tidal tensor GM r r^T/r^5, averaged over an orbit, s-2, shape (3, 3).

    Parameters
    ----------
    gm : float
        Gravitational parameter of the perturber, m3 s-2.
    a, e : float
        Semi-major axis, m, and eccentricity.
    square : ndarray, shape (3, 3)
        Mean of n n^T.
    """
    size = gm / (2 * a**3 * ((1 - e) * (1 + e)) ** 1.5)
    return np.asarray(size * (np.eye(3) - square))


def mean_torque(tide: FloatArray, axis: FloatArray) -> FloatArray:
    """Mean torque per unit of C - A over an orbit, from the mean tidal tensor, s-2, shape (3,)."""
    return np.asarray(3 * np.cross(tide @ axis, axis))


def rounding(tide: FloatArray) -> float:
    """Bound on the rounding error of each component of a mean torque, s-2."""
    return float(3 * ROUNDINGS * np.finfo(float).eps * np.linalg.norm(tide))

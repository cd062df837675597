r"""Torques averaged over orbits: rates and periods of precession.

A plain mean over whole turns of the node misses by 0.1 per cent, because nothing that pulls
comes back to where it was. A taper that falls smoothly to zero at both ends forgets the
ends. The family used here,

    w(t) = cos^(2p)(pi t / L)        p = 0 plain, 1 Hann, 2 "sin4", ...

has its zeros at p+1, p+2, ... turns per window. A window of L = m turns of the slowest cycle,
m > p, therefore removes that cycle and all its harmonics *exactly*, and everything faster
as (frequency)^-(2p+1). On three turns of the node or more, p = 2 is within 2 mas a century.

The rate refers to the middle of the window; it drifts by -2.1 arcsec per century squared, which a
symmetric window does not see.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import JULIAN_YEAR
from earthspin.errors import UndefinedError

FloatArray = NDArray[np.float64]
Numeric = Any
#: Blackman-Harris: minimum four-term window, Harris 1978, Proc. IEEE 66, 51, table 1.
_BLACKMAN_HARRIS = (0.35875, 0.48829, 0.14128, 0.01168)

#: Tapers by name: weights as cosine series in 2 pi t/L.
TAPERS: dict[str, tuple[float, ...]] = {
    "plain": (1.0,),
    "hann": (1 / 2, 1 / 2),
    "sin4": (3 / 8, 1 / 2, 1 / 8),
    "blackman-harris": _BLACKMAN_HARRIS,
}

#: Beyond this the window would see the curvature of the secular drift (measured with DE440:
#: 0.1 mas/cy over 150 years, 0.6 over 450, 4 over 870).
LONGEST_WINDOW = 150 * JULIAN_YEAR

#: Sine of the obliquity below which an axis has no longitude.
UPRIGHT = 1e-12

#: Fewest cycles that a window may hold: with two, nothing tells how far the mean is off.
FEWEST_CYCLES = 3


@dataclass(frozen=True)
class Window:
    """A stretch of time and the weights that it is averaged with.

    Attributes
    ----------
    centre : float
        Middle, s.
    cycles : float
        Turns of the slowest cycle that it holds; whole ones remove it.
    cycle : float
        Length of one turn, s.
    taper : str
        One of `TAPERS`.
    """

    centre: float
    cycles: float
    cycle: float
    taper: str

    @property
    def length(self) -> float:
        """Length, s."""
        return self.cycles * self.cycle

    def sample_times(self, step: float) -> FloatArray:
        """Times `step` s apart over the window, one of them at its centre, s."""
        half = math.floor(self.length / 2 / step)
        return np.asarray(self.centre + step * np.arange(-half, half + 1.0))

    def weights(self, times: FloatArray) -> FloatArray:
        """Weights of evenly spaced times, adding up to 1.

        Parameters
        ----------
        times : ndarray, shape (n,)
            s. Those outside the window weigh nothing.
        """
        x = (times - self.centre) / self.length
        # The two ends of a plain window are the same phase of the cycle: half weight each.
        inside = (np.abs(x) < 0.5) + 0.5 * (np.abs(x) == 0.5)
        cosine = np.cos(2 * np.pi * x)
        w = inside * np.polynomial.chebyshev.chebval(cosine, TAPERS[self.taper])
        return np.asarray(w / np.sum(w))

    def mean(self, times: FloatArray, values: FloatArray) -> FloatArray:
        """Weighted mean of values over time, their first axis.

        Parameters
        ----------
        times : ndarray, shape (n,)
            Evenly spaced, s.
        values : ndarray, shape (n, ...)
        """
        # time last: numpy then sums pairwise, and the same on any number of threads
        in_time = np.ascontiguousarray(np.moveaxis(values, 0, -1))
        return np.asarray(np.sum(self.weights(times) * in_time, axis=-1))


def best_window(start: float, end: float, cycle: float, epoch: float = 0.0) -> Window:
    """Choose the window that converges fastest on the span there is: sin4 on whole cycles.

    Parameters
    ----------
    start, end : float
        The span that the data allow, s.
    cycle : float
        The slowest cycle to be averaged out, s.
    epoch : float
        Where the middle should be, s; taken if three cycles fit about it, else the middle
        of the span.

    Raises
    ------
    UndefinedError
        If fewer than three cycles are available.
    """
    room = 2 * min(epoch - start, end - epoch)
    centre, room = (
        (epoch, room) if room >= FEWEST_CYCLES * cycle else ((start + end) / 2, end - start)
    )
    turns = math.floor(min(room, LONGEST_WINDOW) / cycle)
    if turns < FEWEST_CYCLES:
        raise UndefinedError(
            f"an average over orbits needs three turns of the slowest cycle, "
            f"{FEWEST_CYCLES * cycle / JULIAN_YEAR:.2f} years; the span has "
            f"{room / JULIAN_YEAR:.2f}, and no more than {LONGEST_WINDOW / JULIAN_YEAR:.0f} are "
            f"used; choose a longer span or kernel"
        )
    return Window(centre, turns, cycle, "sin4")


def neighbours(window: Window) -> list[Window]:
    """List the windows that must agree with the chosen one: other tapers, one turn less."""
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
    measured_error: FloatArray | None = None,
    strength: FloatArray | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Means of several pulls and of their total, and how far each may be from that of all time.

    Parameters
    ----------
    window : Window
    times : ndarray, shape (n,)
        Evenly spaced, s.
    values : ndarray, shape (n, perturber, ...)
    slow_swing : ndarray, shape (perturber,)
        How far each pull swings more slowly than any window, over the pull itself: what
        windows that agree may all miss.
    measured_error : ndarray, shape (perturber,), optional
        Errors of the means as measured for this window and these steps; with them no other window
        is asked.
    strength : ndarray, shape (perturber, m), optional
        Factors of the pulls of m cases that differ in nothing else. Means are linear in them, so
        that each window is taken once.

    Returns
    -------
    mean, error : ndarray, shape (label, ...) or (label, ..., m)
        The total stands last where there are several. The error is a 95 % half-width: the
        largest difference from the neighbouring windows and from the same window on every
        second sample, and the slow swing.
    """
    if strength is not None:
        return _means_of_many(window, times, values, slow_swing, strength)
    all_values = with_total(values)
    mean = window.mean(times, all_values)
    along = (-1, *(1,) * (values.ndim - 2))
    if measured_error is None:
        others = [w.mean(times, all_values) for w in neighbours(window)]
        others.append(window.mean(times[::2], all_values[::2]))
        spread = np.max(np.abs(np.stack(others) - mean), axis=0)
    else:
        spread = with_total(np.broadcast_to(measured_error.reshape(along), values[:1].shape))[0]
    size = window.mean(times, np.abs(values))  # not the mean, which may vanish by symmetry
    swing = slow_swing.reshape(along) * size
    return mean, spread + with_total(swing[np.newaxis])[0]


def _means_of_many(
    window: Window,
    times: FloatArray,
    values: FloatArray,
    slow_swing: FloatArray,
    strength: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """The same as `window_mean_and_error`, for pulls with many strengths, from the means of one."""
    means = [window.mean(times, values), *(w.mean(times, values) for w in neighbours(window))]
    means.append(window.mean(times[::2], values[::2]))
    factor = strength.reshape(len(strength), *(1,) * (values.ndim - 2), -1)
    scaled = with_total(np.stack(means)[..., np.newaxis] * factor)
    spread = np.max(np.abs(scaled[1:] - scaled[0]), axis=0)
    along = (-1, *(1,) * (values.ndim - 1))
    size = window.mean(times, np.abs(values))[..., np.newaxis] * np.abs(factor)
    swing = slow_swing.reshape(along) * size
    return scaled[0], spread + with_total(swing[np.newaxis])[0]


def with_total(values: FloatArray) -> FloatArray:
    """Append the sum over perturbers (axis 1) where there is more than one."""
    if values.shape[1] == 1:
        return values
    return np.concatenate([values, values.sum(axis=1, keepdims=True)], axis=1)


def convergence_curve(
    window: Window, times: FloatArray, values: FloatArray, cycles: FloatArray
) -> dict[str, FloatArray]:
    """Mean through every taper against the length of the window, to see them converge.

    Parameters
    ----------
    window : Window
        Centre and cycle are taken from it.
    times : ndarray, shape (n,)
        Evenly spaced, s.
    values : ndarray, shape (n,)
    cycles : ndarray, shape (m,)
        Lengths, in cycles, whole or not.

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
    """Share of a torque that turns an axis along a fixed orbit: N . (k x n)/sin2(obliquity).

    Divided by the angular momentum it is the rate at which the axis's longitude falls, counted
    positive as the precession in longitude is.

    Parameters
    ----------
    torque : ndarray, shape (n, 3)
        N m, or per unit of C - A, s-2.
    axis : ndarray, shape (3,) or (n, 3)
        Unit vector of the spin axis k.
    normal : ndarray, shape (3,) or (n, 3)
        Unit normal n of the orbit, in the axes of the torque.

    Returns
    -------
    ndarray, shape (n,)
        In the unit of the torque.

    Raises
    ------
    UndefinedError
        If the axis stands on the orbit: it then has no longitude.
    """
    across = np.cross(axis, normal)  # towards the equinox, of length sin(obliquity)
    sine_squared = np.sum(across * across, axis=-1)
    if np.any(sine_squared < UPRIGHT**2):
        raise UndefinedError(
            "the spin axis stands upright on the orbit: it has no longitude, "
            "so a rate of precession is not defined"
        )
    return np.asarray(np.sum(torque * across, axis=-1) / sine_squared)


def precessing_of_tensor(in_plane: Numeric, out_of_plane: Numeric, obliquity: float) -> Numeric:
    """Precessing torque of a mean tidal tensor, or what errors of the tensor do to it, s-2.

    With z along the orbit's normal and x below the spin axis,

        N . (k x n)/sin2(eps) = 3 ((Qxx - Qzz) cos(eps) + Qxz cos(2 eps)/sin(eps))

    Parameters
    ----------
    in_plane, out_of_plane : float or ndarray
        Qxx - Qzz and Qxz, s-2; or bounds on their errors, for a bound.
    obliquity : float
        eps, rad; not 0.
    """
    tilt = abs(math.cos(2 * obliquity)) / math.sin(obliquity)
    return 3 * (in_plane * abs(math.cos(obliquity)) + out_of_plane * tilt)

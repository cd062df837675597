r"""Integrate angular momentum and figure axis over a segment of time windows by Picard iteration.

The axis moves by arcseconds during an orbit of a perturber, so the torque hardly depends on this
motion. Each iteration starts from an estimate of the figure axis F at the nodes of all windows. It
integrates the torque through each window with the spectral integration matrix, joins the windows by
a cumulative sum, and computes F on the slow manifold (`earthspin.motion.figure`). Each iteration
gains two to three digits (Clenshaw & Norton 1963, on Chebyshev nodes). The iteration ends when the
next round would move the axis by less than rounding.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from earthspin.constants import ARCSEC, DAY
from earthspin.errors import UndefinedError
from earthspin.motion.figure import tilt_of_figure
from earthspin.motion.forces import Forces
from earthspin.motion.triaxial import semidiurnal_amplitudes
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.numerics.gauss_windows import Windows, integrated

#: Largest allowed last term of the slow manifold, rad.
LARGEST_MANIFOLD_ERROR = 5e-6 * ARCSEC

_ROUND_OFF = 1e-15  # rad
#: Change of the axis in a round above which the iteration has diverged, rad.
_RUNAWAY = 1e3
#: Number of rough Picard rounds, and terms of the slow manifold in rough and in later rounds.
_ROUGH, _FEW, _ALL = 2, 2, 9


@dataclass(frozen=True)
class Start:
    """Figure axis or angular momentum where a series of time windows starts, and its rate.

    `axis` is a figure axis if `is_figure`, else the angular momentum in units of C Omega. `rate` is
    its estimated rate of change, s-1. The mean rate of the last segment gives a first estimate that
    is ten times better than without.
    """

    axis: FloatArray
    rate: FloatArray
    is_figure: bool

    def momentum_with(self, tilt: FloatArray) -> FloatArray:
        """Angular momentum at the start; `tilt` is added if the initial axis is a figure axis.

        `tilt` is added to the start axis if that axis is a figure axis.
        """
        return self.axis + tilt if self.is_figure else self.axis

    def guess(self, windows: Windows, forward: bool) -> FloatArray:
        """First estimate of the axis at all nodes: initial axis plus rate times time, (3, w, n)."""
        since = windows.times - windows.edges[0 if forward else -1]
        return np.asarray(self.axis[:, None, None] + np.multiply.outer(self.rate, since))


@dataclass(frozen=True)
class Segment:
    """Computed angular momentum and figure axis of a body over consecutive time windows.

    Attributes
    ----------
    windows : Windows
        Windows in s from J2000.0 TDB.
    momentum, tilt : ndarray, shape (3, w, order)
        Legendre coefficients of the angular momentum in units of C Omega, and of angular momentum
        minus figure axis.
    fast : ndarray of complex or None
        Legendre coefficients of the semidiurnal amplitudes; None for an axisymmetric body.
    turn : float
        Upper bound on the motion of the axis, rad.
    tail, floor, left : float
        Errors, rad: from torques between the nodes; from the slow manifold and the semidiurnal
        amplitudes; from the unfinished iteration.
    rounds : int
        Number of Picard rounds.
    """

    windows: Windows
    momentum: FloatArray
    tilt: FloatArray
    fast: ComplexArray | None
    turn: float
    tail: float
    floor: float
    left: float
    rounds: int

    def momentum_at_end(self, forward: bool) -> FloatArray:
        """Angular momentum where the integration leaves this segment, in units of C Omega."""
        if forward:
            return np.asarray(self.momentum[:, -1].sum(axis=-1))
        return np.asarray(self.momentum[:, 0] @ signs(self.momentum.shape[-1]))

    def mean_rate(self) -> FloatArray:
        """Mean rate of the angular momentum (in units of C Omega) over the segment, s-1."""
        change = self.momentum_at_end(True) - self.momentum_at_end(False)
        return np.asarray(change / (self.windows.edges[-1] - self.windows.edges[0]))


def signs(terms: int) -> FloatArray:
    """Values (-1)^n of the Legendre polynomials at -1, by degree n from 0."""
    return np.asarray((-1.0) ** np.arange(terms))


def solve(forces: Forces, windows: Windows, start: Start, forward: bool) -> Segment:
    """Integrate angular momentum and figure axis through the windows of one segment.

    Parameters
    ----------
    forces : Forces
    windows : Windows
        Windows in s from J2000.0 TDB.
    start : Start
    forward : bool
        True if `start` is at the first edge, False if it is at the last edge.

    Raises
    ------
    UndefinedError
        If the axis moves too fast for the iteration, or the body spins too slowly for its figure
        axis to stay near the angular momentum.
    """
    law, tensor = forces.over(windows)
    tau = forces.figure.tau
    axis = momentum = start.guess(windows, forward)
    tilt = np.zeros_like(axis)
    change = left = np.inf
    rounds = 0
    while left > _ROUND_OFF or rounds <= _ROUGH:
        rounds += 1
        rate = law(axis, momentum)
        begin = start.momentum_with(_at_edge(windows, tilt, forward))
        starts, momentum = _chain(windows, rate, begin, forward)
        tilt, terms = tilt_of_figure(windows, axis, rate, tau, _FEW if rounds <= _ROUGH else _ALL)
        new_axis = momentum - tilt
        previous, change = change, float(np.max(np.abs(new_axis - axis)))
        axis, left = new_axis, _remaining_change(change, previous)
        if (rounds > 6 and change > 0.5 * previous) or not change < _RUNAWAY:
            break  # limited by rounding, or diverging: the next statement decides
    if not left < 1e-13:
        raise UndefinedError(
            f"the axis moves too fast for the iteration: after {rounds} rounds it still changes by "
            f"{change:.1g} rad; choose a slower precession or a shorter window"
        )
    _refuse_slow_spin(terms[-1], forces.figure.spin_rate)
    series = windows.coefficients(rate)
    fast = _fast(forces, windows, tensor, axis, tilt)
    return Segment(
        windows=windows,
        momentum=integrated(series, windows.half, starts),
        tilt=windows.coefficients(tilt),
        fast=fast,
        turn=float(np.max(np.abs(rate)) * (windows.edges[-1] - windows.edges[0])),
        tail=_tail(series, windows),
        floor=terms[-1] + _fast_tail(fast),
        left=left,
        rounds=rounds,
    )


def _remaining_change(change: float, previous: float) -> float:
    """Estimated further change of the axis if the Picard iteration were continued, rad.

    The changes are assumed to form a geometric series.
    """
    if not change < previous < np.inf:
        return change
    return change * min(1.0, change / (previous - change))


def _chain(
    windows: Windows, rate: FloatArray, begin: FloatArray, forward: bool
) -> tuple[FloatArray, FloatArray]:
    """Integrate the rate of a vector; return the vector at the window starts and at the nodes."""
    to_nodes, whole = windows.integral(rate)
    if forward:
        starts = begin[:, None] + np.cumsum(whole, axis=1) - whole
    else:
        starts = begin[:, None] - np.cumsum(whole[:, ::-1], axis=1)[:, ::-1]
    return starts, starts[..., None] + to_nodes


def _at_edge(windows: Windows, values: FloatArray, forward: bool) -> FloatArray:
    """Extrapolate a function from the nodes to the time at which the segment starts, (3,)."""
    series = windows.coefficients(values[:, :1] if forward else values[:, -1:])[:, 0]
    return np.asarray(series @ signs(series.shape[-1]) if forward else series.sum(axis=-1))


def _refuse_slow_spin(last_term: float, spin_rate: float) -> None:
    if last_term > LARGEST_MANIFOLD_ERROR:
        days = 2 * np.pi / abs(spin_rate) / DAY
        raise UndefinedError(
            f"a spin of {days:.3g} d is too slow for the figure axis to follow the angular "
            f"momentum (slow manifold off by {last_term / ARCSEC * 1e3:.2g} mas, allowed "
            f"{LARGEST_MANIFOLD_ERROR / ARCSEC * 1e3:.2g}); integrate the full attitude with "
            f"earthspin.rotation, or compute = 'rotation'"
        )


def _fast(
    forces: Forces, windows: Windows, tensor: FloatArray, axis: FloatArray, tilt: FloatArray
) -> ComplexArray | None:
    figure = forces.figure
    if figure.triaxiality == 0:
        return None
    amplitudes = semidiurnal_amplitudes(
        windows, tensor, axis, tilt, figure.triaxiality, figure.spin_rate, figure.tau
    )
    return np.asarray(windows.coefficients(amplitudes))


def _fast_tail(fast: ComplexArray | None) -> float:
    """Truncation error of the semidiurnal amplitudes, from the last terms of their series, rad.

    Two of fourteen terms are too few: at a spin of 1.9 d their sum was half the measured error.
    """
    if fast is None:
        return 0.0
    last = max(1, fast.shape[-1] // 4)
    return float(np.max(np.sum(np.abs(fast[..., -last:]), axis=-1)))


def _tail(series: FloatArray, windows: Windows) -> float:
    """Truncation error of the axis in a time window, from the last Legendre terms of its rate, rad.

    The error at the ends of windows is much smaller, since Gauss's rule is exact to twice the
    degree.
    """
    last = np.max(np.abs(series[..., -2:]), axis=(0, 2))
    return float(np.max(last * windows.half[:, 0]) / (2 * windows.order))

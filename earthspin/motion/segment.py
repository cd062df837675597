r"""A stretch of the angular momentum and the figure axis, by Picard iteration on Gauss windows.

The axis moves by arcseconds while the sky goes round, so that the torque hardly depends on it: from
a guess of the figure axis F at the nodes of all windows, integrate the torque through each window
with the spectral integration matrix, chain the windows by a cumulative sum, take F on the slow
manifold (`earthspin.motion.figure`), and repeat. Each round gains two to three digits (Clenshaw &
Norton 1963, on Chebyshev nodes), by which the rounds end when the next would move the axis by less
than rounding.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import ARCSEC, DAY
from earthspin.errors import UndefinedError
from earthspin.motion.figure import tilt_of_figure
from earthspin.motion.forces import Forces
from earthspin.motion.triaxial import semidiurnal_amplitudes
from earthspin.numerics.gauss_windows import Windows, integrated

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

#: Terms of the slow manifold that do not fall below this are refused, rad.
LARGEST_MANIFOLD_ERROR = 5e-6 * ARCSEC

_ROUND_OFF = 1e-15  # rad
#: A round that moves the axis by more than this has run away: the next ones would overflow, rad.
_RUNAWAY = 1e3
#: Rounds on the slow manifold: a few while the path is but roughly known, then all that help.
_ROUGH, _FEW, _ALL = 2, 2, 9


@dataclass(frozen=True)
class Start:
    """What a segment begins with: the figure axis at the epoch, or the angular momentum.

    The mean rate of the last segment leads ten times nearer to the path than no rate does.
    """

    axis: FloatArray
    rate: FloatArray
    is_figure: bool

    def momentum_with(self, tilt: FloatArray) -> FloatArray:
        """Angular momentum at the start, given how it is tilted from the figure axis."""
        return self.axis + tilt if self.is_figure else self.axis

    def guess(self, windows: Windows, forward: bool) -> FloatArray:
        """Guess of the axis at the nodes of a segment, shape (3, w, n)."""
        since = windows.times - windows.edges[0 if forward else -1]
        return np.asarray(self.axis[:, None, None] + np.multiply.outer(self.rate, since))


@dataclass(frozen=True)
class Segment:
    """A stretch that has been solved.

    Attributes
    ----------
    windows : Windows
        s from J2000.0 TDB.
    momentum, tilt : ndarray, shape (3, w, order)
        Legendre coefficients of angular momentum, in units of C Omega, and of what it is tilted by
        from the figure axis.
    fast : ndarray of complex or None
        Those of the semidiurnal amplitudes; None for a body of revolution.
    turn : float
        By what the axis turned at most, rad.
    tail, floor, left : float
        What may be off, rad: by the sky between the nodes; of the slow manifold and the semidiurnal
        amplitudes; by further rounds.
    rounds : int
        That it took.
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
        """Angular momentum where the next segment joins."""
        if forward:
            return np.asarray(self.momentum[:, -1].sum(axis=-1))
        return np.asarray(self.momentum[:, 0] @ signs(self.momentum.shape[-1]))

    def mean_rate(self) -> FloatArray:
        """Mean rate of the angular momentum, s-1."""
        moved = self.momentum_at_end(True) - self.momentum_at_end(False)
        return np.asarray(moved / (self.windows.edges[-1] - self.windows.edges[0]))


def signs(terms: int) -> FloatArray:
    """Legendre polynomials at -1, where a window begins."""
    return np.asarray((-1.0) ** np.arange(terms))


def solve(forces: Forces, windows: Windows, start: Start, forward: bool) -> Segment:
    """Follow the axis through the windows of one segment.

    Parameters
    ----------
    forces : Forces
    windows : Windows
        s from J2000.0 TDB.
    start : Start
    forward : bool
        Whether it starts where the windows begin, or where they end.

    Raises
    ------
    UndefinedError
        If the axis turns too fast for the iteration, or the body spins too slowly for its figure
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
        moved = momentum - tilt
        previous, change = change, float(np.max(np.abs(moved - axis)))
        axis, left = moved, _left(change, previous)
        if (rounds > 6 and change > 0.5 * previous) or not change < _RUNAWAY:
            break  # at the floor of rounding, or not converging: decided below
    if not left < 1e-13:
        raise UndefinedError(
            f"the axis turns too fast for the iteration: after {rounds} rounds it still moves by "
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


def _left(change: float, previous: float) -> float:
    """What all further rounds would move the axis by, each gaining as much as the last one, rad."""
    if not change < previous < np.inf:
        return change
    return change * min(1.0, change / (previous - change))


def _chain(
    windows: Windows, rate: FloatArray, begin: FloatArray, forward: bool
) -> tuple[FloatArray, FloatArray]:
    """Integrate a rate through all windows: value at each window's start, and at the nodes."""
    to_nodes, whole = windows.integral(rate)
    if forward:
        starts = begin[:, None] + np.cumsum(whole, axis=1) - whole
    else:
        starts = begin[:, None] - np.cumsum(whole[:, ::-1], axis=1)[:, ::-1]
    return starts, starts[..., None] + to_nodes


def _at_edge(windows: Windows, values: FloatArray, forward: bool) -> FloatArray:
    """Value where the segment begins, shape (3,)."""
    series = windows.coefficients(values[:, :1] if forward else values[:, -1:])[:, 0]
    return np.asarray(series @ signs(series.shape[-1]) if forward else series.sum(axis=-1))


def _refuse_slow_spin(last_term: float, spin_rate: float) -> None:
    if last_term > LARGEST_MANIFOLD_ERROR:
        days = 2 * np.pi / abs(spin_rate) / DAY
        raise UndefinedError(
            f"a spin of {days:.3g} d is too slow for the figure axis to follow the angular "
            f"momentum (slow manifold off by {last_term / ARCSEC * 1e3:.2g} mas, allowed "
            f"{LARGEST_MANIFOLD_ERROR / ARCSEC * 1e3:.2g}); ask for the whole attitude instead: "
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
    """What the last quarter of the Legendre terms of the semidiurnal amplitudes comes to, rad.

    Two terms of fourteen are too few: at a spin of 1.9 d they came to half the error measured.
    """
    if fast is None:
        return 0.0
    last = max(1, fast.shape[-1] // 4)
    return float(np.max(np.sum(np.abs(fast[..., -last:]), axis=-1)))


def _tail(series: FloatArray, windows: Windows) -> float:
    """What the last two Legendre terms of the rate displace the axis by inside a window, rad.

    Over whole windows the error is far smaller: Gauss's rule is exact to twice the degree.
    """
    last = np.max(np.abs(series[..., -2:]), axis=(0, 2))
    return float(np.max(last * windows.half[:, 0]) / (2 * windows.order))

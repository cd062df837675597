r"""Paths of the angular momentum, rotation and figure axes in time, by numerical integration.

In units of C Omega, with the figure axis F of an axisymmetric body,

    l' = N(F, t)/(C Omega),     F = l - \tau F x F',     \omega/\Omega = F + F x F'/\Omega

A span is divided into segments in which the axis moves little. Each segment is solved as a whole,
so that time and memory grow linearly with the span. The mean rate of a segment gives the first
estimate of the next.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from earthspin.constants import ARCSEC, DAY, NORMAL_95
from earthspin.errors import UndefinedError
from earthspin.motion.forces import (
    DynamicalFigure,
    Forces,
    equatorial_basis,
    semidiurnal_amplitudes,
    tilt_of_figure,
)
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.numerics.polynomials import Windows, integrated

# --- segments -------------------------------------------------------------------------------------
# The axis moves by arcseconds during an orbit of a perturber, so the torque hardly depends on this
# motion. Each iteration starts from an estimate of the figure axis F at the nodes of all windows.
# It integrates the torque through each window with the spectral integration matrix, joins the
# windows by a cumulative sum, and computes F on the slow manifold (`tilt_of_figure`). Each
# iteration gains two to three digits (Clenshaw & Norton 1963, on Chebyshev nodes). The iteration
# ends when the next round would move the axis by less than rounding.

#: Largest allowed last term of the slow manifold, rad.
LARGEST_MANIFOLD_ERROR = 5e-6 * ARCSEC

_ROUND_OFF = 1e-15  # rad
#: Change of the axis in a round above which the iteration has diverged, rad.
_RUNAWAY = 1e3
#: Number of rough Picard rounds, and terms of the slow manifold in rough and in later rounds.
_ROUGH, _FEW, _ALL = 2, 2, 9


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
    tail : float
        Error from the torque between the nodes, estimated from the last coefficients, rad.
    floor : float
        Error of the slow manifold and of the semidiurnal amplitudes, which more nodes do not
        reduce, rad.
    remaining : float
        Change of the axis that further Picard rounds would still make, rad.
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
    remaining: float
    rounds: int

    def momentum_at_end(self, forward: bool) -> FloatArray:
        """Angular momentum at the segment's last time, or first if not `forward`, unit C Omega."""
        if forward:
            return np.asarray(self.momentum[:, -1].sum(axis=-1))
        return np.asarray(self.momentum[:, 0] @ signs(self.momentum.shape[-1]))

    def mean_rate(self) -> FloatArray:
        """Mean rate of the angular momentum (in units of C Omega) over the segment, s-1."""
        change = self.momentum_at_end(True) - self.momentum_at_end(False)
        return np.asarray(change / (self.windows.edges[-1] - self.windows.edges[0]))


def signs(terms: int) -> FloatArray:
    """Values of the Legendre polynomials P_n at -1, which are (-1)^n, for n = 0, 1, ..."""
    return np.asarray((-1.0) ** np.arange(terms))


def solve(
    forces: Forces,
    windows: Windows,
    start: FloatArray,
    mean_rate: FloatArray,
    *,
    is_figure: bool,
    forward: bool,
) -> Segment:
    """Integrate angular momentum and figure axis over consecutive windows, by Picard iteration.

    Parameters
    ----------
    forces : Forces
    windows : Windows
        Windows in s from J2000.0 TDB.
    start : ndarray, shape (3,)
        Figure axis, or angular momentum in units of C Omega.
    mean_rate : ndarray, shape (3,)
        Estimated rate of change of `start`, s-1. The mean rate of the last segment gives a first
        estimate that is ten times better than without.
    is_figure : bool
        True if `start` is the figure axis, False if it is the angular momentum.
    forward : bool
        True if `start` is at the first edge, False if it is at the last edge.

    Raises
    ------
    UndefinedError
        If the axis moves too fast for the iteration, or the body spins too slowly for its figure
        axis to stay near the angular momentum.
    """
    torque_law, tensor = forces.over(windows)
    tau = forces.figure.tau
    elapsed = windows.times - windows.edges[0 if forward else -1]
    axis = momentum = start[:, None, None] + np.multiply.outer(mean_rate, elapsed)
    tilt = np.zeros_like(axis)
    change = remaining = np.inf
    rounds = 0
    while remaining > _ROUND_OFF or rounds <= _ROUGH:
        rounds += 1
        rate = torque_law(axis, momentum)
        start_momentum = start + _at_edge(windows, tilt, forward) if is_figure else start
        starts, momentum = _chain(windows, rate, start_momentum, forward)
        tilt, terms = tilt_of_figure(windows, axis, rate, tau, _FEW if rounds <= _ROUGH else _ALL)
        new_axis = momentum - tilt
        previous, change = change, float(np.max(np.abs(new_axis - axis)))
        axis, remaining = new_axis, _remaining_change(change, previous)
        if (rounds > 6 and change > 0.5 * previous) or not change < _RUNAWAY:
            break  # limited by rounding, or diverging: the next statement decides
    if not remaining < 1e-13:
        raise UndefinedError(
            f"the axis moves too fast for the iteration: after {rounds} rounds it still changes by "
            f"{change:.1g} rad; choose a slower precession or a shorter window"
        )
    _refuse_slow_spin(terms[-1], forces.figure.spin_rate)
    series = windows.coefficients(rate)
    figure, fast = forces.figure, None
    if figure.triaxiality:
        amplitudes = semidiurnal_amplitudes(windows, tensor, axis, tilt, figure)
        fast = np.asarray(windows.coefficients(amplitudes))
    return Segment(
        windows=windows,
        momentum=integrated(series, windows.half, starts),
        tilt=windows.coefficients(tilt),
        fast=fast,
        turn=float(np.max(np.abs(rate)) * (windows.edges[-1] - windows.edges[0])),
        tail=_tail(series, windows),
        floor=terms[-1] + _fast_tail(fast),
        remaining=remaining,
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
    windows: Windows, rate: FloatArray, start: FloatArray, forward: bool
) -> tuple[FloatArray, FloatArray]:
    """Integrate the rate of a vector; return the vector at the window starts and at the nodes."""
    to_nodes, over_windows = windows.integral(rate)
    if forward:
        starts = start[:, None] + np.cumsum(over_windows, axis=1) - over_windows
    else:
        starts = start[:, None] - np.cumsum(over_windows[:, ::-1], axis=1)[:, ::-1]
    return starts, starts[..., None] + to_nodes


def _at_edge(windows: Windows, values: FloatArray, forward: bool) -> FloatArray:
    """Extrapolate a vector from the nodes to the time where the integration starts, shape (3,)."""
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


def _fast_tail(fast: ComplexArray | None) -> float:
    """Truncation error of the semidiurnal amplitudes, from the last Legendre terms, rad.

    Two of fourteen terms are too few: at a spin of 1.9 d their sum was half the measured error.
    """
    if fast is None:
        return 0.0
    last_terms = max(1, fast.shape[-1] // 4)
    return float(np.max(np.sum(np.abs(fast[..., -last_terms:]), axis=-1)))


def _tail(series: FloatArray, windows: Windows) -> float:
    """Largest truncation error of the axis in any window, from the last Legendre terms, rad.

    The error at the ends of windows is much smaller, since Gauss's rule is exact to twice the
    degree.
    """
    last_terms = np.max(np.abs(series[..., -2:]), axis=(0, 2))
    return float(np.max(last_terms * windows.half[:, 0]) / (2 * windows.order))


# --- paths ----------------------------------------------------------------------------------------

#: Labels of the three axes.
AXES = ("angular_momentum", "rotation", "figure")

WINDOW = 8 * DAY
ORDER = 14
#: Largest number of windows in a segment, so that its arrays stay in the processor's cache, and the
#: largest motion of the axis in it (rad), for which the iteration converges fast.
SEGMENT_WINDOWS = 512
SEGMENT_TURN = 0.2


@dataclass(frozen=True)
class AxisPath:
    """Integrated axes of a body, as Legendre series that give the axes at any time in a span.

    Attributes
    ----------
    windows : Windows
    momentum : ndarray, shape (3, w, n + 1)
        Legendre series of the angular momentum in units of C Omega.
    tilt : ndarray, shape (3, w, n)
        Legendre series of angular momentum minus figure axis, rad.
    fast : ndarray, shape (3, w, n), complex, or None
        Legendre series of the semidiurnal amplitudes of `AXES`, for a triaxial body.
    body : DynamicalFigure
        Flattening, spin rate and meridian of the body.
    interpolation_error : float
        Error from interpolating the torques between nodes, rad.
    floor : float
        Sum of the errors of the slow manifold, of the semidiurnal amplitudes, of the iteration and
        of rounding, rad.
    rounds : int
        Largest number of Picard iterations in a segment.
    """

    windows: Windows
    momentum: FloatArray
    tilt: FloatArray
    fast: ComplexArray | None
    body: DynamicalFigure
    interpolation_error: float
    floor: float
    rounds: int

    @property
    def error(self) -> float:
        """Estimated numerical error of the directions of the axes, as an angle in rad."""
        return self.interpolation_error + self.floor

    @property
    def evaluations(self) -> int:
        """Number of epochs at which positions of the perturbers were evaluated."""
        return int(self.windows.times.size)

    @property
    def span(self) -> tuple[float, float]:
        """First and last time that the path covers, s from J2000.0 TDB."""
        return float(self.windows.edges[0]), float(self.windows.edges[-1])

    def at_starts(self) -> FloatArray:
        """Unit vectors of the angular momentum at the starts of the time windows, shape (w, 3).

        The windows are those of the integration.
        """
        momentum = (self.momentum @ signs(self.momentum.shape[-1])).T
        return np.asarray(momentum / np.linalg.norm(momentum, axis=1, keepdims=True))

    def at(self, times: FloatArray, *, semidiurnal: bool = True) -> dict[str, FloatArray]:
        """Unit vectors of angular momentum, rotation axis and figure axis at given times.

        Parameters
        ----------
        times : ndarray, shape (t,)
            Times in any order within the span, s from J2000.0 TDB.
        semidiurnal : bool
            Include the semidiurnal motion of a triaxial body, which is not part of the celestial
            intermediate pole.

        Returns
        -------
        dict of str to ndarray, shape (t, 3)
            Unit vectors by `AXES`. All point to the side of the figure axis; the angular velocity
            of a retrograde body has the opposite direction.
        """
        momentum = self.windows.evaluate(self.momentum, times)
        tilt = self.windows.evaluate(self.tilt, times)
        figure = momentum - tilt
        axes = np.stack([momentum, figure + tilt / (1 - self.body.h), figure])
        if semidiurnal and self.fast is not None:
            axes += self._fast_at(times, figure)
        axes /= np.sqrt(np.sum(axes * axes, axis=1, keepdims=True))
        return dict(zip(AXES, np.moveaxis(axes, 1, 2), strict=True))

    def _fast_at(self, times: FloatArray, figure: FloatArray) -> FloatArray:
        """Semidiurnal displacements of momentum, rotation and figure axis, rad, shape (3, 3, t)."""
        assert self.fast is not None
        phase = np.exp(2j * (self.body.spin_rate * times + self.body.meridian))
        shift = self.windows.evaluate(self.fast, times) * phase
        towards_x, across_x = equatorial_basis(figure / np.sqrt(np.sum(figure * figure, axis=0)))
        return np.asarray(
            shift.real[:, np.newaxis] * towards_x + shift.imag[:, np.newaxis] * across_x
        )


def axis_path(
    forces: Forces,
    start_axis: FloatArray,
    epoch: float,
    span: tuple[float, float],
    *,
    limits: tuple[float, float] = (-np.inf, np.inf),
    window: float = WINDOW,
    order: int = ORDER,
    advance: Callable[[int], None] | None = None,
) -> AxisPath:
    """Integrate the axes of a body from an epoch to both ends of a time span.

    Parameters
    ----------
    forces : Forces
    start_axis : ndarray, shape (3,)
        Unit vector of the figure axis at the epoch.
    epoch : float
        Epoch, s from J2000.0 TDB.
    span : tuple of float
        First and last time, s; windows extend from the epoch to beyond the span.
    limits : tuple of float
        First and last time with positions, s.
    window : float
        Length of a window, s.
    order : int
        Number of nodes in a window.
    advance : callable, optional
        Function that is called with the number of windows of each solved segment.

    Returns
    -------
    AxisPath

    Raises
    ------
    UndefinedError
        If the body spins too slowly for its axis to stay near the angular momentum.
    """
    segments: list[Segment] = []
    for edges, forward in _directions(epoch, span, limits, window):
        start, mean_rate, solved_windows = start_axis, np.zeros(3), 0
        while solved_windows < len(edges) - 1:
            count = _segment_length(segments, len(edges) - 1 - solved_windows, window)
            windows = Windows(np.sort(edges[solved_windows : solved_windows + count + 1]), order)
            segment = solve(
                forces, windows, start, mean_rate, is_figure=solved_windows == 0, forward=forward
            )
            segments.append(segment)
            start, mean_rate = segment.momentum_at_end(forward), segment.mean_rate()
            solved_windows += count
            if advance is not None:
                advance(count)
    segments.sort(key=lambda segment: segment.windows.edges[0])
    ends = [segment.windows.edges[1:] for segment in segments]
    edges = np.concatenate([segments[0].windows.edges[:1], *ends])
    fast = [s.fast for s in segments if s.fast is not None]
    rounding = np.finfo(float).eps * np.sqrt(len(edges) - 1)
    return AxisPath(
        windows=Windows(edges, order),
        momentum=np.concatenate([s.momentum for s in segments], axis=1),
        tilt=np.concatenate([s.tilt for s in segments], axis=1),
        fast=np.concatenate(fast, axis=1) if fast else None,
        body=forces.figure,
        interpolation_error=max(s.tail for s in segments),
        floor=max(s.floor for s in segments) + sum(s.remaining for s in segments) + float(rounding),
        rounds=max(s.rounds for s in segments),
    )


def window_count(epoch: float, span: tuple[float, float], window: float = WINDOW) -> int:
    """Number of time windows in an integration from an epoch to both ends of a span."""
    forward, backward = (max(0.0, d) for d in (span[1] - epoch, epoch - span[0]))
    return int(np.ceil(forward / window) + np.ceil(backward / window)) or 1


def error_of_input(path: AxisPath, figure: FloatArray, u_h: float) -> FloatArray:
    """95 % half-width of the figure axis's direction due to the uncertainty of H, rad.

    The shape is (t,).

    The displacement of the axis since the epoch is proportional to H.

    Parameters
    ----------
    path : AxisPath
    figure : ndarray, shape (t, 3)
        Figure axis.
    u_h : float
        Relative standard uncertainty of H.
    """
    return np.asarray(NORMAL_95 * u_h * _displacement(path, figure))


def error_of_sky(
    path: AxisPath, figure: FloatArray, drift: float, speed: float, begin: float
) -> FloatArray:
    """95 % half-width of the figure axis direction due to errors of perturber positions, rad.

    The shape is (t,).

    It is proportional to the displacement of the axis, plus a constant for short periods.

    Parameters
    ----------
    path : AxisPath
    figure : ndarray, shape (t, 3)
        Figure axis.
    drift : float
        Relative error of the displacement.
    speed : float
        Speed of the axis, rad/s.
    begin : float
        Time in which the axis moves by the amplitude of the short periods, s.
    """
    return np.asarray(drift * (_displacement(path, figure) + speed * begin))


def _displacement(path: AxisPath, figure: FloatArray) -> FloatArray:
    """Displacement of the figure axis since J2000.0 (or the path's nearest time), rad, (t,)."""
    epoch = np.array([min(max(0.0, path.span[0]), path.span[1])])
    return np.asarray(np.linalg.norm(figure - path.at(epoch)["figure"], axis=1))


def _directions(
    epoch: float, span: tuple[float, float], limits: tuple[float, float], window: float
) -> list[tuple[FloatArray, bool]]:
    """Edges (s) of windows from the epoch to each end of the span, with True if forward in time."""
    directions: list[tuple[FloatArray, bool]] = []
    for end, limit, sign in ((span[1], limits[1], 1.0), (span[0], limits[0], -1.0)):
        count = int(np.ceil(sign * (end - epoch) / window))
        if count > 0:
            edges = np.asarray(epoch + sign * window * np.arange(count + 1.0))
            edges[-1] = sign * min(sign * edges[-1], sign * limit)
            if count > 1 and abs(edges[-1] - edges[-2]) < window / 2:
                # At the end of the positions, two equal windows replace a very short one.
                edges[-2] = (edges[-3] + edges[-1]) / 2
            directions.append((edges, sign > 0))
    if not directions:  # a span that contains only the epoch still needs a window
        forward = epoch + window <= limits[1]
        end = epoch + window if forward else max(epoch - window, limits[0])
        directions.append((np.array([epoch, end]), forward))
    return directions


def _segment_length(segments: list[Segment], remaining: int, window: float) -> int:
    """Number of time windows to integrate together next, limited by the speed of the axis."""
    if not segments:
        return min(remaining, 32)
    last_segment = segments[-1]
    turn_per_window = last_segment.turn / len(last_segment.windows.half)
    turn_limit = SEGMENT_WINDOWS if turn_per_window == 0 else int(SEGMENT_TURN / turn_per_window)
    return max(1, min(remaining, turn_limit, SEGMENT_WINDOWS))

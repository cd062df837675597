r"""Paths of the angular momentum, rotation and figure axes in time, by numerical integration.

In units of C Omega, with the figure axis F of an axisymmetric body,

    l' = N(F, t)/(C Omega),     F = l - \tau F x F',     \omega/\Omega = F + F x F'/\Omega

A span is divided into segments in which the axis moves little. Each segment is solved as a whole
(`earthspin.motion.segment`), so that time and memory grow linearly with the span. The mean rate of
a segment gives the first estimate of the next.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from earthspin.constants import DAY, NORMAL_95
from earthspin.motion.forces import Forces
from earthspin.motion.segment import Segment, Start, signs, solve
from earthspin.motion.triaxial import equatorial_basis
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.numerics.gauss_windows import Windows

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
    """Integrated axes of a body over a time span, which can be evaluated at any time in it.

    Attributes
    ----------
    windows : Windows
    momentum : ndarray, shape (3, w, n + 1)
        Legendre series of the angular momentum in units of C Omega.
    tilt : ndarray, shape (3, w, n)
        Legendre series of angular momentum minus figure axis, rad.
    fast : ndarray, shape (3, w, n), complex, or None
        Legendre series of the semidiurnal amplitudes of `AXES`, for a triaxial body.
    spin_rate : float
        Spin rate, rad/s.
    a_over_c : float
        Equatorial over polar moment of inertia.
    meridian : float
        Angle of the axis of least moment at J2000.0, rad.
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
    spin_rate: float
    a_over_c: float
    meridian: float
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
        axes = np.stack([momentum, figure + tilt / self.a_over_c, figure])
        if semidiurnal and self.fast is not None:
            axes += self._fast_at(times, figure)
        axes /= np.sqrt(np.sum(axes * axes, axis=1, keepdims=True))
        return dict(zip(AXES, np.moveaxis(axes, 1, 2), strict=True))

    def _fast_at(self, times: FloatArray, figure: FloatArray) -> FloatArray:
        """Semidiurnal displacement of the three axes of a triaxial body, shape (3, 3, t)."""
        assert self.fast is not None
        phase = np.exp(2j * (self.spin_rate * times + self.meridian))
        move = self.windows.evaluate(self.fast, times) * phase
        first, second = equatorial_basis(figure / np.sqrt(np.sum(figure * figure, axis=0)))
        return np.asarray(move.real[:, np.newaxis] * first + move.imag[:, np.newaxis] * second)


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
    figure = forces.figure
    segments: list[Segment] = []
    for edges, forward in _directions(epoch, span, limits, window):
        start = Start(start_axis, np.zeros(3), is_figure=True)
        first = 0
        while first < len(edges) - 1:
            count = _segment_length(segments, len(edges) - 1 - first, window)
            part = edges[first : first + count + 1]
            segment = solve(forces, Windows(np.sort(part), order), start, forward)
            segments.append(segment)
            start = Start(segment.momentum_at_end(forward), segment.mean_rate(), is_figure=False)
            first += count
            if advance is not None:
                advance(count)
    segments.sort(key=lambda segment: segment.windows.edges[0])
    pieces = [segment.windows.edges[1:] for segment in segments]
    edges = np.concatenate([segments[0].windows.edges[:1], *pieces])
    return AxisPath(
        windows=Windows(edges, order),
        momentum=np.concatenate([s.momentum for s in segments], axis=1),
        tilt=np.concatenate([s.tilt for s in segments], axis=1),
        fast=_concatenated([s.fast for s in segments if s.fast is not None]),
        spin_rate=figure.spin_rate,
        a_over_c=1 - figure.h,
        meridian=figure.meridian,
        interpolation_error=max(s.tail for s in segments),
        floor=max(s.floor for s in segments) + sum(s.left for s in segments) + _rounding(segments),
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
    """Angle between the figure axis at given times and at the epoch, rad, shape (t,)."""
    epoch = np.array([min(max(0.0, path.span[0]), path.span[1])])
    return np.asarray(np.linalg.norm(figure - path.at(epoch)["figure"], axis=1))


def _directions(
    epoch: float, span: tuple[float, float], limits: tuple[float, float], window: float
) -> list[tuple[FloatArray, bool]]:
    """Edges of the time windows from the epoch forward, and from the epoch backward.

    True marks the forward ones.
    """
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
    # A span that contains only the epoch still needs a window.
    return directions or [_one_window(epoch, limits, window)]


def _one_window(
    epoch: float, limits: tuple[float, float], window: float
) -> tuple[FloatArray, bool]:
    if epoch + window <= limits[1]:
        return np.array([epoch, epoch + window]), True
    return np.array([epoch, max(epoch - window, limits[0])]), False


def _segment_length(segments: list[Segment], left: int, window: float) -> int:
    """Number of time windows to integrate together next, limited by the speed of the axis."""
    if not segments:
        return min(left, 32)
    last = segments[-1]
    per_window = last.turn / len(last.windows.half)
    allowed = SEGMENT_WINDOWS if per_window == 0 else int(SEGMENT_TURN / per_window)
    return max(1, min(left, allowed, SEGMENT_WINDOWS))


def _concatenated(pieces: list[ComplexArray]) -> ComplexArray | None:
    return np.concatenate(pieces, axis=1) if pieces else None


def _rounding(segments: list[Segment]) -> float:
    """Rounding error of the integrated axes, rad, from the number of time windows."""
    return float(np.finfo(float).eps * np.sqrt(sum(len(s.windows.half) for s in segments)))

r"""Angular-momentum, rotation and figure axes in time, segment by segment.

In units of C Omega, with the figure axis F of an axisymmetric body,

    l' = N(F, t)/(C Omega),     F = l - \tau F x F',     \omega/\Omega = F + F x F'/\Omega

Spans are cut into segments in which the axis turns little, each of which is solved at once
(`earthspin.motion.segment`), so that time and memory grow linearly with the span; the mean rate of
a segment leads the guess of the next.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import DAY, NORMAL_95
from earthspin.motion.forces import Forces
from earthspin.motion.segment import Segment, Start, signs, solve
from earthspin.motion.triaxial import equatorial_basis
from earthspin.numerics.gauss_windows import Windows

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

#: Labels of the three axes.
AXES = ("angular_momentum", "rotation", "figure")

WINDOW = 8 * DAY
ORDER = 14
#: A segment has so many windows at most (its arrays stay in the processor's cache), and in it
#: the axis turns by so much at most (rad), that the iteration converges fast.
SEGMENT_WINDOWS = 512
SEGMENT_TURN = 0.2


@dataclass(frozen=True)
class AxisPath:
    """The axes of a body over a span, to be asked at any time in it.

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
        rad/s.
    a_over_c : float
    meridian : float
        Angle of the axis of least moment at J2000.0, rad.
    interpolation_error : float
        What the sky between the nodes may displace the axes by, rad.
    floor : float
        What is left of the slow manifold, of the semidiurnal amplitudes and of the iteration, and
        rounding, rad.
    rounds : int
        Most Picard iterations that a segment took.
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
        """Estimated error of the method, rad."""
        return self.interpolation_error + self.floor

    @property
    def evaluations(self) -> int:
        """How many epochs the sky was evaluated at."""
        return int(self.windows.times.size)

    @property
    def span(self) -> tuple[float, float]:
        """First and last time, s."""
        return float(self.windows.edges[0]), float(self.windows.edges[-1])

    def at_starts(self) -> FloatArray:
        """Unit vectors of the angular momentum where each window begins, shape (w, 3)."""
        found = (self.momentum @ signs(self.momentum.shape[-1])).T
        return np.asarray(found / np.linalg.norm(found, axis=1, keepdims=True))

    def at(self, times: FloatArray, *, semidiurnal: bool = True) -> dict[str, FloatArray]:
        """Unit vectors of the three axes.

        Parameters
        ----------
        times : ndarray, shape (t,)
            s from J2000.0 TDB, in any order, within the span.
        semidiurnal : bool
            Without it, the motion of a triaxial body at half a day is left out, as it is in
            the celestial intermediate pole.

        Returns
        -------
        dict of str to ndarray, shape (t, 3)
            By `AXES`. All point to the side of the figure axis; the spin of a retrograde body
            points the other way.
        """
        momentum = self.windows.evaluate(self.momentum, times)
        tilt = self.windows.evaluate(self.tilt, times)
        figure = momentum - tilt
        found = np.stack([momentum, figure + tilt / self.a_over_c, figure])
        if semidiurnal and self.fast is not None:
            found += self._fast_at(times, figure)
        found /= np.sqrt(np.sum(found * found, axis=1, keepdims=True))
        return dict(zip(AXES, np.moveaxis(found, 1, 2), strict=True))

    def _fast_at(self, times: FloatArray, figure: FloatArray) -> FloatArray:
        """Semidiurnal displacement of the three axes, shape (3, 3, t)."""
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
    """Follow the axes of a body from an epoch to a span, before or after it.

    Parameters
    ----------
    forces : Forces
    start_axis : ndarray, shape (3,)
        Unit vector of the figure axis at the epoch.
    epoch : float
        s from J2000.0 TDB.
    span : tuple of float
        First and last time wanted, s; windows reach from the epoch to beyond it.
    limits : tuple of float
        Times that the sky is known for, s.
    window : float
        Length of a window, s.
    order : int
        Nodes in a window.
    advance : callable, optional
        Told how many windows are done.

    Returns
    -------
    AxisPath

    Raises
    ------
    UndefinedError
        If the body spins too slowly for its axis to stay near the angular momentum.
    """
    figure = forces.figure
    done: list[Segment] = []
    for edges, forward in _directions(epoch, span, limits, window):
        here = Start(start_axis, np.zeros(3), is_figure=True)
        first = 0
        while first < len(edges) - 1:
            count = _segment_length(done, len(edges) - 1 - first, window)
            part = edges[first : first + count + 1]
            segment = solve(forces, Windows(np.sort(part), order), here, forward)
            done.append(segment)
            here = Start(segment.momentum_at_end(forward), segment.mean_rate(), is_figure=False)
            first += count
            if advance is not None:
                advance(count)
    done.sort(key=lambda segment: segment.windows.edges[0])
    edges = np.concatenate([done[0].windows.edges[:1], *(s.windows.edges[1:] for s in done)])
    return AxisPath(
        windows=Windows(edges, order),
        momentum=np.concatenate([s.momentum for s in done], axis=1),
        tilt=np.concatenate([s.tilt for s in done], axis=1),
        fast=_joined([s.fast for s in done if s.fast is not None]),
        spin_rate=figure.spin_rate,
        a_over_c=1 - figure.h,
        meridian=figure.meridian,
        interpolation_error=max(s.tail for s in done),
        floor=max(s.floor for s in done) + sum(s.left for s in done) + _rounding(done),
        rounds=max(s.rounds for s in done),
    )


def window_count(epoch: float, span: tuple[float, float], window: float = WINDOW) -> int:
    """How many windows lead from an epoch to a span, both in s."""
    forward, backward = (max(0.0, d) for d in (span[1] - epoch, epoch - span[0]))
    return int(np.ceil(forward / window) + np.ceil(backward / window)) or 1


def error_of_input(path: AxisPath, figure: FloatArray, u_h: float) -> FloatArray:
    """95 % half-width of a direction from the uncertainty of H, rad, shape (t,).

    Whatever the axis has moved since the epoch grows with H.

    Parameters
    ----------
    path : AxisPath
    figure : ndarray, shape (t, 3)
        Figure axis.
    u_h : float
        Relative standard uncertainty of H.
    """
    return np.asarray(NORMAL_95 * u_h * _swept(path, figure))


def error_of_sky(
    path: AxisPath, figure: FloatArray, drift: float, speed: float, begin: float
) -> FloatArray:
    """95 % half-width of a direction from where the sky may be off, rad, shape (t,).

    It grows with what the axis has swept, from what short periods add at once.

    Parameters
    ----------
    path : AxisPath
    figure : ndarray, shape (t, 3)
        Figure axis.
    drift : float
        By what the pull may turn the axis aside, over the angle that it sweeps.
    speed : float
        At which the axis sweeps, rad/s.
    begin : float
        Time in which it sweeps as much as short periods add, s.
    """
    return np.asarray(drift * (_swept(path, figure) + speed * begin))


def _swept(path: AxisPath, figure: FloatArray) -> FloatArray:
    """Angle between a figure axis and that of the epoch, rad, shape (t,)."""
    epoch = np.array([min(max(0.0, path.span[0]), path.span[1])])
    return np.asarray(np.linalg.norm(figure - path.at(epoch)["figure"], axis=1))


def _directions(
    epoch: float, span: tuple[float, float], limits: tuple[float, float], window: float
) -> list[tuple[FloatArray, bool]]:
    """Edges of windows from the epoch outward, and whether they lead forward."""
    found: list[tuple[FloatArray, bool]] = []
    for end, limit, sign in ((span[1], limits[1], 1.0), (span[0], limits[0], -1.0)):
        count = int(np.ceil(sign * (end - epoch) / window))
        if count > 0:
            edges = np.asarray(epoch + sign * window * np.arange(count + 1.0))
            edges[-1] = sign * min(sign * edges[-1], sign * limit)
            if count > 1 and abs(edges[-1] - edges[-2]) < window / 2:
                # where the sky ends, two equal windows instead of a sliver
                edges[-2] = (edges[-3] + edges[-1]) / 2
            found.append((edges, sign > 0))
    # A span that is nothing but the epoch still needs a window.
    return found or [_one_window(epoch, limits, window)]


def _one_window(
    epoch: float, limits: tuple[float, float], window: float
) -> tuple[FloatArray, bool]:
    if epoch + window <= limits[1]:
        return np.array([epoch, epoch + window]), True
    return np.array([epoch, max(epoch - window, limits[0])]), False


def _segment_length(done: list[Segment], left: int, window: float) -> int:
    """How many windows to take next: few at first, to learn how fast the axis turns."""
    if not done:
        return min(left, 32)
    last = done[-1]
    per_window = last.turn / len(last.windows.half)
    allowed = SEGMENT_WINDOWS if per_window == 0 else int(SEGMENT_TURN / per_window)
    return max(1, min(left, allowed, SEGMENT_WINDOWS))


def _joined(pieces: list[ComplexArray]) -> ComplexArray | None:
    return np.concatenate(pieces, axis=1) if pieces else None


def _rounding(segments: list[Segment]) -> float:
    """What rounding adds, rad: it grows with the number of windows as a random walk does."""
    return float(np.finfo(float).eps * np.sqrt(sum(len(s.windows.half) for s in segments)))

r"""One axis over millions of years, by Newton's method in time.

About a fixed axis N near the mean normal of the orbit, a spin axis s has a longitude phi and a
height Z = s.N. Both are polynomials in windows of twenty thousand years, through values at
Gauss-Legendre nodes; the equation is to hold at every node of every window at once (collocation).
Newton's method solves that for all windows of a block together: what a step asks of a window is
linear in where the window starts, so a product of two-by-two matrices carries it from one to the
next.

phi turns once in 26,000 years and Z hardly moves, so plain iteration (Picard) diverges over a
million years, while Newton's method, started from uniform precession, settles in a few steps.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from earthspin.errors import UndefinedError
from earthspin.numerics.gauss_windows import Windows, integrated, rule
from earthspin.secular.orbit import Orbit, Pull, pull, reference_axes
from earthspin.secular.strength import Strength

FloatArray = NDArray[np.float64]

#: Nodes in a window of the orbit.
ORDER = 16
#: Windows solved at once: a million years.
BLOCK = 50
#: When a block is solved, rad: a step of Newton's method from there is expected to change it by
#: less, by the share that sweeps leave or that by which the last step was less than the one before.
SETTLED = 1e-9
MOST_STEPS, DIVERGES = 25, 10.0
#: Sweeps that solve a window's linear equations, until they change it by less than this share.
MOST_SWEEPS, SWEPT = 40, 1e-3
#: Height above which longitude about an axis is of no use: 8 degrees from it.
TOO_NEAR = 0.99


@dataclass(frozen=True)
class Trajectory:
    """A spin axis in time, as polynomials.

    Attributes
    ----------
    windows : Windows
        s from J2000.0 TDB.
    coefficients : ndarray, shape (2, w, n + 1)
        Legendre coefficients of longitude and height about `axes`.
    axes : ndarray, shape (3, 3)
        Rows: two directions across the reference axis, and that axis.
    steps : int
        Newton steps that all blocks took.
    """

    windows: Windows
    coefficients: FloatArray
    axes: FloatArray
    steps: int

    def at(self, times: FloatArray) -> FloatArray:
        """Unit vectors of the axis, shape (3, n), at times in s."""
        phi, z = self.windows.evaluate(self.coefficients, np.asarray(times, dtype=float))
        across = np.sqrt(1 - z * z)
        return np.asarray(self.axes.T @ [across * np.cos(phi), across * np.sin(phi), z])


def solve(
    strength: Strength,
    orbit: Orbit,
    start: FloatArray,
    span: tuple[float, float],
    order: int = ORDER,
    pieces: int = 1,
) -> Trajectory:
    """Follow a spin axis from J2000.0 both ways.

    Parameters
    ----------
    strength : Strength
    orbit : Orbit
    start : ndarray, shape (3,)
        Unit vector of the axis at J2000.0, GCRS.
    span : tuple of float
        First and last time that will be asked for, s; J2000.0 need not lie between.
    order : int
        Nodes in a window.
    pieces : int
        Into how many windows each of the orbit's is cut.

    Raises
    ------
    UndefinedError
        If Newton's method does not settle.
    """
    axes = _axes(orbit, start, span)
    state = np.array([np.arctan2(axes[1] @ start, axes[0] @ start), axes[2] @ start])
    way = _Way(strength, orbit, axes, order)
    past, future = (way.run(edges, state) for edges in _edges(orbit.edges, span, pieces))
    # the past was followed from J2000.0 backwards: put it in order again
    turned = past[1][:, ::-1] * (-1.0) ** np.arange(order + 1)
    windows = Windows(np.concatenate([past[0][::-1], future[0][1:]]), order)
    return Trajectory(windows, np.concatenate([turned, future[1]], axis=1), axes, way.steps)


def _edges(edges: FloatArray, span: tuple[float, float], pieces: int) -> list[FloatArray]:
    """Windows from J2000.0 back to before the span, and on to after it."""
    middle = int(np.searchsorted(edges, 0.0))
    first = int(np.searchsorted(edges, min(span[0], 0.0), side="right")) - 1
    last = int(np.searchsorted(edges, max(span[1], 0.0)))
    if first == last:  # J2000.0 alone: some window it must be
        first, last = max(first - 1, 0), min(last + 1, len(edges) - 1)
    past, future = edges[max(first, 0) : middle + 1], edges[middle : last + 1]
    return [_cut(past[::-1], pieces), _cut(future, pieces)]


def _cut(edges: FloatArray, pieces: int) -> FloatArray:
    if pieces == 1:
        return edges
    fine = edges[:-1, np.newaxis] + np.diff(edges)[:, np.newaxis] * np.arange(pieces) / pieces
    return np.append(fine.ravel(), edges[-1])


def _axes(orbit: Orbit, start: FloatArray, span: tuple[float, float]) -> FloatArray:
    """Axes about the mean normal, or across it where the spin axis is too near to that."""
    times = np.linspace(min(span[0], 0.0), max(span[1], 0.0), 101)
    first, second, normal = reference_axes(np.mean(orbit.at(times)[0], axis=1))
    if abs(normal @ start) < TOO_NEAR:
        return np.stack([first, second, normal])
    return np.stack([normal, first, second])


class _Way:
    """Windows one after another in one direction of time, in blocks."""

    def __init__(self, strength: Strength, orbit: Orbit, axes: FloatArray, order: int) -> None:
        self.strength, self.orbit, self.axes, self.order = strength, orbit, axes, order
        self.steps = 0
        self.height: float | None = None

    def run(self, edges: FloatArray, state: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Edges, and Legendre coefficients of longitude and height, shape (2, w, order + 1)."""
        found = [np.empty((2, 0, self.order + 1))]
        first, size = 0, BLOCK
        while first < len(edges) - 1:
            windows = Windows(edges[first : first + size + 1], self.order)
            settled = self._block(windows, state)
            if settled is None and size == 1:
                raise UndefinedError(
                    "the axis cannot be followed: Newton's method in time does not settle; it may "
                    "pass through the reference axis, or precess too fast for the orbit's windows"
                )
            if settled is None:
                size = max(size // 4, 1)
                continue
            series, state = settled
            found.append(series)
            first += len(windows.half)
        return edges, np.concatenate(found, axis=1)

    def _block(self, windows: Windows, state: FloatArray) -> tuple[FloatArray, FloatArray] | None:
        """Series of a block and its end, or nothing if Newton's method does not settle."""
        times = windows.times.ravel()
        on = pull(self.strength, self.orbit.at(times), times)
        on = Pull(
            *(
                (self.axes @ of if of.ndim > 1 else of).reshape(-1, *windows.times.shape)
                for of in on
            )
        )
        values, before = self._at_one_height(windows, on, state), 1.0
        for _ in range(MOST_STEPS):
            self.steps += 1
            values, change = _newton(windows, on, values, state)
            if not (change < DIVERGES and np.max(np.abs(values[1])) < 1):
                return None
            before, expected = change, change * max(change / before, SWEPT)
            if expected < SETTLED:
                self.height = float(np.mean(values[1]))
                slope, _ = _slope(on, values[0], values[1])
                _, starts, end = _moved(windows, slope, state)
                return integrated(windows.coefficients(slope), windows.half, starts), end
        return None

    def _at_one_height(self, windows: Windows, on: Pull, state: FloatArray) -> FloatArray:
        """Precession at the height of the start, or the mean one so far: a first guess."""
        phi, z = state[0], state[1] if self.height is None else self.height
        rate = on.geodesic[2] - on.constant[0] * z * on.axis[2] ** 2
        inside, across = windows.integral(rate)
        before = np.append(0.0, np.cumsum(across)[:-1])
        return np.stack([phi + before[:, np.newaxis] + inside, np.full_like(inside, z)])


def _moved(
    windows: Windows, slope: FloatArray, state: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Integrals from the start of each window to its nodes; where windows start, and the last ends.

    Of shape (2, w, n), (2, w) and (2,).
    """
    inside, across = windows.integral(slope)
    ends = state[:, np.newaxis] + np.cumsum(across, axis=1)
    return inside, np.concatenate([state[:, np.newaxis], ends[:, :-1]], axis=1), ends[:, -1]


def _newton(
    windows: Windows, on: Pull, values: FloatArray, state: FloatArray
) -> tuple[FloatArray, float]:
    """One step of Newton's method: new values at the nodes, and the largest change, or infinity.

    With S the integral from the start of a window to its nodes, the values y of a window that
    starts at b solve y = b + S f(y). Linearised about what there is, the change is d = c + S J d,
    with the defect c for the start as it was; a start that moves adds what S J makes of a unit
    step.
    """
    slope, jacobian = _slope(on, values[0], values[1])
    moved, starts, _ = _moved(windows, slope, state)
    sides = np.zeros((2, 3, *values.shape[1:]))
    sides[:, 0] = starts[..., np.newaxis] + moved - values
    sides[0, 1] = sides[1, 2] = 1.0
    solved = _linear(windows, jacobian, sides)
    if solved is None:
        return values, np.inf
    change, ends = solved
    shifts = _scan(ends)[:, :-1, np.newaxis]
    total = change[:, 0] + change[:, 1] * shifts[0] + change[:, 2] * shifts[1]
    return values + total, float(np.max(np.abs(total)))


def _linear(
    windows: Windows, jacobian: FloatArray, sides: FloatArray
) -> tuple[FloatArray, FloatArray] | None:
    """Solve d = c + S J d in every window for several c at once, shape (2, k, w, n); and its end.

    Height first, then longitude with it: what turns longitude into height is small, so that a
    sweep leaves little of the error. None if sweeps do not settle.
    """
    gauss = rule(windows.order)
    (j00, j01), (j10, j11) = jacobian * windows.half
    phi, z = sides
    for _ in range(MOST_SWEEPS):
        before = phi
        z = sides[1] + (j10 * phi + j11 * z) @ gauss.integrate
        phi = sides[0] + (j00 * phi + j01 * z) @ gauss.integrate
        if np.max(np.abs(phi - before)) < SWEPT * np.max(np.abs(phi)):
            slopes = j00 * phi + j01 * z, j10 * phi + j11 * z
            return np.stack([phi, z]), np.stack([of @ gauss.weights for of in slopes])
    return None


def _scan(ends: FloatArray) -> FloatArray:
    """How far each window's start moves, shape (2, w + 1), from what a window does to its end.

    Parameters
    ----------
    ends : ndarray, shape (2, 3, w)
        Change between start and end by the defect, and by unit steps of either component at the
        start.
    """
    shifts = np.zeros((2, ends.shape[2] + 1))
    phi = z = 0.0
    for window, ((d0, d00, d01), (d1, d10, d11)) in enumerate(np.moveaxis(ends, 2, 0).tolist()):
        phi, z = phi + d0 + d00 * phi + d01 * z, z + d1 + d10 * phi + d11 * z
        shifts[:, window + 1] = phi, z
    return shifts


def _slope(on: Pull, phi: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Rates of longitude and height, shape (2, ...), and their derivatives, shape (2, 2, ...).

    With the turn W = g n - a (m.s) m of s: Z' = (W x s)_3 and phi' = W_3 - (Z/rho) W_rho, where
    rho is the distance of s from the reference axis and W_rho the part of W towards s.
    """
    cosine, sine = np.cos(phi), np.sin(phi)
    rho = np.sqrt(1 - z * z)
    slant = z / rho
    m1, m2, m3 = on.axis
    m_towards, m_beside = m1 * cosine + m2 * sine, m1 * sine - m2 * cosine
    height = rho * m_towards + z * m3  # m.s
    by_phi, by_z = -rho * m_beside, m3 - slant * m_towards
    a, (g1, g2, g3) = on.constant[0], on.geodesic
    towards = g1 * cosine + g2 * sine - a * height * m_towards
    beside = g1 * sine - g2 * cosine - a * height * m_beside
    slope = np.stack([g3 - a * height * m3 - slant * towards, rho * beside])
    jacobian = np.empty((2, 2, *phi.shape))
    jacobian[0, 0] = a * by_phi * (slant * m_towards - m3) + slant * beside
    jacobian[0, 1] = a * by_z * (slant * m_towards - m3) - towards / rho**3
    jacobian[1, 0] = rho * (towards - a * by_phi * m_beside)
    jacobian[1, 1] = -slant * beside - a * by_z * rho * m_beside
    return slope, jacobian

"""Integrate one or several spin axes over millions of years, by Newton's method in time.

About a fixed axis N near the mean normal of the orbit, a spin axis s has a longitude phi and a
height Z = s.N. Both are polynomials in windows of twenty thousand years, through values at
Gauss-Legendre nodes, and the equation is satisfied at every node (collocation). Newton's method
solves for all windows of a block together.

phi has a period of 26,000 years and Z hardly changes. Picard iteration diverges over a million
years, while Newton's method, started from uniform precession, converges in a few steps.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.errors import ApartError, UndefinedError
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.numerics.polynomials import Windows, integrated, rule
from earthspin.secular.averaged_torque import (
    AveragedTorque,
    ChangingOrbit,
    PrecessionConstant,
    broadcast_over_members,
    mean_torque,
    reference_axes,
)
from earthspin.torque.gravity import dot

# --- Newton's method at the nodes of all windows --------------------------------------------------
# The longitude phi of the spin axis about a fixed axis N and the height Z = s.N are canonical
# variables: with the projection L = m.s on the axis m of the torque, and a rotation g,
#
#     F = g.s - (a/2) L^2,    phi' = dF/dZ,    Z' = -dF/dphi.
#
# Components perpendicular to N are combined in one complex number relative to the longitude of s:
# the real part is along the projection of s, the imaginary part perpendicular to it.

#: Largest number of sweeps for the linear equations of windows, and the size that counts as
#: divergence.
MOST_SWEEPS, SWEEPS_DIVERGE = 40, 1e6
#: Smallest change used as a divisor.
TINY = 1e-300


class NodeTorque(NamedTuple):
    """Averaged torque on a spin axis at integration nodes: axis m, constant a, added rotation g.

    Vectors are resolved along a reference axis N; components perpendicular to N are complex.

    Attributes
    ----------
    axis, drift : ndarray of complex, shape (..., w, n)
        Components perpendicular to N of the axis m of the torque, and of the rotation g (rad/s).
    axis_height, drift_height : ndarray, shape (..., w, n)
        Components of m and g along N.
    constant : ndarray, shape (..., w, n)
        a, rad/s.
    """

    axis: ComplexArray
    axis_height: FloatArray
    drift: ComplexArray
    drift_height: FloatArray
    constant: FloatArray

    @classmethod
    def of(cls, torque: AveragedTorque, axes: FloatArray, windows: Windows) -> NodeTorque:
        """Resolve an averaged torque along and perpendicular to the reference axis N."""
        shape = windows.times.shape

        def components(vector: FloatArray) -> tuple[ComplexArray, FloatArray]:
            x, y, z = (dot(row, vector).reshape(*vector.shape[1:-1], *shape) for row in axes)
            return x + 1j * y, z

        constant = torque.constant.reshape(*torque.constant.shape[:-1], *shape)
        return cls(*components(torque.axis), *components(torque.geodesic), constant)


class Linearization(NamedTuple):
    """Rates of a spin axis's longitude and component along the reference axis, with derivatives.

    The shape is (..., w, n) for w windows of n nodes.

    Attributes
    ----------
    rates : ndarray, shape (2, ..., w, n)
        Rates of longitude and height.
    mixed, by_height, by_longitude : ndarray
        Derivatives of the rate of longitude by longitude (the negative is that of the rate of
        height by height), of the rate of longitude by height, and of the rate of height by
        longitude.
    """

    rates: FloatArray
    mixed: FloatArray
    by_height: FloatArray
    by_longitude: FloatArray


def linearization(torque: NodeTorque, phi: FloatArray, z: FloatArray) -> Linearization:
    """Compute the rates of a spin axis's longitude (rad/s) and reference-axis component (1/s).

    The component along the reference axis is called height. The derivatives of both rates by
    longitude and height are included.
    """
    rotation = np.empty(phi.shape, dtype=complex)
    np.cos(phi, out=rotation.real)
    np.negative(np.sin(phi), out=rotation.imag)
    rho2 = 1 - z * z
    rho = np.sqrt(rho2)
    minus_drho_dz = z / rho
    m = torque.axis * rotation
    m_rho = m.real.copy()
    dl_dphi, dl_dz = rho * m.imag, torque.axis_height - minus_drho_dz * m_rho
    a_l = torque.constant * (rho * m_rho + z * torque.axis_height)
    df_ds = torque.drift * rotation - a_l * m
    df_drho = df_ds.real.copy()
    df_dphi_rho = df_ds.imag.copy()  # dF/dphi over rho
    rates = np.empty((2, *phi.shape))
    df_dz = torque.drift_height - a_l * torque.axis_height
    np.subtract(df_dz, minus_drho_dz * df_drho, out=rates[0])
    np.multiply(rho, -df_dphi_rho, out=rates[1])
    a_dl_dz = torque.constant * dl_dz
    return Linearization(
        rates,
        -a_dl_dz * dl_dphi - minus_drho_dz * df_dphi_rho,
        -a_dl_dz * dl_dz - df_drho / (rho2 * rho),
        torque.constant * dl_dphi**2 + rho * df_drho,
    )


def advance(
    windows: Windows, rates: FloatArray, state: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Integrate the rates of a spin axis's longitude and reference-axis component in time.

    Return the integrals from window starts to nodes, the states at window starts, and the final
    state. The shapes are (2, ..., w, n), (2, ..., w) and (2, ...).
    """
    to_nodes, over_windows = windows.integral(rates)
    ends = np.cumsum(np.concatenate([state[..., np.newaxis], over_windows], axis=-1), axis=-1)
    return to_nodes, ends[..., :-1], ends[..., -1]


def step(
    windows: Windows,
    torque: NodeTorque,
    values: FloatArray,
    state: FloatArray,
    residual: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Longitude and reference-axis component of a spin axis after one Newton step; largest change.

    With S the integral from the start of a window to its nodes, the values y of a window that
    starts at b solve y = b + S f(y). Linearised about the current values, the change is d = c + S J
    d, with the defect c for an unchanged start; a changed start adds S J times a unit step.

    Parameters
    ----------
    windows : Windows
    torque : NodeTorque
    values : ndarray, shape (2, ..., w, n)
        Longitude and height.
    state : ndarray, shape (2, ...)
        Values at the start of the first window.
    residual : ndarray, shape (...)
        Fraction of the change that may remain for the next step.

    Returns
    -------
    values : ndarray, shape (2, ..., w, n)
    change : ndarray, shape (...)
        Largest change; infinity if the linear equations could not be solved.
    """
    linear = linearization(torque, *values)
    to_nodes, starts, _ = advance(windows, linear.rates, state)
    sides = np.zeros((2, 3, *values.shape[1:]))
    np.subtract(starts[..., np.newaxis] + to_nodes, values, out=sides[:, 0])
    sides[0, 1] = sides[1, 2] = 1.0
    change, ends, settled = _linear(windows, linear, sides, residual)
    phi_shift, z_shift = _shifts(ends)[..., np.newaxis]
    total = change[:, 0] + change[:, 1] * phi_shift + change[:, 2] * z_shift
    return values + total, np.where(settled, np.abs(total).max(axis=(0, -2, -1)), np.inf)


def _linear(
    windows: Windows, linear: Linearization, sides: FloatArray, residual_share: FloatArray
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    """Solve the linear equations of one Newton step, in every time window.

    The equation is d = c + S J d for the change d, the defect c, the Jacobian J and the integral S.

    Each sweep solves for the height and then for the longitude; the coupling of longitude to height
    is small, so the residual decreases fast. Return d, shape (2, k, ..., w, n), the change over
    each window, shape (2, k, ..., w), and which axes converged; each axis has as many sweeps as it
    would alone.
    """
    gauss = rule(windows.order)
    jacobian = np.empty((3, *sides.shape[1:]))  # as wide as the sides: broadcasting is slower
    for row, derivative in zip(
        jacobian, (linear.mixed, linear.by_height, linear.by_longitude), strict=True
    ):
        row[:] = derivative * windows.half
    mixed, by_z, by_phi = jacobian
    phi, z = sides
    settled = np.zeros(sides.shape[2:-2], dtype=bool)
    previous = 1.0
    for _ in range(MOST_SWEEPS):
        height = sides[1] + (by_phi * phi - mixed * z) @ gauss.integrate
        longitude = sides[0] + (mixed * phi + by_z * height) @ gauss.integrate
        if settled.any():
            fixed = settled[..., np.newaxis, np.newaxis]
            longitude, height = np.where(fixed, phi, longitude), np.where(fixed, z, height)
        size = np.abs(longitude).max(axis=(0, -2, -1))
        change = np.abs(longitude - phi).max(axis=(0, -2, -1)) / size
        phi, z = longitude, height
        settled = settled | (change * np.minimum(change / previous, 1.0) < residual_share)
        if settled.all() or size.max() > SWEEPS_DIVERGE:
            break
        previous = np.maximum(change, TINY)
    ends = [rate @ gauss.weights for rate in (mixed * phi + by_z * z, by_phi * phi - mixed * z)]
    return np.array([phi, z]), np.array(ends), settled


def _shifts(ends: FloatArray) -> FloatArray:
    """Corrections of a spin axis's longitude and reference-axis component at the window starts.

    Parameters
    ----------
    ends : ndarray, shape (2, 3, ..., w)
        Change between start and end due to the defect, and due to unit changes of each component at
        the start.
    """
    single = ends.ndim == 3
    rows = ends.transpose(-1, *range(ends.ndim - 1))
    phi = z = 0.0 if single else np.zeros(ends.shape[2:-1])
    shifts = []
    for (d0, d00, d01), (d1, d10, d11) in rows.tolist() if single else rows:
        shifts.append((phi, z))
        phi, z = phi + d0 + d00 * phi + d01 * z, z + d1 + d10 * phi + d11 * z
    return np.moveaxis(np.array(shifts), 0, -1)


# --- windows, blocks and the whole trajectory -----------------------------------------------------

#: Number of nodes per window of the orbit.
ORDER = 16
#: Number of windows per block: a million years.
BLOCK = 50
#: Convergence tolerance of a block, rad: stop when the predicted next Newton step is smaller. The
#: prediction uses the residual of the sweeps and the ratio of the last two steps.
SETTLED = 1e-9
MOST_STEPS, STEPS_DIVERGE = 25, 10.0
#: Fraction of a step that sweeps may leave for the next step, per radian of the previous step.
SWEPT = 0.1
#: Largest height |Z| at which the longitude is well conditioned: 8 degrees from the axis.
TOO_NEAR = 0.99


@dataclass(frozen=True)
class AxisTrajectory:
    """Motion of one or many spin axes, as polynomials in time windows.

    Attributes
    ----------
    windows : Windows
        s from J2000.0 TDB.
    coefficients : ndarray, shape (2, ..., w, n + 1)
        Legendre coefficients of longitude and height about `axes`; members before the windows.
    axes : ndarray, shape (3, 3)
        Rows: two directions perpendicular to the reference axis, and that axis.
    steps : int
        Total number of Newton steps of all blocks.
    """

    windows: Windows
    coefficients: FloatArray
    axes: FloatArray
    steps: int

    def about(self, times: FloatArray) -> FloatArray:
        """Longitude about the reference axis (rad) and component along that axis, at given times.

        The component along the reference axis is called height. The shape is (2, ..., n).
        """
        series = self.coefficients
        rows = series.reshape(-1, *series.shape[-2:])
        series_values = self.windows.evaluate(rows, np.asarray(times, dtype=float))
        return series_values.reshape(*series.shape[:-2], -1)

    def at(self, times: FloatArray) -> FloatArray:
        """Unit vectors of the spin axis at given times in s, in the GCRS, shape (3, ..., n)."""
        phi, z = self.about(times)
        equatorial = np.sqrt(1 - z * z)
        components = np.array([equatorial * np.cos(phi), equatorial * np.sin(phi), z])
        return np.stack([dot(column, components) for column in self.axes.T])


def solve(
    precession: PrecessionConstant,
    orbit: ChangingOrbit,
    start: FloatArray,
    span: tuple[float, float],
    order: int = ORDER,
    pieces: int = 1,
    guess: AxisTrajectory | None = None,
) -> AxisTrajectory:
    """Integrate one or several spin axes from J2000.0 in both directions of time.

    Parameters
    ----------
    precession : PrecessionConstant
        Torque; for several axes, its arrays have shape (..., 1).
    orbit : ChangingOrbit
        Orbit, common to all axes.
    start : ndarray, shape (3,) or (3, ...)
        Unit vector of the axis at J2000.0, GCRS.
    span : tuple of float
        First and last time, s; J2000.0 need not be between them.
    order : int
        Number of nodes per window.
    pieces : int
        Number of windows per window of the orbit.
    guess : AxisTrajectory, optional
        Initial guess: the trajectory of a similar setting over the same span.

    Raises
    ------
    UndefinedError
        If Newton's method does not converge.
    ApartError
        If Newton's method does not converge for all of several axes, or they need different
        reference axes.
    """
    axes = _axes(orbit, start, span) if guess is None else guess.axes
    x, y, z = (dot(row, start) for row in axes)
    state = np.array([np.arctan2(y, x), z])
    solver = _BlockSolver(precession, orbit, axes, order, guess)
    past, future = (solver.run(edges, state) for edges in _edges(orbit.edges, span, pieces))
    # The past was integrated backwards: restore ascending order.
    reversed_past = past[1][..., ::-1, :] * (-1.0) ** np.arange(order + 1)
    windows = Windows(np.concatenate([past[0][::-1], future[0][1:]]), order)
    series = np.concatenate([reversed_past, future[1]], axis=-2)
    return AxisTrajectory(windows, series, axes, solver.steps)


def _edges(edges: FloatArray, span: tuple[float, float], pieces: int) -> list[FloatArray]:
    """Edges of the time windows of the integration: before J2000.0, and after J2000.0.

    Both arrays start at J2000.0.
    """
    middle = int(np.searchsorted(edges, 0.0))
    first = int(np.searchsorted(edges, min(span[0], 0.0), side="right")) - 1
    last = int(np.searchsorted(edges, max(span[1], 0.0)))
    if first == last:  # J2000.0 only: any window will do
        first, last = max(first - 1, 0), min(last + 1, len(edges) - 1)
    past, future = edges[max(first, 0) : middle + 1], edges[middle : last + 1]
    return [_cut(past[::-1], pieces), _cut(future, pieces)]


def _cut(edges: FloatArray, pieces: int) -> FloatArray:
    if pieces == 1:
        return edges
    fine = edges[:-1, np.newaxis] + np.diff(edges)[:, np.newaxis] * np.arange(pieces) / pieces
    return np.append(fine.ravel(), edges[-1])


def _axes(orbit: ChangingOrbit, start: FloatArray, span: tuple[float, float]) -> FloatArray:
    """Choose the reference axes of the integration from the mean orbit normal.

    If the spin axis is near that normal, the third is perpendicular to it.
    """
    times = np.linspace(min(span[0], 0.0), max(span[1], 0.0), 101)
    first, second, normal = reference_axes(np.mean(orbit.at(times)[0], axis=1))
    is_near = np.abs(dot(normal, start)) >= TOO_NEAR
    if not is_near.any():
        return np.stack([first, second, normal])
    if not is_near.all():
        raise ApartError("some of the axes are too near to the mean normal of the orbit")
    return np.stack([normal, first, second])


class _BlockSolver:
    """Solver of the spin axis in successive blocks of time windows, starting at J2000.0."""

    def __init__(
        self,
        precession: PrecessionConstant,
        orbit: ChangingOrbit,
        axes: FloatArray,
        order: int,
        guess: AxisTrajectory | None = None,
    ) -> None:
        self.precession, self.orbit, self.axes, self.order = precession, orbit, axes, order
        self.guess, self.steps = guess, 0
        self.height: FloatArray | None = None

    def run(self, edges: FloatArray, state: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Integrate the spin axis over successive time windows from an initial direction.

        The direction is given as longitude and height, the component along the reference axis.

        Return the window edges, and the Legendre series of longitude and height in each window.

        The series have the shape (2, ..., w, order + 1).
        """
        blocks = [np.empty((*state.shape, 0, self.order + 1))]
        first, size = 0, BLOCK
        while first < len(edges) - 1:
            windows = Windows(edges[first : first + size + 1], self.order)
            settled = self._block(windows, state)
            if settled is None and state.ndim > 1:
                raise ApartError("Newton's method in time does not converge for all axes")
            if settled is None and size == 1:
                raise UndefinedError(
                    "the axis cannot be integrated: Newton's method in time does not converge; the "
                    "axis may pass through the reference axis, or precess too fast for the windows"
                )
            if settled is None:
                self.guess, size = None, max(size // 4, 1)
                continue
            series, state = settled
            blocks.append(series)
            first += len(windows.half)
        return edges, np.concatenate(blocks, axis=-2)

    def _block(self, windows: Windows, state: FloatArray) -> tuple[FloatArray, FloatArray] | None:
        """Integrate the spin axis over one block of time windows, by Newton's method.

        Return the Legendre series and the final longitude and height; None if Newton's method does
        not converge.
        """
        torque = NodeTorque.of(
            self._torque(windows.times.ravel(), state[..., np.newaxis]), self.axes, windows
        )
        values, previous = self._first_guess(windows, torque, state), np.ones(state.shape[1:])
        settled = np.zeros(state.shape[1:], dtype=bool)
        for _ in range(MOST_STEPS):
            self.steps += 1
            residual_share = SWEPT * np.minimum(previous, 1.0)
            new, change = step(windows, torque, values, state, residual_share)
            if settled.any():
                new = np.where(settled[..., np.newaxis, np.newaxis], values, new)
            values = new
            if not (np.all(change < STEPS_DIVERGE) and np.abs(values[1]).max() < 1):
                return None
            settled = settled | (change * np.maximum(change / previous, residual_share) < SETTLED)
            if settled.all():
                self.height = values[1].mean(axis=(-2, -1))
                rates = linearization(torque, *values).rates
                _, starts, end = advance(windows, rates, state)
                return integrated(windows.coefficients(rates), windows.half, starts), end
            previous = np.maximum(change, TINY)
        return None

    def _torque(self, times: FloatArray, state: FloatArray) -> AveragedTorque:
        """Averaged torque on one or many spin axes at given times."""
        normal, eccentricity, normal_rate = (
            broadcast_over_members(state, vector) for vector in self.orbit.at(times)
        )
        return mean_torque(self.precession, (normal, eccentricity, normal_rate), times)

    def _first_guess(self, windows: Windows, torque: NodeTorque, state: FloatArray) -> FloatArray:
        """First guess of a spin axis at all times: longitude and reference-axis component.

        It is a neighbouring trajectory shifted to the initial state, or uniform precession.
        """
        if self.guess is None:
            return self._precession(windows, torque, state)
        times = np.append(windows.times, windows.edges[0])
        values = self.guess.about(times)
        values += state[..., np.newaxis] - values[..., -1:]
        return values[..., :-1].reshape(*state.shape, *windows.times.shape)

    def _precession(self, windows: Windows, torque: NodeTorque, state: FloatArray) -> FloatArray:
        """First guess of the spin axis's motion: uniform precession about the reference axis.

        The height, the component along that axis, is constant: that of the start, or the mean of
        the previous block.
        """
        phi, z = state[..., np.newaxis, np.newaxis]
        if self.height is not None:
            z = self.height[..., np.newaxis, np.newaxis]
        rate = torque.drift_height - torque.constant * z * torque.axis_height**2
        to_nodes, over_windows = windows.integral(rate)
        starts = np.cumsum(over_windows, axis=-1) - over_windows
        guess = np.empty((2, *to_nodes.shape))
        guess[0], guess[1] = phi + starts[..., np.newaxis] + to_nodes, z
        return guess

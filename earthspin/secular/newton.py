r"""Newton's method for a spin axis at the collocation nodes of all time windows.

The longitude phi of the spin axis about a fixed axis N and the height Z = s.N are canonical
variables: with the projection L = m.s on the axis m of the torque, and a rotation g,

    F = g.s - (a/2) L^2,    phi' = dF/dZ,    Z' = -dF/dphi.

Components perpendicular to N are combined in one complex number relative to the longitude of s: the
real part is along the projection of s, the imaginary part perpendicular to it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.numerics.polynomials import Windows, rule
from earthspin.secular.orbit import Pull
from earthspin.torque.gravity import dot

#: Largest number of sweeps for the linear equations of windows, and the size that counts as
#: divergence.
MOST_SWEEPS, DIVERGED = 40, 1e6
#: Smallest change used as a divisor.
TINY = 1e-300


class Turn(NamedTuple):
    """Averaged torque on a spin axis at the nodes, resolved along a reference axis N.

    The components perpendicular to N are complex numbers.

    The torque has the axis m, the constant a, and an additional rotation g.

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
    def of(cls, on: Pull, axes: FloatArray, windows: Windows) -> Turn:
        """Resolve an averaged torque into components along and perpendicular to the axis N."""
        shape = windows.times.shape

        def seen(vector: FloatArray) -> tuple[ComplexArray, FloatArray]:
            x, y, z = (dot(row, vector).reshape(*vector.shape[1:-1], *shape) for row in axes)
            return x + 1j * y, z

        constant = on.constant.reshape(*on.constant.shape[:-1], *shape)
        return cls(*seen(on.axis), *seen(on.geodesic), constant)


class Slope(NamedTuple):
    """Rates of a spin axis's longitude and of its component along N at the nodes, with derivatives.

    Their derivatives by longitude and height are included.

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


def slope(on: Turn, phi: FloatArray, z: FloatArray) -> Slope:
    """Compute the rates of a spin axis's longitude and component along N, with their derivatives.

    The rates are in rad/s and in 1/s.

    The height is the component along the reference axis.
    """
    seen = np.empty(phi.shape, dtype=complex)
    np.cos(phi, out=seen.real)
    np.negative(np.sin(phi), out=seen.imag)
    rho2 = 1 - z * z
    rho = np.sqrt(rho2)
    slant = z / rho
    axis = on.axis * seen
    towards = axis.real.copy()
    lift_by_phi, lift_by_z = rho * axis.imag, on.axis_height - slant * towards
    pull = on.constant * (rho * towards + z * on.axis_height)  # a L
    turn = on.drift * seen - pull * axis
    along = turn.real.copy()
    across = turn.imag.copy()
    rates = np.empty((2, *phi.shape))
    np.subtract(on.drift_height - pull * on.axis_height, slant * along, out=rates[0])
    np.multiply(rho, -across, out=rates[1])
    steep = on.constant * lift_by_z
    return Slope(
        rates,
        -steep * lift_by_phi - slant * across,
        -steep * lift_by_z - along / (rho2 * rho),
        on.constant * lift_by_phi**2 + rho * along,
    )


def moved(
    windows: Windows, rates: FloatArray, state: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Integrate the rates of a spin axis's longitude and component along N over time windows.

    Return the integrals from window starts to nodes, the states at window starts, and the final
    state. The shapes are (2, ..., w, n), (2, ..., w) and (2, ...).
    """
    inside, across = windows.integral(rates)
    ends = np.cumsum(np.concatenate([state[..., np.newaxis], across], axis=-1), axis=-1)
    return inside, ends[..., :-1], ends[..., -1]


def step(
    windows: Windows, on: Turn, values: FloatArray, state: FloatArray, left: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Make one Newton step for a spin axis's longitude and component along N; return also its size.

    With S the integral from the start of a window to its nodes, the values y of a window that
    starts at b solve y = b + S f(y). Linearised about the current values, the change is d = c + S J
    d, with the defect c for an unchanged start; a changed start adds S J times a unit step.

    Parameters
    ----------
    windows : Windows
    on : Turn
    values : ndarray, shape (2, ..., w, n)
        Longitude and height.
    state : ndarray, shape (2, ...)
        Values at the start of the first window.
    left : ndarray, shape (...)
        Fraction of the change that may remain for the next step.

    Returns
    -------
    values : ndarray, shape (2, ..., w, n)
    change : ndarray, shape (...)
        Largest change; infinity if the linear equations could not be solved.
    """
    at = slope(on, *values)
    inside, starts, _ = moved(windows, at.rates, state)
    sides = np.zeros((2, 3, *values.shape[1:]))
    np.subtract(starts[..., np.newaxis] + inside, values, out=sides[:, 0])
    sides[0, 1] = sides[1, 2] = 1.0
    change, ends, settled = _linear(windows, at, sides, left)
    by_phi, by_z = _shifts(ends)[..., np.newaxis]
    total = change[:, 0] + change[:, 1] * by_phi + change[:, 2] * by_z
    return values + total, np.where(settled, np.abs(total).max(axis=(0, -2, -1)), np.inf)


def _linear(
    windows: Windows, at: Slope, sides: FloatArray, left: FloatArray
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    """Solve the linear equations of one Newton step, in every time window.

    The equation is d = c + S J d for the change d, the defect c, the Jacobian J and the integral S.

    The result has the shape (2, k, ..., w, n).

    Each sweep solves for the height and then for the longitude; the coupling of longitude to height
    is small, so the residual decreases fast. Returns also the change over each window, shape (2, k,
    ..., w), and which axes converged; each axis has as many sweeps as it would alone.
    """
    gauss = rule(windows.order)
    jacobian = np.empty((3, *sides.shape[1:]))  # as wide as the sides: broadcasting is slower
    for wide, derivative in zip(jacobian, (at.mixed, at.by_height, at.by_longitude), strict=True):
        wide[:] = derivative * windows.half
    mixed, by_z, by_phi = jacobian
    phi, z = sides
    settled = np.zeros(sides.shape[2:-2], dtype=bool)
    before = 1.0
    for _ in range(MOST_SWEEPS):
        height = sides[1] + (by_phi * phi - mixed * z) @ gauss.integrate
        longitude = sides[0] + (mixed * phi + by_z * height) @ gauss.integrate
        if settled.any():
            kept = settled[..., np.newaxis, np.newaxis]
            longitude, height = np.where(kept, phi, longitude), np.where(kept, z, height)
        size = np.abs(longitude).max(axis=(0, -2, -1))
        change = np.abs(longitude - phi).max(axis=(0, -2, -1)) / size
        phi, z = longitude, height
        settled = settled | (change * np.minimum(change / before, 1.0) < left)
        if settled.all() or size.max() > DIVERGED:
            break
        before = np.maximum(change, TINY)
    ends = [rate @ gauss.weights for rate in (mixed * phi + by_z * z, by_phi * phi - mixed * z)]
    return np.array([phi, z]), np.array(ends), settled


def _shifts(ends: FloatArray) -> FloatArray:
    """Corrections of a spin axis's longitude and component along N at the window starts.

    Parameters
    ----------
    ends : ndarray, shape (2, 3, ..., w)
        Change between start and end due to the defect, and due to unit changes of each component at
        the start.
    """
    alone = ends.ndim == 3
    rows = ends.transpose(-1, *range(ends.ndim - 1))
    phi = z = 0.0 if alone else np.zeros(ends.shape[2:-1])
    shifts = []
    for (d0, d00, d01), (d1, d10, d11) in rows.tolist() if alone else rows:
        shifts.append((phi, z))
        phi, z = phi + d0 + d00 * phi + d01 * z, z + d1 + d10 * phi + d11 * z
    return np.moveaxis(np.array(shifts), 0, -1)

r"""Semidiurnal motion of the axes of a triaxial body.

The torque on B - A varies twice a day with the rotation of the body. In the plane of the equator,
as a complex number with respect to the non-rotating direction e1, it is

    n = -(3/2) i (B - A) conj(Q_1F + i Q_2F) exp(2 i theta)

(from N = 3 GM/r5 r x I r, I.9.34). Its amplitude varies slowly, so that its integral and the
response are series in the ratio of a day to the periods of the perturbers. They are computed by
iteration:

    l' = n/(C Omega),   l = f + i tau f',   w = f + (i/Omega) f'

In addition, l contains the contribution of B - A to the angular momentum of a spin axis that is
already tilted by l - f, -(B - A)/(2A) conj(l - f) exp(2 i theta) (0.1 uas). The amplitude of the
axes is 0.03 mas; the mean motion does not change.
"""

from __future__ import annotations

import numpy as np

from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.numerics.gauss_windows import Windows
from earthspin.torque.gravity import apply

#: Smallest distance from the resonance of a flat body for which the series converges.
NEAREST_RESONANCE = 0.2
_ROUNDS = 8  # largest number of rounds; each gains a factor of 25 for fortnightly terms
#: Terms below this change no digit of a unit vector, rad.
_ROUNDING = 1e-16


def equatorial_basis(figure: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two unit vectors in the equator plane; the first is the projected x axis.

    Parameters
    ----------
    figure : ndarray, shape (3, ...)
        Unit vectors, none along x.
    """
    x, y, z = figure
    from_x = np.sqrt(y * y + z * z)
    first = np.stack([1 - x * x, -x * y, -x * z]) / from_x
    second = np.stack([np.zeros_like(x), z, -y]) / from_x
    return first, second


def semidiurnal_amplitudes(
    windows: Windows,
    tensor: FloatArray,
    figure: FloatArray,
    tilt: FloatArray,
    triaxiality: float,
    spin_rate: float,
    tau: float,
) -> ComplexArray:
    """Complex amplitudes of the semidiurnal motion of a triaxial body's three axes.

    Parameters
    ----------
    windows : Windows
    tensor : ndarray, shape (6, w, n)
        `earthspin.torque.gravity.tidal_tensor`.
    figure : ndarray, shape (3, w, n)
        Figure axis without this motion.
    tilt : ndarray, shape (3, w, n)
        Angular momentum minus figure axis, rad.
    triaxiality : float
        (B - A)/C.
    spin_rate : float
        rad/s.
    tau : float
        A/(C Omega), s.

    Returns
    -------
    ndarray, shape (3, w, n), complex
        Amplitudes, rad, to be multiplied by exp(2 i theta), with the angle theta of the axis of
        least moment.

    Raises
    ------
    UndefinedError
        If the body is so flat that the period of its free nutation is close to half a day.
    """
    first, second = equatorial_basis(figure)
    q = _on_equator(apply(tensor, figure), first, second)
    torque = -1.5j * triaxiality / spin_rate * np.conj(q)
    half_turn = 2j * spin_rate
    momentum = _series(windows, torque / half_turn, -1 / half_turn)

    turn = tau * spin_rate  # A/C
    away = 1 - 2 * turn  # from the free nutation, which a thin disc has at half a day
    if abs(away) < NEAREST_RESONANCE:
        raise UndefinedError(
            f"A/C = {turn:.3g}: the semidiurnal torque on B - A resonates with the free nutation "
            f"(|1 - 2 A/C| under {NEAREST_RESONANCE}); remove the effect 'triaxiality' or set "
            f"the body's triaxiality to 0"
        )
    uneven = triaxiality / (2 * turn) * np.conj(_on_equator(tilt, first, second))
    axis = _series(windows, (momentum + uneven) / away, -1j * tau / away)
    rotation = -axis + 1j * windows.derivative(axis) / spin_rate
    return np.stack([momentum, rotation, axis])


def _series(windows: Windows, first: ComplexArray, factor: complex) -> ComplexArray:
    """Solve x = first + factor dx/dt for x, by repeated differentiation of `first`.

    Each term is `factor` times the derivative of the previous term.
    """
    total = term = first
    for _ in range(_ROUNDS):
        term = factor * windows.derivative(term)
        total = total + term
        if np.max(np.abs(term.view(float))) < _ROUNDING:
            break
    return total


def _on_equator(vector: FloatArray, first: FloatArray, second: FloatArray) -> ComplexArray:
    """Projections of vectors on the equator plane, as complex numbers in a given basis."""
    return np.asarray(np.sum(vector * first, axis=0) + 1j * np.sum(vector * second, axis=0))

r"""Figure axis from the angular momentum of a body without free wobble.

For an axisymmetric body whose spin about its figure axis F is Omega, with the angular
momentum l in units of C Omega,

    l = F + \tau F x F',     \tau = A/(C Omega)

is exact. The free motion rotates F about l in about a day (I.6), while the motion due to torques is
slow. Iteration for the tilt, l - F = tau F x (l' - (l - F)'), gives the only motion without a free
part. Each round adds a term, -tau F x (the last term)', of a series in the ratio of the frequencies
of the axis and of the spin. The series is asymptotic; for a slowly rotating body its terms soon
grow.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.gauss_windows import Windows
from earthspin.torque.gravity import cross

#: Terms below this change no digit of a unit vector, rad.
_ROUNDING = 1e-17


def tilt_of_figure(
    windows: Windows, figure: FloatArray, rate: FloatArray, tau: float, rounds: int
) -> tuple[FloatArray, list[float]]:
    """Vector from figure axis to angular momentum in motion without free wobble, rad.

    It is tau F x F', where F is the unit figure axis and F' its rate.

    Parameters
    ----------
    windows : Windows
    figure : ndarray, shape (3, w, n)
        Estimate of F that is correct to first order.
    rate : ndarray, shape (3, w, n)
        l', s-1.
    tau : float
        A/(C Omega), s; negative for a retrograde spin.
    rounds : int
        Largest number of terms of the series.

    Returns
    -------
    tilt : ndarray, shape (3, w, n)
        Tilt, rad.
    sizes : list of float
        Largest value of each term, rad. The series is truncated before the terms grow.
    """
    scaled = tau * figure
    tilt = term = cross(scaled, rate)
    sizes = [float(np.max(np.abs(tilt)))]
    for _ in range(rounds):
        term = cross(windows.derivative(term), scaled)
        size = float(np.max(np.abs(term)))
        if size > 0.7 * sizes[-1]:
            break
        tilt += term
        sizes.append(size)
        if size < _ROUNDING:
            break
    return tilt, sizes


def fastest_sweep(h: float, spin_rate: float, pulls: Iterable[tuple[float, float]]) -> float:
    """Largest speed of an axis in precession, over all obliquities (at 45 degrees), rad/s.

    (3/4) H/Omega times the sum of GM/r3: the rate of precession in longitude, (3/2) H/Omega GM/r3
    cos(eps), times sin(eps) (I.8.23).

    Parameters
    ----------
    h : float
    spin_rate : float
        rad/s.
    pulls : iterable of (gm, distance)
        m3 s-2 and m.
    """
    return abs(0.75 * h / spin_rate) * sum(gm / distance**3 for gm, distance in pulls)

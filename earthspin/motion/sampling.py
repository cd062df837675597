r"""Bound on the error of an axis due to interpolation of the positions of perturbers.

Torques on an oblate body are linear in the tidal tensor Q = sum GM r r^T/r5. With the error dQ of
the interpolated Q, the error of the torque on a figure axis F is 3 (H/\Omega) (dQ F) x F. It is at
most 3 (H/\Omega) s(dQ), where s is half the difference of the largest and the smallest eigenvalue.
The same bound applies to the integral if F is fixed; if the axis has moved by some radians, the
bound is multiplied by 1 plus this angle (integration by parts). The figure axis adds the slow
manifold, \tau F x F' and its next term (`earthspin.motion.figure`), twice, because the initial
angular momentum contains it as well. A triaxial body adds its semidiurnal motion, which is
proportional to Q.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from earthspin.motion.forces import Figure

FloatArray = NDArray[np.float64]


def angle_from_sampling(
    figure: Figure,
    integral: FloatArray,
    value: FloatArray,
    derivative: FloatArray,
    turned: float = 0.0,
) -> FloatArray:
    """Bound on the error of an axis due to interpolation of the tidal tensor, rad.

    Parameters
    ----------
    figure : Figure
    integral, value, derivative : ndarray, shape (...)
        Largest half spreads of the eigenvalues of the errors of the integral of Q since the epoch
        (s-1), of Q (s-2) and of its derivative (s-3).
    turned : float
        Length of the path of the axis since the epoch, rad.

    Returns
    -------
    ndarray, shape (...)
    """
    tau, spin = abs(figure.tau), abs(figure.spin_rate)
    tilt = tau * value + tau * tau * derivative
    slow = 3 * abs(figure.h) / spin * (integral * (1 + turned) + 2 * tilt)
    return np.asarray(slow + 3 * abs(figure.triaxiality) / spin * tilt)


def longest_path(figure: Figure, mean: float, length: float) -> float:
    """Upper bound on the length of the path of a precessing axis, rad.

    Parameters
    ----------
    figure : Figure
    mean : float
        Mean half spread of the eigenvalues of Q, s-2.
    length : float
        Time from the epoch, s.
    """
    return 3 * abs(figure.h / figure.spin_rate) * mean * length

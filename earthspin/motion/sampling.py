r"""How far an error in sampling the sky turns an axis: a bound for any body.

All that the sky does to an oblate body is linear in the tidal tensor Q = sum GM r r^T/r5. With
dQ the error of Q between and behind the nodes, the torque on a figure axis F is off by
3 (H/\Omega) (dQ F) x F, which no F makes larger than 3 (H/\Omega) s(dQ), where s is half the
difference of the largest and the smallest eigenvalue. For the integral this holds while F stands
still; an axis that has turned by some radians multiplies the bound by 1 more than these (integrate
by parts). The figure axis adds the slow manifold, \tau F x F' and its next term
(`earthspin.motion.figure`), twice, because the angular momentum at the start has it, too; and a
triaxial body its semidiurnal motion in proportion to Q itself.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from earthspin.motion.forces import Figure

FloatArray = NDArray[np.float64]


def turn_by_sampling(
    figure: Figure,
    integral: FloatArray,
    value: FloatArray,
    derivative: FloatArray,
    turned: float = 0.0,
) -> FloatArray:
    """Bound on the angle between the axis as sampled and the axis, rad.

    Parameters
    ----------
    figure : Figure
        Of the body.
    integral, value, derivative : ndarray, shape (...)
        Half the spread of the eigenvalues of the errors of the integral of Q since the epoch
        (s-1), of Q (s-2) and of its derivative (s-3), at their largest.
    turned : float
        Path of the axis since the epoch, rad.

    Returns
    -------
    ndarray, shape (...)
    """
    tau, spin = abs(figure.tau), abs(figure.spin_rate)
    tilt = tau * value + tau * tau * derivative
    slow = 3 * abs(figure.h) / spin * (integral * (1 + turned) + 2 * tilt)
    return np.asarray(slow + 3 * abs(figure.triaxiality) / spin * tilt)


def turn_by_mean(figure: Figure, mean: float, length: float) -> float:
    """Longest path of an axis, rad.

    Parameters
    ----------
    figure : Figure
    mean : float
        Mean half spread of the eigenvalues of Q, s-2.
    length : float
        Of time, s.
    """
    return 3 * abs(figure.h / figure.spin_rate) * mean * length

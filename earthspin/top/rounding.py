"""Effect of rounding errors in a top's initial state on its computed motion.

A top that nearly sleeps, or nearly stops at the highest point of its motion, amplifies rounding
errors of the initial state, which limits every method. The effect is measured by changing one
number at a time by one unit in its last place.
"""

from __future__ import annotations

from dataclasses import fields

import numpy as np
from numpy.typing import ArrayLike

from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.top.motion import HeavyTopMotion, heavy_top_motion
from earthspin.top.start import HeavyTop

Numbers = ComplexArray | FloatArray

#: Error bound of the closed form, unless twice the effect of rounding is larger: measured with 500
#: starts in each of ten families (`python -m tests.top.accuracy 500`).
CLOSED_FORM_ERROR = 1e-13
#: Largest theta of a vertical axis, rad. An axis on the vertical is placed within 1e-120 of its
#: passage, so that its azimuth is defined.
UPRIGHT = 1e-100


def error_bound(top: HeavyTop, times: ArrayLike) -> FloatArray:
    """Bound on the largest relative error of `heavy_top_motion` over all times and quantities.

    Parameters
    ----------
    top : HeavyTop
    times : ndarray, shape (n,)
        s.

    Returns
    -------
    ndarray, of the shape of the tops
        Largest of the errors of theta, relative to theta; of phi, psi and the transverse angular
        velocity, relative to their largest values; and of the elements of the attitude.
    """
    return np.maximum(CLOSED_FORM_ERROR, 2 * effect_of_rounding(top, times))


def effect_of_rounding(top: HeavyTop, times: ArrayLike) -> FloatArray:
    """Change of a top's motion if each initial value changes by one unit in its last place.

    Parameters
    ----------
    top : HeavyTop
    times : ndarray, shape (n,)
        s.

    Returns
    -------
    ndarray, of the shape of the tops
        As for `error_bound`.
    """
    t = np.atleast_1d(np.asarray(times, dtype=np.float64))
    start = {field.name: getattr(top, field.name) for field in fields(top)}
    motion = heavy_top_motion(top, t)
    total = _difference(heavy_top_motion(top, np.nextafter(t, np.inf)), motion)
    for name, value in start.items():
        moved = np.nextafter(value, 0.0)  # towards zero: all limits on a start are upper limits
        if np.any(moved != value):
            total = total + _difference(
                heavy_top_motion(HeavyTop(**(start | {name: moved})), t), motion
            )
    return total


def _difference(one: HeavyTopMotion, other: HeavyTopMotion) -> FloatArray:
    """Largest relative difference between two motions of each top, over times and quantities."""
    across, reference = (m.omega_body[..., 0] + 1j * m.omega_body[..., 1] for m in (one, other))
    # a quaternion and its negative are the same attitude
    sign = np.copysign(1.0, np.sum(one.attitude * other.attitude, axis=-1, keepdims=True))
    turned = 2 * np.abs(one.attitude - sign * other.attitude)
    # a vertical axis has no azimuth: the division of the rotation between phi and psi is arbitrary
    tilted = (other.theta > UPRIGHT) & (other.theta != np.pi)
    ratios = (
        _relative(one.theta - other.theta, np.where(tilted, np.abs(other.theta), 0.0)),
        _relative(tilted * (one.phi - other.phi), _largest(other.phi)),
        _relative(tilted * (one.psi - other.psi), _largest(other.psi)),
        _relative(across - reference, _largest(reference)),
        turned.max(axis=(-2, -1)),
    )
    return np.asarray(np.max(ratios, axis=0))


def _largest(values: Numbers) -> FloatArray:
    """Largest absolute value over the last axis (times), which keeps length 1."""
    return np.asarray(np.max(np.abs(values), axis=-1, keepdims=True))


def _relative(difference: Numbers, size: FloatArray) -> FloatArray:
    """Largest ratio |difference|/size over the last axis (times); 0 where size is 0."""
    ratio = np.zeros(difference.shape)
    np.divide(np.abs(difference), size, out=ratio, where=size > 0)
    return np.asarray(np.max(ratio, axis=-1))

"""Heavy symmetric top and its initial state (I.7.1 to I.7.7).

The pivot is the origin. The Euler angles are those of I.7.1: rotations by psi about the body's
axis, by theta about the line of nodes, and by phi about the vertical,

    R = Rz(phi) Rx(theta) Rz(psi),    body to inertial.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from earthspin.errors import BodyError
from earthspin.numerics.arrays import FloatArray

_NAME = "heavy top"
#: Largest rate, rad/s; larger ones would overflow.
_FASTEST = 1e100
#: Inclinations below this count as zero; their fourth powers would underflow.
_UPRIGHT = 1e-60


@dataclass(frozen=True, eq=False, kw_only=True)
class HeavyTop:
    """A symmetric top: its moments of inertia, its weight moment, and its motion at t = 0.

    Each field is a number or an array; the fields broadcast together. A top with arrays is a batch
    of tops.

    Attributes
    ----------
    transverse_moment : ndarray
        I1 = I2, moment about an axis through the pivot perpendicular to the figure axis, kg m2.
    axial_moment : ndarray
        I3, about the figure axis, kg m2; at most 2 I1.
    weight_moment : ndarray
        m g r, weight times the distance from pivot to centre of mass along the figure axis,
        N m. Zero for a free rotor; negative if the centre of mass is below the pivot at theta = 0.
    theta : ndarray
        Angle from the vertical to the figure axis, from 0 to pi, rad. The float nearest to pi
        counts as pi, and values below 1e-60 as zero.
    theta_rate, phi_rate : ndarray
        rad/s. For a vertical axis phi_rate does not affect the motion of the body; it only divides
        the rotation between phi and psi.
    spin : ndarray
        omega3, component of the angular velocity along the figure axis, rad/s; constant.
    phi, psi : ndarray
        rad.
    """

    transverse_moment: Any
    axial_moment: Any
    weight_moment: Any
    theta: Any
    spin: Any
    phi_rate: Any = 0.0
    theta_rate: Any = 0.0
    phi: Any = 0.0
    psi: Any = 0.0

    def __post_init__(self) -> None:
        names = [field.name for field in fields(self)]
        arrays = [np.asarray(getattr(self, name), dtype=np.float64) for name in names]
        for name, value in zip(names, arrays, strict=True):
            _require(np.isfinite(value), name, value, "give a finite number")
        for name, value in zip(names, _broadcast(names, arrays), strict=True):
            array = value.copy()
            array.flags.writeable = False
            object.__setattr__(self, name, array)
        self._check()

    @classmethod
    def from_euler_rates(
        cls, *, theta: ArrayLike, phi_rate: ArrayLike, psi_rate: ArrayLike, **rest: Any
    ) -> HeavyTop:
        """Create a top from psi' instead of the spin: omega3 = phi' cos(theta) + psi' (I.7.3).

        Parameters
        ----------
        theta : float or ndarray
            rad.
        phi_rate, psi_rate : float or ndarray
            rad/s.
        **rest
            The other fields.
        """
        spin = np.multiply(phi_rate, np.cos(theta)) + psi_rate
        return cls(theta=theta, phi_rate=phi_rate, spin=spin, **rest)

    @property
    def shape(self) -> tuple[int, ...]:
        """Array shape of the fields (one element per top); empty for one top."""
        return np.shape(self.theta)

    def _check(self) -> None:
        i1, i3 = self.transverse_moment, self.axial_moment
        _require(i1 > 0, "transverse_moment", i1, "give a positive number of kg m2")
        _require(i3 > 0, "axial_moment", i3, "give a positive number of kg m2")
        most = "no body has more than twice its transverse moment about the pivot"
        _require(i3 / 2 * (1 - 1e-14) <= i1, "axial_moment", i3, most)
        for name in ("theta_rate", "phi_rate", "spin"):
            rate = getattr(self, name)
            _require(np.abs(rate) <= _FASTEST, name, rate, f"give at most {_FASTEST:g} rad/s")
        weight = self.weight_moment
        slow = np.abs(weight) / _FASTEST / _FASTEST <= i1  # in this order nothing overflows
        _require(slow, "weight_moment", weight, "its transverse moment is too small for it")
        upright_to_hanging = (self.theta >= 0) & (self.theta <= np.pi)
        _require(upright_to_hanging, "theta", self.theta, "give an angle from 0 to pi rad")


class TopConstants(NamedTuple):
    """Constants a, b, alpha and beta of a top's motion, as in I.7.7 and I.7.14.

    Attributes
    ----------
    a : ndarray
        (L . z')/I1 = I3 omega3/I1, along the figure axis, rad/s.
    b : ndarray
        (L . z)/I1, along the vertical, rad/s.
    alpha : ndarray
        2 E'/I1, where E' is the energy less that of the spin, rad2/s2.
    beta : ndarray
        2 m g r/I1, rad2/s2.
    """

    a: FloatArray
    b: FloatArray
    alpha: FloatArray
    beta: FloatArray


def top_constants(top: HeavyTop) -> TopConstants:
    """Compute the constants of a top's motion: a, b, alpha and beta of I.7.7 and I.7.14.

    The last rows of the source's table I.7.20 have a and b exchanged: the vertical component
    of the angular momentum is b I1, the axial one a I1.
    """
    heights = axis_heights(top.theta)
    sine2 = heights.below * heights.above
    a = top.axial_moment * top.spin / top.transverse_moment
    beta = 2 * top.weight_moment / top.transverse_moment
    b = top.phi_rate * sine2 + a * heights.cosine
    alpha = top.theta_rate**2 + top.phi_rate**2 * sine2 + beta * heights.cosine
    return TopConstants(a, b, alpha, beta)


class AxisHeights(NamedTuple):
    """Height cos(theta) of the axis, and its distances 1 - cos and 1 + cos from the poles.

    Attributes
    ----------
    below : ndarray
        1 - cos(theta), depth below the upper pole, to full relative accuracy.
    above : ndarray
        1 + cos(theta), height above the lower pole, to full relative accuracy.
    cosine : ndarray
        cos(theta).
    """

    below: FloatArray
    above: FloatArray
    cosine: FloatArray


def axis_heights(theta: FloatArray) -> AxisHeights:
    """Compute cos(theta), 1 - cos(theta) and 1 + cos(theta) without cancellation."""
    below = np.where(theta < _UPRIGHT, 0.0, 2 * np.sin(theta / 2) ** 2)
    # No float equals pi; the nearest one denotes a hanging top.
    above = np.where(theta == np.pi, 0.0, 2 * np.cos(theta / 2) ** 2)
    return AxisHeights(below, above, np.cos(theta))


def _broadcast(names: list[str], values: list[FloatArray]) -> list[FloatArray]:
    """Broadcast all fields of a top to one array shape; raise an error if they do not fit."""
    try:
        return list(np.broadcast_arrays(*values))
    except ValueError:
        shapes = ", ".join(f"{n} {v.shape}" for n, v in zip(names, values, strict=True) if v.ndim)
        raise BodyError(_NAME, "shapes", shapes, "give arrays that broadcast together") from None


def _require(holds: Any, field: str, value: Any, allowed: str) -> None:
    """Raise an error if any value of a field does not meet its condition."""
    holds, value = np.broadcast_arrays(holds, value)
    if not np.all(holds):
        raise BodyError(_NAME, field, float(value[~holds].flat[0]), allowed)

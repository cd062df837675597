"""Principal axes and moments, degenerate bodies included (I.3).

Where two moments agree, any two axes in their plane serve; where all agree, any three. The
choice made here is repeatable, and the result says that it was a choice. A regular polygon
is isotropic in its plane however it is turned: the tilted hexagon of I.6.2 too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from earthspin.errors import BodyError
from earthspin.mass._checks import FloatArray
from earthspin.mass.tensor import check_inertia_tensor

#: Moments closer than this, as a fraction of the largest, count as equal.
EQUAL = 1e-13

#: How rounding in a tensor moves its eigenvalues, as a fraction of the largest.
_EIGENVALUE_ERROR = 4 * np.finfo(float).eps


@dataclass(frozen=True)
class PrincipalAxes:
    """Principal moments A <= B <= C and their axes.

    Attributes
    ----------
    moments : ndarray, shape (3,)
        A, B, C, kg m2.
    b_minus_a, c_minus_a, c_minus_b : float
        Differences, from the tensor less its mean moment: they hold more digits than the
        moments' own, kg m2.
    axes : ndarray, shape (3, 3)
        Rows: unit vectors of the axes of A, B and C, right-handed. So `axes` is the rotation
        to the principal frame: v' = axes @ v, and axes @ I @ axes.T is diagonal.
    shape : str
        ``"sphere"`` (A = B = C), ``"oblate"`` (A = B), ``"prolate"`` (B = C) or ``"triaxial"``,
        as the moments have it.
    free : tuple of bool
        For each axis, whether it is only a choice among equals.
    angle_error : float
        How far rounding of the tensor may have turned the axes that are not free, rad.
    """

    moments: FloatArray
    b_minus_a: float
    c_minus_a: float
    c_minus_b: float
    axes: FloatArray
    shape: str
    free: tuple[bool, bool, bool]
    angle_error: float


def principal_axes(tensor: ArrayLike, equal: float = EQUAL) -> PrincipalAxes:
    """Diagonalize an inertia tensor (I.3.1).

    Signs: in each axis the first component above 0.55 in size is positive, and the third axis
    completes a right-handed set. Free axes: the first coordinate axis that stands well off the
    fixed one is projected onto the plane; a sphere keeps the axes that the tensor came in.

    Parameters
    ----------
    tensor : array_like, shape (3, 3)
        kg m2.
    equal : float
        Moments closer than this fraction of the largest count as equal.

    Raises
    ------
    BodyError
        If no body can have the tensor.
    """
    values = check_inertia_tensor(tensor)
    if values.ndim != 2:
        raise BodyError("rigid body", "inertia tensor", values.shape, "give one 3 x 3 tensor")
    mean = float(np.trace(values)) / 3
    # The deviation keeps the digits of the differences of a nearly spherical body.
    deviation, vectors = np.linalg.eigh(values - mean * np.eye(3))
    moments = np.maximum(mean + deviation, 0.0)
    b_minus_a, c_minus_b = (float(gap) for gap in np.diff(deviation))
    same_ab, same_bc = (gap <= equal * moments[2] for gap in (b_minus_a, c_minus_b))
    axes, shape, free = _choose(vectors.T, same_ab, same_bc)
    gaps = [gap for gap, same in ((b_minus_a, same_ab), (c_minus_b, same_bc)) if not same]
    return PrincipalAxes(
        moments=moments,
        b_minus_a=b_minus_a,
        c_minus_a=float(deviation[2] - deviation[0]),
        c_minus_b=c_minus_b,
        axes=axes,
        shape=shape,
        free=free,
        angle_error=float(_EIGENVALUE_ERROR * moments[2] / min(gaps)) if gaps else 0.0,
    )


def _choose(
    axes: FloatArray, same_ab: bool, same_bc: bool
) -> tuple[FloatArray, str, tuple[bool, bool, bool]]:
    """Fix signs, and choose where the moments leave a choice."""
    if same_ab and same_bc:
        return np.eye(3), "sphere", (True, True, True)
    if same_ab:
        pole = _signed(axes[2])
        across = _across(pole)
        return np.stack([across, np.cross(pole, across), pole]), "oblate", (True, True, False)
    if same_bc:
        pole = _signed(axes[0])
        across = _across(pole)
        return np.stack([pole, across, np.cross(pole, across)]), "prolate", (False, True, True)
    first, second = _signed(axes[0]), _signed(axes[1])
    return np.stack([first, second, np.cross(first, second)]), "triaxial", (False, False, False)


def _signed(axis: FloatArray) -> FloatArray:
    """The axis or its opposite; some component of a unit vector always exceeds 0.577."""
    leading = axis[np.argmax(np.abs(axis) > 0.55)]
    return np.asarray(axis * np.sign(leading))


def _across(pole: FloatArray) -> FloatArray:
    """Unit vector at right angles to the pole, from a coordinate axis that is far from it."""
    coordinate = np.eye(3)[np.argmax(np.abs(pole) < 0.6)]
    across = coordinate - pole * np.dot(coordinate, pole)
    return np.asarray(across / np.linalg.norm(across))

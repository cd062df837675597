"""Principal axes and moments of inertia, also if moments are equal (I.3).

If two moments are equal, their axes are arbitrary in their plane; if all three are equal, all axes
are arbitrary. The choice made here is deterministic, and the result marks arbitrary axes. A regular
polygon is isotropic in its plane at any orientation, including the tilted hexagon of I.6.2.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from earthspin.errors import BodyError
from earthspin.mass.tensor import check_inertia_tensor
from earthspin.numerics.arrays import FloatArray

#: Moments closer than this, as a fraction of the largest, count as equal.
EQUAL = 1e-13

#: Error of the eigenvalues from rounding of the tensor, as a fraction of the largest.
_EIGENVALUE_ERROR = 4 * np.finfo(float).eps


@dataclass(frozen=True)
class PrincipalAxes:
    """Principal moments A <= B <= C of a body, and unit vectors along their axes.

    Attributes
    ----------
    moments : ndarray, shape (3,)
        A, B, C, kg m2.
    b_minus_a, c_minus_a, c_minus_b : float
        Differences, kg m2, computed from the tensor minus its mean moment; more accurate than
        differences of `moments`.
    axes : ndarray, shape (3, 3)
        Rows: unit vectors of the axes of A, B and C, right-handed. So `axes` is the rotation
        to the principal frame: v' = axes @ v, and axes @ I @ axes.T is diagonal.
    shape : str
        ``"sphere"`` (A = B = C), ``"oblate"`` (A = B), ``"prolate"`` (B = C) or ``"triaxial"``,
        according to the moments.
    free : tuple of bool
        For each axis, whether it is an arbitrary choice.
    angle_error : float
        Possible rotation of the axes that are not free, due to rounding of the tensor, rad.
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
    """Compute principal moments and axes by diagonalizing an inertia tensor (I.3.1).

    Signs: the first component of each axis that exceeds 0.55 in absolute value is positive, and the
    third axis completes a right-handed set. Free axes: the first coordinate axis at a large angle
    to the fixed one is projected onto the plane; for a sphere the axes are those of the tensor's
    frame.

    Parameters
    ----------
    tensor : array_like, shape (3, 3)
        kg m2.
    equal : float
        Moments closer than this fraction of the largest count as equal.

    Raises
    ------
    BodyError
        If no body can have this tensor.
    """
    values = check_inertia_tensor(tensor)
    if values.ndim != 2:
        raise BodyError("rigid body", "inertia tensor", values.shape, "give one 3 x 3 tensor")
    mean = float(np.trace(values)) / 3
    # Subtracting the mean avoids cancellation in the differences of a nearly spherical body.
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
    """Choose the signs of principal axes, and axes that are arbitrary because moments are equal.

    Return also the kind of body, and which axes are arbitrary.
    """
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
    """Return an axis with the sign that makes its first large component positive.

    A component is large if its absolute value exceeds 0.55.
    """
    leading = axis[np.argmax(np.abs(axis) > 0.55)]
    return np.asarray(axis * np.sign(leading))


def _across(pole: FloatArray) -> FloatArray:
    """Choose a unit vector perpendicular to a given axis, for axes that are arbitrary."""
    coordinate = np.eye(3)[np.argmax(np.abs(pole) < 0.6)]
    across = coordinate - pole * np.dot(coordinate, pole)
    return np.asarray(across / np.linalg.norm(across))

"""Point masses, inertia tensors and principal axes of bodies of any shape (I.1, I.3).

    I = sum of m (r2 1 - r r)        (I.1.3, I.1.5)

A density on a grid is represented by point masses.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from earthspin.errors import BodyError, UndefinedError
from earthspin.numerics.arrays import BoolArray, FloatArray

# --- checks of inputs -----------------------------------------------------------------------------
# Each raises an error with a one-line message.


def positive(body: str, field: str, value: ArrayLike) -> FloatArray:
    """Return numbers as an array; raise an error unless all are finite and positive."""
    values = np.asarray(value, dtype=float)
    wrong = ~(np.isfinite(values) & (values > 0))
    if np.any(wrong):
        raise BodyError(body, field, first_wrong(values, wrong), "it must be finite and above zero")
    return values


def vectors(name: str, value: ArrayLike) -> FloatArray:
    """Return vectors as an array whose last axis is x, y, z; refuse infinite and missing values."""
    values = np.asarray(value, dtype=float)
    if values.ndim == 0 or values.shape[-1] != 3:
        raise UndefinedError(
            f"{name} has the shape {values.shape}; its last axis must hold x, y and z"
        )
    wrong = ~np.isfinite(values)
    if np.any(wrong):
        raise UndefinedError(
            f"{name} holds {first_wrong(values, wrong)}; give finite numbers of metres"
        )
    return values


def degree(name: str, value: Any) -> int:
    """Return the degree or order of a harmonic as an integer; refuse negative and other values."""
    if not isinstance(value, int | np.integer) or value < 0:
        raise UndefinedError(f"{name} = {value!r} is not possible; give an integer of 0 or more")
    return int(value)


def first_wrong(values: FloatArray, wrong: BoolArray) -> float:
    """Return the first element of `values` for which `wrong` is true."""
    return float(values[wrong].flat[0])


# --- point masses and gridded densities -----------------------------------------------------------
# A density that is constant in each cell is replaced by Gauss points inside the cells. With k
# points along each edge every polynomial up to degree 2k - 1 is integrated exactly: two points give
# the exact inertia tensor of the cells, and exterior multipoles up to degree 3.


def point_masses(masses: ArrayLike, positions: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Check point masses and positions, and return them as arrays of matching shapes.

    Parameters
    ----------
    masses : array_like, shape (..., k)
        Positive, kg; a single mass applies to all positions.
    positions : array_like, shape (..., k, 3)
        m.

    Raises
    ------
    BodyError
        If a mass is not positive.
    UndefinedError
        If the shapes do not match.
    """
    places = vectors("positions", positions)
    if places.ndim < 2 or places.shape[-2] == 0:
        raise UndefinedError(f"positions have the shape {places.shape}; give (k, 3), k at least 1")
    weights = positive("point masses", "mass", masses)
    try:
        return np.broadcast_to(weights, places.shape[:-1]), places
    except ValueError:
        raise UndefinedError(
            f"masses have the shape {weights.shape}, positions {places.shape}; "
            f"give one mass for each position"
        ) from None


def centre_of_mass(masses: ArrayLike, positions: ArrayLike) -> FloatArray:
    """Centre of mass of point masses.

    Parameters
    ----------
    masses : array_like, shape (..., k)
        kg.
    positions : array_like, shape (..., k, 3)
        m.

    Returns
    -------
    ndarray, shape (..., 3)
        m.
    """
    m, r = point_masses(masses, positions)
    return np.asarray(np.einsum("...k,...ki->...i", m, r) / np.sum(m, axis=-1)[..., np.newaxis])


def grid_masses(
    density: ArrayLike, x: ArrayLike, y: ArrayLike, z: ArrayLike, points: int = 2
) -> tuple[FloatArray, FloatArray]:
    """Point masses (kg) and positions (m) that represent a density on a Cartesian grid.

    Parameters
    ----------
    density : array_like, shape (nx, ny, nz)
        Density of each cell, kg m-3; zero in empty cells.
    x, y, z : array_like, shapes (nx + 1,), (ny + 1,), (nz + 1,)
        Edges of the cells in increasing order, m.
    points : int
        Gauss points along each edge of a cell.

    Returns
    -------
    masses : ndarray, shape (k,)
        kg; empty cells are omitted.
    positions : ndarray, shape (k, 3)
        m.

    Raises
    ------
    BodyError
        If a density is negative, or all are zero.
    UndefinedError
        If the edges do not increase or do not match the density.
    """
    rho = np.asarray(density, dtype=float)
    edges = [np.asarray(edge, dtype=float) for edge in (x, y, z)]
    _check_grid(rho, edges)
    if points < 1:
        raise UndefinedError(f"points = {points} is not possible; give 1 or more per cell")
    node, weight = np.polynomial.legendre.leggauss(points)
    places = [(e[:-1] + e[1:])[:, None] / 2 + np.diff(e)[:, None] / 2 * node for e in edges]
    lengths = [np.diff(e)[:, None] / 2 * weight for e in edges]
    # Axes: cell along x, point along x, cell along y, ...
    mass = np.einsum("xyz,xa,yb,zc->xaybzc", rho, *lengths)
    grid = np.stack(np.meshgrid(*[p.ravel() for p in places], indexing="ij"), axis=-1)
    full = mass.ravel() > 0
    return mass.ravel()[full], grid.reshape(-1, 3)[full]


def _check_grid(rho: FloatArray, edges: list[FloatArray]) -> None:
    """Raise an error if cell densities or cell edges are invalid, or their sizes do not match."""
    cells = tuple(e.size - 1 for e in edges)
    if rho.shape != cells:
        raise UndefinedError(
            f"density has the shape {rho.shape}, the edges make {cells} cells; "
            f"give one more edge than cells along each axis"
        )
    for name, edge in zip("xyz", edges, strict=True):
        if edge.ndim != 1 or not np.all(np.isfinite(edge)) or np.any(np.diff(edge) <= 0):
            raise UndefinedError(
                f"the edges along {name} do not increase; sort them, without repeats"
            )
    wrong = ~(np.isfinite(rho) & (rho >= 0))
    if np.any(wrong):
        raise BodyError(
            "grid", "density", first_wrong(rho, wrong), "it must be finite and not negative"
        )
    if not np.any(rho):
        raise BodyError("grid", "density", 0.0, "at least one cell must hold mass")


# --- inertia tensors ------------------------------------------------------------------------------
# Construction, change of origin and frame, and derived quantities.

#: Tolerance for rounding errors in a tensor, as a fraction of its largest component.
ROUNDING = 1e-12

_BODY = "rigid body"


def inertia_tensor(
    masses: ArrayLike, positions: ArrayLike, about: ArrayLike | None = None
) -> FloatArray:
    """Inertia tensor of point masses about a given point (I.1.3), kg m2.

    Parameters
    ----------
    masses : array_like, shape (..., k)
        kg.
    positions : array_like, shape (..., k, 3)
        m.
    about : array_like, shape (3,), optional
        Reference point, m; the origin by default.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        kg m2, along the axes of the positions.
    """
    m, r = point_masses(masses, positions)
    if about is not None:
        r = r - vectors("about", about)
    return tensor_of_second_moments(np.einsum("...k,...ki,...kj->...ij", m, r, r))


def tensor_about_point(tensor: ArrayLike, mass: ArrayLike, offset: ArrayLike) -> FloatArray:
    """Inertia tensor about a point, from the tensor about the centre of mass (parallel axes).

    Parameters
    ----------
    tensor : array_like, shape (..., 3, 3)
        About the centre of mass, kg m2.
    mass : array_like
        kg.
    offset : array_like, shape (..., 3)
        From the centre of mass to the point, m.
    """
    m, d = positive(_BODY, "mass", mass), vectors("offset", offset)
    products = np.asarray(d[..., :, np.newaxis] * d[..., np.newaxis, :])
    shift = tensor_of_second_moments(m[..., np.newaxis, np.newaxis] * products)
    return np.asarray(np.asarray(tensor, dtype=float) + shift)


def angular_momentum(tensor: ArrayLike, omega: ArrayLike) -> FloatArray:
    """Angular momentum L = I omega from inertia tensor and angular velocity (I.1.4).

    Parameters
    ----------
    tensor : array_like, shape (..., 3, 3)
        kg m2.
    omega : array_like, shape (..., 3)
        Angular velocity along the same axes, rad/s.

    Returns
    -------
    ndarray, shape (..., 3)
        kg m2/s.
    """
    return np.asarray(np.einsum("...ij,...j->...i", np.asarray(tensor), np.asarray(omega)))


def kinetic_energy(tensor: ArrayLike, omega: ArrayLike) -> FloatArray:
    """Kinetic energy of rotation T = omega . I omega/2, from inertia tensor (I.1.7), J."""
    w = np.asarray(omega, dtype=float)
    return np.asarray(np.sum(w * angular_momentum(tensor, w), axis=-1) / 2)


def moment_about_axis(tensor: ArrayLike, axis: ArrayLike) -> FloatArray:
    """Moment of inertia about a given axis, from the inertia tensor (I.1.10).

    Parameters
    ----------
    tensor : array_like, shape (..., 3, 3)
        About a point on the axis, kg m2.
    axis : array_like, shape (..., 3)
        Direction of the axis, of any nonzero length.

    Returns
    -------
    ndarray, shape (...)
        kg m2.
    """
    direction = vectors("axis", axis)
    length = np.sqrt(np.sum(direction**2, axis=-1))
    if np.any(length == 0):
        raise UndefinedError("axis = [0, 0, 0] has no direction; give a vector along the axis")
    n = direction / length[..., np.newaxis]
    return np.asarray(np.einsum("...i,...ij,...j->...", n, np.asarray(tensor), n))


def change_frame(tensor: ArrayLike, rotation: ArrayLike) -> FloatArray:
    """Components of an inertia tensor in a rotated frame, I' = R I R^T (below I.1.6).

    Parameters
    ----------
    tensor : array_like, shape (..., 3, 3)
        kg m2.
    rotation : array_like, shape (..., 3, 3)
        R, which gives the components of a vector in the new frame, v' = R v.

    Raises
    ------
    UndefinedError
        If R is not orthogonal.
    """
    r = np.asarray(rotation, dtype=float)
    departure = float(np.max(np.abs(r @ np.swapaxes(r, -1, -2) - np.eye(3))))
    if not departure <= ROUNDING:
        raise UndefinedError(
            f"rotation differs from an orthogonal matrix by {departure:.3g}; "
            f"at most {ROUNDING:g} is allowed"
        )
    rotated = r @ np.asarray(tensor, dtype=float) @ np.swapaxes(r, -1, -2)
    return np.asarray((rotated + np.swapaxes(rotated, -1, -2)) / 2)


def check_inertia_tensor(tensor: ArrayLike) -> FloatArray:
    """Return an inertia tensor as an array; raise an error if no body can have it.

    One moment may be zero, for masses on a straight line.

    Parameters
    ----------
    tensor : array_like, shape (..., 3, 3)
        kg m2.

    Raises
    ------
    BodyError
        If it is not symmetric, if a moment is negative or all are zero, or if one moment exceeds
        the sum of the other two, beyond a tolerance of 10^-12 of the largest component.
    """
    values = np.asarray(tensor, dtype=float)
    if values.shape[-2:] != (3, 3) or not np.all(np.isfinite(values)):
        raise BodyError(_BODY, "inertia tensor", values.tolist(), "give 3 x 3 finite numbers")
    scale = np.max(np.abs(values), axis=(-1, -2))
    skew = np.max(np.abs(values - np.swapaxes(values, -1, -2)), axis=(-1, -2))
    _refuse(skew > ROUNDING * scale, "inertia tensor", values, "it must be symmetric")
    moments = np.linalg.eigvalsh(values)
    least, middle, greatest = np.moveaxis(moments, -1, 0)
    wrong = (least < -ROUNDING * scale) | (middle <= ROUNDING * scale)
    allowed = "they must be above zero (one may be zero, for masses on a line)"
    _refuse(wrong, "principal moments", moments, allowed)
    wrong = greatest - middle > least + ROUNDING * scale
    _refuse(wrong, "principal moments", moments, "none may exceed the sum of the other two")
    return values


def _refuse(wrong: FloatArray, field: str, value: FloatArray, allowed: str) -> None:
    """Raise an error that shows the first wrong element of `value`, if any element is wrong."""
    if np.any(wrong):
        raise BodyError(_BODY, field, value[wrong][0].tolist(), allowed)


def tensor_of_second_moments(second: FloatArray) -> FloatArray:
    """Inertia tensor from the second moments of mass (sum of m r r), kg m2.

    Each diagonal element is a sum of two squares, without cancellation.

    Parameters
    ----------
    second : ndarray, shape (..., 3, 3)
        Sum of m r r, kg m2.
    """
    tensor = -second
    xx, yy, zz = (second[..., i, i] for i in range(3))
    for i, moment in enumerate((yy + zz, zz + xx, xx + yy)):
        tensor[..., i, i] = moment
    return tensor


# --- principal axes -------------------------------------------------------------------------------
# If two moments are equal, their axes are arbitrary in their plane; if all three are equal, all
# axes are arbitrary. The choice made here is deterministic, and the result marks arbitrary axes. A
# regular polygon is isotropic in its plane at any orientation, including the tilted hexagon of
# I.6.2.

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
    gaps = [gap for gap, is_equal in ((b_minus_a, same_ab), (c_minus_b, same_bc)) if not is_equal]
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
    """Choose signs of principal axes, and directions of axes that equal moments leave arbitrary.

    Return also the kind of body, and which axes are arbitrary.
    """
    if same_ab and same_bc:
        return np.eye(3), "sphere", (True, True, True)
    if same_ab:
        pole = _signed(axes[2])
        node = _across(pole)
        return np.stack([node, np.cross(pole, node), pole]), "oblate", (True, True, False)
    if same_bc:
        pole = _signed(axes[0])
        node = _across(pole)
        return np.stack([pole, node, np.cross(pole, node)]), "prolate", (False, True, True)
    axis_a, axis_b = _signed(axes[0]), _signed(axes[1])
    return np.stack([axis_a, axis_b, np.cross(axis_a, axis_b)]), "triaxial", (False, False, False)


def _signed(axis: FloatArray) -> FloatArray:
    """Return an axis with the sign that makes its first large component positive.

    A component is large if its absolute value exceeds 0.55.
    """
    leading = axis[np.argmax(np.abs(axis) > 0.55)]
    return np.asarray(axis * np.sign(leading))


def _across(pole: FloatArray) -> FloatArray:
    """Unit vector perpendicular to a given axis, chosen by a fixed rule."""
    coordinate = np.eye(3)[np.argmax(np.abs(pole) < 0.6)]
    projection = coordinate - pole * np.dot(coordinate, pole)
    return np.asarray(projection / np.linalg.norm(projection))

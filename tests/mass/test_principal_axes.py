"""Principal axes: against 50 digits, and the bodies that leave a choice."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from earthspin.errors import BodyError
from earthspin.mass.rings import ring_positions
from earthspin.mass.tensor import PrincipalAxes, change_frame, inertia_tensor, principal_axes
from tests.mass.accuracy import axes_errors, random_tensor
from tests.mass.closeness import close

#: Random tensors; 600 in the full run.
CASES = 40

ROTATIONS = st.tuples(*[st.floats(-3.1, 3.1)] * 3).map(
    lambda angles: Rotation.from_euler("zxz", angles).as_matrix()
)


def _is_a_frame_that_diagonalizes(result: PrincipalAxes, tensor: np.ndarray) -> None:
    axes, scale = result.axes, result.moments[2]
    # Measured over 600 tensors: 2.0e-15, 1.9e-15 and 1.9e-15.
    assert close(axes @ axes.T, np.eye(3), abs=8e-15)
    assert close(np.linalg.det(axes), 1, abs=8e-15)
    diagonal = axes @ tensor @ axes.T
    assert close(diagonal, np.diag(result.moments), abs=8e-15 * scale)
    assert np.all(np.diff(result.moments) >= 0)


def test_against_fifty_digits() -> None:
    """Moments, differences and axes of one tensor, taken as exact.

    Measured over 600 tensors: moments 1.5e-16, differences 9.6e-16 of the largest difference
    (so that a nearly spherical body keeps them), axes 0.07 of the estimate, which also allows
    for rounding in the tensor.
    """
    rng = np.random.default_rng(1)
    for _ in range(CASES):
        tensor = random_tensor(rng)
        result = principal_axes(tensor)
        off = axes_errors(tensor, result)
        assert off.moments <= 1e-15
        assert off.differences <= 5e-15
        assert off.axes <= 0.5
        _is_a_frame_that_diagonalizes(result, tensor)


@given(st.tuples(*[st.floats(1.0, 1.9)] * 3), ROTATIONS)
def test_any_body_in_any_frame(moments: tuple[float, float, float], turn: np.ndarray) -> None:
    tensor = change_frame(np.diag(moments), turn)
    result = principal_axes(tensor)
    _is_a_frame_that_diagonalizes(result, tensor)
    assert close(result.moments, np.sort(moments), rel=5e-15)


def test_axes_that_are_principal_already_stay() -> None:
    result = principal_axes(np.diag([1.0, 2.0, 2.5]))
    assert np.array_equal(result.axes, np.eye(3))
    assert (result.shape, result.free) == ("triaxial", (False, False, False))
    mixed = principal_axes(np.diag([2.5, 1.0, 2.0]))
    assert np.array_equal(mixed.axes, [[0, 1, 0], [0, 0, 1], [1, 0, 0]])


def test_a_sphere_says_that_all_axes_are_free() -> None:
    result = principal_axes(7.0 * np.eye(3))
    assert (result.shape, result.free) == ("sphere", (True, True, True))
    assert np.array_equal(result.axes, np.eye(3))
    assert result.angle_error == 0
    cube = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) / 1.7
    turned = cube @ Rotation.from_euler("zxz", (0.3, 1.1, -2.0)).as_matrix()
    assert principal_axes(inertia_tensor(2.0, turned)).shape == "sphere"


@given(ROTATIONS, st.sampled_from(["oblate", "prolate"]))
def test_a_body_of_revolution_says_which_axes_are_free(turn: np.ndarray, shape: str) -> None:
    moments, pole, free = {
        "oblate": ([2.0, 2.0, 3.0], 2, (True, True, False)),
        "prolate": ([1.0, 2.0, 2.0], 0, (False, True, True)),
    }[shape]
    tensor = change_frame(np.diag(moments), turn)
    result = principal_axes(tensor)
    assert (result.shape, result.free) == (shape, free)
    _is_a_frame_that_diagonalizes(result, tensor)
    assert close(abs(np.dot(result.axes[pole], turn[:, pole])), 1, abs=4e-15)


def test_coordinate_axes_are_chosen_where_they_serve() -> None:
    assert np.array_equal(principal_axes(np.diag([2.0, 2.0, 3.0])).axes, np.eye(3))
    assert np.array_equal(principal_axes(np.diag([1.0, 3.0, 3.0])).axes, np.eye(3))


@given(st.integers(0, 2**32 - 1))
def test_rounding_does_not_move_a_free_choice(seed: int) -> None:
    """The same answer for a tensor that differs in its last digits."""
    rng = np.random.default_rng(seed)
    noise = rng.normal(size=(3, 3)) * 1e-16
    for moments in ([2.0, 2.0, 3.0], [1.0, 2.0, 2.0], [2.0, 2.0, 2.0], [1.0, 1.7, 2.0]):
        tensor = np.diag(moments)
        axes = principal_axes(tensor + noise + noise.T).axes
        assert close(axes, principal_axes(tensor).axes, abs=1e-14)


@pytest.mark.parametrize("count", [3, 4, 5, 6, 7, 12])
@pytest.mark.parametrize("tilt", [0.0, 0.2, np.pi / 4])
def test_a_regular_polygon_is_isotropic_however_it_is_turned(count: int, tilt: float) -> None:
    """Masses at the corners. The source denies it for the tilted hexagon (I.6.2)."""
    tensor = inertia_tensor(1.0, ring_positions(count, 2.0, tilt))
    assert close(tensor, count * np.diag([2.0, 2.0, 4.0]), abs=2e-15 * count * 4)
    result = principal_axes(tensor)
    assert (result.shape, result.free) == ("oblate", (True, True, False))
    assert np.array_equal(result.axes, np.eye(3))


@pytest.mark.parametrize("tilt", [0.0, 0.2, np.pi / 12, np.pi / 6])
def test_the_tilted_hexagonal_plate(tilt: float) -> None:
    """A uniform plate: integral of xy over its triangles is zero at every tilt."""
    corners = ring_positions(6, 1.0, tilt)[:, :2]
    total = np.zeros((2, 2))
    for p, q in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        area, middle = abs(p[0] * q[1] - p[1] * q[0]) / 2, (p + q)
        # Second moments of a triangle with one corner at the origin.
        total += area / 12 * (np.outer(p, p) + np.outer(q, q) + np.outer(middle, middle))
    assert abs(total[0, 1]) < 1e-16 * 5
    assert close(total[0, 0], total[1, 1], rel=2e-15)
    assert close(total[0, 0], 5 * np.sqrt(3) / 16, rel=2e-15)


def test_masses_on_a_line() -> None:
    """A dumbbell has no moment about itself: an answer, not an error."""
    result = principal_axes(inertia_tensor([1.0, 1.0], [[1, 2, 2], [-1, -2, -2]]))
    assert (result.shape, result.free) == ("prolate", (False, True, True))
    assert close(result.moments, [0, 18, 18], abs=1e-14)
    assert close(result.axes[0], np.array([1, 2, 2]) / 3, abs=1e-15)


def test_close_moments_come_with_the_error_of_their_axes() -> None:
    """B - A = 1e-9: the axes are known to a few parts in ten million, and it says so."""
    result = principal_axes(np.diag([1.0, 1.0 + 1e-9, 1.5]))
    assert result.shape == "triaxial"
    assert close(result.b_minus_a, 1e-9, rel=1e-6)
    assert 1e-7 < result.angle_error < 1e-5
    assert principal_axes(np.diag([1.0, 1.0 + 1e-9, 1.5]), equal=1e-8).shape == "oblate"


def test_a_tensor_that_cannot_be() -> None:
    with pytest.raises(BodyError, match=r"\[1\.0, 1\.0, 3\.0\]"):
        principal_axes(np.diag([1.0, 1.0, 3.0]))
    with pytest.raises(BodyError, match="one 3 x 3"):
        principal_axes(np.stack([np.eye(3)] * 2))


def test_the_error_of_axes_is_eight_times_what_rounding_turns_them_by() -> None:
    """Tensors that are exact but for the last rounding, with moments that differ by a millionth.

    Rounding changes each diagonal element by half a unit in the last place, eps/2, which turns an
    axis by eps/2 over the difference of the moments at most; four eps are claimed, since the sums
    that make a tensor round as well.
    """
    rng = np.random.default_rng(3)
    moments = [1 + k * Fraction(1, 10**6) for k in (0, 1, 3)]
    worst = 0.0
    for _ in range(200):
        a, b, c, d = (Fraction(int(n)) for n in rng.integers(-50, 51, 4))
        # columns of a rotation by a quaternion, times its square
        columns = [
            (a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)),
            (2 * (b * c - a * d), a * a - b * b + c * c - d * d, 2 * (c * d + a * b)),
            (2 * (b * d + a * c), 2 * (c * d - a * b), a * a - b * b - c * c + d * d),
        ]
        size = (a * a + b * b + c * c + d * d) ** 2
        products = [
            [sum(m * v[i] * v[j] for m, v in zip(moments, columns, strict=True)) for j in range(3)]
            for i in range(3)
        ]
        found = principal_axes([[float(value / size) for value in row] for row in products])
        exact = np.array(columns, dtype=float) / float(size) ** 0.5
        turned = np.linalg.norm(np.cross(found.axes, exact), axis=1)
        worst = max(worst, float(turned.max()) / found.angle_error)
    assert 0.08 < worst < 0.13

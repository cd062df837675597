"""From where mass lies to J2, J3, J4 and the principal axes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from earthspin.errors import BodyError, UndefinedError
from earthspin.mass.figure import spheroid_moments
from earthspin.mass.shape import Shape
from tests.mass.solids import ball, brick
from tests.mass.spheroid_reference import spheroid_zonals

#: What is left of moments, J2 and J4 at 20,000 vertices: 1.9e-4, 1.8e-4 and 4.5e-4.
LEFT = 6e-4
SIDES = (3.0, 2.0, 1.0)
ANGLES = st.tuples(*[st.floats(-3.1, 3.1)] * 3)


def of_brick(turn: np.ndarray, shift: np.ndarray) -> Shape:
    vertices, faces = brick(*SIDES)
    return Shape.of_mesh(vertices @ turn.T + shift, faces, density=1000.0)


def test_a_brick_by_mesh_and_by_grid_has_the_textbooks_moments() -> None:
    """m (b^2 + c^2)/12; J4 = -(35 <z^4> - 30 <z^2 r^2> + 3 <r^4>)/8 by hand."""
    x, y, z = SIDES
    mass = 1000.0 * x * y * z
    moments = mass / 12 * np.array([y * y + z * z, x * x + z * z, x * x + y * y])
    m2, m4 = np.array(SIDES) ** 2 / 12, np.array(SIDES) ** 4 / 80
    r4 = m4.sum() + 2 * (m2[0] * m2[1] + m2[1] * m2[2] + m2[0] * m2[2])
    z2r2 = m4[2] + m2[2] * (m2[0] + m2[1])
    a = np.linalg.norm(SIDES) / 2
    j4 = -(35 * m4[2] - 30 * z2r2 + 3 * r4) / (8 * a**4)
    mesh = of_brick(np.eye(3), np.zeros(3))
    cells = np.full((3, 2, 1), 1000.0)
    grid = Shape.of_density(cells, [0, 1, 2.5, 3], [0, 0.3, 2], [0, 1])
    for found in (mesh, grid):
        assert found.mass == pytest.approx(mass, rel=1e-14, abs=0)
        assert found.centre == pytest.approx(np.array(SIDES) / 2, rel=1e-14, abs=0)
        assert found.principal.moments == pytest.approx(moments, rel=1e-14, abs=0)
        assert found.radius == pytest.approx(a, rel=1e-14, abs=0)
        assert found.j4 == pytest.approx(j4, rel=1e-13, abs=0)
        assert abs(found.j3) < 1e-15
        assert found.triaxiality == pytest.approx((x * x - y * y) / 12 / a**2, rel=1e-13, abs=0)


@settings(max_examples=40)
@given(ANGLES, st.tuples(*[st.floats(-5, 5)] * 3).map(np.array))
def test_axes_and_place_of_a_solid_do_not_change_its_figure(
    angles: tuple[float, float, float], shift: np.ndarray
) -> None:
    turn = Rotation.from_euler("zxz", angles).as_matrix()
    still, found = of_brick(np.eye(3), np.zeros(3)), of_brick(turn, shift)
    assert found.principal.moments == pytest.approx(still.principal.moments, rel=1e-12, abs=0)
    assert found.j2 == pytest.approx(still.j2, rel=1e-12, abs=0)
    assert found.j4 == pytest.approx(still.j4, rel=1e-11, abs=0)
    assert found.centre == pytest.approx(turn @ still.centre + shift, rel=0, abs=1e-12)
    along = np.abs(found.principal.axes @ turn)
    assert along == pytest.approx(np.eye(3), rel=0, abs=1e-12)


def test_a_ring_of_masses_has_the_potential_of_a_ring() -> None:
    """P2(0) = -1/2, P4(0) = 3/8."""
    turn = 2 * np.pi * np.arange(7) / 7
    ring = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=-1)
    found = Shape.of_masses(np.full(7, 2.0), 500.0 * ring)
    assert (found.j2, found.j3, found.j4) == pytest.approx((0.5, 0, -0.375), rel=0, abs=1e-15)
    assert found.dynamical_flattening == pytest.approx(0.5, rel=1e-14, abs=0)
    assert found.principal.shape == "oblate"


def test_j3_has_the_sign_of_geodesy_about_the_axis_that_is_named() -> None:
    """A heavy mass north of many at the equator: <z (5 z^2 - 3 r^2)> by hand."""
    turn = 2 * np.pi * np.arange(12) / 12
    ring = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=-1)
    masses, places = np.append(np.ones(12), 0.4), np.vstack([ring, [0.0, 0.0, 0.7]])
    found = Shape.of_masses(masses, places)
    height = places[:, 2] - 0.4 * 0.7 / 12.4
    square = np.append(np.ones(12), 0.0) + height**2
    j3 = -(masses @ (height * (5 * height**2 - 3 * square))) / 2 / 12.4 / found.radius**3
    assert found.principal.axes[2] == pytest.approx([0, 0, 1], rel=0, abs=1e-15)
    assert found.j3 == pytest.approx(j3, rel=1e-13, abs=0)
    assert j3 < 0


def test_a_mesh_of_a_spheroid_comes_close_to_the_spheroid() -> None:
    """The moments as one over the number of vertices, which is what facets cut off."""
    off = {}
    for count in (1250, 5000, 20_000):
        vertices, faces = ball(count, (1.0, 1.0, 0.9))
        found = Shape.of_mesh(vertices, faces, mass=5.0, radius=1.0)
        exact = spheroid_moments(5.0, 1.0, 0.1)
        j2, j4 = spheroid_zonals(0.1, 4)[[2, 4]]
        assert found.mass == pytest.approx(5.0, rel=1e-13, abs=0)
        off[count] = [
            float(found.principal.moments[2] / exact.polar) - 1,
            found.j2 / j2 - 1,
            found.j4 / j4 - 1,
        ]
    for many, more in ((1250, 5000), (5000, 20_000)):
        assert off[many][0] / off[more][0] == pytest.approx(4, rel=0.05, abs=0)
    assert np.max(np.abs(off[20_000])) < LEFT


def test_many_triangles_come_in_pieces_and_add_up(monkeypatch: pytest.MonkeyPatch) -> None:
    vertices, faces = ball(500)
    whole = Shape.of_mesh(vertices, faces, density=1.0)
    monkeypatch.setattr("earthspin.mass.shape.AT_ONCE", 100)
    pieces = Shape.of_mesh(vertices, faces, density=1.0)
    assert pieces.mass == pytest.approx(whole.mass, rel=1e-14, abs=0)
    assert pieces.principal.moments == pytest.approx(whole.principal.moments, rel=1e-13, abs=0)


def test_what_is_no_solid_is_refused() -> None:
    vertices, faces = brick(*SIDES)
    with pytest.raises(BodyError, match="density or mass"):
        Shape.of_mesh(vertices, faces)
    with pytest.raises(BodyError, match="either density or mass"):
        Shape.of_mesh(vertices, faces, density=1.0, mass=1.0)
    with pytest.raises(BodyError, match="density = -1"):
        Shape.of_mesh(vertices, faces, density=-1.0)
    with pytest.raises(BodyError, match="principal moments"):
        Shape.of_masses([1.0], [[1.0, 2.0, 3.0]])
    with pytest.raises(BodyError, match="give \\(k, 3\\)"):
        Shape.of_masses(np.ones((2, 2)), np.ones((2, 2, 3)))
    with pytest.raises(UndefinedError, match="do not increase"):
        Shape.of_density(np.ones((1, 1, 1)), [0, 1], [0, 1], [1, 0])

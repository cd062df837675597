"""Solids between triangles: exact integrals, and meshes that enclose nothing."""

import numpy as np
import pytest

from earthspin.errors import BodyError, UndefinedError
from earthspin.mass.shape import closed_mesh, solid_points
from tests.mass.solids import brick
from tests.refusals import refused

CORNERS = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
FACES = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
POWERS = [(a, b, c) for a in range(6) for b in range(6 - a) for c in range(6 - a - b)]


def factorial(n: int) -> float:
    return float(np.prod(np.arange(1, n + 1)))


@pytest.mark.parametrize("powers", POWERS)
def test_polynomials_of_degree_five_are_exact_over_a_tetrahedron(
    powers: tuple[int, int, int],
) -> None:
    """Integral of x^a y^b z^c over the corner of a cube: a! b! c!/(a + b + c + 3)!."""
    ((volumes, places),) = solid_points(CORNERS, FACES, sum(powers))
    found = float(volumes @ np.prod(places**powers, axis=1))
    exact = np.prod([factorial(n) for n in powers]) / factorial(sum(powers) + 3)
    assert found == pytest.approx(exact, rel=1e-13, abs=0)  # 6e-15 found


@pytest.mark.parametrize("powers", [(2, 2, 0), (4, 0, 1), (1, 1, 3), (0, 0, 0)])
@pytest.mark.parametrize("apart", [0.0, 3.0])
def test_polynomials_over_a_brick_seen_from_within_and_without(
    powers: tuple[int, int, int], apart: float
) -> None:
    vertices, faces = brick(3.0, 2.0, 1.0)
    total = sum(
        float(volumes @ np.prod((places - apart) ** powers, axis=1))
        for volumes, places in solid_points(vertices + apart, faces, sum(powers))
    )
    exact = np.prod([side ** (n + 1) / (n + 1) for side, n in zip((3, 2, 1), powers, strict=True)])
    assert total == pytest.approx(exact, rel=1e-11, abs=0)


def test_what_is_closed_is_taken_as_it_is() -> None:
    vertices, faces = closed_mesh(CORNERS.tolist(), FACES.tolist())
    assert np.array_equal(vertices, CORNERS)
    assert np.array_equal(faces, FACES)


TURNED = np.concatenate([FACES[:3], FACES[3:, ::-1]])


test_what_encloses_no_solid_is_refused = refused(
    (FACES[:3], "3 edges with one triangle"),
    (TURNED, "opposite orientation"),
    (FACES[:, ::-1], "inside out"),
    (np.concatenate([FACES, FACES]), "an edge of more than two triangles"),
    (FACES + 1, "one of the 4 vertices, counted from 0"),
    (FACES - 1, "one of the 4 vertices, counted from 0"),
    (FACES[:0], "0 triangles"),
    (FACES[:, :2], "three whole numbers for each triangle"),
    (FACES.astype(float), "three whole numbers for each triangle"),
    call=lambda faces: closed_mesh(CORNERS, faces),
    kind=BodyError,
)


def test_vertices_are_finite() -> None:
    with pytest.raises(UndefinedError, match="vertices holds nan"):
        closed_mesh(np.where(CORNERS == 1, np.nan, CORNERS), FACES)

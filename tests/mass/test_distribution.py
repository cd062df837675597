"""Point masses and grids."""

import numpy as np

from earthspin.errors import BodyError, UndefinedError
from earthspin.mass.figure import spheroid_moments
from earthspin.mass.tensor import centre_of_mass, grid_masses, inertia_tensor
from tests.mass.closeness import close
from tests.refusals import refused


def test_the_centre_of_mass() -> None:
    assert np.array_equal(centre_of_mass([1.0, 3.0], [[0, 0, 0], [4, 8, -4]]), [3, 6, -3])


def test_a_brick_in_uneven_cells_is_exact() -> None:
    """Textbook moments of a brick 2 x 3 x 5 about its corner and its centre (measured: 4e-16)."""
    x, y, z = [0.0, 0.7, 2.0], [0.0, 1.0, 2.5, 3.0], [0.0, 5.0]
    masses, positions = grid_masses(np.full((2, 3, 1), 4.0), x, y, z)
    mass = 4.0 * 30
    assert close(np.sum(masses), mass, rel=2e-15)
    centre = mass / 12 * np.diag([34.0, 29.0, 13.0])
    found = inertia_tensor(masses, positions, about=[1.0, 1.5, 2.5])
    assert close(found, centre, rel=2e-15, abs=2e-14)
    corner = inertia_tensor(masses, positions)
    assert close(corner[0, 0], mass / 3 * 34, rel=3e-15)
    assert close(corner[0, 1], -mass / 4 * 6, rel=3e-15)


def test_one_point_a_cell_misses_the_cells_own_moment() -> None:
    edge = np.array([-1.0, 1.0])
    one = inertia_tensor(*grid_masses([[[1.0]]], edge, edge, edge, points=1))
    assert np.array_equal(one, np.zeros((3, 3)))


def test_a_spheroid_on_a_grid_comes_close() -> None:
    """Steps in the surface leave 1e-3 at 60 cells (measured: 3.1e-4)."""
    edges = np.linspace(-1, 1, 61)
    middle = (edges[1:] + edges[:-1]) / 2
    x, y, z = np.meshgrid(middle, middle, middle, indexing="ij")
    inside = (x**2 + y**2 + (z / 0.7) ** 2 < 1).astype(float)
    masses, positions = grid_masses(inside, edges, edges, edges, points=1)
    found = inertia_tensor(masses, positions)
    known = spheroid_moments(float(np.sum(masses)), 1.0, 0.3)
    assert close(found[2, 2], known.polar, rel=3e-3)
    assert close(found[0, 0], known.equatorial, rel=3e-3)
    assert close(found[2, 2] - found[0, 0], known.difference, rel=1e-2)


def test_empty_cells_are_left_out() -> None:
    edge = np.array([0.0, 1.0, 2.0])
    density = np.zeros((2, 2, 2))
    density[1, 0, 1] = 3.0
    masses, positions = grid_masses(density, edge, edge, edge)
    assert masses.size == 8
    assert close(np.sum(masses), 3.0, rel=1e-15)
    assert close(centre_of_mass(masses, positions), [1.5, 0.5, 1.5], abs=4e-16)


EDGE = [0.0, 1.0]


test_grids_that_cannot_be = refused(
    (([[[-1.0]]], EDGE, EDGE, EDGE), BodyError, r"density = -1\.0"),
    (([[[0.0]]], EDGE, EDGE, EDGE), BodyError, r"density = 0\.0.*at least one cell"),
    (([[[np.nan]]], EDGE, EDGE, EDGE), BodyError, "density = nan"),
    (([[[1.0]]], [0.0, 1.0, 2.0], EDGE, EDGE), UndefinedError, r"make \(2, 1, 1\) cells"),
    (([[[1.0]]], EDGE, [1.0, 0.0], EDGE), UndefinedError, "edges along y do not increase"),
    (([[[1.0]]], EDGE, EDGE, EDGE, 0), UndefinedError, "points = 0"),
    call=lambda arguments: grid_masses(*arguments),
)

"""Bodies from point masses, grids, meshes and layers, and what is asked of them."""

from pathlib import Path

import astropy.units as u
import numpy as np
import pytest
import trimesh

import earthspin
from earthspin import Body
from earthspin.errors import BodyError, EarthspinError, MissingExtraError, SeriesError, Where
from tests.mass.solids import brick
from tests.refusals import refused

#: Sides of a brick, m.
SIDES = (3.0, 2.0, 1.0)
MOMENTS = np.array([5.0, 10.0, 13.0]) * 1000.0


def test_a_brick_is_the_same_by_mesh_and_by_grid_in_any_unit() -> None:
    vertices, faces = brick(*SIDES)
    by_mesh = Body.from_mesh((vertices, faces), density="2 g/cm3", spin_period="5 h")
    by_grid = Body.from_density(
        np.full((1, 1, 1), 2.0) * u.g / u.cm**3, [0, 3] * u.m, [0, 200] * u.cm, [0.0, 1.0]
    )
    in_km = Body.from_mesh((vertices / 1000, faces), mass=12 * u.t, unit="km")
    for body in (by_mesh, by_grid, in_km):
        assert body.moments == pytest.approx(MOMENTS, rel=1e-13, abs=0)
        assert body.mass == pytest.approx(12_000.0, rel=1e-13, abs=0)
    assert by_mesh.spin_period == 18_000.0


@pytest.mark.parametrize("ending", ["stl", "obj", "ply", "off"])
def test_a_mesh_from_a_file(tmp_path: Path, ending: str) -> None:
    """STL repeats each corner for each triangle, and keeps four bytes of each number."""
    file = tmp_path / f"brick.{ending}"
    trimesh.Trimesh(*brick(*SIDES), process=False).export(file)
    body = Body.from_mesh(file, density=2000.0, name="brick")
    assert body.moments == pytest.approx(MOMENTS, rel=1e-6, abs=0)
    assert body.name == "brick"


def test_a_mesh_of_trimesh_is_taken_as_it_is() -> None:
    body = Body.from_mesh(trimesh.creation.box((3.0, 2.0, 1.0)), density=2000.0)
    assert body.moments == pytest.approx(MOMENTS, rel=1e-13, abs=0)


def test_moments_of_a_body_are_those_it_was_made_of() -> None:
    body = earthspin.EARTH
    a, b, c = body.moments
    scale = body.mass * body.radius**2
    # C/(M a2) = 0.330701, (B - A)/C = 2.196e-5 (Groten 2004, J. Geod. 77, 724 (not verified))
    assert c / scale == pytest.approx(0.330701, rel=2e-5, abs=0)
    assert (b - a) / c == pytest.approx(2.196e-5, rel=1e-3, abs=0)
    assert body.replace(moments=[a, b, c]).j2 == pytest.approx(body.j2, rel=1e-12, abs=0)


def test_a_brick_turned_about_its_middle_axis_tips_over() -> None:
    """From a shape straight into a free rotor: the third component changes its sign (I.6)."""
    rock = Body.from_density([[[2000.0]]], [0.0, 3.0], [0.0, 2.0], [0.0, 1.0])
    turning = earthspin.free_rotor(rock.moments, [1e-3, 1.0, 1e-3], np.linspace(0, 60, 601))
    about_middle = turning.omega_body.isel(component=1)
    assert float(about_middle.min()) < -0.99
    steady = earthspin.free_rotor(rock.moments, [1e-3, 1e-3, 1.0], np.linspace(0, 60, 601))
    assert float(steady.omega_body.isel(component=2).min()) > 0.99


def test_hydrostatic_layers_have_the_earths_hydrostatic_figure() -> None:
    """1/299.8 and 1072.7e-6 (Nakiboglu 1982, PEPI 28, 302), of second order; ours is of first."""
    body = Body.from_layers("prem", spin_period=86164.1, name="liquid")
    assert 1 / body.flattening == pytest.approx(299.8, rel=2e-3, abs=0)
    assert body.j2 == pytest.approx(1.0727e-3, rel=3e-3, abs=0)
    assert body.name == "liquid"
    moment = body.j2 / body.dynamical_flattening
    assert moment == pytest.approx(0.3308, rel=3e-3, abs=0)


def test_a_body_that_was_made_stands_in_a_scene() -> None:
    vertices, faces = brick(*SIDES)
    body = Body.from_mesh((vertices, faces), density=2000.0, pole=("10 deg", "60 deg"))
    assert Body.read(body.write(), Where("body")) == body


test_what_makes_no_body_is_refused_in_one_line = refused(
    (lambda: Body.from_mesh("brick.stl", density=1.0), "there is no such file"),
    (lambda: Body.from_mesh("brick.doc", density=1.0), "not a mesh format"),
    (lambda: Body.from_mesh(3, density=1.0), "give a file, a Trimesh, or"),
    (lambda: Body.from_mesh(brick(1, 1, 1), density="3 m"), "density"),
    (lambda: Body.from_mesh(brick(1, 1, 1), density=1.0, unit="s"), "unit"),
    (lambda: Body.from_mesh(brick(1, 1, 1)), "either density or mass"),
    (lambda: Body.from_mesh(brick(1, 1, 1), density=1.0, colour=1), "colour"),
    (lambda: Body.from_layers("pram", spin_period="1 d"), "prem"),
    (lambda: Body.from_masses([1, -1], [[0, 0, 0], [1, 0, 0]]), "above zero"),
    (lambda: Body(name="x", gm=1.0).moments, "j2"),
    (lambda: Body(name="x", gm=1, j2=0.0, radius=1.0, dynamical_flattening=0.0).moments, "C"),
)


def test_a_file_of_nothing_is_refused(tmp_path: Path) -> None:
    for ending, words in (("stl", "x" * 10), ("obj", ""), ("ply", "ply\nformat nonsense\n")):
        file = tmp_path / f"nothing.{ending}"
        file.write_text(words)
        with pytest.raises((SeriesError, BodyError)):
            Body.from_mesh(file, density=1.0)


def test_without_trimesh_the_extra_is_named(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setitem(__import__("sys").modules, "trimesh", None)
    with pytest.raises(MissingExtraError, match="mesh"):
        Body.from_mesh(tmp_path / "a.stl", density=1.0)


def test_a_body_takes_its_numbers_with_their_units() -> None:
    told = Body(name="x", gm="4e14 m3/s2", radius=6400 * u.km, pole=("10 deg", "60 deg"))
    plain = Body(name="x", gm=4e14, radius=6.4e6, pole=tuple(np.radians([10.0, 60.0]).tolist()))
    assert told == plain
    with pytest.raises(EarthspinError, match="gm"):
        Body(name="x", gm="4e14 m2")

"""The questions of the rotor, the top and the spheroid, asked as a user would."""

import numpy as np
import pytest

import earthspin
from earthspin import EARTH, Scene
from earthspin.rotor.euler import integrate_rotation
from earthspin.scenes import QUESTIONS
from earthspin.top.start import HeavyTop
from tests.reference.heavy_top import integrate_heavy_top
from tests.refusals import refused

TIMES = np.linspace(0.0, 20.0, 41)
TOP = {
    "transverse_moment": 1.0,
    "axial_moment": 1.2,
    "weight_moment": 1.5,
    "theta": 0.7,
    "spin": 3.0,
    "phi_rate": 0.3,
}


def test_free_rotor_against_the_full_equations() -> None:
    result = earthspin.free_rotor([2.0, 1.0, 3.0], [0.3, 1.0, 0.1], TIMES)
    numeric = integrate_rotation([2.0, 1.0, 3.0], [0.3, 1.0, 0.1], TIMES)
    assert np.allclose(result.omega_body, numeric.omega_body, rtol=0, atol=1e-12)
    assert np.allclose(result.attitude, numeric.attitude, rtol=0, atol=1e-12)
    assert np.ptp(result.energy.values) < 1e-15 * float(result.energy[0]) * 4
    assert result.attrs["compute"] == "free-rotor"
    assert list(result.quaternion.values) == ["w", "x", "y", "z"]
    momentum = np.linalg.norm(result.angular_momentum_body, axis=1)
    assert np.ptp(momentum) < 4e-15


def test_differences_keep_their_digits() -> None:
    """A cone of one microarcsecond on a body like the Earth, from differences of moments."""
    moments = {"A": 8.0e37, "B-A": 1.7e33, "C-A": 2.6e35}
    cone = np.radians(1e-6 / 3600)
    period = 86164.0 * 8.0e37 / 2.6e35
    result = earthspin.free_rotor(moments, [7.29e-5 * cone, 0.0, 7.29e-5], [0.0, period / 2])
    assert float(result.omega_body[1, 0]) == pytest.approx(-7.29e-5 * cone, rel=0.05, abs=0)


def test_several_starts_at_once() -> None:
    starts = [[0.3, 1.0, 0.1], [0.0, 0.0, 1.0]]
    many = earthspin.free_rotor([1.0, 2.0, 3.0], starts, TIMES)
    one = earthspin.free_rotor([1.0, 2.0, 3.0], starts[0], TIMES)
    assert many.omega_body.dims == ("time", "component", "start")
    assert np.array_equal(many.omega_body.isel(start=0), one.omega_body)
    assert "polhode" in earthspin.run_tree(one)["poinsot"]
    assert "poinsot" not in earthspin.run_tree(many)


@pytest.mark.parametrize(
    ("moments", "omega"),
    [
        ([3.0, 4.0, 6.0], [2.0, 0.0, 1.0]),  # on the separatrix
        ([1.0, 2.0, 3.0], [0.0, 1.0, 0.0]),  # about the middle axis
        ([2.0, 2.0, 2.0], [0.3, 0.4, 0.5]),  # a sphere
    ],
)
def test_a_polhode_without_a_period_has_no_advance(moments: list, omega: list) -> None:
    from earthspin.views.rendering import tables_for

    scene = Scene(compute="free-rotor", rotor={"moments": moments, "omega": omega, "times": TIMES})
    tree = earthspin.run_tree(scene)
    result = tree.to_dataset()
    numeric = integrate_rotation(moments, omega, TIMES)
    # omega falls off the middle axis in e-foldings, as errors of the integrator grow
    assert np.allclose(result.attitude, numeric.attitude, rtol=0, atol=1e-6)
    assert np.isposinf(tree["poinsot"].polhode_period)
    assert "herpolhode_advance" not in tree["poinsot"]
    single = [table for table in tables_for(tree) if table.headers == ("quantity", "value")]
    rows = dict(row for table in single for row in table.rows)
    assert rows["period of the polhode, s"] == "infinite"


def test_heavy_top_against_the_full_equations() -> None:
    result = earthspin.heavy_top(TIMES, **TOP)
    numeric = integrate_heavy_top(HeavyTop(**TOP), TIMES)
    assert np.allclose(result.attitude, numeric.attitude, rtol=0, atol=5e-11)
    assert str(result.pattern.values) == "wave"
    turning = earthspin.run_tree(result, "turning")["turning/turning_angle"]
    assert result.theta.min() >= turning[0] - 1e-12
    assert result.theta.max() <= turning[1] + 1e-12


@pytest.mark.parametrize(
    ("scene", "pattern"),
    [
        ("top-wave", "wave"),
        ("top-cusp", "cusp"),
        ("top-loop", "loop"),
        ("sleeping-top", "sleeping"),
    ],
)
def test_shipped_tops(scene: str, pattern: str) -> None:
    assert str(earthspin.run(scene).pattern.values) == pattern


def test_the_racket_turns_over() -> None:
    result = earthspin.run_tree("tennis-racket")
    middle = result.omega_body.sel(component="y")
    assert float(middle.min()) < -0.99
    assert float(middle.max()) > 0.99
    assert np.argmax(result["poinsot"].growth_rate.values) == 1


def test_spheroid_field_far_away_is_maccullaghs() -> None:
    position = np.array([[3.5e8, 0.0, 1.6e8]])
    result = earthspin.spheroid_field(position, point_mass=7.346e22)
    difference = 0.2 * EARTH.mass * (EARTH.radius**2) * (1 - (1 - EARTH.flattening) ** 2)
    r = np.linalg.norm(position)
    x, _, z = position[0]
    expected = -3 * 6.67430e-11 * 7.346e22 * difference * z * x / r**5
    assert float(result.torque.sel(component="y")[0]) == pytest.approx(expected, rel=1e-5, abs=0)
    assert result.torque.attrs["frame"]


ROTOR = {"moments": ["1 kg m2", "1.7 kg m2", "2 kg m2"], "omega": ["0 rad/s", "1 rad/s", "1 rad/s"]}
TOP_TABLE = {
    "transverse_moment": "1 kg m2",
    "axial_moment": "1.2 kg m2",
    "weight_moment": "1.5 N m",
    "theta": "40 deg",
    "spin": "3 rad/s",
}
test_what_is_wrong_is_named = refused(
    ("free-rotor", "rotor", ROTOR | {"moments": ["1 kg m2", "1 kg m2", "3 kg m2"]}, "moment"),
    ("free-rotor", "rotor", ROTOR | {"omega": ["0 rad/s"] * 3}, "angular"),
    ("free-rotor", "rotor", ROTOR | {"omga": 1}, "did you mean 'omega'"),
    ("free-rotor", "rotor", ROTOR | {"points": 0}, "1 or more"),
    ("free-rotor", "rotor", {"omega": ROTOR["omega"]}, "rotor.moments = None: required"),
    ("free-rotor", "rotor", ROTOR | {"moments": {"A": 1, "B": 2, "C": 3}}, "A, B-A, C-A"),
    ("top", "top", TOP_TABLE | {"theta": "200 deg"}, "theta"),
    ("top", "top", TOP_TABLE | {"axial_moment": "3 kg m2"}, "axial_moment"),
    ("top", "top", TOP_TABLE | {"spin": None}, "top.spin"),
    ("spheroid", "spheroid", {}, "spheroid.position"),
    ("wobble", "top", {}, "no such key"),
    call=lambda word, name, table: earthspin.run(
        QUESTIONS[word].from_table({name: table}, source="my.toml")
    ),
)

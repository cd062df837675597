"""A body with its neighbours: each with one uncertain number changed."""

import numpy as np
from scipy.spatial.transform import Rotation

from earthspin.bodies import EARTH
from earthspin.constants import DAY
from earthspin.motion.axes import axis_path
from earthspin.motion.effects import EFFECTS, RIGID
from earthspin.motion.forces import DynamicalFigure, Forces
from earthspin.motion.solution import (
    FLATTENING,
    TIDE,
    TRIAXIALITY,
    AttitudeIntegrator,
    masses,
    relative_tide_error,
    rigid_bodies,
    shares_of,
    start_of,
    upright,
)
from earthspin.sky.ephemeris import Ephemeris
from tests.motion.kepler import AS_SKY, Ellipse, angle
from tests.motion.sky import CODES, GM, NORTH, UAS, figure, forces

FIGURE = DynamicalFigure(h=0.2, spin_rate=1.0, triaxiality=0.1)


def test_each_neighbour_has_one_number_changed() -> None:
    bare = Forces(figure=FIGURE, gm={}, positions=lambda times: {})
    body, changed = rigid_bodies(
        bare, 1.0, {FLATTENING: 0.01, TRIAXIALITY: 0.02, TIDE: float("nan")}
    )
    assert changed == (FLATTENING, TRIAXIALITY)
    h = (body.c_minus_a + body.c_minus_b) / 2
    np.testing.assert_allclose(h, [0.2, 0.202, 0.2], rtol=1e-15, atol=0)
    difference = body.c_minus_a - body.c_minus_b
    np.testing.assert_allclose(difference, [0.1, 0.101, 0.102], rtol=1e-14, atol=0)
    assert np.array_equal(body.tide, np.ones(3))


def test_what_a_neighbour_is_away_by_is_what_the_number_does() -> None:
    """Against a second run with that number."""
    orbit, times = Ellipse(0.1), np.linspace(0.0, 20.0, 801)
    pulled = Forces(
        figure=FIGURE, gm={"mass": 1.0}, positions=lambda t: {"mass": orbit.at(t)}, near=("mass",)
    )
    half_widths = {FLATTENING: 1e-3, TIDE: 2e-3}

    def follow(half_widths: dict[str, float], **changed: float) -> AttitudeIntegrator:
        numbers = {"h": 0.2, "triaxiality": 0.1} | changed
        made = Forces(
            figure=DynamicalFigure(spin_rate=1.0, **numbers),
            gm={"mass": changed.pop("gm", 1.0)},
            positions=pulled.positions,
            near=("mass",),
        )
        body, _ = rigid_bodies(made, 1.0, half_widths)
        return AttitudeIntegrator(
            body, masses(made), start_of(body, AS_SKY, np.array([0.1, 0.0, 1.1])), 20.0
        )

    found = follow(half_widths).at(times)
    other = follow({}, h=0.2 * 1.001, triaxiality=0.1 * 1.001).at(times)
    shares = shares_of(found, (FLATTENING, TIDE), 2e-3)
    away = np.maximum.accumulate(angle(found.attitude, other.attitude))
    # the largest so far, between these times too
    np.testing.assert_allclose(shares["input"][0][40:], away[40:], rtol=0.02, atol=0)
    assert np.all(shares["kernel"][0][1:] > 0)
    assert np.isnan(shares_of(found, (FLATTENING, TIDE), float("nan"))["kernel"]).all()
    together = np.sqrt(sum(shares[of] ** 2 for of in ("method", "input", "kernel")))
    np.testing.assert_allclose(shares[""], together, rtol=1e-14, atol=0)


def test_the_doubt_of_a_pull_is_that_of_a_tide() -> None:
    """Tides of a mass that is nearer, and of one that is turned, each by its error."""
    one, spectral = np.array([1.0, 0.0, 0.0]), 2
    for error, moved in (
        (relative_tide_error(1.0, 1e-6, 0.0), np.array([1 + 1e-6, 0.0, 0.0])),
        (relative_tide_error(1.0, 0.0, 1e-6), np.array([np.cos(1e-6), np.sin(1e-6), 0.0])),
    ):
        tides = [np.outer(r, r) / np.linalg.norm(r) ** 5 for r in (one, moved)]
        off = np.linalg.norm(tides[1] - tides[0], spectral)
        assert 0.4 * error < off < 1.0001 * error


def test_a_body_stands_upright_where_it_is_told() -> None:
    axis = np.array([0.3, -0.4, 0.866])
    axis /= np.linalg.norm(axis)
    matrix = Rotation.from_quat(upright(axis, 0.0), scalar_first=True).as_matrix()
    np.testing.assert_allclose(matrix[:, 2], axis, rtol=0, atol=1e-15)
    # its first axis is x, projected on the equator
    x = np.array([1.0, 0.0, 0.0]) - axis[0] * axis
    np.testing.assert_allclose(matrix[:, 0], x / np.linalg.norm(x), rtol=0, atol=1e-15)
    turned = Rotation.from_quat(upright(axis, 0.5), scalar_first=True).as_matrix()
    np.testing.assert_allclose(turned[:, 0] @ matrix[:, 0], np.cos(0.5), rtol=1e-14, atol=0)
    np.testing.assert_allclose(turned[:, 0] @ matrix[:, 1], np.sin(0.5), rtol=1e-14, atol=0)


def test_the_earth_with_all_effects_against_the_solver_of_the_pole(de421: Ephemeris) -> None:
    """Three axes of the slow manifold, and the attitude turn by turn, over ten days."""
    days = 10.0
    made = forces(de421, figure(radius=EARTH.radius, inverse_polar_moment=3.024), near=tuple(GM))
    for name in RIGID:
        if name != "planets":
            made = EFFECTS[name].switch_on(made, EARTH)
    assert set(made.gm) == set(CODES)
    times = np.linspace(0.0, days * DAY, 41)
    path = axis_path(made, NORTH, 0.0, (0.0, times[-1]))
    true = path.at(times)
    body, _ = rigid_bodies(made, made.figure.spin_rate, {})
    attitude = upright(true["figure"][0], made.figure.meridian)
    length = np.linalg.norm(path.windows.evaluate(path.momentum, times[:1])[:, 0])
    momentum = (
        Rotation.from_quat(attitude, scalar_first=True)
        .inv()
        .apply(length * true["angular_momentum"][0])
    )
    omega = made.figure.spin_rate * momentum / body.moments[:, 0]
    found = AttitudeIntegrator(body, masses(made), start_of(body, attitude, omega), times[-1]).at(
        times
    )
    axis = Rotation.from_quat(found.attitude, scalar_first=True).as_matrix()[:, :, 2]
    away = np.linalg.norm(axis - true["figure"], axis=1)
    # 9e-4 uas measured on the triaxial body; J3, J4 and geodesic precession move it by 100s of uas
    assert np.max(away) < 0.02 * UAS

"""Largest torques beyond the bulge, against a search over all directions."""

import numpy as np
import pytest

import earthspin
from earthspin.bodies import EARTH, MOON, SUN
from earthspin.torque.gravity import largest_torque_on_figure, zonal_law

MASS, RADIUS = 6.0e24, 6.4e6
GM, DISTANCE = 4.9e12, 3.6e8
MOMENT = MASS * RADIUS**2


def directions(count: int = 200_000) -> np.ndarray:
    """Unit vectors all over the sphere, on a spiral of golden angles, shape (3, n)."""
    turn = np.pi * (3 - np.sqrt(5)) * np.arange(count)
    z = 1 - (2 * np.arange(count) + 1) / count
    across = np.sqrt(1 - z * z)
    return np.stack([across * np.cos(turn), across * np.sin(turn), z])


def largest(zonal: dict[int, float], triaxiality: float = 0.0) -> dict[str, float]:
    return largest_torque_on_figure([(GM, DISTANCE)], MASS, RADIUS, zonal, triaxiality)


@pytest.mark.parametrize(("degree", "coefficient"), [(3, -2.5e-6), (3, 2.5e-6), (4, -1.6e-6)])
def test_zonal(degree: int, coefficient: float) -> None:
    place = DISTANCE * directions()
    axis = np.broadcast_to(np.array([[0.0], [0.0], [1.0]]), place.shape)
    found = zonal_law({degree: coefficient}, RADIUS, GM, place)(axis) * MOMENT
    sizes = np.linalg.norm(found, axis=0)
    bound = largest({degree: coefficient})[f"j{degree}"]
    assert sizes.max() <= bound
    assert sizes.max() == pytest.approx(bound, rel=1e-8, abs=0)


def test_triaxiality_by_four_masses() -> None:
    """Masses on the axes of the equator, of either sign: nothing but B - A."""
    size, arm = 1e18, DISTANCE / 1e4
    arms = arm * np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]])
    place = DISTANCE * directions().T
    torque = np.zeros_like(place)
    for mass, at in zip((size, size, -size, -size), arms, strict=True):
        away = place - at
        pull = GM * mass * away / np.linalg.norm(away, axis=1, keepdims=True) ** 3
        torque += np.cross(at, pull)
    b_minus_a = 4 * size * arm**2
    sizes = np.linalg.norm(torque, axis=1)
    bound = largest({}, b_minus_a / MOMENT)["triaxiality"]
    # the masses are not infinitely near: an arm of 1e-4 of the distance tells in 1e-8
    assert sizes.max() == pytest.approx(bound, rel=1e-5, abs=0)


def test_several_pull_together() -> None:
    both = largest_torque_on_figure(
        [(GM, DISTANCE), (1.3e20, 1.5e11)], MASS, RADIUS, {3: -2.5e-6, 4: -1.6e-6}, 7e-6
    )
    alone = [
        largest_torque_on_figure([one], MASS, RADIUS, {3: -2.5e-6, 4: -1.6e-6}, 7e-6)
        for one in ((GM, DISTANCE), (1.3e20, 1.5e11))
    ]
    assert set(both) == {"j3", "j4", "triaxiality"}
    for effect, size in both.items():
        assert size == pytest.approx(sum(one[effect] for one in alone), rel=1e-15, abs=0)


def test_what_a_body_has_not_is_not_left_out() -> None:
    assert largest({3: 0.0, 4: 0.0}) == {}
    assert set(largest({3: 0.0, 4: 1e-6})) == {"j4"}


def test_a_series_says_what_it_leaves_out() -> None:
    """At least the torque at every epoch, and no more than the nearest place allows."""
    tree = earthspin.run_tree(
        earthspin.Scene(compute="torque", span=("2000-01-01", "2003-01-01"), step="7 h")
    )
    series, told = tree.to_dataset(), tree["neglected"].neglected_effect
    bulge = EARTH.mass * EARTH.radius**2
    largest_there_is = {}
    for degree in (3, 4):
        total = np.zeros((3, series.sizes["time"]))
        for body in (SUN, MOON):
            one = series.sel(perturber=body.name)
            ra, dec = np.radians(one.right_ascension.values), np.radians(one.declination.values)
            unit = np.stack([np.cos(dec) * np.cos(ra), np.cos(dec) * np.sin(ra), np.sin(dec)])
            axis = np.broadcast_to(np.array([[0.0], [0.0], [1.0]]), unit.shape)
            coefficient = float(getattr(EARTH, f"j{degree}"))
            total += zonal_law(
                {degree: coefficient}, EARTH.radius, body.gm, one.distance.values * unit
            )(axis)
        largest_there_is[f"j{degree}"] = np.linalg.norm(total, axis=0).max() * bulge
    for effect, size in largest_there_is.items():
        assert size < float(told.sel(effect=effect)) < 2 * size
    near = [float(series.distance.sel(perturber=b.name).min()) for b in (SUN, MOON)]
    ellipse = sum(1.5 * b.gm / r**3 for b, r in zip((SUN, MOON), near, strict=True)) * bulge
    expected = ellipse * EARTH.triaxiality
    assert float(told.sel(effect="triaxiality")) == pytest.approx(expected, rel=1e-14, abs=0)
    assert list(told.values) == sorted(told.values, reverse=True)
    assert series.attrs["neglected"].startswith("triaxiality: ")

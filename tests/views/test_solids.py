"""Solids: what is drawn is what the theory says."""

import json

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin.rotor.axisymmetric import SymmetricRotor
from earthspin.views import report, rotors, solids


@pytest.fixture(scope="module")
def poinsot() -> xr.DataTree:
    return earthspin.run_tree("poinsot")


def test_every_solid_is_plain_json() -> None:
    assert "Every picture can be turned" in report.gallery_page()
    for solid in report.gallery():
        content = json.loads(solid.json())
        frames = len(content["times"])
        assert len(content["attitude"]) == frames
        for item in content["items"]:
            assert item["kind"] in {"mesh", "line", "arrow"}
            if "track" in item:
                assert len(item["track"]) == frames
        assert solid.caption.endswith(".")


def test_the_polhode_lies_on_both_ellipsoids(poinsot: xr.DataTree) -> None:
    polhode = poinsot["poinsot"].polhode.values
    for name in ("inertia_ellipsoid", "momentum_ellipsoid"):
        on = np.sum((polhode / poinsot["poinsot"][name].values) ** 2, axis=1)
        assert np.allclose(on, 1.0, rtol=0, atol=1e-13)


def test_a_polhode_crosses_the_sphere_of_its_mean_speed(poinsot: xr.DataTree) -> None:
    """I.5.4: the speed varies, by what energy and momentum allow, so no sphere holds the curve."""
    solid = rotors.polhode_with_sphere(poinsot)
    sphere, curve = (np.asarray(item["points"]).reshape(-1, 3) for item in solid.items[1:3])
    radius = np.linalg.norm(sphere, axis=1)
    assert np.ptp(radius) < 1e-12 * radius[0]
    speed = np.linalg.norm(curve, axis=1)
    assert speed.min() < 0.99 * radius[0]
    assert speed.max() > 1.01 * radius[0]


def test_the_rolling_ellipsoid_touches_the_plane(poinsot: xr.DataTree) -> None:
    """At every time the highest point of the ellipsoid is the tip of omega, on the plane."""
    solid = rotors.rolling_ellipsoid(poinsot)
    height = float(poinsot["poinsot"].invariable_plane_distance)
    track = next(i["track"] for i in solid.items if i["kind"] == "arrow" and "track" in i)
    assert np.allclose(track[:, 2], height, rtol=8e-15, atol=0)
    from earthspin.numerics.quaternion import rotate

    body = solids.ellipsoid(poinsot["poinsot"].inertia_ellipsoid.values, 61, 121).reshape(-1, 3)
    for q in np.asarray(solid.attitude)[::120]:
        turned = rotate(np.broadcast_to(q, (len(body), 4)), body)
        assert turned[:, 2].max() <= height * (1 + 1e-12)
        assert turned[:, 2].max() > height * 0.998


@pytest.mark.parametrize(("difference", "alpha"), [(-0.6, 0.35), (0.8, 0.6)])
def test_the_cones_touch_along_omega(difference: float, alpha: float) -> None:
    rotor = SymmetricRotor(equatorial=1.0, difference=difference, speed=1.0, alpha=alpha)
    times = np.linspace(0, 30, 50)
    omega, axis = rotor.omega_inertial(times), rotor.figure_axis(times)
    to_axis = np.arctan2(
        np.linalg.norm(np.cross(omega, axis), axis=1), np.sum(omega * axis, axis=1)
    )
    to_momentum = np.arctan2(np.hypot(omega[:, 0], omega[:, 1]), omega[:, 2])
    assert np.allclose(to_axis, alpha, rtol=0, atol=1e-14)
    assert np.allclose(to_momentum, abs(rotor.space_cone), rtol=0, atol=1e-14)
    picture = rotors.rolling_cones(rotor, "cones")  # their middle is the middle of the picture
    tips = [i[name] for i in picture.items for name in ("tip", "track") if name in i]
    heights = np.concatenate([[0.0], *(np.reshape(tip, (-1, 3))[:, 2] for tip in tips)])
    assert np.mean([heights.min(), heights.max()]) == pytest.approx(
        picture.height, rel=1e-14, abs=0
    )
    assert 1.2 < np.ptp(heights) / picture.radius < 2


def test_shapes() -> None:
    points = solids.ellipsoid((1.0, 2.0, 3.0))
    assert np.allclose(np.sum((points / [1.0, 2.0, 3.0]) ** 2, axis=-1), 1.0, rtol=1e-14, atol=0)
    rim = solids.cone(0.3, 2.0)[1]
    assert np.allclose(np.linalg.norm(rim, axis=-1), 2.0, rtol=1e-14, atol=0)
    assert np.allclose(
        np.arctan2(np.hypot(rim[:, 0], rim[:, 1]), rim[:, 2]), 0.3, rtol=0, atol=1e-14
    )
    assert np.all(solids.square(1.5, 0.7)[..., 2] == 0.7)


def test_no_label_ends_the_element_that_holds_it() -> None:
    """As `</script>` would, wherever a name comes from."""
    from earthspin.views.page import page

    label = "</script><script>alert(1)</script><!--"
    solid = solids.Solid("t", "c", [solids.arrow(np.ones(3), solids.BLACK, label)], 1.0)
    assert json.loads(solid.json())["items"][0]["label"] == label
    shown = page("t", solids=[solid])
    assert label not in shown
    assert shown.count("<script") == shown.count("</script>") == 2


def test_pictures_do_not_depend_on_the_order_of_labels(poinsot: xr.DataTree) -> None:
    labels = ("component", "quaternion", "in_plane", "bound")
    other = poinsot.copy()
    for path, node in poinsot.subtree_with_keys:
        data = node.to_dataset(inherit=False)
        turned = {dim: slice(None, None, -1) for dim in data.dims if dim in labels}
        other[path].dataset = data.isel(turned).transpose()
    for _, make in rotors.ROTOR_SOLIDS:
        assert make(other).json() == make(poinsot).json()

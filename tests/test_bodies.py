"""Bodies: what exists, what cannot, and what stays consistent when a number changes."""

import dataclasses
import math
import re
import tomllib

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

import earthspin
from earthspin import EARTH, MARS, SUN, BodyError, Scene, SceneError, UnitsError
from earthspin.bodies import BODIES, body
from earthspin.bodies.body import Body
from earthspin.constants import Constant
from earthspin.errors import Where


@pytest.mark.parametrize("name", BODIES)
def test_every_body_is_cited(name: str) -> None:
    assert BODIES[name].reference
    assert BODIES[name].naif


def test_a_body_is_frozen() -> None:
    with pytest.raises(dataclasses.FrozenInstanceError):
        EARTH.j2 = 0.0  # type: ignore[misc]


def test_a_name_that_is_nearly_right() -> None:
    with pytest.raises(SceneError, match="did you mean 'earth'"):
        body("erth", Where("body"))


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"gm": -1.0}, "gm"),
        ({"mass": -5e24}, "gm"),
        ({"gm": math.nan}, "gm"),
        ({"gm": 1e61}, "gm"),
        ({"spin_period": -1e31}, "spin_period"),
        ({"radius": 0.0}, "radius"),
        ({"radius": math.inf}, "radius"),
        ({"spin_period": 0.0}, "spin_period"),
        ({"dynamical_flattening": 0.6}, "dynamical_flattening"),
        ({"flattening": 1.0}, "flattening"),
        ({"j2": -1e-3, "dynamical_flattening": 1e-3}, "j2"),
        ({"moments": (8e37, 8e37, -8e37)}, "moments"),
        ({"moments": (1e37, 8e37, 1e37)}, "moments"),
        ({"moments": (8e37, 8e37, 17e37)}, "dynamical_flattening"),
        ({"j2": 2e-3, "dynamical_flattening": 2.05e-3}, "dynamical_flattening"),
        ({"moments": (1.65e38, 1.65e38, 1.651e38)}, "dynamical_flattening"),
        ({"moments": (8e37, 8e37, 8.1e37), "j2": 1e-3}, "moments"),
        ({"colour": "blue"}, "colour"),
        ({"mass": 6e24, "gm": 4e14}, "mass"),
        ({"pole": "north"}, "pole"),
    ],
)
def test_impossible_bodies_name_the_field(change: dict, field: str) -> None:
    with pytest.raises(BodyError) as error:
        EARTH.replace(**change)
    assert error.value.field == field


def test_the_meridian_of_an_earlier_scene_is_the_long_axis_of_the_earth() -> None:
    """Scenes before `prime_meridian` had 4.6297550 rad, at which the axis is at 14.93 deg west."""
    table = EARTH.write() | {"meridian": "4.629755030133973 rad"}
    del table["long_axis"]
    for scene in (table, {"meridian": "4.629755030133973 rad"}):
        assert math.degrees(Body.read(scene, Where("body")).long_axis) == pytest.approx(
            -14.93, abs=0.005, rel=0
        )
    mars = Body.read({"from": "mars", "meridian": "0.5 rad"}, Where("body"))
    assert (mars.long_axis, mars.prime_meridian) == (0.5, None)


def test_a_hollow_sphere_is_the_limit_of_round_bodies() -> None:
    """It has 2/3 M a2 about each axis, 1.620e38 kg m2 with mass and radius of the Earth."""
    shell = EARTH.replace(moments=(1.62e38, 1.62e38, 1.621e38))
    assert shell.moments[2] == pytest.approx(1.621e38, rel=1e-9, abs=0)


def test_the_thin_disc_is_the_limit() -> None:
    assert EARTH.replace(dynamical_flattening=0.5).dynamical_flattening == 0.5


def test_j2_alone_keeps_the_polar_moment() -> None:
    changed = EARTH.replace(j2=2 * EARTH.j2)
    assert np.isclose(
        changed.j2 / changed.dynamical_flattening,
        EARTH.j2 / EARTH.dynamical_flattening,
        rtol=1e-15,
        atol=0,
    )


@given(a=st.floats(1e30, 1e38), stretch=st.floats(0.0, 0.5), flat=st.floats(1e-6, 0.4))
def test_moments_give_the_figure_they_came_from(a: float, stretch: float, flat: float) -> None:
    b = a * (1 + stretch)
    c = (a + b) / 2 * (1 + flat)
    body = EARTH.replace(moments=(a, b, c))
    scale = body.mass * body.radius**2
    mean = c - body.j2 * scale
    assert np.isclose(mean, (a + b) / 2, rtol=1e-15, atol=0)
    assert np.isclose(body.j2 * scale / body.dynamical_flattening, c, rtol=2e-15, atol=0)
    assert np.isclose(body.triaxiality * scale, b - a, rtol=2e-15, atol=0)


def test_moments_may_be_named_either_way_round() -> None:
    one, two = (
        EARTH.replace(moments=m) for m in ((8.0e37, 8.1e37, 8.2e37), (8.1e37, 8e37, 8.2e37))
    )
    assert one.triaxiality == two.triaxiality > 0
    assert one.j2 == two.j2
    assert one.dynamical_flattening == pytest.approx(0.15 / 8.2, rel=1e-14, abs=0)


def test_the_uncertainty_of_the_bulge() -> None:
    """C - A = J2 (GM/G) a2, moved in each number in turn and added up as squares."""
    known = {"j2": 3e-3, "gm": 1e-3, "radius": 2e-3}
    body = EARTH.replace(relative_uncertainty=known)

    def bulge(**moved: float) -> float:
        return (
            (1 + moved.get("j2", 0)) * (1 + moved.get("gm", 0)) * (1 + moved.get("radius", 0)) ** 2
        )

    shares = [bulge(**{name: u}) - 1 for name, u in known.items()]
    expected = math.hypot(*shares, 1.5e-15 / 6.67430e-11)
    # the square of a radius moved by 2e-3 adds 2e-6 to 4e-3
    assert body.relative_uncertainty_of_bulge() == pytest.approx(expected, rel=1e-3, abs=0)


def test_what_is_changed_loses_its_uncertainty() -> None:
    changed = EARTH.replace(dynamical_flattening=0.003)
    assert "dynamical_flattening" not in changed.relative_uncertainty
    assert "j2" in changed.relative_uncertainty


def test_a_missing_field_is_asked_for() -> None:
    with pytest.raises(BodyError, match="give dynamical_flattening"):
        SUN.needed("dynamical_flattening")


def test_fields_may_be_labelled_arrays() -> None:
    h = xr.DataArray(np.linspace(0.003, 0.004, 5), dims="draw")
    assert EARTH.replace(dynamical_flattening=h).dynamical_flattening.dims == ("draw",)
    with pytest.raises(BodyError):
        EARTH.replace(dynamical_flattening=h + 0.498)


def test_obliquity_of_mars() -> None:
    # 25.19 degrees: Folkner et al. 1997, Science 278, 1749
    from earthspin.sky.poles import angle

    obliquity = math.degrees(angle(MARS.pole.true(0.0), MARS.orbit_pole.vector()))
    assert abs(obliquity - 25.19) < 0.005


def test_j2_of_a_sphere_needs_h_too() -> None:
    sphere = EARTH.replace(j2=0.0, dynamical_flattening=0.0)
    with pytest.raises(BodyError, match="dynamical_flattening"):
        sphere.replace(j2=1e-3)
    with pytest.raises(BodyError, match="radius"):
        SUN.replace(radius=None).replace(moments=(1e47, 1e47, 1e47))
    with pytest.raises(BodyError, match="did you mean 'triaxiality'"):
        EARTH.replace(triaxialty=0.0)


def test_j2_may_be_changed_where_it_is_an_array() -> None:
    j2 = xr.DataArray([1e-3, 2e-3], dims="draw")
    many = EARTH.replace(j2=j2)
    assert many.replace(j2=2 * j2).dynamical_flattening.dims == ("draw",)


def test_a_changed_number_may_carry_its_unit() -> None:
    import astropy.units as u

    assert EARTH.replace(spin_period="12 h").spin_period == 43200.0
    assert EARTH.replace(radius=6378 * u.km).radius == 6378e3
    assert EARTH.replace(long_axis="180 deg").long_axis == math.pi
    assert MARS.replace(pole=("90 deg", 30 * u.deg)).pole == pytest.approx(
        (math.pi / 2, math.pi / 6), rel=1e-15, abs=0
    )
    heavy = ("8.01e37 kg m2", 8.01e37 * u.kg * u.m**2, 8.04e37)
    assert EARTH.replace(moments=heavy) == EARTH.replace(moments=(8.01e37, 8.01e37, 8.04e37))
    for wrong in ("12", "12 kg", 3 * u.m):
        with pytest.raises(UnitsError, match="spin_period"):
            EARTH.replace(spin_period=wrong)


def test_bodies_are_equal_if_every_number_is() -> None:
    assert EARTH.replace() == EARTH
    assert hash(EARTH.replace()) == hash(EARTH)
    assert EARTH.replace(j3=0.0) != EARTH
    assert EARTH != "earth"
    h = xr.DataArray([0.003, 0.0031], {"draw": [1, 2]}, ("draw",))
    many = EARTH.replace(dynamical_flattening=h)
    assert many == EARTH.replace(dynamical_flattening=h.copy())
    assert many != EARTH.replace(dynamical_flattening=h.assign_coords(draw=[1, 3]))
    assert many != EARTH != many


def test_a_body_can_be_read_at_a_glance() -> None:
    assert "\n" not in repr(EARTH)
    h = xr.DataArray([0.003, 0.0031], dims="draw")
    assert "an array along draw" in repr(EARTH.replace(dynamical_flattening=h))
    # a number that was changed has no source any more
    assert "Mathews" in EARTH._repr_html_()
    assert "Mathews" not in EARTH.replace(dynamical_flattening=0.003, reference="")._repr_html_()
    assert "<b>" not in EARTH.replace(name="<b>")._repr_html_()


_TURNS = {"radius", "j2", "dynamical_flattening", "spin_period", "pole"}


@pytest.mark.parametrize(
    ("compute", "settings", "needed"),
    [
        ("torque", {}, {"radius", "j2", "pole"}),
        ("precession", {}, _TURNS),
        ("pole", {}, _TURNS),
        ("iau", {}, _TURNS),
        ("wobble", {}, _TURNS - {"pole"} | {"flattening"}),
        ("spheroid", {"spheroid": {"position": [["1 m", "0 m", "0 m"]]}}, {"radius", "flattening"}),
    ],
)
def test_all_that_a_body_lacks_is_named_at_once(
    compute: str, settings: dict, needed: set[str]
) -> None:
    bare = {"from": "nothing", "name": "ceres", "gm": "62.6 km3/s2"}
    with pytest.raises(BodyError) as error:
        Scene(compute=compute, body=bare, **settings)
    told = str(error.value)
    assert told.count("\n") == 0
    assert {name for name in Body.KINDS if f" {name} = " in told} == needed
    # no number of any body stands there: units, and what a pure number is
    forms = dict(re.findall(r"(\w+) = (.*?)(?:, (?=\w+ = )|$)", told.split("; give ")[1]))
    assert set(forms) == needed
    assert not any(re.search(r"\d", re.sub("(j|a|radius)2", "", form)) for form in forms.values())
    # given in that form, it is enough
    ratios = {"j2": "1e-3", "dynamical_flattening": "3e-3", "flattening": "3e-3"}
    lines = [f"{n} = {ratios.get(n, form.replace('...', '40'))}" for n, form in forms.items()]
    Scene(compute=compute, body=bare | tomllib.loads("\n".join(lines)), **settings)


def test_a_pole_is_a_value() -> None:
    from earthspin.sky.poles import IAU_2006, FixedPole

    assert EARTH.pole == IAU_2006
    assert str(EARTH.pole) == "iau2006"
    pole = FixedPole(math.radians(317.68143), math.radians(52.88650))
    assert MARS.replace(pole=("317.68143 deg", "52.88650 deg")).pole == pole
    assert EARTH.replace(pole=MARS.pole).pole == MARS.pole
    assert str(pole) == "right ascension 317.68143 deg, declination 52.88650 deg"


@pytest.mark.parametrize(
    ("start", "change", "unit"),
    [
        (EARTH, {"radius": 6371}, "km"),
        (EARTH, {"radius": xr.DataArray([6371e3, 6371], dims="member")}, "km"),
        (EARTH, {"gm": 3.986e5}, "km3/s2"),
        (SUN, {"radius": 695700}, "km"),
        (SUN, {"gm": 1.327e11}, "km3/s2"),
        (BODIES["saturn"], {"radius": 60268}, "km"),
        (BODIES["moon"], {"gm": 4902.8}, "km3/s2"),
    ],
)
def test_a_number_that_is_usual_in_kilometres_is_refused(
    start: Body, change: dict, unit: str
) -> None:
    """The torque of the Sun on an Earth of 6371 m is a millionth of the right one."""
    with pytest.raises(BodyError, match=f"no body has this density; if it is in {unit}, write"):
        start.replace(**change)
    for key, value in change.items():
        if isinstance(value, (int, float)):
            assert start.replace(**{key: f"{value} {unit}"}).gm > 0


@pytest.mark.parametrize(
    ("gm", "radius"),
    [
        (1.0, 1.0),
        (1.37e20, 5.9e6),  # Sirius B (Bond et al. 2017), 2.4e9 kg/m3
        (1.79e20, 2.14e6),  # ZTF J1901+1458 (Caiazzo et al. 2021), 6.5e10 kg/m3
        (1.9e20, 12e3),  # a neutron star, 4e17 kg/m3
        (5.4e26, 1.2e10),  # the black hole of the galaxy, within its horizon
        (2.2e21, 5.3e11),  # Betelgeuse, 5e-5 kg/m3
        (4.3e-11, 0.3),  # a ball of 0.65 kg
    ],
)
def test_dense_and_thin_bodies_are_possible(gm: float, radius: float) -> None:
    assert Body(name="x", gm=gm, radius=radius).gm == gm


@pytest.mark.parametrize("field", ["j2", "spin_period"])
def test_an_array_given_to_a_body_is_copied_and_cannot_be_changed(field: str) -> None:
    given = xr.DataArray([1.0, 1.1], dims="case") * getattr(EARTH, field)
    body = EARTH.replace(**{field: given})
    before = earthspin.precession(body=body)
    kept = getattr(body, field).values.copy()
    given[0] = 5.0
    np.testing.assert_array_equal(getattr(body, field), kept)
    with pytest.raises(ValueError, match="read-only"):
        getattr(body, field)[1] = 7.0
    xr.testing.assert_equal(earthspin.precession(body=body), before)


def test_an_unknown_uncertainty_is_not_zero() -> None:
    assert math.isnan(Constant(3.0, "m", None, "a source").relative_uncertainty)
    assert Constant(3.0, "m", 0.0, "by definition").relative_uncertainty == 0

"""The rotation of the Moon against the librations of DE421, and the effects on its attitude."""

from pathlib import Path

import numpy as np
import pytest
from astropy.time import Time
from jplephem.spk import SPK
from scipy.spatial.transform import Rotation

import earthspin
from earthspin import BODIES, MARS, MOON, SceneError
from earthspin.bodies.laplace_plane import laplace_plane
from earthspin.bodies.moons import ORBITS
from earthspin.constants import ARCSEC, J2000_JD
from earthspin.errors import BodyError, Where
from earthspin.frames import BodyFixed
from earthspin.numerics.arrays import FloatArray
from earthspin.sky.ephemeris import open_ephemeris

#: TDB Julian date, Euler angles (rad) and their rates (rad/d), from the package jplephem.
DE421 = np.loadtxt(Path(__file__).parents[1] / "data" / "de421-librations.txt")


def dates(jd: FloatArray) -> list[str]:
    """Dates as ISO text, all at 12h."""
    return list(
        np.datetime_as_string(np.datetime64("2000-01-01T12:00") + (jd - J2000_JD).astype("m8[D]"))
    )


def apart(answer: "earthspin.Dataset", angles: FloatArray) -> FloatArray:  # type: ignore[name-defined]
    """Angle from the librations, arcsec."""
    found = Rotation.from_quat(answer.attitude.values, scalar_first=True)
    return np.asarray((Rotation.from_euler("ZXZ", angles).inv() * found).magnitude() / ARCSEC)


def test_the_moon_is_as_in_de421() -> None:
    """The table of starts holds none of these dates."""
    jd, angles = DE421[:, 0], DE421[:, 1:4]
    chosen = np.isin(np.arange(len(jd)), np.arange(0, 13))  # from 1991 to 1995
    found = earthspin.rotation(times=dates(jd[chosen]), body="moon")
    away = apart(found, angles[chosen])
    assert np.all(away < 0.0055)
    assert np.all(away < found.attitude_error.values * 3600)
    assert found.attitude_error.values[0] == pytest.approx(0.14 / 3600, rel=1e-6, abs=0)
    assert "DE421" in found.attitude_error.start
    # angular velocity along the axes of the mantle, from the angles and their rates
    (phi_rate, theta_rate, psi_rate), (_, theta, psi) = DE421[0, 4:7], DE421[0, 1:4]
    spin = [
        phi_rate * np.sin(theta) * np.sin(psi) + theta_rate * np.cos(psi),
        phi_rate * np.sin(theta) * np.cos(psi) - theta_rate * np.sin(psi),
        phi_rate * np.cos(theta) + psi_rate,
    ]
    np.testing.assert_allclose(found.omega[0], np.array(spin) / 86400, rtol=0, atol=3e-14)


@pytest.mark.parametrize("row", [0, 15, 30, 45])
def test_any_first_date_is_as_in_de421(row: int) -> None:
    found = earthspin.rotation(times=dates(DE421[row : row + 1, 0]), body="moon")
    assert apart(found, DE421[row : row + 1, 1:4])[0] < 0.0055


@pytest.mark.parametrize(
    ("effect", "least", "most"),
    [
        ("harmonics", 100, 130),
        ("tides", 0.1, 1.3),
        ("fluid-core", 0.4, 2.5),
        ("flattened-perturber", 0.003, 0.05),
    ],
)
def test_an_effect_that_is_off_has_its_size_in_the_section(
    effect: str, least: float, most: float
) -> None:
    """Without it, the distance from DE421 after a year is the size that the section gives."""
    known = earthspin.rotation(times=["2000-01-01"], body="moon").attrs["effects"].split()
    effects = [name for name in known if name != effect]
    jd, angles = DE421[:6, 0], DE421[:6, 1:4]
    scene = earthspin.Scene(compute="rotation", times=dates(jd), body="moon", effects=effects)
    tree = earthspin.run_tree(scene, "neglected")
    away = float(apart(tree.to_dataset(), angles)[-1])  # after 365 d
    sizes = tree["neglected"].neglected_effect
    assert least < away < most
    assert effect in sizes.effect
    assert 0.4 < float(sizes.sel(effect=effect)) / away < 6.0


def test_the_long_axis_points_to_the_earth() -> None:
    """Optical librations reach 8 deg in longitude and 7 deg in latitude."""
    found = earthspin.rotation("2026-01-01", "2026-03-01", "1 d", body="moon")
    seen = earthspin.torque_series(times=found.time, perturbers=["moon"])
    ra, de = (
        np.radians(seen.right_ascension.values[:, 0]),
        np.radians(seen.declination.values[:, 0]),
    )
    moon = np.array([np.cos(de) * np.cos(ra), np.cos(de) * np.sin(ra), np.sin(de)]).T
    axes = Rotation.from_quat(found.attitude.values, scalar_first=True).as_matrix()[:, :, 0]
    # the equator of date has turned by 0.37 deg
    assert np.degrees(np.arccos(np.sum(axes * -moon, axis=1))).max() < 11


def test_the_moon_keeps_its_start_outside_the_table() -> None:
    early = earthspin.rotation(times=["1905-01-01"], body="moon")
    assert "prime meridian" in early.attitude_error.start
    assert float(early.attitude_error[0]) > 1.0


def test_harmonics_take_the_place_of_j3_and_j4() -> None:
    with pytest.raises(BodyError, match="harmonics contains them"):
        MOON.replace(j3=1e-6)
    with pytest.raises(SceneError, match="c30 to s99"):
        MARS.replace(harmonics={"c22": 1e-5})
    table = MOON.write()
    assert earthspin.Body.read(table, Where("body")) == MOON


def test_effects_on_the_attitude_are_those_of_rotation_only() -> None:
    with pytest.raises(SceneError, match="tides"):
        earthspin.pole("2000-01-01", "2001-01-01", "10 d", effects=["tides"])
    known = earthspin.rotation(times=["2000-01-01"]).attrs["effects"]
    assert "tides" not in known
    assert "harmonics" not in known


def test_the_torque_is_about_the_principal_axes() -> None:
    """The axis of C of DE421, which the axis by the formula of the IAU follows within 18 arcsec."""
    jd = DE421[::4, 0]
    found = earthspin.torque_series(times=dates(jd), body="moon", perturbers=["earth"])
    axis = Rotation.from_euler("ZXZ", DE421[::4, 1:4]).as_matrix()[:, :, 2]
    with SPK.open(str(open_ephemeris("de421").path)) as kernel:
        earth = (kernel[3, 399].compute(jd) - kernel[3, 301].compute(jd)).T
    sine = np.sum(axis * earth, axis=1) / np.linalg.norm(earth, axis=1)
    away = np.abs(found.declination.values[:, 0] - np.degrees(np.arcsin(sine))) * 3600
    assert away.max() < 19  # 90 for the pole of the IAU
    assert float(found.direction_error[0]) == pytest.approx(18.0, abs=0.1)


def test_mean_earth_axes() -> None:
    """Poles and whole rotation by NAIF (moon_080317.tf); the IAU's pole is that of these axes."""
    answer = earthspin.rotation("2000-01-01T12:00", "2000-01-02", "1 d", body="moon")
    when = Time("2000-01-01T12:00", scale="tdb")
    principal = BodyFixed(obstime=when, model=answer).matrix
    mean = BodyFixed(obstime=when, model=answer, axes="mean-earth").matrix
    between = Rotation.from_matrix(mean @ principal.T)
    assert between.magnitude() / ARCSEC == pytest.approx(103.85, abs=0.005)
    assert np.arccos(mean[2] @ principal[2]) / ARCSEC == pytest.approx(78.56, abs=0.005)
    pole = MOON.needed("pole").true(0.0)
    assert np.linalg.norm(np.cross(mean[2], pole)) / ARCSEC < 18.3
    with pytest.raises(SceneError, match="mean-earth"):
        BodyFixed(obstime=when, model=answer, axes="iau")
    mars = earthspin.rotation(times=["2000-01-01T12:00"], body="mars", perturbers=[])
    with pytest.raises(SceneError, match="only the Moon"):
        _ = BodyFixed(obstime=when, model=mars, axes="mean-earth").matrix


@pytest.mark.parametrize(
    ("name", "planet", "most"), [("titan", "saturn", 0.65), ("phobos", "mars", 1.15)]
)
def test_an_orbit_about_a_planet_lies_in_the_laplace_plane(
    name: str, planet: str, most: float
) -> None:
    """In the ecliptic, Saturn would be at declinations up to 28 deg and Mars at 26 deg."""
    period = f"{ORBITS[name].period / 86400:.8g} d"  # type: ignore[operator]
    body = BODIES[name].replace(orbit={"period": period, "about": planet})
    found = earthspin.torque_series(
        "2000-01-01", "2000-03-01", "5 h", body=body, perturbers=[planet]
    )
    assert 0.2 < np.abs(found.declination.values).max() < most


def test_the_laplace_plane_of_iapetus() -> None:
    """Its tilt to the equator of Saturn is 14.8 deg (JPL, mean elements of satellites)."""
    saturn = BODIES["saturn"]
    plane = laplace_plane(ORBITS["iapetus"], 1.2e11, saturn)
    assert plane is not None
    pole = saturn.needed("pole").true(0.0)
    assert np.degrees(np.arccos(plane.matrix[2] @ pole)) == pytest.approx(14.8, abs=0.5)


def test_the_error_of_the_kernel_contains_the_direction_of_the_earth() -> None:
    """Between DE421 and DE440 the same start leads to attitudes 1.4 and 5.8 mas apart in a year."""
    year = ("2000-01-01", "2000-12-31", "73 d")
    kernel = earthspin.rotation(*year, body="moon").attitude_error_kernel.values * 3.6e6
    assert 5.8 < kernel[-1] < 15
    assert kernel[0] < 1e-6

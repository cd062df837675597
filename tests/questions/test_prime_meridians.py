"""Prime meridians and axes of least moment: the first attitude of `rotation`, and its error."""

from collections.abc import Callable

import numpy as np
import pytest
from astropy.time import Time
from numpy import sin
from scipy.spatial.transform import Rotation

import earthspin
from earthspin import BODIES, EARTH, MARS, SceneError
from earthspin.bodies.body import Body
from earthspin.errors import BodyError, Where
from earthspin.frames import BodyFixed
from earthspin.numerics.arrays import FloatArray

Angles = tuple[FloatArray, FloatArray, FloatArray]


# Archinal et al. 2018, Celest. Mech. 130:22, with the correction of 2019: right ascension and
# declination of the pole, and W, in degrees; d in days and t in centuries from J2000.0 TDB.


def _sine(degrees: FloatArray) -> FloatArray:
    return np.asarray(sin(np.radians(degrees)))


def _mercury(d: FloatArray, t: FloatArray) -> Angles:
    m1 = 174.7910857 + 4.092335 * d
    libration = 0.01067257 * _sine(m1) - 0.00112309 * _sine(2 * m1) - 0.0001104 * _sine(3 * m1)
    return 281.0103 - 0.0328 * t, 61.4155 - 0.0049 * t, 329.5988 + 6.1385108 * d + libration


def _venus(d: FloatArray, t: FloatArray) -> Angles:
    return 272.76 + 0 * t, 67.16 + 0 * t, 160.20 - 1.4813688 * d


def _mars(d: FloatArray, t: FloatArray) -> Angles:
    ra = 317.269202 - 0.10927547 * t + 0.419057 * _sine(79.398797 + 0.5042615 * t)
    de = 54.432516 - 0.05827105 * t + 1.591274 * _sine(256.325722 + 0.5042615 * t)
    w = 176.049863 + 350.891982443297 * d + 0.584542 * _sine(95.391654 + 0.5042615 * t)
    return ra, de, w + np.degrees(np.arctan2(4.893449e-5, -8.463591e-5) / 2)


def _phobos(d: FloatArray, t: FloatArray) -> Angles:
    m1 = 169.51 - 0.4357640 * d
    ra, de = 317.68 - 0.108 * t + 1.79 * _sine(m1), 52.90 - 0.061 * t - 1.08 * _sine(m1 + 90)
    w = 35.18774440 + 1128.84475928 * d + 12.72192797 * t**2
    w += 1.42421769 * _sine(190.72646643 + 15917.10818695 * t)
    w -= 1.143 * _sine(189.63271560 + 41215158.1842005 * t + 12.711923222 * t**2)
    return ra, de, w


def _titan(d: FloatArray, t: FloatArray) -> Angles:
    return 39.4827 + 0 * t, 83.4279 + 0 * t, 186.5855 + 22.5769768 * d


IAU: dict[str, Callable[[FloatArray, FloatArray], Angles]] = {
    "mercury": _mercury, "venus": _venus, "mars": _mars, "phobos": _phobos, "titan": _titan,
}  # fmt: skip


def _away(answer: "earthspin.Dataset", name: str) -> FloatArray:  # type: ignore[name-defined]
    """Angle about the axis from the IAU, deg."""
    days = (answer.time.values - np.datetime64("2000-01-01T12:00")) / np.timedelta64(1, "D")
    ra, de, w = IAU[name](days, days / 36525)
    published = Rotation.from_euler("ZXZ", np.stack([ra + 90, 90 - de, w], axis=1), degrees=True)
    found = Rotation.from_quat(answer.attitude.values, scalar_first=True)
    return np.degrees((published.inv() * found).as_rotvec())[:, 2]


@pytest.mark.parametrize("name", IAU)
def test_bodies_start_on_the_prime_meridian_of_the_iau(name: str) -> None:
    body = BODIES[name]
    for date in ("2000-01-01T12:00", "2026-01-01", "2050-01-01"):
        found = earthspin.rotation(times=[date], body=body, perturbers=[])
        away = abs(float(_away(found, name)[0]))
        if date.startswith("2000"):
            assert away < 0.01, date
        if body.prime_meridian_uncertainty or "spin_period" in body.relative_uncertainty:
            assert away < 0.01 + float(found.attitude_error[0]) < 8.0, date


@pytest.mark.parametrize(
    ("name", "stop", "step"),
    [
        ("mercury", "2020-01-01", "30 d"),
        ("venus", "2020-01-01", "300 d"),
        ("mars", "2001-01-01", "30 d"),
    ],
)
def test_bodies_stay_with_the_iau_as_claimed(name: str, stop: str, step: str) -> None:
    found = earthspin.rotation("2000-01-01T12:00", stop, step, body=name)
    away = np.abs(_away(found, name))
    assert np.all(away <= found.attitude_error.values + 1e-4)
    assert float(found.attitude_error[-1]) < 0.62


def test_the_error_of_the_start_stays_in_later_errors() -> None:
    body = MARS.replace(prime_meridian_uncertainty="1 deg", pole_uncertainty="0.5 deg")
    found = earthspin.rotation("2000-01-01T12:00", "2000-01-03", "1 d", body=body, perturbers=[])
    np.testing.assert_allclose(found.attitude_error, 1.96 * np.hypot(1.0, 0.5), rtol=0.02, atol=0)
    exact = earthspin.rotation(
        "2000-01-01T12:00", "2000-01-03", "1 d", body=body, perturbers=[],
        start_attitude=found.attitude.values[0],
    )  # fmt: skip
    assert float(exact.attitude_error[-1]) < 1e-8


def test_the_x_axis_is_stated() -> None:
    day = {"times": ["2000-01-01T12:00"], "perturbers": []}
    assert "74.98 deg" in earthspin.rotation(**day, body="mars").attitude.x_axis
    assert earthspin.rotation(**day, body="venus").attitude.x_axis == "prime meridian"
    tilted = earthspin.rotation(**day, body=EARTH.replace(obliquity="10 deg"))
    assert tilted.attitude.x_axis.startswith("arbitrary")
    with pytest.raises(SceneError, match=r"its x axis is arbitrary.*prime_meridian"):
        _ = BodyFixed(obstime=Time("2000-01-01T12:00", scale="tdb"), model=tilted).matrix


def test_the_earth_turns_with_ut1() -> None:
    with pytest.raises(BodyError, match="follows from UT1"):
        EARTH.replace(prime_meridian="10 deg")


def test_scenes_with_the_earlier_meridian_are_read() -> None:
    """Its angle was counted from the projected x axis at J2000.0, to the axis of least moment."""
    earth = Body.read({"meridian": "4.629755030133973 rad"}, Where("body"))
    assert earth == EARTH
    mars = Body.read({"from": "mars", "meridian": "0.5 rad"}, Where("body"))
    assert mars.prime_meridian is None
    found = earthspin.rotation(times=["2000-01-01T12:00"], body=mars, perturbers=[])
    x, _, z = Rotation.from_quat(found.attitude.values[0], scalar_first=True).as_matrix().T
    projected = np.array([1.0, 0.0, 0.0]) - z[0] * z
    across = np.cross(z, projected)
    assert np.arctan2(x @ across, x @ projected) == pytest.approx(0.5, abs=1e-14)

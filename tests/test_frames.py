"""Frames of astropy and Skyfield from answers, against ERFA."""

import astropy.units as u
import erfa
import numpy as np
import pytest
from astropy.coordinates import ICRS, SkyCoord
from astropy.time import Time
from scipy.spatial.transform import Rotation
from skyfield.api import load
from skyfield.positionlib import ICRF

import earthspin
from earthspin import CoverageError, SceneError
from earthspin.frames import BodyFixed, EquatorOfDate, SkyfieldFrame, rotations

NOW = Time("2020-05-05T03:00:00", scale="tdb")


@pytest.fixture(scope="module")
def past() -> EquatorOfDate:
    answer = earthspin.long_term("-12 kyr", "0 kyr", "1 kyr")
    return EquatorOfDate(obstime=Time(-9999.0, format="jyear", scale="tdb"), model=answer)


@pytest.fixture(scope="module")
def now() -> EquatorOfDate:
    effects = ["planets", "j3", "j4", "triaxiality", "geodesic", "j2-rate", "second-order"]
    answer = earthspin.pole("2000-01-01", "2001-01-01", "30 d", effects=[*effects, "nonrigid"])
    return EquatorOfDate(obstime=NOW, model=answer)


def test_mean_equator_of_centuries_against_erfa(past: EquatorOfDate) -> None:
    """Within 250 years IAU 2006 is better than the answer, whose error contains the difference."""
    for year in (1750.0, 1900.0, 2100.0, 2250.0):
        time = Time(year, format="jyear", scale="tdb")
        frame = EquatorOfDate(obstime=time, model=past.model)
        iau = erfa.pmat06(time.jd1, time.jd2)
        off = np.degrees(np.linalg.norm(frame.matrix[2] - iau[2])) * 3600
        assert off < frame.error.to_value("arcsec")


def test_mean_equator_of_millennia_against_erfa(past: EquatorOfDate) -> None:
    """Vondrak et al. (2011) were fitted to an older solution: 98 arcsec at 10,000 BC."""
    off = np.degrees(np.linalg.norm(past.matrix[2] - erfa.ltpb(-9999.0)[2])) * 3600
    assert off == pytest.approx(98.1, abs=1)
    turn = Rotation.from_matrix(past.matrix @ erfa.ltpb(-9999.0).T).magnitude()
    assert np.degrees(turn) * 3600 == pytest.approx(230.6, abs=2)


def test_true_equator_against_erfa(now: EquatorOfDate) -> None:
    iau = erfa.pnm06a(NOW.tt.jd1, NOW.tt.jd2)
    assert np.linalg.norm(now.matrix[2] - iau[2]) < now.error.to_value("rad")
    # the equinox: the same error over the sine of the obliquity
    assert np.max(abs(now.matrix - iau)) < now.error.to_value("rad") / np.sin(np.radians(23.4))


def test_there_and_back(past: EquatorOfDate, now: EquatorOfDate) -> None:
    stars = SkyCoord([10.0, 200.0, 300.0], [89.9, -60.0, 0.0], unit="deg")
    for frame in (past, now):
        back = stars.transform_to(frame).transform_to(ICRS())
        assert np.max(back.separation(stars).arcsec) < 1e-9
    between = stars.transform_to(past).transform_to(now)
    assert np.max(between.separation(stars.transform_to(now)).arcsec) < 1e-9
    assert stars.transform_to(now).ra[0] != stars.ra[0]


def test_times_of_an_array(now: EquatorOfDate) -> None:
    times = Time(["2021-01-01", "2020-05-05T03:00:00"], scale="tdb")
    stars = SkyCoord([10, 10] * u.deg, [5, 5] * u.deg)
    many = stars.transform_to(EquatorOfDate(obstime=times, model=now.model))
    one = stars[1].transform_to(now)
    assert many[1].separation(SkyCoord(one.ra, one.dec, frame=many[1].frame)).arcsec < 1e-9
    assert many[0].ra > many[1].ra


def test_skyfield_turns_vectors_alike(now: EquatorOfDate) -> None:
    frame = SkyfieldFrame(earthspin.run(now.model.question))
    scale = load.timescale(builtin=True)
    vector = np.array([1.0, 0.2, 0.3])
    found = ICRF(vector, t=scale.tdb(2020, 5, 5.125)).frame_xyz(frame).au
    assert np.max(abs(found - now.matrix @ vector)) < 1e-11
    assert frame.rotation_at(scale.tdb(2020, 5, [5, 6])).shape == (3, 3, 2)


def test_body_fixed_axes() -> None:
    answer = earthspin.rotation("2000-01-01", "2000-02-01", "10 d")
    frame = BodyFixed(obstime=Time("2000-01-21", scale="tdb"), model=answer)
    w, x, y, z = answer.attitude.values[2]
    # figure axis of the body in the sky, from the quaternion by hand
    axis = np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
    assert frame.matrix[2] == pytest.approx(axis, abs=1e-12)
    assert rotations(answer)[2].as_matrix()[:, 2] == pytest.approx(axis, abs=1e-14)
    pole = ICRS(SkyCoord(*axis, representation_type="cartesian").spherical).transform_to(frame)
    assert pole.spherical.lat.deg == pytest.approx(90, abs=1e-5)
    with pytest.raises(SceneError, match="the rotation starts at 2000-01-01"):
        _ = BodyFixed(obstime=Time("1999-01-01", scale="tdb"), model=answer).matrix


def test_refusals(now: EquatorOfDate) -> None:
    with pytest.raises(CoverageError, match=r"2100-01-01.* is outside kernel 'de421'"):
        _ = EquatorOfDate(obstime=Time("2100-01-01", scale="tdb"), model=now.model).matrix
    with pytest.raises(SceneError, match="give an answer to 'long-term' or 'pole'"):
        EquatorOfDate(obstime=NOW, model=earthspin.precession())
    with pytest.raises(SceneError, match="model = 'nothing'"):
        ICRS(1 * u.deg, 2 * u.deg).transform_to(EquatorOfDate())
    many = earthspin.long_term("-1 kyr", "0 kyr", "1 kyr").expand_dims(member=2)
    with pytest.raises(SceneError, match="along member"):
        EquatorOfDate(obstime=NOW, model=many)
    with pytest.raises(SceneError, match="it has no 'attitude'"):
        rotations(earthspin.precession())

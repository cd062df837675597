"""What public calls return, compared as it is returned with independent counterparts.

No offset, trend or mean is removed before a comparison.
"""

from functools import lru_cache
from pathlib import Path

import astropy.units as u
import erfa
import numpy as np
import pytest
import skyfield_data
import xarray as xr
from astropy.coordinates import get_body_barycentric, solar_system_ephemeris
from astropy.time import Time
from astropy.utils import iers

import earthspin
from earthspin import EARTH
from earthspin.constants import ARCSEC, EPSILON_0, J2000_JD, MAS, G
from earthspin.motion.effects import EFFECTS, RESPONSE, RIGID

CENTURY = ("1950-01-02", "2049-12-30", "11.3 d")
DE421 = Path(skyfield_data.__file__).parent / "data" / "de421.bsp"


def days_of(answer: xr.Dataset) -> np.ndarray:
    """Days from J2000.0 TDB."""
    return (answer.time.values - np.datetime64("2000-01-01T12:00")) / np.timedelta64(1, "D")


def figure_axis(answer: xr.Dataset) -> np.ndarray:
    axis = answer.sel(axis="figure")
    return np.stack([axis.X, axis.Y, axis.Z], axis=-1)


@lru_cache
def century(response: str) -> xr.Dataset:
    """Pole with every effect over a century."""
    return earthspin.pole(*CENTURY, effects=tuple(EFFECTS), response=response)


def from_the_iau(answer: xr.Dataset) -> np.ndarray:
    """Figure axis minus the pole of IAU 2006/2000A, mas, shape (t, 3)."""
    return (figure_axis(answer) - erfa.pnm06a(J2000_JD, days_of(answer))[:, 2]) / MAS


def coverage(answer: xr.Dataset) -> float:
    """Share of dates whose distance from the IAU is inside the claimed error."""
    distance = np.linalg.norm(from_the_iau(answer), axis=1)
    return float(np.mean(distance <= answer.direction_error.values * 1000))


def test_the_nonrigid_pole_is_that_of_the_iau() -> None:
    answer = century("fitted")
    distance = np.linalg.norm(from_the_iau(answer), axis=1)
    assert distance.max() < 1  # 0.66 mas measured, 33.5 from another start
    at_epoch = earthspin.pole(times=["2000-01-01T12:00"], effects=tuple(EFFECTS))
    assert np.linalg.norm(from_the_iau(at_epoch)) < 0.1  # 0.037 mas measured
    assert coverage(answer) >= 0.95  # 1.00 measured
    # an error of a few times the distance that it bounds
    assert answer.direction_error.max() * 1000 < 2 * distance.max()


def test_what_the_nonrigid_pole_leaves_is_the_closure_of_the_rates() -> None:
    answer = century("fitted")
    slope = np.polynomial.polynomial.polyfit(days_of(answer) / 365.25, from_the_iau(answer), 1)[1]
    budget = 1000 * earthspin.compare_iau()
    sine = np.sin(EPSILON_0.value * ARCSEC)
    # -0.0094 and -0.0071 mas/yr measured, for -0.0140 and -0.0085 in the budget; the analysis
    # misses the rates of the IAU's own pole by 0.0046 and 0.0015
    for axis, name, scale in ((0, "psi", sine), (1, "omega", 1.0)):
        closure = budget.closure if name == "psi" else budget.omega_closure
        analysis = float(budget[f"{name}_rate_analysis_error"])
        assert slope[axis] == pytest.approx(float(closure) * scale, abs=1.1 * analysis * scale)


@pytest.mark.slow
def test_the_predicted_pole_is_near_that_of_the_iau() -> None:
    answer = century("predicted")
    difference = from_the_iau(answer)
    sizes = earthspin.run_tree(earthspin.Scene(compute="iau"), "residual_sizes")["residual_sizes"]
    rms = sizes.residual_rms.sel(model="predicted").values
    near = (answer.time >= np.datetime64("1990")) & (answer.time < np.datetime64("2010"))
    assert np.all(np.abs(difference[near.values].mean(axis=0)[:2]) < rms)
    assert coverage(answer) >= 0.95  # 0.97 measured


def test_the_nonrigid_pole_is_the_observed_one() -> None:
    table = iers.IERS_A.open(iers.IERS_A_FILE)
    observed = table[np.isin(table["NutFlag"], ["I", "B"]) & (table["MJD"] > 51544 * u.d)][::40]
    times = Time(observed["MJD"], format="mjd", scale="utc").tdb
    days = times.jd1 - J2000_JD + times.jd2
    x, y, _ = erfa.pnm06a(J2000_JD, days)[:, 2].T
    x = x + observed["dX_2000A"].to_value("rad")
    y = y + observed["dY_2000A"].to_value("rad")
    dates = np.datetime64("2000-01-01T12:00") + (days * 86400e6).astype("timedelta64[us]")
    answer = earthspin.pole(times=dates, effects=tuple(EFFECTS))
    axis = figure_axis(answer)
    distance = np.hypot(axis[:, 0] - x, axis[:, 1] - y) / MAS
    # 0.42 mas measured: IAU 2006/2000A itself is 0.34 mas rms from these observations, most of it
    # the free core nutation, which no model contains
    assert np.sqrt(np.mean(distance**2)) < 0.6


def test_the_rigid_pole_is_as_far_from_the_iaus_as_its_neglected_effects_say() -> None:
    answer = earthspin.pole(*CENTURY, effects=RIGID)
    distance = np.linalg.norm(from_the_iau(answer), axis=1)
    size = np.array([RESPONSE.at(day) / MAS for day in days_of(answer)])
    assert np.all(distance <= size + 1)  # the nonrigid pole is 0.66 mas from the IAU's
    assert distance.max() > 0.8 * size.max()  # 88 mas measured


def test_a_kernel_without_j2000_will_do(tmp_path: Path) -> None:
    from jplephem.excerpter import write_excerpt
    from jplephem.spk import SPK

    path = tmp_path / "late.bsp"
    kernel = SPK.open(str(DE421))
    with path.open("w+b") as excerpt:
        write_excerpt(kernel, excerpt, 2453371.5, 2471184.5, list(kernel.daf.summaries()))
    kernel.close()
    answer = earthspin.pole(
        "2006-01-01", "2050-01-01", "30 d", effects=tuple(EFFECTS), ephemeris=str(path)
    )
    assert coverage(answer) >= 0.95


def test_torques_follow_from_positions_read_by_astropy() -> None:
    answer = earthspin.torque_series("1995-01-03", "2015-01-01", "29.7 d")
    days = days_of(answer)
    equator = erfa.pmat06(J2000_JD, days)
    times = Time(J2000_JD, days, format="jd", scale="tdb")
    with solar_system_ephemeris.set(str(DE421)):
        earth = get_body_barycentric("earth", times)
        for name, body in (("sun", earthspin.SUN), ("moon", earthspin.MOON)):
            place = (get_body_barycentric(name, times) - earth).xyz.to_value(u.m)
            x, y, z = np.einsum("tij,jt->it", equator, place)
            distance = np.sqrt(x * x + y * y + z * z)
            ours = answer.sel(perturber=name)
            bound = np.radians(ours.direction_error.item() / 3600)
            alpha, delta = np.radians(ours.right_ascension), np.radians(ours.declination)
            direction = [
                np.cos(alpha) * np.cos(delta), np.sin(alpha) * np.cos(delta), np.sin(delta)
            ]  # fmt: skip
            off = np.linalg.norm(np.stack(direction) - np.stack([x, y, z]) / distance, axis=0)
            assert np.all(off <= bound)
            assert np.all(np.abs(ours.distance - distance) <= ours.distance_error.item())
            # I.9.34 with C - A = J2 M a2
            excess = EARTH.j2 * EARTH.gm / G.value * EARTH.radius**2
            torque = 3 * body.gm * excess * z / distance**5 * np.stack([y, -x, 0 * x])
            error = np.linalg.norm(ours.torque.values.T - torque, axis=0)
            assert np.all(error <= ours.torque_magnitude_error)


def test_polar_motion_is_that_of_astropys_reader() -> None:
    answer = earthspin.polar_motion()
    table = iers.IERS_B.open()
    np.testing.assert_allclose(answer.x, table["PM_x"].to_value("arcsec"), rtol=0, atol=1e-15)
    np.testing.assert_allclose(answer.y, table["PM_y"].to_value("arcsec"), rtol=0, atol=1e-15)
    dates = Time(table["MJD"], format="mjd", scale="utc").datetime64
    assert np.all(answer.time.values == dates)


def test_precession_angles_are_those_of_the_pole_that_pole_returns() -> None:
    """ERFA's psi_A and omega_A; without the rate of the interior psi_A was 21 mas/cy more."""
    tree = earthspin.run_tree(earthspin.compare_iau(), sections=["angles"])
    rate = tree["angles"].dataset.sel(angle="psi_A", degree=1)
    p03 = 5038.481507  # arcsec per century, Capitaine, Wallace & Chapront 2003
    assert float(rate.angle_coefficient_iau) == pytest.approx(p03, rel=1e-7, abs=0)
    apart = float(rate.angle_coefficient) - p03
    assert apart == pytest.approx(float(tree.dataset.closure) * 100, abs=2e-4)
    assert abs(apart) < 1.2 * float(rate.angle_coefficient_error)


@pytest.mark.parametrize(("name", "share"), [("mercury", 0.9), ("saturn", 0.9)])
def test_torques_contain_the_uncertainty_of_the_pole(name: str, share: float) -> None:
    """The pole moved by its 95 % half-width, to the sides: largest change of the declination."""
    body = earthspin.BODIES[name]
    span = ("2000-01-01", "2030-01-01", "20 d")
    series = earthspin.torque_series(*span, body=body)
    pole = body.needed("pole").true(0.0)
    half = 1.96 * body.pole_uncertainty
    largest = 0.0
    for side in np.linspace(0, np.pi, 8, endpoint=False):
        east = np.cross([0.0, 0.0, 1.0], pole) / np.hypot(pole[0], pole[1])
        moved = pole + half * (np.cos(side) * east + np.sin(side) * np.cross(pole, east))
        bodies = [body.replace(pole=direction(axis)) for axis in (moved, pole)]
        both = (earthspin.torque_series(*span, body=one).declination for one in bodies)
        largest = max(largest, float(abs(np.subtract(*both)).max()) * 3600)
    assert share < largest / float(series.direction_error[0]) < 1.01


def direction(vector: np.ndarray) -> tuple[str, str]:
    """Right ascension and declination."""
    angles = np.arctan2(vector[1], vector[0]), np.arctan2(vector[2], np.hypot(*vector[:2]))
    return tuple(f"{angle} rad" for angle in angles)

"""What the page on models, times and frames says, held to ERFA and to the definitions."""

from pathlib import Path

import erfa
import numpy as np
import pytest
from astropy.time import Time
from scipy.spatial.transform import Rotation

import earthspin
from earthspin import EARTH

DOCS = Path(__file__).parents[2] / "docs"
J2000 = 2451545.0
ARCSEC = np.pi / 180 / 3600


@pytest.mark.parametrize("equator", ["mean", "true"])
def test_directions_stand_on_the_equator_of_date_and_are_geometric(equator: str) -> None:
    """The Sun of ERFA's own theory (epv00, good to some arcseconds), turned by ERFA's matrices."""
    seen = earthspin.torque_series(times=["2026-05-01"], perturbers="sun", equator=equator)
    days = float(Time("2026-05-01", scale="tdb").jd - J2000)
    away = -erfa.epv00(J2000, days)[0]["p"]
    turned = (erfa.pmat06 if equator == "mean" else erfa.pnm06a)(J2000, days) @ away
    ra, dec = np.arctan2(turned[1], turned[0]), np.arcsin(turned[2] / np.linalg.norm(turned))
    # measured: 2.1e-8 rad; light time or aberration would be 1e-4, nutation 4e-5, precession 6e-3
    assert np.radians(seen.right_ascension.item()) == pytest.approx(
        ra % (2 * np.pi), abs=1e-7, rel=0
    )
    assert np.radians(seen.declination.item()) == pytest.approx(dec, abs=1e-7, rel=0)


def test_psi_grows_as_psi_a_and_holds_the_nutation() -> None:
    path = earthspin.pole("2020-01-01", "2020-01-01", "1 d").sel(axis="figure")
    days = float(Time("2020-01-01", scale="tdb").jd - J2000)
    _, psi_a, omega_a, *_ = erfa.p06e(J2000, days)
    dpsi, deps = erfa.nut06a(J2000, days)
    # measured: 0.013 and 0.009 arcsec; the Earth is not rigid
    assert path.psi.item() == pytest.approx((psi_a + dpsi) / ARCSEC, abs=0.06, rel=0)
    assert path.eps.item() == pytest.approx((omega_a + deps) / ARCSEC, abs=0.06, rel=0)


def test_signs_of_the_rate() -> None:
    def rate(**changes: float) -> float:
        body = EARTH.replace(**changes)
        return earthspin.precession(body=body, perturbers="sun").precession_rate[-1].item()

    assert rate() > 0
    assert rate(spin_period=-EARTH.spin_period) < 0
    assert rate(j2=-EARTH.j2) < 0


def test_the_torque_of_the_sun_never_turns_back() -> None:
    year = earthspin.torque_series("2026-01-01", "2027-01-01", "1 d", perturbers="sun")
    x = year.torque.sel(component="x").values
    assert x.min() > -1e-6 * x.max()
    assert x.mean() > 0.4 * x.max()


def test_quaternions_turn_the_body_into_inertial_axes() -> None:
    def turned(answer: object, vectors: np.ndarray) -> np.ndarray:
        assert answer.quaternion.values.tolist() == ["w", "x", "y", "z"]
        attitude = answer.attitude.transpose("time", "quaternion").values
        return Rotation.from_quat(attitude, scalar_first=True).apply(vectors)

    rotor = earthspin.free_rotor([1, 2, 2.5], [0.1, 1, 0.1], [0, 1, 5])
    body, inertial = (
        rotor[name].transpose("time", "component").values
        for name in ("omega_body", "omega_inertial")
    )
    # measured: 2.2e-16, and 3.3e-16 for the top
    assert np.allclose(turned(rotor, body), inertial, atol=2e-15, rtol=0)
    assert np.allclose(body[0], inertial[0], atol=1e-15, rtol=0)
    top = earthspin.run("top-loop")
    up = turned(top, np.tile([0.0, 0.0, 1.0], (top.time.size, 1)))[:, 2]
    assert np.allclose(up, np.cos(top.theta.values), atol=3e-15, rtol=0)

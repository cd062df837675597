"""What each cause of an error moves, and by how much."""

from dataclasses import replace

import numpy as np
import pytest

from earthspin.constants import ARCSEC, JULIAN_YEAR, NORMAL_95
from earthspin.secular.error_budget import AxisInputs, Uncertainty, changed, changes, shifted_orbit
from earthspin.secular.trajectory import solve
from tests.secular.setting import EARTHS, KYR, POLE, arcsec, earths

SETTING = AxisInputs(earths(), EARTHS, POLE)
TILT = NORMAL_95 * 0.001 * ARCSEC


def uncertainty(
    constant: float = 1e-6, earth: bool = True, start: tuple[float, ...] = (TILT,)
) -> Uncertainty:
    return Uncertainty(constant=constant, start=start, orbit=EARTHS.error, earth=earth)


def causes(
    constant: float = 1e-6, earth: bool = True, start: tuple[float, ...] = (TILT,)
) -> dict[str, AxisInputs]:
    """By cause; of the orbit's two ways the second."""
    return dict(changes(SETTING, uncertainty(constant, earth, start)))


def test_what_is_known_of_the_earth_alone_is_left_out_elsewhere() -> None:
    assert set(causes(earth=False)) == {"constant", "start", "orbit"}
    assert set(causes(earth=False, start=())) == {"constant", "orbit"}
    assert set(causes()) == {"constant", "start", "orbit", "J2 rate", "tides", "ellipticity"}


@pytest.mark.parametrize("tilt", [TILT, 0.9 * ARCSEC])
def test_the_start_is_tilted_by_its_half_width_towards_the_orbit_or_away(tilt: float) -> None:
    start = causes(start=(tilt,))["start"].start
    assert np.linalg.norm(start) == pytest.approx(1.0, rel=1e-15, abs=0)
    normal = EARTHS.at(np.zeros(1))[0][:, 0]
    moved = np.arccos(start @ normal) - np.arccos(POLE @ normal)
    assert abs(moved) == pytest.approx(tilt, rel=1e-6, abs=0)
    assert arcsec(start, POLE) * ARCSEC == pytest.approx(tilt, rel=1e-6, abs=0)


def test_the_start_is_moved_in_two_directions_across_one_another() -> None:
    found = changes(SETTING, uncertainty(earth=False, start=(TILT, TILT)))
    tilted, turned = (of.start - POLE for cause, of in found if cause == "start")
    assert np.linalg.norm(turned) == pytest.approx(TILT, rel=1e-6, abs=0)
    assert abs(tilted @ turned) < 1e-6 * TILT**2
    assert abs(turned @ EARTHS.at(np.zeros(1))[0][:, 0]) < 1e-6 * TILT


def test_constant_tides_and_ellipticity_change_by_their_half_widths() -> None:
    found, now, e2 = causes(3e-6), np.zeros(1), np.array([0.0167**2])
    before = earths().constant(now, e2)
    constant = found["constant"].precession.constant(now, e2)
    assert constant / before - 1 == pytest.approx([3e-6], rel=1e-6, abs=0)
    tides = found["tides"].precession.tides
    assert tides.moon / earths().tides.moon == pytest.approx(1.2, rel=1e-14, abs=0)
    assert tides.spin / earths().tides.spin == pytest.approx(1.2, rel=1e-14, abs=0)
    far = np.array([-10e6 * JULIAN_YEAR])
    drifted = found["ellipticity"].precession.constant(far, e2) / earths().constant(far, e2) - 1
    assert drifted == pytest.approx([-0.007], rel=1e-9, abs=0)


def test_the_j2_band_widens_where_its_rate_has_faded() -> None:
    found, e2 = causes()["J2 rate"].precession, np.array([0.0167**2])
    for years, acted in ((-1000, 0.2 * 1000), (-10_000, 10_000)):
        time = np.array([years * JULIAN_YEAR])
        more = found.constant(time, e2) / earths().constant(time, e2) - 1
        expected = earths().j2_rate * -acted * JULIAN_YEAR
        assert more == pytest.approx([expected], rel=1e-4, abs=0)


@pytest.mark.parametrize("way", [0, 1])
def test_a_moved_orbit_is_moved_by_its_error_and_still_an_orbit(way: int) -> None:
    times = np.linspace(-900, 900, 37) * KYR
    other = shifted_orbit(EARTHS, EARTHS.error, np.eye(2)[way])
    n, e, turning = other.at(times)
    n0, e0, turning0 = EARTHS.at(times)
    by_normal, by_shape = EARTHS.error(times)
    assert np.allclose(np.linalg.norm(n, axis=0), 1, rtol=0, atol=1e-15)
    assert np.allclose(np.linalg.norm(n - n0, axis=0), by_normal, rtol=1e-3, atol=1e-12)
    assert np.allclose(np.linalg.norm(e - e0, axis=0), by_shape, rtol=1e-9, atol=1e-15)
    assert np.array_equal(turning, turning0)
    assert other.coverage == EARTHS.coverage
    assert np.array_equal(other.edges, EARTHS.edges)


def test_an_orbit_is_moved_in_two_directions_across_one_another() -> None:
    now = np.zeros(1)
    n, e, _ = EARTHS.at(now)
    found = changes(SETTING, uncertainty())
    (n1, e1, _), (n2, e2, _) = (of.orbit.at(now) for cause, of in found if cause == "orbit")
    by_normal, by_shape = EARTHS.error(now)
    assert abs(np.sum((n1 - n) * (n2 - n))) < 1e-5 * by_normal[0] ** 2
    assert abs(np.sum((e1 - e) * (e2 - e))) < 1e-5 * by_shape[0] ** 2


def test_past_ten_thousand_years_the_earth_itself_counts_most() -> None:
    time = np.array([-100 * KYR])
    mine = solve(earths(), EARTHS, POLE, (time[0], 0.0)).at(time)
    off = {
        cause: arcsec(solve(of.precession, of.orbit, of.start, (time[0], 0.0)).at(time), mine)
        for cause, of in causes().items()
    }
    assert max(off, key=lambda cause: off[cause]) in {"tides", "ellipticity", "J2 rate"}
    assert off["start"] < 0.1


def test_a_circular_orbit_can_be_moved() -> None:
    circle = replace(
        EARTHS, coefficients=EARTHS.coefficients * [[[1.0]], [[1.0]], [[0.0]], [[0.0]]]
    )
    half_widths = lambda times: np.full((2, times.size), 1e-6)  # noqa: E731
    n, e, _ = shifted_orbit(circle, half_widths, (1.0, 0.0)).at(np.zeros(1))
    assert np.linalg.norm(n - circle.at(np.zeros(1))[0]) == pytest.approx(1e-6, rel=1e-6, abs=0)
    assert np.linalg.norm(e) == pytest.approx(1e-6, rel=1e-6, abs=0)


def test_all_causes_change_at_once() -> None:
    """Each as far as alone: the orbit's two ways add as vectors."""
    amounts = np.array([0.5, -1.0, 0.3, -0.4, 2.0, -0.7, 1.5])
    now, far, e2 = np.zeros(1), np.array([-1e5 * JULIAN_YEAR]), np.array([0.0167**2])
    together = changed(SETTING, uncertainty(3e-6), amounts)
    factors = [1.0, 1.0]
    for place in (0, 4, 5, 6):
        alone = changed(SETTING, uncertainty(3e-6), amounts * (np.arange(7) == place))
        for at, time in enumerate((now, far)):
            before = SETTING.precession.constant(time, e2)
            factors[at] *= float((alone.precession.constant(time, e2) / before).item())
    for factor, time in zip(factors, (now, far), strict=True):
        changed_by = together.precession.constant(time, e2) / SETTING.precession.constant(time, e2)
        # products of two changes are left out
        assert changed_by - 1 == pytest.approx([factor - 1], rel=1e-3, abs=0)
    assert arcsec(together.start, POLE) == pytest.approx(NORMAL_95 * 0.001, rel=1e-6, abs=0)
    n, _, _ = together.orbit.at(now)
    by_normal = EARTHS.error(now)[0, 0]
    tilt = np.linalg.norm(n - EARTHS.at(now)[0])
    assert tilt == pytest.approx(0.5 * by_normal, rel=1e-6, abs=0)

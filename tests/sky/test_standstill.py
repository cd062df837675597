"""Standstills, against Skyfield and a minimiser."""

import numpy as np
import pytest
import xarray as xr
from scipy.optimize import minimize_scalar
from skyfield.api import load, load_file

from earthspin.sky.ephemeris import find_kernel
from earthspin.sky.iau_models import find_standstills, node_passages


@pytest.mark.parametrize("number", [0, 7, 14, 22, 31])
def test_each_extreme_is_one_of_skyfields(precession_tree: xr.DataTree, number: int) -> None:
    """Same month, same declination, by another library's kernel reading and a minimiser."""
    import erfa

    kernel, scale = load_file(str(find_kernel("de421"))), load.timescale(builtin=True)
    moon = kernel["moon"] - kernel["earth"]
    found = precession_tree["standstills"].to_dataset().isel(standstill=number)
    day = found.standstill.values
    sign = np.sign(float(found.standstill_declination))
    centre = (day - np.datetime64("2000-01-01T12")) / np.timedelta64(1, "D")

    def minus_swing(offset: float) -> float:
        jd = 2451545.0 + centre + offset
        x, y, z = erfa.pmat06(jd, 0.0) @ moon.at(scale.tdb_jd(jd)).position.km
        return float(-sign * np.degrees(np.arctan2(z, np.hypot(x, y))))

    best = minimize_scalar(minus_swing, bounds=(-3, 3), method="bounded", options={"xatol": 1e-8})
    kernel.close()
    assert abs(best.x) < 2e-5  # measured: 5.3e-6, half a second
    off = abs(-sign * best.fun - float(found.standstill_declination))
    assert off < 5e-10  # deg; measured: 9e-11


def test_north_and_south_alternate_every_nine_years(precession_tree: xr.DataTree) -> None:
    both = precession_tree["standstills"].to_dataset()
    assert list(both.standstill_kind.values) == ["minor", "minor", "major", "major"] * 8
    for sign in (1, -1):
        _alternate(both.sel(standstill=np.sign(both.standstill_declination) == sign))


def _alternate(standstills: xr.Dataset) -> None:
    assert list(standstills.standstill_kind.values) == ["minor", "major"] * 8
    years = np.diff(standstills.standstill.values) / np.timedelta64(365250, "h") * 1000 / 24
    assert np.all((years > 8.3) & (years < 10.3))


def test_they_are_beyond_the_textbooks_limits(precession_tree: xr.DataTree) -> None:
    standstills = precession_tree["standstills"]
    swing = abs(standstills.standstill_declination)
    major = swing[standstills.standstill_kind == "major"]
    minor = swing[standstills.standstill_kind == "minor"]
    # 28.73 and 18.14: extremes of the envelope by an independent scan of the kernel
    assert abs(float(major.max()) - 28.73) < 0.01
    assert abs(float(minor.min()) - 18.14) < 0.01
    assert float(major.min()) > 28.58
    assert float(minor.max()) < 18.30


def test_a_wave_of_known_swing() -> None:
    """A made-up declination whose widest month is known."""
    passage = next(day for kind, day in node_passages(0, 9000) if kind == "major")

    def declination(days: np.ndarray) -> np.ndarray:
        envelope = 0.4 + 0.1 * np.cos(2 * np.pi * (days - passage) / 6798.0)
        return envelope * np.cos(2 * np.pi * (days - passage) / 27.32)

    found = [s for s in find_standstills(declination, 0, 9000) if s.kind == "major"]
    north, south = sorted(found, key=lambda s: -s.declination)
    # the widest month is at the passage; half a month away the envelope is 2e-6 lower
    assert north.day == pytest.approx(passage, abs=0.01)
    assert north.declination == pytest.approx(0.5, abs=1e-7)
    assert abs(south.day - passage) == pytest.approx(27.32 / 2, abs=0.01)
    assert south.declination == pytest.approx(-0.5, abs=1e-5)


def test_a_span_too_short_to_hold_one() -> None:
    assert find_standstills(np.sin, 0.0, 300.0) == []
    assert find_standstills(np.sin, 0.0, 1.0) == []

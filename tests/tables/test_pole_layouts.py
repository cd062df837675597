"""Published layouts of the pole, made from C04: read as C04, in each unit and order of columns."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import earthspin
from earthspin.constants import ARCSEC, MAS
from earthspin.sky import eop

DAYS = 30


@pytest.fixture(scope="module")
def c04() -> dict[str, np.ndarray]:
    """Numbers of January 2020: x, y and errors in arcsec, dX, dY in mas."""
    pole = eop.read_polar_motion().between(58849, 58848 + DAYS)
    offsets = eop.read_pole_offsets().between(58849, 58848 + DAYS)
    return {
        "mjd": pole.mjd,
        **{n: getattr(pole, n) / ARCSEC for n in ("x", "y", "x_error", "y_error")},
        "dx": offsets.x / MAS,
        "dy": offsets.y / MAS,
    }


def igs(c: dict[str, np.ndarray]) -> str:
    """IGSMAIL-1943: microarcseconds, names above units."""
    head = (
        "version 2\nSource: sessions of 2020\n\n"
        "   MJD        Xpole   Ypole  UT1-UTC    LOD  Xsig  Ysig   UTsig  LODsig  Nr Nf Nt     Xrt"
        "    Yrt  Xrtsig  Yrtsig\n"
        '              (10**-6")       (0.1 usec)    (10**-6")     (0.1 usec)              '
        '(10**-6"/d)    (10**-6"/d)\n'
    )
    rows = zip(*(c[n] for n in ("mjd", "x", "y", "x_error", "y_error")), strict=True)
    return head + "\n".join(
        f"{mjd:9.2f} {1e6 * x:.0f} {1e6 * y:.0f} -1771665 3000 {1e6 * ex:.0f} {1e6 * ey:.0f} 20 30"
        " 90 10 90 -2641 399 20 20"
        for mjd, x, y, ex, ey in rows
    )


def eop_all(c: dict[str, np.ndarray]) -> str:
    """CelesTrak: observed rows, then predicted ones."""
    rows = [
        f"2020 01 {day + 1:02d} {mjd:.0f} {x:9.6f} {y:9.6f} -0.1771554  0.0004406 -0.112 -0.010 "
        f"{dx / 1e3:9.6f} {dy / 1e3:9.6f}  37"
        for day, (mjd, x, y, dx, dy) in enumerate(
            zip(*(c[n] for n in ("mjd", "x", "y", "dx", "dy")), strict=True)
        )
    ]
    predicted = "2020 02 05 58884 0.9 0.9 0 0 0 0 0 0 37"
    return (
        f"VERSION 1.1\n#   Date    MJD\nNUM_OBSERVED_POINTS {DAYS}\nBEGIN OBSERVED\n"
        + "\n".join(rows)
        + f"\nEND OBSERVED\nNUM_PREDICTED_POINTS 1\nBEGIN PREDICTED\n{predicted}\nEND PREDICTED\n"
    )


def bulletin_b(c: dict[str, np.ndarray]) -> str:
    """IERS: milliarcseconds; lines of text that begin with numbers, and a second section."""
    rows = [
        f"2020   1 {day + 1:3d}  {mjd:.0f} {1e3 * x:9.3f} {1e3 * y:9.3f} -177.1554 "
        f"{dx:.3f} {dy:.3f} {1e3 * ex:.3f} {1e3 * ey:.3f} 0.0105 0.030 0.030"
        for day, (mjd, x, y, ex, ey, dx, dy) in enumerate(zip(*c.values(), strict=True))
    ]
    head = "          BULLETIN B 385\n1 February 2020\n1 - DAILY FINAL VALUES OF x, y\n"
    tail = "\n  2 - CELESTIAL POLE OFFSETS dPsi1980\n2020 1 1 58849 -1 -2 3\n"
    return head + "\n".join(rows) + tail


def eoxy(c: dict[str, np.ndarray]) -> str:
    """IVS: arcseconds, offsets in milliarcseconds, the name of a session among the numbers."""
    names = ("mjd", "x", "y", "dx", "dy", "x_error", "y_error")
    return "%=IVS-EOP 2.2 GSF 2020\n# MJD x y UT1 dX dY\n" + "\n".join(
        f" {mjd:.6f} {x:.6f} {y:.6f} -0.177 {dx:.3f} {dy:.3f} {ex:.6f} {ey:.6f} 0.00001 0.03 0.03 "
        "35.2 0.1 0.2 0.3 0.4 4321 R1928 24.0 0.1 -0.2 0.3 - - - - - - - -"
        for mjd, x, y, dx, dy, ex, ey in zip(*(c[n] for n in names), strict=True)
    )


def eop2(c: dict[str, np.ndarray]) -> str:
    """JPL: milliarcseconds, in cells; rows after the last data point are predicted."""
    head = (
        " $  Last UTPM Data Point   2020-01-30T00:00:00 UTC\n"
        " $  Last DX,DY Data Point  2020-01-30T00:00:00 UTC\n EOP2=\n"
    )
    rows = [
        f" {mjd:.1f}, {1e3 * x:.6f}, {1e3 * y:.6f}, 36944.1, {1e3 * ex:.4f}, {1e3 * ey:.4f}, "
        f"0.1, 0.0, 0.0, 0.0, {dx:.5f}, {dy:.5f}, 0.3, 0.4, 0.0, $ x"
        for mjd, x, y, ex, ey, dx, dy in zip(*c.values(), strict=True)
    ]
    return head + "\n".join([*rows, rows[-1].replace("58878", "58879")])


@pytest.mark.parametrize("layout", [igs, eop_all, bulletin_b, eoxy, eop2])
def test_it_is_read_as_c04(
    tmp_path: Path, c04: dict[str, np.ndarray], layout: Callable[[dict[str, np.ndarray]], str]
) -> None:
    file = tmp_path / "table.txt"
    file.write_text(layout(c04))
    pole = earthspin.polar_motion(file=file)
    assert np.allclose(pole.x, c04["x"], rtol=0, atol=1e-6)
    assert np.allclose(pole.y, c04["y"], rtol=0, atol=1e-6)
    if layout not in (igs, eop_all):
        offsets = eop.read_pole_offsets(file)
        assert np.allclose(offsets.x / MAS, c04["dx"], rtol=0, atol=1e-3)
        assert np.allclose(offsets.y / MAS, c04["dy"], rtol=0, atol=1e-3)
    if layout is not eop_all:
        assert np.allclose(pole.x_error / 1.96, c04["x_error"], rtol=1e-3, atol=1e-6)
    assert pole.x.attrs["references"] != "IERS c04"

"""Tables of polar motion and of excitation: read whole, or refused by line."""

from pathlib import Path

import numpy as np
import pytest

import earthspin
from earthspin import SeriesError
from earthspin.constants import ARCSEC, MAS
from earthspin.sky import eop


@pytest.fixture(scope="module")
def lines() -> list[str]:
    """Head and four hundred days of C04."""
    return eop.c04_path().read_text().splitlines()[:406]


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "pole.txt"


def test_c04_against_astropys_own_reader() -> None:
    from astropy.utils.iers import IERS_B

    table = IERS_B.open()
    series = eop.read_polar_motion()
    assert series.name == "c04"
    assert series.repairs == ""
    assert np.array_equal(series.mjd, table["MJD"].value)
    assert np.allclose(series.x / ARCSEC, table["PM_x"].to_value("arcsec"), rtol=0, atol=1e-15)
    assert np.allclose(series.y / ARCSEC, table["PM_y"].to_value("arcsec"), rtol=0, atol=1e-15)
    assert np.allclose(
        series.x_error / ARCSEC, table["e_PM_x"].to_value("arcsec"), rtol=0, atol=1e-15
    )
    assert series.step == 1


def test_finals_against_c04() -> None:
    finals = eop.read_polar_motion(eop.c04_path().with_name("finals2000A.all"))
    assert finals.name == "finals2000A"
    c04 = eop.read_polar_motion().between(55000, 60000)
    late = finals.between(55000, 60000)
    assert np.max(abs(late.x - c04.x)) < 1 * MAS
    assert np.max(abs(late.y - c04.y)) < 1 * MAS


def test_c01_by_hand(file: Path) -> None:
    years = 1890 + 0.05 * np.arange(60)
    rows = [f"{y:.2f}  {0.1 * np.cos(y):.6f} 0.02 {0.2:.6f} 0.03 0.0 0.0" for y in years]
    file.write_text("# C01\n" + "\n".join(rows))
    series = eop.read_polar_motion(file)
    assert series.name == "c01"
    # 1900.0 Besselian is JD 2415020.31352
    assert series.mjd[0] == pytest.approx(15019.81352 - 10 * 365.242198781, rel=1e-15, abs=0)
    assert series.step == pytest.approx(18.2621, abs=1e-4)
    assert series.x[0] / ARCSEC == pytest.approx(0.1 * np.cos(1890), abs=1e-6)
    assert series.y_error[3] / ARCSEC == pytest.approx(0.03, rel=1e-15, abs=0)


def test_the_older_layout_of_c04(file: Path) -> None:
    row = "{}   1 {:2d}  {}   0.1   0.2   0.03 0.0017 0.0 0.0   0.03 0.04 0.002 0.0014 0.0 0.0"
    file.write_text("\n".join(row.format(1962, d + 1, 37665 + d) for d in range(5)))
    series = eop.read_polar_motion(file)
    assert series.mjd[0] == 37665
    assert series.y[0] / ARCSEC == pytest.approx(0.2, rel=1e-15, abs=0)
    assert series.y_error[0] / ARCSEC == pytest.approx(0.04, rel=1e-15, abs=0)


def test_what_can_be_put_right_is_said(lines: list[str], file: Path) -> None:
    whole = lines.copy()
    del whole[100:103]  # a gap of three days
    whole[50], whole[60] = whole[60], whole[50]
    whole.insert(200, whole[200])
    whole[300] = whole[300][:26] + "         nan" + whole[300][38:]
    file.write_text("\n".join(whole))
    series = eop.read_polar_motion(file)
    for words in ("1 rows without numbers", "sorted by date", "1 repeated rows", "4 missing steps"):
        assert words in series.repairs
    assert np.all(np.diff(series.mjd) == 1)


def test_the_longest_gap_that_is_bridged(lines: list[str], file: Path) -> None:
    """Nine days without a row are ten steps; ten days are one too many."""
    file.write_text("\n".join(lines[:100] + lines[109:]))
    bridged = eop.read_polar_motion(file)
    assert "9 missing steps bridged" in bridged.repairs
    whole = eop.read_polar_motion().mjd[:400]
    assert np.array_equal(bridged.mjd, whole)
    file.write_text("\n".join(lines[:100] + lines[110:]))
    with pytest.raises(SeriesError, match=r"a gap of 11.0 d"):
        eop.read_polar_motion(file)


def damaged(lines: list[str], how: str) -> list[str]:
    whole = lines.copy()
    if how == "cut":
        whole[-1] = whole[-1][:80]
    if how == "cut in errors":
        whole[-1] = whole[-1][:130]
    if how == "long gap":
        del whole[100:140]
    if how == "contradiction":
        whole.insert(200, whole[200][:26] + "    0.123456" + whole[200][38:])
    if how == "mas":
        whole[150] = whole[150][:26] + "   123.45600" + whole[150][37:]
    if how == "word":
        whole[20] = whole[20][:26] + "       pole " + whole[20][38:]
    if how == "empty":
        whole = whole[:6]
    if how == "one row":
        whole = whole[:7]
    if how == "prose":
        whole = ["this is no table", "1 2 3"]
    return whole


@pytest.mark.parametrize(
    ("how", "message"),
    [
        ("cut", "line 406: 10 columns; 12 or more .* cut off"),
        ("cut in errors", "line 406: .*cut off"),
        ("long gap", r"line 100: a gap of 41.0 d follows MJD \d+"),
        ("contradiction", "stands twice"),
        ("mas", "line 151: .* milliarcseconds"),
        ("word", "line 21: could not convert"),
        ("empty", "none of the known tables"),
        ("one row", "holds 1 rows"),
        ("prose", "none of the known tables"),
    ],
)
def test_what_cannot_is_refused(lines: list[str], file: Path, how: str, message: str) -> None:
    file.write_text("\n".join(damaged(lines, how)))
    with pytest.raises(SeriesError, match=message) as caught:
        earthspin.polar_motion(file=file)
    assert "\n" not in str(caught.value)


def test_missing_files_and_kinds(file: Path) -> None:
    with pytest.raises(SeriesError, match="No such file"):
        eop.read_polar_motion(file)
    with pytest.raises(SeriesError, match="kind 'c05' is unknown"):
        eop.read_polar_motion(kind="c05")
    with pytest.raises(SeriesError, match="choose a span inside it"):
        earthspin.polar_motion(span=("1900-01-01", "1950-01-01"))


EAM = """# effective angular momentum functions
 2000  1  1  0  51544.000  1.0e-07 2.0e-07 3.0e-07  1.0e-08 -2.0e-08 0.0
 2000  1  1  3  51544.125  1.1e-07 2.1e-07 3.0e-07  1.0e-08 -2.0e-08 0.0
 2000  1  1  6  51544.250  1.2e-07 2.2e-07 3.0e-07  1.0e-08 -2.0e-08 0.0
"""


def test_excitation_files(file: Path) -> None:
    file.write_text(EAM)
    read = eop.read_angular_momentum(file)
    assert np.allclose(
        read.chi, [1.1e-7 + 1.8e-7j, 1.2e-7 + 1.9e-7j, 1.3e-7 + 2e-7j], rtol=0, atol=1e-20
    )
    chi = earthspin.read_excitation(file)
    assert float(chi.chi1[0]) == pytest.approx(1.1e-7 / MAS, rel=1e-15, abs=0)
    driven = earthspin.polar_motion_from(chi, period=433.0, quality_factor=100.0)
    assert driven.time.size == 4
    assert float(driven.x[0]) == 0
    # dp/dt = -i s (chi - p): the first step of an eighth of a day
    assert float(driven.x[1]) * 1e3 == pytest.approx(
        2 * np.pi / 433 / 8 * 1.8e-7 / MAS, rel=0.01, abs=0
    )


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("3.0e-07  1.0e-08 -2.0e-08 0.0\n 2000  1  1  6", "\n 2000  1  1  6", "7 columns"),
        ("51544.125", "51544.200", "step changes"),
        ("1.1e-07", "11.0", "radians"),
        ("1.1e-07", "pole", "could not convert"),
    ],
)
def test_damaged_excitation_files(file: Path, old: str, new: str, message: str) -> None:
    file.write_text(EAM.replace(old, new))
    with pytest.raises(SeriesError, match=message):
        earthspin.read_excitation(file)
    file.write_text("# nothing\n")
    with pytest.raises(SeriesError, match="holds 0 rows"):
        eop.read_angular_momentum(file)

"""Celestial pole offsets: read from the columns that the IERS documents, and only if observed."""

from pathlib import Path

import numpy as np
import pytest

from earthspin import SeriesError
from earthspin.constants import ARCSEC, MAS
from earthspin.sky import eop


def test_c04_against_astropys_own_reader() -> None:
    from astropy.utils.iers import IERS_B

    table = IERS_B.open()
    series = eop.read_pole_offsets()
    rows = np.searchsorted(table["MJD"].value, series.mjd)
    assert np.array_equal(table["MJD"].value[rows], series.mjd)
    for name, column in (("x", "dX_2000A"), ("y", "dY_2000A")):
        expected = table[column].to_value("arcsec")[rows]
        assert np.allclose(getattr(series, name) / ARCSEC, expected, rtol=0, atol=1e-15)
    # the rows before have zeros in both columns, which no observation gave
    observed = table["dX_2000A"].to_value("arcsec") != 0
    assert series.mjd[0] == table["MJD"].value[observed][0] == 45700
    assert "rows of zeros at the start" in series.repairs


def test_finals_by_its_documented_columns() -> None:
    """ReadMe.finals2000A: flag in column 96, dX in 98-106, error 107-115, dY 117-125, 126-134."""
    lines = eop.finals_path().read_text().splitlines()
    rows = [line for line in lines if line[95:96] == "I"]
    series = eop.read_pole_offsets("finals")
    assert series.name == "finals2000A"
    assert np.array_equal(series.mjd, [float(line[7:15]) for line in rows])
    for name, first in (("x", 98), ("x_error", 107), ("y", 117), ("y_error", 126)):
        cells = [float(line[first - 1 : first + 8]) for line in rows]
        assert np.allclose(getattr(series, name) / MAS, cells, rtol=1e-13, atol=0)
    # 2000 May 20, read by eye
    day = int(np.searchsorted(series.mjd, 51684))
    values = [series.x[day], series.x_error[day], series.y[day], series.y_error[day]]
    assert np.allclose(np.array(values) / MAS, [-0.211, 0.213, -0.118, 0.146], rtol=1e-12, atol=0)


def test_what_is_predicted_is_left_out() -> None:
    """The flag of dX, dY ends before that of x, y, and both before the predictions do."""
    lines = eop.finals_path().read_text().splitlines()
    offsets, pole = eop.read_pole_offsets("finals"), eop.read_polar_motion("finals")
    flagged = [float(line[7:15]) for line in lines if line[95:96] == "P"]
    assert not np.isin(offsets.mjd, flagged).any()
    assert offsets.mjd[-1] < pole.mjd[-1] < float(flagged[-1])
    predicted = [float(line[7:15]) for line in lines if line[16:17] == "P"]
    assert not np.isin(pole.mjd, predicted).any()


def test_a_row_that_loses_its_flag_is_no_observation(tmp_path: Path) -> None:
    lines = [line for line in eop.finals_path().read_text().splitlines() if line[95:96] == "I"]
    rows = lines[5000:5100]
    rows[-1] = f"{rows[-1][:95]}P{rows[-1][96:]}"
    file = tmp_path / "finals.txt"
    file.write_text("\n".join(rows))
    assert eop.read_pole_offsets(file).mjd[-1] == float(rows[-2][7:15])
    assert eop.read_polar_motion(file).mjd[-1] == float(rows[-1][7:15])


def test_the_two_tables_agree() -> None:
    """Measured since 2000: 0.11 and 0.10 mas rms."""
    c04, finals = (eop.read_pole_offsets(name).between(51544, 60000) for name in ("c04", "finals"))
    for name in ("x", "y"):
        assert np.std(getattr(c04, name) - getattr(finals, name)) < 0.15 * MAS


def test_offsets_from_an_older_model_are_refused(tmp_path: Path) -> None:
    rows = eop.c04_path().read_text().splitlines()[-60:]
    old = [f"{row[:62]}   -0.110000{row[74:]}" for row in rows]
    assert old[0].split()[8] == "-0.110000"
    file = tmp_path / "old.txt"
    file.write_text("\n".join(old))
    with pytest.raises(SeriesError, match=r"line 1: dX, dY = -0\.11,.*IAU 1980"):
        eop.read_pole_offsets(file, "c04")
    assert eop.read_polar_motion(file, "c04").mjd.size == 60


def test_c01_by_year_has_none(tmp_path: Path) -> None:
    file = tmp_path / "c01.txt"
    file.write_text("1900.0 0.1 0.01 0.1 0.01\n1900.1 0.1 0.01 0.1 0.01\n")
    with pytest.raises(SeriesError, match="a table C01 by year holds no dX, dY"):
        eop.read_pole_offsets(file, "c01")


def test_c01_by_date(tmp_path: Path) -> None:
    """Columns 5, 6 and 10, 11 of the real table."""
    excerpt = Path(__file__).parent.parent / "data" / "eopc01-excerpt.txt"
    rows = [line.split() for line in excerpt.read_text(errors="replace").splitlines()]
    late = [row for row in rows if row and row[0][0] != "#" and float(row[0]) > 46000]
    file = tmp_path / "late.txt"
    file.write_text("\n".join(" ".join(row) for row in late))
    series = eop.read_pole_offsets(file, "c01")
    first = next(row for row in late if float(row[4]) or float(row[5]))
    assert series.mjd[0] == pytest.approx(float(first[0]), abs=1e-3)
    values = [series.x[0], series.y[0], series.x_error[0], series.y_error[0]]
    expected = [float(first[i]) for i in (4, 5, 9, 10)]
    assert np.allclose(np.array(values) / ARCSEC, expected, rtol=1e-12, atol=1e-15)

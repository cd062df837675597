"""Celestial pole offsets: read from the columns that the IERS documents, and only if observed."""

from pathlib import Path

import erfa
import numpy as np
import pytest
from astropy.time import Time

import earthspin
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
    assert "rows of zeros, not observed, left out, 1962-01-01 to 1983-12-31" in series.repairs


def test_finals_by_its_documented_columns() -> None:
    """ReadMe.finals2000A: flag in column 96, dX in 98-106, error 107-115, dY 117-125, 126-134."""
    lines = eop.file_of("finals").read_text().splitlines()
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
    lines = eop.file_of("finals").read_text().splitlines()
    offsets, pole = eop.read_pole_offsets("finals"), eop.read_polar_motion("finals")
    flagged = [float(line[7:15]) for line in lines if line[95:96] == "P"]
    assert not np.isin(offsets.mjd, flagged).any()
    assert offsets.mjd[-1] < pole.mjd[-1] < float(flagged[-1])
    predicted = [float(line[7:15]) for line in lines if line[16:17] == "P"]
    assert not np.isin(pole.mjd, predicted).any()


def test_a_row_that_loses_its_flag_is_no_observation(tmp_path: Path) -> None:
    lines = [line for line in eop.file_of("finals").read_text().splitlines() if line[95:96] == "I"]
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
    rows = eop.file_of("c04").read_text().splitlines()[-60:]
    old = [f"{row[:62]}   -0.110000{row[74:]}" for row in rows]
    assert old[0].split()[8] == "-0.110000"
    file = tmp_path / "old.txt"
    file.write_text("\n".join(old))
    with pytest.raises(SeriesError, match=r"line 1: dX, dY = -0\.11,.*IAU 1980"):
        eop.read_pole_offsets(file, "c04")
    assert eop.read_polar_motion(file, "c04").mjd.size == 60


def from_iau_1980(mjd: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Offsets of the same pole in longitude and obliquity from the IAU models of 1976 and 1980."""
    plus = [
        model + offset
        for model, offset in zip(erfa.xys06a(2400000.5, mjd)[:2], (x, y), strict=True)
    ]
    pole = np.stack([*plus, np.sqrt(1 - plus[0] ** 2 - plus[1] ** 2)], axis=-1)
    across, along, _ = np.einsum("nij,nj->in", erfa.pnm80(2400000.5, mjd), pole)
    return np.array([across / np.sin(erfa.obl80(2400000.5, mjd)), along])


def test_offsets_from_iau_1980_by_another_way() -> None:
    """The finals.all of 1990-01-01 has -5.258 mas in longitude."""
    series = eop.read_pole_offsets().between(47892, 47893)
    longitude, _ = from_iau_1980(series.mjd, series.x, series.y) / MAS
    assert longitude[0] == pytest.approx(-5.258, abs=0.3)


def rows_of_c04(mjd: np.ndarray, offsets: np.ndarray) -> str:
    """Text in the 16 columns of the series C04 until 2022."""
    dates = [Time(day, format="mjd").ymdhms for day in mjd]
    return "\n".join(
        f"{d.year} {d.month} {d.day} {day:.0f} 0.1 0.3 0.1 0.001 {x:.6f} {y:.6f} "
        "0.0001 0.0001 0.00001 0.00001 0.0002 0.0002"
        for d, day, (x, y) in zip(dates, mjd, offsets.T / ARCSEC, strict=True)
    )


@pytest.mark.parametrize("year", range(1984, 1992))
def test_a_year_of_offsets_from_iau_1980_is_refused(tmp_path: Path, year: int) -> None:
    first = Time(f"{year}-01-01").mjd
    series = eop.read_pole_offsets().between(first, first + 364)
    pairs = np.array([series.x, series.y]), from_iau_1980(series.mjd, series.x, series.y)
    assert abs(pairs[1]).max() < 21 * MAS
    for name, offsets in zip(("new", "old"), pairs, strict=True):
        (tmp_path / name).write_text(rows_of_c04(series.mjd, offsets))
    assert np.allclose(eop.read_pole_offsets(tmp_path / "new").x, series.x, rtol=0, atol=1e-3 * MAS)
    with pytest.raises(SeriesError, match="IAU 1980"):
        earthspin.pole_offsets(file=str(tmp_path / "old"))


def test_small_offsets_from_iau_1980_are_refused(tmp_path: Path) -> None:
    """Days of 1985 on which no offset passes 5 mas: only the comparison of tables can tell."""
    first = Time("1985-01-01").mjd
    series = eop.read_pole_offsets().between(first, first + 364)
    offsets = from_iau_1980(series.mjd, series.x, series.y)
    small = np.max(abs(offsets), axis=0) < 4.9 * MAS
    assert small.sum() > 20
    (tmp_path / "old").write_text(rows_of_c04(series.mjd[small], offsets[:, small]))
    with pytest.raises(SeriesError, match="mas from finals2000A"):
        earthspin.pole_offsets(file=str(tmp_path / "old"))


def test_finals_all_before_august_1992_is_refused(tmp_path: Path) -> None:
    """The rows of finals2000A with the offsets of finals.all in the same columns, mas."""
    rows = [line for line in eop.file_of("finals").read_text().splitlines() if line[95:96] == "I"]
    rows = [line for line in rows if float(line[7:15]) < 48835]
    (tmp_path / "new").write_text("\n".join(rows))
    assert eop.read_pole_offsets(tmp_path / "new").mjd.size == len(rows)
    series = eop.read_pole_offsets("finals").between(0, 48834)
    offsets = from_iau_1980(series.mjd, series.x, series.y) / MAS
    old = [
        f"{row[:97]}{x:9.3f}{row[106:116]}{y:9.3f}{row[125:]}"
        for row, (x, y) in zip(rows, offsets.T, strict=True)
    ]
    for first in (0, len(old) - 3000):  # from 1980, and from 1984
        (tmp_path / "old").write_text("\n".join(old[first:]))
        with pytest.raises(SeriesError, match="IAU 1980"):
            eop.read_pole_offsets(tmp_path / "old")


def test_rows_outside_the_installed_tables_have_a_limit(tmp_path: Path) -> None:
    days = np.arange(42048.0, 42058.0)  # in 1974
    for size, fits in ((4.9, True), (5.1, False)):
        (tmp_path / "t").write_text(rows_of_c04(days, np.full((2, 10), size * MAS)))
        if fits:
            assert eop.read_pole_offsets(tmp_path / "t").x[0] == pytest.approx(
                size * MAS, rel=1e-14, abs=0
            )
        else:
            with pytest.raises(SeriesError, match="IAU 1980"):
                eop.read_pole_offsets(tmp_path / "t")


def test_the_published_c01_from_1962_on(tmp_path: Path) -> None:
    """Optical offsets of 0.09 arcsec stand before; between, zeros until there are observations."""
    excerpt = Path(__file__).parent.parent / "data" / "eopc01-excerpt.txt"
    rows = [line.split() for line in excerpt.read_text(errors="replace").splitlines()]
    rows = [row for row in rows if row and row[0][0] != "#"]
    optical, late = ([r for r in rows if low < float(r[0]) < low + 9000] for low in (17000, 46000))
    step = 18.262
    start, end = float(optical[-1][0]), float(late[0][0])
    between = [
        [f"{mjd:.3f}", *optical[-1][1:4], "0", "0", *optical[-1][6:]]
        for mjd in np.linspace(start, end, round((end - start) / step) + 1)[1:-1]
    ]
    file = tmp_path / "eopc01.txt"
    file.write_text("\n".join(" ".join(row) for row in [*optical, *between, *late]))
    with pytest.raises(SeriesError, match=r"1962.*span"):
        earthspin.pole_offsets(file=str(file))
    answer = earthspin.pole_offsets(file=str(file), span=("1962-01-01", "1988-01-01"))
    observed = [row for row in late if float(row[4]) and float(row[0]) < 47161]
    assert answer.time.size == len(observed)
    assert answer.dX.values == pytest.approx([1e3 * float(row[4]) for row in observed], abs=2e-3)


def test_c01_by_year(tmp_path: Path) -> None:
    """The columns as published: year, x, y, UT1-TAI, dX and dY, each followed by its error."""
    file = tmp_path / "c01.txt"
    file.write_text(
        "#  an  x  x_er  y  y_er  UT1-TAI  UT1_er  dX  dX_er  dY  dY_er\n"
        "2023.35 0.09 0.0001 0.49 0.0001 -37.0 0.00003 0.000170 0.000100 -0.000210 0.000100\n"
        "2023.40 0.106036 0.000100 0.490185 0.000100 -37.0160727 0.0000300 0.000169 0.000100 "
        "-0.000209 0.000100\n"
    )
    series = eop.read_pole_offsets(file)
    values = [series.x[1], series.y[1], series.x_error[1], series.y_error[1]]
    assert np.array(values) / MAS == pytest.approx([0.169, -0.209, 0.1, 0.1], rel=1e-12, abs=0)
    assert eop.read_polar_motion(file).y[1] == pytest.approx(0.490185 * ARCSEC, rel=1e-14, abs=0)
    file.write_text("1900.0 0.1 0.01 0.1 0.01\n1900.1 0.1 0.01 0.1 0.01\n")
    with pytest.raises(SeriesError, match=r"5 columns.*dX, dY"):
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

"""UT1 and length of day of tables: one series in all layouts, and tables that are refused."""

from pathlib import Path

import numpy as np
import pytest
from astropy.utils import iers

from earthspin.errors import SeriesError
from earthspin.sky import eop
from earthspin.sky.universal_time import UniversalTime, read_universal_time, tai_minus_utc

LEAP_SECONDS = [53736, 54832, 56109, 57204, 57754]


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "table"


def lines_of(name: str, first: int, last: int) -> list[str]:
    """Rows of a carried table between two modified Julian dates."""
    place = slice(7, 15) if name == "finals" else slice(18, 26)
    lines = eop.file_of(name).read_text().splitlines()
    return [
        x for x in lines if not x.startswith("#") and first <= float(x[place].split(".")[0]) <= last
    ]


def test_leap_seconds_are_taken_out() -> None:
    for name in ("c04", "finals"):
        series = read_universal_time(name, span=(53000, 59000))
        rows = np.searchsorted(series.mjd, LEAP_SECONDS)
        assert np.max(abs(np.diff(series.ut1_minus_tai)[rows - 1])) < 0.003
        assert np.allclose(np.diff(series.ut1_minus_utc)[rows - 1], 1.0, rtol=0, atol=0.003)


def test_tai_minus_utc_of_bulletins() -> None:
    """USNO: 4.3131700 s + 0.002592 s a day from 1966, 4.2131700 from 1968, whole from 1972."""
    mjd = np.array([39126.0, 39226.0, 41316.0, 41317.0, 57753.0, 57754.0])
    expected = [4.31317, 4.31317 + 0.2592, 4.21317 + (41316 - 39126) * 0.002592, 10, 36, 37]
    assert np.allclose(tai_minus_utc(mjd), expected, rtol=0, atol=1e-9)


def test_tables_agree_with_astropy_and_with_one_another() -> None:
    table = iers.IERS_A.open(iers.IERS_A_FILE)
    series = read_universal_time("finals")
    expected = table["UT1_UTC_A"][np.isfinite(table["UT1_UTC_A"])].value
    assert np.max(abs(series.ut1_minus_utc - expected)) < 1e-12
    c04, finals = (read_universal_time(n, span=(50000, 61000)) for n in ("c04", "finals"))
    assert np.max(abs(c04.ut1_minus_tai - finals.ut1_minus_tai)) < 3e-4
    assert np.max(abs(c04.length_of_day - finals.length_of_day)) < 3e-4
    # the length of day is the change of UT1 in a day, central differences
    slope = (c04.ut1_minus_tai[:-2] - c04.ut1_minus_tai[2:]) / 2
    assert np.std(slope - c04.length_of_day[1:-1]) < 5e-5


def test_predicted_rows_are_marked() -> None:
    series = read_universal_time("finals")
    lines = [x for x in lines_of("finals", 41684, 99999) if x[58:68].strip()]
    assert series.predicted.tolist() == [x[57] == "P" for x in lines]
    assert np.isnan(series.length_of_day[series.predicted]).all()
    assert not read_universal_time().predicted.any()


CSV = (
    "MJD;Type;x_pole;sigma_x_pole;y_pole;sigma_y_pole;Type;UT1-UTC;sigma_UT1-UTC;"
    "LOD;sigma_LOD;Type;dPsi;sigma_dPsi;dEpsilon;sigma_dEpsilon;dX;sigma_dX;dY;sigma_dY"
)


def csv(series: UniversalTime, types: list[str], unit: float) -> str:
    """Table of the IERS data centre."""
    columns = (series.ut1_minus_utc, series.ut1_error)
    days = (series.length_of_day / unit, series.length_of_day_error / unit)
    rows = zip(series.mjd, types, *columns, *days, strict=True)
    pole, offsets = "0.1;0.01;0.3;0.01", ";;;;0.1;0.1;0.1;0.1"
    lines = [f"{m:.0f};{t};{pole};{t};{u};{e};{d};{f};{t};{offsets}" for m, t, u, e, d, f in rows]
    return "\n".join([CSV, *lines])


@pytest.mark.parametrize(
    "layout", ["finals.csv", "c04.csv", "finals", "c04", "named", "EOP-All.csv"]
)
def test_one_series_in_all_layouts(file: Path, layout: str) -> None:
    name = "finals" if "finals" in layout else "c04"
    series = read_universal_time(name, span=(57744, 57764))
    columns = None
    if layout == "named":
        rows = zip(series.mjd, 1e3 * series.length_of_day, series.ut1_minus_utc, strict=True)
        file.write_text("\n".join(f"{m:.0f} {lod:.5f} {ut1:.8f}" for m, lod, ut1 in rows))
        columns = "mjd, lod (ms), ut1 (s)"
    elif layout == "EOP-All.csv":
        rows = zip(series.mjd, series.ut1_minus_utc, series.length_of_day, strict=True)
        lines = [f"{m:.0f},0.1,0.3,{ut1},{lod},0,0,0,0,36,O" for m, ut1, lod in rows]
        file.write_text("\n".join(["MJD,X,Y,UT1-UTC,LOD,DPSI,DEPS,DX,DY,DAT,DATA_TYPE", *lines]))
        columns = ""
    elif layout.endswith("csv"):
        word, unit = ("final", 1e-3) if name == "finals" else ("", 1.0)
        file.write_text(csv(series, [word] * 20 + ["prediction" if word else ""], unit))
    else:
        file.write_text("\n".join(lines_of(name, 57744, 57764)))
    read = read_universal_time(file, columns)
    for field in ("mjd", "ut1_minus_tai", "length_of_day"):
        assert np.allclose(getattr(read, field), getattr(series, field), rtol=0, atol=1e-7)
    if columns is None:
        assert np.allclose(read.ut1_error, series.ut1_error, rtol=1e-9, atol=0)
        assert np.allclose(read.length_of_day_error, series.length_of_day_error, rtol=1e-9, atol=0)
    assert read.predicted.tolist() == [False] * 20 + [layout == "finals.csv"]


@pytest.mark.parametrize(
    "columns",
    [
        "mjd, lod (s), ut1 (s)",
        "mjd, lod (ms), ut1 (ms)",
        "mjd, lod (ms), -ut1 (s)",
        "mjd, ut1 (s), lod (s)",
        "mjd, lod (ms), x (s)",
    ],
)
def test_another_meaning_is_refused(file: Path, columns: str) -> None:
    series = read_universal_time(span=(57744, 57764))
    rows = zip(series.mjd, 1e3 * series.length_of_day, series.ut1_minus_utc, strict=True)
    file.write_text("\n".join(f"{m:.0f} {lod:.5f} {ut1:.8f}" for m, lod, ut1 in rows))
    with pytest.raises(SeriesError):
        read_universal_time(file, columns)


@pytest.mark.parametrize("damage", ["digit", "row", "cut", "one"])
def test_damaged_tables_are_refused(file: Path, damage: str) -> None:
    lines = lines_of("finals", 57744, 57764)
    if damage == "digit":
        lines[5] = lines[5][:59] + "9" + lines[5][60:]
    elif damage == "row":
        del lines[5:7]
    elif damage == "one":
        del lines[1:]
    else:
        lines[-1] = lines[-1][:75]
    file.write_text("\n".join(lines))
    with pytest.raises(SeriesError):
        read_universal_time(file)

"""Meaning of columns: declared, compared with the Earth, and offered in another form if wrong."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import polars as pl
import pytest
import xarray as xr

import earthspin
from earthspin import EarthspinError, SeriesError
from earthspin.constants import ARCSEC
from earthspin.sky import eop
from tests.sky.test_orbit_files import elements, la2010

#: Values of La2004 (Laskar et al. 2004) from today to 4000 years ago: kyr ago, eccentricity,
#: obliquity and longitude of perihelion in radians.
LA2004 = np.array(
    [
        (0, 1.6709072796e-02, 4.0909226760e-01, 1.7964355440e00),
        (1, 1.7114572348e-02, 4.1135368290e-01, 1.4974042827e00),
        (2, 1.7497147218e-02, 4.1355583329e-01, 1.1994738151e00),
        (3, 1.7853348054e-02, 4.1564276595e-01, 9.0348882298e-01),
        (4, 1.8176827632e-02, 4.1755854564e-01, 6.0877226132e-01),
    ]
)


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "table.txt"


def offered(call: Callable[[], Any]) -> str:
    """Columns that a message offers last."""
    with pytest.raises(SeriesError) as error:
        call()
    keys = re.findall(r"columns='([^']*)'", str(error.value))
    assert keys, str(error.value)
    return str(keys[-1])


# --- solutions ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("time", "columns"),
    [
        (1.0, "epoch (kyr ago)"),
        (1e3, "epoch (yr ago)"),
        (-1e3, "epoch (yr)"),
        (1e-3, "epoch (Myr ago)"),
    ],
)
def test_times_of_tables_without_names(file: Path, time: float, columns: str) -> None:
    np.savetxt(file, LA2004 * [time, 1, 1, 1])
    found = offered(lambda: earthspin.read_solution(file))
    assert found == f"{columns}, eccentricity, obliquity (rad), longitude_of_perihelion (rad)"
    solution = earthspin.read_solution(file, columns=found)
    assert solution.epoch.values.tolist() == [-4000, -3000, -2000, -1000, 0]
    assert solution.attrs["body"] == "earth"


@pytest.mark.parametrize(
    ("wrong", "right"),
    [
        ("epoch (kyr)", "epoch (kyr ago)"),
        ("epoch (Myr ago)", "epoch (kyr ago)"),
        ("longitude_of_perihelion (rad)", "longitude_of_perigee (rad)"),
        ("obliquity (deg)", "obliquity (rad)"),
        ("eccentricity", "climatic_precession"),
    ],
)
def test_declared_columns_that_agree_only_otherwise(file: Path, wrong: str, right: str) -> None:
    e, perihelion = LA2004[:, 1], LA2004[:, 3]
    table = {
        "epoch (kyr ago)": LA2004[:, 0],
        "obliquity (rad)": LA2004[:, 2],
        "longitude_of_perigee (rad)": perihelion + np.pi,
        "climatic_precession": e * np.sin(perihelion),
    }
    np.savetxt(file, np.transpose([*table.values()]))
    sound = ", ".join(table)
    assert earthspin.read_solution(file, columns=sound).attrs["body"] == "earth"
    assert (
        offered(lambda: earthspin.read_solution(file, columns=sound.replace(right, wrong))) == sound
    )


def test_toy_models_are_read_as_declared(file: Path) -> None:
    k = np.arange(60.0)
    np.savetxt(file, np.transpose([k, 0.03 * np.sin(k / 3)]), delimiter=",")
    toy = earthspin.read_solution(file, columns="epoch (ka), climatic_precession")
    assert toy.climatic_precession.values[-1] == 0
    assert "body" not in toy.attrs


@pytest.mark.parametrize(
    ("header", "columns"),
    [
        ("kyr_BP,eccentricity", "epoch (kyr BP), eccentricity"),
        ("time (ka before 2000),ecc", "epoch (ka before 2000), eccentricity"),
        ("age,tilt", "epoch (kyr ago), eccentricity"),  # by its numbers
    ],
)
def test_headers_that_are_not_understood(file: Path, header: str, columns: str) -> None:
    np.savetxt(file, LA2004[:, :2], delimiter=",", header=header, comments="")
    with pytest.raises(SeriesError, match=re.escape(header.replace(",", ", "))):
        earthspin.read_solution(file)
    assert offered(lambda: earthspin.read_solution(file)) == columns
    assert earthspin.read_solution(file, columns=columns).epoch.values[0] < -3999


@pytest.mark.parametrize("header", ["year,ecc\n", "time (yr),ecc\n", "Year (CE),ecc\n", ""])
def test_years_of_the_calendar_are_not_offered_as_epochs(file: Path, header: str) -> None:
    """The year 2000 is epoch 0: by as many years is a reading off that has epochs for years."""
    rows = [f"{year},{0.01670909 - 4.2e-7 * (year - 2000)}" for year in range(1900, 2101, 20)]
    file.write_text(header + "\n".join(rows))
    with pytest.raises(SeriesError, match="subtract 2000" if header else "name them") as error:
        earthspin.read_solution(file)
    assert "columns='epoch (yr)" not in str(error.value)


def test_a_missing_number_is_named_with_the_columns_without_it(file: Path) -> None:
    file.write_text("epoch (kyr),eccentricity,obliquity (deg)\n-1,NA,23.57\n0,0.0167,23.44\n")
    columns = offered(lambda: earthspin.read_solution(file))
    assert "eccentricity" not in earthspin.read_solution(file, columns=columns)


def test_epochs_are_the_decimal_numbers_of_the_file(file: Path) -> None:
    """-17.4 times 1000 is -17399.999999999996 in floats, and no label of `long_term`."""
    past = earthspin.long_term("-20 kyr", "0 kyr", "0.1 kyr")
    rows = [f"{-place / 10:.1f} {e}" for place, e in enumerate(past.eccentricity.values[::-1])]
    file.write_text("\n".join(rows))
    assert earthspin.read_solution(file).epoch.values[26] == -17400.0


def test_files_of_mars_say_so(file: Path) -> None:
    past = earthspin.long_term("-5 kyr", "0 kyr", "1 kyr", body="mars")
    names = ["eccentricity", "obliquity", "longitude_of_perihelion"]
    rows = past[names].to_dataframe()[names]
    rows[names[1:]] = np.radians(rows[names[1:]])
    rows.index = rows.index / 1000
    rows.to_csv(file, sep=" ", header=False)
    assert earthspin.read_solution(file).attrs["body"] == "mars"


@pytest.mark.parametrize("frame", [pd.DataFrame, pl.DataFrame])
def test_solutions_in_data_frames(frame: Callable[[Any], Any]) -> None:
    table = frame({"epoch (ka)": LA2004[:, 0], "obliquity (rad)": LA2004[:, 2]})
    solution = earthspin.read_solution(table)
    assert float(solution.obliquity[-1]) == pytest.approx(23.43926, rel=0, abs=1e-5)


# --- poles ----------------------------------------------------------------------------------------


def pole(days: int = 60, first: float = 58849) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Modified Julian dates, x and y of C04 from a day on, by default of 2020, arcsec."""
    seen = eop.read_polar_motion().between(first, first - 1 + days)
    return seen.mjd, seen.x / ARCSEC, seen.y / ARCSEC


@pytest.mark.parametrize(
    ("change", "columns"),
    [
        (lambda x, y: (x, -y), "mjd, x (arcsec), -y (arcsec)"),
        (lambda x, y: (y, x), "mjd, y (arcsec), x (arcsec)"),
        (lambda x, y: (1e3 * x, 1e3 * y), "mjd, x (mas), y (mas)"),
        (lambda x, y: (10 * x, 10 * y), "mjd, x (0.1 arcsec), y (0.1 arcsec)"),
        (lambda x, y: (ARCSEC * x, ARCSEC * y), "mjd, x (rad), y (rad)"),
    ],
)
@pytest.mark.parametrize("header", ["MJD,x,y", ""])
def test_poles_that_agree_only_otherwise(
    file: Path, change: Callable[..., Any], columns: str, header: str
) -> None:
    mjd, x, y = pole()
    np.savetxt(file, np.transpose([mjd, *change(x, y)]), delimiter=",", header=header, comments="")
    found = offered(lambda: earthspin.polar_motion(file=file))
    assert found == columns
    again = earthspin.polar_motion(file=file, columns=found)
    assert np.allclose(again.x, x, rtol=1e-12, atol=0)
    assert np.allclose(again.y, y, rtol=1e-12, atol=0)
    assert earthspin.run(again).equals(again)


@pytest.mark.parametrize("width", [5, 16, 21])
def test_a_number_of_columns_alone_is_not_believed(file: Path, width: int) -> None:
    """Dates as in tables of the IERS, but numbers of no pole."""
    mjd = 58849 + np.arange(40)
    dates = [(2020, 1 + day // 31, 1 + day % 31) for day in range(40)]
    head = [
        (*date, 0, day) if width == 21 else (*date, day)
        for date, day in zip(dates, mjd, strict=True)
    ]
    if width == 5:
        head = [(2010.05 + row / 20,) for row in range(40)]
    rows = [(*first, *([0.4] * (width - len(first)))) for first in head]
    np.savetxt(file, rows, fmt="%.10g")
    with pytest.raises(SeriesError, match="from finals2000A"):
        earthspin.polar_motion(file=file)


def test_zeros_without_error_are_no_observations(file: Path) -> None:
    """C01 has them for y from 1858.9 to 1860.9; the years before are read by span."""
    mjd = -1000 + 36.5242 * np.arange(80)
    rows = [
        f"{day:.3f} 0.1 {0 if 20 <= row < 40 else 0.1} 0 0 0 0.07 {0 if 20 <= row < 40 else 0.09}"
        + " 0" * 21
        for row, day in enumerate(mjd)
    ]
    file.write_text("\n".join(rows))
    series = eop.read_polar_motion(file)
    assert series.mjd[0] == pytest.approx(mjd[40], abs=1e-3)
    assert "20 rows of zeros, not observed, left out, 1858-02-" in series.repairs
    early = earthspin.polar_motion(file=file, span=("1856-03-01", "1857-12-31"))
    assert early.sizes["time"] > 15
    assert not (early.y == 0).any()


def test_a_header_with_decimal_years_is_confirmed_or_declared(file: Path) -> None:
    """Half a year off, as the year of the middle would be; C04 at the years of the table is right.

    The Besselian epoch 2000.0 is JD 2451544.533 (Lieske 1979, A&A 73, 282).
    """
    years = 2000 + 0.05 * np.arange(60)
    seen = eop.read_polar_motion()
    mjd = 51544.033 + (years - 2000) * 365.242198781

    def write(mjd: np.ndarray) -> None:
        x, y = (np.interp(mjd, seen.mjd, values / ARCSEC) for values in (seen.x, seen.y))
        np.savetxt(file, np.transpose([years, x, y]), header="year x y", comments="")

    write(mjd)
    assert eop.read_polar_motion(file).mjd[0] == pytest.approx(mjd[0], abs=0.01)
    write(mjd + 180)
    with pytest.raises(SeriesError, match="arcsec from finals2000A; give kind='c01'"):
        earthspin.polar_motion(file=file)
    assert earthspin.polar_motion(file=file, kind="c01").sizes["time"] == 60
    years -= 90
    write(mjd)
    with pytest.raises(SeriesError, match="fewer than 5 days of finals2000A; give kind='c01'"):
        earthspin.polar_motion(file=file)


def test_a_quantity_that_a_header_has_twice(file: Path) -> None:
    mjd, x, y = pole()
    rows = pd.DataFrame(np.transpose([mjd, x, y, 0 * x]))
    table = rows.set_axis(["MJD", "x (arcsec)", "y (arcsec)", "x (arcsec)"], axis=1)
    with pytest.raises(EarthspinError, match="header has 'x' twice"):
        earthspin.polar_motion(file=table)
    table.to_csv(file, index=False)
    with pytest.raises(SeriesError, match="header has 'x' twice"):
        earthspin.polar_motion(file=file)
    columns = "mjd, x (arcsec), y (arcsec),"
    assert np.allclose(earthspin.polar_motion(file=file, columns=columns).x, x, rtol=1e-12, atol=0)
    file.write_text("epoch (kyr),obliquity (deg),obliquity (rad)\n0,23.44,0\n-1,23.57,0\n")
    with pytest.raises(SeriesError, match="'obliquity' stands twice"):
        earthspin.read_solution(file)
    orbit = la2010()
    with pytest.raises(SeriesError, match="header has 'k' twice"):
        earthspin.read_orbit(pd.concat([orbit, 0 * orbit[["k"]]], axis=1))


def labelled(index: Callable[[pd.DatetimeIndex], Any]) -> pd.DataFrame:
    """Table of pandas with the pole of some days, and another index."""
    _, x, y = pole()
    days = pd.date_range("2020-01-01", periods=60)
    return pd.DataFrame({"x (arcsec)": x, "y (arcsec)": y}, index=index(days))


@pytest.mark.parametrize(
    "table",
    [
        labelled(lambda days: days).set_axis(['x(")', 'y(")'], axis=1),
        labelled(lambda days: days.to_period("D")),
        labelled(lambda days: xr.date_range("2020-01-01", periods=60, use_cftime=True)),
        labelled(lambda days: pd.Index(days.strftime("%Y-%m-%d"), name="date")),
        labelled(lambda days: pd.Index(58849 + np.arange(60), name="MJD")),
        labelled(lambda days: pd.Index(2458849.5 + np.arange(60), name="JD")),
        pl.DataFrame(labelled(lambda days: days).reset_index(names="time").to_dict("list")),
    ],
    ids=["quotes", "period", "cftime", "text", "MJD", "JD", "polars"],
)
def test_tables_of_pandas_and_polars(table: Any) -> None:
    _, x, y = pole()
    read = earthspin.polar_motion(file=table)
    assert np.allclose(read.x, x, rtol=0, atol=1e-15)
    assert np.allclose(read.y, y, rtol=0, atol=1e-15)
    assert str(read.time.values[0])[:10] == "2020-01-01"


@pytest.mark.parametrize("names", [("x_pole", "y_pole"), ("PM_x", "PM_y"), ("Xpole", "Ypole")])
def test_names_of_the_pole(names: tuple[str, str]) -> None:
    table = labelled(lambda days: days).set_axis([*names], axis=1)
    table.attrs["units"] = "arcsec"
    assert earthspin.polar_motion(file=table).sizes["time"] == 60
    with pytest.raises(EarthspinError, match=r"name the column 'x \(arcsec\)'"):
        earthspin.polar_motion(file=pl.DataFrame(table.reset_index(names="time").to_dict("list")))
    table = table.set_axis(["east", "north"], axis=1)
    with pytest.raises(EarthspinError, match="'x' along 'time', or a table with that column"):
        earthspin.polar_motion(file=table)


def test_all_calls_take_the_same_things(file: Path) -> None:
    mjd, x, y = pole(6000, 51544)
    np.savetxt(file, np.transpose([mjd, 1e3 * x, 1e3 * y]))
    columns = "mjd, x (mas), y (mas)"
    frame = pl.DataFrame({"MJD": mjd, "x (mas)": 1e3 * x, "y (mas)": 1e3 * y})
    for given in (
        {"ds": file, "columns": columns},
        {"ds": frame},
        {"ds": str(file), "columns": columns},
    ):
        assert float(earthspin.fit_chandler(**given).chandler_period) == pytest.approx(433, abs=20)
        assert earthspin.excitation(**given).sizes["time"] == mjd.size - 1
        named = {"file" if name == "ds" else name: value for name, value in given.items()}
        assert earthspin.polar_motion(**named).sizes["time"] == mjd.size
        ahead = earthspin.forecast(5, **named)
        assert float(ahead.x[0]) == pytest.approx(x[-1], rel=0, abs=0.01)
    with pytest.raises(EarthspinError, match="rename the columns"):
        earthspin.polar_motion(file=frame, columns=columns)


# --- orbits ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("change", "right"),
    [
        (lambda t: t.rename(columns={"omega": "varpi"}), "omega (deg)"),
        (lambda t: t.assign(t=-t.t), "t (d ago)"),
        (lambda t: t.assign(inc=np.radians(t.inc)), "inc (rad)"),
    ],
)
def test_orbits_that_agree_only_otherwise(
    change: Callable[[pd.DataFrame], pd.DataFrame], right: str
) -> None:
    table = change(elements().drop(columns="varpi"))
    columns = offered(lambda: earthspin.read_orbit(table))
    assert right in columns
    known = earthspin.long_term("-15 kyr", "0 kyr", "5 kyr")
    read = earthspin.read_orbit(table, columns=columns)
    again = earthspin.long_term("-15 kyr", "0 kyr", "5 kyr", orbit=read)
    assert float(abs(again.climatic_precession - known.climatic_precession).max()) < 1e-4
    assert float(abs(again.obliquity - known.obliquity).max()) < 1e-3


def test_a_file_of_mercury_by_its_names(file: Path) -> None:
    """The default layout of Mercury6: "peri" is the argument of the perihelion."""
    table = elements()
    head = "\n EARTHMOO\n\n    Time (years)  a  e  i  peri  node  M  mass\n"
    rows = np.transpose(
        [
            table.t / 365.25,
            table.a,
            table.e,
            table.inc,
            table.omega,
            table.Omega,
            0 * table.t,
            0 * table.t,
        ]
    )
    file.write_text(head + "\n".join(" ".join(f"{x:.10g}" for x in row) for row in rows))
    ours = earthspin.long_term("-40 kyr", "0 kyr", "10 kyr")
    theirs = earthspin.long_term("-40 kyr", "0 kyr", "10 kyr", orbit=earthspin.read_orbit(file))
    off = abs(theirs.climatic_precession - ours.climatic_precession)
    assert float(off.max()) < 1e-4


def test_a_header_that_contradicts_a_key(file: Path) -> None:
    table = la2010().rename(columns={"t": "t (kyr)"})
    table.to_csv(file, index=False)
    assert file.name in earthspin.read_orbit(file, time="kyr").source
    with pytest.raises(EarthspinError, match=r"header has 't \(kyr\)'; leave out time"):
        earthspin.read_orbit(file, time="yr")


@pytest.mark.parametrize(
    ("text", "columns", "words"),
    [
        ("MJD,x (m),y (m)\n58849,0.1,0.2\n58850,0.1,0.2\n", None, r"unit of 'x \(m\)'.*x \(arcsec"),
        ("1 0.1 0.2\n2 0.1 0.2\n", "x (mas), y (mas),", "no column of dates; name one of year"),
        ("1 0.1 0.2\n2 0.1 0.2\n", "mjd, x (mas), x (mas)", "'x' stands twice"),
        ("1 0.1 0.2\n2 0.1 0.2\n", "mjd, x (mas), z (mas)", "'z' is unknown"),
        ("1 0.1 0.2\n2 0.1 0.2\n", "mjd, x (mas)", "3 columns, of which 2 are named"),
    ],
)
def test_columns_that_cannot_be_read(
    file: Path, text: str, columns: str | None, words: str
) -> None:
    file.write_text(text)
    with pytest.raises(SeriesError, match=words):
        earthspin.polar_motion(file=file, columns=columns)


def test_a_span_beside_a_gap_of_the_real_table_is_read() -> None:
    """Rows of C01 from 1846 to 2022, most of which are left out in the excerpt."""
    excerpt = Path(__file__).parent.parent / "data" / "eopc01-excerpt.txt"
    with pytest.raises(SeriesError, match="take a span on one side of it"):
        earthspin.polar_motion(file=excerpt)
    part = earthspin.polar_motion(file=excerpt, span=("1912-04-16", "1913-01-01"))
    assert float(part.x[0]) == pytest.approx(-0.161046, rel=0, abs=1e-5)  # row of MJD 19512.277

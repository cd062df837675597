"""Tables of polar motion and of excitation: read whole, or refused by line."""

import gzip
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import earthspin
from earthspin import SeriesError
from earthspin.constants import ARCSEC, MAS
from earthspin.sky import eop, pole_tables
from tests.reference import simulation


@pytest.fixture(scope="module")
def lines() -> list[str]:
    """Head and four hundred days of C04."""
    return eop.file_of("c04").read_text().splitlines()[:406]


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
    finals = eop.read_polar_motion(eop.file_of("c04").with_name("finals2000A.all"))
    assert finals.name == "finals2000A"
    c04 = eop.read_polar_motion().between(55000, 60000)
    late = finals.between(55000, 60000)
    assert np.max(abs(late.x - c04.x)) < 1 * MAS
    assert np.max(abs(late.y - c04.y)) < 1 * MAS


EXCERPT = Path(__file__).parent.parent / "data" / "eopc01-excerpt.txt"


def part_of_c01(first: float, last: float) -> str:
    """Header and rows of the real table between two dates."""
    lines = EXCERPT.read_text(encoding="ascii", errors="replace").splitlines()
    rows = [x for x in lines if not x.startswith("#") and first < float(x.split()[0]) < last]
    return "\n".join([x for x in lines if x.startswith("#")] + rows)


@pytest.mark.parametrize("kind", ["c01", None])
def test_c01_as_it_is(file: Path, kind: str | None) -> None:
    """Rows of the IERS: x and y, not UT1-TAI, in steps of a tenth and of a twentieth of a year."""
    file.write_text(part_of_c01(19500, 19900))
    series = eop.read_polar_motion(file, kind)
    assert series.name == "c01"
    assert series.repairs == ""
    assert series.step == pytest.approx(365.242198781 / 20, abs=1e-4)
    # The row of MJD 19512.277, read by eye.
    assert series.x[0] / ARCSEC == pytest.approx(-0.161046, rel=1e-14, abs=0)
    assert series.y[0] / ARCSEC == pytest.approx(-0.041441, rel=1e-14, abs=0)
    assert series.x_error[0] / ARCSEC == pytest.approx(0.018693, rel=1e-14, abs=0)
    assert series.y_error[0] / ARCSEC == pytest.approx(0.021589, rel=1e-14, abs=0)
    file.write_text(part_of_c01(-5000, 0))
    assert eop.read_polar_motion(file, kind).step == pytest.approx(36.5242, abs=1e-4)
    late = file.with_name("late")
    late.write_text(part_of_c01(46000, 48000))
    c04 = eop.read_polar_motion()
    modern = eop.read_polar_motion(late, kind)
    for name in ("x", "y"):
        same = np.interp(modern.mjd, c04.mjd, getattr(c04, name))
        # measured: 4.9 mas; C01 is smoother and has other errors
        assert np.max(abs(getattr(modern, name) - same)) < 10 * MAS


def test_the_whole_excerpt_has_gaps(file: Path) -> None:
    with pytest.raises(SeriesError, match=r"line 54: a gap of 27046\.2 d"):
        eop.read_polar_motion(EXCERPT)


def rows_of_c01(mjd: np.ndarray, p: np.ndarray) -> str:
    """Synthetic rows in the layout of the real table."""
    rest = " 0.000000" * 21
    return "\n".join(
        f"{day:12.3f} {one.real:9.6f} {-one.imag:9.6f} -23.3092829 0.000000 0.000000 "
        f"0.020000 0.020000{rest}"
        for day, one in zip(mjd, p, strict=True)
    )


def test_a_fit_from_1890_to_2022(file: Path) -> None:
    """Synthetic rows in the layout of C01: the excerpt is too short for a fit."""
    step = 365.242198781 / 20
    time, p = simulation.simulate(132, 433.0, 96.0, step=step, seed=4)
    scatter = 20 * np.random.default_rng(1).standard_normal((time.size, 2)) @ [1, 1j]
    file.write_text(rows_of_c01(11368.5 + time, (p + scatter) / 1e3))
    pole = earthspin.polar_motion(file=file)
    for method in ("burg", "likelihood"):
        found = earthspin.fit_chandler(pole, method=method)
        assert abs(float(found.chandler_period) - 433) < float(found.chandler_period_error) < 4
        low, high = found.chandler_quality_factor_low, found.chandler_quality_factor_high
        assert float(low) < 96 < float(high)
    driven = earthspin.excitation(pole, period=433.0, quality_factor=96.0)
    assert driven.sizes["time"] == time.size - 1


def test_rows_of_both_steps_become_even(file: Path) -> None:
    """Tenths of a year before 1890 are halved by straight lines, and the cut is said."""
    year = 365.242198781
    mjd = 11368.5 + year * np.r_[-20:-1e-9:0.1, 0:20:0.05]
    p = 0.1 * np.exp(2j * np.pi * mjd / 433)
    file.write_text(rows_of_c01(mjd, p))
    series = eop.read_polar_motion(file)
    assert "200 missing steps bridged by straight lines" in series.repairs
    assert "a wobble of 433 d by up to 3.5%" in series.repairs
    off = abs(series.x - 1j * series.y - 0.1 * ARCSEC * np.exp(2j * np.pi * series.mjd / 433))
    assert 0.034 < np.max(off) / (0.1 * ARCSEC) < 0.0352  # (pi D/T)^2/2 = 0.0351
    fit = earthspin.fit_chandler(earthspin.polar_motion(file=file))
    assert float(fit.chandler_period) == pytest.approx(433, abs=0.3)


def test_steps_of_a_tenth_of_a_year(file: Path) -> None:
    """The oldest rows alone: one in 36.5 d is enough for all methods."""
    time, p = simulation.simulate(60, 433.0, 96.0, step=36.5242, seed=4)
    file.write_text(rows_of_c01(-4703.268 + time, p / 1e3))
    pole = earthspin.polar_motion(file=file)
    for method in ("burg", "likelihood"):
        found = earthspin.fit_chandler(pole, method=method)
        assert abs(float(found.chandler_period) - 433) < float(found.chandler_period_error)


def test_c01_by_hand(file: Path) -> None:
    years = 1890 + 0.05 * np.arange(60)
    rows = [f"{y:.2f}  {0.1 * np.cos(y):.6f} 0.02 {0.2:.6f} 0.03 0.0 0.0" for y in years]
    file.write_text("# C01\n" + "\n".join(rows))
    with pytest.raises(SeriesError, match=r"by years it has fewer than 5 days of.*kind='c01'"):
        eop.read_polar_motion(file)
    series = eop.read_polar_motion(file, "c01")
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


def test_finals_with_another_calendar(file: Path) -> None:
    rows = eop.file_of("c04").with_name("finals2000A.all").read_text().splitlines()[:400]
    file.write_text("\n".join(rows))
    assert eop.read_polar_motion(file, "finals2000A").mjd[0] == 41684
    file.write_text("\n".join([*rows[:99], "73 4 1" + rows[99][6:], *rows[100:]]))
    with pytest.raises(SeriesError, match="line 100: MJD"):
        eop.read_polar_motion(file)


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


@pytest.mark.parametrize("kind", ["text", "nan"])
def test_rows_that_are_lost_are_counted_and_named(lines: list[str], file: Path, kind: str) -> None:
    def spoil(line: str) -> str:
        return "x" + line if kind == "text" else line[:26] + "         nan" + line[38:]

    start = next(at for at, line in enumerate(lines) if line.strip() and line[0] != "#")
    rows = lines[start : start + 300]
    few = [spoil(row) if at in (50, 200) else row for at, row in enumerate(rows)]
    file.write_text("\n".join(few))
    repairs = eop.read_polar_motion(file).repairs
    assert "2 rows without numbers left out, the first in line 51" in repairs
    many = [spoil(row) if at % 9 == 5 else row for at, row in enumerate(rows)]
    file.write_text("\n".join(many))
    with pytest.raises(SeriesError, match="line 6: 33 of 300 rows") as error:
        eop.read_polar_motion(file)
    assert error.value.line == 6


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


def in_radians(row: str) -> str:
    words = row.split()
    words[5:7] = [f"{float(word) * ARCSEC:.9f}" for word in words[5:7]]
    return "  ".join(words)


def at(place: int, change: Callable[[str], str]) -> Callable[[list[str]], list[str]]:
    """Change one line of a table."""
    return lambda rows: [*rows[:place], change(rows[place]), *rows[place + 1 :]]


def words_of(change: Callable[[list[str]], list[str]]) -> Callable[[str], str]:
    """Change the words of a row."""
    return lambda row: "  ".join(change(row.split()))


def below(change: Callable[[str], str]) -> Callable[[list[str]], list[str]]:
    """Change every row."""
    return lambda rows: rows[:6] + [change(row) for row in rows[6:]]


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (lambda rows: [*rows[:-1], rows[-1][:80]], "line 406: 10 columns; 21 are .* cut off"),
        (lambda rows: [*rows[:-1], rows[-1][:130]], "line 406: .*cut off"),
        (lambda rows: rows[:100] + rows[140:], r"line 100: a gap of 41.0 d follows MJD \d+"),
        (
            lambda rows: [
                *rows[:200],
                rows[200][:26] + "    0.123456" + rows[200][38:],
                *rows[200:],
            ],
            "stands twice",
        ),
        (at(150, lambda row: row[:26] + "   123.45600" + row[37:]), "line 151: .* milliarcseconds"),
        (
            at(150, words_of(lambda words: words[:6] + words[7:])),
            "line 151: 20 columns; .* a column lost",
        ),
        (
            below(lambda row: row.replace(row[16:26], f"{float(row[16:26]) + 1e5:10.2f}", 1)),
            r"line 7: MJD 137665.00 differs from the calendar date, MJD 37665",
        ),
        (at(36, lambda row: row[:4] + "   2  30" + row[12:]), "line 37: there is no day 1962-2-30"),
        (below(in_radians), "line .* is it in radians"),
        (
            at(150, lambda row: row[:26] + "    1.899999" + row[38:]),
            r"line 151: the pole jumps by 1\.8, .* in 1 d",
        ),
        (
            at(150, words_of(lambda words: [*words[:13], f"-{words[13]}", *words[14:]])),
            "line 151: errors of x, y = -",
        ),
        (at(150, lambda row: row[:16] + "       nan" + row[26:]), "line 151: .*calendar"),
        (at(150, lambda row: row[:16] + "       inf" + row[26:]), "line 151: .*calendar"),
        (at(20, lambda row: row[:26] + "       pole " + row[38:]), "line 21: could not convert"),
        (lambda rows: rows[:6], "holds no rows of numbers"),
        (lambda rows: rows[:7], "holds 1 rows"),
        (lambda rows: ["this is no table", "1 2 3"], "none of the known tables"),
    ],
)
def test_what_cannot_is_refused(
    lines: list[str], file: Path, damage: Callable[[list[str]], list[str]], message: str
) -> None:
    file.write_text("\n".join(damage(lines)))
    with pytest.raises(SeriesError, match=message):
        earthspin.polar_motion(file=file)


def test_missing_files_and_kinds(file: Path) -> None:
    with pytest.raises(SeriesError, match="No such file"):
        eop.read_polar_motion(file)
    with pytest.raises(earthspin.EarthspinError, match="'c05'"):
        earthspin.polar_motion(kind="c05")
    with pytest.raises(SeriesError, match="choose a span inside it"):
        earthspin.polar_motion(span=("1900-01-01", "1950-01-01"))


#: Header of the CSV of the IERS data centre since November 2023. Before, it had no rates; in the
#: oldest files X and Y stand for x_pole and y_pole. Each Type is that of the columns after it.
CENTRE = (
    "MJD;Year;Month;Day;Type;x_pole;sigma_x_pole;y_pole;sigma_y_pole;x_rate;sigma_x_rate;y_rate;"
    "sigma_y_rate;Type;UT1-UTC;sigma_UT1-UTC;LOD;sigma_LOD;Type;dPsi;sigma_dPsi;dEpsilon;"
    "sigma_dEpsilon;dX;sigma_dX;dY;sigma_dY"
)
FINALS = CENTRE + ";Type;bulB/x_pole;bulB/y_pole;Type;bulB/UT-UTC;Type;bulB/dX;bulB/dY"
WITHOUT_RATES = FINALS.replace("x_rate;sigma_x_rate;y_rate;sigma_y_rate;", "")
OLDEST = WITHOUT_RATES.replace("x_pole", "X").replace("y_pole", "Y")
CELESTRAK = "DATE,MJD,X,Y,UT1-UTC,LOD,DPSI,DEPS,DX,DY,DAT,DATA_TYPE"
DATES = [f"2025-11-{21 + day}" for day in range(6)]
EOP2 = (
    f" $  Last UTPM Data Point   {DATES[2]}T00:00:00 UTC\n $  UTPM Predicts to  2026-02-01\n"
    f" $  Last DX,DY Data Point  {DATES[1]}T00:00:00 UTC\n EOP2TYP='EOP2'\n EOP2=\n"
)


def in_layout(header: str, observed: str, predicted: str, unit: float) -> str:
    """Four days, of which x, y were observed on three, and dX, dY on two; then two dates alone."""
    lines = [header]
    for day, date in enumerate(DATES):
        pole, offsets = (observed if day < last else predicted for last in (3, 2))
        types = iter([pole, pole, offsets, "", "", ""])
        values = {"mjd": 61000 + day, "date": date, "year": 2025, "month": 11, "day": 21 + day}
        if day < 4:
            values |= {"x": 0.1 + 0.001 * day, "y": 0.3, "sigma_x": 0.01, "sigma_y": 0.02}
            values |= {"dx": 1e-4 * unit, "dy": -2e-4 * unit, "data_type": pole}
            values |= {"sigma_dx": 3e-4 * unit, "sigma_dy": 4e-4 * unit}
        cells = [
            next(types) if name == "Type" else values.get(name.lower().replace("_pole", ""), "")
            for name in re.split("[;,]", header)
        ]
        lines.append((";" if ";" in header else ",").join(map(str, cells)))
    return "\r\n".join(lines)


PUBLISHED = {
    "finals2000A.csv": (in_layout(FINALS, "final", "prediction", 1e3), 3, 2),
    "finals2000A.csv without rates": (in_layout(WITHOUT_RATES, "final", "prediction", 1e3), 3, 2),
    "finals2000A.csv with X and Y": (in_layout(OLDEST, "final", "prediction", 1e3), 3, 2),
    "c04.csv": (in_layout(CENTRE, "", "", 1.0), 4, 4),
    "EOP-All.csv": (in_layout(CELESTRAK, "O", "P", 1.0), 3, 3),
    "EOP2": (
        EOP2
        + "\n".join(
            f" {61000 + day}.0, {100.0 + day}, 300.0, 36944.1, 10.0, 20.0, 0.1, 0.0, 0.0, 0.0, "
            f"0.1, -0.2, 0.3, 0.4, 0.0, $ {date}"
            for day, date in enumerate(DATES[:4])
        ),
        3,
        2,
    ),
}


def test_dates_of_a_csv_before_1858_are_rows(file: Path) -> None:
    rows = [f"{day};0.1;0.01;0.2;0.02" for day in range(-3, 4)]
    file.write_text("\n".join(["MJD;x_pole;sigma_x_pole;y_pole;sigma_y_pole", *rows]))
    assert eop.read_polar_motion(file).mjd.tolist() == [*range(-3, 4)]


@pytest.mark.parametrize("layout", PUBLISHED)
def test_published_layouts_by_name_of_column(file: Path, layout: str) -> None:
    text, days, offset_days = PUBLISHED[layout]
    file.write_bytes(gzip.compress(text.encode()))
    pole, offsets = eop.read_polar_motion(file), eop.read_pole_offsets(file)
    assert pole.name == layout.split()[0]
    assert np.array_equal(pole.mjd, 61000 + np.arange(days))
    assert np.array_equal(offsets.mjd, 61000 + np.arange(offset_days))
    errors = [np.nan] * 2 if layout == "EOP-All.csv" else [0.01, 0.02]
    seen = [column[2] / ARCSEC for column in (pole.x, pole.y, pole.x_error, pole.y_error)]
    assert np.allclose(seen, [0.102, 0.3, *errors], rtol=1e-12, atol=0, equal_nan=True)
    errors = [np.nan] * 2 if layout == "EOP-All.csv" else [0.3, 0.4]
    seen = [c[1] / MAS for c in (offsets.x, offsets.y, offsets.x_error, offsets.y_error)]
    assert np.allclose(seen, [0.1, -0.2, *errors], rtol=1e-12, atol=0, equal_nan=True)
    assert earthspin.pole_offsets(file=file).dX_error.isnull().all() == (layout == "EOP-All.csv")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (" I E R S  B U L L E T I N - A\n 5 September\n 26 9 5 61288 0.1\n", "finals2000A.all"),
        ("year,pole\n2000.0,0.1\n", "header 'year, pole' is not understood.* pandas table"),
        ("0 0 0 0 0 0\n1 1 1 1 1 1\n", "name its columns.* pandas table"),
        (PUBLISHED["EOP2"][0].replace("Last UTPM", ""), "header"),
        (PUBLISHED["EOP2"][0].replace(f"Point   {DATES[2]}", "Point   2025-11-31"), "no date"),
        (PUBLISHED["c04.csv"][0].rsplit(";", 1)[0], "line 7: 26 columns; 27"),
        ("MJD,x\n61000,0.1\n61001,0.1\n", "no x, y"),
    ],
)
def test_other_tables_are_refused_with_a_remedy(file: Path, text: str, words: str) -> None:
    file.write_text(text)
    with pytest.raises(SeriesError, match=words):
        earthspin.polar_motion(file=file)


@pytest.mark.parametrize("text", [part_of_c01(46900, 48000), PUBLISHED["EOP2"][0]], ids=range(2))
def test_rows_without_a_date_are_refused(file: Path, text: str) -> None:
    file.write_text(re.sub(r"(?m)^\s*(46923\S*|61001\.0)", " nan", text))
    with pytest.raises(SeriesError, match="date is nan"):
        eop.read_polar_motion(file)


def test_a_csv_that_pandas_wrote_again(file: Path) -> None:
    """Commas separate its columns, and pandas numbers those of equal name: Type, Type.1, Type.2."""
    file.write_text(PUBLISHED["finals2000A.csv"][0])
    pd.read_csv(file, sep=";").to_csv(file)
    assert eop.read_polar_motion(file).name == "finals2000A.csv"
    assert np.array_equal(eop.read_pole_offsets(file).mjd, [61000, 61001])


@pytest.mark.parametrize("kind", ["c04", "c01", "finals2000A"])
def test_a_file_without_rows_is_refused(file: Path, kind: str) -> None:
    file.write_text("# a header\n")
    with pytest.raises(SeriesError, match="holds no rows of numbers"):
        eop.read_polar_motion(file, kind)


def test_predictions_are_not_looked_for_in_other_tables(
    lines: list[str], file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file.write_text("\n".join(lines))
    monkeypatch.setattr(pole_tables, "rows_of", None)
    assert eop.read_bulletin_a(file) is None


def test_a_byte_order_mark_before_the_first_row_is_ignored(lines: list[str], file: Path) -> None:
    file.write_text("\n".join(lines[6:]), encoding="utf-8-sig")
    assert eop.read_polar_motion(file).mjd[0] == 37665
    file.write_text(PUBLISHED["c04.csv"][0], encoding="utf-8-sig")
    assert eop.read_polar_motion(file).name == "c04.csv"


def test_a_bad_archive_is_refused(file: Path) -> None:
    file.write_bytes(gzip.compress(b"1" * 1000)[:-9])
    with pytest.raises(SeriesError, match="cannot be read"):
        eop.read_polar_motion(file)


@pytest.mark.parametrize("dates", ["index", "mjd", "zone"])
def test_a_pandas_table_with_units(dates: str) -> None:
    """As the Dataset of the same numbers, in questions and in calls on labelled data."""
    seen = earthspin.polar_motion(span=("1999-01-01", "2016-01-01"))
    table = (1e3 * seen[["x", "y", "x_error", "y_error"]]).to_dataframe()
    if dates == "mjd":
        table.index = pd.Index(eop.read_polar_motion().between(51179, 57388).mjd, name="MJD")
    elif dates == "zone":
        table.index = table.index.tz_localize("UTC")
    with pytest.raises(earthspin.EarthspinError, match=r"attrs\['units'\]"):
        earthspin.polar_motion(file=table)
    table.attrs["units"] = "mas"
    again = earthspin.polar_motion(file=table)
    for name in ("x", "y", "x_error", "y_error"):
        assert np.allclose(again[name], seen[name], rtol=0, atol=1e-15)
    assert np.array_equal(again.time, seen.time)
    assert earthspin.run(again).equals(again)
    assert float(earthspin.forecast(30, file=table).x[-1]) == pytest.approx(
        float(earthspin.forecast(30, file=seen).x[-1]), rel=0, abs=1e-13
    )
    assert float(earthspin.fit_chandler(table).chandler_period) == pytest.approx(
        float(earthspin.fit_chandler(seen).chandler_period), rel=0, abs=1e-9
    )
    table.loc[table.index[50], "x"] += 900
    with pytest.raises(SeriesError, match="jumps"):
        earthspin.polar_motion(file=table)
    with pytest.raises(earthspin.EarthspinError, match="column 'MJD'"):
        earthspin.polar_motion(file=table.reset_index(drop=True))


@pytest.mark.parametrize("name", ["x_error", "y_error"])
def test_errors_of_a_given_table_that_are_not_complete_are_left_out(name: str) -> None:
    """Without a column, those of x would stand for y, or the reverse."""
    seen = earthspin.polar_motion(span=("1999-01-01", "2016-01-01"))
    given = earthspin.polar_motion(file=seen.assign({name: seen[name].where(seen.x > 0)}))
    assert np.allclose(given.x, seen.x, rtol=0, atol=1e-12)
    assert np.isnan(given.x_error).all()
    assert np.isnan(given.y_error).all()

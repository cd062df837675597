"""Text of tables is split once, in every form in which programs write it."""

from pathlib import Path

import numpy as np
import pytest

import earthspin
from earthspin import SeriesError
from earthspin.tables.columns import declared, fits, written
from earthspin.tables.sheet import split

ROWS = [(0.0, 0.016702), (-1.0, 0.017161), (-2.0, 0.017497)]
NAMES = ("epoch (kyr)", "eccentricity")


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "table"


@pytest.mark.parametrize("mark", [",", ";", "\t", " "])
@pytest.mark.parametrize("quote", ["", '"'])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
@pytest.mark.parametrize("decimal", [".", ","])
def test_forms_of_text(
    file: Path, mark: str, quote: str, end: str, encoding: str, decimal: str
) -> None:
    if decimal == mark:
        return
    lines = [mark.join(f"{quote}{name}{quote}" for name in NAMES)]
    lines += [mark.join(map(str, row)).replace(".", decimal) for row in ROWS]
    file.write_text(end.join(lines), encoding=encoding, newline="")
    sheet = split(file)
    assert sheet.names == [*NAMES]
    assert np.array_equal([sheet.column(0), sheet.column(1)], np.transpose(ROWS))
    assert earthspin.read_solution(file).eccentricity.values[-1] == 0.016702


def test_names_of_rows_as_r_writes_them(file: Path) -> None:
    names = ["Time_ka", "prec_angle_LA04", "tilt_LA04", "ecc_LA04"]
    for mark in (",", " "):
        rest = mark.join(f'"{name}"' for name in names)
        rows = [mark.join(['"1"', "0", "1.796", "0.40909", "0.016702"])]
        rows += [mark.join(['"2"', "1", "1.498", "0.41135", "0.017161"])]
        for header in ('""' + mark + rest, rest) if mark == "," else (rest,):
            file.write_text("\n".join([header, *rows]))
            assert earthspin.read_solution(file).epoch.values.tolist() == [-1000, 0]


@pytest.mark.parametrize(
    "head",
    [
        "# made by hand, from INSOLN.LA2004\n# epoch (kyr), eccentricity\n",
        "epoch,eccentricity\nkyr,1\n",
        "epoch (kyr)   eccentricity\n\n",
        "% epoch (kyr) eccentricity\n% written in 2020 by a program, columns as above.\n",
    ],
)
def test_lines_above_the_rows(file: Path, head: str) -> None:
    file.write_text(head + "\n".join(f"{t},{e}" for t, e in ROWS))
    assert earthspin.read_solution(file).epoch.values.tolist() == [-2000, -1000, 0]


def test_exponents_of_fortran_and_a_delimiter_at_the_end(file: Path) -> None:
    file.write_text("epoch (kyr),eccentricity\n0,0.16702D-01,\n-1,1.7161d-2,\n-2,17.497D-03,\n")
    assert np.array_equal(
        earthspin.read_solution(file).eccentricity, [0.017497, 0.017161, 0.016702]
    )


@pytest.mark.parametrize(
    "text", ["epoch (kyr BP), eccentricity,, obliquity (deg)", "mjd, x (mas), -y (mas)", "t,,,, e"]
)
def test_declarations_are_written_as_they_are_read(text: str) -> None:
    assert written(declared(text)) == text
    assert fits(text, text.count(",") + 1)
    assert not fits(text, text.count(","))
    assert fits(text + ", ...", 30)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("<!DOCTYPE html>\n<html><td>1</td>", "web page.*raw"),
        ("version https://git-lfs.github.com/spec/v1\noid sha256:aa\nsize 1\n", "git lfs pull"),
        ("%=SNX 2.02 IGS\n", "SINEX file.*import pandas"),
        ("stk.v.11.0\nBEGIN Ephemeris\n\n0 1 2 3\n", "file of STK.*skiprows=3"),
        ("PK\x03\x04", "ZIP archive or a workbook.*read_excel"),
        ('{"x": [1, 2]}', "JSON file.*read_json"),
    ],
)
def test_files_that_are_no_tables_are_named(file: Path, content: str, words: str) -> None:
    file.write_text(content)
    for read in (
        earthspin.read_solution,
        earthspin.read_orbit,
        earthspin.read_excitation,
        earthspin.fit_chandler,
        lambda name: earthspin.polar_motion(file=name),
        lambda name: earthspin.long_term(orbit=str(name)),
    ):
        with pytest.raises(SeriesError, match=words):
            read(file)


def test_the_lines_that_read_a_sinex_file_do_so(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Rows in the columns of SINEX 2.02; x and y of C04 on four days of 2020."""
    monkeypatch.chdir(file.parent)
    seen = earthspin.polar_motion(span=("2020-01-01", "2020-01-04"))
    rows = [
        f"{2 * day + place:6d} {name}    ---- -- ---- 20:{day + 1:03d}:00000 mas  2 "
        f"{1e3 * float(seen[name[0].lower()][day]):21.15e} 0.5E-01"
        for day in range(4)
        for place, name in enumerate(("XPO", "YPO"), start=1)
    ]
    file.write_text("\n".join(["%=SNX 2.02 IGS", "+SOLUTION/ESTIMATE", *rows, "%ENDSNX"]))
    with pytest.raises(SeriesError) as error:
        earthspin.polar_motion(file=file)
    program = str(error.value).split("as a table: ")[1]
    names: dict[str, object] = {}
    exec(program, names)
    again = earthspin.polar_motion(file=names["t"])
    assert float(abs(again[["x", "y"]] - seen[["x", "y"]]).to_dataarray().max()) < 1e-15


def test_a_row_of_another_length_is_lost_or_the_last_one_cut(file: Path) -> None:
    rows = [f"{day} 0.1 0.2 0.3" for day in range(5)]
    file.write_text("\n".join([*rows, "5 0.1"]))
    with pytest.raises(SeriesError, match="line 6: 2 columns; 4 are expected; is the file cut off"):
        earthspin.read_solution(file)
    file.write_text("\n".join([*rows[:2], "9 0.1", *rows[2:]]))
    with pytest.raises(SeriesError, match="line 3: 2 columns; 4 are expected; is a column lost"):
        earthspin.read_solution(file)

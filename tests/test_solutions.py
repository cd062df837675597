"""Published solutions, in the layouts of their files, beside the numbers of `long_term`."""

from pathlib import Path

import numpy as np
import pytest

import earthspin
from earthspin import read_solution
from tests.refusals import refused

DATA = Path(__file__).parent / "data"
LA2004 = DATA / "la2004-excerpt.txt"
#: First rows of published files: La2010a_ecc3L.dat, ZB18a_insolation.dat and PT.De1.0000Td1.0000
#: (Zeebe & Lourens; the latter rounded, as a snapshot of snvecR has them), orbit91 (Berger & Loutre
#: 1991). The file of snvec with e and perihelion is made from that without.
LA2010 = "         0  0.016702362\n        -1  0.017161382\n        -2  0.017496814\n"
ZB18A = """\
   0.0000000000000000 1.6705450449544221E-002 23.439291111111096 102.91731806631989 477.8285188
 -0.37902002296715986 1.6846498381376977E-002 23.488653010884036 96.484912236211045 478.1984694
 -0.76035501718682474 1.7045694816592009E-002 23.537973843759552 89.812706523967861 478.7154292
"""
SNVEC = "0 0.409 0 0.0163\n-0.379 0.410 0.0924 0.0167\n-0.760 0.411 0.185 0.0170\n"
SNVEC_WITH_E = (
    "0 0.016705 0.409093 0 1.796246 0.016283\n-0.379 0.016846 0.40995 0.0924 1.68398 0.01674"
)
ORBIT91 = """\
                                                     INSOLATION
          ECC      OMEGA   OBL       PREC   65NJul  65SJan  15NJul  15SJan

     0  0.017236  101.37  23.446   0.01690  426.76  455.58  440.60  470.35
    -1  0.017644   84.26  23.573   0.01756  430.12  455.48  442.48  468.57
    -6  0.019249  359.99  24.100   0.00000  458.31  441.00  464.53  446.98
    -7  0.019477  343.37  24.163  -0.00557  463.29  437.78  468.75  442.94
"""
ALL = {
    *("obliquity", "eccentricity", "longitude_of_perihelion"),
    *("climatic_precession", "coprecession"),
}


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "solution.txt"


@pytest.mark.parametrize(
    ("text", "names", "degrees", "numbers"),
    [
        (LA2004.read_text(), ALL, (0.0015, 0.25), 8e-5),
        (LA2010, {"eccentricity"}, (), 6e-5),
        ("\n".join(f"{row} 0.0" for row in LA2010.splitlines()), {"eccentricity"}, (), 6e-5),
        (ZB18A, ALL, (1e-4, 0.1), 4e-5),
        (SNVEC, {"obliquity", "climatic_precession"}, (0.015, 0.0), 8e-5),
        (SNVEC_WITH_E, ALL, (2e-4, 0.08), 4e-5),
        (ORBIT91, ALL, (0.008, 0.8), 6e-4),
    ],
    ids=["La2004", "La2010", "ZB20a", "ZB18a", "snvec", "snvec with e", "Berger"],
)
def test_files_as_published(
    file: Path, text: str, names: set[str], degrees: tuple[float, ...], numbers: float
) -> None:
    """The two agree in units, epochs and signs; a perihelion of the Sun is 180 degrees away."""
    file.write_text(text)
    solution = read_solution(file)
    assert {*solution.data_vars} == names
    ours = earthspin.long_term(times=solution.epoch)
    largest = abs(ours - solution).max()
    bounds = dict(zip(("obliquity", "longitude_of_perihelion"), degrees, strict=False))
    for name in names:
        assert float(largest[name]) < bounds.get(name, numbers), name
        assert solution[name].attrs["units"] == ours[name].attrs["units"]


def test_la2004_as_others_read_it() -> None:
    """Values of the file as a public study has them: e sin(varpi), and the obliquity in rad."""
    solution = read_solution(LA2004).sel(epoch=[-200_000, -100_000, 0])
    expected = [-0.03833572638169867, -0.0006501053038830341, 0.01627964595166013]
    assert np.allclose(solution.climatic_precession, expected, rtol=0, atol=1e-15)
    tilts = [0.4037251011418818, 0.4130265591582125, 0.4090928042223415]
    assert np.allclose(np.radians(solution.obliquity), tilts, rtol=0, atol=1e-15)


def test_astrogeo(file: Path) -> None:
    file.write_text(
        "0.370 57.673582 57.335846 57.885557 21.818198 21.547225 21.991389 22.231292 22.227687 "
        "22.236342 61.062980 60.584835 61.826758"
    )
    solution = read_solution(file)
    assert (float(solution.epoch[0]), float(solution.obliquity[0])) == (-370e6, 22.231292)


def test_columns_that_are_named(file: Path) -> None:
    """Ages before 1950, the Sun's perigee, and steps of 100 kyr, over which nothing is followed."""
    file.write_text("0 281.37 7 23.446\n100 178.73 7 23.719")
    columns = "epoch (kyr BP), longitude_of_perigee (deg), , obliquity (deg)"
    solution = read_solution(file, columns=columns)
    assert solution.epoch.values.tolist() == [-100_050.0, -50.0]
    assert np.allclose(solution.longitude_of_perihelion, [358.73, 101.37], rtol=0, atol=1e-9)
    file.write_text("370 22.23\n0 23.44")
    ages = read_solution(file, columns="epoch (Myr ago), obliquity (deg)")
    assert ages.epoch.values.tolist() == [-370e6, 0.0]


@pytest.mark.parametrize("mark", ["", "# "])
def test_a_csv_file_of_long_term_is_read_back(file: Path, mark: str) -> None:
    past = earthspin.long_term("-30 kyr", "0 kyr", "1 kyr")
    file.write_text(mark + past.earthspin.to_csv(file).read_text())
    solution = read_solution(file)
    assert "obliquity_error" in solution
    assert all(np.all(abs(solution[name] - past[name]) < 1e-12) for name in solution)


def told(text: str, columns: object = None) -> None:
    Path("told.txt").write_text(text)
    read_solution("told.txt", columns=columns)  # type: ignore[arg-type]


test_it_is_refused = refused(
    ("0 0.0167\n1 0.01716\n2 0.0175", r"columns='epoch \(kyr ago\), eccentricity'"),  # ages
    ("kyr_BP,eccentricity\n0,0.0167", r"columns='epoch \(kyr BP\), eccentricity'"),
    ("-400 0.0167\n-401 0.0168", "name them"),  # far from what is known
    ("0 0.4396\n-1 0.4376", "2 columns .*name them"),  # an obliquity
    ("0 1 0 .01 .01 0 0\n-1 1 0 .01 .01 0 0", "read_orbit"),
    ("0 0.0167 23.44 102.9\n-1 0.0172 23.57 85.8", "name them"),  # degrees
    ("0 0.0167 0.409 1.796 478\n-1 0.0172 0.411 1.498 480", "name them"),  # radians
    ("0 0.0167\n0 0.0168", "repeated"),
    ("0 23.4", "epoch (kyr), obliqity (deg)", "did you mean 'obliquity'"),
    ("0 23.4", "epoch (kyr), obliquity", r"obliquity \(deg\)"),
    ("0 23.4", "epoch (kyr AD), obliquity (deg)", r"epoch \(yr\)"),
    ("0 23.4 1", "epoch (kyr), obliquity (deg)", "3 columns, of which 2"),
    ("0 23.4", "obliquity (deg), obliquity (deg)", "stands twice"),
    ("0 23.4", "eccentricity, obliquity (deg)", "epoch is needed"),
    ("0 23.4", ["epoch (kyr)", "obliquity (deg)"], "one text"),
    ("none", "no rows"),
    call=told,
)


@pytest.fixture(autouse=True)
def inside(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_a_model_that_does_not_change_is_no_other_unit_of_time(tmp_path: Path) -> None:
    """Constants near those of today fit times in any unit."""
    path = tmp_path / "still.csv"
    rows = "\n".join(f"{age},0.0167,23.44" for age in range(101))
    path.write_text(f"epoch (kyr BP),eccentricity,obliquity (deg)\n{rows}\n")
    assert earthspin.read_solution(path).epoch[0] == -100050

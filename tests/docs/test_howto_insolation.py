"""Examples of the how-to pages on insolation and on the tools that take it."""

import re
import shutil
from pathlib import Path

import numpy as np
import pytest

import earthspin
from tests.docs.lessons import DOCS


def test_caloric_summers_of_a_file_for_r(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """At most ten lines; the last row is today by La2004, in years before 1950."""
    page = (DOCS / "howto" / "insolation.md").read_text()
    cell = re.search(r":tags: \[caloric-csv\]\n(.*?)```", page, re.DOTALL)
    assert cell is not None
    assert len(cell[1].strip().splitlines()) <= 10
    data = DOCS.parent / "tests" / "data" / "la2004-excerpt.txt"
    shutil.copy(data, tmp_path / "INSOLN.LA2004.BTL.ASC")
    monkeypatch.chdir(tmp_path)
    exec(cell[1], {})
    lines = (tmp_path / "caloric.csv").read_text().splitlines()
    assert lines[0] == "kyr_BP,caloric_summer,caloric_winter,latitude"
    rows = np.array([line.split(",") for line in lines[1:]], dtype=float)
    assert rows[[0, -1], 0].tolist() == [199.95, -0.05]
    # the upper and lower half of 100,000 instants of the year, with the elements in the file
    eps, e, perihelion = 0.4090928042223415, 0.01670236225492288, 1.796256991128036
    mean = 2 * np.pi * (np.arange(100_000) + 0.5) / 100_000
    eccentric = mean
    for _ in range(20):
        eccentric = mean + e * np.sin(eccentric)
    true = 2 * np.arctan2(
        np.sqrt(1 + e) * np.sin(eccentric / 2), np.sqrt(1 - e) * np.cos(eccentric / 2)
    )
    decline, phi = np.arcsin(np.sin(eps) * np.sin(true + perihelion + np.pi)), np.radians(65)
    half = np.arccos(np.clip(-np.tan(phi) * np.tan(decline), -1, 1))
    day = half * np.sin(phi) * np.sin(decline) + np.cos(phi) * np.cos(decline) * np.sin(half)
    days = np.sort(1361 / np.pi * day / (1 - e * np.cos(eccentric)) ** 2)
    halves = [days[50_000:].mean(), days[:50_000].mean()]
    assert rows[-1, 1:3] == pytest.approx(halves, rel=0, abs=1e-5)


TOOLS = (DOCS / "howto" / "palaeoclimate.md").read_text()
#: As in the page.
JUNE = {"latitude": "65N", "longitude": "90 deg", "solar_constant": "1361 W/m2"}


def _block(name: str) -> str:
    """Code of the page that imports a library."""
    blocks = re.findall(r"```(?:python|\{code-cell\} ipython3)\n(.*?)```", TOOLS, re.DOTALL)
    return next(block for block in blocks if f"{name}" in block)


def test_ages_of_a_csv_count_from_the_year_that_is_named(tmp_path: Path) -> None:
    june = earthspin.insolation("-2 kyr", "0 kyr", "1 kyr", **JUNE)
    ages = {
        "kyr BP": [1.95, 0.95, -0.05],
        "ka": [2.0, 1.0, 0.0],
        "kyr from 1950": [-1.95, -0.95, 0.05],
        "yr BP": [1950.0, 950.0, -50.0],
        "kyr": [-2.0, -1.0, 0.0],
    }
    for unit, expected in ages.items():
        path = june.earthspin.to_csv(tmp_path / "june.csv", units={"epoch": unit})
        header, *rows = (line.split(",") for line in path.read_text().splitlines())
        assert header == [f"epoch ({unit})", "insolation (W m-2)", "insolation_error (W m-2)"]
        assert [row[0] for row in rows] == [str(age) for age in expected]
        assert [float(row[1]) for row in rows] == june.insolation.values.tolist()


def test_elements_with_ages_are_read_back(tmp_path: Path) -> None:
    past = earthspin.long_term("-9 kyr", "0 kyr", "1 kyr")
    path = past.earthspin.to_csv(tmp_path / "past.csv", units={"epoch": "kyr BP"})
    back = earthspin.read_solution(path)
    assert back.epoch.values.tolist() == past.epoch.values.tolist()
    assert np.array_equal(back.obliquity, past.obliquity)


def test_the_strongest_periods_are_the_known_ones(capsys: pytest.CaptureFixture[str]) -> None:
    cell = _block("find_peaks")
    code = cell[cell.index("import numpy") :].strip().splitlines()
    assert len([line for line in code if line]) <= 8
    exec(cell[cell.index("past =") :], {"earthspin": earthspin})
    lines = re.findall(r"\[(.*?)\]", capsys.readouterr().out)
    found = [sorted(float(word) for word in line.split()) for line in lines]
    # as usually quoted; half a width of a peak is P^2/(2 * 2000 kyr)
    periods = [[39.5, 41.1, 53.7], [19.0, 22.4, 23.7], [96.0, 126.0, 405.0]]
    for computed, published in zip(found, periods, strict=True):
        widths = np.square(published) / 4000
        assert np.all(np.abs(np.subtract(computed, published)) < widths)


def test_pyleoclim_takes_the_table() -> None:
    pytest.importorskip("pyleoclim")
    names: dict = {"june": earthspin.insolation("-1 Myr", "0 kyr", "1 kyr", **JUNE)}
    exec(_block("pyleoclim"), names)
    assert names["series"].time[[0, -1]] == pytest.approx([-0.05, 999.95], rel=1e-12, abs=0)
    spectrum = names["spectrum"]
    period = 1 / spectrum.frequency[np.nanargmax(spectrum.amplitude)]
    assert min(abs(period - 19.0), abs(period - 23.7)) < 0.5


def test_climlab_takes_the_orbit_and_gives_the_same_insolation() -> None:
    pytest.importorskip("climlab")
    names: dict = {"earthspin": earthspin}
    exec(_block("climlab"), names)
    june = earthspin.insolation("-1 Myr", "0 kyr", "1 kyr", **JUNE).insolation
    assert np.allclose(names["theirs"], june, rtol=0, atol=1e-10)

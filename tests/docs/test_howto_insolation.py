"""The example of the how-to on insolation that makes a file for R."""

import re
import shutil
from pathlib import Path

import numpy as np
import pytest

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

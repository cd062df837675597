"""Tasks of the how-to in ten lines, and the likely wrong variants of each."""

import re
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from astropy.utils import iers

import earthspin
from earthspin import EARTH, Body, EarthspinError, Orbit
from tests.docs.lessons import DOCS


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    shutil.copy(iers.IERS_A_FILE, tmp_path / "finals2000A.all")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def done(task: str) -> dict[str, Any]:
    """Names that the lines of a task define."""
    page = (DOCS / "howto" / "tasks.md").read_text(encoding="utf-8")
    cell = re.search(rf":tags: \[{task}\]\n(.*?)```", page, re.DOTALL)
    assert cell is not None
    assert len(cell[1].strip().splitlines()) <= 10
    names: dict[str, Any] = {}
    exec(cell[1], names)
    return names


def test_the_pole_of_a_file_in_mas() -> None:
    """Against astropy's reader of the same file."""
    done("geodesist")
    rows = pd.read_csv("pole.csv")
    table = iers.IERS_A.open("finals2000A.all")
    known = table[table["MJD"].value == 60310]  # 2024-01-01
    assert rows["x (mas)"][0] == pytest.approx(known["PM_x"].value[0] * 1e3, rel=0, abs=2)
    assert len(rows) == 61


@pytest.mark.slow
def test_ten_thousand_planets() -> None:
    """Against 4 pi spin / (3 n2 H cos(eps)) of a circular orbit, in closed form."""
    names = done("engineer")
    rates = xr.open_dataset("planets.nc").precession_period.sel(perturber="total")
    assert rates.sizes == {"planet": 10_000}
    square = earthspin.SUN.gm / names["a"] ** 3
    ratio = EARTH.dynamical_flattening * np.cos(names["tilt"])
    seconds = 4 * np.pi * (2 * np.pi / names["day"]) / (3 * square * ratio)
    np.testing.assert_allclose(rates, seconds / 31557600.0, rtol=1e-9, atol=0)


def test_a_book_turns_over() -> None:
    """It comes to nearly the opposite spin about its middle axis."""
    thrown = done("lecturer")["thrown"]
    assert float(thrown.omega_body.sel(component="y").min()) == pytest.approx(-10, rel=0, abs=0.01)


@pytest.mark.parametrize(
    ("wrong", "advice"),
    [
        (lambda: earthspin.polar_motion(file="finals2000A.al"), "finals2000A.al"),
        (
            lambda: earthspin.polar_motion(
                span=("2024-01-01", "2024-03-01"), file="finals2000A.all"
            ).earthspin.to_csv("pole.csv", units={"x": "metre"}),
            "mas|arcsec",
        ),
        (lambda: earthspin.precession(body=EARTH.replace(obliquity=40.5)), "'40.5 deg'"),
        (lambda: Orbit(a=1.0, around="star"), "about"),
        (lambda: Body.from_density([[[700.0]]], [0, 24], [0, 17], name="book"), "z"),
        (lambda: earthspin.free_rotor([1, 2, 2.5], [0.01, 10.0], [0.0, 1.0]), "omega"),
    ],
)
def test_wrong_variants_end_in_one_line(wrong: Callable[[], Any], advice: str) -> None:
    with pytest.raises(EarthspinError, match=advice) as refusal:
        wrong()
    assert "\n" not in str(refusal.value)

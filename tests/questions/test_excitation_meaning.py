"""Columns of angular momentum are compared with the excitation that moves the observed pole."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin import SceneError, SeriesError
from earthspin.constants import MAS

#: Noise added to the excitation, mas: the rest that files of air, water and ground leave.
NOISE = 10.0


@pytest.fixture(scope="module")
def pole() -> xr.Dataset:
    return earthspin.polar_motion(span=("2004-01-01", "2018-01-01"))


@pytest.fixture(scope="module")
def chi(pole: xr.Dataset) -> np.ndarray:
    """Excitation from C04, of the Barnes et al. (1983) sign, with noise, mas: chi1, chi2."""
    true = earthspin.excitation(pole, period="433 d", quality_factor=80)
    noise = np.random.default_rng(5).standard_normal((2, true.time.size))
    return np.array([true.chi1, true.chi2]) + NOISE * noise


def written(file: Path, chi1: np.ndarray, chi2: np.ndarray) -> Path:
    """One row a day at noon, in the common layout of the mass term, and radians."""
    days = np.datetime64("2004-01-01") + np.arange(chi1.size)
    rows = zip(days, np.transpose([chi1, chi2]) * MAS, strict=True)
    lines = [
        f"{str(day).replace('-', ' ')} 12 {(day - np.datetime64('1858-11-17')).astype(int)}.5 "
        f"{one:.6e} {two:.6e} 0.0"
        for day, (one, two) in rows
    ]
    file.write_text("\n".join(lines))
    return file


@pytest.mark.parametrize(
    ("turn", "meaning"),
    [
        (lambda a, b: (-a, b), "-mass1 (rad), mass2 (rad)"),
        (lambda a, b: (a, -b), "mass1 (rad), -mass2 (rad)"),
        (lambda a, b: (b, a), "mass2 (rad), mass1 (rad)"),
    ],
)
def test_files_with_another_meaning_are_refused(
    tmp_path: Path,
    chi: np.ndarray,
    turn: Callable[..., tuple[np.ndarray, np.ndarray]],
    meaning: str,
) -> None:
    file = written(tmp_path / "AAM.txt", *turn(*chi))
    with pytest.raises(SeriesError) as error:
        earthspin.read_excitation(file)
    columns = f"year, month, day, hour, mjd, {meaning}, mass3 (rad)"
    assert f"columns='{columns}'" in str(error.value)
    read = earthspin.read_excitation(file, columns=columns)
    assert np.corrcoef(read.chi1, chi[0])[0, 1] > 0.99


def test_files_that_agree_and_toys_are_read(tmp_path: Path, chi: np.ndarray) -> None:
    read = earthspin.read_excitation(written(tmp_path / "AAM.txt", *chi))
    assert np.allclose(read.chi1, chi[0], rtol=1e-5, atol=1e-4)
    toy = 30 * np.random.default_rng(6).standard_normal(chi.shape)
    read = earthspin.read_excitation(written(tmp_path / "toy.txt", *toy))
    assert np.allclose(read.chi2, toy[1], rtol=1e-5, atol=1e-4)


def test_the_unit_of_columns_is_converted(tmp_path: Path, chi: np.ndarray) -> None:
    file = written(tmp_path / "AAM.txt", *(chi / MAS / 1e3))
    columns = "year, month, day, hour, mjd, mass1 (arcsec), mass2 (arcsec),"
    read = earthspin.read_excitation(file, columns=columns)
    assert np.allclose(read.chi1, chi[0], rtol=1e-5, atol=1e-4)


def test_another_unit_is_offered(tmp_path: Path, chi: np.ndarray) -> None:
    file = written(tmp_path / "AAM.txt", *chi)
    columns = "year, month, day, hour, mjd, mass1 ({0}), mass2 ({0}),"
    with pytest.raises(SeriesError) as error:
        earthspin.read_excitation(file, columns=columns.format("mas"))
    assert f"they do with columns='{columns.format('rad')}'" in str(error.value)


@pytest.mark.parametrize(
    ("one", "two", "words"),
    [("-chi1", "chi2", "'-chi1' and 'chi2'"), ("chi2", "chi1", "'chi2' and 'chi1'")],
)
def test_a_given_excitation_is_compared_with_its_pole(
    pole: xr.Dataset, one: str, two: str, words: str
) -> None:
    true = earthspin.excitation(pole, period="433 d", quality_factor=80)
    sign = -1 if one[0] == "-" else 1
    other = true.assign(
        chi1=true.chi1.copy(data=sign * true[one.removeprefix("-")].values),
        chi2=true.chi2.copy(data=true[two].values),
    )
    with pytest.raises(SceneError, match=words):
        earthspin.fit_chandler(pole, excitation=other)
    with pytest.raises(SceneError, match=words):
        earthspin.forecast(5, file="c04", origin="2017-12-01", excitation=other)
    radians = true.assign(chi1=true.chi1.copy(data=true.chi1 * MAS))
    radians["chi2"] = true.chi2.copy(data=true.chi2 * MAS)
    with pytest.raises(SceneError, match=r"they are 5e-09 times .* in mas"):
        earthspin.fit_chandler(pole, excitation=radians)

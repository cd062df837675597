"""Effective angular momentum functions: one file or many, by component, term and day."""

from pathlib import Path

import numpy as np
import pytest

import earthspin
from earthspin import SceneError, SeriesError
from earthspin.constants import MAS
from earthspin.sky.angular_momentum import read_angular_momentum

EAM = """# effective angular momentum functions
 2000  1  1  0  51544.000  1.0e-07 2.0e-07 3.0e-07  1.0e-08 -2.0e-08 0.0
 2000  1  1  3  51544.125  1.1e-07 2.1e-07 3.0e-07  1.0e-08 -2.0e-08 0.0
 2000  1  1  6  51544.250  1.2e-07 2.2e-07 3.0e-07  1.0e-08 -2.0e-08 0.0
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "excitation.txt"


def test_one_file(file: Path) -> None:
    file.write_text(EAM)
    read = read_angular_momentum(file)
    assert np.allclose(
        read.mass + read.motion,
        [1.1e-7 + 1.8e-7j, 1.2e-7 + 1.9e-7j, 1.3e-7 + 2e-7j],
        rtol=0,
        atol=1e-20,
    )
    chi = earthspin.read_excitation(file)
    assert float(chi.chi1[0]) == pytest.approx(1.1e-7 / MAS, rel=1e-15, abs=0)
    assert chi.chi3.values == pytest.approx(3e-7 * 86400e3, rel=1e-15, abs=0)
    driven = earthspin.polar_motion_from(chi, period=433.0, quality_factor=100.0)
    assert driven.time.size == 4
    assert float(driven.x[0]) == 0
    # dp/dt = -i s (chi - p): the first step of an eighth of a day
    assert float(driven.x[1]) * 1e3 == pytest.approx(
        2 * np.pi / 433 / 8 * 1.8e-7 / MAS, rel=0.01, abs=0
    )


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("3.0e-07  1.0e-08 -2.0e-08 0.0\n 2000  1  1  6", "\n 2000  1  1  6", "7 columns"),
        ("  3  51544.125", "  3  51544.200", "line 3: MJD 51544.20 differs from the calendar"),
        (" 51544.125", " 151544.125", "line 3: MJD 151544.1. differs from the calendar"),
        (" 51544.125", " nan", "line 3: MJD nan differs from the calendar"),
        ("  1  3  51544.125", "  1  2  51544.08333", "line 3: the step changes before MJD"),
        ("  1  3  51544.125", "  1 12  51544.500", "line 4: .*time runs backwards"),
        (" 2000  1  1  6  51544", " x000  1  1  6  51544", "line 4: 1 line among the rows"),
        ("1.1e-07", "11.0", "line 3: .* radians"),
        ("1.1e-07", "nan", "line 3: .* radians"),
        ("1.1e-07", "pole", "line 3: could not convert"),
        (" 2000  1  1  3", " 2000 13  1  3", "line 3: there is no day 2000-13-1"),
    ],
)
def test_damaged_files(file: Path, old: str, new: str, message: str) -> None:
    assert EAM.count(old) == 1
    file.write_text(EAM.replace(old, new))
    with pytest.raises(SeriesError, match=message):
        earthspin.read_excitation(file)


def test_the_axial_part_is_left_out_where_a_file_has_none(tmp_path: Path) -> None:
    """Two rows each, with the axial part in mass and motion, in one of them, and in none."""
    aam, oam, ham = (tmp_path / f"{name}.asc" for name in ("AAM", "OAM", "HAM"))
    rows = [f"2000 1 {day} 0 {51543 + day} 1e-7 2e-7 1e-8 0 0 {day}e-8" for day in (2, 4)]
    aam.write_text("\n".join(rows))
    chi = earthspin.read_excitation(aam)
    assert chi.chi3.attrs["units"] == "ms"
    assert np.allclose(chi.chi3, [3e-8 * 86400e3, 5e-8 * 86400e3], rtol=1e-12, atol=0)
    mass = earthspin.read_excitation(aam, terms=["mass"])
    assert np.allclose(mass.chi3, 1e-8 * 86400e3, rtol=1e-12, atol=0)
    rows = [f"2000 1 {day} 0 {51543 + day} 1e-7 2e-7 -4e-8" for day in (2, 4)]
    oam.write_text("\n".join(rows))
    both = earthspin.read_excitation([aam, oam])
    assert np.allclose(both.chi3, [-1e-8 * 86400e3, 1e-8 * 86400e3], rtol=1e-12, atol=0)
    columns = "year, month, day, hour, mjd, mass1, mass2,"
    assert "chi3" not in earthspin.read_excitation(oam, columns=columns)
    ham.write_text("51545 1e-7 2e-7 0\n51547 1e-7 2e-7 0")
    for columns in ("mjd, mass1, mass2,", "mjd, mass1, mass2, mass3"):
        two = earthspin.read_excitation(ham, columns=columns)
        assert {*two.data_vars} == {"chi1", "chi2"}
    oam.write_text("\n".join([*rows, rows[-1].replace("-4e-8", "-5e-8")]))
    with pytest.raises(SeriesError, match="twice"):
        earthspin.read_excitation(oam)


def test_an_empty_file(file: Path) -> None:
    file.write_text("# nothing\n")
    with pytest.raises(SeriesError, match="holds no rows"):
        read_angular_momentum(file)


# --- folders --------------------------------------------------------------------------------------


def row(mjd: float, mass: complex, motion: complex | None) -> str:
    day = np.datetime64("1858-11-17T00", "m") + np.timedelta64(round(mjd * 1440), "m")
    date, clock = str(day).split("T")
    terms = [mass.real, mass.imag, 0.0]
    terms += [] if motion is None else [motion.real, motion.imag, 0.0]
    calendar = f"{date.replace('-', ' ')} {clock[:2]}"
    return f"{calendar} {mjd:.3f} " + " ".join(f"{term:.9e}" for term in terms)


#: Slopes of the components, by day; their values are lines, of which means are known exactly.
SLOPES = {"AAM": 1e-9 - 2e-9j, "OAM": 3e-9 + 1e-9j, "SLAM": -2e-9 + 0j}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Two years of three components, synthetic: overlapping by a day, the later one read first."""
    for name, slope in SLOPES.items():
        step = 1.0 if name == "SLAM" else 0.125
        for label, first, last in (("b_1999", 51540, 51544), ("a_2000", 51543, 51548)):
            times = np.arange(first + (0.5 if step == 1 else 0.0), last + 1e-9, step)
            motion = None if name == "SLAM" else 1e-8
            rows = [row(t, slope * (t - 51540), motion) for t in times]
            (tmp_path / f"{label}_{name}.asc").write_text("# synthetic\n" + "\n".join(rows))
    return tmp_path


def test_daily_is_true_or_false(file: Path) -> None:
    file.write_text(EAM)
    with pytest.raises(SceneError, match="daily = 'no'"):
        earthspin.read_excitation(file, daily="no")


def test_a_folder_is_joined_summed_and_averaged(folder: Path) -> None:
    whole = read_angular_momentum(folder, daily=True)
    assert np.array_equal(whole.mjd, 51540.5 + np.arange(8))
    expected = sum(SLOPES.values()) * (whole.mjd - 51540)
    assert np.allclose(whole.mass, expected, rtol=0, atol=1e-17)
    assert np.allclose(whole.motion, 2e-8, rtol=0, atol=1e-20)
    files = sorted(folder.glob("*AAM*"))
    air = earthspin.read_excitation([*files, *folder.glob("*OAM*")], components=["AAM"])
    assert air.sizes["time"] == 8 * 8 + 1
    assert air.attrs["source"] == "AAM (mass, motion)"
    mass = earthspin.read_excitation(folder, components=["AAM"], terms=["mass"])
    assert np.allclose((air - mass).chi1 * MAS, 1e-8, rtol=0, atol=1e-18)
    assert np.allclose(mass.chi2 * MAS, -2e-9 * np.arange(65) / 8, rtol=0, atol=1e-17)


def test_only_the_span_that_all_components_cover(folder: Path) -> None:
    (folder / "b_1999_OAM.asc").unlink()
    found = read_angular_momentum(folder, ["AAM", "OAM"])
    assert np.array_equal(found.mjd, np.arange(51543, 51548.01, 0.125))
    expected = (SLOPES["AAM"] + SLOPES["OAM"]) * (found.mjd - 51540)
    assert np.allclose(found.mass, expected, rtol=0, atol=1e-17)


def test_means_of_days_of_a_bent_line(tmp_path: Path) -> None:
    """A triangle that peaks at noon, its samples at other hours: by hand 3/4 of it, and 1/8."""
    file = tmp_path / "bent"
    times = 51544 + np.array([-12, 0, 12, 24, 36, 48]) / 24
    values = np.array([0, 0.5, 1, 0.5, 0, 0]) * 1e-7
    file.write_text(
        "\n".join(row(t, complex(v, 0), None) for t, v in zip(times, values, strict=True))
    )
    found = read_angular_momentum(file, daily=True)
    assert np.array_equal(found.mjd, [51544.5, 51545.5])
    assert np.allclose(found.mass, [0.75e-7, 0.125e-7], rtol=1e-9, atol=0)


def test_days_that_begin_between_samples(tmp_path: Path) -> None:
    """Samples at 1h, 7h, 13h and 19h of a parabola, against a fine sum of lines between them."""
    file = tmp_path / "parabola"
    times = np.round(51544 + 1 / 24 + np.arange(14) / 4, 3)
    values = 1e-9 * (times - 51544) ** 2
    rows = [row(t, complex(v, 1e-9), None) for t, v in zip(times, values, strict=True)]
    file.write_text("\n".join(rows))
    found = read_angular_momentum(file, daily=True)
    assert np.array_equal(found.mjd, [51545.5, 51546.5])
    inside = (np.arange(100_000) + 0.5) / 100_000
    means = [np.interp(day + inside, times, values).mean() for day in (51545, 51546)]
    assert np.allclose(found.mass.real, means, rtol=1e-8, atol=0)
    assert np.allclose(found.mass.imag, 1e-9, rtol=1e-9, atol=0)


def test_what_does_not_fit_together(folder: Path) -> None:
    with pytest.raises(SeriesError, match="daily=True"):
        read_angular_momentum(folder)
    with pytest.raises(SeriesError, match="'AMM'; did you mean"):
        earthspin.read_excitation(folder, components=["AMM"])
    with pytest.raises(SceneError, match="did you mean 'mass'"):
        earthspin.read_excitation(folder, terms=["mas"])
    other = folder / "c_2000_AAM.asc"
    other.write_text(row(51543.0, 9e-9 + 0j, 1e-8))
    with pytest.raises(SeriesError, match=r"line 1: MJD 51543\.000"):
        read_angular_momentum(folder, ["AAM"])
    other.unlink()
    (folder / "a_2000_AAM.asc").write_text(row(51550.0, 9e-9 + 0j, 1e-8))
    with pytest.raises(SeriesError, match="a file missing"):
        read_angular_momentum(folder, ["AAM"])
    (folder / "notes.txt").write_text("")
    with pytest.raises(SeriesError, match="component"):
        read_angular_momentum(folder)
    with pytest.raises(SeriesError, match="No such file"):
        read_angular_momentum(folder / "none")

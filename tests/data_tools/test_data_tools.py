"""The tools that measure: on the kernel that comes along, in short."""

from pathlib import Path

import numpy as np
import pytest

from data_tools import free_wobble, long_term, neglected
from data_tools.__main__ import main
from data_tools.kernels import largest_differences
from data_tools.windows import rates, scatter
from earthspin.constants import DAY
from earthspin.motion.effects import EFFECTS, MEASURED
from earthspin.sky.ephemeris import Ephemeris


def test_hashes_are_as_known(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["verify"]) == 0
    assert "de421" in capsys.readouterr().out


def test_a_kernel_is_not_far_from_itself(de421: Ephemeris) -> None:
    found = largest_differences(de421, de421, [10, 301], 399, step=1000.0)
    assert found == {10: (0.0, 0.0), 301: (0.0, 0.0)}


def test_a_missing_kernel_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["windows", "--kernel", "none.bsp"]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_the_claimed_error_holds_in_the_last_century(de421: Ephemeris) -> None:
    rate, times = rates(de421, 19_000)
    centres = np.arange(-8000, 8000, 700) * DAY
    for taper, turns in (("hann", 3), ("sin4", 3)):
        rms, largest, share = scatter(rate, times, taper, turns, centres)
        assert share >= 0.95
        assert 0.05 < rms < 1.5  # mas a century; the smooth curve takes part of the swing here
        assert largest < 5


@pytest.mark.parametrize("bent", [False, True])
def test_the_tightest_bound_touches_what_it_bounds(bent: bool) -> None:
    years = np.linspace(-99.0, 50.0, 700)
    growth = 2.8e-4 * years**2 if bent else 0.125 * np.abs(years)
    moved = growth + 0.2 * np.abs(np.sin(years))
    found = neglected.tightest(years, moved, bent=bent)
    bound = neglected.bound(found, years)
    assert np.all(bound >= moved)
    assert found.swing == pytest.approx(0.2, rel=0.02, abs=0)
    assert (found.bend if bent else found.rate) == pytest.approx(
        2.8e-4 if bent else 0.125, rel=0.01, abs=0
    )


def test_numbers_are_rounded_up() -> None:
    assert [neglected.rounded_up(x) for x in (0.0, 7.6377, 0.1230001, 2.76e-4)] == [
        0.0,
        7.64,
        0.124,
        2.76e-4,
    ]


@pytest.mark.slow
def test_the_table_of_what_is_neglected_holds(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """On a coarse grid; what stands is measured on a fine one."""
    monkeypatch.setattr(neglected, "STEP", "29.9 d")
    assert main(["neglected"]) == 0
    rows = [line.split() for line in capsys.readouterr().out.splitlines()[1:]]
    assert {row[0] for row in rows} == set(EFFECTS)
    for name, swing, rate, bend, worst in rows:
        stands = EFFECTS[name].size
        assert 0.8 < float(worst) <= 1
        reach = MEASURED / 365.25
        claimed = stands.swing + stands.rate * reach + stands.bend * reach**2
        found = float(swing) + float(rate) * reach + float(bend) * reach**2
        assert found == pytest.approx(claimed, rel=0.1, abs=0)


def test_a_cell_of_the_free_wobble_is_as_stored() -> None:
    """Eight of the four hundred records: within three of their standard errors."""
    cell = free_wobble.Cell("burg", 100.0, 65.0, 0.3, 500.0)
    row = [part.strip() for part in cell.row(8).split("|")[1:-1]]
    assert row[:4] == ["100", "65", "30%", "500"]
    table = free_wobble.PAGE.read_text().split('`"likelihood"`')[0].splitlines()
    stored = next(x for x in table if x.startswith("| 100 | 65 | 30% | 500 |")).split("|")[1:-1]
    bias, scatter = (float(stored[n].split("±")[0]) for n in (4, 5))
    assert abs(float(row[4].split("±")[0]) - bias) < 3 * scatter / np.sqrt(8)
    assert 90 <= float(stored[7]) <= 100


def test_files_of_other_solutions_are_read_in_their_layouts(tmp_path: Path) -> None:
    (tmp_path / "La2010a.dat").write_text("0 0.0167\n-1 0.0171\n-20000 0.03\n")
    (tmp_path / "LA2004").write_text("0.0 0.167D-01 0.409D+00 0.18D+01\n")
    (tmp_path / "ZB18a").write_text("0.0 1.67E-002 23.5 103.0 478.0\n")
    found = long_term.read_solution(tmp_path / "La2010a.dat")
    assert found["eccentricity"].tolist() == [0.0167, 0.0171]  # beyond ten million years is none
    assert long_term.read_solution(tmp_path / "LA2004")["obliquity"].tolist() == [0.409]
    degrees = long_term.read_solution(tmp_path / "ZB18a")["obliquity"]
    assert degrees == pytest.approx([np.radians(23.5)], rel=1e-14, abs=0)

"""The tools that measure: on the kernel that comes along, in short."""

import numpy as np
import pytest

from data_tools import error_models, free_wobble, neglected
from data_tools.__main__ import main
from earthspin.bodies import EARTH, MARS, MOON, SUN
from earthspin.choosing.choice import models
from earthspin.constants import DAY
from earthspin.motion.effects import EFFECTS, MEASURED
from earthspin.sky.ephemeris import Ephemeris


def test_hashes_are_as_known(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["verify"]) == 0
    assert "de421" in capsys.readouterr().out


def test_a_missing_kernel_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["orbits", "none.bsp"]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_errors_of_windows_are_as_stored(de421: Ephemeris, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(error_models, "NODES", {16: (6, 8, 12), 64: (4,)})
    monkeypatch.setattr(error_models, "REACH", (0.1, 1.0, 3.0, 10.0, 30.0))
    monkeypatch.setattr(error_models, "SAMPLES", 4000)
    place = error_models.place_of(de421, EARTH, MOON)
    found = error_models.window_errors(error_models.tensor_rate(place), error_models.spread)
    table = models()["pole"]
    stored = table["tensor"]["399"]["301"]
    for row, setting in enumerate(error_models.settings()):
        place_in_file = table["settings"].index(list(setting))
        for name in ("value", "derivative"):
            # fewer samples, a shorter span: at most as large, by no more than a factor of 4
            assert -0.6 < found[name][row] - stored[name][place_in_file] < 0.02
        # the largest of few samples in the shortest reaches is left out
        off = np.subtract(found["integral"][row][1:], stored["integral"][place_in_file][1:5])
        assert np.all((off > -0.6) & (off < 0.02)), (setting, off)


@pytest.mark.slow
def test_errors_of_nutation_are_as_stored(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(error_models, "NUTATION_STEPS", (2.0, 5.0))
    monkeypatch.setattr(error_models, "SAMPLES", 6000)
    stored = {(row["model"], row["step"]): row["error"] for row in models()["nutation"]}
    for row in error_models.nutation_models():
        assert abs(row["error"] - stored[row["model"], row["step"]]) < 0.15, (
            row
        )  # measured: 0.09, for fewer samples


def test_means_sampled_sparsely_are_as_stored(de421: Ephemeris) -> None:
    place = error_models.place_of(de421, MARS, SUN)
    start, end = de421.coverage([4, 10])
    days = np.arange(np.ceil(start), np.floor(end))
    turned = np.einsum("tij,jt->it", error_models.orbit_frame(MARS, days), place(days * DAY))
    cycle = SUN.cycle / DAY
    margin = int(np.ceil(4 * cycle)) + 1
    centres = np.arange(margin, days.size - margin, 200)
    found = error_models.average_errors(error_models.tidal_tensor([(1.0, turned)]), cycle, centres)
    stored = models()["average"]["tensor"]["499"][f"{cycle:.2f}"]["10"]
    assert found["mean"] == pytest.approx(stored["mean"], rel=1e-4, abs=0)
    # fifty years of centres instead of a thousand: never worse, where sampling decides, alike
    off = np.subtract(found["in_plane"], stored["in_plane"])
    assert off.max() < 0.3
    assert abs(off[0, -1]) < 0.5


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

"""The tools that measure: on the kernel that comes along, in short."""

import json

import numpy as np
import pytest

from data_tools import audit, free_wobble, neglected
from data_tools.__main__ import main
from earthspin.motion.effects import RESPONSE


def test_hashes_are_as_known(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["verify"]) == 0
    assert "de421" in capsys.readouterr().out


def test_the_tightest_bound_touches_what_it_bounds() -> None:
    years = np.linspace(-99.0, 50.0, 700)
    moved = 0.125 * np.abs(years) + 0.2 * np.abs(np.sin(years))
    found = neglected.tightest(years, moved)
    assert np.all(neglected.bound(found, years) >= moved)
    assert found.swing == pytest.approx(0.2, rel=0.02, abs=0)
    assert found.rate == pytest.approx(0.125, rel=0.01, abs=0)


@pytest.mark.slow
def test_the_bound_on_the_response_holds(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """On a coarse grid; what stands is measured on a fine one."""
    monkeypatch.setattr(neglected, "STEP", "29.9 d")
    assert main(["neglected"]) == 0
    swing, rate, worst = map(float, capsys.readouterr().out.splitlines()[1].split())
    assert 0.8 < worst <= 1
    assert swing + 50 * rate == pytest.approx(RESPONSE.swing + 50 * RESPONSE.rate, rel=0.1, abs=0)


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


FAULT = {"id": "PYSEC-1", "fix_versions": ["2.0"]}


def report(**entry: object) -> str:
    return json.dumps({"dependencies": [{"name": "x", "version": "1.0", **entry}]})


@pytest.mark.parametrize(
    ("found", "problem", "status", "words"),
    [
        (report(vulns=[FAULT]), "", 1, "x 1.0: PYSEC-1, fixed in 2.0"),
        (report(vulns=[]), "", 0, "1 of 1"),
        (report(skip_reason="not found on PyPI"), "", 0, "not found on PyPI"),
        ("", "Traceback\nConnectionError: no network", 0, "ConnectionError"),
        ("", "python: No module named pip_audit", 1, "No module named"),
    ],
)
def test_a_known_vulnerability_fails_and_no_network_is_told(
    capsys: pytest.CaptureFixture[str], found: str, problem: str, status: int, words: str
) -> None:
    assert audit.judge(found, problem) == status
    assert words in capsys.readouterr().out

"""Stiff and extreme cases: their words, how they are judged, and that each can fail."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import earthspin
from data_tools.stability import BEGIN, END, PAGE, markdown, with_tables
from earthspin.checks import stability
from earthspin.checks.case import Case, Distances, holds, judge, refused
from earthspin.checks.stability import PARTS, all_cases, chosen_cases, labelled
from earthspin.cli import main
from earthspin.engine import store
from earthspin.errors import SceneError, UndefinedError
from earthspin.views.stability_tables import tally, tally_line, verdict_tables


@pytest.fixture(scope="module")
def quick() -> xr.Dataset:
    return earthspin.stability(quick=True)


def planted(measure: Callable[[], Any], **changes: Any) -> Case:
    given: dict[str, Any] = {
        "name": "planted",
        "part": "mass",
        "hard_because": "it was planted",
        "held_against": "nothing",
        "bound": 1.0,
    }
    return Case(measure=measure, **(given | changes))


def refusing(line: str = "it cannot be told") -> Callable[[], None]:
    def measure() -> None:
        error = UndefinedError(line)
        error.args = (line,)  # the class itself keeps to one line
        raise error

    return measure


# --- the cases -----------------------------------------------------------------------------


def test_there_are_enough_cases_of_every_part() -> None:
    cases = all_cases()
    assert len(cases) >= 150
    assert sum(case.must_hold for case in cases) >= 130
    assert len({case.name for case in cases}) == len(cases)
    assert {case.part for case in cases} == set(PARTS)


@pytest.mark.parametrize("case", all_cases(), ids=lambda case: case.name)
def test_every_case_says_what_it_is(case: Case) -> None:
    for words in (case.name, case.hard_because, case.held_against):
        assert words
        assert words == " ".join(words.split())
    assert case.unit
    assert 0 <= case.bound < math.inf


def test_a_quick_run_is_a_part_of_all() -> None:
    few, usual, every = chosen_cases(quick=True), chosen_cases(), chosen_cases(long=True)
    assert 130 < len(few) < len(usual) < len(every) == len(all_cases())
    assert not any(case.long for case in usual)


def test_none_fails(quick: xr.Dataset) -> None:
    failed = quick.case.values[quick.verdict.values == "fails"]
    assert list(failed) == [], quick.reason.sel(case=failed).values
    assert np.all(quick.verdict.values[quick.must_hold.values] == "holds")
    assert np.all(quick.verdict.values[~quick.must_hold.values] == "refused")


def test_what_is_measured_is_within_the_bound(quick: xr.Dataset) -> None:
    assert np.all(np.isfinite(quick.measured))
    assert np.all(abs(quick.measured) <= quick.bound)
    refused = quick.isel(case=quick.verdict.values == "refused")
    assert np.all(refused.measured == 0)
    assert np.all(refused.bound == 0)
    assert all("\n" not in line and line for line in refused.reason.values)


# --- the verdicts --------------------------------------------------------------------------


def test_a_distance_within_the_bound_holds() -> None:
    for measured in (0.0, -1.0, np.float64(0.5), np.array(0.2), xr.DataArray([0.1, -0.3]), True):
        found = judge(planted(lambda measured=measured: [measured]))
        assert (found.verdict, found.reason, found.bound) == ("holds", "", 1.0)
        assert found.measured == np.max(np.abs(measured))
        assert found.run_time >= 0


def test_the_distance_is_the_largest_size_of_all_that_is_yielded() -> None:
    def measure() -> Distances:
        yield 0.1
        yield np.array([[0.2, -0.9], [0.3, 0.0]])
        yield -0.4j

    assert judge(planted(measure)).measured == 0.9
    assert judge(planted(measure, bound=0.8)).verdict == "fails"


def warn() -> Distances:
    yield 0.0
    warnings.warn("digits were lost", RuntimeWarning, stacklevel=1)


@pytest.mark.parametrize(
    ("measure", "reason"),
    [
        (lambda: [math.nan], "NaN"),
        (lambda: [0.0, np.float64(math.nan)], "NaN"),
        (lambda: [np.array([math.nan, 9.0]), 0.0], "NaN"),
        (lambda: [0.0, 1.5], "exceeds the bound"),
        (lambda: [-1.5, 0.0], "exceeds the bound"),
        (lambda: [math.inf], "exceeds the bound"),
        (lambda: (np.float64(1e300) * x > 0 for x in [np.float64(1e300)]), "overflow"),
        (lambda: (x / x > 0 for x in np.zeros(1)), "invalid value"),
        (lambda: (1 / x < 0 for x in np.zeros(1)), "divide by zero"),
        (warn, "digits were lost"),
        (lambda: [][1], "IndexError"),
        (lambda: None, "it gave no distance"),
        (lambda: [], "it gave no distance"),
        (lambda: 0.0, "not iterable"),
        (lambda: ["text"], "TypeError"),
        (refusing(), "it was refused: it cannot be told"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_all_else_fails(measure: Callable[[], Any], reason: str) -> None:
    found = judge(planted(measure))
    assert found.verdict == "fails"
    assert reason in found.reason
    assert not math.isnan(found.measured)


def test_an_expected_refusal_is_refused() -> None:
    case = planted(refusing(), refusal="cannot be told")
    found = judge(case)
    assert (found.measured, found.bound, found.verdict) == (0.0, 0.0, "refused")
    assert found.reason == "it cannot be told"


@pytest.mark.parametrize(
    ("measure", "reason"),
    [
        (lambda: [0.0], "an answer instead of a refusal"),
        (lambda: None, "an answer instead of a refusal"),
        (refusing("quite another thing"), "does not say 'cannot be told'"),
        (refusing("it cannot be told\nin one line"), "not one line"),
        (lambda: 1 / 0, "ZeroDivisionError"),
    ],
)
def test_a_refusal_that_does_not_come_fails(measure: Callable[[], Any], reason: str) -> None:
    found = judge(planted(measure, refusal="cannot be told"))
    assert found.verdict == "fails"
    assert reason in found.reason


def test_judging_leaves_no_trace() -> None:
    before, filters = np.geterr(), list(warnings.filters)
    judge(planted(lambda: [0.0]))
    judge(planted(warn))
    assert np.geterr() == before
    assert warnings.filters == filters


def test_what_libraries_will_change_is_no_failure() -> None:
    def measure() -> Distances:
        warnings.warn("will be renamed", DeprecationWarning, stacklevel=1)
        yield 0.0

    assert judge(planted(measure)).verdict == "holds"


def test_the_words_of_a_case_are_its_docstring() -> None:
    @holds(bound=2.0, unit="mas", slow=True)
    def one() -> Distances:
        """a name: with a colon

        Hard because: reasons go on
            in a second line
        Compared with: a reference
        """
        yield 1.0

    @refused("no")
    def two() -> None:
        """another name

        Hard because: c
        """

    assert (one.name, one.hard_because) == (
        "a name: with a colon",
        "reasons go on in a second line",
    )
    assert (one.held_against, one.bound, one.unit) == ("a reference", 2.0, "mas")
    assert (one.part, one.must_hold, one.refusal) == ("test_stability", True, "")
    assert (one.slow, one.long) == (True, False)
    assert judge(one).measured == 1.0
    assert (two.name, two.hard_because) == ("another name", "c")
    assert (two.must_hold, two.refusal) == (False, "no")
    assert two.held_against == "a refusal in one line that says 'no'"


# --- the dataset ---------------------------------------------------------------------------


def test_the_dataset_is_as_promised(quick: xr.Dataset) -> None:
    for name in ("measured", "bound", "verdict", "must_hold", "unit", "hard_because"):
        assert quick[name].dims == ("case",)
    assert quick.must_hold.dtype == bool
    assert set(quick.verdict.values) == {"holds", "refused"}
    assert quick.run_time.attrs["units"] == "s"
    assert all(variable.attrs["long_name"] for variable in quick.variables.values())
    assert quick.sizes["case"] == len(np.unique(quick.case))


def test_it_comes_back_from_disk(quick: xr.Dataset, tmp_path: Path) -> None:
    xr.testing.assert_identical(store.read(store.write(quick, tmp_path / "s.nc")), quick)


def test_only_some() -> None:
    parts = earthspin.stability(only="units")
    assert set(parts.case_part.values) == {"units"}
    words = earthspin.stability(only="Leap SECOND")
    assert words.case.values.tolist() == [
        "through the leap second of 2016-12-31",
        "every leap second since 1972",
    ]


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"only": "motoin"}, "did you mean 'motion'"),
        ({"only": "zzz"}, "no case has that word"),
        ({"only": ""}, "no case has that word"),
        ({"only": "10^8 epochs", "quick": True}, "take long"),
    ],
)
def test_words_that_no_case_has(given: dict[str, Any], said: str) -> None:
    with pytest.raises(SceneError, match="stability: only") as error:
        earthspin.stability(**given)
    assert said in str(error.value)


# --- the command ---------------------------------------------------------------------------


def test_the_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["stability", "--quick", "--only", "leap second"]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert "through the leap second" in out
    assert out.splitlines()[-1].startswith("2 cases, 2 of which must hold: 2 hold, 0 are refused")


@pytest.mark.parametrize(
    "measure", [lambda: [math.nan], lambda: 1 / 0, lambda: [np.exp(np.float64(1e4))]]
)
def test_a_failure_is_told_and_is_the_exit_status(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, measure: Any
) -> None:
    cases = (planted(lambda: [0.0], name="sound"), planted(measure))
    monkeypatch.setattr(stability, "all_cases", lambda: cases)
    assert main(["stability"]) == 1
    out = capsys.readouterr().out
    assert "fails: planted: " in out
    assert "1 hold, 0 are refused as they should be, 1 fail" in out


def test_tables_and_tally() -> None:
    cases = (
        planted(lambda: [0.0], name="one"),
        planted(lambda: [2.0], name="two", unit="mas"),
        planted(refusing("|a| is no"), name="three", refusal="is no", part="top"),
    )
    result = labelled(cases, [judge(case) for case in cases])
    assert tally(result) == {"holds": 1, "refused": 1, "fails": 1}
    first, second = verdict_tables(result)
    assert [row[-1] for row in first.rows] == ["holds", "fails"]
    assert second.rows == [("three", "", "", "", "refused")]
    assert tally_line(result).startswith("3 cases, 2 of which must hold: 1 hold")
    text = markdown(result)
    assert "| two | it was planted | nothing | 2.0e+00 mas | 1.0e+00 mas | fails |" in text
    assert "| three | it was planted | \\|a\\| is no |" in text


# --- the page ------------------------------------------------------------------------------


def test_the_page_shows_every_case() -> None:
    page = PAGE.read_text(encoding="utf-8")
    shown = {line.split(" | ")[0].removeprefix("| ") for line in page.splitlines()}
    missing = {case.name for case in chosen_cases()} - shown
    assert not missing, "run python -m data_tools stability"
    assert "| fails |" not in page.split(BEGIN)[1]


def test_the_measured_part_is_replaced_and_nothing_else() -> None:
    page = f"words\n{BEGIN}\nold\n{END}\nmore words\n"
    new = with_tables(page, "new")
    assert new == f"words\n{BEGIN}\n\nnew\n{END}\nmore words\n"
    assert with_tables(new, "new") == new

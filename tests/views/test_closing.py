"""The line that ends `run` and `report`: the error of the headline number, and its cost."""

import re
import subprocess
import sys
import time
from pathlib import Path

import astropy.units as u
import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin import EARTH, cli
from earthspin.engine.variables import largest_of
from earthspin.scenes import QUESTIONS
from earthspin.views.closing_line import closing_line
from earthspin.views.rendering import tables_for
from tests import shipped


@pytest.mark.parametrize("word", QUESTIONS)
def test_every_question_has_a_headline_with_an_error_or_a_reason(word: str) -> None:
    answer = shipped.answer(shipped.SCENES[word])
    assert QUESTIONS[word].headline in answer
    line = closing_line(answer)
    assert re.search(r"95 % error [\d.e-]+|no error: \w", line), line
    effect = largest_of(answer.attrs["neglected"])
    if effect is not None:  # its size can be compared with the error
        value = answer[QUESTIONS[word].headline]
        names = [value.name, *value.attrs.get("ancillary_variables", "").split()]
        units = [answer[name].attrs["units"] for name in names]
        assert any(u.Unit(effect[2]).is_equivalent(u.Unit(unit)) for unit in units)


def test_the_numbers_of_the_line_are_those_of_the_answer(precession_tree: xr.DataTree) -> None:
    line, total = closing_line(precession_tree), precession_tree.sel(perturber="total")
    shown = [float(number) for number in re.findall(r"(?<= )\d[\d.]*e-\d+", line.split(";")[0])]
    names = ["precession_rate_error" + share for share in ("", "_method", "_input")]
    assert np.allclose(shown, [float(total[name]) for name in names], rtol=0.05, atol=0)
    plan = precession_tree["plan"]
    (work,) = map(float, re.findall(r"of it ([\d.e-]+) s computation", line))
    assert work == pytest.approx(float(plan.run_time.sum()), rel=0.05, abs=0)
    assert float(plan.computation_time) == pytest.approx(
        float(plan.run_time.sum()), rel=1e-9, abs=0
    )
    assert float(plan.wall_time) > float(plan.computation_time)


def test_a_series_gives_its_largest_error_and_the_date() -> None:
    answer = earthspin.torque_series("2000-01-01", "2000-03-01", "1 d")
    largest = answer.torque_magnitude_error.where(
        answer.torque_magnitude_error == answer.torque_magnitude_error.max(), drop=True
    )
    date, name = str(largest.time.values[0])[:10], str(largest.perturber.values[0])
    assert f"at {date}, {name}" in closing_line(answer)


def test_a_headline_names_an_epoch_of_the_answer() -> None:
    """The largest error at epoch -2,963,000 was announced at -3e6."""
    answer = earthspin.long_term(times=["0 yr", "-2963000 yr"])
    line = closing_line(answer)
    assert float(re.findall(r"at epoch (\S+) yr", line)[0]) in answer.epoch.values


@pytest.mark.parametrize("scene", ["polar-motion", "forecast", "iau"])
def test_the_line_has_the_unit_of_the_tables(scene: str) -> None:
    """The error of the pole was given in arcsec beside tables in mas."""
    answer = shipped.answer(scene)
    name = QUESTIONS[answer.attrs["compute"]].headline
    unit = {"iau": "mas/cy"}.get(scene, "mas")
    size, own = re.findall(r"95 % error (\S+) (\S+?)(?: at|;|$)", closing_line(answer))[0]
    assert own == unit
    error = answer[answer[name].attrs["ancillary_variables"]]
    factor = (1 * u.Unit(error.attrs["units"])).to_value(unit.replace("cy", "hyr"))
    assert float(size) == pytest.approx(float(error.max()) * factor, rel=0.05, abs=0)
    shown = " ".join(" ".join(table.headers) for table in tables_for(answer))
    assert f", {unit}" in shown


def test_a_neglected_effect_has_the_unit_of_the_error() -> None:
    line = closing_line(shipped.answer("iau"))
    assert re.search(r"error \S+ mas/cy; not modelled: nonrigid, -21 mas/cy", line), line


def test_an_effect_is_named_only_where_it_exceeds_the_error() -> None:
    assert "not modelled: geodesic" in closing_line(earthspin.precession())
    vague = EARTH.replace(relative_uncertainty={"dynamical_flattening": 0.01})
    assert "not modelled" not in closing_line(earthspin.precession(body=vague))


def test_an_unmeasured_error_gives_its_reason() -> None:
    answer = earthspin.precession().copy()
    answer["precession_rate_error"] = answer.precession_rate_error * np.nan
    answer.precession_rate_error.attrs |= {"no_error": "its positions were not compared"}
    assert closing_line(answer) == "precession rate: no error: its positions were not compared"


def test_it_is_the_last_line_of_the_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["run", "wobble"]) == 0
    last = capsys.readouterr().out.splitlines()[-1]
    assert re.fullmatch(
        r"period solar: largest 95 % error .* d at \w+; .* s, of it .* s computation", last
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    "words",
    [
        "run precession",
        "ensemble precession --members 10 --out {}/e.zarr",
        "play top --out {}/top.html",
    ],
)
def test_the_line_gives_the_wall_time_of_the_process(words: str, tmp_path: Path) -> None:
    """As a clock outside has it; the process was 0.3 s long, or longer, before it was asked."""
    command = [sys.executable, "-m", "earthspin", *words.format(tmp_path).split()]
    begun = time.monotonic()
    process = subprocess.run(command, capture_output=True, text=True, check=True)
    outside = time.monotonic() - begun
    last = process.stdout.splitlines()[-1]
    inside, work = map(float, re.findall(r"(\S+) s, of it (\S+) s computation$", last)[0])
    assert 0.5 * outside < inside < outside + 0.05 + 0.05 * inside
    assert work < inside

"""The scripts of the gallery: what each must say, and what the quick ones draw.

The build of the pages runs all of them, and refuses a picture by the same rules.
"""

import ast
import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
CHECK = DOCS / "_ext" / "gallery_figures.py"
SCRIPTS = sorted((DOCS / "gallery").rglob("plot_*.py"))

#: Half a second each at most; together they touch every package that the gallery draws.
QUICK = (
    "bodies/plot_axes_of_a_brick", "bodies/plot_maccullagh", "bodies/plot_moment_about_any_axis",
    "bodies/plot_one_over_r", "bodies/plot_rings", "bodies/plot_spheroid_field",
    "free_rotors/plot_football_and_plate", "free_rotors/plot_herpolhode",
    "free_rotors/plot_polhodes", "free_rotors/plot_tennis_racket",
    "long_term/plot_angles_of_the_equator", "many/plot_day_and_flattening",
    "many/plot_rackets", "many/plot_ten_thousand_earths", "pole/plot_pole_path",
    "precession/plot_pole_circle", "precession/plot_worlds", "top/plot_effective_potential",
    "top/plot_sleeping_top", "top/plot_steady_precession", "top/plot_three_patterns",
    "torques/plot_torque_against_declination", "torques/plot_torque_through_a_year",
    "torques/plot_who_pulls", "wobble/plot_inside", "wobble/plot_ladder",
)  # fmt: skip

#: An equation, section or exercise of the source text, or a paper with its year.
SOURCE = re.compile(r"\bI\.\d|\b(1[89]|20)\d\d\)")


def name(script: Path) -> str:
    return script.relative_to(DOCS / "gallery").with_suffix("").as_posix()


def faults_of(*scripts: Path) -> dict[str, list[str]]:
    """Faults of each figure, in a process of its own: what is tested elsewhere needs no pyplot."""
    out = subprocess.run(
        [sys.executable, "-W", "error::RuntimeWarning", str(CHECK), *map(str, scripts)],
        capture_output=True,
        encoding="utf-8",
    )
    assert out.returncode == 0, out.stderr
    found = [json.loads(line) for line in out.stdout.splitlines()]
    return {line["script"]: line["faults"] for line in found}


@pytest.fixture(scope="module")
def faults() -> dict[str, list[str]]:
    return faults_of(*(DOCS / "gallery" / f"{script}.py" for script in QUICK))


def test_there_are_at_least_thirty() -> None:
    assert len(SCRIPTS) >= 30
    assert {name(script) for script in SCRIPTS} >= set(QUICK)


@pytest.mark.any_version
@pytest.mark.parametrize("script", SCRIPTS, ids=name)
def test_it_says_what_is_seen_where_it_stands_and_what_to_try(script: Path) -> None:
    text = script.read_text(encoding="utf-8")
    words = ast.get_docstring(ast.parse(text))
    assert words is not None
    title, line, *rest = words.splitlines()
    assert len(title) <= len(line)
    assert set(line) == {"="}
    assert SOURCE.search(words), "no equation of the source text and no paper"
    assert any(part.startswith("*Next:*") for part in rest), "nothing to try next"


@pytest.mark.any_version
@pytest.mark.parametrize("script", SCRIPTS, ids=name)
def test_it_is_short_and_types_no_result(script: Path) -> None:
    text = script.read_text(encoding="utf-8")
    words = ast.get_docstring(ast.parse(text)) or ""
    code = text.split('"""', 2)[2].splitlines()
    assert sum(bool(line.strip()) and not line.strip().startswith("#") for line in code) <= 26
    prose = re.sub(r"\bI\.\d+(\.\d+)?|``.*?``|:math:`.*?`", "", words)
    assert re.findall(r"\d+\.\d+", prose) == [], "numbers come from what the script prints or draws"


@pytest.mark.slow
@pytest.mark.parametrize("script", QUICK)
def test_it_draws_one_figure_whose_axes_name_their_units(
    script: str, faults: dict[str, list[str]]
) -> None:
    assert faults[str(DOCS / "gallery" / f"{script}.py")] == []


def test_the_rules_see_what_is_wrong(tmp_path: Path) -> None:
    none, poor = tmp_path / "none.py", tmp_path / "poor.py"
    none.write_text("print('no figure')\n")
    poor.write_text(
        "import matplotlib.pyplot as plt\n"
        "figure, ax = plt.subplots()\n"
        "ax.plot([1.0, 2.0, float('nan')], label='broken')\n"
        "ax.set(xlabel='time', ylabel='length, m')\n"
    )
    assert faults_of(none, poor) == {
        str(none): ["it draws 0 figures, not one"],
        str(poor): [
            "the label of x, 'time', has no unit",
            "the label of y, 'length, m', has its unit not in brackets at its end",
            "the line 'broken' has NaN",
        ],
    }

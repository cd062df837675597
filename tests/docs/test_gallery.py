"""Scripts of the gallery: their text, and the figures of the quick ones.

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

#: Some seconds together; they touch the packages that draw at once.
QUICK = (
    "bodies/plot_gravity_of_a_body", "bodies/plot_inertia", "bodies/plot_spheroids_and_rings",
    "free_rotors/plot_cones_and_stability", "many/plot_many_bodies",
    "top/plot_nutation_of_a_top", "top/plot_steady_and_sleeping_tops", "torques/plot_torques",
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


def parts(script: Path) -> list[tuple[list[str], list[str]]]:
    """Lines of text and of code of each picture."""
    blocks = script.read_text(encoding="utf-8").split("\n# %%\n")[1:]
    lines = [block.splitlines() for block in blocks]
    ends = [next(n for n, line in enumerate(block) if line[:1] != "#") for block in lines]
    return [
        ([line.removeprefix("#").strip() for line in block[:end]], block[end:])
        for block, end in zip(lines, ends, strict=True)
    ]


def test_there_are_at_least_sixty_pictures() -> None:
    assert sum(len(parts(script)) for script in SCRIPTS) >= 60
    assert {name(script) for script in SCRIPTS} >= set(QUICK)


@pytest.mark.any_version
@pytest.mark.parametrize("script", SCRIPTS, ids=name)
def test_a_picture_has_a_title_a_source_and_something_to_try(script: Path) -> None:
    title, line, *_ = (ast.get_docstring(ast.parse(script.read_text("utf-8"))) or "").splitlines()
    assert line == "=" * len(title)
    for (heading, under, *text), _ in parts(script):
        assert under == "-" * len(heading)
        assert SOURCE.search(" ".join(text)), f"{heading}: no equation and no paper"
        assert any(part.startswith("*Next:*") for part in text), f"{heading}: nothing to try next"


@pytest.mark.any_version
@pytest.mark.parametrize("script", SCRIPTS, ids=name)
def test_code_is_short_and_text_has_no_computed_number(script: Path) -> None:
    for (heading, *text), code in parts(script):
        assert sum(line.strip()[:1] not in ("", "#") for line in code) <= 26, heading
        prose = re.sub(r"\bI\.\d+(\.\d+)?|``.*?``|:math:`.*?`", "", " ".join(text))
        assert re.findall(r"\d+\.\d+", prose) == [], heading


@pytest.mark.slow
@pytest.mark.parametrize("script", QUICK)
def test_figures_whose_axes_name_their_units(script: str, faults: dict[str, list[str]]) -> None:
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
        str(none): ["0 figures are drawn, not 1"],
        str(poor): [
            "the label of x, 'time', has no unit",
            "the label of y, 'length, m', has its unit not in brackets at its end",
            "the line 'broken' has NaN",
        ],
    }

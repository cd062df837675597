"""Rules by which the build of the pages refuses a figure of the gallery."""

import json
import subprocess
import sys
from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs"
CHECK = DOCS / "_ext" / "gallery_figures.py"


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

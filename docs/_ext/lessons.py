"""What a lesson of the course holds, how its cells are run, and how Jupyter is to read it.

``python docs/_ext/lessons.py LESSON ...`` runs the cells of lessons with warnings as errors, and
prints a line of JSON for each: its path, what it prints, and what is wrong with its figures.
"""

from __future__ import annotations

import json
import re
import sys
import warnings
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

_CELL = re.compile(
    r"^```\{code-cell\} ipython3\n(?::tags:.*\n\n)?((?:.*\n)*?)```$", flags=re.MULTILINE
)
_LABEL = re.compile(r"\$\$ \(([^)]+)\)$", flags=re.MULTILINE)
_PLACE = re.compile(r"\{place\}`(?:[^`<]+<([^>`]+)>|([^`]+))`")
_SOLUTION = re.compile(
    r'<details class="solution">\n<summary>.*?</summary>\n\n(.*?)\n</details>', re.S
)

#: Words of these pages, and what Jupyter understands for them.
IN_JUPYTER = (
    (_LABEL, r"\\tag{\1}$$"),
    (re.compile(r"\{place\}`([^`<]+?) <[^`]+>`"), r"\1"),
    (re.compile(r"\{place\}`([^`]+)`"), r"(\1)"),
    (re.compile(r'<details class="solution">\n<summary>(.*?)</summary>'), r"**\1**"),
    (re.compile(r"\n*</details>"), ""),
    (re.compile(r"\]\(((?:\.\./)*[\w/-]+)\.md\)"), r"](\1.html)"),
)

#: Warnings of others, on which nobody here can act; the tests of the package ignore them too.
OF_OTHERS = ("The file .*finals2000A", "numpy.ndarray size changed", "Setting the shape on a NumPy")


def cells(text: str) -> list[str]:
    """Return the code of each cell."""
    return _CELL.findall(text)


def places(text: str) -> list[str]:
    """Return the numbers of the source text that have their place in a lesson."""
    return _LABEL.findall(text) + [named or plain for named, plain in _PLACE.findall(text)]


def solutions(text: str) -> list[str]:
    """Return what folds open below each exercise."""
    return _SOLUTION.findall(text)


def for_jupyter(text: str) -> str:
    """Tell the prose of a lesson in the words of Jupyter."""
    for ours, theirs in IN_JUPYTER:
        text = ours.sub(theirs, text)
    return text


def run(lesson: Path) -> dict[str, Any]:
    """Run the cells of a lesson, one after the other, in one clean namespace."""
    from gallery_figures import faults
    from matplotlib import pyplot as plt

    plt.close("all")
    plt.rcdefaults()
    names: dict[str, Any] = {"__name__": "__main__"}
    printed = StringIO()
    with redirect_stdout(printed):
        for code in cells(lesson.read_text(encoding="utf-8")):
            exec(compile(code, str(lesson), "exec"), names)
    figures = [plt.figure(number) for number in plt.get_fignums()]
    return {"lesson": lesson.stem, "printed": printed.getvalue(), "faults": faults(figures, 1)}


def main(lessons: list[str]) -> None:
    """Run lessons, and print what came of each."""
    from matplotlib import pyplot as plt

    plt.switch_backend("Agg")
    warnings.simplefilter("error")
    for message in OF_OTHERS:
        warnings.filterwarnings("ignore", message)
    for lesson in lessons:
        print(json.dumps(run(Path(lesson))), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])

"""Cells, equations and solutions of a lesson of the course, and the lesson for Jupyter."""

from __future__ import annotations

import re

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

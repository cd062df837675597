"""Tutorials and how-to pages: code that fits its column and can be copied."""

import ast
import re
from pathlib import Path

import pytest

pytestmark = pytest.mark.any_version
DOCS = Path(__file__).parents[2] / "docs"
PAGES = sorted([*(DOCS / "tutorials").glob("*.md"), *(DOCS / "howto").glob("*.md")])
STORIES = [page for page in PAGES if page.name != "index.md"]
CELL = re.compile(r"^```\{code-cell\} ipython3\n(.*?)^```", re.DOTALL | re.MULTILINE)
#: Characters of code that the column of a page holds at 1280 pixels.
WIDEST = 94


def name(page: Path) -> str:
    return f"{page.parent.name}/{page.stem}"


@pytest.mark.parametrize("page", STORIES, ids=name)
def test_code_fits_and_can_be_copied(page: Path) -> None:
    """No magic and no command of a shell among the Python, and nothing imported out of sight."""
    text = page.read_text(encoding="utf-8")
    cells = CELL.findall(text)
    shown = [cell for cell in cells if not cell.startswith(":tags:")]
    assert shown
    for cell in shown:
        assert max(map(len, cell.splitlines())) <= WIDEST, cell
        ast.parse(cell)  # a line that starts with % or ! is no Python
    imported = set(re.findall(r"^(?:from \S+ )?import (.+?)(?:\s+#.*)?$", "".join(shown), re.M))
    assert any("earthspin" in words for words in imported)

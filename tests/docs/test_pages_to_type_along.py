"""Tutorials and how-to pages: code that fits its column, no step that the reader does not see."""

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


@pytest.mark.parametrize("page", [p for p in STORIES if p.parent.name == "tutorials"], ids=name)
def test_a_tutorial_ends_in_a_figure_in_the_folder(page: Path) -> None:
    last = CELL.findall(page.read_text(encoding="utf-8"))[-1]
    assert re.search(r'figure\.savefig\("\w+\.(png|pdf)"', last)


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_every_page_is_on_the_list_of_its_folder(page: Path) -> None:
    if page.name != "index.md":
        listed = (page.parent / "index.md").read_text(encoding="utf-8").splitlines()
        assert page.stem in listed

"""Every word that the pages mark as a term has its line in the glossary."""

import re
from pathlib import Path

import pytest

pytestmark = pytest.mark.any_version
DOCS = Path(__file__).parents[2] / "docs"
PAGES = [page for page in DOCS.rglob("*.md") if "_build" not in page.parts]
MARKED = re.compile(r"\{term\}`(?:[^`<]*<([^`>]+)>|([^`]+))`")


def marked(text: str) -> set[str]:
    """Terms that a page marks: the word itself, or the one in brackets behind it."""
    return {" ".join((one or other).split()) for one, other in MARKED.findall(text)}


def entries() -> dict[str, str]:
    """Terms of the glossary with their lines."""
    body = (DOCS / "glossary.md").read_text(encoding="utf-8").split(":sorted:\n\n")[1]
    found: dict[str, str] = {}
    for entry in body.split("\n```")[0].split("\n\n"):
        head, _, words = entry.partition("\n")
        found[head] = " ".join(words.split())
    return found


def test_every_marked_term_has_an_entry() -> None:
    there, used = set(entries()), set()
    for page in PAGES:
        terms = marked(page.read_text(encoding="utf-8"))
        used |= terms
        assert terms <= there, f"{page.name}: {sorted(terms - there)}"
    assert len(used) >= 10


def test_every_entry_says_something_in_a_sentence() -> None:
    for term, words in entries().items():
        assert len(words) > 20, term
        assert words.endswith("."), term


def test_marks_are_found() -> None:
    assert marked("a {term}`polar\nmotion`, {term}`True <true equator>`") == {
        "polar motion", "true equator",
    }  # fmt: skip

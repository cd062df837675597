"""The lessons of the course: every equation has its place. The build of the pages runs them."""

import re
import tomllib

import pytest

from tests.docs.lessons import DOCS, RUNNER, built

INDEX = (DOCS / "course" / "index.md").read_text(encoding="utf-8")
NAMES = re.search(r"```\{toctree\}\n:maxdepth: 1\n\n(.*?)\n```", INDEX, re.S)[1].split()  # type: ignore[index]
LESSONS = {
    name: (DOCS / "course" / f"{name}.md").read_text(encoding="utf-8") for name in NAMES
}  # fmt: skip

READER = built(RUNNER)


def test_every_lesson_is_in_the_contents() -> None:
    there = {path.stem for path in (DOCS / "course").glob("*.md")} - {"index"}
    assert set(NAMES) == there
    assert len(NAMES) == 11


def test_every_number_has_its_place_in_the_lesson_of_its_section() -> None:
    entries = tomllib.loads((DOCS / "equations.toml").read_text(encoding="utf-8"))["equation"]
    placed = {}
    for name, text in LESSONS.items():
        title = re.search(r"^# (?:(I\.\d) )?", text, re.MULTILINE)
        for number in READER.places(text):
            assert number not in placed, f"{number} has two places"
            placed[number] = name
            assert title is not None
            assert title[1] is not None, f"{number} in {name}"
            assert number.startswith(title[1]), f"{number} in {name}"
    assert set(placed) == {entry["number"] for entry in entries}


@pytest.mark.parametrize("name", NAMES)
def test_it_has_exercises_whose_numbers_are_computed(name: str) -> None:
    text = LESSONS[name]
    exercises = re.findall(r"^\*\*\d\.\*\* ", text, re.MULTILINE)
    found = READER.solutions(text)
    assert 2 <= len(exercises) <= 4
    assert len(exercises) == len(found) == text.count("<details") == text.count("</details>")
    assert all(READER.cells(solution) for solution in found)


@pytest.mark.parametrize("name", NAMES)
def test_jupyter_finds_nothing_it_does_not_know(name: str) -> None:
    told = READER.for_jupyter(LESSONS[name])
    prose = re.sub(r"```.*?```", "", told, flags=re.S)
    assert not re.search(r"\{\w+\}`|</?(details|summary)|\$\$ \(I\.|\.md\)", prose)

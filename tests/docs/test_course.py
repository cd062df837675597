"""The lessons of the course: every equation has its place. The build of the pages runs them."""

import re
import tomllib

from tests.docs.lessons import DOCS, RUNNER, built

INDEX = (DOCS / "course" / "index.md").read_text(encoding="utf-8")
NAMES = re.search(r"```\{toctree\}\n:maxdepth: 1\n\n(.*?)\n```", INDEX, re.S)[1].split()  # type: ignore[index]
LESSONS = {
    name: (DOCS / "course" / f"{name}.md").read_text(encoding="utf-8") for name in NAMES
}  # fmt: skip

READER = built(RUNNER)


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

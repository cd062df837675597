"""The lessons of the course: every number has its place, every cell runs, what it prints is so.

The build of the pages runs the cells too, and refuses one that fails.
"""

import re
import tomllib

import pytest

from tests.docs.lessons import DOCS, NUMBER, RUNNER, built, hold, results_of

INDEX = (DOCS / "course" / "index.md").read_text(encoding="utf-8")
NAMES = re.search(r"```\{toctree\}\n:maxdepth: 1\n\n(.*?)\n```", INDEX, re.S)[1].split()  # type: ignore[index]
LESSONS = {
    name: (DOCS / "course" / f"{name}.md").read_text(encoding="utf-8") for name in NAMES
}  # fmt: skip

#: What a lesson prints of one thing: two numbers, found in two ways, and how near they are to each
#: other; or one number, their difference, and what it may come to.
PRINTED = {
    "inertia-tensor": [
        (rf"T over particles: {NUMBER} J\nT from the tensor: {NUMBER}", 1e-11),
        (rf"torque on the bearings: {NUMBER} N m, by the formula {NUMBER}", 1e-4),
        (rf"trace {NUMBER}, 2 Σ m r² {NUMBER}", 1e-6),
        (rf"largest difference:? {NUMBER}", 1e-14),
    ],
    "equation-of-motion": [
        (rf"energy gained {NUMBER} J, work done {NUMBER} J", 1e-5),
        (rf"leaves the straight line by {NUMBER}", 1e-11),
        (rf"largest difference {NUMBER} kg", 1e-6),
    ],
    "principal-axes": [
        (rf"{NUMBER} m towards the ice; by the estimate {NUMBER} m", 1e-2),
    ],
    "euler-equations": [
        (rf"growth by hand {NUMBER} 1/s.*?\n.*?from the motion: {NUMBER}", 1e-5),
        (rf"closed form in I.4.4: off by {NUMBER}", 2e-5),
        (rf"stepped instead: {NUMBER}", 1e-12),
        (rf"changes by {NUMBER}", 1e-13),
    ],
    "poinsot": [
        (rf"height over width {NUMBER}, by the formula {NUMBER}", 1e-4),
        (rf"2T/L = {NUMBER} rad/s; height of the tip {NUMBER}", 1e-6),
        (rf"1 ± {NUMBER}", 1e-14),
    ],
    "symmetric-rotor": [
        (rf"φ' = {NUMBER}, L/I1 = {NUMBER}", 1e-6),
        (rf"Ω' = {NUMBER}, {NUMBER} rad/s", 1e-11),
        (rf"Jacobi's functions: {NUMBER}", 1e-13),
        (rf"largest difference in S: {NUMBER}", 1e-13),
        (rf"I⁻¹ L is ω to {NUMBER}", 1e-13),
    ],
    "heavy-top": [
        (rf"I.7.17: {NUMBER} s from A to B and back;\nlibrary {NUMBER}", 1e-8),
        (rf"critical spin {NUMBER}, library {NUMBER}", 1e-6),
        (rf"falls to {NUMBER}°, library {NUMBER}°", 1e-5),
        (rf"I.7.9 : off by {NUMBER}", 3e-5),
        (rf"I.7.18: off by {NUMBER}", 1e-5),
        (rf"after 24 s {NUMBER}", 1e-10),
        (rf"it nods by {NUMBER} deg", 1e-6),
    ],
    "oblate-earth": [
        (rf"exact {NUMBER}, I.8.2 {NUMBER}", 2e-3),
        (rf"by hand: .*: {NUMBER} years(?:.*\n)+library: total .* {NUMBER} years", 1e-3),
        (rf"I.8.7 by hand is off by {NUMBER}", 1e-14),
    ],
    "torque-formula": [
        (rf"J2 = {NUMBER}, G \(I3 - I1\) = {NUMBER}", 1e-9),
        (rf"by hand {NUMBER}, library {NUMBER}", 1e-14),
    ],
    "observed-earth": [
        (rf"elastic .* = {NUMBER} days\n(?:.*\n)*elastic +{NUMBER} days", 3e-4),
        (rf"C/\(M a²\) = {NUMBER}; moment factor of PREM {NUMBER}", 1e-3),
    ],
    "long-run": [
        (rf"off the formula by {NUMBER}", 1e-14),
        (rf"by hand {NUMBER}, library {NUMBER} arcsec a year", 1e-4),
        (rf"swings by {NUMBER}°, to first order {NUMBER}°", 2e-2),
        (rf"by hand {NUMBER}°, library {NUMBER}°", 1e-3),
        (rf"they differ by {NUMBER}°", 0.05),
        (rf"from the plane alone {NUMBER}, library {NUMBER} arcsec", 1e-3),
        (rf"{NUMBER} W/m² by hand, {NUMBER} by the library", 1e-4),
    ],
}


READER = built(RUNNER)


@pytest.fixture(scope="module")
def results() -> dict[str, dict[str, str]]:
    return results_of(DOCS / "course" / f"{name}.md" for name in NAMES)


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


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_its_cells_run_and_draw_one_picture(name: str, results: dict[str, dict[str, str]]) -> None:
    assert READER.cells(LESSONS[name])
    assert results[name]["faults"] == []


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_what_it_prints_twice_agrees(name: str, results: dict[str, dict[str, str]]) -> None:
    for words, nearness in PRINTED[name]:
        hold(results[name]["printed"], words, nearness)


@pytest.mark.parametrize("name", NAMES)
def test_jupyter_finds_nothing_it_does_not_know(name: str) -> None:
    told = READER.for_jupyter(LESSONS[name])
    prose = re.sub(r"```.*?```", "", told, flags=re.S)
    assert not re.search(r"\{\w+\}`|</?(details|summary)|\$\$ \(I\.|\.md\)", prose)


def test_words_for_jupyter() -> None:
    ours = (
        "by {place}`I.1.8` $$ a = b $$ (I.1.9)\n{place}`exercise <I.1 exercise: x>` [map](../a.md)"
    )
    told = "by (I.1.8) $$ a = b \\tag{I.1.9}$$\nexercise [map](../a.html)"
    assert READER.for_jupyter(ours) == told
    assert READER.places(ours) == ["I.1.9", "I.1.8", "I.1 exercise: x"]

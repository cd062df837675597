"""What questions are made of: typed parts that fit together, shown to a type checker."""

import inspect
import re
import subprocess
import sys
from collections.abc import Iterator
from graphlib import TopologicalSorter
from pathlib import Path
from typing import Any

import pytest

from earthspin.engine.part import BLOCK, Part, part
from earthspin.engine.question import Question, define_parts, key, keys_of
from earthspin.engine.variables import Neglected
from earthspin.scenes import QUESTIONS

ROOT = Path(__file__).parents[2]
PARTS = {
    f"{question.word}: {one.title}": one
    for question in QUESTIONS.values()
    for one in question.graph.parts.values()
}


def calls_of(question: type[Question]) -> list[str]:
    """A function that calls each part with the results of the others, for the type checker."""
    parts, keys = question.graph.parts, keys_of(question)
    names = {
        n: [i for i in (*p.needs, *p.uses) if i in parts or i in keys] for n, p in parts.items()
    }
    needs = {n: [i for i in inputs if i in parts] for n, inputs in names.items()}
    lines = [f"def {question.call}(question: {question.__module__}.{question.__name__}) -> None:"]
    for name in TopologicalSorter(needs).static_order():
        given = ", ".join(f"{i}={i if i in parts else f'question.{i}'}" for i in names[name])
        laid = ".dataset()" if parts[name].gives else ""
        lines.append(f"    {name} = {parts[name].__module__}.{name}({given}){laid}")
    return lines


def test_results_and_parameters_agree_in_type(tmp_path: Path, pytestconfig: pytest.Config) -> None:
    """In one function more, a part gets what another gives, so that the checker is seen to look."""
    lines = [line for question in QUESTIONS.values() for line in calls_of(question)]
    wrong = [line.replace("samples(sky=sky", "samples(sky=stretch") for line in lines]
    assert wrong != lines
    modules = {part.__module__ for part in PARTS.values()}
    modules |= {question.__module__ for question in QUESTIONS.values()}
    head = [f"import {module}" for module in sorted(modules)]
    for name, text in (("right", lines), ("wrong", wrong)):
        (tmp_path / f"{name}.py").write_text("\n".join([*head, *text, ""]), encoding="utf-8")
    cache = getattr(pytestconfig, "cache", None)  # none where its plugin is off
    kept = Path(cache.mkdir("mypy")) if cache is not None else tmp_path / "cache"
    words = [*(sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(kept))]
    words += ["--config-file", str(ROOT / "pyproject.toml"), *map(str, tmp_path.glob("*.py"))]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False)
    assert "right.py" not in done.stdout, done.stdout
    assert "arg-type" in done.stdout, done.stdout + done.stderr


# --- types -----------------------------------------------------------------------------------

LOOSE = re.compile(r"\bAny\b|\bobject\b|\b[Dd]ict\b(?!\[)|\bMapping\b(?!\[)|\blist\b(?!\[)")


def annotations_of(one: Part[..., Any]) -> Iterator[tuple[str, str]]:
    for name, parameter in inspect.signature(one.function).parameters.items():
        assert parameter.annotation is not inspect.Parameter.empty, name
        yield name, str(parameter.annotation)
    yield "return", str(inspect.signature(one.function).return_annotation)


def test_what_is_loose_is_seen() -> None:
    for text in ("Any", "dict[str, Any]", "Mapping", "dict", "xr.Dataset | object", "list"):
        assert LOOSE.search(text), text
    for text in ("dict[str, int]", "tuple[Body, ...]", "Manya", "Mapping[str, float]"):
        assert not LOOSE.search(text), text


@pytest.mark.parametrize("name", PARTS)
def test_what_a_part_takes_and_gives_is_typed(name: str) -> None:
    for parameter, annotation in annotations_of(PARTS[name]):
        assert not LOOSE.search(annotation), (parameter, annotation)


@pytest.mark.parametrize("question", QUESTIONS.values(), ids=QUESTIONS)
def test_what_a_question_takes_is_typed(question: type[Question]) -> None:
    annotated = {
        name: str(annotation)
        for cls in question.__mro__
        for name, annotation in vars(cls).get("__annotations__", {}).items()
    }
    for name in keys_of(question):
        assert not LOOSE.search(annotated[name]), (name, annotated[name])


@pytest.mark.parametrize("name", PARTS)
def test_a_part_says_what_it_does(name: str) -> None:
    one = PARTS[name]
    assert one.does
    assert (one.__doc__ or "").split("\n")[0].endswith(".")
    assert "\n" not in one.does


@pytest.mark.parametrize("question", QUESTIONS.values(), ids=QUESTIONS)
def test_a_part_and_a_key_never_share_a_name(question: type[Question]) -> None:
    assert not set(question.graph.parts) & {*keys_of(question), BLOCK}
    assert [name for name, one in question.graph.parts.items() if one.name != name] == []


# --- what define_parts refuses --------------------------------------------------------------------


class Asked(Question, word="asked", call="asked"):
    """A question of the tests."""

    size: int = key(1, doc="a number")


@part
def answer(size: int) -> int:
    """Give it back."""
    return size


@part
def neglected() -> Neglected:
    """Nothing."""
    return Neglected()


def test_a_question_that_fits_together_is_taken() -> None:
    define_parts(Asked, answer=answer, sections={"neglected": neglected})
    assert set(Asked.graph.parts) == {"answer", "neglected"}
    assert Asked.graph.sections == {"neglected": ("neglected",)}


def test_a_part_with_the_name_of_a_key_is_refused() -> None:
    @part
    def size() -> int:
        """Clash."""
        return 1

    with pytest.raises(TypeError, match="share a name"):
        define_parts(Asked, answer=answer, sections={"neglected": neglected}, parts=[size])


def test_two_parts_of_one_name_are_refused() -> None:
    def other(size: int) -> int:
        """Another."""
        return -size

    other.__name__ = "answer"
    with pytest.raises(TypeError, match="share a name"):
        define_parts(Asked, answer=answer, sections={"neglected": neglected}, parts=[part(other)])


def test_a_parameter_that_is_neither_key_nor_part_is_refused() -> None:
    @part
    def lost(size: int, colour: str) -> int:
        """Ask for what there is not."""
        return size

    @part
    def hopeful(size: int, colour: str | None = None) -> int:
        """Ask for it if it is there."""
        return size

    for one in (lost, hopeful):
        with pytest.raises(TypeError, match=f"Asked: {one.name} takes 'colour'"):
            define_parts(Asked, answer=one, sections={"neglected": neglected})


def test_a_question_says_what_it_neglects() -> None:
    with pytest.raises(TypeError, match="Asked has no part"):
        define_parts(Asked, answer=answer, sections={})


@pytest.mark.parametrize("question", QUESTIONS.values(), ids=QUESTIONS)
def test_every_question_has_a_section_of_what_it_neglects(question: type[Question]) -> None:
    (name,) = question.graph.sections["neglected"]
    one = question.graph.parts[name]
    assert str(inspect.signature(one.function).return_annotation) == "Neglected"

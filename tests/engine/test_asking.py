"""Public calls and keys: one class says all, and a key that it does not have is refused."""

import inspect
from pathlib import Path
from typing import Any

import pytest
import tomli_w

import earthspin
from earthspin import SceneError, load_scene
from earthspin.engine.question import Question, describe_keys, keys_of
from earthspin.scenes import QUESTIONS
from tests import shipped

KEYS = [key for question in QUESTIONS.values() for key in keys_of(question).values()]
#: Every key at the head of a scene, every setting and every table that some question has.
HEADS = {key.name for key in KEYS if not key.setting}
SETTINGS = {key.name for key in KEYS if key.setting}
TABLES = sorted({question.table for question in QUESTIONS.values() if question.table})

each_question = pytest.mark.parametrize("question", QUESTIONS.values(), ids=QUESTIONS)


@each_question
def test_a_key_of_another_question_is_refused_however_it_is_given(
    question: type[Question], tmp_path: Path
) -> None:
    """In a file, with changes, in a class, in a call."""
    keys = shipped.table(question.word)
    full = {"compute": question.word} | keys
    name = min(HEADS - set(keys_of(question)))
    settings = keys.get(question.table or "", {}) | {name: 1}
    path, wrong = tmp_path / "scene.toml", tmp_path / "wrong.toml"
    path.write_text(tomli_w.dumps(full))
    wrong.write_text(tomli_w.dumps({name: 1} | full))
    for ask in (
        lambda: load_scene(wrong),
        lambda: load_scene(path, {name: 1}),
        lambda: earthspin.Scene(**{name: 1}, **full),
        lambda: load_scene(path).replace(**{name: 1}),
        lambda: question(**settings),
    ):
        words = f"{name} = 1: compute = '{question.word}' has no such key"
        with pytest.raises(SceneError, match=words) as error:
            ask()
        assert name in error.value.key
    with pytest.raises(TypeError, match=f"{question.call}.*'{name}'"):
        getattr(earthspin, question.call)(**settings)


@each_question
def test_keys_of_other_questions_are_refused(question: type[Question]) -> None:
    """At the head of a scene, and in its table."""
    full = shipped.table(question.word)
    for name in sorted(HEADS | SETTINGS):
        key = keys_of(question).get(name)
        if key is None or key.setting:
            words = "has no such key" if key is None else "it belongs in the table"
            with pytest.raises(SceneError, match=words):
                question.from_table(full | {name: 1})
        if question.table and (key is None or not key.setting):
            with pytest.raises(SceneError, match="allowed: ") as error:
                question.from_table({question.table: full.get(question.table, {}) | {name: 1}})
            assert error.value.key == f"{question.table}.{name}"


@each_question
def test_a_table_of_another_question_is_refused(question: type[Question]) -> None:
    for table in TABLES:
        words = f"it is a table: \\[{table}\\]" if table == question.table else "has no such key"
        with pytest.raises(SceneError, match=words):
            question.from_table(shipped.table(question.word) | {table: 3})


# --- what a call says of itself ----------------------------------------------------------------


def arguments(question: type[Question]) -> set[str]:
    """What a call takes: its keys, the span of a series as two."""
    names = set(keys_of(question)) - {"title"}
    return names - {"span"} | {"start", "stop"} if "start" in question.positional else names


@each_question
def test_the_signature_names_every_key(question: type[Question]) -> None:
    function = getattr(earthspin, question.call)
    parameters = inspect.signature(function).parameters
    assert set(parameters) == arguments(question)
    assert tuple(parameters)[: len(question.positional)] == question.positional
    for name, parameter in parameters.items():
        free = name in question.positional
        assert parameter.kind is (
            parameter.POSITIONAL_OR_KEYWORD if free else parameter.KEYWORD_ONLY
        )
        key = keys_of(question).get(name)
        required = key is not None and key.required
        assert (parameter.default is parameter.empty) == required
    assert function.__name__ == question.call


@each_question
def test_the_docstring_describes_every_key(question: type[Question]) -> None:
    doc = inspect.getdoc(getattr(earthspin, question.call)) or ""
    head, rest = doc.split("Parameters\n----------\n")
    assert head.strip()
    listed, _ = rest.split("\nReturns\n-------\n")
    for name in arguments(question):
        assert f"\n{name} : " in f"\n{listed}", name
    words = " ".join(listed.split())
    for name, key in keys_of(question).items():
        if name in inspect.signature(getattr(earthspin, question.call)).parameters:
            assert key.doc[1:] in words, name
    for heading in ("Raises", "Examples"):
        assert f"\n{heading}\n" in doc


@each_question
def test_the_list_of_keys_is_whole(question: type[Question]) -> None:
    text = describe_keys(question)
    head, _, table = text.partition(f"[{question.table}]") if question.table else (text, "", "")
    for name, key in keys_of(question).items():
        assert f"\n{name}: " in f"\n{table if key.setting else head}", name
    assert all(len(line) <= 100 for line in text.splitlines() if line.startswith(" "))


def test_a_call_without_what_must_be_given_is_refused() -> None:
    with pytest.raises(TypeError, match=r"heavy_top\(\) missing .*'transverse_moment'"):
        earthspin.heavy_top([0.0, 1.0])
    with pytest.raises(TypeError, match=r"free_rotor\(\) missing .*'moments'"):
        earthspin.free_rotor()
    with pytest.raises(TypeError, match=r"spheroid_field\(\) missing .*'position'"):
        earthspin.spheroid_field()
    with pytest.raises(TypeError, match=r"precession\(\) too many positional"):
        earthspin.precession("earth")


@pytest.mark.parametrize("call", [earthspin.pole, earthspin.torque_series, earthspin.long_term])
def test_one_end_of_a_span_is_refused_by_its_name(call: Any) -> None:
    with pytest.raises(SceneError, match=r"stop = None: give both start and stop"):
        call("2000-01-01")
    with pytest.raises(SceneError, match=r"start = None: give both start and stop"):
        call(stop="2000-01-01")


def test_times_stand_in_place_of_span_and_step() -> None:
    for word, keys in {
        "torque": {"times": ["2000-01-01"], "step": "1 h"},
        "pole": {"times": ["2000-01-01"], "span": ["2000-01-01", "2001-01-01"]},
    }.items():
        with pytest.raises(SceneError, match="give either times, or span and step"):
            earthspin.Scene(compute=word, **keys)
    moments = {"moments": [1, 2, 2.5], "omega": [0.1, 1, 0.1]}
    with pytest.raises(SceneError, match="give either times, or duration and points"):
        earthspin.Scene(compute="free-rotor", rotor=moments | {"times": [1.0], "points": 3})

"""Public calls and keys: one class says all, and a key that it does not have is refused."""

import ast
import inspect
import pickle
from pathlib import Path
from typing import Any

import pytest
import tomli_w

import earthspin
from earthspin import ArgumentError, SceneError, load_scene
from earthspin.engine.public_calls import arguments_of
from earthspin.engine.question import Question, keys_of
from earthspin.scenes import QUESTIONS
from tests import shipped

#: Every key at the head of a scene that some question has.
HEADS = {
    key.name for each in QUESTIONS.values() for key in keys_of(each).values() if not key.setting
}


@pytest.mark.parametrize("question", QUESTIONS.values(), ids=QUESTIONS)
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


CALLS = {name: getattr(earthspin, name) for name in earthspin.__all__} | {
    name: getattr(earthspin.Body, name) for name in dir(earthspin.Body) if name.startswith("from_")
}
LACKING = [
    name
    for name, call in CALLS.items()
    if inspect.isroutine(call)
    and inspect.Parameter.empty in (p.default for p in inspect.signature(call).parameters.values())
]


@pytest.mark.parametrize("name", LACKING)
def test_a_call_without_what_must_be_given_is_answered_by_an_example(name: str) -> None:
    parameters = inspect.signature(CALLS[name]).parameters.values()
    needed = next(p.name for p in parameters if p.default is p.empty)
    with pytest.raises(ArgumentError, match=f"missing .*'{needed}'") as error:
        CALLS[name]()
    example = ast.parse(str(error.value).partition("; write ")[2])
    assert name in ast.dump(example)
    assert pickle.loads(pickle.dumps(CALLS[name])) == CALLS[name]


def test_a_class_method_is_answered_without_its_class() -> None:
    with pytest.raises(ArgumentError, match=r"write from_layers\('prem', spin_period='1 d'\)"):
        earthspin.Body.from_layers("prem", "1 d")


@pytest.mark.parametrize("question", QUESTIONS.values(), ids=QUESTIONS)
def test_a_call_in_another_spelling_is_answered_by_what_to_type(question: type[Question]) -> None:
    call, (*names,) = getattr(earthspin, question.call), arguments_of(question)
    places = ["x"] * len(question.positional)
    with pytest.raises(ArgumentError, match=rf"write {question.call}\(.*{names[len(places)]}='x'"):
        call(*places, "x")
    for name in filter(lambda name: len(name) > 2, names):
        swapped = name[:-2] + name[:-3:-1] if len(name) > 4 else name
        for near in sorted({f"{name}s", name[:-1], swapped, name.title()} - {*names}):
            with pytest.raises(ArgumentError, match=f"'{near}'; did you mean '{name}'"):
                call(**{near: 1})


@pytest.mark.parametrize("call", [earthspin.pole, earthspin.torque_series, earthspin.long_term])
def test_one_end_of_a_span_is_refused_by_its_name(call: Any) -> None:
    with pytest.raises(SceneError, match="stop = None"):
        call("2000-01-01")
    with pytest.raises(SceneError, match="start = None"):
        call(stop="2000-01-01")


def test_times_stand_in_place_of_span_and_step() -> None:
    for word, keys in {
        "torque": {"times": ["2000-01-01"], "step": "1 h"},
        "pole": {"times": ["2000-01-01"], "span": ["2000-01-01", "2001-01-01"]},
    }.items():
        with pytest.raises(SceneError, match="times, or span and step"):
            earthspin.Scene(compute=word, **keys)
    moments = {"moments": [1, 2, 2.5], "omega": [0.1, 1, 0.1]}
    with pytest.raises(SceneError, match="times, or duration and points"):
        earthspin.Scene(compute="free-rotor", rotor=moments | {"times": [1.0], "points": 3})

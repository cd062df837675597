"""Public calls and keys: one class says all, and a key that it does not have is refused."""

import inspect
from pathlib import Path
from typing import Any

import pytest
import tomli_w

import earthspin
from earthspin import EarthspinError, SceneError, load_scene
from earthspin.engine.question import Question, describe_keys, keys_of
from earthspin.scenes import QUESTIONS

#: A value of each key that some question takes, as a scene file holds it.
VALUES: dict[str, Any] = {
    "body": "earth",
    "perturbers": ["sun"],
    "source": "skyfield",
    "ephemeris": "de421",
    "span": ["2000-01-01", "2000-02-01"],
    "step": "1 d",
    "times": ["2000-01-01"],
    "accuracy": 1e-3,
    "equator": "mean",
    "effects": ["j3"],
    "response": "fitted",
    "anelastic_exponent": 0.2,
    "interior": "prem",
    "period": "1 d",
    "start_attitude": [1.0, 0.0, 0.0, 0.0],
    "start_omega": [0.0, 0.0, 1e-4],
    "torque": {"live": "friction"},
    "orbit": "own",
    "tides": 1.0,
    "ellipticity": 1.0,
    "obliquity_shift": "1 deg",
    "longitude_shift": "1 deg",
    "j2_rate": "0 1/s",
}
#: Every key at the head of a scene that some question has.
HEADS = {n for q in QUESTIONS.values() for n, one in keys_of(q).items() if not one.setting}
TABLES = {q.table for q in QUESTIONS.values() if q.table}
#: A scene of each question that runs as it is, if anything does.
FULL: dict[str, dict[str, Any]] = {
    "free-rotor": {
        "rotor": {
            "moments": ["1 kg m2", "2 kg m2", "2.5 kg m2"],
            "omega": ["0.1 rad/s", "1 rad/s", "0.1 rad/s"],
        }
    },
    "top": {
        "top": {
            **{"transverse_moment": "1 kg m2", "axial_moment": "1.2 kg m2"},
            **{"weight_moment": "1.5 N m", "theta": "40 deg", "spin": "3 rad/s"},
        }
    },
    "spheroid": {"spheroid": {"position": [["7e6 m", "0 m", "0 m"]]}},
    "cassini-states": {
        "body": {"from": "mars"},
        "orbit": {"period": "687 d", "i": "3 deg", "node_period": "-70 kyr"},
    },
}
FOREIGN = [
    (word, name) for word, q in QUESTIONS.items() for name in sorted(HEADS - set(keys_of(q)))
]
SETTINGS = [
    (word, name)
    for word, q in QUESTIONS.items()
    for name in sorted(
        {n for other in QUESTIONS.values() for n, one in keys_of(other).items() if one.setting}
        - set(keys_of(q))
    )
]


def test_every_head_has_a_value() -> None:
    assert HEADS - {"title", "members", "uncertainty", "n"} == set(VALUES)  # these have all
    assert len(FOREIGN) > 30


@pytest.mark.parametrize("word", QUESTIONS)
def test_the_scenes_of_this_test_are_whole(word: str) -> None:
    scene = QUESTIONS[word].from_table(FULL.get(word, {}))
    assert earthspin.plan(scene).parts


def refused(error: pytest.ExceptionInfo[EarthspinError], word: str, name: str) -> None:
    assert isinstance(error.value, SceneError)
    assert f"compute = '{word}' has no such key" in str(error.value)
    assert name in error.value.key
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(("word", "name"), FOREIGN)
def test_a_key_of_another_question_is_refused(word: str, name: str, tmp_path: Path) -> None:
    """In a file, with changes, in a class, in a call."""
    value, full = VALUES[name], {"compute": word} | FULL.get(word, {})
    path, wrong = tmp_path / "scene.toml", tmp_path / "wrong.toml"
    path.write_text(tomli_w.dumps(full))
    wrong.write_text(tomli_w.dumps({name: value} | full))
    with pytest.raises(EarthspinError) as error:
        load_scene(wrong)
    refused(error, word, name)
    assert str(error.value).startswith(f"{wrong}: {name} = ")
    with pytest.raises(EarthspinError) as error:
        load_scene(path, {name: value})
    refused(error, word, name)
    with pytest.raises(EarthspinError) as error:
        earthspin.Scene(**{name: value}, **full)
    refused(error, word, name)
    with pytest.raises(EarthspinError) as error:
        load_scene(path).replace(**{name: value})
    refused(error, word, name)
    given = full.get(QUESTIONS[word].table or "-", {}) | {name: value}
    with pytest.raises(EarthspinError) as error:
        QUESTIONS[word](**given)
    refused(error, word, name)
    with pytest.raises(TypeError, match=f"{QUESTIONS[word].call}.*'{name}'"):
        getattr(earthspin, QUESTIONS[word].call)(**given)


@pytest.mark.parametrize("word", QUESTIONS)
@pytest.mark.parametrize("table", sorted(TABLES))
def test_a_table_of_another_question_is_refused(word: str, table: str) -> None:
    question = QUESTIONS[word]
    if table == question.table:
        with pytest.raises(SceneError, match=f"it is a table: \\[{table}\\]"):
            question.from_table({table: 3})
        with pytest.raises(SceneError, match="allowed: ") as error:
            question.from_table({table: {"colour": "blue"}})
        assert error.value.key == f"{table}.colour"
    else:
        with pytest.raises(SceneError, match="has no such key"):
            question.from_table({table: {}} | FULL.get(word, {}))


@pytest.mark.parametrize(("word", "name"), SETTINGS)
def test_a_setting_of_another_question_is_refused(word: str, name: str) -> None:
    question = QUESTIONS[word]
    full = FULL.get(word, {})
    with pytest.raises(SceneError, match="has no such key"):
        question.from_table(full | {name: 1})
    if question.table:
        with pytest.raises(SceneError, match="allowed: ") as error:
            question.from_table({question.table: full.get(question.table, {}) | {name: 1}})
        assert error.value.key == f"{question.table}.{name}"


@pytest.mark.parametrize("question", QUESTIONS.values(), ids=QUESTIONS)
def test_a_setting_stands_in_its_table_and_nothing_else(question: type[Question]) -> None:
    full = FULL.get(question.word, {})
    for name, one in keys_of(question).items():
        if one.setting:
            with pytest.raises(SceneError, match="it belongs in the table"):
                question.from_table(full | {name: 1})
        elif question.table:
            table = full.get(question.table, {}) | {name: 1}
            with pytest.raises(SceneError, match="allowed: "):
                question.from_table({question.table: table})


# --- what a call says of itself ----------------------------------------------------------------

CALLS = {q.call: q for q in QUESTIONS.values()}


def arguments(question: type[Question]) -> set[str]:
    """What a call takes: its keys, the span of a series as two."""
    names = set(keys_of(question)) - {"title"}
    return names - {"span"} | {"start", "stop"} if "start" in question.positional else names


@pytest.mark.parametrize("call", CALLS)
def test_the_signature_names_every_key(call: str) -> None:
    question, function = CALLS[call], getattr(earthspin, call)
    parameters = inspect.signature(function).parameters
    assert set(parameters) == arguments(question)
    assert tuple(parameters)[: len(question.positional)] == question.positional
    for name, parameter in parameters.items():
        free = name in question.positional
        assert parameter.kind is (
            parameter.POSITIONAL_OR_KEYWORD if free else parameter.KEYWORD_ONLY
        )
        one = keys_of(question).get(name)
        required = one is not None and one.required
        assert (parameter.default is parameter.empty) == required
    assert function.__name__ == call


@pytest.mark.parametrize("call", CALLS)
def test_the_docstring_describes_every_key(call: str) -> None:
    question, doc = CALLS[call], inspect.getdoc(getattr(earthspin, call)) or ""
    head, rest = doc.split("Parameters\n----------\n")
    assert head.strip()
    listed, _ = rest.split("\nReturns\n-------\n")
    for name in arguments(question):
        assert f"\n{name} : " in f"\n{listed}", name
    words = " ".join(listed.split())
    for name, one in keys_of(question).items():
        if name in inspect.signature(getattr(earthspin, call)).parameters:
            assert one.doc[1:] in words, name
    for heading in ("Raises", "Examples"):
        assert f"\n{heading}\n" in doc


@pytest.mark.parametrize("question", QUESTIONS.values(), ids=QUESTIONS)
def test_the_list_of_keys_is_whole(question: type[Question]) -> None:
    text = describe_keys(question)
    head, _, table = text.partition(f"[{question.table}]") if question.table else (text, "", "")
    for name, one in keys_of(question).items():
        assert f"\n{name}: " in f"\n{table if one.setting else head}", name
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

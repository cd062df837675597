"""Scenes: what is read, and one clear line for whatever is wrong."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin import EARTH, MOON, EarthspinError, Scene, SceneError, load_scene
from earthspin.engine.question import Question, scene_text
from earthspin.scenes import question_named, shipped_scenes, typed_scene


def read(table: dict[str, Any]) -> Question:
    """A scene as a file has it."""
    keys = dict(table)
    return question_named(keys.pop("compute", None), "my.toml").from_table(keys, source="my.toml")


#: A year, whose ends are 366 days.
SPAN = ["2015-01-01", "2016-01-01"]
WRONG = [
    ({}, "compute"),
    ({"compute": "precesion"}, "did you mean 'precession'"),
    ({"compute": 3}, "compute"),
    ({"compute": "torque", "perturber": ["sun"]}, "did you mean 'perturbers'"),
    ({"compute": "torque", "perturbers": ["sun", "mon"]}, "did you mean 'moon'"),
    ({"compute": "torque", "perturbers": ["sun", "sun"]}, "twice"),
    ({"compute": "torque", "perturbers": ["earth"]}, "does not pull on itself"),
    ({"compute": "torque", "equator": "men"}, "did you mean 'mean'"),
    ({"compute": "torque", "span": ["2001-01-01", "2000-01-01"]}, "ends before it starts"),
    ({"compute": "torque", "span": "2001"}, "two dates"),
    ({"compute": "torque", "step": "0 h"}, "1 microsecond"),
    ({"compute": "torque", "step": "6 kg"}, "6 kg"),
    ({"compute": "precession", "accuracy": 1e-6}, "no such key: delete"),
    ({"compute": "rotation", "tolerance": "fine"}, "tolerance"),
    ({"compute": "rotation", "tolerance": 1e-14}, "tolerance"),
    ({"compute": "pole", "effects": ["plants"]}, "did you mean 'planets'"),
    ({"compute": "precession", "effects": ["planets"]}, "no such key"),
    ({"compute": "torque", "body": {"mass": "-1 kg"}}, "mass must be zero or more"),
    ({"compute": "torque", "body": {"mas": "6 kg"}}, "did you mean 'mass'"),
    ({"compute": "torque", "body": {"moments": ["1 kg m2", "1 kg m2", "3 kg m2"]}}, "C cannot"),
    ({"compute": "torque", "body": {"name": "mine", "spin_period": "9 h"}}, "from = 'nothing'"),
    ({"compute": "torque", "perturbers": [{"name": "star"}]}, "from = 'nothing'"),
    ({"compute": "torque", "body": {"from": "nothing", "name": "a"}}, "spin_period, pole"),
    ({"compute": "torque", "body": {"from": ""}}, "body.from = ''"),
    ({"compute": "free-rotor", "rotor": 3}, "it is a table"),
    ({"compute": "torque", "rotor": {}}, "no such key"),
    (
        {"compute": "free-rotor", "omega": [1], "rotor": {"omega": [1]}},
        "omega = [1]: it is given twice",
    ),
    ({"compute": "polar-motion", "polar_motion": {"flie": "c04"}}, "did you mean 'file'"),
]


@pytest.mark.parametrize(("table", "words"), WRONG, ids=[w for _, w in WRONG])
def test_what_is_wrong_is_one_line(table: dict, words: str) -> None:
    with pytest.raises(EarthspinError) as error:
        read(table)
    text = str(error.value)
    assert words in text
    assert "\n" not in text
    assert text.startswith("my.toml: ")


@pytest.mark.parametrize(
    "changes",
    [
        {"file": "finals", "span": SPAN},
        {"polar_motion.file": "finals", "polar_motion.span": SPAN},
        {"polar_motion": {"file": "finals", "span": SPAN}},
    ],
)
def test_a_key_is_found_wherever_it_is_typed(changes: dict[str, Any]) -> None:
    question = load_scene("polar-motion", changes)
    assert question.file == "finals"
    assert np.allclose(
        question.span.days, [5478.5, 5843.5], rtol=1e-12, atol=0
    )  # from J2000.0, 12h
    assert load_scene("forecast", {"forecast.file": "finals"}).file == "finals"
    assert load_scene("top-cusp", {"times": ["0 s", "1 s"]}).times.tolist() == [0, 1]


def test_a_span_of_observations_is_two_words() -> None:
    seen = earthspin.polar_motion(*SPAN, file="finals")
    assert seen.identical(earthspin.polar_motion(span=SPAN, file="finals"))
    assert seen.time.size == 366
    assert earthspin.pole_offsets(*SPAN).time.size == 366
    with pytest.raises(SceneError, match="either start and stop, or span"):
        earthspin.polar_motion(*SPAN, span=SPAN)
    with pytest.raises(SceneError, match="both start and stop, or file"):
        earthspin.polar_motion("eopc01.txt")


def test_words_for_effects_stand_beside_names() -> None:
    known = load_scene("pole", {"effects": "known"}).effects
    assert load_scene("pole", {"effects": ["rigid", "nonrigid"]}).effects == known
    assert load_scene("pole", {"effects": ["j3", "known"]}).effects[0] == "j3"


@pytest.mark.parametrize(
    ("year", "words"), [("1800", "ephemeris='de440'"), ("1200", "earthspin.long_term")]
)
def test_a_date_without_positions_names_what_covers_it(year: str, words: str) -> None:
    with pytest.raises(earthspin.CoverageError, match=words):
        earthspin.torque_series(f"{year}-01-01", f"{year}-02-01", "1 d")


def test_files(tmp_path: Path) -> None:
    good, bad, binary = (tmp_path / f"{n}.toml" for n in ("good", "bad", "binary"))
    good.write_text('compute = "torque"\nstep = "1 h"\n')
    bad.write_text("compute = torque\n")
    binary.write_bytes(b"\xff\xfe\x00")
    assert load_scene(good).step == 3600.0
    assert load_scene(good).title == "good"
    assert load_scene(good, {"body": "mars"}).title == "good"
    for path, words in (
        (bad, "not TOML"),
        (binary, "cannot be read"),
        (tmp_path, "cannot be read"),
    ):
        with pytest.raises(SceneError, match=words) as error:
            load_scene(path)
        assert str(path) in str(error.value)
    with pytest.raises(SceneError, match="no such file"):
        load_scene(tmp_path / "none.toml")
    with pytest.raises(SceneError, match="did you mean 'torque'"):
        load_scene("torqe")


def test_changes_reach_into_tables() -> None:
    scene = load_scene("torque", {"step": "1 h", "body.j2": 2e-3, "perturbers": "sun"})
    assert scene.step == 3600.0
    assert scene.body.j2 == 2e-3
    assert [p.name for p in scene.perturbers] == ["sun"]
    with pytest.raises(SceneError, match="not a table"):
        load_scene("torque", {"step.size": 1})


def test_a_key_replaces_the_keys_that_it_excludes() -> None:
    times = ["2020-01-01", "2021-01-01"]
    question = load_scene("pole", {"times": times})
    assert question.given == {"title", "times"}
    again = load_scene(question, {"span": times, "step": "1 d"})
    assert again.given == {"title", "span", "step"}
    with pytest.raises(SceneError, match="times, or span and step"):
        load_scene("pole", {"times": times, "step": "1 d"})


def test_a_scene_in_python_takes_bodies_and_words() -> None:
    scene = Scene(compute="torque", body=EARTH, perturbers=["sun", MOON])
    assert scene.perturbers[1] is MOON
    assert scene.replace(step="1 h").perturbers == scene.perturbers


@pytest.mark.parametrize(
    "change",
    [
        {"step": "1" * 1_000_000 + "x"},
        {"step": "1 h" + "/h" * 1_000_000},
        {"a." * 1_000_000 + "a": 1},
        {"body." * 1_000 + "j2": 1},
    ],
    ids=["digits", "slashes", "dots", "deep"],
)
def test_long_texts_are_refused_before_they_are_parsed(change: dict[str, Any]) -> None:
    """The parsers of numbers, units and keys would take hours."""
    with pytest.raises(EarthspinError):
        load_scene("torque", change)


def test_a_file_with_a_key_of_many_parts_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "deep.toml"
    for text in ("a." * 1_000_000 + "a = 1", "body = {" + "a." * 1_000_000 + "a = 1}"):
        path.write_text(f'compute = "torque"\n{text}\n')
        with pytest.raises(SceneError, match="parts"):
            load_scene(path)


@pytest.mark.parametrize(
    ("scene", "key", "bare", "unit"),
    [
        ("precession", "body.spin_period", 43200.0, "s"),
        ("precession", "body.spin_period", 43200, "s"),
        ("precession", "body.radius", 6.4e6, "m"),
        ("top-wave", "duration", 2.0, "s"),
        ("rotation", "start_omega", [0.0, 0.0, 7e-5], "rad/s"),
    ],
)
def test_numbers_that_are_typed_carry_units(
    scene: str, key: str, bare: Any, unit: str, tmp_path: Path
) -> None:
    """In files and with --set; in Python plain numbers are in SI units."""
    path, word = tmp_path / "scene.toml", load_scene(scene).word
    name = f"top.{key}" if word == "top" else key
    in_python = load_scene(scene, {name: bare}).to_table()
    with_unit = [f"{one} {unit}" for one in bare] if isinstance(bare, list) else f"{bare} {unit}"
    assert typed_scene(scene, {name: with_unit}).to_table() == in_python
    path.write_text(f'compute = "{word}"\n{name} = {bare!r}\n')
    for typed in (lambda: typed_scene(scene, {name: bare}), lambda: load_scene(path)):
        with pytest.raises(SceneError, match="unit, like"):
            typed()


@pytest.mark.parametrize("scene", shipped_scenes())
def test_the_complete_scene_of_an_answer_is_read_from_a_file(scene: str, tmp_path: Path) -> None:
    """It carries units, so that a person may store it and change it."""
    question = load_scene(scene)
    path = tmp_path / "complete.toml"
    path.write_text(scene_text(question))
    assert load_scene(path).to_table() == question.to_table()


def test_arrays_of_a_scene_keep_their_places(tmp_path: Path) -> None:
    """Although they begin alike, and a title may look like the mark of an array."""
    many = {
        name: xr.DataArray(np.r_[[value] * 40, 2 * value], dims="case")
        for name, value in (("j2", 1e-3), ("j3", -2e-6), ("j4", 1e-3))
    }
    question = load_scene("precession", {"body": EARTH.replace(**many)})
    question = replace(question, title=f"packed array {0:050}")
    path = tmp_path / "complete.toml"
    path.write_text(scene_text(question))
    again = load_scene(path)
    assert again.title == question.title
    for name, values in many.items():
        assert getattr(again.body, name).equals(values)


def test_an_element_of_an_orbit_that_is_typed_carries_its_unit(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    text = 'compute = "precession"\nperturbers = [{ from = "moon", orbit = { a = %s } }]\n'
    path.write_text(text % '"3.84e8 m"')
    load_scene(path)
    path.write_text(text % "3.84e8")
    with pytest.raises(SceneError, match="give it with its unit"):
        load_scene(path)


@pytest.mark.parametrize(
    "changes",
    [
        {"body.j2": 1e-3, "body": {"j2": 1.1e-3}},
        {"body": {"j2": 1.1e-3}, "body.j2": 1e-3},
        {"body.j2": 1e-3, "body": "mars"},
        {"body.j2": 1e-3, "body": {"from": "mars"}},
    ],
)
def test_a_number_in_two_spellings_is_refused(changes: dict) -> None:
    with pytest.raises(SceneError, match=r"body\.j2 = .*it is given twice"):
        load_scene("precession", changes)


@pytest.mark.parametrize("mars", ["mars", {"from": "mars"}])
def test_a_table_before_a_number_in_it_is_a_start(mars: object) -> None:
    question = load_scene("precession", {"body": mars, "body.j2": 1.9e-3})
    assert (question.body.name, question.body.j2) == ("mars", 1.9e-3)


@pytest.mark.parametrize(
    ("scene", "changes", "title"),
    [
        ("precession", {"body": "mars"}, "Precession of Mars"),
        ("precession", {"body": "mars", "title": "own"}, "own"),
        ("precession", {"body.spin_period": "12 h"}, "Precession of the equinoxes"),
        ("rotation", {"body": "mars"}, "Mars turns"),
        ("cassini-states", {"body": "titan"}, "Cassini states of Titan"),
        ("cassini-states", {"body": "moon"}, "Cassini states of the Moon"),
    ],
)
def test_the_title_of_a_shipped_scene_names_the_body(scene: str, changes: dict, title: str) -> None:
    assert load_scene(scene, changes).title == title

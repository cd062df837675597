"""Plans: the order of the parts, and what is left out and why."""

import pytest

import earthspin
from earthspin import MARS, Scene, SceneError, load_scene
from earthspin.scene import planning
from earthspin.scene.parts import PARTS
from earthspin.scene.questions import QUESTIONS


@pytest.mark.parametrize("word", QUESTIONS)
def test_parts_run_after_what_they_need(word: str) -> None:
    plan = earthspin.plan(Scene(compute=word))
    seen: set[str] = set()
    for part in plan.parts:
        assert set(part.needs) <= seen
        seen.add(part.name)
    assert seen | set(plan.left_out) == set(PARTS)
    assert not seen & set(plan.left_out)


def test_every_part_is_wanted_or_needed_by_some_question() -> None:
    used = set().union(*(q.wants for q in QUESTIONS.values()))
    used |= set().union(*(p.needs + p.uses for p in PARTS.values()))
    assert used == set(PARTS)


def test_every_function_is_there() -> None:
    from importlib import import_module

    for part in PARTS.values():
        module, function = part.function.split(":")
        assert callable(getattr(import_module(module), function)), part.name


def test_reasons() -> None:
    plan = earthspin.plan(load_scene("sun-only"))
    assert plan.left_out["standstills"] == "the moon is not among the perturbers"
    assert "torque-series" in plan.left_out
    plan = earthspin.plan(Scene(compute="precession", body=MARS, perturbers=["sun"]))
    assert "mars" in plan.left_out["iau-2006"]
    plan = earthspin.plan(load_scene("torque"))
    assert plan.left_out["nutation"] == "the equator is the mean one"
    plan = earthspin.plan(load_scene("torque", {"equator": "true"}))
    assert "nutation" not in plan.left_out


def test_a_wobble_needs_no_kernel() -> None:
    plan = earthspin.plan(load_scene("wobble"))
    assert [p.name for p in plan.parts] == [
        "wobble-ladder",
        "interior-response",
        "wobble-sensitivity",
        "observed-wobble",
    ]


def test_the_words_of_a_plan() -> None:
    text = str(earthspin.plan(load_scene("sun-only")))
    assert "left out" in text
    assert "the moon is not among the perturbers" in text


def test_a_part_is_left_out_with_what_it_needs(monkeypatch: pytest.MonkeyPatch) -> None:
    from dataclasses import replace

    closed = replace(PARTS["ephemeris"], left_out=lambda scene: "no kernel today")
    monkeypatch.setitem(planning.PARTS, "ephemeris", closed)
    plan = earthspin.plan(load_scene("precession"))
    assert "no kernel today" in plan.left_out["mean-rates"]
    with pytest.raises(SceneError, match="no kernel today"):
        earthspin.plan(load_scene("torque"))

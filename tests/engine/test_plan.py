"""Plans: the order of the parts, and what is left out and why."""

import copy
import pickle
from dataclasses import replace
from inspect import signature

import pytest

import earthspin
from earthspin import Scene, SceneError, load_scene
from earthspin.engine.question import BLOCK, Part, Question, keys_of
from earthspin.engine.run import Run
from earthspin.scenes import QUESTIONS, shipped_scenes


@pytest.mark.parametrize("scene", shipped_scenes())
def test_a_plan_names_every_part_once_and_can_be_pickled(scene: str) -> None:
    plan = earthspin.plan(scene, "all")
    titles = {part.title for part in plan.question.graph.parts.values()}
    assert sorted([*(part.title for part in plan.parts), *plan.left_out]) == sorted(titles)
    for same in (pickle.loads(pickle.dumps(plan)), copy.deepcopy(plan)):
        assert same.parts == plan.parts
        assert str(same) == str(plan)
        assert same.question.to_table() == plan.question.to_table()


@pytest.mark.parametrize("question", QUESTIONS.values(), ids=QUESTIONS)
def test_every_key_is_used_by_some_part(question: type[Question]) -> None:
    """A key that nothing takes would do nothing and say nothing."""
    parts = question.graph.parts.values()
    used = {name for part in parts for name in (*part.needs, *part.uses)}
    used |= {name for part in parts for why in part.unless for name in signature(why).parameters}
    of_the_engine = {"title", "members"}
    assert set(keys_of(question)) - used == of_the_engine
    graph = question.graph
    assert used <= {*keys_of(question), *graph.parts, BLOCK}


def test_a_part_is_left_out_with_what_it_needs(monkeypatch: pytest.MonkeyPatch) -> None:
    """And runs without what it uses if that is there."""
    for word, name in (("torque", "sky"), ("wobble", "inputs")):
        graph = QUESTIONS[word].graph
        closed = Part(graph.parts[name].function, (lambda: "no kernel today",))
        changed = replace(graph, parts=graph.parts | {name: closed})
        monkeypatch.setattr(QUESTIONS[word], "graph", changed)
    with pytest.raises(SceneError, match=r"nothing to do: .*no kernel today"):
        earthspin.plan("torque")
    plan = earthspin.plan("wobble", "all")
    assert "wobble_rungs" in [part.name for part in plan.parts]
    reason = "it needs inputs, which is left out: no kernel today"
    assert plan.left_out["sensitivity"] == reason


def test_a_dimension_of_results_is_not_one_of_bodies() -> None:
    import xarray as xr

    h = xr.DataArray([0.003, 0.0033], dims="time")
    body = earthspin.EARTH.replace(dynamical_flattening=h)
    with pytest.raises(SceneError, match="already") as error:
        earthspin.plan(Scene(compute="torque", body=body))
    assert error.value.key == "body.dynamical_flattening"


def test_a_changed_question_gets_no_result_of_another_path(monkeypatch: pytest.MonkeyPatch) -> None:
    """The key `response` of the pole leaves out parts that take no key themselves."""
    calls: list[str] = []

    def watched(run: Run, name: str) -> object:
        if name not in run.values:
            calls.append(name)
        return original(run, name)

    original = Run.__getitem__
    monkeypatch.setattr(Run, "__getitem__", watched)
    keys = {"span": ["2000-01-01", "2001-01-01"], "step": "30 d", "effects": ["nonrigid"]}
    fitted = load_scene("pole", keys | {"response": "fitted"})
    predicted = fitted.replace(response="predicted")
    run, other = Run(fitted), Run(predicted).numbers()
    run.answer()
    calls.clear()
    again = run.again(predicted)
    assert again.numbers().identical(other)
    assert "axis_path" in calls
    assert "sky" not in calls
    calls.clear()
    assert run.again(fitted).numbers().identical(run.numbers())
    assert calls == []

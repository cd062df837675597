"""Sections: each alone, none by the way, and no trap of DataTree."""

from collections.abc import Iterator

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import earthspin
from earthspin import SceneError, load_scene
from earthspin.scenes import QUESTIONS, shipped_scenes
from tests import shipped

#: Scenes that are asked for section by section; one that has all of each question.
SCENES = shipped.SCENES | {"free-rotor": "poinsot", "top": "top-loop"}
NAMES = {word: set(question.graph.sections) for word, question in QUESTIONS.items()}


#: Questions whose answers take seconds.
LONG = ("iau", "nutation", "rotation")


@pytest.mark.parametrize("word", QUESTIONS)
def test_a_tree_holds_the_answer_its_sections_and_its_plan(word: str) -> None:
    tree = shipped.tree(SCENES[word])
    xr.testing.assert_identical(tree.to_dataset(), shipped.answer(SCENES[word]))
    assert set(tree.children) == NAMES[word] | {"plan"}
    plan = tree["plan"].to_dataset(inherit=False)
    times = {"wall_time", "computation_time"}
    assert set(plan.data_vars) == {"status", "reason", "run_time", *times}
    titles = [part.title for part in QUESTIONS[word].graph.parts.values()]
    assert sorted(plan.part.values) == sorted(titles)
    assert set(plan.status.values) <= {"ran", "reused", "left out"}
    assert plan.run_time.attrs["units"] == "s"


EACH = [(word, section) for word, names in NAMES.items() for section in sorted(names)]


@pytest.mark.parametrize(
    ("word", "section"),
    [pytest.param(*pair, marks=pytest.mark.slow if pair[0] in LONG else ()) for pair in EACH],
)
def test_a_section_alone_is_the_same(word: str, section: str) -> None:
    tree = earthspin.run_tree(SCENES[word], section)
    assert set(tree.children) == {section, "plan"}
    whole = shipped.tree(SCENES[word])
    xr.testing.assert_identical(tree[section].to_dataset(), whole[section].to_dataset())
    ran = tree["plan"].status.isin(["ran", "reused"])
    titles = {part.title for part in earthspin.plan(SCENES[word], section).parts}
    assert set(tree["plan"].part.values[ran]) == titles
    assert np.all(tree["plan"].run_time.values[ran] > 0)
    assert not tree["plan"].run_time.values[~ran].any()
    assert np.all(tree["plan"].reason != "")


def test_several_sections_may_be_named() -> None:
    tree = earthspin.run_tree("wobble", ["observed", "sensitivity", "observed"])
    assert set(tree.children) == {"observed", "sensitivity", "plan"}
    assert set(earthspin.run_tree("wobble", []).children) == {"plan"}


@pytest.mark.parametrize(
    ("sections", "words"),
    [
        ("standstils", "did you mean 'standstills'"),
        (["seasons", "standstils"], "did you mean 'standstills'"),
        ("plan", "allowed: all, convergence"),
        ("chandler", "allowed: all, convergence"),
    ],
)
def test_an_unknown_section_is_refused(sections: str | list[str], words: str) -> None:
    for ask in (earthspin.run_tree, earthspin.plan):
        with pytest.raises(SceneError, match=words) as error:
            ask("precession", sections)
        assert error.value.key == "sections"


def test_sections_may_be_any_sequence_of_names() -> None:
    one = earthspin.plan("precession", ["seasons"])
    for sections in (np.array(["seasons"]), pd.Series(["seasons"]), iter(["seasons"])):
        assert earthspin.plan("precession", sections).sections == one.sections == ("seasons",)


POLE = ["10 deg", "60 deg"]
NOT_HERE = [
    ("sun-only", {}, "standstills", "the moon is not among the perturbers"),
    ("sun-only", {}, "seasons", "the moon is not among the perturbers"),
    ("precession", {"body.spin_period": "12 h"}, "iau_2006", "a modified Earth"),
    ("precession", {"body": "mars", "perturbers": "sun"}, "iau_2006", "no precession model"),
    ("precession", {"body.naif": [], "body.pole": POLE}, "iau_2006", "real Earth only"),
    ("precession", {"body.j2": 0.0, "body.dynamical_flattening": 0.0}, "free_wobble", "sphere"),
    ("wobble", {"body.interior": "none"}, "sensitivity", "no interior of the Earth is known"),
    ("poinsot", {"rotor.omega": [["1 rad/s"] * 3] * 2}, "poinsot", "there are several starts"),
]


@pytest.mark.parametrize(("scene", "changes", "section", "reason"), NOT_HERE)
def test_a_section_that_does_not_apply(
    scene: str, changes: dict[str, object], section: str, reason: str
) -> None:
    """Refused with the reason where it is named, left out where all are asked for."""
    question = load_scene(scene, changes)
    with pytest.raises(SceneError, match=reason) as error:
        earthspin.run_tree(question, section)
    assert (error.value.key, error.value.given) == ("sections", section)
    assert "it does not apply" in str(error.value)
    every = earthspin.plan(question, "all")
    assert section not in every.sections
    assert any(reason in why for why in every.left_out.values())


def sections_of(tree: xr.DataTree) -> Iterator[tuple[str, xr.Dataset]]:
    for name, node in tree.children.items():
        yield name, node.to_dataset(inherit=False)


@pytest.mark.parametrize("scene", shipped_scenes())
def test_no_section_repeats_a_name_of_the_root_or_of_another(scene: str) -> None:
    tree = shipped.tree(scene)
    root = tree.to_dataset()
    names = [str(name) for _, node in sections_of(tree) for name in node.data_vars]
    assert len(set(names)) == len(names)
    for section, node in sections_of(tree):
        assert not set(node.data_vars) & set(root.variables), section
        for dim, size in node.sizes.items():
            if dim in root.sizes:  # then these are the root's labels, and as many
                assert size == root.sizes[dim], (section, dim)
                if dim in node.coords:
                    assert node.indexes[dim].equals(root.indexes[dim])
            else:
                assert dim not in root.coords, (section, dim)

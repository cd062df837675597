"""Answers: they hold the answer alone, and are the same every time."""

import re
from datetime import UTC, datetime

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin import EARTH, Scene, load_scene
from earthspin.engine.variables import Neglected
from earthspin.scenes import shipped_scenes
from tests import shipped


@pytest.fixture(scope="module", params=shipped_scenes())
def answer(request: pytest.FixtureRequest) -> xr.Dataset:
    return shipped.tree(request.param).to_dataset()


def test_no_clock_stands_in_an_answer(answer: xr.Dataset) -> None:
    today = datetime.now(UTC)
    text = repr([answer.attrs, *(v.attrs for v in answer.variables.values())])
    assert f"{today:%Y-%m-%d}" not in text
    assert not re.search(r"run_?time|seconds_of|date_created", text)


def test_an_answer_names_what_it_neglects(answer: xr.Dataset) -> None:
    words = answer.attrs["neglected"]
    assert words
    assert "\n" not in words
    name = next(n for n, t in shipped_scenes().items() if t == answer.attrs["title"])
    sizes = shipped.tree(name)["neglected"].neglected_effect
    assert sizes.dims == ("effect",)
    if sizes.size:
        largest = str(abs(sizes).idxmax().values)
        assert words.startswith(f"{largest}: ")
        assert f"{float(sizes.sel(effect=largest)):.3g} {sizes.attrs['units']}" in words
    else:
        unknown = sizes.attrs.get("of_unknown_size")
        assert words == (f"of unknown size: {unknown}" if unknown else sizes.attrs["long_name"])


def names_in(text: str) -> set[str]:
    """Names in a docstring, with those that ± stands for; shares of an error are suffixes."""
    with_error = re.findall(r"`(\w+)`\s±", text)
    return {*re.findall(r"`(\w+)`", text), *(f"{name}_error" for name in with_error)}


@pytest.mark.parametrize("name", shipped_scenes())
def test_the_docstring_names_each_variable_and_each_section(name: str) -> None:
    question, tree = type(load_scene(name)), shipped.tree(name)
    text = getattr(earthspin, question.call).__doc__
    returns = text.partition("\nReturns\n")[2].partition("\nRaises\n")[0]
    answer, _, sections = returns.partition("Sections, from `earthspin.run_tree`:")
    assert re.findall(r"- `(\w+)`: ", sections) == [*question.graph.sections]
    assert set(tree.children) - {"plan"} <= set(question.graph.sections)
    names = names_in(answer)
    for variable in map(str, tree.data_vars):
        name, _, share = variable.partition("_error_")
        assert variable in names or {f"{name}_error", f"_error_{share}"} <= names
    for section in set(tree.children) - {"plan", Neglected.PART}:
        assert set(tree[section].data_vars) <= names_in(sections)


def test_a_frame_has_a_row_for_each_label(answer: xr.Dataset) -> None:
    """The rows have the labels of most variables: of `long_term`, epochs and not perturbers."""
    spread = {"component", "quaternion", "axis"}
    if "epoch" in answer.sizes:
        spread.add("perturber")
    rows = np.prod([size for dim, size in answer.sizes.items() if dim not in spread])
    frame = answer.earthspin.to_frame()
    assert len(frame) == rows
    assert all(
        frame[name].nunique() == answer.sizes[name] for name in answer.sizes if name in frame
    )
    assert not frame.isna().any(axis=None)


def test_many_bodies_share_the_dimensions_of_the_question_and_their_own() -> None:
    h = xr.DataArray(np.linspace(0.003, 0.0034, 1000), dims="draw")
    answer = earthspin.precession(body=EARTH.replace(dynamical_flattening=h))
    assert set(answer.sizes) == {"perturber", "draw"}
    # 7 variables over both, with no curve that nobody asked for
    assert answer.nbytes < 20 * 3 * 1000 * 8


def test_an_earth_with_a_day_of_twelve_hours_says_so() -> None:
    fast = EARTH.replace(spin_period=43200.0)
    tree = earthspin.run_tree(Scene(compute="precession", body=fast))
    assert tree.attrs["body"] == "earth"
    assert tree.attrs["body_changes"] == "spin_period = 43200.0 s"
    assert "free_wobble_period" in tree["free_wobble"]
    assert "observed_period" not in tree["free_wobble"]
    reason = str(tree["plan/reason"].sel(part="observed-wobble").values)
    assert reason == "no observed wobble of this Earth is known"
    wobble = load_scene("wobble", {"body.spin_period": "12 h", "body.interior": "none"})
    assert "observed" not in earthspin.run_tree(wobble)
    changes = earthspin.run(wobble).attrs["body_changes"]
    assert changes == "spin_period = 43200.0 s; interior = none"
    with pytest.raises(earthspin.SceneError, match="no observed wobble"):
        earthspin.run_tree(wobble, "observed")


def test_a_body_as_it_is_says_nothing_of_changes(precession_result: xr.Dataset) -> None:
    assert "body_changes" not in precession_result.attrs
    # what is known better of the same body does not make it another
    finer = EARTH.replace(j2=EARTH.j2 * (1 + 1e-6), dynamical_flattening=EARTH.dynamical_flattening)
    tree = earthspin.run_tree(Scene(compute="precession", body=finer), "free_wobble")
    assert float(tree["free_wobble/observed_period"]) == 430.9
    assert tree.attrs["body_changes"].startswith("j2 = ")

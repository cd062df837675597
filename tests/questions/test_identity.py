"""A body is known by its NAIF code, not by its name."""

from collections.abc import Mapping
from typing import Any

import pytest

import earthspin
from earthspin import BODIES, EARTH, Body, EarthspinError
from earthspin.bodies.planets import MEAN_MOON, MEAN_SUN, default_perturbers
from tests.shipped import SCENES

SHORT = {"span": ("2000-01-01", "2000-01-04"), "step": "1 d"}
ASKED = [name for name in SCENES.values() if hasattr(earthspin.load_scene(name), "body")]


def numbers(scene: str, keys: Mapping[str, Any]) -> Any:
    """All numbers and words of an answer with its sections, with built-in names of bodies."""
    try:
        short = SHORT if scene in ("rotation", "pole") else {}
        tree = earthspin.run_tree(earthspin.load_scene(scene, {**short, **keys}))
    except EarthspinError as error:
        return type(error)
    names = {f"own {name}": name for name in BODIES}

    def built_in(word: Any) -> Any:
        return names.get(word, word)

    return {
        f"{node.path}/{name}": [built_in(value) for value in variable.values.ravel().tolist()]
        for node in tree.subtree
        if node.name != "plan"
        for name, variable in node.to_dataset().variables.items()
    }


def own(body: Body) -> Body:
    return body.replace(name=f"own {body.name}")


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("scene", ASKED)
def test_a_renamed_body_has_the_same_numbers(scene: str) -> None:
    answers = 0
    for name, body in BODIES.items():
        expected = numbers(scene, {"body": body})
        answers += isinstance(expected, dict)
        assert repr(numbers(scene, {"body": own(body)})) == repr(expected), name
        if isinstance(expected, dict) and hasattr(earthspin.load_scene(scene), "perturbers"):
            perturbers = default_perturbers(body)
            named = numbers(scene, {"body": body, "perturbers": perturbers})
            keys = {"body": own(body), "perturbers": [own(p) for p in perturbers]}
            assert repr(numbers(scene, keys)) == repr(named), name
    assert answers


def test_orbits_about_a_renamed_body() -> None:
    mean = [MEAN_SUN, MEAN_MOON]
    expected = earthspin.precession(body=EARTH, perturbers=mean)
    answer = earthspin.precession(body=own(EARTH), perturbers=[own(p) for p in mean])
    assert (answer.precession_rate.values == expected.precession_rate.values).all()


def test_own_numbers_of_a_body_with_a_built_in_code() -> None:
    slow = own(EARTH).replace(spin_period="48 h")
    rates = [float(earthspin.precession(body=b).precession_rate[-1]) for b in (slow, EARTH)]
    assert rates[0] / rates[1] == pytest.approx(48 * 3600 / EARTH.spin_period, rel=1e-12, abs=0)
    assert "spin_period" in slow.changes
    assert Body(name="earth", gm=1e14, naif=(-1,)).known_as == ""

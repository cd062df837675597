"""Labelled arrays: in every number of a body each question takes them, or names the field."""

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin import EARTH, MOON, SUN, EarthspinError
from earthspin.engine.question import Question
from earthspin.scenes import load_scene, run

SHORT = {"span": ["2001-01-01", "2001-02-01"], "step": "10 d"}
SCENES = {
    "precession": {},
    "torque": SHORT,
    "pole": SHORT,
    "iau": {},
    "wobble": {},
    "long-term": {"span": ["-2 kyr", "0 yr"]},
}
FIELDS = [name for name in EARTH.UNITS if getattr(EARTH, name) is not None]

#: What a field is named by where another follows from it.
ALSO = {"j2": {"dynamical_flattening"}, "radius": {"interior"}, "gm": {"interior"}}


def many(value: float) -> xr.DataArray:
    """Two values that are a millionth apart."""
    return xr.DataArray([value, value * (1 + 1e-6)], dims="member")


def answered(word: str, changes: dict[str, object]) -> tuple[xr.Dataset | None, str]:
    """The answer, or why there is none."""
    try:
        return run(scene(word).replace(**changes)), ""
    except EarthspinError as error:
        return None, str(error)


def scene(word: str) -> Question:
    return load_scene(word, SCENES[word])


@pytest.mark.parametrize("word", SCENES)
def test_numbers_of_the_body(word: str) -> None:
    """Taken: a member is what it is alone. Refused: in one line that names the field.

    All numbers are changed at once, and again without the field that was refused.
    """
    fields = {"j2"} if word == "iau" else {*FIELDS}
    while fields:
        numbers = {name: many(float(getattr(EARTH, name))) for name in FIELDS if name in fields}
        answer, refusal = answered(word, {"body": EARTH.replace(**numbers)})
        if answer is None:
            assert "\n" not in refusal
            named = {f for f in fields if any(name in refusal for name in {f, *ALSO.get(f, ())})}
            assert named
            fields -= named
            continue
        body = EARTH.replace(**{name: values[1].item() for name, values in numbers.items()})
        alone = run(scene(word).replace(body=body))
        for name, variable in answer.data_vars.items():
            member = variable.isel(member=1) if "member" in variable.dims else variable
            if variable.dtype.kind == "f":
                np.testing.assert_allclose(member, alone[name], rtol=2e-14, atol=1e-300)
        return


@pytest.mark.parametrize("field", ["gm", "cycle", "slow_swing", "radius"])
@pytest.mark.parametrize("word", ["precession", "torque", "pole", "iau", "long-term"])
def test_a_number_of_what_pulls_is_one(word: str, field: str) -> None:
    """Once they leaked numpy's words on the truth of arrays."""
    if word in ("precession", "long-term") and field == "gm":
        return  # the mean torque is linear in it: tests/engine/test_ensemble.py
    value = getattr(SUN, field)
    sun = SUN.replace(**{field: many(7e8 if value is None else float(value))})
    with pytest.raises(EarthspinError, match=rf"perturbers\.sun\.{field}"):
        scene(word).replace(perturbers=(sun, MOON))


@pytest.mark.parametrize("field", ["pole", "orbit_pole"])
@pytest.mark.parametrize(
    "given",
    [
        (xr.DataArray([5.5, 5.6], dims="m"), xr.DataArray([0.9, 0.95], dims="m")),
        xr.DataArray([[5.5, 0.9], [5.6, 0.95]], dims=("m", "angle")),
        np.array([[5.5, 0.9], [5.6, 0.95]]),
        [[5.5, 5.6], [0.9, 0.95]],
    ],
)
def test_a_pole_is_one_direction(field: str, given: object) -> None:
    with pytest.raises(EarthspinError, match=f"{field} = 'an array'.*one direction"):
        EARTH.replace(**{field: given})


@pytest.mark.parametrize(
    "moments",
    [
        [xr.DataArray([1.0, 1.1], dims="m"), 2, 2.8],
        [np.array([1.0, 1.1]), 2, 2.8],
        [[1, 2, 2.8], [1, 2, 2.9]],
        {"A": xr.DataArray([1.0, 1.1], dims="m"), "B-A": 1, "C-A": 1.8},
    ],
)
def test_moments_of_a_free_rotor_are_three_numbers(moments: object) -> None:
    with pytest.raises(EarthspinError, match="moments"):
        earthspin.free_rotor(moments, [0.01, 1, 0], [0, 10])  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "key", ["transverse_moment", "axial_moment", "weight_moment", "theta", "spin"]
)
def test_the_numbers_of_a_top_are_one_each(key: str) -> None:
    numbers = {"transverse_moment": 1, "axial_moment": 1.2, "weight_moment": 1.5, "theta": 0.7}
    with pytest.raises(EarthspinError, match=f"{key} = .*give one number"):
        earthspin.heavy_top([0, 1], **{**numbers, "spin": 3, key: many(0.7)})  # type: ignore[arg-type]


@pytest.mark.parametrize("word", SCENES)
def test_a_question_can_be_changed_that_has_a_step_in_years(word: str) -> None:
    """Once a step of years, read before, was refused for want of its unit."""
    asked = scene(word)
    assert asked.replace(title="again").keys() == asked.keys() | {"title": "again"}

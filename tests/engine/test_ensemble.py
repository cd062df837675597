"""Ensembles: members that are the same alone, drawn as they say, and whole or refused."""

from __future__ import annotations

from itertools import combinations, pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pint
import pytest
import xarray as xr
from astropy import units
from scipy import stats

import earthspin
from earthspin import EARTH, MOON, SUN, ArgumentError, EarthspinError, SceneError
from earthspin.engine.ensemble import ROW, Ensemble
from earthspin.engine.members import Distribution, Members, draw, standard_normal
from earthspin.errors import Where
from earthspin.scenes import QUESTIONS, Scene, load_scene
from earthspin.units import pack
from tests import shipped
from tests.engine.work import assert_is_alone
from tests.refusals import refused

DAYS = {"span": ["2000-01-01", "2000-01-03"], "step": "6 h"}
EXPONENT = {"anelastic_exponent": {"uniform": [0.04, 0.19]}}
H = {"body.dynamical_flattening": {"normal": [EARTH.dynamical_flattening, 1e-9]}}
RADIUS = {"body.radius": {"uniform": ["6378.1 km", "6378.2 km"]}}
#: Keys that make a question quick, and an input that its members differ in, where the first number
#: of its shipped scene does not do.
ASKED: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "precession": ({}, {"body.j2": {"normal": [EARTH.j2, 1e-10]}}),
    "torque": (DAYS, RADIUS),
    "pole": ({"span": ["2000-01-01", "2000-01-11"], "step": "5 d"}, H),
    "long-term": ({"span": ["-20 kyr", "0 kyr"], "step": "10 kyr"}, H),
    "insolation": ({"span": ["-20 kyr", "0 kyr"], "step": "10 kyr", "latitude": ["65N", "0N"]}, H),
    "cassini-states": ({}, {"body.j2": {"normal": [2.033e-4, 1e-8]}}),
    "love-numbers": ({}, EXPONENT),
    "rotation": (DAYS, {"body.triaxiality": {"normal": [EARTH.triaxiality, 1e-9]}}),
    "polar-motion": ({}, {"body.gm": {"normal": [EARTH.gm, 8e5]}}),
    "wobble": ({}, EXPONENT),
    "free-rotor": (
        {"moments": [1, 2, 2.8], "omega": [0.01, 1, 0], "times": [0, 10]},
        {"moments.2": {"grid": [2.5, 2.8]}, "omega.0": {"choice": [0.01, 0.02]}},
    ),
    "top": (
        {
            "transverse_moment": 1, "axial_moment": 1.2, "weight_moment": 1.5,
            "theta": "40 deg", "spin": 3, "times": [0, 1, 2],
        },
        {"spin": {"uniform": [2, 4]}},
    ),
    "spheroid": (
        {"position": ["7000 km", "0 km", "0 km"]},
        {"body.flattening": {"normal": [EARTH.flattening, 1e-9]}},
    ),
    "iau": ({}, H),
    "nutation": ({}, H),
    "observed-day": (
        {"span": ["2020-01-01", "2020-01-11"]}, {"tides": {"choice": ["left in", "taken out"]}},
    ),
}  # fmt: skip
#: Questions that follow the pole over centuries, some seconds a member.
SLOW = ("iau", "nutation")
QUICK = tuple(word for word in QUESTIONS if word not in SLOW)


def asked(word: str, n: int = 4, **settings: Any) -> Any:
    """A question with members."""
    scene = load_scene(shipped.SCENES[word])
    keys, inputs = ASKED.get(word, ({}, RADIUS))
    if word not in ASKED and not hasattr(scene, "body"):
        name, number = next((n, x) for n, x in scene.keys().items() if isinstance(x, float))
        inputs = {name: {"uniform": [0.99 * number, number]}}
    members = {"n": n, **inputs, **settings}
    return QUESTIONS[word](members=members, **keys) if keys else scene.replace(members=members)


def label_of(many: xr.Dataset) -> str:
    """Name of the coordinate that holds the one input of an ensemble."""
    (label,) = (str(name) for name, variable in many.coords.items() if "input" in variable.attrs)
    return label


def differ(one: xr.Dataset, other: xr.Dataset) -> list[str]:
    """Variables that are not the same to the bit."""
    return [str(n) for n in one.variables if not one[n].variable.equals(other[n].variable)]


# --- every question ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "word", [*QUICK, *(pytest.param(word, marks=pytest.mark.slow) for word in SLOW)]
)
def test_a_member_is_the_same_alone(word: str) -> None:
    all_of_them = earthspin.run(asked(word))
    alone = earthspin.run(asked(word, only=[2]))
    assert all_of_them.sizes["member"] == 4
    assert differ(alone, all_of_them.isel(member=[2])) == []
    again = earthspin.ensemble(asked(word).replace(members=None), all_of_them.isel(member=[2, 3]))
    assert differ(again.isel(member=[0]).drop_vars("member"), alone.drop_vars("member")) == []


@pytest.mark.parametrize("word", ["precession", "torque", "wobble"])
def test_side_by_side_is_one_by_one(word: str) -> None:
    """All numbers of the body at once, each by another factor."""
    fields = [name for name in sorted(EARTH.LABELLED - {"slow_swing"}) if getattr(EARTH, name)]
    values = {
        name: float(getattr(EARTH, name)) * (1 + 1e-7 * (place + 1) * np.arange(5.0))
        for place, name in enumerate(fields)
    }
    question = asked(word).replace(members=None)
    inputs = xr.Dataset({f"body.{name}": ("member", several) for name, several in values.items()})
    many = earthspin.ensemble(question, inputs)
    for number in (0, 4):
        body = EARTH.replace(**{name: float(several[number]) for name, several in values.items()})
        # numpy divides complex arrays otherwise than complex numbers (measured: 7e-16)
        rtol = 2e-15 if word == "wobble" else 0.0
        assert_is_alone(many, number, earthspin.run(question.replace(body=body)), rtol, rtol)


@pytest.mark.parametrize(
    ("word", "name", "low", "high"),
    [
        ("top", "spin", 2.0, 4.0),
        ("top", "theta", 0.1, 3.0),
        ("top", "axial_moment", 0.3, 1.9),
        ("spheroid", "body.flattening", -3.0, 0.9),
        ("spheroid", "point_mass", 1.0, 1e20),
        ("long-term", "tides", 0.0, 1.2),
        ("long-term", "ellipticity", 0.99, 1.02),
        ("long-term", "j2_rate", -9e-16, 0.0),
        ("long-term", "obliquity_shift", 0.0, 0.5),
        ("long-term", "longitude_shift", -3.0, 3.0),
        ("long-term", "body.dynamical_flattening", 0.0032, 0.0034),
    ],
)
def test_numbers_of_a_question_are_side_by_side(
    word: str, name: str, low: float, high: float
) -> None:
    """And the same bits as the question has by itself."""
    values = np.linspace(low, high, 5)
    question = asked(word).replace(members=xr.Dataset({name: ("member", values)}))
    assert Ensemble(question).width > 1
    many = earthspin.run(question)
    for number, value in enumerate(values.tolist()):
        key, _, field = name.partition(".")
        changed = EARTH.replace(**{field: value}) if field else value
        alone = earthspin.run(question.replace(members=None, **{key: changed}))
        assert_is_alone(many, number, alone)
    assert np.array_equal(many.coords[label_of(many)].values, values)


@pytest.mark.slow
def test_members_that_cannot_stand_side_by_side_are_made_one_by_one() -> None:
    """Newton's method does not settle for the third over blocks in which it does for the others."""
    values = [1.0, 1.01, 8.0]
    many = earthspin.ensemble(
        QUESTIONS["long-term"](span=("-1 Myr", "0 kyr"), step="100 kyr"),
        xr.Dataset({"ellipticity": ("member", values)}),
    )
    for number, value in enumerate(values):
        alone = earthspin.long_term("-1 Myr", "0 kyr", "100 kyr", ellipticity=value)
        assert_is_alone(many, number, alone)


@pytest.mark.parametrize("omega", [[0.01, 1, 0], [[0.01, 1, 0], [1, 0.2, 0.3]]])
@pytest.mark.parametrize(
    "moments", [[1, 2, 2.8], {"A": "1 kg m2", "B-A": "1e-3 kg m2", "C-A": "2e-3 kg m2"}]
)
def test_rotors_are_side_by_side(moments: Any, omega: Any) -> None:
    """One of three moments and one of the angular velocities, with one start and with two."""
    values = {"moments.0": np.array([1.0, 1.1, 1.2]), "omega.1": np.array([1.0, 1e-3, 0.0])}
    question = QUESTIONS["free-rotor"](moments=moments, omega=omega, times=[0, 7, 90])
    inputs = xr.Dataset({name: ("member", variable) for name, variable in values.items()})
    assert Ensemble(question.replace(members=inputs)).width > 1
    many = earthspin.ensemble(question, inputs)
    for number in range(3):
        start = np.array(omega, dtype=float)
        start.flat[1] = values["omega.1"][number]
        first = float(values["moments.0"][number])
        own = {**moments, "A": first} if isinstance(moments, dict) else [first, *moments[1:]]
        assert_is_alone(many, number, earthspin.free_rotor(own, start, [0, 7, 90]))


def test_masses_of_what_pulls_are_side_by_side() -> None:
    values = MOON.gm * (1 + 1e-6 * np.arange(3.0))
    inputs = xr.Dataset({"moon.gm": ("member", values)})
    many = earthspin.ensemble("precession", inputs)
    assert Ensemble(asked("precession").replace(members=inputs)).width > 1
    for number in range(3):
        moon = MOON.replace(gm=float(values[number]))
        # The mean of a sum is not the sum of means to the last bit (measured 2e-15); errors are
        # differences of such means, and rounding there is larger (measured: 1.5e-9).
        assert_is_alone(many, number, earthspin.precession(perturbers=[SUN, moon]), 1e-14, 1e-8)


@pytest.mark.slow
def test_any_number_in_any_block() -> None:
    whole = earthspin.run(asked("precession", 200))
    for n, block in ((1, 45), (ROW, 64), (ROW + 1, 45), (ROW + 1, 64), (199, 45), (199, 200)):
        part = earthspin.ensemble(asked("precession", n), block=block)
        assert differ(part, whole.isel(member=slice(0, n))) == []


# --- how members are drawn -----------------------------------------------------------------------


def draws(n: int, inputs: dict[str, Any], **settings: Any) -> dict[str, np.ndarray]:
    question = Scene(compute="wobble", members={"n": n, **inputs, **settings})
    return Ensemble(question).values


def test_random_numbers_are_those_of_philox() -> None:
    sequence = np.random.SeedSequence(7, spawn_key=(17,))
    expected = np.random.Generator(np.random.Philox(sequence)).standard_normal(3)
    assert np.array_equal(standard_normal(7, np.array([3, 17]), 3)[1], expected)
    drawn = draws(18, {"body.j2": {"normal": [0.001, 1e-5]}}, seed=7)
    assert drawn["body.j2"][17] == 0.001 + 1e-5 * expected[0]


@pytest.mark.parametrize(
    ("distribution", "expected"),
    [
        ({"normal": [0.0033, 1e-6]}, stats.norm(0.0033, 1e-6)),
        ({"uniform": [0.0030, 0.0034]}, stats.uniform(0.0030, 0.0004)),
    ],
)
def test_draws_follow_their_distribution(distribution: dict[str, Any], expected: Any) -> None:
    drawn = draws(4000, {"body.dynamical_flattening": distribution})["body.dynamical_flattening"]
    assert stats.kstest(drawn, expected.cdf).pvalue > 0.01  # the seed is fixed


def test_choices_and_grids() -> None:
    inputs = {"body.j2": {"choice": [0.001, 0.0011]}, "body.radius": {"grid": ["6000 km", "1 Mm"]}}
    drawn = draws(4000, inputs)
    assert abs(np.mean(drawn["body.j2"] == 0.001) - 0.5) < 0.03
    assert np.array_equal(drawn["body.radius"][:4], [6e6, 1e6, 6e6, 1e6])
    two = {"body.j2": {"grid": [0.001, 0.0011]}, "body.radius": {"grid": ["6000 km", "7000 km"]}}
    every = Ensemble(Scene(compute="wobble", members=two)).values
    assert len({*zip(every["body.j2"], every["body.radius"], strict=True)}) == 4


def test_correlations() -> None:
    inputs = {"body.j2": {"normal": [0.001, 1e-5]}, "body.gm": {"normal": [4e14, 1e10]}}
    pair = [["body.j2", "body.gm", -0.8]]
    drawn = draws(4000, inputs, correlations=pair)
    assert np.corrcoef(*drawn.values())[0, 1] == pytest.approx(-0.8, abs=0.02)
    assert np.array_equal(draws(4000, inputs)["body.j2"], drawn["body.j2"])


def test_correlated_numbers_of_a_member_are_the_same_alone() -> None:
    """To the bit: a product of matrices would round a single row otherwise."""
    names, here = ("body.j2", "body.j3", "body.gm", "body.radius"), Where("members")
    pairs = tuple((a, b, 0.4) for a, b in pairwise(names))
    members = Members(n=50, correlations=pairs)
    normal = dict.fromkeys(names, Distribution("normal", (1.0, 1.0)))
    together = draw(members, normal, np.arange(50), here)
    for number in range(50):
        alone = draw(members, normal, np.array([number]), here)
        assert all(alone[name][0] == together[name][number] for name in names)


def test_published_uncertainties_are_the_bodies_own() -> None:
    work = Ensemble(Scene(compute="precession", members=4000))
    assert list(work.inputs) == [
        "body.gm", "body.radius", "body.j2", "body.dynamical_flattening", "body.flattening",
        "sun.gm", "moon.gm",
    ]  # fmt: skip
    for name, item in work.inputs.items():
        body = EARTH if item.key == "body" else {"sun": SUN, "moon": MOON}[name.split(".")[0]]
        field = name.split(".")[1]
        u = abs(getattr(body, field)) * body.relative_uncertainty[field]
        drawn = work.values[name]
        assert drawn.std() == pytest.approx(u, rel=0.04, abs=0)
        assert drawn.mean() == pytest.approx(getattr(body, field), abs=4 * u / np.sqrt(4000))


# --- what they tell ------------------------------------------------------------------------------


def test_quantiles_and_linear_errors_agree() -> None:
    ends = earthspin.ensemble("precession", 4000).earthspin.quantiles([0.025, 0.975])
    half = ends.precession_rate.diff("quantile").squeeze("quantile", drop=True) / 2
    linear = earthspin.precession().precession_rate_error_input
    np.testing.assert_allclose(half, linear, rtol=0.04, atol=0)  # 4000 members: 2 % of one sigma


def test_quantiles_give_the_half_width_of_the_period() -> None:
    """The same number as `uncertainty = "sample"` of earlier versions gave, to all its digits."""
    ends = earthspin.ensemble("precession", 1000).earthspin.quantiles()
    period = ends.precession_period.sel(perturber="total")
    half = float(period.sel(quantile=0.975) - period.sel(quantile=0.025)) / 2
    assert half == pytest.approx(0.0159277, abs=5e-8)


def test_the_share_of_h_in_the_rate_is_that_of_the_linear_errors() -> None:
    answer = earthspin.ensemble("precession", 2000)
    shares = answer.earthspin.sensitivity()
    total = shares.precession_rate_share.sel(perturber="total")
    # the rate is proportional to H, and to the masses by their shares
    rate = earthspin.precession().precession_rate
    by_h = EARTH.relative_uncertainty["dynamical_flattening"]
    moons = rate.sel(perturber="moon") / rate.sel(perturber="total")
    by_moon = MOON.relative_uncertainty["gm"] * float(moons)
    expected = by_h**2 / (by_h**2 + by_moon**2)
    error = shares.precession_rate_share_error.sel(perturber="total")
    error = float(error.sel(input="body.dynamical_flattening"))
    assert error < 1e-4
    share = float(total.sel(input="body.dynamical_flattening"))
    assert share == pytest.approx(expected, rel=0, abs=error)
    slope = shares.precession_rate_slope.sel(perturber="total", input="body.dynamical_flattening")
    whole = float(rate.sel(perturber="total"))
    assert float(slope) == pytest.approx(whole / EARTH.dynamical_flattening, rel=1e-6, abs=0)
    assert float(shares.precession_rate_unexplained.max()) < 1e-9


def test_what_is_no_ensemble_is_refused() -> None:
    answer = earthspin.precession()
    for call in (answer.earthspin.quantiles, answer.earthspin.sensitivity):
        with pytest.raises(SceneError, match="it is not an ensemble"):
            call()
    with pytest.raises(SceneError, match="at least 9 members"):
        earthspin.ensemble("precession", 5).earthspin.sensitivity()
    with pytest.raises(SceneError, match="between 0 and 1"):
        earthspin.ensemble("precession", 5).earthspin.quantiles([2])
    with pytest.raises(SceneError, match="an ensemble has only"):
        earthspin.run_tree(asked("precession"), "seasons")


# --- what cannot be ------------------------------------------------------------------------------

FLAT = {"n": 100, "body.dynamical_flattening": {"uniform": [0.4, 0.6]}}


def test_impossible_members_are_refused_or_dropped() -> None:
    with pytest.raises(SceneError, match=r"2, 5, 6, 8, 11 and 48 more.*of 100.*at most 0\.5"):
        earthspin.ensemble("precession", FLAT)
    kept = earthspin.ensemble("precession", FLAT, impossible="drop")
    assert kept.sizes["member"] == 47
    assert kept.attrs["members_dropped"].startswith("53 that cannot exist: 2, 5, 6")
    assert 2 not in kept.member
    assert float(kept.body_dynamical_flattening.max()) <= 0.5
    with pytest.raises(SceneError, match="members cannot exist"):
        earthspin.ensemble("precession", {**FLAT, "only": [2, 5]}, impossible="drop")


def test_a_member_that_fails_is_named() -> None:
    members = xr.Dataset({"body.spin_period": ("member", [86164.0, 27.3217 * 86400])})
    with pytest.raises(EarthspinError, match="member"):
        earthspin.ensemble("precession", members)


@pytest.fixture
def few_draws(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """At most a thousand members are drawn; the list counts them."""
    philox, counts = np.random.Philox, [0]

    def counted(*args: Any) -> Any:
        counts[0] += 1
        assert counts[0] <= 1000
        return philox(*args)

    monkeypatch.setattr(np.random, "Philox", counted)
    return counts


def million(low: float, high: float) -> dict[str, Any]:
    return {"grid": np.linspace(low, high, 10**6)}


@pytest.mark.parametrize(
    ("members", "message"),
    [
        (10**12, "to 10000000"),
        (
            {"body.j2": million(0.00108, 0.00109), "body.gm": million(3.98e14, 3.99e14)},
            r"'1000000000000 members \(1000000 times 1000000\)': .*at most 10000000.*'only'",
        ),
        (10**7, r"members = 10000000: they need about .* GB .*; give a path to write them"),
    ],
)
def test_members_that_are_too_many_are_refused_before_they_are_drawn(
    members: Any, message: str, few_draws: list[int]
) -> None:
    with pytest.raises(SceneError, match=message):
        earthspin.ensemble("precession", members)


def test_an_ensemble_of_days_goes_to_a_store(
    monkeypatch: pytest.MonkeyPatch, few_draws: list[int]
) -> None:
    monkeypatch.setattr("earthspin.engine.ensemble.LONGEST_IN_MEMORY", 1e-3)
    with pytest.raises(SceneError, match=r"days.*; give a path"):
        earthspin.ensemble(asked("love-numbers", 200_000))


def test_members_of_a_large_grid_may_be_computed_alone(few_draws: list[int]) -> None:
    """Of 25 million, of which all together are refused; nothing is drawn for a grid."""
    values = np.linspace(3.98e14, 3.99e14, 5000)
    grid = {"body.gm": {"grid": values}, "moon.gm": {"grid": values / 81}, "only": [5003]}
    one = earthspin.ensemble("precession", grid)
    assert (one.body_gm.item(), one.moon_gm.item()) == (values[3], (values / 81)[1])
    assert few_draws == [0]


NAN = xr.Dataset({"body.j2": ("member", [1e-3, np.nan])})
#: Correlations that no three numbers have.
IMPOSSIBLE = [[a, b, -0.9] for a, b in combinations(("body.j2", "body.radius", "body.gm"), 2)]


test_bad_members_are_refused = refused(
    (0, "whole number, 1 or more"),
    (-3, "whole number, 1 or more"),
    (2.5, "how many, a table of distributions"),
    (True, "how many, a table of distributions"),
    ("nowhere.csv", "there is no such file"),
    (NAN, "member 1"),
    (NAN.isel(member=[]), "it has no members"),
    (xr.Dataset(), "it has no members"),
    (NAN.fillna(1e-3).rename(member="row"), "one of the dimensions must be 'member'"),
    (NAN.fillna(1e-3).rename({"body.j2": "body.j3x"}), "did you mean 'body.j3'"),
    (NAN.fillna(1e-3).astype(str), "give finite numbers"),
    ({"n": 3}, "no input of this question"),
    ({"n": 3, "body.j": {"normal": [1, 2]}}, "did you mean 'body.j"),
    ({"n": 3, "H": {"normal": [1, 2]}}, "write 'body.dynamical_flattening'"),
    ({"n": 3, "body.name": {"choice": [1, 2]}}, "allowed"),
    ({"n": 3, "body.j2": 5}, "a table like normal"),
    ({"n": 3, "body.j2": {"gauss": [1, 2]}}, "give one of normal, uniform, choice, grid"),
    ({"n": 3, "body.j2": {"normal": [1]}}, "a mean and one standard deviation"),
    ({"n": 3, "body.j2": {"normal": [1e-3, -1]}}, "must be zero or positive"),
    ({"n": 3, "body.j2": {"uniform": [2, 1]}}, "give the lowest value first"),
    ({"n": 3, "body.radius": {"uniform": ["1 s", "2 s"]}}, "is not a value in units of m"),
    ({"n": 3, "body.j2": {"choice": []}}, "one value or more"),
    ({"body.j2": {"normal": [1e-3, 1e-5]}}, "give the number of members"),
    ({"n": 3, "body.j2": {"grid": [1e-3, 2e-3]}}, "give a multiple of"),
    ({"n": 3, "uncertainty": "sampled"}, "did you mean 'sample'"),
    ({"n": 3, "impossible": "ignore"}, "allowed: drop, refuse"),
    ({"n": 3, "uncertainty": "sample", "only": [3]}, "numbered from 0 to 2"),
    ({"n": 3, "uncertainty": "sample", "seed": -1}, "whole number, 0 or more"),
    ({"n": 3, "uncertainty": "sample", "correlations": [["a", "b"]]}, "two names and a number"),
    ({"n": 3, "uncertainty": "sample", "correlations": [["a", "b", 0.5]]}, "allowed: anelastic"),
    ({"n": 3, "correlations": [["body.j2", "body.gm", 1.5]]}, "between -1 and 1"),
    ({"n": 3, "uncertainty": "sample", "correlations": IMPOSSIBLE}, "is not positive definite"),
    call=lambda members: earthspin.ensemble("wobble", members),
)


@pytest.mark.parametrize("key", [{"uncertainty": "sample"}, {"uncertainty": "linear"}, {"n": 3}])
def test_keys_of_earlier_versions_are_refused_with_what_to_type(key: dict[str, Any]) -> None:
    words = r"give members: earthspin\.ensemble\('precession', 1000\)\.earthspin\.quantiles\(\)$"
    with pytest.raises(ArgumentError, match=words):
        earthspin.pole(**key)
    with pytest.raises(SceneError, match=words):
        load_scene("pole", key)


def test_inputs_have_their_units_and_names() -> None:
    answer = earthspin.ensemble(asked("free-rotor"))
    assert answer.moments_2.attrs["input"] == "moments.2"
    assert answer.moments_2.attrs["units"] == "kg m2"
    grid = {"moon.gm": {"grid": [4.9e12]}, "body.spin_period": {"grid": ["1 d"]}}
    answer = earthspin.ensemble("precession", grid)
    assert answer.moon_gm.attrs["units"] == "m3/s2"
    assert answer.body_spin_period.attrs["units"] == "s"


@pytest.mark.slow
def test_sources_of_random_numbers_of_numpy() -> None:
    """An integer is the seed itself; equal generators give equal ensembles (SPEC 7)."""
    seeded = earthspin.ensemble("precession", 5, seed=3)
    xr.testing.assert_identical(earthspin.ensemble("precession", 5, rng=3), seeded)
    for source in (np.random.default_rng, np.random.SeedSequence):
        first, again, other = (
            earthspin.ensemble("precession", 5, rng=source(number)) for number in (1, 1, 2)
        )
        xr.testing.assert_identical(first, again)
        assert not first.precession_rate.equals(other.precession_rate)
    for wrong in (1.5, "a", True, np.timedelta64(3, "s"), np.random.PCG64(3)):
        with pytest.raises(SceneError, match=r"rng = .*a Generator or SeedSequence"):
            earthspin.ensemble("precession", 5, rng=wrong)
    with pytest.raises(SceneError, match="give either seed or rng"):
        earthspin.ensemble("precession", 5, seed=1, rng=1)


def test_whole_numbers_of_numpy_are_those_of_python() -> None:
    two, three = np.int64(2), np.int64(3)
    answer = earthspin.ensemble("precession", three, block=two, seed=three)
    xr.testing.assert_identical(answer, earthspin.ensemble("precession", 3, rng=3))
    past = earthspin.long_term("-1 kyr", "0 kyr", "1 kyr")
    xr.testing.assert_identical(earthspin.pole_stars(past, two), earthspin.pole_stars(past, 2))
    assert earthspin.EARTH.replace(naif=(np.int32(399),)) == earthspin.EARTH.replace(naif=(399,))


def test_the_address_of_a_scheduler_is_checked_if_one_block_needs_none() -> None:
    with pytest.raises(SceneError, match="scheduler = 'nonsense'"):
        earthspin.ensemble("precession", 3, client="nonsense")


def shifted(values: list[float], unit: str | None) -> xr.Dataset:
    attrs = {} if unit is None else {"units": unit}
    return xr.Dataset({"obliquity_shift": ("member", values, attrs)})


def test_units_of_members_are_read() -> None:
    """The obliquity of J2000.0 by the IAU, 84381.406 arcsec, and one and two degrees more."""
    now = earthspin.Scene(compute="long-term", times=["0 kyr"])
    answer = earthspin.ensemble(now, shifted([1.0, 2.0], "deg"))
    expected = 84381.406 / 3600 + np.array([1.0, 2.0])
    assert answer.obliquity.values.ravel() == pytest.approx(expected, abs=1e-4)
    assert answer.obliquity_shift.attrs["units"] == "rad"
    for again in (earthspin.run(answer), earthspin.ensemble(now, answer)):
        assert np.array_equal(again.obliquity, answer.obliquity)
    plain = earthspin.ensemble(now, shifted([np.radians(1.0), np.radians(2.0)], None))
    assert plain.obliquity.values == pytest.approx(answer.obliquity.values, rel=1e-14, abs=0)
    for unit in ("km", "degs"):
        with pytest.raises(EarthspinError, match=f"obliquity_shift = '{unit}'"):
            earthspin.ensemble(now, shifted([1.0, 2.0], unit))


@pytest.mark.parametrize("labels", [["low", "mid", "high"], [30, 10, 20], [0.5, 1.5, 2.5]])
def test_members_keep_their_labels(tmp_path: Path, labels: list[Any]) -> None:
    """The rate of precession goes with the length of the day."""
    hours = xr.DataArray([12.0, 24.0, 48.0], {"member": labels}, "member", attrs={"units": "h"})
    members = xr.Dataset({"body.spin_period": hours})
    answer = earthspin.ensemble("precession", members).precession_rate.sel(perturber="total")
    again = earthspin.run(earthspin.ensemble("precession", members))
    assert again.member.values.tolist() == answer.member.values.tolist() == labels
    ratio = answer.sel(member=labels[2]) / answer.sel(member=labels[0])
    assert ratio.item() == pytest.approx(4.0, rel=1e-12, abs=0)
    members.to_dataframe().to_csv(tmp_path / "members.csv")
    plain = pd.read_csv(tmp_path / "members.csv").assign(**{"body.spin_period": 86164.0})
    plain.to_csv(tmp_path / "members.csv", index=False)
    assert (
        earthspin.ensemble("precession", tmp_path / "members.csv").member.values.tolist() == labels
    )
    few = earthspin.ensemble("precession", again.isel(member=[2, 0]))
    assert few.member.values.tolist() == [labels[2], labels[0]]
    assert few.precession_rate.sel(perturber="total").equals(answer.isel(member=[2, 0]))


def test_members_in_any_order_of_dimensions_and_components() -> None:
    rotor = {"rotor": {"moments": [1.0, 2.0, 3.0], "omega": [1.0, 0, 0], "times": [0.0, 1.0]}}
    omega = xr.DataArray([[0.1, 0.2], [0.3, 0.4], [1.0, 2.0]], dims=("component", "member"))
    omega = omega.assign_coords(component=["x", "y", "z"], member=["a", "b"])
    scene = earthspin.load_scene("free-rotor", rotor)
    sound = earthspin.ensemble(scene, xr.Dataset({"omega": omega}))
    turned = earthspin.ensemble(scene, xr.Dataset({"omega": omega.isel(component=[2, 0, 1]).T}))
    assert sound.omega_body.isel(time=0).values == pytest.approx(omega.T.values, rel=1e-14, abs=0)
    assert np.array_equal(turned.omega_body, sound.omega_body)


def test_units_of_members_are_not_stripped() -> None:
    hours = pint.UnitRegistry().Quantity(np.array([12.0, 24.0]), "hour")
    answer = earthspin.ensemble("precession", xr.Dataset({"body.spin_period": ("member", hours)}))
    assert answer.body_spin_period.values.tolist() == [43_200.0, 86_400.0]
    grid = {"body.spin_period": {"grid": [*hours]}}
    drawn = earthspin.run(earthspin.ensemble("precession", grid))
    assert drawn.body_spin_period.values.tolist() == [43_200.0, 86_400.0]
    objects = xr.Dataset({"body.spin_period": ("member", np.array([*hours], dtype=object))})
    with pytest.raises(EarthspinError, match=r"their unit as attrs\['units'\]"):
        earthspin.ensemble("precession", objects)


def test_units_of_numbers_of_bodies_in_files_and_distributions(tmp_path: Path) -> None:
    """Of the same bodies in m3/s2: the precession by the Moon goes with its GM."""
    masses = xr.Dataset({"moon.gm": ("member", [4902.8, 9805.6], {"units": "km3/s2"})})
    masses.to_netcdf(tmp_path / "masses.nc")
    plain = {"moon.gm": {"grid": [4902.8e9, 9805.6e9]}}
    expected = earthspin.ensemble("precession", plain).precession_period.values
    for members in (
        masses,
        tmp_path / "masses.nc",
        {"moon.gm": {"grid": [4902.8, 9805.6] * units.Unit("km3/s2")}},
    ):
        period = earthspin.ensemble("precession", members).precession_period.values
        assert period == pytest.approx(expected, rel=1e-14, abs=0)


GRID = {"grid": [1.08e-3, 1.09e-3]}


test_an_input_in_two_spellings_is_refused = refused(
    ({"body.j2": GRID, "body": {"j2": GRID}}, "body.j2 = .*it is given twice"),
    ({"wobble.k2": {"grid": [0.3]}, "k2": {"grid": [0.29]}}, "it is given twice"),
    ({"body.j2": GRID, "values": {"body.j2": pack(np.array([1e-3, 2e-3]))}}, "it is given twice"),
    call=lambda members: earthspin.ensemble(Scene(compute="wobble"), members),
)


def test_a_number_of_the_question_out_of_range_is_found_among_arrays() -> None:
    members = {"n": 70, "seed": 1, "ocean_love_number": {"normal": [0.04, 0.03]}}
    kept = earthspin.ensemble("wobble", members | {"impossible": "drop"})
    assert 0.0 <= float(kept.ocean_love_number.min()) < 0.02
    assert "that cannot exist" in kept.attrs["members_dropped"]
    with pytest.raises(SceneError, match=r"cannot exist: .*ocean_love_number"):
        earthspin.ensemble("wobble", members)

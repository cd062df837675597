"""An answer can be run again, from memory and from a file, and gives the same bits."""

import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomli_w
import xarray as xr
from hypothesis import given, reject
from hypothesis import strategies as st

import earthspin
from earthspin import EARTH, MARS, SceneError, VersionWarning, load_scene
from earthspin.bodies import BODIES
from earthspin.bodies.checks import refuse_break_up
from earthspin.questions.wobble import Wobble
from earthspin.scenes import shipped_scenes
from tests import shipped

H = xr.DataArray([0.003, 0.0032, 0.0033], {"draw": ["low", "middle", "high"]}, ("draw",))
YEARS = xr.DataArray([1.1e-3, 1.2e-3], {"case": [0.1, 1 / 3]}, ("case",))
DATES = [str(np.datetime64("1990-01-01T00:00") + np.timedelta64(k * k, "h")) for k in range(100)]
MANY = np.random.default_rng(5).uniform(0.0, 100.0, 50)
CALLS: dict[str, Callable[[], xr.Dataset]] = {
    "mars": lambda: earthspin.precession(body="mars", perturbers=["sun"]),
    "labelled": lambda: earthspin.precession(body=EARTH.replace(dynamical_flattening=H)),
    "labelled by floats": lambda: earthspin.wobble_ladder(
        body=EARTH.replace(j2=YEARS, dynamical_flattening=3 * YEARS)
    ),
    "a list of dates": lambda: earthspin.torque_series(times=DATES),
    "two dates": lambda: earthspin.pole(times=["2003-05-05T01:02:03.456", "1999-01-01"]),
    "differences": lambda: earthspin.free_rotor(
        {"A": 8.0e37, "B-A": 1.7e33, "C-A": 2.6e35}, [1e-12, 0.0, 7.29e-5], [0.0, 1e7]
    ),
    "several starts": lambda: earthspin.free_rotor(
        [1.0, 2.0, 3.0], [[0.3, 1.0, 0.1], [0.0, 0.0, 1.0]], MANY
    ),
    "true equator": lambda: earthspin.torque_series(
        "2000-01-01", "2001-01-01", "30 d", equator="true"
    ),
    "a top": lambda: earthspin.heavy_top(
        MANY,
        transverse_moment=1 / 3,
        axial_moment="0.4 kg m2",
        weight_moment=1.5,
        theta="40 deg",
        spin="200 deg/s",
    ),
    "a perturber by its numbers": lambda: earthspin.torque_series(
        "2000-01-01", "2000-01-02", "6 h", perturbers=["sun", BODIES["moon"].replace(gm=5e12)]
    ),
    "a moving and a fixed pole": lambda: earthspin.torque_series(
        "2000-01-01", "2000-01-02", "6 h", body=MARS.replace(pole=(1 / 3, 1.2)), perturbers="sun"
    ),
    "moments": lambda: earthspin.precession(
        body=EARTH.replace(moments=(8.0e37, 8.001e37, 8.03e37), mass=6e24)
    ),
    "UTC": lambda: earthspin.torque_series("2000-01-01T00:00Z", "2000-01-02T00:00Z", "6 h"),
    "the observed pole": lambda: earthspin.polar_motion(span=("1990-01-01", "2000-01-01")),
}


def run_again(answer: xr.Dataset, folder: Path) -> None:
    """Through a plain netCDF file, and from files of ours."""
    plain, ours, chunked = (folder / name for name in ("plain.nc", "ours.nc", "ours.zarr"))
    answer.to_netcdf(plain)
    xr.testing.assert_identical(earthspin.run(str(plain)), answer)
    earthspin.write(answer, ours)
    earthspin.write(answer, chunked)
    scene = load_scene(answer).to_table()
    assert load_scene(ours).to_table() == load_scene(chunked).to_table() == scene


def test_every_way_to_give_an_answer_runs_it(tmp_path: Path) -> None:
    answer = CALLS["two dates"]()
    paths = [earthspin.write(answer, tmp_path / f"answer.{kind}") for kind in ("nc", "zarr")]
    paths.append(earthspin.write(earthspin.run_tree(answer), tmp_path / "tree.nc"))
    with xr.open_dataset(paths[0]) as read:
        for again in (read, *paths, *map(str, paths), *map(earthspin.open, paths)):
            xr.testing.assert_identical(earthspin.run(again), answer)


@pytest.mark.parametrize(
    "scene",
    [
        pytest.param(scene, marks=pytest.mark.slow if scene in ("nutation", "rotation") else ())
        for scene in shipped_scenes()
    ],
)
def test_shipped_scenes_are_run_again(scene: str, tmp_path: Path) -> None:
    # the budget of one effect takes a fifth of that of all
    few = earthspin.run(load_scene("iau", {"effects": ["geodesic"]})) if scene == "iau" else None
    run_again(shipped.answer(scene) if few is None else few, tmp_path)


@pytest.mark.parametrize("call", CALLS)
def test_calls_are_run_again(call: str, tmp_path: Path) -> None:
    run_again(CALLS[call](), tmp_path)


@pytest.mark.parametrize("call", ["mars", "differences", "labelled", "labelled by floats"])
def test_sections_are_given_for_an_answer(call: str, tmp_path: Path) -> None:
    answer = CALLS[call]()
    tree = earthspin.run_tree(answer)
    xr.testing.assert_identical(tree.to_dataset(), answer)
    answer.to_netcdf(tmp_path / "answer.nc")
    again = earthspin.run_tree(tmp_path / "answer.nc")
    xr.testing.assert_identical(again.drop_nodes("plan"), tree.drop_nodes("plan"))
    old, new = (each["plan"].to_dataset(inherit=False) for each in (tree, again))
    times = ["run_time", "wall_time", "computation_time"]
    xr.testing.assert_identical(new.drop_vars(times), old.drop_vars(times))


def test_the_scene_of_an_answer_can_be_changed() -> None:
    answer = earthspin.wobble_ladder(ocean="global")
    other = earthspin.run(load_scene(answer, {"wobble.ocean": "none"}))
    xr.testing.assert_identical(other, earthspin.wobble_ladder(ocean="none"))


@pytest.mark.parametrize(
    "attribute", ["earthspin_version", "numpy_version", "jplephem_version", "ephemeris_sha256"]
)
def test_other_versions_are_named(attribute: str, tmp_path: Path) -> None:
    answer = earthspin.run("torque")
    older = answer.assign_attrs({attribute: "0.0.1"})
    with pytest.warns(VersionWarning, match=f"{attribute} 0.0.1, now {answer.attrs[attribute]}"):
        xr.testing.assert_identical(earthspin.run(older), answer)
    older.to_netcdf(tmp_path / "older.nc")
    with pytest.warns(VersionWarning, match=attribute):
        earthspin.run(tmp_path / "older.nc")
    with pytest.warns(VersionWarning, match=attribute):
        earthspin.run_tree(older, ())


def test_a_dataset_of_another_origin_is_refused(tmp_path: Path) -> None:
    other = xr.Dataset({"x": ("time", [1.0])}, attrs={"scene": 7})
    other.to_netcdf(tmp_path / "other.nc")
    for given_ in (other, xr.Dataset(), tmp_path / "other.nc"):
        with pytest.raises(SceneError, match="no scene"):
            earthspin.run(given_)


@pytest.mark.parametrize("text", ["compute = ", 'compute = "wobbly"', "", "x = 1"])
def test_a_scene_that_was_spoilt_is_refused(text: str) -> None:
    spoilt = earthspin.run("wobble").assign_attrs(scene=text)
    with pytest.raises(SceneError):
        earthspin.run(spoilt)


# --- to a table and back -------------------------------------------------------------------------


def bits(value: Any) -> Any:
    """What two equal values of a key have in common, down to the sign of zero."""
    if isinstance(value, float):
        return value.hex()
    if isinstance(value, np.ndarray):
        return value.shape, value.tobytes()
    if isinstance(value, xr.DataArray):
        labels = {str(k): bits(np.asarray(v.values)) for k, v in value.coords.items()}
        return value.dims, bits(value.values), labels
    if isinstance(value, dict):
        return {name: bits(one) for name, one in value.items()}
    if isinstance(value, (tuple, list)):
        return [bits(one) for one in value]
    if hasattr(value, "__dict__"):
        return type(value).__name__, {name: bits(one) for name, one in vars(value).items()}
    return value


FINITE = st.floats(allow_nan=False, allow_infinity=False)
#: Words of one line, without what a terminal would take for an order.
ONE_LINE = st.characters(codec="utf-8", exclude_categories=["Cs", "Cc", "Cf", "Zl", "Zp"])


@st.composite
def bodies(draw: st.DrawFn) -> earthspin.Body:
    start = draw(st.sampled_from([EARTH, MARS]))
    h, polar = draw(st.floats(1e-12, 0.5)), draw(st.floats(1e-3, 1.0))  # C over M a2
    changes: dict[str, Any] = {"dynamical_flattening": h, "j2": polar * h, "triaxiality": 0.0}
    for name, value in {
        "gm": st.floats(1e3, 1e25),
        "radius": st.floats(1.0, 1e9),
        "spin_period": st.floats(1.0, 1e9) | st.floats(-1e9, -1.0),
        "triaxiality": st.floats(0.0, polar / 2),
        "j3": FINITE,
        "long_axis": st.floats(-6.2, 6.2),
        "flattening": st.floats(-10.0, 0.99),
        "orbital_period": st.floats(1.0, 1e12),
        "pole": st.tuples(st.floats(-6.2, 6.2), st.floats(-1.57, 1.57)),
        "interior": st.sampled_from([None, "prem", "none"]),
        "name": st.text(ONE_LINE, min_size=1),
        "reference": st.text(ONE_LINE),
        "relative_uncertainty": st.dictionaries(
            st.sampled_from(["gm", "j2", "radius"]), st.floats(0.0, 1.0)
        ),
    }.items():
        if draw(st.booleans()):
            changes[name] = draw(value)
    if draw(st.booleans()):
        size = draw(st.integers(1, 40))
        listed = draw(st.lists(st.floats(1e-12, 0.5), min_size=size, max_size=size))
        labels = draw(st.none() | st.lists(FINITE, min_size=size, max_size=size))
        coords = {} if labels is None else {"draw": labels}
        changes["dynamical_flattening"] = xr.DataArray(listed, coords, ("draw",))
        changes["j2"] = polar * changes["dynamical_flattening"]
    try:
        made = start.replace(**changes)
        refuse_break_up(made)
    except earthspin.BodyError:
        reject()
    return made


@given(body=bodies(), title=st.text(ONE_LINE, max_size=20))
def test_bodies_are_written_exactly(body: earthspin.Body, title: str) -> None:
    question = Wobble(body=body, title=title)
    table = tomllib.loads(tomli_w.dumps(question.to_table()))
    assert table.pop("compute") == "wobble"
    back = Wobble.from_table(table)
    assert (bits(back.body), back.title) == (bits(question.body), question.title)
    assert back.to_table() == question.to_table()

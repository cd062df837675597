"""Running: only what a scene needs, and the same every time."""

import os
import shutil
from collections import OrderedDict
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin import Scene, SceneError, load_scene, scenes
from earthspin.engine.run import Run
from earthspin.numerics.arrays import FloatArray
from earthspin.questions import averages, iau_comparison
from earthspin.scenes import run, run_tree
from earthspin.sky import ephemeris
from earthspin.sky.poles import Direction, FixedPole, PoleModel
from tests.blocks import run_blocks


class MyPole(PoleModel):
    """A fixed pole that its owner can change."""

    declination = 0.0

    def at_epoch(self) -> FixedPole:
        return FixedPole(5.0, self.declination)

    def mean(self, days: FloatArray) -> FloatArray:
        return self.at_epoch().mean(days)

    def equator(self, orbit: Direction | None, *moving: object) -> FloatArray:
        return self.at_epoch().equator(orbit)


def opened_kernels(monkeypatch: pytest.MonkeyPatch) -> list[ephemeris.Ephemeris]:
    """Every kernel that is opened from now on; each counts what it is asked for.

    No samples of earlier runs are reused.
    """
    monkeypatch.setattr(averages.torque_samples, "_stored", OrderedDict())
    opened: list[ephemeris.Ephemeris] = []
    initialise = ephemeris.Ephemeris.__init__

    def watched(kernel: ephemeris.Ephemeris, *args: object, **kwargs: object) -> None:
        initialise(kernel, *args, **kwargs)
        opened.append(kernel)

    monkeypatch.setattr(ephemeris.Ephemeris, "__init__", watched)
    return opened


def test_the_moon_is_never_evaluated_under_the_sun_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    opened = opened_kernels(monkeypatch)
    run(load_scene("sun-only", {"source": "jplephem"}))
    (kernel,) = opened
    assert (3, 301) not in kernel.evaluations
    assert kernel.evaluations[(0, 10)] > 0


def test_a_thousand_bodies_evaluate_the_kernel_once(monkeypatch: pytest.MonkeyPatch) -> None:
    h = xr.DataArray(np.linspace(0.003, 0.0034, 1000), dims="draw")
    counts = []
    for body in (earthspin.EARTH, earthspin.EARTH.replace(dynamical_flattening=h)):
        opened = opened_kernels(monkeypatch)
        earthspin.precession(body=body, source="jplephem")
        counts.append(opened[0].evaluations)
    assert counts[0] == counts[1]
    assert counts[0][(3, 301)] > 0


def test_means_are_reused_for_equal_inputs_only(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    opened = opened_kernels(monkeypatch)
    kernel = tmp_path / "own.bsp"
    shutil.copy(ephemeris.find_kernel("de421"), kernel)
    heavy_moon = earthspin.MOON.replace(gm=1.01 * earthspin.MOON.gm)
    masses = xr.DataArray([1.0, 1.01], dims="mass") * earthspin.MOON.gm

    def rate(**keys: object) -> tuple[xr.DataArray, bool]:
        """Rate of precession, and whether the kernel was evaluated for it."""
        answer = earthspin.precession(source="jplephem", **keys)
        return answer.precession_rate.sel(perturber="total"), bool(opened[-1].evaluations)

    def pair(perturber: object) -> list[object]:
        return [earthspin.SUN, perturber]

    first, evaluated = rate(ephemeris=kernel)
    assert evaluated
    again, evaluated = rate(ephemeris=kernel, body=earthspin.EARTH.replace())
    assert not evaluated
    assert float(again) == float(first)
    for reused in (False, True):  # by Skyfield
        plan = earthspin.run_tree("precession", [])["plan"]
        assert plan.status.sel(part="torque-samples") == ("reused" if reused else "ran")
    # anything else is computed: another body, mass, span, or file under the same name
    slow = earthspin.EARTH.replace(spin_period="48 h")
    slower, _ = rate(ephemeris=kernel, body=slow)
    turns = slow.spin_period / earthspin.EARTH.spin_period
    assert float(slower) == pytest.approx(turns * float(first), rel=1e-14, abs=0)
    heavier, evaluated = rate(ephemeris=kernel, perturbers=pair(heavy_moon))
    assert evaluated
    assert float(heavier) > float(first)
    assert rate(ephemeris=kernel, span=("1920-01-01", "2050-01-01"))[1]
    for _ in range(2):  # arrays may change in place
        both, evaluated = rate(ephemeris=kernel, perturbers=pair(earthspin.MOON.replace(gm=masses)))
        assert evaluated
        assert np.allclose(both, [first, heavier], rtol=1e-13, atol=0)
    before = averages.window_means._stored.copy()
    rate(ephemeris=kernel, body=earthspin.EARTH.replace(j2=masses / earthspin.MOON.gm * 1e-3))
    assert averages.window_means._stored == before  # means of samples that are not stored
    pole = MyPole()
    rates = []
    for pole.declination in (0.9, 0.5):  # a pole of the user, who may change it
        mars = earthspin.MARS.replace(pole=pole)
        slow, evaluated = rate(ephemeris=kernel, body=mars, perturbers="sun")
        assert evaluated
        rates.append(float(slow))
    assert abs(rates[1] - rates[0]) > 0.1
    with kernel.open("r+b") as file:  # another comment in the same kernel
        file.seek(1024)
        file.write(b"edited")
    os.utime(kernel, (1e9, 1e9))
    assert rate(ephemeris=kernel)[1]


@pytest.mark.slow
def test_paths_of_the_pole_are_reused_for_other_dates_only(monkeypatch: pytest.MonkeyPatch) -> None:
    parts = iau_comparison.comparison, iau_comparison.response_fit
    span, dates = ["2000-01-01", "2000-01-03"], {"span": ["2001-01-01", "2001-01-03"]}
    heavy_moon = earthspin.MOON.replace(gm=1.01 * earthspin.MOON.gm)

    def pole(changed: dict[str, object], status: str) -> xr.DataTree:
        tree = run_tree(load_scene("pole", {"span": span, "step": "1 d"} | changed), [])
        assert {str(tree["plan"].status.sel(part=p.title).values) for p in parts} == {status}
        return tree

    for part in parts:
        monkeypatch.setattr(part, "_stored", OrderedDict())
    first = pole(dates, "ran")
    pole({"effects": ["planets", "j3", "geodesic", "nonrigid"]}, "ran")
    pole({"body": earthspin.EARTH.replace(dynamical_flattening=0.00328)}, "ran")
    pole({"perturbers": [earthspin.SUN, heavy_moon]}, "ran")
    pole({}, "reused")
    assert pole(dates, "reused").dataset.equals(first.dataset)


def test_both_forms_of_the_torque_agree_to_round_off() -> None:
    """The series uses (I.8.7); here the vector form, from the kernel and ERFA directly."""
    import erfa

    from earthspin.sky.ephemeris import open_ephemeris
    from earthspin.torque.gravity import torque_from_position

    series = earthspin.torque_series("1950-01-01", "1951-01-01", "1 d")
    days = (series.time.values - np.datetime64("2000-01-01T12")) / np.timedelta64(1, "D")
    matrix = erfa.pmat06(2451545.0, days)
    place = open_ephemeris("de421").positions({"sun": 10, "moon": 301}, 399, days)
    body = earthspin.EARTH
    bulge = body.j2 * body.mass * body.radius**2
    for one in (earthspin.SUN, earthspin.MOON):
        torque = torque_from_position(one.gm, bulge, place[one.name], matrix[:, 2])
        along = np.einsum("nij,nj->ni", matrix, torque)
        off = np.abs(series.torque.sel(perturber=one.name).values - along)
        assert off.max() < 2e-15 * float(series.torque_magnitude.max())  # measured: 5e-16


def test_blocks_are_the_series() -> None:
    scene = Scene(compute="torque", span=("2000-01-01", "2000-03-01"), step="20 s")
    blocks = list(run_blocks(scene))
    assert len(blocks) == 2
    whole = run(scene)
    joined = np.concatenate([b.torque.values for b in blocks])
    assert np.array_equal(joined, whole.torque.values)


@pytest.mark.parametrize(
    ("word", "end"), [("torque", "2000-01-01"), ("pole", "1999-02-15"), ("rotation", "1999-02-15")]
)
def test_a_stored_series_has_the_attributes_of_the_run(
    word: str, end: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The Moon was 2 % nearer after the first of 20 blocks, and the torque 5 % larger."""
    scene = Scene(compute=word, span=("1999-01-01", end), step="12 h")
    whole = run(scene)
    monkeypatch.setattr(scenes, "BLOCK", 37)
    stored = earthspin.open(earthspin.write_series(scene, tmp_path / "series.zarr"))
    if word == "rotation":  # the whole number is not known when the first block is written
        del whole.attitude_error.attrs["evaluations"]
    assert stored.attrs == whole.attrs
    for name, variable in whole.variables.items():
        assert stored[name].attrs == variable.attrs, name


def test_the_nearest_place_of_a_very_long_series_is_found() -> None:
    """Every n-th of 500,000 times: the smallest distance to 1e-4, the torque to 1e-3."""
    scene = Scene(compute="torque", span=("1905-01-01", "1995-01-01"), step="95 min")
    dense = earthspin.torque_series("1905-01-01", "1995-01-01", "95 min").distance.min("time")
    near = Run(scene)["nearest"]
    for name, distance in near.items():
        smallest = float(dense.sel(perturber=name))
        assert smallest <= distance < smallest * (1 + 1e-4)


def test_a_series_in_blocks_is_of_one_question(tmp_path: Path) -> None:
    scene = load_scene("torque", {"members": 3})
    with pytest.raises(SceneError) as error:
        earthspin.write_series(scene, tmp_path / "x.zarr")
    assert error.value.key == "members"
    with pytest.raises(SceneError):
        next(run_blocks(scene))


def test_a_scene_that_cannot_be_written_by_region(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="only a series of torques"):
        earthspin.write_series("wobble", tmp_path / "x.zarr")


def test_a_body_without_nutation_has_no_true_equator() -> None:
    with pytest.raises(SceneError, match="Mars"):
        earthspin.torque_series(
            "2000-01-01", "2000-01-02", "6 h", body="mars", perturbers=["sun"], equator="true"
        )


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("precession_rate_error_input", "dynamical_flattening"),
        ("mean_torque_error", "j2"),
        ("free_wobble_period_error", "dynamical_flattening"),
    ],
)
def test_input_errors_are_what_moving_the_input_gives(name: str, change: str) -> None:
    """Move a number by 1.96 of its standard deviations and see what the result does."""
    body = earthspin.EARTH
    u = 1e-4  # large enough to outweigh all else
    known = {**body.relative_uncertainty, change: u}
    moved = getattr(body, change) * (1 + 1.96 * u)
    other = {"dynamical_flattening": body.dynamical_flattening} if change == "j2" else {}
    scene = load_scene("precession")
    bodies = body.replace(relative_uncertainty=known), body.replace(**{change: moved}, **other)
    one, two = (earthspin.run_tree(scene.replace(body=each), "free_wobble") for each in bodies)
    if name.startswith("free_wobble"):
        one, two = one["free_wobble"], two["free_wobble"]
    base = name.split("_error")[0]
    shift = np.max(np.abs(two[base] - one[base]))
    assert np.isclose(float(np.max(one[name])), float(shift), rtol=0.03, atol=0)

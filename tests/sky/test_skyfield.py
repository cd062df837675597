"""Skyfield as a source: the same torques, rates and standstills as the fast reader gives."""

import erfa
import numpy as np
import pytest
import xarray as xr
from skyfield.api import load, load_file

import earthspin
from earthspin.engine.question import keys_of
from earthspin.sky import iau_models
from earthspin.sky.ephemeris import Ephemeris, find_kernel
from earthspin.sky.skyfield import Skyfield

TARGETS = {"sun": 10, "moon": 301, "mars": 499}
#: All that DE421 covers, at steps of 27.5 d.
DAYS = np.linspace(-36000.0, 19000.0, 2001)


@pytest.fixture(scope="module")
def skyfield() -> Skyfield:
    return Skyfield(find_kernel("de421"), "de421")


def apart(one: xr.DataArray, other: xr.DataArray) -> float:
    """Largest difference over the largest value."""
    return float(abs(one - other).max() / abs(one).max())


@pytest.mark.parametrize("equator", ["mean", "true"])
@pytest.mark.parametrize("year", [1900, 2000, 2052])
def test_torques_are_those_of_the_fast_reader(equator: str, year: int) -> None:
    span = (f"{year}-01-01", f"{year}-06-01")
    fast, slow = (
        earthspin.torque_series(*span, "6 h", equator=equator, source=source)
        for source in ("jplephem", "skyfield")
    )
    for name in ("declination", "right_ascension", "distance", "torque", "torque_magnitude"):
        # measured: 3e-12 at the mean equator; 1.6e-11 at the true one, most of it between the
        # nodes of the fast reader's nutation
        assert apart(fast[name], slow[name]) < 1e-10, name
    assert (slow.direction_error == fast.direction_error).all()


@pytest.mark.parametrize("scene", ["precession", "sun-only"])
def test_rates_are_those_of_the_fast_reader(scene: str) -> None:
    fast = earthspin.run(earthspin.load_scene(scene, {"source": "jplephem"}))
    slow = earthspin.run(scene)
    for name in ("precession_rate", "precession_period", "mean_torque", "obliquity"):
        assert apart(fast[name], slow[name]) < 1e-10, name  # measured: 2.4e-12


def test_standstills_are_those_of_the_fast_reader(precession_tree: xr.DataTree) -> None:
    slow = earthspin.run_tree(
        earthspin.load_scene("precession", {"source": "jplephem"}), "standstills"
    )
    ours, theirs = precession_tree["standstills"], slow["standstills"]
    assert (ours.standstill_kind == theirs.standstill_kind).all()
    assert apart(ours.standstill_declination, theirs.standstill_declination) < 1e-10
    # measured: 3e-12, and the same microsecond but for its rounding
    assert abs(ours.standstill.values - theirs.standstill.values).max() <= np.timedelta64(10, "us")


def test_no_position_comes_from_the_fast_reader(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise AssertionError("the fast reader was asked")

    monkeypatch.setattr(Ephemeris, "positions", refuse)
    monkeypatch.setattr(Ephemeris, "_step_positions", refuse)
    earthspin.torque_series("2000-01-01", "2000-02-01", "1 d", source="skyfield", equator="true")


@pytest.mark.parametrize("true", [False, True])
def test_declinations_are_those_of_erfa(skyfield: Skyfield, true: bool) -> None:
    """Positions by Skyfield itself, the equator of IAU 2006/2000A by ERFA at each time."""
    kernel, scale = load_file(str(find_kernel("de421"))), load.timescale(builtin=True)
    t = scale.tdb_jd(2451545.0, DAYS)
    matrix = (erfa.pnm06a if true else erfa.pmat06)(2451545.0, DAYS)
    equator = iau_models.true_equator if true else None
    for name, (ra, dec, distance) in skyfield.radec(TARGETS, 399, DAYS, equator).items():
        place = (kernel[TARGETS[name]] - kernel[399]).at(t).position.m.T
        x, y, z = np.einsum("tij,tj->it", matrix, place)
        assert np.abs(dec - np.arctan2(z, np.hypot(x, y))).max() < 5e-12  # measured: 1.8e-12
        off = (ra - np.arctan2(y, x) + np.pi) % (2 * np.pi) - np.pi
        assert np.abs(off).max() < 5e-12  # measured: 1.4e-12
        assert np.allclose(distance, np.linalg.norm(place, axis=1), rtol=1e-14, atol=0)
    kernel.close()


def test_it_is_radec_of_date_but_for_what_iau_2006_changed(skyfield: Skyfield) -> None:
    """Skyfield as it comes: 4e-11 rad by 2030, and 1.3e-10 rad in 1900, where J2 was larger."""
    kernel, scale = load_file(str(find_kernel("de421"))), load.timescale(builtin=True)
    found = skyfield.radec({"moon": 301}, 399, DAYS, iau_models.true_equator)["moon"][1]
    _, dec, _ = (kernel["moon"] - kernel["earth"]).at(scale.tdb_jd(2451545.0, DAYS)).radec("date")
    off = np.abs(found - dec.radians)
    assert 2e-11 < off[abs(DAYS) < 10957].max() < 5e-11  # measured: 4.2e-11
    assert 1e-10 < off.max() < 1.5e-10  # measured: 1.27e-10
    kernel.close()


def test_equator_and_declination_are_one(skyfield: Skyfield) -> None:
    days = DAYS[::100]
    place = skyfield.positions(TARGETS, 399, days)["moon"]
    x, y, z = np.einsum("tij,tj->it", skyfield.equator(days), place)
    _, dec, _ = skyfield.radec(TARGETS, 399, days, None)["moon"]
    assert np.allclose(np.arctan2(z, np.hypot(x, y)), dec, rtol=0, atol=1e-15)


@pytest.mark.slow
def test_both_readers_answer_every_question_that_opens_a_kernel() -> None:
    """With the same numbers: 1e-9 of the largest is required, 1e-11 and less measured."""
    from earthspin.scenes import QUESTIONS

    short = {
        "torque": {"span": ["2000-01-01", "2000-03-01"], "step": "1 d"},
        "pole": {"span": ["2000-01-01", "2001-01-01"], "step": "30 d"},
        "iau": {"span": ["2000-01-01", "2001-01-01"], "step": "30 d"},
        "rotation": {"span": ["2000-01-01", "2000-01-03"], "step": "6 h"},
        "long-term": {"span": ["-10 kyr", "0 kyr"]},
        "insolation": {"span": ["-10 kyr", "0 kyr"]},
    }
    words = [word for word, question in QUESTIONS.items() if "source" in keys_of(question)]
    assert set(short) <= set(words)
    for word in words:
        answers = [
            earthspin.run(earthspin.load_scene(word, {**short.get(word, {}), "source": source}))
            for source in ("jplephem", "skyfield")
        ]
        for name, values in answers[0].data_vars.items():
            # a closure is a small difference of large rates, which are compared themselves
            if values.dtype.kind == "f" and not {"error", "closure"} & {*str(name).split("_")}:
                scale = float(abs(values).max()) or 1.0
                difference = float(abs(values - answers[1][name]).max())
                assert difference <= 1e-9 * scale, (word, name, difference / scale)


def test_more_times_than_a_block(skyfield: Skyfield) -> None:
    days = np.linspace(0.0, 300.0, 5001)
    whole = skyfield.radec({"moon": 301}, 399, days, None)["moon"]
    for index in (0, 4095, 4096, 5000):
        one = skyfield.radec({"moon": 301}, 399, days[index : index + 1], None)["moon"]
        assert [of[0] for of in one] == pytest.approx([of[index] for of in whole], rel=1e-15, abs=0)


def test_a_body_with_a_pole_of_its_own() -> None:
    fast, slow = (
        earthspin.torque_series(
            "2000-01-01", "2000-03-01", "1 d", body="mars", perturbers="sun", source=source
        )
        for source in ("jplephem", "skyfield")
    )
    assert apart(fast.torque, slow.torque) < 1e-13  # measured: 2e-15


def test_times_outside_the_kernel(skyfield: Skyfield) -> None:
    with pytest.raises(earthspin.CoverageError, match="1899-07-29"):
        earthspin.torque_series("1899-01-01", "1899-02-01", "1 d", source="skyfield")
    for call in (skyfield.positions, lambda *a: skyfield.radec(*a, None)):
        with pytest.raises(earthspin.CoverageError):
            call(TARGETS, 399, np.array([np.nan]))

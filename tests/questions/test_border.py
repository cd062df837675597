"""One typed border: every argument of every call is checked once, and refused in one line."""

import datetime as dt
import math
import warnings
from typing import Any

import astropy.units as u
import numpy as np
import pandas as pd
import pytest
import xarray as xr

import earthspin
from earthspin import EARTH, Body, BodyError, EarthspinError, SceneError, UnitsError
from earthspin.constants import JULIAN_YEAR

MOMENTS, OMEGA = [1.0, 2.0, 2.5], [0.1, 1.0, 0.1]
TOP: dict[str, Any] = {
    "transverse_moment": 1.0,
    "axial_moment": 1.2,
    "weight_moment": 1.5,
    "theta": 0.7,
    "spin": 3.0,
}


def seconds(answer: xr.Dataset) -> list[float]:
    assert answer.time.attrs["units"] == "s"
    found: list[float] = answer.time.values.tolist()
    return found


# --- what was taken for something else -------------------------------------------------------


@pytest.mark.parametrize(
    "times",
    [
        [0.0, 1.0] * u.hour,
        ["0 h", "1 h"],
        [0.0 * u.hour, 60 * u.min],
        [dt.timedelta(0), dt.timedelta(hours=1)],
        np.array([0, 60], "m8[m]"),
        pd.to_timedelta(["0 h", "1 h"]),
        xr.DataArray([0.0, 1.0], dims="time", attrs={"units": "h"}),
        (0, "1 h"),
    ],
    ids=["Quantity", "text", "mixed units", "timedelta", "m8", "pandas", "labelled", "mixed"],
)
def test_times_carry_their_unit(times: object) -> None:
    assert seconds(earthspin.free_rotor(MOMENTS, OMEGA, times)) == [0.0, 3600.0]
    assert seconds(earthspin.heavy_top(times, **TOP)) == [0.0, 3600.0]


@pytest.fixture(scope="module")
def chi() -> xr.Dataset:
    pole = earthspin.polar_motion(span=("1990-01-01", "1992-01-01"))
    return earthspin.excitation(pole, period=432.5, quality_factor=101)


@pytest.mark.parametrize(
    "period",
    [1.2 * u.yr, "1.2 yr", dt.timedelta(days=438.3), 1.2 * 365.25, 1.2 * JULIAN_YEAR * u.s],
    ids=["Quantity", "text", "timedelta", "days", "seconds"],
)
def test_a_period_carries_its_unit(chi: xr.Dataset, period: object) -> None:
    found = earthspin.polar_motion_from(chi, period=period)
    expected = earthspin.polar_motion_from(chi, period="438.3 d")
    # 438.3 d in every form; the last digit is that of the conversion
    xr.testing.assert_allclose(found, expected, rtol=1e-13, atol=1e-14)
    pole = earthspin.polar_motion(span=("1990-01-01", "1992-01-01"))
    driven = earthspin.excitation(pole, period=period)
    assert driven.attrs["chandler_period"] == pytest.approx(438.3, rel=1e-15, abs=0)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"period": "1.2 kg"}, "period"),
        ({"period": 0.0}, "greater than zero"),
        ({"period": math.nan}, "finite"),
        ({"period": [430.0, 431.0]}, "one number"),
        ({"quality_factor": -1.0}, "greater than zero"),
        ({"quality_factor": "much"}, "quality_factor"),
        ({"quality_factor": 100 * u.s}, "quality_factor"),
        ({"start": [1.0]}, "shape"),
        ({"start": [1.0, math.inf]}, "finite"),
        ({"start": ["1 mas", "1 kg"]}, "start"),
    ],
)
def test_what_does_not_drive_a_pole(chi: xr.Dataset, keys: dict[str, Any], words: str) -> None:
    with pytest.raises((SceneError, UnitsError), match=words):
        earthspin.polar_motion_from(chi, **keys)


def test_a_start_carries_its_unit(chi: xr.Dataset) -> None:
    plain = earthspin.polar_motion_from(chi, start=[50.0, 300.0])
    for start in ([50, 300] * u.mas, ["0.05 arcsec", "300 mas"], ("50 mas", "300 mas")):
        found = earthspin.polar_motion_from(chi, start=start)
        xr.testing.assert_allclose(found, plain, rtol=1e-13, atol=0)


def test_windows_carry_their_unit() -> None:
    pole = earthspin.polar_motion(span=("1962-01-01", "2000-01-01"))
    plain = earthspin.fit_chandler(pole, window=4383.0)
    xr.testing.assert_identical(earthspin.fit_chandler(pole, window=12 * u.yr), plain)
    for wrong in ("12 kg", [4383.0, 1.0], math.nan, 0.0):
        with pytest.raises((SceneError, UnitsError), match="window"):
            earthspin.fit_chandler(pole, window=wrong)


# --- masks, and members that do not align ----------------------------------------------------


_PLACES = [[0.0, 0, 0], [1, 0, 0], [0, 1, 0.5]]
_CORNERS = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
_FACES = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]


def _of_torque(torque: Any) -> Any:
    return earthspin.rotation(
        "2000-01-01", "2000-01-02", "12 h", perturbers=[], effects=[], torque=lambda *_: torque
    )


#: Calls that take arrays, each with arrays of the right shape, to which the shares of `SPOILT` are
#: added.
TAKES_ARRAYS = {
    "masses": (np.ones(3), lambda m: Body.from_masses(m, _PLACES)),
    "positions": (np.array(_PLACES), lambda r: Body.from_masses([1.0, 1, 1], r)),
    "density": (np.ones((1, 1, 2)), lambda d: Body.from_density(d, [0, 1], [0, 1], [0, 1, 2])),
    "edges": (np.arange(3.0), lambda z: Body.from_density(np.ones((1, 1, 2)), [0, 1], [0, 1], z)),
    "vertices": (np.array(_CORNERS), lambda v: Body.from_mesh((v, _FACES), density=1.0)),
    "faces": (np.array(_FACES), lambda f: Body.from_mesh((_CORNERS, f), density=1.0)),
    "torque": (np.array([0.0, 0.0, 1e20]), _of_torque),
    "start": (
        np.array([0.0, 0.0, 7e-5]),
        lambda w: earthspin.rotation(
            "2000-01-01", "2000-01-02", "12 h", perturbers=[], effects=[], start_omega=w
        ),
    ),
    "frame": (
        np.eye(3),
        lambda axes: earthspin.read_orbit(
            pd.DataFrame(dict.fromkeys("tkhqp", np.arange(-20.0, 1.0))), frame=axes
        ),
    ),
}


def _of_objects(array: Any, last: object) -> Any:
    array = array.astype(object)
    array.flat[-1] = last
    return array


SPOILT = {
    "masked": lambda a: np.ma.masked_array(a, np.arange(a.size).reshape(a.shape) == a.size - 1),
    "rows masked": lambda a: [np.ma.masked_array(row, np.ones_like(row)) for row in a],
    "complex": lambda a: a + 1j,
    "complex Quantity": lambda a: (a + 1j) * u.one,
    "text": lambda a: a.astype(str),
    "objects, one a text": lambda a: _of_objects(a, "1"),
    "objects, one complex": lambda a: _of_objects(a, 1j),
    "objects, one None": lambda a: _of_objects(a, None),
    "truth": lambda a: np.ones(a.shape, dtype=bool),
    "nothing": lambda a: a[:0],
}


@pytest.mark.parametrize("spoilt", SPOILT.values(), ids=SPOILT)
@pytest.mark.parametrize(("array", "call"), TAKES_ARRAYS.values(), ids=TAKES_ARRAYS)
def test_no_array_loses_a_part_on_its_way_in(array: Any, call: Any, spoilt: Any) -> None:
    """A masked number is not used, an imaginary part not dropped, text not read."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(EarthspinError):
            call(spoilt(array))


def test_columns_of_an_orbit_are_real_numbers() -> None:
    rows = pd.DataFrame({"t": np.arange(-20.0, 1.0), "k": 0.01, "h": 0.0, "q": 0.0, "p": 0.0})
    for k in (0.01 + 1e-9j, "0.01", True, None):
        with pytest.raises(EarthspinError):
            earthspin.read_orbit(rows.assign(k=k))


def test_a_torque_is_converted_to_newton_metres() -> None:
    plain, quantity = _of_torque([0.0, 0.0, 1e23]), _of_torque([0, 0, 1e20] * u.kN * u.m)
    np.testing.assert_array_equal(plain.omega, quantity.omega)


@pytest.mark.parametrize(
    "values", [["a"], [1e-3 + 1j], [None], [True], []],
    ids=["text", "complex", "None", "truth", "nothing"],
)  # fmt: skip
def test_labelled_arrays_of_a_body_are_real_numbers(values: list[Any]) -> None:
    array = xr.DataArray(np.array(values), dims="case")
    for call in (EARTH.replace, lambda j2: earthspin.wobble_ladder(body={"j2": j2})):
        with pytest.raises(EarthspinError, match="j2"):
            call(j2=array)


def test_labelled_arrays_of_a_body_are_converted_from_their_units() -> None:
    plain = xr.DataArray([6.0e6, 6.5e6], dims="case")
    in_km = xr.DataArray([6000.0, 6500.0], dims="case", attrs={"units": "km"})
    found = EARTH.replace(radius=in_km).radius
    np.testing.assert_array_equal(found, plain)


def labelled(values: list[float], labels: list[Any] | None = None) -> xr.DataArray:
    return xr.DataArray(values, {} if labels is None else {"draw": labels}, ("draw",))


MISALIGNED = {
    "other labels": (labelled([1.0, 1.1], ["a", "b"]), labelled([1.0, 1.1], ["a", "c"])),
    "another order": (labelled([1.0, 1.1], ["a", "b"]), labelled([1.0, 1.1], ["b", "a"])),
    "other numbers": (labelled([1.0, 1.1], [0, 1]), labelled([1.0, 1.1], [1, 2])),
    "another length": (labelled([1.0, 1.1]), labelled([1.0, 1.1, 1.2])),
    "another length with labels": (labelled([1.0, 1.1], [0, 1]), labelled([1.0, 1, 1], [0, 1, 2])),
    "labels of another sort": (labelled([1.0, 1.1], ["a", "b"]), labelled([1.0, 1.1], [0, 1])),
}


@pytest.mark.parametrize("form", MISALIGNED)
def test_members_that_do_not_align_are_refused(form: str) -> None:
    one, two = MISALIGNED[form]
    with pytest.raises(BodyError, match="differ") as error:
        EARTH.replace(
            j2=EARTH.j2 * one,
            dynamical_flattening=EARTH.dynamical_flattening * one,
            radius=6e6 * two,
        )
    assert "draw" in str(error.value)


def test_members_that_align_are_taken() -> None:
    for one, two in (
        (labelled([1.0, 1.1], ["a", "b"]), labelled([1.0, 1.2], ["a", "b"])),
        (labelled([1.0, 1.1], ["a", "b"]), labelled([1.0, 1.2])),
    ):
        body = EARTH.replace(
            dynamical_flattening=EARTH.dynamical_flattening * one, gm=EARTH.gm * two
        )
        rate = earthspin.precession(body=body).precession_rate.sel(perturber="total")
        assert rate.sizes == {"draw": 2}
        assert float(rate[1] / rate[0]) == pytest.approx(1.1, rel=1e-14, abs=0)


# --- every argument of every call; tests/test_units.py has every way to be wrong ----------------


def rotor(**keys: Any) -> xr.Dataset:
    return earthspin.free_rotor(**({"moments": MOMENTS, "omega": OMEGA, "times": [0.0]} | keys))


def top(**keys: Any) -> xr.Dataset:
    return earthspin.heavy_top(**({"times": [0.0]} | TOP | keys))


def field(**keys: Any) -> xr.Dataset:
    return earthspin.spheroid_field(**({"position": [[7e6, 0.0, 0.0]]} | keys))


def series(**keys: Any) -> xr.Dataset:
    return earthspin.torque_series(
        **({"start": "2000-01-01", "stop": "2000-01-02", "step": "6 h"} | keys)
    )


#: One value of each kind of argument that is none; tests/fuzz has thousands.
WRONG = [
    (rotor, "moments", [1.0, 2.0, 2.5, 3.0]),
    (rotor, "moments", ["1 kg", "2 kg", "2.5 kg"]),
    (rotor, "omega", [[0.1, 1.0, 0.1], [0.1, 1.0]]),
    (rotor, "times", [0.0, 1.0] * u.kg),
    (rotor, "times", np.array(["2000-01-01"], "M8[s]")),
    (rotor, "points", 2.5),
    (top, "theta", "40 m"),
    (top, "times", ["0", "1"]),
    (top, "spin", 3 * u.s),
    (top, "axial_moment", None),
    (field, "position", [["7000 km", "0 km", "0 kg"]]),
    (series, "start", 2000),
    (series, "stop", np.datetime64("NaT", "D")),
    (series, "body", {"gm": np.ma.masked}),
    (series, "body", {"pole": ["1 deg", "1 kg"]}),
    (series, "body", {"observed_wobble": {"value": 5.0, "unit": "km", "source": "x"}}),
    (series, "body", {"relative_uncertainty": {"foo": 1.0}}),
    (series, "ephemeris", 7),
    (earthspin.rotation, "tolerance", "1 mas"),
    (earthspin.precession, "span", ["2000-01-01"]),
    (earthspin.pole, "effects", [3]),
    (earthspin.pole, "times", [1.0, 2.0]),
    (earthspin.wobble_ladder, "anelastic_exponent", "0.1 s"),
    (earthspin.polar_motion, "window", 0.0),
    (earthspin.polar_motion, "file", 3),
]


@pytest.mark.parametrize(
    ("call", "name", "value"), WRONG, ids=[f"{c.__name__}-{n}-{v!r}" for c, n, v in WRONG]
)
def test_what_is_wrong_is_one_line_that_names_it(call: Any, name: str, value: Any) -> None:
    instead = {"times": None} if name in ("points", "duration") else {}
    with pytest.raises(EarthspinError) as error:
        call(**instead, **{name: value})
    text = str(error.value)
    assert {"start": "span", "stop": "span"}.get(name, name) in text
    assert "\n" not in text
    assert len(text) < 500


@pytest.mark.parametrize(
    ("one", "two"),
    [
        (lambda: series(step=21600.0), lambda: series(step=6 * u.h)),
        (lambda: series(step="360 min"), lambda: series(step=np.timedelta64(6, "h"))),
        (lambda: top(theta=0.5 * u.rad), lambda: top(theta="0.5 rad")),
        (lambda: rotor(moments=[1000, 2000, 2500] * u.g * u.m**2), lambda: rotor()),
        (lambda: field(position=[[7000, 0, 0]] * u.km), lambda: field(position=[7e6, 0, 0])),
        (lambda: field(point_mass="1000 g"), lambda: field()),
        (lambda: series(perturbers="moon"), lambda: series(perturbers=("moon",))),
        (lambda: series(body="EARTH"), lambda: series(body=EARTH)),
        (lambda: series(body={"from": "earth"}), lambda: series()),
        (lambda: series(start=dt.date(2000, 1, 1)), lambda: series(start="2000-01-01 00:00")),
        (lambda: series(start=pd.Timestamp("2000-01-01")), lambda: series()),
    ],
)
def test_all_forms_of_a_value_give_the_same(one: Any, two: Any) -> None:
    first, second = one(), two()
    xr.testing.assert_allclose(first, second, rtol=1e-15, atol=0)


# --- arguments of newer calls ----------------------------------------------------------------

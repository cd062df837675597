"""Datasets: the conventions that every result keeps."""

import astropy.units as u
import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin.dataset import SchemaError, Variable, build
from earthspin.scene.parts import PARTS

#: Physical type by unit: what a unit must mean for a variable that carries it.
KINDS = {
    "arcsec/yr": "angular speed",
    "yr": "time",
    "d": "time",
    "s": "time",
    "deg": "angle",
    "arcsec": "angle",
    "mas": "angle",
    "uas": "angle",
    "m": "length",
    "N m": "torque",
    "kg m2": "moment of inertia",
    "1": "dimensionless",
}


@pytest.fixture(
    scope="module",
    params=["precession", "sun-only", "torque", "wobble", "polar-motion", "pole", "iau"],
    ids=lambda name: name,
)
def result(request: pytest.FixtureRequest) -> xr.Dataset:
    return earthspin.run(request.param)


def test_every_variable_is_described(result: xr.Dataset) -> None:
    for name, variable in result.data_vars.items():
        assert variable.attrs["long_name"], name
        assert variable.dtype.kind in "fUM", name
        if variable.dtype.kind == "f":
            unit = u.Unit(variable.attrs["units"])
            kinds = str(unit.physical_type) if unit != u.one else "dimensionless"
            assert KINDS[variable.attrs["units"]] in kinds, (name, kinds)


def test_errors_are_ancillary_and_positive(result: xr.Dataset) -> None:
    for name in result.data_vars:
        if not str(name).endswith("_error"):
            continue
        base = str(name).removesuffix("_error")
        # PREM comes without an error of its H.
        assert float(result[name].min()) >= (0 if name == "flattening_error" else 1e-300), name
        if base in result:
            assert name in result[base].attrs["ancillary_variables"].split()
            assert result[name].attrs["units"] == result[base].attrs["units"]


def test_no_number_is_missing(result: xr.Dataset) -> None:
    for name, variable in result.variables.items():
        if name == "quality_factor":  # infinite where nothing is lost
            assert np.all(variable > 0)
        elif variable.dtype.kind == "f":
            assert np.all(np.isfinite(variable)), name


def test_attributes_are_text_and_numbers(result: xr.Dataset) -> None:
    holders = [result.attrs, *(v.attrs for v in result.variables.values())]
    for attributes in holders:
        for key, value in attributes.items():
            assert type(value) in (str, int, float), key
    assert result.attrs["Conventions"].startswith("CF-")
    assert result.attrs["earthspin_version"] == earthspin.__version__


def test_the_plan_is_data(result: xr.Dataset) -> None:
    assert set(result.part.values) == set(PARTS)
    ran = result.part_status == "ran"
    assert set(np.unique(result.part_status)) <= {"ran", "left out"}
    assert np.all(result.part_run_time.where(ran, drop=True) > 0)
    assert np.all(result.part_run_time.where(~ran, drop=True) == 0)
    assert np.all(result.part_reason != "")


def test_without_its_cost_a_result_is_the_same_bit_for_bit(result: xr.Dataset) -> None:
    again = earthspin.run(result.attrs["title"] and _scene_of(result))
    xr.testing.assert_identical(result.drop_dims("part"), again.drop_dims("part"))


def _scene_of(result: xr.Dataset) -> str:
    titles = {
        "Precession of the equinoxes": "precession",
        "Free wobble, from the rigid to the yielding body": "wobble",
        "Observed polar motion and the free wobble in it": "polar-motion",
        "The pole in time": "pole",
        "Our pole beside IAU 2006/2000A": "iau",
    }
    title = result.attrs["title"]
    return titles.get(title) or ("sun-only" if "alone" in title else "torque")


SCHEMA = {"x": Variable(("time",), "deg", "an angle")}


def test_values_are_turned_from_si() -> None:
    built = build("p", SCHEMA, {"x": np.array([np.pi])})
    assert built.x.values == pytest.approx([180.0], rel=1e-15, abs=0)
    assert built.x.attrs == {"long_name": "an angle", "part": "p", "units": "deg"}


def test_a_part_must_keep_its_word() -> None:
    with pytest.raises(SchemaError, match="declares"):
        build("p", SCHEMA, {})
    with pytest.raises(SchemaError, match="declares"):
        build("p", SCHEMA, {"x": xr.DataArray([1.0], dims="other")})


def test_extra_dimensions_come_last() -> None:
    values = xr.DataArray(np.ones((2, 3)), dims=("draw", "time"))
    assert build("p", SCHEMA, {"x": values}).x.dims == ("time", "draw")

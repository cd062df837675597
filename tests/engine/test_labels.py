"""Datasets: the conventions that every answer and every section keeps."""

from collections.abc import Iterator

import astropy.units as u
import numpy as np
import pytest
import xarray as xr

import earthspin
from earthspin import UndefinedError
from earthspin.engine.variables import FROM_SI, Variables, number, si
from tests import shipped


@pytest.fixture(
    scope="module",
    params=["precession", "sun-only", "torque", "wobble", "polar-motion", "pole", "iau"],
    ids=lambda name: name,
)
def tree(request: pytest.FixtureRequest) -> xr.DataTree:
    return shipped.tree(request.param)


@pytest.fixture(scope="module")
def nodes(tree: xr.DataTree) -> dict[str, xr.Dataset]:
    """The answer and its sections."""
    plain = {path: node.to_dataset(inherit=False) for path, node in tree.subtree_with_keys}
    return {path: node for path, node in plain.items() if path != "plan"}


def variables_of(nodes: dict[str, xr.Dataset]) -> Iterator[tuple[str, xr.DataArray]]:
    for node in nodes.values():
        yield from ((str(name), variable) for name, variable in node.data_vars.items())


def test_every_variable_is_described(nodes: dict[str, xr.Dataset]) -> None:
    for name, variable in variables_of(nodes):
        assert variable.attrs["long_name"], name
        assert variable.dtype.kind in "fiUM", name
        if variable.dtype.kind == "f":
            assert variable.attrs["units"] in FROM_SI, name
            assert u.Unit(variable.attrs["units"]).physical_type != "unknown", name


def test_errors_are_ancillary_and_positive(nodes: dict[str, xr.Dataset]) -> None:
    for result in nodes.values():
        for name in result.data_vars:
            if not str(name).endswith("_error"):
                continue
            base = str(name).removesuffix("_error")
            # an effect that is off contributes nothing, exactly
            exact = name in ("psi_rate_error", "omega_rate_error")
            assert float(result[name].min()) >= (0 if exact else 1e-300), name
            if base in result:
                assert name in result[base].attrs["ancillary_variables"].split()
                assert result[name].attrs["units"] == result[base].attrs["units"]


def test_no_number_is_missing(nodes: dict[str, xr.Dataset]) -> None:
    every = [item for node in nodes.values() for item in node.variables.items()]
    for name, variable in every:
        if name == "quality_factor":  # infinite where nothing is lost
            assert np.all(variable > 0)
        elif variable.dtype.kind == "f":
            assert np.all(np.isfinite(variable)), name


def test_attributes_are_text_and_numbers(nodes: dict[str, xr.Dataset]) -> None:
    result = nodes["."]
    holders = [node.attrs for node in nodes.values()]
    holders += [v.attrs for node in nodes.values() for v in node.variables.values()]
    for attributes in holders:
        for key, value in attributes.items():
            assert type(value) in (str, int, float), key
    assert "Conventions" not in result.attrs
    assert result.attrs["earthspin_version"] == earthspin.__version__


class Angles(Variables, along=("time",)):
    """One variable."""

    x = number("deg", "an angle")


def test_values_are_turned_from_si() -> None:
    laid = Angles(x=np.array([np.pi])).dataset()
    assert laid.x.values == pytest.approx([180.0], rel=1e-15, abs=0)
    assert laid.x.attrs == {"long_name": "an angle", "units": "deg"}


def test_extra_dimensions_come_last() -> None:
    values = xr.DataArray(np.ones((2, 3)), dims=("draw", "time"))
    assert Angles(x=values).dataset().x.dims == ("time", "draw")


def test_numbers_that_are_missing_are_refused_in_one_line() -> None:
    with pytest.raises(UndefinedError, match="an angle is undefined"):
        Angles(x=np.array([np.nan])).dataset()


def test_a_unit_that_is_not_known_is_not_taken_for_si() -> None:
    """A radius in km once came back as 7,000,000 of them."""

    class Far(Variables):
        """One variable in a unit that no result is shown in."""

        length = number("km", "a length")

    far = xr.DataArray(7000.0, attrs={"units": "km"})
    with pytest.raises(earthspin.SceneError, match="units = 'km'"):
        si(far)
    with pytest.raises(earthspin.SceneError, match="units = 'km'"):
        Far(length=7e6).dataset()
    assert float(si(xr.DataArray(2.0, attrs={"units": "d"}))) == 172800.0


def test_every_number_has_an_error_or_says_why_not(nodes: dict[str, xr.Dataset]) -> None:
    root = set(nodes[next(iter(nodes))].data_vars)
    for path, result in nodes.items():
        for name, of in result.data_vars.items():
            an_error = "_error" in str(name) or str(name).startswith("error_")
            if path == "plan" or of.dtype.kind != "f" or an_error:
                continue
            named = of.attrs.get("ancillary_variables", "").split()
            assert bool(named) != bool(of.attrs.get("no_error")), (path, name)
            assert set(named) <= set(result.data_vars) | root, (path, name)


#: Ends of texts that hold for numbers of several units: a relative error, a share, a comparison.
FOR_SEVERAL = ("relative_error holds", "a share of an error", "for comparison with the others")


@pytest.mark.parametrize("scene", sorted(shipped.SCENES.values()))
def test_a_reason_for_no_error_is_that_of_one_kind_of_number(scene: str) -> None:
    """Every float of every shipped scene has an error, or a text that no other unit shares."""
    for path, node in shipped.tree(scene).subtree_with_keys:
        units: dict[str, set[str]] = {}
        for name, of in node.to_dataset(inherit=False).data_vars.items():
            if path == "plan" or of.dtype.kind != "f" or "error" in str(name).split("_"):
                continue
            reason = of.attrs.get("no_error", "")
            assert reason or of.attrs.get("ancillary_variables"), (path, name)
            units.setdefault(reason, set()).add(of.attrs["units"])
        shared = {reason for reason, found in units.items() if reason and len(found) > 1}
        assert not {reason for reason in shared if not reason.endswith(FOR_SEVERAL)}, path

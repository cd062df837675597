"""What came of the accuracy that a scene asks for: asked, estimated, chosen."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.dataset import Schema, Variable
from earthspin.scene.part import Part
from earthspin.scene.parts.conditions import asked_angle, refuse_unkept, without_accuracy

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.spec import Scene


def pole_accuracy(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Asked, estimated, chosen: of the pole."""
    return _report(POLE_ACCURACY, given["pole"].direction_error, asked_angle(scene))


def rate_accuracy(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Asked, estimated, chosen: of the rate of precession by all perturbers."""
    rates = given["mean-rates"].isel(perturber=-1)
    relative = rates.precession_rate_error / abs(rates.precession_rate)
    attrs = rates.precession_rate_error.attrs
    relative.attrs = {name: attrs[name] for name in ("method", "evaluations")}
    return _report(RATE_ACCURACY, relative, float(scene.accuracy))


def series_accuracy(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Asked, estimated, chosen: of the directions of a torque series."""
    return _report(SERIES_ACCURACY, given["torque-series"].direction_error, asked_angle(scene))


def rotation_accuracy(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Asked and kept: by the closed form of the free rotor."""
    from earthspin.rotor.triaxial import CLOSED_FORM_ERROR

    size = given["free-rotation"].attitude.size // 4
    return _closed_form(scene, ROTATION_ACCURACY, "Jacobi's closed form", CLOSED_FORM_ERROR, size)


def top_accuracy(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Asked and kept: by the closed form of the heavy top."""
    from earthspin.scene.parts.tops import TOP
    from earthspin.scene.tables import read_table
    from earthspin.top.rounding import error_bound
    from earthspin.top.start import HeavyTop

    settings = read_table(TOP, scene)
    times = settings.pop("times")
    bound = error_bound(HeavyTop(**settings), times)
    return _closed_form(scene, TOP_ACCURACY, "elliptic functions", bound, times.size)


def field_accuracy(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Asked and kept: by the closed form of the spheroid's field."""
    from earthspin.mass.spheroid import CLOSED_FORM_ERROR

    size = given["spheroid-field"].sizes["point"]
    return _closed_form(scene, FIELD_ACCURACY, "exact closed form", CLOSED_FORM_ERROR, size)


def _closed_form(
    scene: Scene, part: Part, words: str, bound: float, evaluations: int
) -> xr.Dataset:
    """Report of a method without settings, or a refusal."""
    import xarray as xr

    remedy = "no float of 64 bits carries more; ask for less"
    refuse_unkept(scene.accuracy, bound, "(relative)", remedy)
    error = xr.DataArray(bound, attrs={"method": words, "evaluations": evaluations})
    return _report(part, error, float(scene.accuracy))


def _report(part: Part, error: xr.DataArray, asked: float | None) -> xr.Dataset:
    from earthspin.dataset import build, si

    result = build(
        part.name,
        part.gives,
        {
            "error_asked": asked,
            "error_estimated": float(si(error).max()),
            "method_chosen": error.attrs["method"],
            "evaluations": error.attrs["evaluations"],
        },
    )
    # as it was asked for: 1 arcsec is 1e6 uas, not a rounding less
    result["error_asked"].values[...] = float(f"{float(result.error_asked):.14g}")
    return result


def _gives(unit: str, of: str) -> Schema:
    return {
        "error_asked": Variable((), unit, f"error asked for, {of}"),
        "error_estimated": Variable((), unit, f"error estimated, at its largest, {of}"),
        "method_chosen": Variable((), "", "method and settings chosen for it"),
        "evaluations": Variable((), "1", "evaluations of the sky, or of terms of nutation"),
    }


def _accuracy_of(what: str, part: str, unit: str, of: str) -> Part:
    """Declare the report on one question."""
    return Part(
        name=f"{what}-accuracy",
        does=f"accuracy of the {what}: asked, estimated, and the method chosen",
        function=f"earthspin.scene.parts.accuracies:{what}_accuracy",
        needs=(part,),
        keys=("tables", "accuracy"),
        gives=_gives(unit, of),
        left_out=without_accuracy,
    )


POLE_ACCURACY = _accuracy_of("pole", "pole", "uas", "in direction")
RATE_ACCURACY = _accuracy_of("rate", "mean-rates", "1", "relative, of the rate by all perturbers")
SERIES_ACCURACY = _accuracy_of("series", "torque-series", "mas", "in direction")
ROTATION_ACCURACY = _accuracy_of(
    "rotation", "free-rotation", "1", "relative, of angular velocity and attitude"
)
TOP_ACCURACY = _accuracy_of(
    "top", "heavy-top", "1", "relative, of angles, angular velocity and attitude"
)
FIELD_ACCURACY = _accuracy_of(
    "field", "spheroid-field", "1", "relative, of potential, attraction and torque"
)

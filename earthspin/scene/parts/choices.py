"""Settings for the accuracy that a scene asks for, and what came of them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.dataset import Schema, Variable
from earthspin.scene.part import Part
from earthspin.scene.parts.conditions import asked_angle, needs_iau, without_accuracy

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.choosing import Choice
    from earthspin.scene.spec import Scene

#: Of what is asked for, what is given to the method, so that a result never claims more than asked.
MARGIN = 0.99


def chosen_windows(scene: Scene, given: Mapping[str, Any]) -> Choice | None:
    """Cheapest windows of the pole, or the most accurate; None where the sky was not measured."""
    from earthspin.bodies import BODIES, PLANETS
    from earthspin.constants import DAY
    from earthspin.mass.inertia import inverse_polar_moment
    from earthspin.scene.choosing import Turning, cheapest, window_choices
    from earthspin.scene.parts.axes_in_time import pole_times

    body, effects = scene.body, scene.effects or ()
    asked = asked_angle(scene) or math.inf
    h, j2 = float(body.needed("dynamical_flattening")), float(body.needed("j2"))
    pulls = {p.naif[0]: float(p.gm) for p in scene.perturbers}
    if "planets" in effects:
        others = (BODIES[name] for name in PLANETS if name != body.name)
        pulls = {p.naif[0]: float(p.gm) for p in others} | pulls
    first, last = pole_times(scene).span()
    turning = Turning(
        code=body.naif[0],
        h=h,
        triaxiality=inverse_polar_moment(j2, h) * float(body.triaxiality),
        spin_rate=float(body.spin_rate),
        gm=pulls,
        geodesic="geodesic" in effects and any(p.name == "sun" for p in scene.perturbers),
    )
    known = body.relative_uncertainty.get("dynamical_flattening", 0.0) == 0
    share = MARGIN if known else MARGIN / math.sqrt(2)
    menu = window_choices(turning, first * DAY, last * DAY)
    return cheapest(menu, asked * share) or min(menu, key=lambda c: c.error, default=None)


def chosen_average(scene: Scene, given: Mapping[str, Any]) -> Choice | None:
    """Cheapest window of an average over orbits, or None where the sky was not measured."""
    from earthspin.constants import DAY, NORMAL_95
    from earthspin.scene.choosing import Pushed, average_choices, cheapest
    from earthspin.sky.equator import angle, orbit_normal, pole_at
    from earthspin.torque.average import best_window

    body, sky = scene.body, given["ephemeris"]
    cycle = max(p.cycle for p in scene.perturbers)
    normal = orbit_normal(body.needed("pole"), body.orbit_pole)
    pushed = Pushed(
        code=body.naif[0],
        obliquity=angle(pole_at(body.needed("pole"), 0.0), normal),
        normal=normal,
        gm={p.naif[0]: float(p.gm) for p in scene.perturbers},
        slow_swing={p.naif[0]: p.slow_swing for p in scene.perturbers},
        cycle=cycle,
    )
    widest = best_window(sky.span[0] * DAY, sky.span[1] * DAY, cycle)
    # H and each GM scale the rate; that of the strongest pull stands for all
    u_gm = max(p.relative_uncertainty.get("gm", 0.0) for p in scene.perturbers)
    u_h = body.relative_uncertainty.get("dynamical_flattening", 0.0)
    room = scene.accuracy**2 - (NORMAL_95 * math.hypot(u_h, u_gm)) ** 2
    allowed = MARGIN * math.sqrt(room) if room > 0 else 0.0
    return cheapest(average_choices(pushed, widest.cycles), allowed)


def chosen_nutation(scene: Scene, given: Mapping[str, Any]) -> Choice | None:
    """Cheapest way to the true equator, next to what the kernel is off by."""
    from earthspin.scene.choosing import cheapest, nutation_choices

    sky, times = given["ephemeris"], given["times"]
    kernel = max(sky.ephemeris.error(code)[0] for code in sky.targets.values())
    left = (asked_angle(scene) or math.inf) - kernel
    first, last = times.span()
    return cheapest(nutation_choices(first, last, times.size), MARGIN * left)


# --- what came of it -----------------------------------------------------------------------------


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

    from earthspin.errors import AccuracyError

    if bound > scene.accuracy:
        raise AccuracyError(
            scene.accuracy, bound, "(relative)", "no float of 64 bits carries more; ask for less"
        )
    error = xr.DataArray(bound, attrs={"method": words, "evaluations": evaluations})
    return _report(part, error, float(scene.accuracy))


def _report(part: Part, error: xr.DataArray, asked: float | None) -> xr.Dataset:
    from earthspin.dataset import build, si

    return build(
        part.name,
        part.gives,
        {
            "error_asked": asked,
            "error_estimated": float(si(error).max()),
            "method_chosen": error.attrs["method"],
            "evaluations": error.attrs["evaluations"],
        },
    )


def _gives(unit: str, of: str) -> Schema:
    return {
        "error_asked": Variable((), unit, f"error asked for, {of}"),
        "error_estimated": Variable((), unit, f"error estimated, at its largest, {of}"),
        "method_chosen": Variable((), "", "method and settings chosen for it"),
        "evaluations": Variable((), "1", "evaluations of the sky, or of terms of nutation"),
    }


CHOSEN_WINDOWS = Part(
    name="chosen-windows",
    does="the cheapest windows of the pole that meet the accuracy asked for",
    function="earthspin.scene.parts.choices:chosen_windows",
    keys=("body", "perturbers", "effects", "accuracy", "span", "step", "times"),
    left_out=without_accuracy,
)

CHOSEN_AVERAGE = Part(
    name="chosen-average",
    does="the cheapest window and step of the averages that meet the accuracy asked for",
    function="earthspin.scene.parts.choices:chosen_average",
    needs=("ephemeris",),
    keys=("body", "perturbers", "accuracy"),
    left_out=without_accuracy,
)

CHOSEN_NUTATION = Part(
    name="chosen-nutation",
    does="the cheapest nutation that meets the accuracy asked for",
    function="earthspin.scene.parts.choices:chosen_nutation",
    needs=("times", "ephemeris"),
    keys=("accuracy",),
    left_out=lambda scene: (
        without_accuracy(scene)
        or ("the equator is the mean one" if scene.equator == "mean" else needs_iau(scene))
    ),
)

#: The parts that choose.
CHOOSING = (CHOSEN_WINDOWS.name, CHOSEN_AVERAGE.name, CHOSEN_NUTATION.name)

POLE_ACCURACY = Part(
    name="pole-accuracy",
    does="accuracy of the pole: asked, estimated, and the method chosen",
    function="earthspin.scene.parts.choices:pole_accuracy",
    needs=("pole",),
    keys=("accuracy",),
    gives=_gives("uas", "in direction"),
    left_out=without_accuracy,
)

RATE_ACCURACY = Part(
    name="rate-accuracy",
    does="accuracy of the rate: asked, estimated, and the method chosen",
    function="earthspin.scene.parts.choices:rate_accuracy",
    needs=("mean-rates",),
    keys=("accuracy",),
    gives=_gives("1", "relative, of the rate by all perturbers"),
    left_out=without_accuracy,
)

SERIES_ACCURACY = Part(
    name="series-accuracy",
    does="accuracy of the directions: asked, estimated, and the method chosen",
    function="earthspin.scene.parts.choices:series_accuracy",
    needs=("torque-series",),
    keys=("accuracy",),
    gives=_gives("mas", "in direction"),
    left_out=without_accuracy,
)

ROTATION_ACCURACY = Part(
    name="rotation-accuracy",
    does="accuracy of the rotation: asked, and what the closed form keeps",
    function="earthspin.scene.parts.choices:rotation_accuracy",
    needs=("free-rotation",),
    keys=("accuracy",),
    gives=_gives("1", "relative, of angular velocity and attitude"),
    left_out=without_accuracy,
)

TOP_ACCURACY = Part(
    name="top-accuracy",
    does="accuracy of the top: asked, and what the closed form keeps on this start",
    function="earthspin.scene.parts.choices:top_accuracy",
    needs=("heavy-top",),
    keys=("tables", "accuracy"),
    gives=_gives("1", "relative, of angles, angular velocity and attitude"),
    left_out=without_accuracy,
)

FIELD_ACCURACY = Part(
    name="field-accuracy",
    does="accuracy of the field: asked, and what the closed form keeps",
    function="earthspin.scene.parts.choices:field_accuracy",
    needs=("spheroid-field",),
    keys=("accuracy",),
    gives=_gives("1", "relative, of potential, attraction and torque"),
    left_out=without_accuracy,
)

"""The three axes of a body in time, as directions and as angles."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from earthspin.bodies import IAU_2006
from earthspin.dataset import Variable
from earthspin.scene.part import Part
from earthspin.scene.parts.conditions import asked_angle, refuse_angle
from earthspin.scene.parts.torque_at_times import TIME, series_times

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.motion.axes import AxisPath
    from earthspin.scene.choosing import Choice
    from earthspin.scene.spec import Scene
    from earthspin.units import TimeGrid, TimeList

DEFAULT_SPAN = ("1980-01-01T12:00:00", "2020-01-01T12:00:00")
DEFAULT_STEP = "5 d"


def pole_times(scene: Scene) -> TimeGrid | TimeList:
    """Times at which the axes are wanted.

    Raises
    ------
    SceneError
        If there are more than fit into memory.
    """
    from earthspin.errors import SceneError
    from earthspin.scene.running import LONGEST_IN_MEMORY

    times = series_times(scene, DEFAULT_SPAN, DEFAULT_STEP)
    if times.size > LONGEST_IN_MEMORY:
        raise SceneError(
            "step",
            scene.step,
            f"{times.size} times do not fit into memory (up to {LONGEST_IN_MEMORY}); "
            f"choose a longer step or a shorter span",
            source=scene.source,
        )
    return times


def follow(scene: Scene, given: Mapping[str, Any]) -> AxisPath:
    """Integrate from the epoch to the times of the scene, on the windows chosen if they will do."""
    from earthspin.errors import UndefinedError

    tried: list[AxisPath] = []
    for choice in (*given.get("chosen-windows", ()), None):
        try:
            path = _follow(scene, given, choice)
        except UndefinedError:
            if choice is None and not tried:
                raise
            continue  # windows that are too wide for the slow manifold of this spin
        if choice is None or _worst_error(scene, path) <= (asked_angle(scene) or 0.0):
            tried.append(path)
            break
        tried.append(path)
    return min(tried, key=lambda path: _worst_error(scene, path)) if tried[1:] else tried[0]


def _worst_error(scene: Scene, path: AxisPath) -> float:
    """Largest error of a direction at the times of the scene, H included, rad."""
    import numpy as np

    from earthspin.constants import DAY
    from earthspin.motion.axes import error_of_input

    u_h = scene.body.relative_uncertainty.get("dynamical_flattening", 0.0)
    if u_h == 0:
        return path.error
    now = pole_times(scene).days(0, pole_times(scene).size)
    from_input = error_of_input(path, path.at(now * DAY)["figure"], u_h)
    return float(np.hypot(path.error, from_input.max()))


def _follow(scene: Scene, given: Mapping[str, Any], choice: Choice | None) -> AxisPath:
    """Integrate on chosen windows, or on the finest."""
    import numpy as np

    from earthspin.constants import DAY
    from earthspin.motion.axes import WINDOW, axis_path, window_count
    from earthspin.progress import progress
    from earthspin.scene.parts.pulls import forces_of, start_of

    pulls, times = given["pulls"], pole_times(scene)
    sky = pulls.sky
    sky.ephemeris.check_times(np.array(times.span()), {*pulls.targets.values(), sky.centre})
    axis, epoch = start_of(scene, pulls)
    first, last = times.span()
    span = first * DAY, last * DAY
    settings = {} if choice is None else choice.settings
    with progress("pole", window_count(epoch, span, settings.get("window", WINDOW))) as advance:
        path = axis_path(
            forces_of(scene, pulls, scene.effects or ()),
            axis,
            epoch,
            span,
            limits=pulls.limits,
            advance=advance,
            **settings,
        )
    # What was measured of the settings is a bound; the path itself only sees its last terms.
    return path if choice is None else replace(path, interpolation_error=choice.error)


def pole(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Directions of the three axes at the times of the scene."""
    import numpy as np

    from earthspin.constants import DAY
    from earthspin.dataset import build
    from earthspin.motion.axes import AXES, error_of_input
    from earthspin.units import datetime64

    times, path = pole_times(scene), given["axis-path"]
    now = times.days(0, times.size)
    found = path.at(now * DAY)
    u_h = scene.body.relative_uncertainty.get("dynamical_flattening", 0.0)
    method = np.full(now.size, path.error)
    from_input = error_of_input(path, found["figure"], u_h)
    error = np.hypot(method, from_input)
    refuse_angle(
        asked_angle(scene),
        float(error.max()),
        "stay nearer to J2000.0 or give the body a better known H",
    )
    if "nonrigid" in (scene.effects or ()):
        _shift_of(scene, given).apply(found, now)
    vectors = np.stack([found[axis] for axis in AXES], axis=1)
    result = build(
        "pole",
        POLE.gives,
        {
            "X": vectors[..., 0],
            "Y": vectors[..., 1],
            "Z": vectors[..., 2],
            "direction_error": error,
            "direction_error_method": method,
            "direction_error_input": from_input,
        },
        coords={"time": ("time", datetime64(now), dict(TIME)), "axis": list(AXES)},
    )
    for name in ("X", "Y", "Z"):
        result[name].attrs["frame"] = "GCRS"
    window = np.median(np.diff(path.windows.edges)) / DAY
    result["direction_error"].attrs |= {
        "method": f"Gauss windows of {window:g} d with {path.windows.order} nodes",
        "evaluations": path.evaluations,
    }
    return result


def pole_angles(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Longitude and inclination of the axes on the fixed orbit."""
    import numpy as np

    from earthspin.compare.angles import on_fixed_ecliptic
    from earthspin.dataset import build
    from earthspin.sky.equator import ecliptic_axes

    axes = given["pole"]
    vectors = np.stack([axes.X, axes.Y, axes.Z], axis=-1)
    ecliptic = ecliptic_axes(scene.body.pole, scene.body.orbit_pole)
    angles = on_fixed_ecliptic(vectors.reshape(-1, 3), ecliptic).reshape(*vectors.shape[:2], 2)
    return build(
        "pole-angles",
        POLE_ANGLES.gives,
        {"psi": np.unwrap(angles[..., 0], axis=0), "eps": angles[..., 1]},
        coords={"time": axes.time, "axis": axes.axis},
    )


def _shift_of(scene: Scene, given: Mapping[str, Any]) -> Any:
    """Non-rigid response, or a refusal where it was named and there is none."""
    from earthspin.errors import SceneError

    if "nonrigid-shift" not in given:
        raise SceneError(
            "effects",
            "nonrigid",
            f"no response of the inside of {scene.body.name} is known; leave it out",
            source=scene.source,
        )
    return given["nonrigid-shift"]


def _no_angles(scene: Scene) -> str | None:
    """Angles need an orbit, and an axis that does not stand on it."""
    import math

    pole_, orbit = scene.body.pole, scene.body.orbit_pole
    if pole_ == IAU_2006:
        return None
    if orbit is None:
        return f"psi is counted along the orbit, and {scene.body.name} has no orbit_pole"
    (ra, dec), (ra0, dec0) = pole_, orbit
    half = math.sin((dec - dec0) / 2) ** 2
    half += math.cos(dec) * math.cos(dec0) * math.sin((ra - ra0) / 2) ** 2
    if half < 1e-14 or half > 1 - 1e-14:
        return "the axis stands upright on the orbit: its longitude psi is not defined"
    return None


_AXES = ("time", "axis")

AXIS_PATH = Part(
    name="axis-path",
    does="the axes from J2000.0 to the times wanted: Picard iteration on Gauss windows",
    function="earthspin.scene.parts.axes_in_time:follow",
    needs=("pulls",),
    uses=("chosen-windows",),
    keys=("step", "times", "accuracy"),
)

POLE = Part(
    name="pole",
    does="directions of angular-momentum, rotation and figure axis at every time",
    function="earthspin.scene.parts.axes_in_time:pole",
    needs=("axis-path",),
    uses=("nonrigid-shift",),
    keys=("body", "effects", "accuracy", "span", "step", "times"),
    gives={
        "X": Variable(_AXES, "1", "first component of the unit vector of the axis"),
        "Y": Variable(_AXES, "1", "second component of the unit vector of the axis"),
        "Z": Variable(_AXES, "1", "third component of the unit vector of the axis"),
        "direction_error": Variable(
            ("time",), "uas", "95 % half-width of the directions, figure of the body included"
        ),
        "direction_error_method": Variable(("time",), "uas", "share of the integration"),
        "direction_error_input": Variable(("time",), "uas", "share of the uncertainty of H"),
    },
)

POLE_ANGLES = Part(
    name="pole-angles",
    does="longitude psi and inclination eps of the axes on the fixed orbit of J2000.0",
    function="earthspin.scene.parts.axes_in_time:pole_angles",
    needs=("pole",),
    left_out=_no_angles,
    gives={
        "psi": Variable(
            _AXES, "arcsec", "precession and nutation in longitude along the orbit of J2000.0"
        ),
        "eps": Variable(_AXES, "arcsec", "angle of the axis from the normal of that orbit"),
    },
)

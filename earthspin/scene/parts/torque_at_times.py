"""Where the perturbers stand and what they pull, at many times."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, cast

from earthspin.dataset import Variable, with_error
from earthspin.errors import SceneError
from earthspin.scene.part import Part
from earthspin.scene.parts.conditions import asked_angle, refuse_angle
from earthspin.units import TimeGrid, TimeList, time_grid

if TYPE_CHECKING:
    import numpy as np
    import xarray as xr
    from numpy.typing import NDArray

    from earthspin.scene.spec import Scene

#: What `step` is if the scene does not say, and how long a span without one is.
DEFAULT_STEP = "6 h"
DEFAULT_SPAN = ("2000-01-01T12:00:00", "2001-01-01T12:00:00")


def series_times(
    scene: Scene, default_span: tuple[str, str] = DEFAULT_SPAN, default_step: str = DEFAULT_STEP
) -> TimeGrid | TimeList:
    """Times at which a scene wants its series."""
    if scene.times is not None:
        return cast("TimeList", scene.times)
    span = scene.span or default_span
    step = default_step if scene.step is None else scene.step
    return time_grid(span[0], span[1], step, scene.source)


def read_times(scene: Scene, given: Mapping[str, Any]) -> TimeGrid | TimeList:
    """Make the times of the series, once for all parts."""
    return series_times(scene)


def torque_series(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Series at every time of the scene."""
    return torque_block(scene, given, 0, given["times"].size)


def torque_block(scene: Scene, given: Mapping[str, Any], first: int, last: int) -> xr.Dataset:
    """Series from the time numbered `first` up to `last`.

    Raises
    ------
    CoverageError
        If the kernel does not cover a time.
    """
    import numpy as np
    import xarray as xr

    from earthspin.dataset import build
    from earthspin.mass.inertia import moment_difference
    from earthspin.sky.equator import equator_of_date, rotate, spherical
    from earthspin.torque.gravity import torque_error, torque_from_declination
    from earthspin.units import datetime64

    sky, body = given["ephemeris"], scene.body
    if scene.equator == "true" and "nutation" not in given:
        raise SceneError(
            "equator",
            scene.equator,
            f"there is no nutation model for {body.name}; use 'mean'",
            source=scene.source,
        )
    now = given["times"].days(first, last)
    equator = equator_of_date(body.needed("pole"), body.orbit_pole, now, given.get("nutation"))
    positions = sky.positions(now)
    names = list(sky.targets)
    seen = {name: spherical(rotate(equator, positions[name])) for name in names}
    choice = given.get("chosen-nutation")
    turned = 0.0 if choice is None else choice.error
    bounds = {name: sky.ephemeris.error(sky.targets[name]) for name in names}
    kernel_error = {name: (turned + angle, far) for name, (angle, far) in bounds.items()}
    refuse_angle(
        asked_angle(scene),
        max(angle for angle, _ in kernel_error.values()),
        "that is what the kernel is known to; ask for less",
    )

    def stack(values: list[Any], *dims: str) -> xr.DataArray:
        return xr.DataArray(np.stack(values, axis=1), dims=("time", "perturber", *dims))

    bulge = moment_difference(body.needed("j2"), body.mass, body.needed("radius"))
    u_bulge = body.relative_uncertainty_of_bulge()
    per_bulge = [torque_from_declination(p.gm, 1.0, *seen[p.name]) for p in scene.perturbers]
    error = [
        torque_error(
            p.gm,
            1.0,
            declination=seen[p.name][1],
            distance=seen[p.name][2],
            angle_error=kernel_error[p.name][0],
            distance_error=kernel_error[p.name][1],
            u_product=math.hypot(u_bulge, p.relative_uncertainty.get("gm", 0.0)),
        )
        for p in scene.perturbers
    ]
    result = build(
        "torque-series",
        TORQUE_SERIES.gives,
        {
            "right_ascension": stack([seen[name][0] for name in names]),
            "declination": stack([seen[name][1] for name in names]),
            "distance": stack([seen[name][2] for name in names]),
            "torque": stack(per_bulge, "component") * bulge,
            "torque_magnitude": stack([_norm(t) for t in per_bulge]) * abs(bulge),
            "torque_magnitude_error": stack(error) * abs(bulge),
            "direction_error": [kernel_error[name][0] for name in names],
            "distance_error": [kernel_error[name][1] for name in names],
        },
        coords={
            "time": ("time", datetime64(now), dict(TIME)),
            "perturber": names,
            "component": ["x", "y", "z"],
        },
        frame=f"{scene.equator} equator and equinox of date",
    )
    result["direction_error"].attrs |= {
        "method": _equator_words(scene, given),
        "evaluations": given["times"].size * len(names)
        + getattr(given.get("nutation"), "evaluations", 0),
    }
    return result


def _equator_words(scene: Scene, given: Mapping[str, Any]) -> str:
    """How the equator was found, for people."""
    nutation = given.get("nutation")
    if nutation is not None:
        return f"IAU {nutation.model} nutation, a node each {nutation.spacing:g} d"
    choice = given.get("chosen-nutation")
    return "mean equator" if choice is None else str(choice.words)


def _norm(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    import numpy as np

    return np.asarray(np.linalg.norm(vectors, axis=-1))


TIME = {"long_name": "time (TDB)", "standard_name": "time", "axis": "T"}
_SERIES = ("time", "perturber")

TIMES = Part(
    name="times",
    does="the times of the series",
    function="earthspin.scene.parts.torque_at_times:read_times",
    keys=("span", "step", "times"),
)

TORQUE_SERIES = Part(
    name="torque-series",
    does="declination, distance and torque of each perturber at every time",
    function="earthspin.scene.parts.torque_at_times:torque_series",
    needs=("times", "ephemeris"),
    uses=("nutation", "chosen-nutation"),
    keys=("body", "perturbers", "ephemeris", "equator", "accuracy"),
    gives={
        "right_ascension": Variable(_SERIES, "deg", "right ascension, geometric"),
        "declination": Variable(_SERIES, "deg", "declination, geometric"),
        "distance": Variable(_SERIES, "m", "distance between the centres"),
        "torque": Variable((*_SERIES, "component"), "N m", "torque on the bulge"),
        **with_error("torque_magnitude", Variable(_SERIES, "N m", "magnitude of the torque")),
        "direction_error": Variable(
            ("perturber",), "deg", "bound on right ascension and declination"
        ),
        "distance_error": Variable(("perturber",), "m", "bound on the distance from the kernel"),
    },
)

"""A free rotor in time, and Poinsot's picture of it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.dataset import Variable
from earthspin.scene.part import Part
from earthspin.scene.tables import Table, read_table

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.spec import Scene

#: Settings of the table [rotor]: unit and an example of each.
ROTOR = Table(
    "rotor",
    quantities={"moments": ("kg m2", "8.01e37 kg m2"), "omega": ("rad/s", "1 rad/s")},
    defaults={"moments": (1.0, 2.0, 3.0), "omega": (0.1, 1.0, 0.1)},
)


def free_rotation(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Rotate the body of the table [rotor] in closed form."""
    from earthspin.dataset import build
    from earthspin.rotor.triaxial import free_rotation as rotate

    settings = read_table(ROTOR, scene)
    motion = rotate(settings["moments"], settings["omega"], settings["times"])
    starts = ("start",) * (motion.energy.ndim - 1)
    return build(
        "free-rotation",
        FREE_ROTATION.gives,
        {
            "omega_body": _laid(motion.omega_body, *starts, "time", "component"),
            "angular_momentum_body": _laid(
                motion.angular_momentum_body, *starts, "time", "component"
            ),
            "omega_inertial": _laid(motion.omega_inertial, *starts, "time", "component"),
            "attitude": _laid(motion.attitude, *starts, "time", "quaternion"),
            "energy": _laid(motion.energy, *starts, "time"),
        },
        coords={
            "time": ("time", motion.times, {"units": "s", "long_name": "time from the start"}),
            "component": ["x", "y", "z"],
            "quaternion": ["w", "x", "y", "z"],
        },
    )


def poinsot(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Ellipsoids, polhode, invariable plane and herpolhode of one start."""
    import numpy as np

    from earthspin.dataset import build
    from earthspin.rotor import poinsot as p
    from earthspin.rotor.euler import axis_stability

    settings = read_table(ROTOR, scene)
    moments, omega = settings["moments"], settings["omega"]
    path = p.polhode(moments, omega)
    stability = axis_stability(moments, sum(w * w for w in omega) ** 0.5)
    returns = {}
    if bool(np.isfinite(path.period)):
        returns["herpolhode_advance"] = p.herpolhode_advance(moments, omega)
    return build(
        "poinsot",
        dict(POINSOT.gives) | (ADVANCE if returns else {}),
        {
            "inertia_ellipsoid": p.inertia_ellipsoid(moments, omega),
            "momentum_ellipsoid": p.momentum_ellipsoid(moments, omega),
            "polhode": path.omega,
            "polhode_period": path.period,
            "invariable_plane_distance": p.invariable_plane_distance(moments, omega),
            "herpolhode": p.herpolhode(moments, omega, settings["times"]),
            "herpolhode_radius": p.herpolhode_radii(moments, omega),
            **returns,
            "growth_rate": stability.growth_rate,
        },
        coords={
            "time": (
                "time",
                settings["times"],
                {"units": "s", "long_name": "time from the start"},
            ),
            "component": ["x", "y", "z"],
            "in_plane": ["x", "y"],
            "bound": ["inner", "outer"],
        },
    )


def _laid(values: Any, *dims: str) -> xr.DataArray:
    import xarray as xr

    return xr.DataArray(values, dims=dims)


def _one_start(scene: Scene) -> str | None:
    import numpy as np

    omega = (scene.tables or {}).get("rotor", {}).get("omega", ROTOR.defaults["omega"])
    return None if np.ndim(np.asarray(omega, dtype=object)) == 1 else "there are several starts"


_SERIES = ("time", "component")

FREE_ROTATION = Part(
    name="free-rotation",
    does="angular velocity, attitude and energy of a free rotor, in closed form",
    function="earthspin.scene.parts.rotation:free_rotation",
    keys=("tables",),
    gives={
        "omega_body": Variable(_SERIES, "rad/s", "angular velocity along the principal axes"),
        "angular_momentum_body": Variable(
            _SERIES, "kg m2 / s", "angular momentum along the principal axes"
        ),
        "omega_inertial": Variable(
            _SERIES, "rad/s", "angular velocity along inertial axes, those of the body at t = 0"
        ),
        "attitude": Variable(("time", "quaternion"), "1", "unit quaternion, body to inertial"),
        "energy": Variable(("time",), "J", "kinetic energy of rotation"),
    },
)

POINSOT = Part(
    name="poinsot",
    does="ellipsoids, polhode and herpolhode of a free rotor",
    function="earthspin.scene.parts.rotation:poinsot",
    keys=("tables",),
    left_out=_one_start,
    gives={
        "inertia_ellipsoid": Variable(
            ("component",), "rad/s", "semi-axes of the inertia ellipsoid"
        ),
        "momentum_ellipsoid": Variable(
            ("component",), "rad/s", "semi-axes of the ellipsoid of constant angular momentum"
        ),
        "polhode": Variable(
            ("polhode_point", "component"), "rad/s", "path of the angular velocity in the body"
        ),
        "polhode_period": Variable((), "s", "time of one round of the polhode"),
        "invariable_plane_distance": Variable(
            (), "rad/s", "distance of the invariable plane from the centre, 2T/L"
        ),
        "herpolhode": Variable(
            ("time", "in_plane"), "rad/s", "path of the angular velocity in the invariable plane"
        ),
        "herpolhode_radius": Variable(("bound",), "rad/s", "bounds of the herpolhode"),
        "growth_rate": Variable(
            ("component",), "1/s", "rate at which a small tilt off each axis grows; 0 if stable"
        ),
    },
)

#: Given where the polhode has a period: not on the separatrix, nor where omega stands still.
ADVANCE = {"herpolhode_advance": Variable((), "rad", "turn of the herpolhode per round")}

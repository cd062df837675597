"""The heavy symmetric top in time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.dataset import Variable
from earthspin.scene.part import Part
from earthspin.scene.tables import Table, read_table

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.spec import Scene

#: Settings of the table [top].
TOP = Table(
    "top",
    quantities={
        "transverse_moment": ("kg m2", "2e-4 kg m2"),
        "axial_moment": ("kg m2", "8e-5 kg m2"),
        "weight_moment": ("N m", "0.04 N m"),
        "theta": ("rad", "30 deg"),
        "spin": ("rad/s", "200 rad/s"),
        "phi_rate": ("rad/s", "0 rad/s"),
        "theta_rate": ("rad/s", "0 rad/s"),
        "phi": ("rad", "0 deg"),
        "psi": ("rad", "0 deg"),
    },
    defaults={
        "transverse_moment": 1.0,
        "axial_moment": 0.5,
        "weight_moment": 1.0,
        "theta": 0.5,
        "spin": 5.0,
        "phi_rate": 0.0,
        "theta_rate": 0.0,
        "phi": 0.0,
        "psi": 0.0,
    },
)


def heavy_top(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Move the top of the table [top], by elliptic functions."""
    import numpy as np

    from earthspin.dataset import build
    from earthspin.top.motion import heavy_top_motion
    from earthspin.top.start import HeavyTop
    from earthspin.top.turning import effective_potential

    settings = read_table(TOP, scene)
    times = settings.pop("times")
    top = HeavyTop(**settings)
    motion = heavy_top_motion(top, times)
    inclination = np.linspace(0.0, np.pi, POTENTIAL_POINTS)[1:-1]
    return build(
        "heavy-top",
        HEAVY_TOP.gives,
        {
            "theta": motion.theta,
            "phi": motion.phi,
            "psi": motion.psi,
            "attitude": motion.attitude,
            "omega_body": motion.omega_body,
            "turning_angle": motion.turning_angle,
            "pattern": motion.pattern,
            "nutation_period": motion.nutation_period,
            "mean_precession_rate": motion.precession_rate,
            "effective_potential": effective_potential(top, inclination),
        },
        coords={
            "time": ("time", times, {"units": "s", "long_name": "time from the start"}),
            "component": ["x", "y", "z"],
            "quaternion": ["w", "x", "y", "z"],
            "turning": ["upper", "lower"],
            "inclination": (
                "inclination",
                np.degrees(inclination),
                {"units": "deg", "long_name": "angle from the vertical"},
            ),
        },
    )


POTENTIAL_POINTS = 361
_TIME = ("time",)

HEAVY_TOP = Part(
    name="heavy-top",
    does="Euler angles, pattern and turning angles of a heavy top, by elliptic functions",
    function="earthspin.scene.parts.tops:heavy_top",
    keys=("tables",),
    gives={
        "theta": Variable(_TIME, "rad", "angle from the vertical to the axis"),
        "phi": Variable(_TIME, "rad", "turn of the axis about the vertical"),
        "psi": Variable(_TIME, "rad", "turn of the body about its axis"),
        "attitude": Variable(("time", "quaternion"), "1", "unit quaternion, body to inertial"),
        "omega_body": Variable(
            ("time", "component"), "rad/s", "angular velocity along the principal axes"
        ),
        "turning_angle": Variable(("turning",), "rad", "least and greatest theta"),
        "pattern": Variable((), "", "wave, cusp, loop, steady or sleeping"),
        "nutation_period": Variable((), "s", "time in which theta goes once to and fro"),
        "mean_precession_rate": Variable((), "rad/s", "mean rate of phi"),
        "effective_potential": Variable(
            ("inclination",), "rad2 / s2", "effective potential V of alpha = theta'^2 + V"
        ),
    },
)

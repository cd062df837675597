"""The exact field of a homogeneous spheroid at given points."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.dataset import Variable
from earthspin.scene.part import Part
from earthspin.scene.tables import Table, read_table

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.spec import Scene

#: Settings of the table [spheroid].
SPHEROID = Table(
    "spheroid",
    quantities={"position": ("m", "7000 km"), "point_mass": ("kg", "1 kg")},
    defaults={"point_mass": 1.0},
    timed=False,
)


def spheroid_field(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Potential and attraction at each point, and the torque of a mass there on the body."""
    import numpy as np

    from earthspin.dataset import build
    from earthspin.mass import spheroid

    settings, body = read_table(SPHEROID, scene), scene.body
    points = np.atleast_2d(np.asarray(settings["position"], dtype=np.float64))
    figure = body.gm, body.needed("radius"), body.needed("flattening")
    return build(
        "spheroid-field",
        SPHEROID_FIELD.gives,
        {
            "position": points,
            "potential": spheroid.spheroid_potential(*figure, points),
            "attraction": spheroid.spheroid_attraction(*figure, points),
            "torque": spheroid.spheroid_torque(*figure, settings["point_mass"], points),
        },
        coords={"component": ["x", "y", "z"]},
        frame="principal axes of the spheroid, z along its axis",
    )


_VECTOR = ("point", "component")

SPHEROID_FIELD = Part(
    name="spheroid-field",
    does="potential, attraction and torque of a homogeneous spheroid, exact",
    function="earthspin.scene.parts.spheroid_points:spheroid_field",
    keys=("body", "tables"),
    gives={
        "position": Variable(_VECTOR, "m", "place of the point from the centre"),
        "potential": Variable(("point",), "J/kg", "gravitational potential"),
        "attraction": Variable(_VECTOR, "m/s2", "acceleration of gravity"),
        "torque": Variable(_VECTOR, "N m", "torque of the point mass on the spheroid"),
    },
)

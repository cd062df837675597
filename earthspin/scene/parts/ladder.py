"""The rungs of the wobble ladder that a rigid body has."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.dataset import Variable
from earthspin.scene.part import Part

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.spec import Scene

RUNGS = ("flattening", "rigid", "triaxial")


def wobble_ladder(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Period of the free wobble, rung by rung."""
    import xarray as xr

    from earthspin.dataset import build
    from earthspin.wobble import ladder

    body = scene.body
    h, j2 = body.needed("dynamical_flattening"), body.needed("j2")
    turns = xr.concat(
        [
            xr.DataArray(ladder.turns_from_flattening(body.needed("flattening"))),
            xr.DataArray(ladder.turns_rigid(h)),
            xr.DataArray(ladder.turns_triaxial(h, j2, body.triaxiality)),
        ],
        dim=xr.Variable("rung", list(RUNGS)),
    )
    period = turns * abs(body.needed("spin_period"))
    return build(
        "wobble-ladder",
        WOBBLE_LADDER.gives,
        {
            "period_solar": period,
            "period_sidereal": turns,
            "factor": turns.copy(data=ladder.factors(turns.values)),
        },
    )


_RUNG = ("rung",)

WOBBLE_LADDER = Part(
    name="wobble-ladder",
    does="free wobble of the rigid body, rung by rung",
    function="earthspin.scene.parts.ladder:wobble_ladder",
    keys=("body",),
    gives={
        "period_solar": Variable(_RUNG, "d", "period of the free wobble in days of 86400 s"),
        "period_sidereal": Variable(
            _RUNG, "1", "period of the free wobble in turns of the body, its sidereal days"
        ),
        "factor": Variable(_RUNG, "1", "period over that of the rung before"),
    },
)

"""Our pole less the IAU's in time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.dataset import Variable
from earthspin.scene.part import Part
from earthspin.scene.parts.axes_in_time import pole_times
from earthspin.scene.parts.pole_analysis import path_over
from earthspin.scene.parts.torque_at_times import TIME

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.spec import Scene


def residuals(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Our pole less the IAU's in time, for three models, constant and rate removed."""
    import numpy as np

    from earthspin.compare.nutation import complex_nutation, without_line
    from earthspin.dataset import build
    from earthspin.sky import iau
    from earthspin.units import datetime64

    done, pulls, times = given["pole-analysis"], given["pulls"], pole_times(scene)
    days = times.days(0, times.size)
    first, last = times.span()
    ends = np.array([min(first, 0.0), max(last, 0.0)])
    pulls.sky.ephemeris.check_times(ends[[0, 1]], {*pulls.targets.values(), pulls.sky.centre})
    effects = [e for e in scene.effects or () if e != "nonrigid"]
    iau_eta = complex_nutation(iau.nutation_of(iau.true_pole(days), days))

    def eta_of(effects: list[str], axis: str) -> Any:
        path = path_over(scene, pulls, effects, done.start, ends)
        return complex_nutation(iau.nutation_of(done.pole(path, days, axis), days))

    rigid = eta_of(effects, "figure")
    models = {
        "first-order": eta_of([], "angular_momentum"),
        "rigid": rigid,
        "nonrigid": rigid + given["nonrigid-shift"].eta(days),
    }
    left = np.stack([model - iau_eta for model in models.values()], axis=1)
    plain = np.stack([left.real, left.imag], axis=-1)
    fitted = without_line(days / 36525.0, plain.reshape(days.size, -1)).reshape(plain.shape)
    chosen = fitted[:, 2 if "nonrigid" in (scene.effects or ()) else 1]
    return build(
        "iau-residuals",
        IAU_RESIDUALS.gives,
        {
            "dpsi_sineps": chosen[:, 0],
            "deps": chosen[:, 1],
            "dpsi_sineps_by_model": fitted[..., 0],
            "deps_by_model": fitted[..., 1],
            "residual_rms": np.sqrt(np.mean(fitted**2, axis=0)),
            "residual_maximum": np.max(np.abs(fitted), axis=0),
            "residual_rms_unfitted": np.sqrt(np.mean(plain**2, axis=0)),
        },
        coords={
            "time": ("time", datetime64(days), dict(TIME)),
            "model": list(models),
            "direction": ["dpsi_sineps", "deps"],
        },
    )


_MODEL = ("model", "direction")

IAU_RESIDUALS = Part(
    name="iau-residuals",
    does="our pole less the IAU's in time, for three models",
    function="earthspin.scene.parts.pole_residuals:residuals",
    needs=("pole-analysis", "nonrigid-shift"),
    keys=("span", "step", "times"),
    gives={
        "dpsi_sineps": Variable(
            ("time",), "mas", "our pole less the IAU's in longitude times sin(eps), line removed"
        ),
        "deps": Variable(("time",), "mas", "our pole less the IAU's in obliquity, line removed"),
        "dpsi_sineps_by_model": Variable(
            ("time", "model"), "mas", "the same in longitude, for three models"
        ),
        "deps_by_model": Variable(
            ("time", "model"), "mas", "the same in obliquity, for three models"
        ),
        "residual_rms": Variable(_MODEL, "mas", "root mean square after constant and rate"),
        "residual_maximum": Variable(_MODEL, "mas", "largest after constant and rate"),
        "residual_rms_unfitted": Variable(_MODEL, "mas", "root mean square with nothing fitted"),
    },
)

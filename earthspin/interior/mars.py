"""Mars in four even layers, a fluid core among them, that have its mass and moment of inertia."""

from __future__ import annotations

import numpy as np

from earthspin.constants import Constant, G
from earthspin.interior.layers import Layer, LayeredBody

_INSIGHT = "Le Maistre et al. 2023, Nature 619, 733"
#: Of the fluid core; the density within the 5955 to 6290 kg m-3 of the same paper.
CORE_RADIUS = Constant(1835e3, "m", 55e3, _INSIGHT)
CORE_DENSITY = Constant(6100.0, "kg m-3", 90.0, _INSIGHT + ": 5955 to 6290")
#: Crust of 24 to 72 km (Knapmeyer-Endrun et al. 2021, Science 373, 438), in the middle.
CRUST = Constant(48e3, "m", 12e3, "Knapmeyer-Endrun et al. 2021, Science 373, 438: 24 to 72 km")
CRUST_DENSITY = Constant(2900.0, "kg m-3", None, "between 2500 and 3100 kg m-3, recalled")
#: Where the minerals of the mantle change, about 1000 km deep.
TRANSITION_RADIUS = Constant(2390e3, "m", None, "about 1000 km below the surface, recalled")
MEAN_RADIUS = Constant(3389.5e3, "m", None, "Archinal et al. 2018, Celest. Mech. 130:22, table 4")
#: Speeds of shear waves in crust, upper and lower mantle, m/s.
SHEAR_SPEEDS = (2900.0, 4450.0, 4850.0)
SHEAR_SOURCE = "near those of Khan et al. 2021, Science 373, 434; recalled"
#: Ratio of the speeds of compressional and shear waves; the core's speed, m/s.
SPEED_RATIO, CORE_SPEED = 1.8, 5000.0
#: Quality factor of the mantle in shear at 1 s.
SHEAR_Q = 100.0
_GM = Constant(42828.375816e9, "m3 s-2", None, "header of DE440")
#: I/(M R2) of the mean moment, from C/(M a2) = 0.36367 and J2 = 1.9566e-3 with a = 3396 km.
MOMENT = Constant(0.36376, "", 1e-4, "mean moment of C/(M a2) = 0.36367, as recalled")


def four_layers(core_radius: float = CORE_RADIUS.value) -> LayeredBody:
    """Mars with a fluid core of a given radius.

    The densities of upper and lower mantle are those with which mass and moment of inertia are
    met.

    Parameters
    ----------
    core_radius : float
        m.
    """
    mass = _GM.value / G.value
    tops = np.array(
        [core_radius, TRANSITION_RADIUS.value, MEAN_RADIUS.value - CRUST.value, MEAN_RADIUS.value]
    )
    volume, moment = (np.diff(tops**n, prepend=0.0) for n in (3, 5))
    volume, moment = 4 * np.pi / 3 * volume, 8 * np.pi / 15 * moment
    known = np.array([CORE_DENSITY.value, 0.0, 0.0, CRUST_DENSITY.value])
    wanted = [
        mass - volume @ known,
        MOMENT.value * mass * MEAN_RADIUS.value**2 - moment @ known,
    ]
    lower, upper = np.linalg.solve([volume[1:3], moment[1:3]], wanted)
    crust, above, below = SHEAR_SPEEDS
    solids = zip(tops[1:], (lower, upper, CRUST_DENSITY.value), (below, above, crust), strict=True)
    return LayeredBody(
        "mars",
        (
            Layer(core_radius, (CORE_DENSITY.value,), (CORE_SPEED,)),
            *(
                Layer(float(top), (float(rho),), (SPEED_RATIO * vs,), (vs,), SHEAR_Q)
                for top, rho, vs in solids
            ),
        ),
        f"core: {_INSIGHT}; crust: {CRUST.source}; shear speeds {SHEAR_SOURCE}; mantle densities "
        "from mass and moment of inertia",
    )


MARS = four_layers()

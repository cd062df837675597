"""Four-layer model of Mars with a fluid core, consistent with its mass and moment of inertia."""

from __future__ import annotations

import numpy as np

from earthspin import constants as c
from earthspin.constants import Constant, G
from earthspin.interior.layers import Layer, LayeredBody

_INSIGHT = "Le Maistre et al. 2023, Nature 619, 733"
_INSIGHT_READ = "abstract, nature.com/articles/s41586-023-06150-0"
#: Radius and density of the fluid core; the paper gives a density of 5955 to 6290 kg m-3.
CORE_RADIUS = Constant(1835e3, "m", 55e3, _INSIGHT, _INSIGHT_READ)
CORE_DENSITY = Constant(6100.0, "kg m-3", 90.0, _INSIGHT + ": 5955 to 6290", _INSIGHT_READ)
_CRUST = "Knapmeyer-Endrun et al. 2021, Science 373, 438: 24 to 72 km"
#: Thickness of the crust: the middle of 24 to 72 km (Knapmeyer-Endrun et al. 2021).
CRUST = Constant(48e3, "m", 12e3, _CRUST, "abstract, doi.org/10.1126/science.abf8966")
_SEISMIC = (
    "InSight_KKS21_GP (Knapmeyer-Endrun et al., Khan et al., Staehler et al. 2021, Science 373, "
    "438, 434 and 443)"
)
_SEISMIC_READ = "SPECFEM/specfem3d_globe, DATA/mars/mars_1D.dat"
_STEEPEST = _SEISMIC + ": steepest rise of the shear speed; uncertainty: half the step of the table"
_MEAN = _SEISMIC + ": mean by volume; uncertainty: standard deviation within the layer"
CRUST_DENSITY = Constant(2660.0, "kg m-3", 220.0, _MEAN, _SEISMIC_READ)
#: Radius of the mantle's mineral phase transition, about 1050 km deep.
TRANSITION_RADIUS = Constant(2334.5e3, "m", 25e3, _STEEPEST, _SEISMIC_READ)
_IAU_2015 = "Archinal et al. 2018, Celest. Mech. 130:22, table 4"
MEAN_RADIUS = Constant(3389.5e3, "m", None, _IAU_2015, c.SHTOOLS + "Mars.py")
#: Speeds of shear waves in crust, upper and lower mantle.
SHEAR_SPEEDS = tuple(
    Constant(speed, "m s-1", spread, _MEAN, _SEISMIC_READ)
    for speed, spread in ((3070.0, 750.0), (4340.0, 80.0), (4940.0, 100.0))
)
#: Ratio of compressional to shear wave speed in the solid, and compressional speed in the core.
SPEED_RATIO = Constant(1.84, "", 0.035, _MEAN, _SEISMIC_READ)
CORE_SPEED = Constant(5220.0, "m s-1", 150.0, _MEAN, _SEISMIC_READ)
#: Shear quality factor of the mantle at 1 s.
SHEAR_Q = Constant(
    100.0, "", None, "assumed: of the order that the acceleration of Phobos gives", c.ASSUMED
)
#: I/(M R2) for the mean moment, (A + B + C)/3 = C - 2/3 J2 M a2.
MOMENT = (c.MARS_POLAR_MOMENT.value - 2 / 3 * c.MARS_J2.value) * (
    c.MARS_RADIUS.value / MEAN_RADIUS.value
) ** 2


def four_layers() -> LayeredBody:
    """Make a four-layer model of Mars with a fluid core.

    The densities of upper and lower mantle follow from the mass and the moment of inertia.
    """
    mass = c.MARS_GM.value / G.value
    crust_base = MEAN_RADIUS.value - CRUST.value
    tops = np.array([CORE_RADIUS.value, TRANSITION_RADIUS.value, crust_base, MEAN_RADIUS.value])
    volume, moment = (np.diff(tops**n, prepend=0.0) for n in (3, 5))
    volume, moment = 4 * np.pi / 3 * volume, 8 * np.pi / 15 * moment
    fixed = np.array([CORE_DENSITY.value, 0.0, 0.0, CRUST_DENSITY.value])
    required = [mass - volume @ fixed, MOMENT * mass * MEAN_RADIUS.value**2 - moment @ fixed]
    lower, upper = np.linalg.solve([volume[1:3], moment[1:3]], required)
    densities = (lower, upper, CRUST_DENSITY.value)
    speeds = (speed.value for speed in reversed(SHEAR_SPEEDS))
    solids = zip(tops[1:], densities, speeds, strict=True)
    return LayeredBody(
        "mars",
        (
            Layer(CORE_RADIUS.value, (CORE_DENSITY.value,), (CORE_SPEED.value,)),
            *(
                Layer(float(top), (float(rho),), (SPEED_RATIO.value * vs,), (vs,), SHEAR_Q.value)
                for top, rho, vs in solids
            ),
        ),
        f"core: {_INSIGHT}; crust: {CRUST.source}; speeds: {_SEISMIC}; mantle densities "
        "from mass and moment of inertia",
    )


MARS = four_layers()

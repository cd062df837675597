"""Mean orbits of the Sun and Moon about the Earth, and of bodies in spin-orbit resonance."""

from __future__ import annotations

import math

from earthspin.bodies.inner import MERCURY, MERCURY_ORBIT
from earthspin.bodies.moon import MOON
from earthspin.bodies.moons import ORBITS as OF_MOONS
from earthspin.bodies.moons import TITAN_OBLIQUITY
from earthspin.bodies.orbit import Orbit
from earthspin.bodies.sun import SUN
from earthspin.constants import (
    AU,
    COMPUTED,
    DAY,
    DAYS_PER_CENTURY,
    SIDEREAL_MONTH,
    SIDEREAL_YEAR,
    SIMON_READ,
    Constant,
)  # fmt: skip

MEAN_ELEMENTS = "Simon et al. 1994, A&A 282, 663 (J2000.0)"
LUNAR_ELEMENTS = "Chapront-Touze & Chapront 1988, A&A 190, 342"

#: Semi-major axis, eccentricity, and inclination to the ecliptic.
SUN_DISTANCE = Constant(1.000001018 * AU, "m", None, MEAN_ELEMENTS, SIMON_READ)
SUN_ECCENTRICITY = Constant(0.01670863, "", None, MEAN_ELEMENTS, SIMON_READ)
#: Constant of ELP. An ellipse with the same period has 384748 km; the mean of 1/r is 1/(384400 km).
MOON_DISTANCE = Constant(383397772.5, "m", None, LUNAR_ELEMENTS, SIMON_READ)
MOON_ECCENTRICITY = Constant(0.05554553, "", None, LUNAR_ELEMENTS, SIMON_READ)
MOON_INCLINATION = Constant(5.15668983, "deg", None, LUNAR_ELEMENTS, SIMON_READ)

#: Mean longitude and longitude of pericentre at J2000.0, from the ecliptic and equinox of J2000.0.
SUN_LONGITUDE = Constant(280.46645683, "deg", None, MEAN_ELEMENTS, SIMON_READ)
SUN_PERIGEE = Constant(282.93734808, "deg", None, MEAN_ELEMENTS, SIMON_READ)
MOON_LONGITUDE = Constant(218.31664563, "deg", None, MEAN_ELEMENTS, SIMON_READ)
MOON_PERIGEE = Constant(83.35324312, "deg", None, MEAN_ELEMENTS, SIMON_READ)
MOON_NODE = Constant(125.04455501, "deg", None, MEAN_ELEMENTS, SIMON_READ)
#: Rates of the longitudes of the Moon's perigee and node, from the fixed equinox of J2000.0.
PERIGEE_RATE = Constant(14643420.2669, "0.01 arcsec yr-1", None, MEAN_ELEMENTS, SIMON_READ)
NODE_RATE = Constant(-6967919.3631, "0.01 arcsec yr-1", None, MEAN_ELEMENTS, SIMON_READ)

_TURN = 1296000.0 * DAYS_PER_CENTURY * DAY  # arcsec s / (100 yr)

#: The Sun on its apparent elliptical orbit about the Earth.
MEAN_SUN = SUN.replace(
    orbit=Orbit(
        a=SUN_DISTANCE.value,
        period=SIDEREAL_YEAR.value,
        e=SUN_ECCENTRICITY.value,
        pericentre=math.radians(SUN_PERIGEE.value),
        mean_anomaly=math.radians(SUN_LONGITUDE.value - SUN_PERIGEE.value),
        about="earth",
        reference=MEAN_ELEMENTS,
    )
)
#: The Moon on an ellipse with its sidereal period, with precessing node and perigee.
MEAN_MOON = MOON.replace(
    orbit=Orbit(
        period=SIDEREAL_MONTH.value,
        e=MOON_ECCENTRICITY.value,
        i=math.radians(MOON_INCLINATION.value),
        node=math.radians(MOON_NODE.value),
        pericentre=math.radians(MOON_PERIGEE.value - MOON_NODE.value),
        mean_anomaly=math.radians(MOON_LONGITUDE.value - MOON_PERIGEE.value),
        node_period=_TURN / NODE_RATE.value,
        # the argument of perigee is measured from the node, which regresses
        pericentre_period=_TURN / (PERIGEE_RATE.value - NODE_RATE.value),
        about="earth",
        reference=f"{LUNAR_ELEMENTS}; {MEAN_ELEMENTS}",
    )
)
#: Orbits referred to their Laplace planes, by name of the body.
PRECESSING_ORBITS = {MOON.name: MEAN_MOON.orbit, MERCURY.name: MERCURY_ORBIT} | OF_MOONS

_LUNAR_STATE = "energy of the figure averaged over four turns of the node in DE421"
#: Obliquity of a solid Titan in its Cassini state, as `cassini_states` computes it, deg.
_TITAN_IF_SOLID = 0.114
#: Effects not included in the Cassini-state equation, as changes of the obliquity in the upright
#: state, by name of the body.
LEFT_OUT_OF_STATES: dict[str, dict[str, Constant]] = {
    MOON.name: {
        "the Sun in the orbit": Constant(-0.0227, "deg", None, _LUNAR_STATE, COMPUTED),
        "spin counted from the node": Constant(-0.0080, "deg", None, _LUNAR_STATE, COMPUTED),
        "pull of the Sun": Constant(0.0022, "deg", None, _LUNAR_STATE, COMPUTED),
        "mean inclination": Constant(
            -0.0115,
            "deg",
            None,
            "5.145 deg, with which the observed one is made, less that of ELP",
            COMPUTED,
        ),
        "fluid core and inner core": Constant(
            0.003,
            "deg",
            None,
            "a few thousandths of a degree: arXiv:2201.00803",
            "abstract of arXiv:2201.00803",
        ),
    },
    "titan": {
        "ocean under the shell": Constant(
            TITAN_OBLIQUITY.value - _TITAN_IF_SOLID,
            "deg",
            None,
            f"observed, {TITAN_OBLIQUITY.source}, less {_TITAN_IF_SOLID:g} deg of a solid body",
            f"{TITAN_OBLIQUITY.read_in}; that of a solid body: {COMPUTED}",
        )
    },
}

"""Default perturbers, mean orbits, neglected effects and text lists of the built-in bodies."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from earthspin import constants as c
from earthspin.bodies.body import BODIES, NUMBERS, SPIN_FIELDS, Body, body
from earthspin.bodies.earth_moon_sun import MOON, SUN
from earthspin.bodies.giants import ORBITS
from earthspin.bodies.inner import MERCURY, MERCURY_ORBIT
from earthspin.bodies.moons import ORBITS as OF_MOONS
from earthspin.bodies.moons import TITAN_OBLIQUITY
from earthspin.bodies.orbit import Orbit
from earthspin.constants import ARCSEC, AU, DAY, DAYS_PER_CENTURY, JULIAN_YEAR, Constant
from earthspin.errors import Where

# --- planets and default perturbers ---------------------------------------------------------------

#: The planets; the effect ``planets`` adds them to the perturbers.
PLANETS = ("mercury", "venus", "earth", "mars", "jupiter", "saturn", "uranus", "neptune")

_BALAND = "Baland et al. 2023, A&A 670, A29"
_JACOBSON = "C/(M R2) = 0.2405 agrees with the pole of Jacobson 2007, BAAS 39, 317: 0.672"
#: Contributions to the precession rate other than torques on the bulge, by planet and effect.
LEFT_OUT_OF_RATES: dict[str, dict[str, Constant]] = {
    "mars": {
        "geodesic": Constant(-6.754e-3, "arcsec/yr", None, _BALAND, "abstract of arXiv:2211.04937")
    },
    "saturn": {"C from pole data": Constant(-0.07, "arcsec/yr", None, _JACOBSON, c.COMPUTED)},
}

_SUN_AND_MOON = ("sun", "moon")
_PERTURBERS = (
    {name: ("sun",) for name in PLANETS if name != "earth"}
    | {"moon": ("earth", "sun")}
    | {name: (orbit.about, "sun") for name, orbit in OF_MOONS.items()}
)


def default_perturbers(body: Body) -> tuple[Body, ...]:
    """Default perturbers: Sun (planets), planet and Sun (moons), Sun and Moon (Earth, others)."""
    return tuple(BODIES[name] for name in _PERTURBERS.get(body.known_as, _SUN_AND_MOON))


def on_its_orbit(body: Body) -> Body:
    """Set the mean orbit of a giant planet without orbit and position; return others unchanged."""
    placed = body.orbit is not None or body.position is not None
    if placed or body.known_as not in ORBITS:
        return body
    orbit = ORBITS[body.known_as]
    assert orbit.a is not None
    # with its period, the orbit stays the same if an ensemble varies the mass
    nominal = BODIES[body.known_as] if hasattr(body.gm, "dims") else body
    period = 2 * math.pi * math.sqrt(orbit.a**3 / (SUN.gm + nominal.gm_on(SUN)))
    orbit = replace(orbit, period=period)
    return body.replace(orbit=orbit, orbit_pole=body.orbit_pole)


# --- mean orbits ----------------------------------------------------------------------------------

MEAN_ELEMENTS = "Simon et al. 1994, A&A 282, 663 (J2000.0)"
LUNAR_ELEMENTS = "Chapront-Touze & Chapront 1988, A&A 190, 342"

#: Semi-major axis, eccentricity, and inclination to the ecliptic.
SUN_DISTANCE = Constant(1.000001018 * AU, "m", None, MEAN_ELEMENTS, c.SIMON_READ)
SUN_ECCENTRICITY = Constant(0.01670863, "", None, MEAN_ELEMENTS, c.SIMON_READ)
#: Constant of ELP. An ellipse with the same period has 384748 km; the mean of 1/r is 1/(384400 km).
MOON_DISTANCE = Constant(383397772.5, "m", None, LUNAR_ELEMENTS, c.SIMON_READ)
MOON_ECCENTRICITY = Constant(0.05554553, "", None, LUNAR_ELEMENTS, c.SIMON_READ)
MOON_INCLINATION = Constant(5.15668983, "deg", None, LUNAR_ELEMENTS, c.SIMON_READ)

#: Mean longitude and longitude of pericentre at J2000.0, from the ecliptic and equinox of J2000.0.
SUN_LONGITUDE = Constant(280.46645683, "deg", None, MEAN_ELEMENTS, c.SIMON_READ)
SUN_PERIGEE = Constant(282.93734808, "deg", None, MEAN_ELEMENTS, c.SIMON_READ)
MOON_LONGITUDE = Constant(218.31664563, "deg", None, MEAN_ELEMENTS, c.SIMON_READ)
MOON_PERIGEE = Constant(83.35324312, "deg", None, MEAN_ELEMENTS, c.SIMON_READ)
MOON_NODE = Constant(125.04455501, "deg", None, MEAN_ELEMENTS, c.SIMON_READ)
#: Rates of the longitudes of the Moon's perigee and node, from the fixed equinox of J2000.0.
PERIGEE_RATE = Constant(14643420.2669, "0.01 arcsec yr-1", None, MEAN_ELEMENTS, c.SIMON_READ)
NODE_RATE = Constant(-6967919.3631, "0.01 arcsec yr-1", None, MEAN_ELEMENTS, c.SIMON_READ)

_TURN = 1296000.0 * DAYS_PER_CENTURY * DAY  # arcsec s / (100 yr)

#: The Sun on its apparent elliptical orbit about the Earth. Bounds on its errors, as those of the
#: Moon and the giant planets, are differences from DE440.
MEAN_SUN = SUN.replace(
    orbit=Orbit(
        a=SUN_DISTANCE.value,
        period=c.SIDEREAL_YEAR.value,
        e=SUN_ECCENTRICITY.value,
        pericentre=math.radians(SUN_PERIGEE.value),
        mean_anomaly=math.radians(SUN_LONGITUDE.value - SUN_PERIGEE.value),
        about="earth",
        reference=MEAN_ELEMENTS,
        direction_error=50.0 * ARCSEC,
        direction_drift=0.55 * ARCSEC / JULIAN_YEAR,
        distance_error=1.3e7,
        distance_drift=1.55e5 / JULIAN_YEAR,
        rate_error=2e-6,
    )
)
#: The Moon on an ellipse with its sidereal period, with precessing node and perigee.
MEAN_MOON = MOON.replace(
    orbit=Orbit(
        period=c.SIDEREAL_MONTH.value,
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
        direction_error=8700.0 * ARCSEC,
        distance_error=7e6,
        rate_error=2.8e-3,
    )
)
#: Orbits referred to their Laplace planes, by name of the body.
PRECESSING_ORBITS = {MOON.name: MEAN_MOON.orbit, MERCURY.name: MERCURY_ORBIT} | OF_MOONS

_LUNAR_STATE = "energy of the figure averaged over four turns of the node in DE421"
_LUNAR_INCLINATION = "5.145 deg, with which the observed one is made, less that of ELP"
_LUNAR_CORE = "a few thousandths of a degree: arXiv:2201.00803"
#: Obliquity of a solid Titan in its Cassini state, as `cassini_states` computes it, deg.
_TITAN_IF_SOLID = 0.114
_TITAN_OCEAN = f"observed, {TITAN_OBLIQUITY.source}, less {_TITAN_IF_SOLID:g} deg of a solid body"
_TITAN_OCEAN_READ = f"{TITAN_OBLIQUITY.read_in}; that of a solid body: {c.COMPUTED}"
#: Effects not included in the Cassini-state equation, as changes of the obliquity in the upright
#: state, by name of the body.
LEFT_OUT_OF_STATES: dict[str, dict[str, Constant]] = {
    MOON.name: {
        "the Sun in the orbit": Constant(-0.0227, "deg", None, _LUNAR_STATE, c.COMPUTED),
        "spin counted from the node": Constant(-0.0080, "deg", None, _LUNAR_STATE, c.COMPUTED),
        "pull of the Sun": Constant(0.0022, "deg", None, _LUNAR_STATE, c.COMPUTED),
        "mean inclination": Constant(-0.0115, "deg", None, _LUNAR_INCLINATION, c.COMPUTED),
        "fluid core and inner core": Constant(
            0.003, "deg", None, _LUNAR_CORE, "abstract of arXiv:2201.00803"
        ),
    },
    "titan": {
        "ocean under the shell": Constant(
            TITAN_OBLIQUITY.value - _TITAN_IF_SOLID, "deg", None, _TITAN_OCEAN, _TITAN_OCEAN_READ
        )
    },
}


# --- effects beyond a rigid body under torques on its bulge ---------------------------------------

#: Days after the start at which the sizes were measured.
DAYS = (1.0, 10.0, 30.0, 100.0, 365.0, 1000.0, 3650.0, 14000.0)


@dataclass(frozen=True)
class BeyondRigid:
    """Sizes of effects on a body's attitude that the rigid-body model neglects.

    Attributes
    ----------
    sizes : mapping of str to tuple of float
        Largest change of the attitude up to each of `DAYS`, arcsec, by effect.
    source : str
        Source of the sizes.
    unknown : str
        Effects whose sizes are not known.
    """

    sizes: Mapping[str, tuple[float, ...]]
    source: str
    unknown: str = ""

    def after(self, days: float) -> dict[str, float]:
        """Size of each neglected effect after a number of days from the initial epoch, rad.

        Parameters
        ----------
        days : float
            Time since the start. Before the first of `DAYS` a size grows with the square of the
            time, as for an unmodelled torque; beyond the last it is constant.
        """
        early = min(days / DAYS[0], 1.0) ** 2
        place = np.log(np.clip(days, DAYS[0], DAYS[-1]))
        return {
            name: float(early * np.exp(np.interp(place, np.log(DAYS), np.log(size)))) * ARCSEC
            for name, size in self.sizes.items()
        }


#: Sizes by name of the body.
BEYOND_RIGID = {
    "moon": BeyondRigid(
        {
            "harmonics": (0.0092, 0.77, 2.1, 15.0, 120.0, 140.0, 200.0, 275.0),
            "fluid-core": (9.2e-4, 0.074, 0.14, 0.52, 1.6, 4.1, 11.0, 12.0),
            "tides": (3.7e-4, 0.023, 0.054, 0.21, 0.64, 1.2, 3.1, 3.3),
            "flattened-perturber": (7e-6, 5e-4, 6e-4, 0.0022, 0.013, 0.025, 0.064, 0.15),
        },
        "the model of DE421 (Folkner et al. 2009, IPN Progress Report 42-178), integrated by "
        "DOP853 with and without each effect from its librations at 6 dates: largest differences",
        unknown="solid inner core, frequency dependence of the tides",
    ),
    "earth": BeyondRigid(
        {
            "changes of the length of day": (0.061, 0.56, 1.6, 5.2, 17.0, 44.0, 144.0, 347.0),
            "polar motion": (0.0056, 0.053, 0.14, 0.4, 0.6, 0.6, 0.6, 0.6),
            "response of the inside to nutation": (0.0575,) * 8,
        },
        "finals2000A of the IERS, 1973 to 2025, largest changes of UT1 (less the mean spin) and of "
        "the pole over intervals of each length; response: python -m data_tools neglected",
    ),
}


# --- lists as text --------------------------------------------------------------------------------


def all_in_words() -> str:
    """List all built-in bodies as text: perturber only, or spinning too; and unknown numbers."""
    width = max(map(len, BODIES))
    lines = []
    for name, world in BODIES.items():
        missing = [field for field in SPIN_FIELDS if getattr(world, field) is None]
        facts = ["pulls and spins" if len(missing) < len(SPIN_FIELDS) - 1 else "pulls"]
        if name in OF_MOONS:
            facts = [f"{facts[0]} once it has an orbit or a position"]
        if missing and facts[0] != "pulls":
            facts.append(f"not known: {', '.join(missing)}")
        if name in PRECESSING_ORBITS:
            facts.append("locked to its orbit (cassini_states, not precession)")
        lines.append(f"{name:<{width}}  {'; '.join(facts)}")
    return "\n".join([*lines, "", "each number with its source: earthspin info bodies NAME"])


def in_words(name: str) -> str:
    """List every number of a body with its unit, standard deviation and source.

    Raises
    ------
    SceneError
        If there is no such body.
    """
    world = body(name, Where("bodies"))
    lines = [f"{world.name}: {world.reference}", "  ± is one standard deviation"]
    for field, number in NUMBERS.get(world.name, {}).items():
        error = f" ± {number.uncertainty:.2g}" if number.uncertainty else ""
        lines.append(f"  {field} = {number.value:.9g}{error} {number.unit}".rstrip())
        lines.append(f"      {number.source}")
    for moon in world.satellites:
        error = f" ± {moon.gm_uncertainty:.2g}" if moon.gm_uncertainty else ""
        inclination = math.degrees(moon.i)
        lines.append(
            f"  satellite {moon.name}: gm = {moon.gm:.9g}{error} m3 s-2, a = {moon.a:.9g} m, "
            f"i = {inclination:.4g} deg"
        )
        lines.append(f"      {moon.reference}")
    if world.pole is not None:
        lines.append(f"  pole: {world.pole}")
    return "\n".join(lines)

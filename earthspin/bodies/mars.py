"""Mars."""

from __future__ import annotations

import math

from earthspin.bodies.body import Body
from earthspin.constants import DAY, DE440, Constant
from earthspin.sky.moving_pole import MovingPole
from earthspin.sky.poles import Direction, FixedPole

_MRO110B = "Konopliv et al. 2011, Icarus 211, 401 (MRO110B)"

# Normalised coefficients of degree 2.
_C20, _C22, _S22 = -8.7502e-4, -8.4636e-5, 4.8935e-5

J2 = Constant(-_C20 * math.sqrt(5.0), "", 1e-9, _MRO110B + ", normalised C20 = -8.7502e-4")
#: C/(M R2). With it our rate, geodesic precession included, is that observed from the ground.
POLAR_MOMENT = Constant(
    0.36367,
    "",
    0.00010,
    "C/(M R2) after the precession observed by landers; as recalled, not seen in a public copy",
)
#: Rate of precession of the spin axis.
PRECESSION = Constant(
    -7.576, "arcsec yr-1", 0.035, "Folkner et al. 1997, Science 278, 1749 (Viking and Pathfinder)"
)

NUMBERS = {
    "gm": Constant(42828.375816e9, "m3 s-2", None, DE440),
    "radius": Constant(3396000.0, "m", None, "reference radius of Konopliv et al. 2011"),
    "j2": J2,
    "dynamical_flattening": Constant(
        J2.value / POLAR_MOMENT.value,
        "",
        J2.value / POLAR_MOMENT.value * POLAR_MOMENT.relative_uncertainty,
        f"J2 over C/(M R2): {J2.source}; {POLAR_MOMENT.source}",
    ),
    # (B - A)/(M a2) = 4 sqrt(5/12) |C22 + i S22|
    "triaxiality": Constant(
        4 * math.sqrt(5 / 12) * math.hypot(_C22, _S22), "", None, _MRO110B + ", degree 2, order 2"
    ),
    "flattening": Constant(
        (3396.19 - 3376.20) / 3396.19,
        "",
        4e-5,
        "Archinal et al. 2018, Celest. Mech. 130:22, table 4",
    ),
    "spin_period": Constant(
        360.0 / 350.89198226 * DAY, "s", None, "Archinal et al. 2011, Celest. Mech. 109, 101"
    ),
    "orbital_period": Constant(
        686.9798 * DAY, "s", None, "Standish & Williams, approximate elements, sidereal"
    ),
}

#: The IAU's pole of 2015, which moves: ``MARS.replace(pole=MOVING_POLE)``. `MARS` keeps the one of
#: J2000.0, with which the errors of its averages were measured.
MOVING_POLE = MovingPole.published(  # Archinal et al. 2018, Celest. Mech. 130:22, as recalled
    (317.269202, -0.10927547),
    (54.432516, -0.05827105),
    [
        (0.000068, 198.991226, 19139.4819985),
        (0.000238, 226.292679, 38280.8511281),
        (0.000052, 249.663391, 57420.7251593),
        (0.000009, 266.183510, 76560.6367950),
        (0.419057, 79.398932, 0.5042615),
    ],
    [
        (0.000051, 122.433576, 19139.9407476),
        (0.000141, 43.058401, 38280.8753272),
        (0.000031, 57.663379, 57420.7517205),
        (0.000005, 79.476401, 76560.6495004),
        (1.591274, 166.325722, 0.5042615),
    ],
)

MARS = Body.cited(
    "mars",
    NUMBERS,
    naif=(499, 4),
    # Archinal et al. 2011, Celest. Mech. 109, 101, at J2000.0
    pole=FixedPole(math.radians(317.68143), math.radians(52.88650)),
    # from i = 1.84969142, node = 49.55953891 deg to the ecliptic (Standish & Williams)
    orbit_pole=Direction(math.radians(273.37323), math.radians(65.32299)),
    interior="mars-insight",
    observed_wobble=Constant(
        206.9, "d", 0.5, "Konopliv et al. 2020, Geophys. Res. Lett. 47, e2020GL090568"
    ),
    reference="Konopliv et al. 2011; Archinal et al. 2011, 2018; DE440",
)

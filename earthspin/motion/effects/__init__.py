"""Effects on the axes besides the torque on the equatorial bulge, one module for each effect."""

from earthspin.motion.effects.effect import Effect, Numbers
from earthspin.motion.effects.geodesic import GEODESIC
from earthspin.motion.effects.j2_rate import J2_RATE
from earthspin.motion.effects.nonrigid import NONRIGID
from earthspin.motion.effects.planets import PLANETS
from earthspin.motion.effects.second_order import SECOND_ORDER
from earthspin.motion.effects.triaxiality import TRIAXIALITY
from earthspin.motion.effects.zonal import J3, J4

__all__ = [
    "EFFECTS", "GEODESIC", "MEASURED_WITH", "NONRIGID", "PLANETS", "RIGID", "SECOND_ORDER",
    "Effect", "Numbers", "add",
]  # fmt: skip

#: All effects by name.
EFFECTS: dict[str, Effect] = {
    effect.name: effect
    for effect in (PLANETS, J3, J4, TRIAXIALITY, GEODESIC, J2_RATE, SECOND_ORDER, NONRIGID)
}

#: Names of the effects with which the errors of the solver were measured.
MEASURED_WITH = tuple(EFFECTS)

#: Names of the effects on a rigid body.
RIGID = tuple(name for name in EFFECTS if name != NONRIGID.name)


def add(effect: Effect) -> None:
    """Register a new effect on the axes; it is switched off by default.

    Raises
    ------
    ValueError
        If another effect has this name.
    """
    if EFFECTS.setdefault(effect.name, effect) is not effect:
        raise ValueError(f"another effect has the name '{effect.name}'; choose a different one")

"""What moves the axes beside the pull on the bulge, one effect a file."""

from earthspin.motion.effects.effect import MEASURED, SOURCE, Effect, Growth, Numbers
from earthspin.motion.effects.geodesic import GEODESIC
from earthspin.motion.effects.j2_rate import J2_RATE
from earthspin.motion.effects.nonrigid import NONRIGID
from earthspin.motion.effects.planets import PLANETS
from earthspin.motion.effects.second_order import SECOND_ORDER
from earthspin.motion.effects.triaxiality import TRIAXIALITY
from earthspin.motion.effects.zonal import J3, J4

__all__ = [
    "EFFECTS", "GEODESIC", "MEASURED", "MEASURED_WITH", "NONRIGID", "PLANETS", "RIGID", "SOURCE",
    "Effect", "Growth", "Numbers", "add",
]  # fmt: skip

#: Every effect by its word.
EFFECTS: dict[str, Effect] = {
    effect.name: effect
    for effect in (PLANETS, J3, J4, TRIAXIALITY, GEODESIC, J2_RATE, SECOND_ORDER, NONRIGID)
}

#: Words of those with which the errors of the solver were measured.
MEASURED_WITH = tuple(EFFECTS)

#: Words of those that move a rigid body: what is switched on unless others are named.
RIGID = tuple(name for name in EFFECTS if name != NONRIGID.name)


def add(effect: Effect) -> None:
    """Let a further effect be asked for by its word; it is off unless it is named.

    Raises
    ------
    ValueError
        If the word stands for another effect.
    """
    if EFFECTS.setdefault(effect.name, effect) is not effect:
        raise ValueError(f"'{effect.name}' is the word for another effect")

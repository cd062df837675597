"""Reasons for leaving a part out, and readings of a key, that several parts share."""

from __future__ import annotations

from typing import TYPE_CHECKING

from earthspin.bodies import IAU_2006

if TYPE_CHECKING:
    from earthspin.scene.spec import Scene


def needs_iau(scene: Scene) -> str | None:
    """Leave out what stands on the IAU's models, for a body that has none."""
    if scene.body.pole != IAU_2006:
        return f"the IAU has no precession model for {scene.body.name}"
    return None


def needs_sun_and_moon_alone(scene: Scene) -> str | None:
    """Leave out what compares the pull of sun and moon, no less and no more, with the IAU's."""
    names = {p.name for p in scene.perturbers}
    missing = [name for name in ("sun", "moon") if name not in names]
    if missing:
        return needs_iau(scene) or f"the {missing[0]} is not among the perturbers"
    if len(names) > 2:
        return needs_iau(scene) or "the comparison is for sun and moon alone"
    return needs_iau(scene)


def needs_nonrigid(scene: Scene) -> str | None:
    """Leave out the response of the inside where it is switched off."""
    if scene.compute != "iau" and "nonrigid" not in (scene.effects or ()):
        return "the non-rigid response is switched off"
    return needs_iau(scene)


def without_accuracy(scene: Scene) -> str | None:
    """Leave out what chooses settings where no accuracy is asked for."""
    return "no accuracy is asked for: the finest settings" if scene.accuracy is None else None


def asked_angle(scene: Scene) -> float | None:
    """Accuracy asked for as an angle, rad."""
    from earthspin.units import number

    if scene.accuracy is None:
        return None
    return number(scene.accuracy, "rad", f"{scene.source}: accuracy", "1 mas")


def refuse_angle(asked: float | None, best: float, remedy: str) -> None:
    """Refuse an angle that is not kept; both in rad.

    Raises
    ------
    AccuracyError
    """
    from earthspin.constants import MAS

    if asked is not None:
        refuse_unkept(asked / MAS, best / MAS, "mas", remedy)


def refuse_unkept(asked: float, best: float, unit: str, remedy: str) -> None:
    """Refuse an accuracy that is not kept, but for what a change of units rounds away.

    Raises
    ------
    AccuracyError
    """
    from earthspin.errors import AccuracyError

    if not best <= asked * (1 + 1e-12):
        raise AccuracyError(asked, best, unit, remedy)

"""Conditions under which results are left out, and published rates of neglected effects."""

from __future__ import annotations

from collections.abc import Collection

from earthspin.bodies import Body, in_a_sentence, proper
from earthspin.constants import PUBLISHED_EFFECTS
from earthspin.engine.neglected import Neglected
from earthspin.nutation.budget import published_effects


def no_iau_model(body: Body) -> str | None:
    """If the IAU has no precession model of the body, return why IAU results are left out.

    Otherwise return None.
    """
    described = body.pole is not None and body.pole.of_the_iau
    return None if described else f"the IAU has no precession model for {in_a_sentence(body.name)}"


def not_sun_and_moon(body: Body, perturbers: tuple[Body, ...]) -> str | None:
    """If body or perturbers do not fit, return why IAU comparisons are left out; otherwise None.

    These need a body with an IAU precession model and only the Sun and the Moon as perturbers.
    """
    if no_iau_model(body):
        return no_iau_model(body)
    names = {p.name for p in perturbers}
    missing = [name for name in ("sun", "moon") if name not in names]
    if missing:
        return f"the {missing[0]} is not among the perturbers"
    return "the comparison is for Sun and Moon only" if len(names) > 2 else None


def not_the_iaus_earth(body: Body, perturbers: tuple[Body, ...]) -> str | None:
    """If the Earth or its perturbers are modified, return why IAU numbers are left out.

    Otherwise return None.
    """
    if not_sun_and_moon(body, perturbers):
        return not_sun_and_moon(body, perturbers)
    if body.is_as_named:
        return None
    return f"the IAU's numbers do not apply to a modified {proper(body.name)}: {body.changes}"


def no_moon(body: Body, perturbers: tuple[Body, ...]) -> str | None:
    """If the Moon does not perturb the Earth, return why lunar results are left out; else None."""
    if no_iau_model(body):
        return no_iau_model(body)
    has_moon = "moon" in {p.name for p in perturbers}
    return None if has_moon else "the moon is not among the perturbers"


def no_accuracy(accuracy: float | None) -> str | None:
    """If no accuracy is requested, return why no settings are chosen for it; otherwise None."""
    return "no accuracy is requested, so the finest settings are used" if accuracy is None else None


def many_pulls(perturbers: tuple[Body, ...]) -> str | None:
    """If the mass of a perturber is an array, return why some results are left out; else None.

    These are results that need one number for each mass.
    """
    arrays = [p.name for p in perturbers if hasattr(p.gm, "dims")]
    return f"the mass of '{arrays[0]}' is an array" if arrays else None


def neglected_rates(modelled: Collection[str] = ()) -> Neglected:
    """Published contributions to the rate of psi_A of the effects that are not modelled."""
    return Neglected(
        {name: size for name, size in published_effects().items() if name not in modelled},
        "arcsec/yr",
        "published contribution to the rate of an effect that is not modelled",
        next(iter(PUBLISHED_EFFECTS.values())).source,
    )

"""Reasons for leaving a part out that several questions share, and published sizes."""

from __future__ import annotations

from collections.abc import Collection

from earthspin.bodies import Body, in_a_sentence, proper
from earthspin.constants import PUBLISHED_EFFECTS
from earthspin.engine.neglected import Neglected
from earthspin.nutation.budget import published_effects


def no_iau_model(body: Body) -> str | None:
    """Leave out what stands on the IAU's models, for a body that has none."""
    described = body.pole is not None and body.pole.of_the_iau
    return None if described else f"the IAU has no precession model for {in_a_sentence(body.name)}"


def not_sun_and_moon(body: Body, perturbers: tuple[Body, ...]) -> str | None:
    """Leave out what compares the pull of Sun and Moon, no less and no more, with the IAU's."""
    if no_iau_model(body):
        return no_iau_model(body)
    names = {p.name for p in perturbers}
    missing = [name for name in ("sun", "moon") if name not in names]
    if missing:
        return f"the {missing[0]} is not among the perturbers"
    return "the comparison is for Sun and Moon only" if len(names) > 2 else None


def not_the_iaus_earth(body: Body, perturbers: tuple[Body, ...]) -> str | None:
    """Leave the IAU's numbers out for an Earth whose figure or spin has been changed."""
    if not_sun_and_moon(body, perturbers):
        return not_sun_and_moon(body, perturbers)
    if body.is_as_named:
        return None
    return f"the IAU's numbers are those of another {proper(body.name)}: {body.changes}"


def no_moon(body: Body, perturbers: tuple[Body, ...]) -> str | None:
    """Leave out what follows the Moon above the Earth's equator."""
    if no_iau_model(body):
        return no_iau_model(body)
    there = "moon" in {p.name for p in perturbers}
    return None if there else "the moon is not among the perturbers"


def no_accuracy(accuracy: float | None) -> str | None:
    """Leave out what chooses settings where no accuracy is asked for."""
    return (
        "no accuracy is asked for, so the finest settings are taken" if accuracy is None else None
    )


def many_pulls(perturbers: tuple[Body, ...]) -> str | None:
    """Leave out what is drawn of one sky where a mass stands for many."""
    many = [p.name for p in perturbers if hasattr(p.gm, "dims")]
    return f"the mass of '{many[0]}' stands for many" if many else None


def neglected_rates(modelled: Collection[str] = ()) -> Neglected:
    """Published contributions to the rate of psi_A, those of some effects excluded."""
    return Neglected(
        {name: size for name, size in published_effects().items() if name not in modelled},
        "arcsec/yr",
        "published contribution to the rate that the model leaves out",
        next(iter(PUBLISHED_EFFECTS.values())).source,
    )

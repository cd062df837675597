"""Reasons to omit results, and published numbers for comparison with results."""

from __future__ import annotations

import math
from collections.abc import Collection

import numpy as np

from earthspin.bodies import Body, in_a_sentence, label_of, proper
from earthspin.constants import DAY, NORMAL_95, PUBLISHED_EFFECTS
from earthspin.engine import Neglected, Variables, measured, part
from earthspin.numerics.arrays import Numeric
from earthspin.nutation.rate_budget import published_effects
from earthspin.questions.ellipse_chains import cases


def no_iau_model(body: Body) -> str | None:
    """Return the reason (text) to omit IAU results if the body has no IAU model, else None.

    The model is that of its precession.
    """
    if body.pole is not None and body.pole.of_the_iau:
        return None
    if body.naif:
        return f"the IAU has no precession model for {in_a_sentence(body.name)}"
    return "the precession model of the IAU is for the real Earth only"


def not_sun_and_moon(body: Body, perturbers: tuple[Body, ...]) -> str | None:
    """Return the reason (text) to omit IAU comparisons if they do not apply, else None.

    These need a body with an IAU precession model and only the Sun and the Moon as perturbers.
    """
    more = "the comparison is for Sun and Moon only" if len(perturbers) > 2 else None
    return _lacking(body, perturbers, "sun", "moon") or more


def not_the_iaus_earth(body: Body, perturbers: tuple[Body, ...]) -> str | None:
    """Return the reason (text) to omit IAU numbers if the Earth is modified, else None.

    These need the unmodified Earth, with only the Sun and the Moon as perturbers.
    """
    if reason := not_sun_and_moon(body, perturbers):
        return reason
    if body.is_as_named:
        return None
    return f"the IAU's numbers do not apply to a modified {proper(body.name)}: {body.changes}"


def no_moon(body: Body, perturbers: tuple[Body, ...]) -> str | None:
    """Return the reason (text) to omit lunar results if the Moon is no perturber, else None."""
    return _lacking(body, perturbers, "moon")


def _lacking(body: Body, perturbers: tuple[Body, ...], *names: str) -> str | None:
    """Return the reason (text): no IAU model, or a missing perturber; None if neither applies."""
    missing = (name for name in names if label_of(name, perturbers) is None)
    reasons = (f"the {name} is not among the perturbers" for name in missing)
    return no_iau_model(body) or next(reasons, None)


def mass_is_array(perturbers: tuple[Body, ...]) -> str | None:
    """Return why results are omitted (text) if the mass of a perturber is an array, else None.

    These are results that need one number for each mass.
    """
    arrays = [p.name for p in perturbers if hasattr(p.gm, "dims")]
    return f"the mass of '{arrays[0]}' is an array" if arrays else None


def orbit_is_array(body: Body, perturbers: tuple[Body, ...]) -> str | None:
    """Return why results that need one orbit are omitted (text) if there are many, else None."""
    many = bool(cases(body, perturbers)[0])
    return "orbits, poles or satellites are arrays" if many else None


def north_note(body: Body, obliquity: Numeric | None = None) -> dict[str, str]:
    """Attributes that explain the obliquity of a body that spins backwards; empty for other bodies.

    Parameters
    ----------
    body : Body
    obliquity : float, optional
        rad; None if it changes in time.
    """
    period = body.spin_period
    if period is None or not bool(np.any(np.asarray(period) < 0)):
        return {}
    note = {
        "north": f"the pole of {in_a_sentence(body.name)}, about which it spins backwards; "
        "the angle of the spin vector is 180 deg minus this"
    }
    if obliquity is not None and not np.ndim(obliquity):
        note["spin_obliquity"] = f"{180 - math.degrees(obliquity):.2f} deg"
    return note


def neglected_rates(modelled: Collection[str] = ()) -> Neglected:
    """Published contributions to the rate of psi_A by effects that are not modelled."""
    return Neglected(
        {name: size for name, size in published_effects().items() if name not in modelled},
        "arcsec/yr",
        "published contribution that the computed rate leaves out",
        next(iter(PUBLISHED_EFFECTS.values())).source,
    )


# --- observed wobble -----------------------------------------------------------------------------


class ObservedWobble(Variables):
    """Observed period of the free wobble, as a variable of a result (Dataset)."""

    observed_period = measured("d", "observed period of the free wobble")


def no_observed_wobble(body: Body) -> str | None:
    """Return the reason (text) to omit the observed period if no wobble was observed, else None."""
    if body.observed_wobble:
        return None
    return f"no observed wobble of this {proper(body.name)} is known"


@part(unless=no_observed_wobble)
def observed_wobble(body: Body) -> ObservedWobble:
    """Observed period of the free wobble from the literature."""
    observed = body.observed_wobble
    assert observed is not None
    period = observed.value * DAY
    half_width = NORMAL_95 * period * observed.relative_uncertainty
    return ObservedWobble(observed_period=(period, half_width)).with_attributes(
        observed_period={"references": observed.source}
    )

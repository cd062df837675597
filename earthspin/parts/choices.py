"""Choose the cheapest settings of a method whose error is within the requested accuracy."""

from __future__ import annotations

import math

from earthspin.bodies import BODIES, PLANETS, Body
from earthspin.choosing.averages import Averaging, average_choices
from earthspin.choosing.choice import Choice, cheapest
from earthspin.choosing.nutation import NutationNodes, nutation_choices
from earthspin.choosing.promises import MARGIN
from earthspin.choosing.windows import PoleWindows, window_choices
from earthspin.constants import DAY
from earthspin.dates import Epochs
from earthspin.engine.part import part
from earthspin.motion.effects import GEODESIC, MEASURED_WITH
from earthspin.parts.pulls import Pulls, forces_of, start_of
from earthspin.parts.reasons import no_accuracy, no_iau_model
from earthspin.parts.sky import Sky, Stretch
from earthspin.sky.sources import OF_DATE, SourceName
from earthspin.torque.rates import left_for_method


def available_windows(
    body: Body,
    perturbers: tuple[Body, ...],
    effects: tuple[str, ...],
    pulls: Pulls,
    epochs: Epochs,
) -> list[Choice[PoleWindows]]:
    """Possible window lengths of the axis integration with their errors; empty if not measured."""
    measured = set(effects) <= set(MEASURED_WITH)
    if not measured or not all(member.naif for member in (body, *perturbers)):
        return []
    forces = forces_of(body, pulls, effects)
    _, epoch = start_of(body, pulls)
    first, last = (day * DAY - epoch for day in epochs.span())
    bodies = {name: BODIES[name] for name in PLANETS} | {p.name: p for p in perturbers}
    masses: dict[int, float] = {}
    for name, gm in forces.gm.items():
        code = bodies[name].naif[0]
        masses[code] = masses.get(code, 0.0) + gm
    return window_choices(
        body.naif[0],
        forces.figure,
        masses,
        (first, last),
        geodesic=forces.gm.get("sun", 0.0) if GEODESIC.name in effects else 0.0,
    )


@part(unless=no_accuracy, chooses=True)
def chosen_windows(
    body: Body,
    perturbers: tuple[Body, ...],
    effects: tuple[str, ...],
    pulls: Pulls,
    epochs: Epochs,
    accuracy: float | None,
) -> list[Choice[PoleWindows]]:
    """Choose the cheapest window length of the axis integration within the requested accuracy.

    The list also contains the most accurate window length. It is empty if no errors were measured
    for these bodies and positions.
    """
    menu = available_windows(body, perturbers, effects, pulls, epochs)
    exact = body.relative_uncertainty.get("dynamical_flattening", 0.0) == 0
    # The error from H is known only after the integration; until then, assume equal shares.
    share = MARGIN if exact else MARGIN / math.sqrt(2)
    best = [min(menu, key=lambda choice: choice.error)] if menu else []
    choice = cheapest(menu, (accuracy or math.inf) * share)
    return best if choice is None else [choice, *best]


@part(unless=no_accuracy, chooses=True)
def chosen_average(
    body: Body, perturbers: tuple[Body, ...], stretch: Stretch, accuracy: float | None
) -> Choice[Averaging] | None:
    """Choose the cheapest time window and sampling step of an average for the requested accuracy.

    The result is None if no errors were measured for these bodies and positions.
    """
    u_h = body.relative_uncertainty.get("dynamical_flattening", 0.0)
    # A single perturber may cause the whole rate, so use the largest uncertainty of any GM.
    u_gm = max(p.relative_uncertainty.get("gm", 0.0) for p in perturbers)
    allowed = MARGIN * left_for_method(accuracy or math.inf, u_h, u_gm)
    menu = average_choices(body, perturbers, stretch.first, stretch.last)
    widest = max((choice.settings.cycles for choice in menu), default=0)
    # If no setting is accurate enough, take the longest window with the smallest step.
    finest = next((choice for choice in menu if choice.settings.cycles == widest), None)
    return cheapest(menu, allowed) or finest


def on_mean_equator(equator: str) -> str | None:
    """Return the reason (text) to omit nutation if the mean equator is requested, else None."""
    return "the equator is the mean one" if equator == "mean" else None


def source_has_equator(source: SourceName) -> str | None:
    """Return the reason (text) to omit nutation if the source has its own equator, else None.

    This is a source of positions that has the equator of date.
    """
    return f"{source} has the equator of date" if source in OF_DATE else None


@part(unless=(no_accuracy, on_mean_equator, no_iau_model, source_has_equator), chooses=True)
def chosen_nutation(
    sky: Sky, epochs: Epochs, accuracy: float | None
) -> Choice[NutationNodes | None] | None:
    """Choose the cheapest way to compute nutation that meets the requested accuracy.

    The accuracy is first reduced by the error of the ephemeris.
    """
    kernel = max(sky.error(place, epochs.span())[0] for place in sky.targets.values())
    allowed = (accuracy or math.inf) - kernel
    first, last = epochs.span()
    return cheapest(nutation_choices(first, last, epochs.size), MARGIN * allowed)

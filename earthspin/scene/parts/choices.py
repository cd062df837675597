"""Settings for the accuracy that a scene asks for."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.scene.part import Part
from earthspin.scene.parts.conditions import asked_angle, needs_iau, without_accuracy

if TYPE_CHECKING:
    from earthspin.scene.choosing import AverageChoice, Choice
    from earthspin.scene.spec import Scene

#: Of what is asked for, what is given to the method, so that a result never claims more than asked.
MARGIN = 0.99


def windows_on_offer(scene: Scene, given: Mapping[str, Any]) -> list[Choice]:
    """Windows of the pole; none where the sky was not measured."""
    from earthspin.bodies import BODIES, PLANETS
    from earthspin.constants import DAY
    from earthspin.scene.choosing import window_choices
    from earthspin.scene.parts.axes_in_time import pole_times
    from earthspin.scene.parts.pulls import forces_of, start_of

    forces = forces_of(scene, given["pulls"], scene.effects or ())
    _, epoch = start_of(scene, given["pulls"])
    first, last = (day * DAY - epoch for day in pole_times(scene).span())
    bodies = {name: BODIES[name] for name in PLANETS} | {p.name: p for p in scene.perturbers}
    masses: dict[int, float] = {}
    for name, gm in forces.gm.items():
        code = bodies[name].naif[0]
        masses[code] = masses.get(code, 0.0) + gm
    return window_choices(
        scene.body.naif[0],
        forces.figure,
        masses,
        (first, last),
        geodesic=0.0 if forces.primary is None else forces.gm[forces.primary],
    )


def chosen_windows(scene: Scene, given: Mapping[str, Any]) -> list[Choice]:
    """Windows of the pole to try: the cheapest that will do, then the most accurate.

    Empty where the sky was not measured.
    """
    from earthspin.scene.choosing import cheapest

    menu = windows_on_offer(scene, given)
    asked = asked_angle(scene) or math.inf
    exact = scene.body.relative_uncertainty.get("dynamical_flattening", 0.0) == 0
    # what H takes of the request is known when the path is; half and half until then
    share = MARGIN if exact else MARGIN / math.sqrt(2)
    best = [min(menu, key=lambda choice: choice.error)] if menu else []
    choice = cheapest(menu, asked * share)
    return best if choice is None else [choice, *best]


def averages_on_offer(scene: Scene, given: Mapping[str, Any]) -> list[AverageChoice]:
    """Windows of an average over orbits; none where the sky was not measured."""
    from earthspin.bodies import IAU_2006
    from earthspin.constants import DAY
    from earthspin.scene.choosing import Pull, Pushed, average_choices
    from earthspin.sky.equator import angle, orbit_normal, pole_at
    from earthspin.torque.average import best_window

    body, sky = scene.body, given["ephemeris"]
    cycle = max(p.cycle for p in scene.perturbers)
    normal = orbit_normal(body.needed("pole"), body.orbit_pole)
    pushed = Pushed(
        code=body.naif[0],
        obliquity=angle(pole_at(body.needed("pole"), 0.0), normal),
        normal=normal,
        moving=body.pole == IAU_2006,
        pulls={p.name: Pull(p.naif[0], float(p.gm), p.slow_swing) for p in scene.perturbers},
        cycle=cycle,
    )
    widest = best_window(sky.span[0] * DAY, sky.span[1] * DAY, cycle)
    return average_choices(pushed, widest.cycles)


def chosen_average(scene: Scene, given: Mapping[str, Any]) -> AverageChoice | None:
    """Cheapest window of an average over orbits, or None where the sky was not measured."""
    from earthspin.scene.choosing import cheapest
    from earthspin.torque.rates import left_for_method

    u_h = scene.body.relative_uncertainty.get("dynamical_flattening", 0.0)
    # the strongest pull may be all of the rate: its GM stands for all
    u_gm = max(p.relative_uncertainty.get("gm", 0.0) for p in scene.perturbers)
    allowed = MARGIN * left_for_method(scene.accuracy, u_h, u_gm)
    menu = averages_on_offer(scene, given)
    widest = max((choice.settings["cycles"] for choice in menu), default=0)
    # where none will do, the widest window at the closest step
    finest = next((choice for choice in menu if choice.settings["cycles"] == widest), None)
    return cheapest(menu, allowed) or finest


def chosen_nutation(scene: Scene, given: Mapping[str, Any]) -> Choice | None:
    """Cheapest way to the true equator, next to what the kernel is off by."""
    from earthspin.scene.choosing import cheapest, nutation_choices

    sky, times = given["ephemeris"], given["times"]
    kernel = max(sky.ephemeris.error(code)[0] for code in sky.targets.values())
    left = (asked_angle(scene) or math.inf) - kernel
    first, last = times.span()
    return cheapest(nutation_choices(first, last, times.size), MARGIN * left)


CHOSEN_WINDOWS = Part(
    name="chosen-windows",
    does="the cheapest windows of the pole that meet the accuracy asked for",
    function="earthspin.scene.parts.choices:chosen_windows",
    needs=("pulls",),
    keys=("body", "perturbers", "effects", "accuracy", "span", "step", "times"),
    left_out=without_accuracy,
)

CHOSEN_AVERAGE = Part(
    name="chosen-average",
    does="the cheapest window and step of the averages that meet the accuracy asked for",
    function="earthspin.scene.parts.choices:chosen_average",
    needs=("ephemeris",),
    keys=("body", "perturbers", "accuracy"),
    left_out=without_accuracy,
)

CHOSEN_NUTATION = Part(
    name="chosen-nutation",
    does="the cheapest nutation that meets the accuracy asked for",
    function="earthspin.scene.parts.choices:chosen_nutation",
    needs=("times", "ephemeris"),
    keys=("accuracy",),
    left_out=lambda scene: (
        without_accuracy(scene)
        or ("the equator is the mean one" if scene.equator == "mean" else needs_iau(scene))
    ),
)

#: The parts that choose.
CHOOSING = (CHOSEN_WINDOWS.name, CHOSEN_AVERAGE.name, CHOSEN_NUTATION.name)

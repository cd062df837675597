"""Accuracy on request over random scenes: ``python -m tests.choosing.accuracy [scenes of a kind]``.

For each scene: what was asked, what was claimed, how far off the result truly is, how many
evaluations the choice cost, and what the cheapest setting of the menu that truly meets the request
would have cost. The truth is the same question at settings far finer than any on the menu.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.random import Generator

import earthspin
from earthspin import Body
from earthspin.choosing.averages import average_choices
from earthspin.choosing.choice import models
from earthspin.choosing.nutation import nutation_choices
from earthspin.constants import ARCSEC, DAY
from earthspin.errors import AccuracyError, UndefinedError
from earthspin.motion.axes import AXES, axis_path
from earthspin.parts.averages import mean_rates, mean_torques, torque_samples, window_means
from earthspin.parts.choices import available_windows, chosen_average
from earthspin.parts.pulls import Pulls, forces_of, pulls, start_of
from earthspin.parts.sky import PerturbedBody, Sky, places, sky, stretch
from earthspin.parts.times import epochs
from earthspin.questions.pole import Pole
from earthspin.questions.precession import Precession, rate_accuracy
from earthspin.questions.torque import Torque
from earthspin.sky.equator import rotate
from earthspin.sky.iau import Nutation
from earthspin.torque.average import Window

UAS = 1e-6 * ARCSEC
#: Settings whose bound is further than this from the request are not tried for being cheap.
HOPELESS = 30


class Outcome(NamedTuple):
    """What became of one scene; errors in the unit of the request.

    `cheapest` is None where it was not looked for; `asked` less than what is left to the method
    where the kernel takes its share.
    """

    words: str
    asked: float
    claimed: float
    true: float
    cost: int
    cheapest: int | None


# --- the pole ------------------------------------------------------------------------------------


def random_body(rng: Generator) -> Body:
    """An Earth or Mars of another flattening, spin, and sometimes pole, known exactly."""
    start = earthspin.EARTH if rng.random() < 0.6 else earthspin.MARS
    h = 10 ** rng.uniform(-5, -2) * rng.choice([1, 1, 1, -1])
    changes: dict[str, Any] = {
        "j2": 0.35 * h,
        "dynamical_flattening": h,
        "spin_period": 86400 * 10 ** rng.uniform(-0.6, 0.3) * rng.choice([1, 1, -1]),
    }
    if start is earthspin.MARS or rng.random() < 0.3:
        pole = rng.uniform(0, 2 * np.pi), np.arcsin(rng.uniform(-1, 1))
        changes |= {"pole": pole, "orbit_pole": earthspin.MARS.orbit_pole}
    return start.replace(**changes)


def random_span(rng: Generator, longest: float) -> tuple[str, str]:
    """Dates between 1900 and 2050, from days to years apart."""
    length = 365.25 * 10 ** rng.uniform(-1.5, np.log10(longest))
    first = rng.uniform(-36000, 18000 - length)
    epoch = np.datetime64("2000-01-01T12:00", "s")
    return tuple(str(epoch + np.timedelta64(int(d * 86400), "s")) for d in (first, first + length))  # type: ignore[return-value]


def sky_of(question: PerturbedBody) -> Sky:
    """The sky of a question."""
    return sky(question.ephemeris, places(question.body, question.perturbers), question.source)


def pulls_of(question: Pole) -> Pulls:
    """What turns the axis of a question."""
    body, perturbers = question.body, question.perturbers
    return pulls(sky_of(question), body, perturbers, question.effects)


def true_axes(question: Pole, window: float, order: int) -> np.ndarray:
    """Axes of a question on windows of one's own, shape (time, axis, 3)."""
    turned_by = pulls_of(question)
    times = epochs(question.span, question.step, question.times)
    first, last = times.span()
    axis, epoch = start_of(question.body, turned_by)
    path = axis_path(
        forces_of(question.body, turned_by, question.effects),
        axis,
        epoch,
        (first * DAY, last * DAY),
        limits=turned_by.limits,
        window=window,
        order=order,
    )
    found = path.at(times.days(0, times.size) * DAY)
    return np.stack([found[name] for name in AXES], axis=1)


def pole_outcome(rng: Generator) -> Outcome:
    """Ask for a path of the pole; nine decades of accuracy."""
    body = random_body(rng)
    perturbers = ["sun"]
    if body.name == "earth":
        perturbers = [["sun", "moon"], ["sun"], ["moon"]][rng.choice(3, p=[0.7, 0.2, 0.1])]
    asked = 10 ** rng.uniform(-0.7, 8.3)  # uas
    question = Pole(
        body=body,
        perturbers=perturbers,
        effects=None if rng.random() < 0.3 else ["second-order"],
        span=random_span(rng, 40),
        step="7.3 d",
    )
    # below what the sky is known to, a promise is refused
    floor = float(earthspin.run(question).direction_error_kernel.max()) * 1e6
    asked = max(asked, 1.2 * floor)
    question = question.replace(accuracy=f"{asked} uarcsec")
    result = earthspin.run(question)
    truth = true_axes(question, 4 * DAY, 16)

    def off(found: np.ndarray) -> float:
        return float(np.linalg.norm(found - truth, axis=-1).max() / UAS)

    cost, cheapest = int(result.evaluations), int(result.evaluations)
    times = epochs(question.span, question.step, question.times)
    menu = available_windows(body, question.perturbers, question.effects, pulls_of(question), times)
    for choice in sorted(menu, key=lambda c: c.evaluations):
        if choice.evaluations >= cheapest or choice.error > HOPELESS * asked * UAS:
            continue
        try:
            if off(true_axes(question, choice.settings.window, choice.settings.order)) <= asked:
                cheapest = choice.evaluations
        except UndefinedError:
            continue
    found = np.stack([result[c].transpose("time", "axis").values for c in "XYZ"], axis=-1)
    claimed = float(result.error_estimated) * 1e6
    return Outcome(str(result.method_chosen.values), asked, claimed, off(found), cost, cheapest)


# --- the mean rate -------------------------------------------------------------------------------


def rate_outcome(rng: Generator) -> Outcome:
    """Ask for a rate of precession."""
    if rng.random() < 0.5:
        body, perturbers = earthspin.EARTH, ["sun", "moon"]
    elif rng.random() < 0.5:
        body, perturbers = earthspin.EARTH, ["sun"]
    else:
        body, perturbers = earthspin.MARS, ["sun"]
    h = 10 ** rng.uniform(-5, -2)
    changes: dict[str, Any] = {"j2": 0.35 * h, "dynamical_flattening": h}
    if body is earthspin.MARS:
        changes["pole"] = rng.uniform(0, 2 * np.pi), np.arcsin(rng.uniform(-1, 1))
    asked = 10 ** rng.uniform(-5.7, 0)
    question = Precession(body=body.replace(**changes), perturbers=perturbers, accuracy=asked)
    body, pulling = question.body, question.perturbers
    above = sky_of(question)
    within = stretch(above, question.span)
    samples = torque_samples(above, within, body, pulling)  # daily, on the widest window
    precessing = (
        samples.precessing.sum(axis=1)
        if len(pulling) == 1
        else samples.precessing[:, :2].sum(axis=1)
    )
    truth = samples.window.mean(samples.times, precessing)

    def off(cycles: float, step: float) -> float:
        window = Window(samples.window.centre, cycles, samples.window.cycle, "sin4")
        times = window.sample_times(step)
        picked = precessing[np.rint((times - samples.times[0]) / DAY).astype(int)]
        return float(abs(window.mean(times, picked) / truth - 1))

    choice = chosen_average(body, pulling, within, asked)
    fewer = torque_samples(above, within, body, pulling, choice)
    rates = mean_rates(mean_torques(window_means(fewer, pulling, choice)), body, pulling)
    report = rate_accuracy(rates, asked).dataset()
    cost = cheapest = int(report.evaluations)
    menu = average_choices(body, pulling, within.first, within.last)
    for one in sorted(menu, key=lambda c: c.evaluations):
        if one.evaluations < cheapest and off(one.settings.cycles, one.settings.step) <= asked:
            cheapest = one.evaluations
    widest = mean_rates(mean_torques(window_means(samples, pulling)), body, pulling)
    rate, best = (float(of.rate.value[-1]) for of in (rates, widest))
    return Outcome(
        str(report.method_chosen.values),
        asked,
        float(report.error_estimated),
        abs(rate / best - 1),
        cost,
        cheapest,
    )


# --- directions at the true equator --------------------------------------------------------------


def series_outcome(rng: Generator) -> Outcome:
    """Ask for declinations at the true equator."""
    perturbers = ["sun", "moon"] if rng.random() < 0.5 else ["sun"]
    asked = 10 ** rng.uniform(0.9, 5.5)  # mas
    span = random_span(rng, 20)
    step = float(10 ** rng.uniform(-0.5, 1.5))
    question = Torque(
        perturbers=perturbers,
        equator="true",
        span=span,
        step=f"{step} d",
        accuracy=f"{asked} mas",
    )
    result = earthspin.run(question)
    above = sky_of(question)
    days = epochs(question.span, question.step, question.times)
    now = days.days(0, days.size)
    first, last = days.span()
    exact = Nutation(first, last, 0)
    place = above.positions(now)
    directions = {n: p / np.linalg.norm(p, axis=1, keepdims=True) for n, p in place.items()}
    kernel = max(above.error(code)[0] for code in above.targets.values()) / ARCSEC * 1e3

    def off(equator: np.ndarray) -> float:
        best = exact.true_equator(now)
        turned = (rotate(equator, d) - rotate(best, d) for d in directions.values())
        return max(float(np.linalg.norm(t, axis=1).max()) for t in turned) / ARCSEC * 1e3

    from earthspin.sky import iau

    cost = cheapest = int(result.evaluations) - now.size * len(perturbers)
    for choice in nutation_choices(first, last, now.size):
        if choice.evaluations < cheapest:
            equator = (
                Nutation(
                    first,
                    last,
                    now.size,
                    model=choice.settings.model,
                    spacing=choice.settings.spacing,
                ).true_equator(now)
                if choice.settings
                else iau.mean_equator(now)
            )
            if off(equator) + kernel <= asked:
                cheapest = choice.evaluations
    ra, dec = (np.radians(result[n].values) for n in ("right_ascension", "declination"))
    seen = np.stack([np.cos(dec) * np.cos(ra), np.cos(dec) * np.sin(ra), np.sin(dec)], axis=-1)
    best = exact.true_equator(now)
    true = max(
        float(np.linalg.norm(seen[:, i] - rotate(best, directions[name]), axis=1).max())
        for i, name in enumerate(perturbers)
    )
    return Outcome(
        str(result.method_chosen.values),
        asked,
        float(result.error_estimated) * 1e3,
        true / ARCSEC * 1e3 + kernel,
        cost + now.size * len(perturbers),
        cheapest + now.size * len(perturbers),
    )


KINDS: dict[str, Callable[[Generator], Outcome]] = {
    "pole": pole_outcome,
    "precession": rate_outcome,
    "torque": series_outcome,
}


def outcomes(kind: str, count: int, seed: int = 7) -> Iterator[Outcome]:
    """Outcomes of random scenes; those that are refused say so by their number alone."""
    rng = np.random.default_rng([seed, *map(ord, kind)])
    for _ in range(count):
        try:
            yield KINDS[kind](rng)
        except AccuracyError as error:
            yield Outcome("refused", error.asked, error.best, error.best, 0, None)


def summary(found: list[Outcome]) -> dict[str, float]:
    """Share within the request, worst ratio, costs over the cheapest."""
    met = [o for o in found if o.cheapest is not None]
    ratio = np.array([o.true / o.asked for o in met])
    cost = np.array([o.cost / max(o.cheapest or 1, 1) for o in met])
    return {
        "scenes": len(found),
        "refused": len(found) - len(met),
        "within": float(np.mean(ratio <= 1)),
        "worst": float(ratio.max()),
        "median cost": float(np.median(cost)),
        "95 % cost": float(np.percentile(cost, 95)),
    }


def main() -> None:
    """Print a row for each kind."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    for kind in sys.argv[2:] or KINDS:
        found = list(outcomes(kind, count))
        print(kind, {key: round(value, 3) for key, value in summary(found).items()}, flush=True)
        worst = sorted(found, key=lambda o: -(o.cost / max(o.cheapest or o.cost or 1, 1)))[:3]
        for outcome in worst:
            print("   dearest:", outcome)
        for outcome in sorted(found, key=lambda o: -o.true / o.asked)[:2]:
            print("   nearest:", outcome)


if __name__ == "__main__":
    assert models()
    main()

"""Accuracy on request over random scenes: ``python -m tests.scene.accuracy [scenes of a kind]``.

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
from earthspin import Body, Scene
from earthspin.constants import ARCSEC, DAY
from earthspin.errors import AccuracyError, UndefinedError
from earthspin.motion.axes import AXES, axis_path
from earthspin.scene.choosing import models, nutation_choices
from earthspin.scene.parts import PARTS
from earthspin.scene.parts.axes_in_time import pole_times
from earthspin.scene.parts.choices import averages_on_offer, windows_on_offer
from earthspin.scene.parts.pulls import forces_of, start_of
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


def true_axes(scene: Scene, window: float, order: int) -> np.ndarray:
    """Axes of a scene on windows of one's own, shape (time, axis, 3)."""
    given: dict[str, Any] = {"ephemeris": PARTS["ephemeris"].run(scene, {})}
    pulls = PARTS["pulls"].run(scene, given)
    times = pole_times(scene)
    first, last = times.span()
    axis, epoch = start_of(scene, pulls)
    path = axis_path(
        forces_of(scene, pulls, scene.effects or ()),
        axis,
        epoch,
        (first * DAY, last * DAY),
        limits=pulls.limits,
        window=window,
        order=order,
    )
    found = path.at(times.days(0, times.size) * DAY)
    return np.stack([found[name] for name in AXES], axis=1)


def pole_outcome(rng: Generator) -> Outcome:
    """Ask for a path of the pole; nine decades of accuracy."""
    body = random_body(rng)
    pulls = ["sun"]
    if body.name == "earth":
        pulls = [["sun", "moon"], ["sun"], ["moon"]][rng.choice(3, p=[0.7, 0.2, 0.1])]
    asked = 10 ** rng.uniform(-0.7, 8.3)  # uas
    scene = Scene(
        compute="pole",
        body=body,
        perturbers=pulls,
        effects=None if rng.random() < 0.3 else ["second-order"],
        span=random_span(rng, 40),
        step="7.3 d",
        accuracy=f"{asked} uarcsec",
    )
    result = earthspin.run(scene)
    given: dict[str, Any] = {"ephemeris": PARTS["ephemeris"].run(scene, {})}
    given["pulls"] = PARTS["pulls"].run(scene, given)
    truth = true_axes(scene, 4 * DAY, 16)

    def off(found: np.ndarray) -> float:
        return float(np.linalg.norm(found - truth, axis=-1).max() / UAS)

    cost, cheapest = int(result.evaluations), int(result.evaluations)
    for choice in sorted(windows_on_offer(scene, given), key=lambda c: c.evaluations):
        if choice.evaluations >= cheapest or choice.error > HOPELESS * asked * UAS:
            continue
        try:
            if off(true_axes(scene, **choice.settings)) <= asked:
                cheapest = choice.evaluations
        except UndefinedError:
            continue
    found = np.stack([result[c].transpose("time", "axis").values for c in "XYZ"], axis=-1)
    claimed = float(result.error_estimated)
    return Outcome(str(result.method_chosen.values), asked, claimed, off(found), cost, cheapest)


# --- the mean rate -------------------------------------------------------------------------------


def rate_outcome(rng: Generator) -> Outcome:
    """Ask for a rate of precession."""
    if rng.random() < 0.5:
        body, pulls = earthspin.EARTH, ["sun", "moon"]
    elif rng.random() < 0.5:
        body, pulls = earthspin.EARTH, ["sun"]
    else:
        body, pulls = earthspin.MARS, ["sun"]
    h = 10 ** rng.uniform(-5, -2)
    changes: dict[str, Any] = {"j2": 0.35 * h, "dynamical_flattening": h}
    if body is earthspin.MARS:
        changes["pole"] = rng.uniform(0, 2 * np.pi), np.arcsin(rng.uniform(-1, 1))
    asked = 10 ** rng.uniform(-5.7, 0)
    scene = Scene(
        compute="precession", body=body.replace(**changes), perturbers=pulls, accuracy=asked
    )
    given: dict[str, Any] = {"ephemeris": PARTS["ephemeris"].run(scene, {})}
    samples = PARTS["torque-samples"].run(scene, given)  # daily, on the widest window
    push = samples.push.sum(axis=1) if len(pulls) == 1 else samples.push[:, :2].sum(axis=1)
    truth = samples.window.mean(samples.times, push)

    def off(cycles: float, step: float) -> float:
        window = Window(samples.window.centre, cycles, samples.window.cycle, "sin4")
        times = window.sample_times(step)
        picked = push[np.rint((times - samples.times[0]) / DAY).astype(int)]
        return float(abs(window.mean(times, picked) / truth - 1))

    given["chosen-average"] = PARTS["chosen-average"].run(scene, given)
    given["torque-samples"] = PARTS["torque-samples"].run(scene, given)
    given["mean-rates"] = PARTS["mean-rates"].run(scene, given)
    report = PARTS["rate-accuracy"].run(scene, given)
    cost = cheapest = int(report.evaluations)
    for choice in sorted(averages_on_offer(scene, given), key=lambda c: c.evaluations):
        if choice.evaluations < cheapest and off(**choice.settings) <= asked:
            cheapest = choice.evaluations
    rate = given["mean-rates"].precession_rate.values[-1]
    full = dict(given)
    del full["chosen-average"]
    full["torque-samples"] = samples
    best = PARTS["mean-rates"].run(scene.replace(accuracy=None), full).precession_rate.values[-1]
    return Outcome(
        str(report.method_chosen.values),
        asked,
        float(report.error_estimated),
        float(abs(rate / best - 1)),
        cost,
        cheapest,
    )


# --- directions at the true equator --------------------------------------------------------------


def series_outcome(rng: Generator) -> Outcome:
    """Ask for declinations at the true equator."""
    pulls = ["sun", "moon"] if rng.random() < 0.5 else ["sun"]
    asked = 10 ** rng.uniform(0.9, 5.5)  # mas
    span = random_span(rng, 20)
    step = float(10 ** rng.uniform(-0.5, 1.5))
    scene = Scene(
        compute="torque",
        perturbers=pulls,
        equator="true",
        span=span,
        step=f"{step} d",
        accuracy=f"{asked} mas",
    )
    result = earthspin.run(scene)
    sky = PARTS["ephemeris"].run(scene, {})
    days = PARTS["times"].run(scene, {})
    now = days.days(0, days.size)
    first, last = days.span()
    exact = Nutation(first, last, 0)
    place = sky.ephemeris.positions(sky.targets, sky.centre, now)
    directions = {n: p / np.linalg.norm(p, axis=1, keepdims=True) for n, p in place.items()}
    kernel = max(sky.ephemeris.error(code)[0] for code in sky.targets.values()) / ARCSEC * 1e3

    def off(equator: np.ndarray) -> float:
        best = exact.true_equator(now)
        turned = (rotate(equator, d) - rotate(best, d) for d in directions.values())
        return max(float(np.linalg.norm(t, axis=1).max()) for t in turned) / ARCSEC * 1e3

    from earthspin.sky import iau

    cost = cheapest = int(result.evaluations) - now.size * len(pulls)
    for choice in nutation_choices(first, last, now.size):
        if choice.evaluations < cheapest:
            equator = (
                Nutation(first, last, now.size, **choice.settings).true_equator(now)
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
        for i, name in enumerate(pulls)
    )
    return Outcome(
        str(result.method_chosen.values),
        asked,
        float(result.error_estimated),
        true / ARCSEC * 1e3 + kernel,
        cost + now.size * len(pulls),
        cheapest + now.size * len(pulls),
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

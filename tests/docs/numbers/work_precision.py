"""docs/work_precision.md: what the text says of the tables that it includes."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from functools import cache
from typing import NamedTuple

import mpmath as mp
import numpy as np
from scipy.special import ndtri

from earthspin.bodies import MOON
from earthspin.checks.ladders import (
    model_sky,
    of_ensemble,
    of_free_rotor,
    of_spheroid,
    of_top,
    of_torque,
)
from earthspin.checks.ladders.of_precession import TORUS
from earthspin.checks.work_precision import SHORTEST_SAMPLE
from earthspin.constants import JULIAN_YEAR, MAS
from earthspin.interior.modes import transfer
from earthspin.sky import iau
from tests.docs.numbers.nutation import retrograde_node, rungs
from tests.docs.numbers.sentence import ROOT, Column, Part, Sentence, Told
from tests.top.accuracy import ulp_effect_at
from tests.top.textbook import DIGITS, Textbook

PAGE = "docs/work_precision.md"
#: Multiples of D, l', l and F of the slow term.
SLOW = (3, 3, -1, -2)
#: Run times are measured again on other machines and days.
RUN_TIMES = 1.5
SECONDS = {"µs": 1e-6, "ms": 1e-3, "s": 1.0}


class Row(NamedTuple):
    """A setting of a measured table: error in its unit, and run time, s."""

    method: str
    setting: str
    error: float
    run_time: float


@cache
def rows(quantity: str) -> tuple[Row, ...]:
    """A table of docs/measured."""
    text = (ROOT / f"docs/measured/accuracy-{quantity}.inc").read_text(encoding="utf-8")
    found, method = [], ""
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip("| ").split("|")]
        if not re.match(r"\| .*\| [\d,]+ \|", line):
            continue
        method = cells[0] if not line.startswith("|  |") else method
        setting, error, time = cells[1:4] if not line.startswith("|  |") else cells[0:3]
        number, unit = time.split()
        found.append(Row(method, setting, float(error), float(number) * SECONDS[unit]))
    assert found, quantity
    return tuple(found)


def row(quantity: str, method: str, setting: str = "") -> Row:
    """One setting."""
    (found,) = (r for r in rows(quantity) if (r.method, r.setting) == (method, setting))
    return found


def by_skyfield() -> list[float]:
    """Errors of Skyfield as it comes, and as a source, uas, and the ratio of their run times."""
    alone = row("torque", "Skyfield, radec of date (other)")
    source = row("torque", 'source = "skyfield"')
    return [1e3 * alone.error, 1e3 * source.error, source.run_time / alone.run_time]


def faster_than_integrators() -> list[float]:
    """How many times faster the closed form of a free rotor is: at least, at most."""
    closed = row("free-rotor", "closed form").run_time
    others = [r.run_time for r in rows("free-rotor") if r.method != "closed form"]
    return [min(others) / closed, max(others) / closed]


def slower_than(quantity: str, ours: str, other: tuple[str, str], setting: str = "") -> float:
    """Run time of a setting of ours over that of another method."""
    return row(quantity, ours, setting).run_time / row(quantity, *other).run_time


def slower_than_collocation() -> list[float]:
    """How many times longer integrators need for the compliances, that come as near."""
    ours, *_ = (r for r in rows("compliances") if r.setting == "settled to 1e-13")
    others = [r for r in rows("compliances") if r.method != ours.method and r.error < 1e-11]
    # the cheapest of each
    best: dict[str, float] = {}
    for r in others:
        best[r.method] = min(r.run_time, best.get(r.method, math.inf))
    ratios = [time / ours.run_time for time in best.values()]
    return [min(ratios), max(ratios)]


def millionth_of_the_answers() -> float:
    """What a millionth of all answers moves of the largest term of nutation, uas."""
    sigma, e, rigid = retrograde_node()
    parts = rungs()["inner-core"].parts(sigma)
    more = replace(parts, answers=1.001 * parts.answers)
    change = (transfer(more, sigma, e) - transfer(parts, sigma, e)) * rigid
    return float(abs(change[0]))  # mas of a thousandth are uas of a millionth


def slow_term() -> float:
    """Amplitude of the model's slowest term over its mean."""
    turns = [2 * np.pi * np.arange(count) / count for count in TORUS]
    angles = np.stack(np.meshgrid(*turns, indexing="ij")).reshape(4, -1)
    found = np.concatenate(
        [model_sky.precessing(part) for part in np.array_split(angles, TORUS[0], axis=1)]
    )
    wave = np.exp(-1j * (np.array(SLOW) @ angles))
    return float(2 * abs(np.mean(found * wave)) / np.mean(found))


def period_of_the_slow_term() -> float:
    """Of 3 D + 3 l' - l - 2 F, Julian years."""
    rate = np.array([-1, 3, -2, 3, 0]) @ iau.delaunay_rates()
    return float(abs(2 * np.pi / rate) / JULIAN_YEAR)


def not_linear(uncertainty: float = of_ensemble.UNCERTAINTY) -> float:
    """What the linear half-width of 1/H lacks, relative."""
    return (float(ndtri(of_ensemble.ENDS[1])) * uncertainty) ** 2


def members_for(error: float) -> float:
    """How many drawn members have a half-width as good as that."""
    return (of_ensemble.expected_scatter(1) / error) ** 2


def last_place_of_the_top() -> float:
    """What a unit in the last place of each input does to the top's attitude, rad."""
    with mp.workdps(DIGITS):
        moment = 100 * float(Textbook(of_top.TOP).period)
        return float(ulp_effect_at(of_top.TOP, moment)[4:].max())


MEASURED = [
    Sentence(PAGE, "Calls that take less than {} ms are repeated", lambda: 1e3 * SHORTEST_SAMPLE),
    Sentence(
        PAGE,
        "the remaining ${}$ is a true variation",
        lambda: row("precession", "sin4", "8 turns, 1 d").error,
    ),
    Sentence(PAGE, "a term of\n${}$ in $3D", slow_term, slow=True),
    Sentence(PAGE, "Its period is {} years, longer than any window", period_of_the_slow_term),
    Sentence(PAGE, "its rate varies by\n${}$ (", lambda: MOON.slow_swing),
    Sentence(PAGE, "Skyfield differs by {} µas because", lambda: by_skyfield()[0]),
    Sentence(PAGE, "and differs by\n{} µas because of", lambda: by_skyfield()[1]),
    Sentence(
        PAGE,
        "milliarcsecond down to rounding, ${}$ µas",
        lambda: min(r.error for r in rows("pole")),
        factor=2.0,
    ),
    Sentence(
        PAGE,
        "are {} to {} times slower than\nwindows of {} d with {} nodes",
        lambda: [
            *(
                slower_than("pole", method, ("Picard, 8 d", "20 nodes"), "DOP853")
                for method in ("momentum and figure axis", "full attitude")
            ),
            8,
            20,
        ],
        factor=RUN_TIMES,
    ),
    Sentence(
        PAGE,
        "comes\nwithin ${}$ some {} times faster, but gives no error",
        lambda: [
            row("rotation", "solve_ivp LSODA (other)", "rtol 1e-13").error,
            slower_than(
                "rotation",
                "windows in two forms, with the error",
                ("solve_ivp LSODA (other)", "rtol 1e-13"),
                "tolerance 1e-8",
            ),
        ],
        factor=RUN_TIMES,
    ),
    Sentence(
        PAGE,
        "it is as accurate as\nearthspin here, and {} times faster",
        lambda: slower_than(
            "elements",
            "ellipses by their elements",
            ("Newton's method, Danby's start (other)", "6 steps"),
        ),
        factor=RUN_TIMES,
    ),
    Sentence(
        PAGE,
        "is within ${}$ after\nthree turns of the node at {} times the run time",
        lambda: [
            row("mean-orbit", "sin4 window", "3 turns, 4 d").error,
            slower_than("mean-orbit", "sin4 window", ("closed form", ""), "3 turns, 4 d"),
        ],
        factor=RUN_TIMES,
    ),
    Sentence(
        PAGE,
        "of a plain mean over five turns is ${}$.",
        lambda: row("mean-orbit", "plain mean over years (other)", "94.8 years, 1 d").error,
    ),
    Sentence(PAGE, "Moments 1 : {} : {}, a hundred periods", lambda: of_free_rotor.MOMENTS[1:]),
    Sentence(PAGE, "and from {} to {} times faster", faster_than_integrators, factor=RUN_TIMES),
    Sentence(
        PAGE, "value changes its attitude by ${}$", last_place_of_the_top, factor=1.5, slow=True
    ),
    Sentence(
        PAGE,
        "at distances from {} to {} equatorial radii, together",
        lambda: [of_spheroid.DISTANCES[0], of_spheroid.DISTANCES[-1]],
    ),
    Sentence(
        PAGE,
        "has ten correct digits at {} radii, four at\nthe Moon's",
        lambda: of_spheroid.DISTANCES[0],
    ),
    Sentence(PAGE, "none at ${}$ radii; long double", lambda: of_spheroid.DISTANCES[4]),
    Sentence(
        PAGE,
        "Its rounding error is ${}$ mas, a\nthousand times smaller than that of ERFA in double "
        "precision, so it checks the sum of ERFA (${}$ mas)",
        lambda: [
            of_torque.ladder(quick=True).reference_error / MAS,
            row("torque", "IAU 2000A at each epoch").error,
        ],
        slow=True,
    ),
    Sentence(
        PAGE,
        "for no method can it be smaller than\n$T\\sqrt{T/4\\pi QL}$, {} days for {} years",
        lambda: [433 * math.sqrt(433 / (4 * math.pi * 100 * 65 * 365.25)), 65],
    ),
    Sentence(PAGE, "neglects the nonlinear part, {} % here", lambda: 100 * not_linear()),
    Sentence(PAGE, "known to a thousandth it is ${}$", lambda: not_linear(1e-3)),
    Sentence(
        PAGE,
        "{} members have an error of {} %, and {} are as accurate as the linear error",
        lambda: [1000, 100 * of_ensemble.expected_scatter(1000), members_for(not_linear())],
    ),
    Sentence(
        PAGE,
        "have an error of ${}/n$ instead",
        lambda: 1000 * row("ensemble", "evenly spaced members", "1,000 members").error,
    ),
    Sentence(
        PAGE,
        "at Gauss's nodes has an error of ${}$.",
        lambda: row("compliances", "collocation at Gauss's nodes", "settled to 1e-13").error,
    ),
    Sentence(
        PAGE, "same error need {} to {} times as long", slower_than_collocation, factor=RUN_TIMES
    ),
    Sentence(
        PAGE,
        "compliances moves the term of\nthe Moon's node by {} µas",
        millionth_of_the_answers,
        slow=True,
    ),
    Sentence(
        PAGE,
        "is {}″ at a relative tolerance of $10^{-9}$ and {}″ at $10^{-10}$",
        lambda: [
            row("long-term", "DOP853, fitted equation (other)", f"rtol 1e-{k}").error
            for k in (9, 10)
        ],
    ),
]
#: Measured once, where the ladder was made.
IN_LADDERS = "earthspin/checks/ladders: what steps or points in between change"
TOLD: list[Told | Column | Part] = [
    Told(PAGE, "so the limits of its central {} %\nfollow", "given: what is meant"),
    Told(PAGE, "points computes it to\n${}$ without a window", IN_LADDERS),
    Told(PAGE, "Steps of six hours change it by ${}$ rad", IN_LADDERS),
    Told(PAGE, "halving those changes it by ${}$ rad", IN_LADDERS),
    Told(
        PAGE, "halving its steps changes it by\n${}$.", "printed by python -m data_tools references"
    ),
    Told(PAGE, "relative tolerance of ${}$ and", "given: a tolerance"),
    Told(PAGE, "″ at ${}$. Restarted", "given: a tolerance"),
    Told(
        PAGE,
        "it reaches {}″ in {} ms, {} times as long as twelve nodes",
        "run times: python tests/benchmarks/long_term.py",
    ),
]

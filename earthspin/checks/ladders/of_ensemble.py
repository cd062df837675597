"""Compare error and run time of methods for the precession period's uncertainty due to H.

Methods: ensembles and linear errors.

The period is proportional to 1/H, so the ends of its central 95 % interval are the reciprocals of
those of H.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import cache, partial
from typing import Any

import numpy as np
from scipy.special import ndtri

from tests.reference.sky import BODY, H
from earthspin.checks.work_precision import FloatArray, Ladder, Method, Result, Setting, method
from earthspin.engine.spread import quantiles
from earthspin.many import ensemble
from earthspin.scenes import QUESTIONS, run

#: Relative standard uncertainty of H, large enough that the period is not linear in H.
UNCERTAINTY = 0.1
NAME, TOTAL = "body.dynamical_flattening", {"perturber": "total"}
#: Quantiles at the ends of the central 95 % interval.
ENDS = (0.025, 0.975)
#: Relative half-widths of the central 95 % intervals of H and of the period.
H_OFFSET = float(ndtri(ENDS[1])) * UNCERTAINTY
HALF_WIDTH = H_OFFSET / (1 - H_OFFSET * H_OFFSET)
MEMBERS, QUICK_MEMBERS = (100, 1000, 10_000), (100, 1000)
#: Number of seeds over which the rms error of drawn members is taken.
SEEDS, FEW_SEEDS = 32, 4
#: Allowed rms error over all seeds and over a few seeds, relative to the expected scatter.
EXCESS, QUICK_EXCESS = 1.5, 2.0


def ladder(quick: bool) -> Ladder:
    """Return the comparison (`Ladder`) of methods for the precession period's uncertainty."""
    seeds = FEW_SEEDS if quick else SEEDS
    members = QUICK_MEMBERS if quick else MEMBERS
    scatter = (QUICK_EXCESS if quick else EXCESS) * expected_scatter(members[-1])
    drawn, by_numpy = (
        [_over_seeds(n, run, seeds) for n in members] for run in (_from_draws, _by_numpy)
    )
    spread = [Setting(f"{n:,} members", partial(_from_even_members, n)) for n in members]
    return Ladder(
        quantity="ensemble",
        unit="1",
        problem="half-width of the central 95 % of the precession period, if H has a relative "
        f"standard uncertainty of {100 * UNCERTAINTY:g} %; the error is relative, with drawn "
        f"members the rms over {seeds} seeds, known to {100 / math.sqrt(2 * seeds):.0f} per cent",
        subject="the half-width of a number from an uncertain H",
        reference="the closed form: the period is proportional to 1/H, so its quantiles follow "
        "from those of the normal distribution",
        reference_error=1e-15,
        methods=[
            Method("members drawn", drawn, scatter),
            Method("evenly spaced members", spread, 5 / members[-1]),
            method("linear errors", "", _linear, bound=1.1 * H_OFFSET * H_OFFSET),
            Method("numpy, period as 1/H", by_numpy),
        ],
        error=lambda widths: float(np.sqrt(np.mean((widths / HALF_WIDTH - 1) ** 2))),
        useful=0.3,
    )


def expected_scatter(members: int) -> float:
    """Expected relative standard deviation of a half-width estimated from random members.

    A quantile of n draws has the standard deviation sqrt(p (1 - p)/n) divided by the density, and
    the two ends have the correlation p/(1 - p).
    """
    p, at = ENDS[0], H_OFFSET / UNCERTAINTY
    density = math.exp(-at * at / 2) / math.sqrt(2 * math.pi)
    scatter = math.sqrt(p * (1 - p) / members) * UNCERTAINTY / density
    low, high = scatter / (1 + H_OFFSET) ** 2, scatter / (1 - H_OFFSET) ** 2
    both = math.sqrt(low * low + high * high - 2 * low * high * p / (1 - p)) / 2
    return both / HALF_WIDTH


def _over_seeds(members: int, run: Callable[[int, int], Result], seeds: int) -> Setting:
    return Setting(
        f"{members:,} members",
        lambda: run(members, 0),
        error_values=lambda: np.concatenate([run(members, seed)[0] for seed in range(seeds)]),
    )


def _from_draws(members: int, seed: int) -> Result:
    normal = {"normal": [H, UNCERTAINTY * H]}
    return _half_width({"n": members, NAME: normal}, seed), members


def _from_even_members(members: int) -> Result:
    """Half-width of the precession period from quantiles of H at even probabilities.

    The number of members is returned with it.
    """
    grid = H * (1 + UNCERTAINTY * ndtri((np.arange(members) + 0.5) / members))
    return _half_width({NAME: {"grid": grid.tolist()}}), members


def _half_width(members: Mapping[str, Any], seed: int = 0) -> FloatArray:
    """Half-width of the precession period in an ensemble, divided by the nominal period."""
    answer = ensemble("precession", members, seed=seed)
    low, high = quantiles(answer, ENDS).precession_period.sel(TOTAL).values
    return np.atleast_1d((high - low) / 2 / _period())


def _linear() -> Result:
    uncertain = BODY.replace(relative_uncertainty={NAME.split(".")[1]: UNCERTAINTY})
    answer = run(QUESTIONS["precession"](body=uncertain)).sel(TOTAL)
    width = answer.precession_period_error / answer.precession_period
    return np.atleast_1d(width.values), 1


def _by_numpy(members: int, seed: int) -> Result:
    """Relative half-width of the precession period from random draws of H by NumPy.

    The period is computed once and divided by each draw.
    """
    period = run(QUESTIONS["precession"]()).precession_period.sel(TOTAL).values
    drawn = np.random.default_rng(seed).normal(1.0, UNCERTAINTY, members)
    low, high = np.quantile(period / drawn, ENDS)
    return np.atleast_1d((high - low) / 2 / period), members


@cache
def _period() -> float:
    return float(run(QUESTIONS["precession"]()).precession_period.sel(TOTAL))

"""Uncertainty of the precession period due to H: ensembles and linear errors.

The period is proportional to 1/H, so the ends of its central 95 % interval are the reciprocals of
those of H.
"""

import math
from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np
from scipy.special import ndtri

from earthspin.scenes import QUESTIONS, ensemble, run
from tests.benchmarks.accuracy.ladder import Ladder, settings
from tests.reference.sky import BODY, H

#: Relative standard uncertainty of H, large enough that the period is not linear in H.
UNCERTAINTY = 0.1
NAME, TOTAL = "body.dynamical_flattening", {"perturber": "total"}
#: Quantiles at the ends of the central 95 % interval.
ENDS = (0.025, 0.975)
#: Relative half-widths of the central 95 % intervals of H and of the period.
H_OFFSET = float(ndtri(ENDS[1])) * UNCERTAINTY
HALF_WIDTH = H_OFFSET / (1 - H_OFFSET * H_OFFSET)
MEMBERS, SEEDS = (100, 1000, 10_000), 32


def ladder() -> Ladder:
    """Methods for the half-width of the precession period."""
    return Ladder(
        title="Half-width of a period from an uncertain H",
        problem="half-width of the central 95 % of the precession period, if H has a relative "
        f"standard uncertainty of {100 * UNCERTAINTY:g} %; the error is relative, the rms over "
        f"{SEEDS} seeds, known to {100 / math.sqrt(2 * SEEDS):.0f} per cent",
        reference="the closed form: the period is proportional to 1/H, so its quantiles follow "
        "from those of the normal distribution",
        unit="1",
        floor=1e-15,
        error=lambda widths: np.sqrt(np.mean((np.array(widths) / HALF_WIDTH - 1) ** 2)),
        runs={
            "members drawn": settings("{} members", _from_draws, MEMBERS),
            "evenly spaced members": settings("{} members", _from_even_members, MEMBERS),
            "linear errors": {"": _linear},
            "numpy, period as 1/H": settings("{} members", _by_numpy, MEMBERS),
        },
        bounds={
            "members drawn": 1.5 * expected_scatter(MEMBERS[-1]),
            "evenly spaced members": 5 / MEMBERS[-1],
            "linear errors": 1.1 * H_OFFSET * H_OFFSET,
        },
        cases=SEEDS,
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


def _from_draws(members: int, case: int = 0) -> tuple[float, int]:
    normal = {"normal": [H, UNCERTAINTY * H]}
    return _half_width({"n": members, NAME: normal}, case), members


def _from_even_members(members: int, case: int = 0) -> tuple[float, int]:
    """Half-width from quantiles of H at even probabilities, the same for every seed."""
    grid = H * (1 + UNCERTAINTY * ndtri((np.arange(members) + 0.5) / members))
    return _half_width({NAME: {"grid": grid.tolist()}}), members


def _half_width(members: Mapping[str, Any], seed: int = 0) -> float:
    """Half-width of the precession period in an ensemble, divided by the nominal period."""
    answer = ensemble("precession", members, seed=seed)
    low, high = answer.earthspin.quantiles(ENDS).precession_period.sel(TOTAL).values
    return float((high - low) / 2 / _period())


def _linear(case: int = 0) -> tuple[float, int]:
    uncertain = BODY.replace(relative_uncertainty={NAME.split(".")[1]: UNCERTAINTY})
    answer = run(QUESTIONS["precession"](body=uncertain)).sel(TOTAL)
    return float(answer.precession_period_error / answer.precession_period), 1


def _by_numpy(members: int, case: int = 0) -> tuple[float, int]:
    """Half-width from random draws of H by NumPy; the period is computed once."""
    period = float(run(QUESTIONS["precession"]()).precession_period.sel(TOTAL))
    drawn = np.random.default_rng(case).normal(1.0, UNCERTAINTY, members)
    low, high = np.quantile(period / drawn, ENDS)
    return float((high - low) / 2 / period), members


@cache
def _period() -> float:
    return float(run(QUESTIONS["precession"]()).precession_period.sel(TOTAL))

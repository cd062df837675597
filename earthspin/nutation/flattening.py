"""What the IAU's rate of precession says about H and C, and what the Earth's inside says.

H is itself inferred from observed precession, so that our rate with that H must come out
right: closure tests consistency. Only a model of the inside gives C on its own.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from earthspin.constants import PREM_MEAN_MOMENT, PREM_RADIUS
from earthspin.mass.inertia import polar_moment_factor
from earthspin.nutation.budget import Budget

#: Effects whose published sizes tell how sure our own are.
COMPARED = ("planets", "j4", "geodesic", "second-order")


def inferred_h(h: float, torque_rate: float, excess: float) -> float:
    """H that would bring our rate to the IAU's.

    Parameters
    ----------
    h : float
        H that was used.
    torque_rate : float
        The part of our rate that grows with H.
    excess : float
        Our rate less the IAU's, all effects counted, in the same unit.
    """
    return h * (1 - excess / torque_rate)


def inferred_h_uncertainty(h: float, torque_rate: float, effects: float, method: float) -> float:
    """One standard deviation of the inferred H.

    Parameters
    ----------
    h, torque_rate : float
    effects : float
        Root sum square of what our effects differ by from the published ones.
    method : float
        By what the same analysis misses the rate of a pole whose rate is known.
    """
    return abs(h / torque_rate) * math.hypot(effects, method)


def polar_moment_from_mean(
    mean_moment: float, mean_radius: float, equatorial_radius: float, j2: float
) -> float:
    """C/(M a2) of a body whose mean moment of inertia a spherical model gives.

    I = (A + B + C)/3 and C - (A + B)/2 = J2 M a2 give C = I + (2/3) J2 M a2.

    Parameters
    ----------
    mean_moment : float
        I/(M R2).
    mean_radius, equatorial_radius : float
        R and a, m.
    j2 : float
    """
    return mean_moment * (mean_radius / equatorial_radius) ** 2 + 2 / 3 * j2


def polar_moment_from_h(j2: float, h: float) -> float:
    """C/(M a2) from the bulge and the dynamical flattening."""
    return float(polar_moment_factor(j2, h))


class Flattening(NamedTuple):
    """H and C/(M a2) from one origin, with their standard uncertainties.

    Attributes
    ----------
    h, h_uncertainty : float
    moment, moment_uncertainty : float
    """

    h: float
    h_uncertainty: float
    moment: float
    moment_uncertainty: float


def inferred_from(budget: Budget, h: float) -> tuple[float, float]:
    """H that would close a budget, and its standard uncertainty.

    Parameters
    ----------
    budget : Budget
    h : float
        H that it was made with.
    """
    compared = [effect for effect in budget.psi if effect in COMPARED]
    spread = math.sqrt(sum((budget.psi[e] - budget.psi_published[e]) ** 2 for e in compared))
    # Geodesic precession alone does not grow with H.
    grows = sum(rate for effect, rate in budget.psi.items() if effect != "geodesic")
    return (
        inferred_h(h, grows, budget.closure),
        inferred_h_uncertainty(h, grows, spread, budget.psi_analysis_error),
    )


def compared_flattenings(
    budget: Budget, h: float, j2: float, radius: float, *, u_h: float, u_j2: float
) -> dict[str, Flattening]:
    """H and C/(M a2) as published, as the IAU's rate implies them, and of PREM.

    Parameters
    ----------
    budget : Budget
    h, j2 : float
        That it was made with.
    radius : float
        That `j2` refers to, m.
    u_h, u_j2 : float
        Their relative standard uncertainties.
    """

    def from_h(value: float, uncertainty: float) -> Flattening:
        moment = polar_moment_from_h(j2, value)
        return Flattening(
            value, uncertainty, moment, moment * math.hypot(uncertainty / value, u_j2)
        )

    prem = polar_moment_from_mean(PREM_MEAN_MOMENT.value, PREM_RADIUS.value, radius, j2)
    # PREM is a model: half of its last printed digit is all that is known of its error
    u_prem = PREM_MEAN_MOMENT.relative_uncertainty
    return {
        "published": from_h(h, u_h * h),
        "from the IAU's rate": from_h(*inferred_from(budget, h)),
        "PREM": Flattening(j2 / prem, j2 / prem * u_prem, prem, prem * u_prem),
    }

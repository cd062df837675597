"""Values of H and C that the IAU precession rate and an Earth model imply.

The published H is inferred from the observed precession, so closure of the rate only tests
consistency. Only an interior model gives an independent C.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from earthspin.constants import PREM_MEAN_MOMENT, PREM_RADIUS
from earthspin.mass.figure import polar_moment_factor
from earthspin.numerics.arrays import Numeric
from earthspin.nutation.budget import Budget

#: Effects whose published sizes measure the error of the computed ones.
COMPARED = ("planets", "j4", "geodesic", "second-order")


def inferred_h(h: float, torque_rate: float, excess: float) -> float:
    """Dynamical flattening H for which the computed precession rate equals that of the IAU.

    Parameters
    ----------
    h : float
        H used in the computation.
    torque_rate : float
        Part of the computed rate that is proportional to H.
    excess : float
        Computed rate with all effects minus the IAU rate, in the same unit.
    """
    return h * (1 - excess / torque_rate)


def inferred_h_uncertainty(h: float, torque_rate: float, effects: float, method: float) -> float:
    """Standard deviation of the H that is inferred from the IAU precession rate.

    Parameters
    ----------
    h, torque_rate : float
    effects : float
        Root sum square of the differences between the computed and the published effects.
    method : float
        Error of the same analysis for a pole whose rate is known.
    """
    return abs(h / torque_rate) * math.hypot(effects, method)


def polar_moment_from_mean(
    mean_moment: float, mean_radius: float, equatorial_radius: Numeric, j2: Numeric
) -> Numeric:
    """Polar moment factor C/(M a2) from the mean moment of a spherical model.

    I = (A + B + C)/3 and C - (A + B)/2 = J2 M a2 give C = I + (2/3) J2 M a2.

    Parameters
    ----------
    mean_moment : float
        I/(M R2).
    mean_radius, equatorial_radius : float
        R and a, m.
    j2 : float
        Like the radius, a float or a labelled array.
    """
    return mean_moment * (mean_radius / equatorial_radius) ** 2 + 2 / 3 * j2


def prem_polar_moment(radius: Numeric, j2: Numeric) -> Numeric:
    """Polar moment factor C/(M a2) of the Earth model PREM, for a reference radius a, m, and J2."""
    return polar_moment_from_mean(PREM_MEAN_MOMENT.value, PREM_RADIUS.value, radius, j2)


def polar_moment_from_h(j2: float, h: float) -> float:
    """Polar moment factor C/(M a2) = J2/H, from J2 and the dynamical flattening H."""
    return float(polar_moment_factor(j2, h))


class Flattening(NamedTuple):
    """Values of H and C/(M a2) from one source, with their standard uncertainties.

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
    """Value of H that makes the computed precession rate equal to the IAU's, and its uncertainty.

    Parameters
    ----------
    budget : Budget
    h : float
        H used in the budget.
    """
    compared = [effect for effect in budget.psi if effect in COMPARED]
    spread = math.sqrt(sum((budget.psi[e] - budget.psi_published[e]) ** 2 for e in compared))
    # all effects except geodesic precession are proportional to H
    grows = sum(rate for effect, rate in budget.psi.items() if effect != "geodesic")
    return (
        inferred_h(h, grows, budget.closure),
        inferred_h_uncertainty(h, grows, spread, budget.psi_analysis_error),
    )


def compared_flattenings(
    budget: Budget, h: float, j2: float, radius: float, *, u_h: float, u_j2: float
) -> dict[str, Flattening]:
    """Values of H and C/(M a2) by source: published, from the IAU precession rate, and from PREM.

    Parameters
    ----------
    budget : Budget
    h, j2 : float
        Values used in the budget.
    radius : float
        Reference radius of `j2`, m.
    u_h, u_j2 : float
        Relative standard uncertainties of `h` and `j2`.
    """

    def from_h(value: float, uncertainty: float) -> Flattening:
        moment = polar_moment_from_h(j2, value)
        return Flattening(
            value, uncertainty, moment, moment * math.hypot(uncertainty / value, u_j2)
        )

    prem = prem_polar_moment(radius, j2)
    # PREM states no errors: half a unit of its last printed digit is used
    u_prem = PREM_MEAN_MOMENT.relative_uncertainty
    return {
        "published": from_h(h, u_h * h),
        "from the IAU's rate": from_h(*inferred_from(budget, h)),
        "PREM": Flattening(j2 / prem, j2 / prem * u_prem, prem, prem * u_prem),
    }

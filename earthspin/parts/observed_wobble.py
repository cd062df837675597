"""Published observed period of the free wobble."""

from __future__ import annotations

from earthspin.bodies import Body, proper
from earthspin.constants import DAY, NORMAL_95
from earthspin.engine.part import part
from earthspin.engine.variables import Pair, Variables, measured


class ObservedWobble(Variables):
    """Observed period of the free wobble, as a variable of a result (Dataset)."""

    observed_period: Pair = measured("d", "observed period of the free wobble")


def not_observed(body: Body) -> str | None:
    """Return the reason (text) to omit the observed period if no wobble was observed, else None."""
    if body.observed_wobble:
        return None
    return f"no observed wobble of this {proper(body.name)} is known"


@part(unless=not_observed)
def observed_wobble(body: Body) -> ObservedWobble:
    """Observed period of the free wobble from the literature."""
    observed = body.observed_wobble
    assert observed is not None
    period = observed.value * DAY
    half_width = NORMAL_95 * period * observed.relative_uncertainty
    return ObservedWobble(observed_period=(period, half_width)).with_attributes(
        observed_period={"references": observed.source}
    )

"""The observed period of the free wobble, a cited figure."""

from __future__ import annotations

from earthspin.bodies import Body, proper
from earthspin.constants import DAY, NORMAL_95
from earthspin.engine.part import part
from earthspin.engine.variables import Pair, Variables, measured


class ObservedWobble(Variables):
    """The observed period of the free wobble."""

    observed_period: Pair = measured("d", "observed period of the free wobble")


def not_kept(body: Body) -> str | None:
    """Leave it out for a body that nobody has observed."""
    if body.observed_wobble:
        return None
    return f"no observed wobble of this {proper(body.name)} is kept"


@part(unless=not_kept)
def observed_wobble(body: Body) -> ObservedWobble:
    """The observed period of the free wobble, a cited figure."""
    observed = body.observed_wobble
    assert observed is not None
    period = observed.value * DAY
    half_width = NORMAL_95 * period * observed.relative_uncertainty
    return ObservedWobble(observed_period=(period, half_width)).with_attributes(
        observed_period={"references": observed.source}
    )

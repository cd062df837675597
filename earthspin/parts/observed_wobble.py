"""The observed period of the free wobble, a cited figure."""

from __future__ import annotations

from typing import TYPE_CHECKING

from earthspin.bodies import Body, proper
from earthspin.constants import DAY, NORMAL_95
from earthspin.engine.labels import Variable, build, with_error
from earthspin.engine.part import part

if TYPE_CHECKING:
    import xarray as xr

OBSERVED = with_error("observed_period", Variable((), "d", "observed period of the free wobble"))


def not_kept(body: Body) -> str | None:
    """Leave it out for a body that nobody has observed."""
    if body.observed_wobble:
        return None
    return f"no observed wobble of this {proper(body.name)} is kept"


@part(gives=OBSERVED, unless=not_kept)
def observed_wobble(body: Body) -> xr.Dataset:
    """The observed period of the free wobble, a cited figure."""
    observed = body.observed_wobble
    assert observed is not None
    period = observed.value * DAY
    values = {
        "observed_period": period,
        "observed_period_error": NORMAL_95 * period * observed.relative_uncertainty,
    }
    result = build(OBSERVED, values)
    result.observed_period.attrs["references"] = observed.source
    return result

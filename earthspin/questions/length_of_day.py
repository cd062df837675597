"""Length of day and UT1 that follow from the zonal tides of Sun and Moon."""

from __future__ import annotations

import numpy as np

from earthspin.bodies import Body
from earthspin.constants import NORMAL_95
from earthspin.dates import Epochs, Span, Step, datetime64
from earthspin.engine import Neglected, key, part, public_call
from earthspin.engine.variables import Variables, labels, measured
from earthspin.errors import ApartError
from earthspin.interior.layers import PREM
from earthspin.questions import reasons
from earthspin.questions.sky import Sky, places, sky
from earthspin.questions.time_axes import SPAN_DOC, Dated, DateSeries, days_of, epochs
from earthspin.questions.zonal_tides import change_by, nodes
from earthspin.torque import zonal_tides as theory
from earthspin.torque.zonal_tides import KAPPA, ZonalTides


class LengthOfDay(
    DateSeries,
    word="length-of-day",
    call="length_of_day",
    positional=("start", "stop", "step"),
):
    """Changes of the length of day and of UT1 by the zonal tides of Sun and Moon.

    The mean of the tides is left out; UT1 is counted from the first date. The label `total` is the
    sum. The section `response` has the Earth's response as computed from its layers.

    Examples
    --------
    >>> import earthspin
    >>> year = earthspin.length_of_day("2025-01-01", "2026-01-01", "1 d")
    >>> print(year.length_of_day.sel(perturber="total").max().round(2).values)
    0.86
    """

    page, headline = "length_of_day", "length_of_day"

    span: Span = key(("2000-01-01T12:00:00", "2001-01-01T12:00:00"), doc=SPAN_DOC)
    step: Step = key("1 d", doc="interval between dates")

    needs = ("radius", "pole")

    def check(self) -> None:
        """Refuse bodies but the Earth, and perturbers whose mean tide is not known."""
        super().check()
        if reasons.no_iau_model(self.body):
            problem = "the response to zonal tides is known for the Earth alone"
            raise self.error("body", self.body.name, problem)
        if self.body.labelled:
            raise ApartError("the length of day is computed for one body at a time")
        for perturber in self.perturbers:
            if perturber.known_as not in theory.MEAN_FACTORS:
                problem = "the mean tide is known of sun and moon; leave it out"
                raise self.error("perturbers", perturber.name, problem)


class TidalDay(Dated, along=("time", "perturber")):
    """Length of day and UT1 in time, by perturber."""

    length_of_day = measured("ms", "change of the length of day by zonal tides")
    ut1_tides = measured("ms", "change of UT1 by zonal tides since the first date")
    perturber = labels()


@part(loads=("scipy.interpolate",))
def tides(epochs: Epochs, sky: Sky, body: Body, perturbers: tuple[Body, ...]) -> ZonalTides:
    """Compute the tide of each perturber, and their sum, at nodes a day apart."""
    days = nodes(*epochs.span())
    places = sky.radec(body, days)
    changes = np.array([change_by(p, body, *places[p.name][1:]) for p in perturbers])
    names = [*(p.known_as for p in perturbers), "total"]
    return ZonalTides.through(names, days, np.vstack([changes, changes.sum(axis=0)]))


@part
def tidal_day(epochs: Epochs, tides: ZonalTides, perturbers: tuple[Body, ...]) -> TidalDay:
    """Compute length of day and UT1 by the zonal tides at every time."""
    days = days_of(epochs)
    source = {"references": KAPPA.source, "response": f"{KAPPA.value} = k M a2/C"}
    return TidalDay(
        time=datetime64(days),
        perturber=[*(p.name for p in perturbers), "total"],
        length_of_day=tides.length_of_day(days),
        ut1_tides=tides.ut1(days),
    ).with_attributes(length_of_day=source, ut1_tides=source)


class TidalResponse(Variables, along=("rung",)):
    """Response of the Earth's rotation to zonal tides, by what takes part."""

    response = measured(
        "1",
        "relative change of the length of day over that of C/(M a2) for a Love number of 1",
        comment="of PREM to observed: with the core turning along, with a liquid core that does "
        "not, with an equilibrium ocean on 65 and 70 % of the globe; the adopted response",
    )
    rung = labels()


@part
def response() -> TidalResponse:
    """Compute the response of PREM, with and without core and ocean, beside the observed one."""
    computed = theory.computed_responses(PREM)
    published = {"observed_fortnight": theory.OBSERVED, "adopted": KAPPA}
    errors = [NORMAL_95 * (c.uncertainty or np.nan) for c in published.values()]
    values = [*computed.values(), *(c.value for c in published.values())]
    return TidalResponse(
        rung=[*computed, *published],
        response=(values, [*[np.nan] * len(computed), *errors]),
    ).with_attributes(
        no_error="NaN for rungs of PREM, whose layers have no errors",
        response={"references": f"{PREM.reference}; {theory.OBSERVED.source}; {KAPPA.source}"},
    )


@part
def neglected() -> Neglected:
    """Effects on the length of day that the tides leave out.

    These are what C04 holds beside the tides at most, the mean of the tides, and differences of the
    response from `KAPPA`: at half a year in table 8.1, over 18.6 years by the anelasticity of PREM.
    """
    sizes = {
        "winds, currents and the core": 4.4e-3,
        "mean of the tides": 1.68e-3,
        "ocean and anelasticity at half a year": 5.2e-6,
        "anelasticity over 18.6 years": 3.3e-6,
        "tide of Venus": 1.6e-10,
    }
    source = "IERS C04; IERS Conventions (2010), table 8.1; anelasticity of love_numbers"
    unknown = "tides of a day and of half a day, up to 0.09 ms in UT1"
    return Neglected(sizes, "ms", "largest change of the length of day", source, unknown)


length_of_day = public_call(
    LengthOfDay,
    answer=tidal_day,
    sections=(response, neglected),
    parts=(places, sky, epochs, tides),
)

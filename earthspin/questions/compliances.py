"""How the parts of a layered body answer to one another, and its figure of equilibrium."""

from __future__ import annotations

from typing import TYPE_CHECKING

from earthspin.bodies import EARTH, Body
from earthspin.bodies.limits import refuse_break_up
from earthspin.engine.asking import ask
from earthspin.engine.labels import Variable, build, without_error
from earthspin.engine.neglected import Neglected
from earthspin.engine.part import part
from earthspin.engine.question import Question, key, made_of
from earthspin.parts.layered import LayeredInterior, layers, not_prem, require_layers

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.interior.layers import LayeredBody


class Compliances(Question, word="compliances", call="compliances", positional=("interior",)):
    """Compliances, ellipticities and coupling numbers of a layered body, and its free modes.

    Returns
    -------
    Dataset
        Along `number`: `number_value`, in the notation of Mathews et al. (1991): kappa to nu, e,
        e_f and e_s of hydrostatic equilibrium, the coupling numbers a1 to a3, and A_f/A and A_s/A
        as `fluid` and `inner`. A number of a part that the body does not have is left out.
        `earthspin.run_tree` adds the published ones of PREM, and the periods of the free modes.

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line; among it a liquid surface.

    Examples
    --------
    >>> import earthspin
    >>> print(f"{earthspin.compliances('prem').number_value.sel(number='kappa'):.4e}")
    1.0369e-03
    >>> mars = earthspin.run_tree("compliances", "modes")
    >>> print(mars["modes"].compliance_mode_period.round(1).values)
    [ 393.6 -455.6  475.5 2411. ]
    """

    views, page = "compliances", "wobble"

    interior: LayeredInterior | None = key(None, doc="layers; without any, those of the body")
    body: Body = key(EARTH, doc="body whose spin and dynamical flattening they have")

    def check(self) -> None:
        """A body that spins, and layers that are known."""
        require_layers(self, self.interior, self.body)
        self.body.require(("spin_period", "dynamical_flattening"))
        if self.body.labelled:
            raise self.error("body", self.body.name, "give single numbers here, no labelled arrays")
        refuse_break_up(self.body)


NUMBERS = without_error(
    "they follow from the layers, whose own errors are not known",
    {"number_value": Variable(("number",), "1", "number of the body, in units of its moments")},
)


@part(gives=NUMBERS)
def numbers(layers: LayeredBody, body: Body) -> xr.Dataset:
    """Compliances of the elastic body, and its figure of hydrostatic equilibrium."""
    from earthspin.interior.rotation import numbers_of

    found = numbers_of(layers, abs(float(body.spin_rate)))
    result = build(NUMBERS, {"number_value": list(found.values())}, coords={"number": list(found)})
    result.number_value.attrs["references"] = layers.reference
    return result


PUBLISHED = {
    "published_value": Variable(
        ("published_number",), "1", "published number", no_error="the source gives none"
    ),
    "published_source": Variable(("published_number",), "", "where it is published"),
}


@part(gives=PUBLISHED, unless=not_prem)
def published() -> xr.Dataset:
    """The same numbers of PREM as published, each with its source."""
    from earthspin.interior.published import PREM_PUBLISHED

    return build(
        PUBLISHED,
        {
            "published_value": [of.value for of in PREM_PUBLISHED.values()],
            "published_source": [of.source for of in PREM_PUBLISHED.values()],
        },
        coords={"published_number": list(PREM_PUBLISHED)},
    )


MODES = without_error(
    "they follow from the layers, whose own errors are not known",
    {
        "compliance_mode_period": Variable(
            ("free_mode",),
            "d",
            "period of a free mode of the elastic body: of a nutation in space, negative if "
            "retrograde; else in the body",
        )
    },
)


@part(gives=MODES)
def modes(layers: LayeredBody, body: Body) -> xr.Dataset:
    """Free modes of the elastic body without an ocean, its H as observed; those that it has."""
    from earthspin.interior.love import elastic
    from earthspin.interior.rotation import free_modes, mode_period, parts_of
    from earthspin.mass.inertia import ellipticity_from_h

    e = float(ellipticity_from_h(body.number("dynamical_flattening")))
    spin_rate = abs(float(body.spin_rate))
    found = free_modes(parts_of(layers, spin_rate, elastic(layers).answers, e))
    periods = [mode_period(name, s, spin_rate) for name, s in found.items()]
    return build(MODES, {"compliance_mode_period": periods}, coords={"free_mode": list(found)})


@part
def neglected() -> Neglected:
    """What a sphere at rest leaves out."""
    return Neglected(what="rotation and ellipticity in the answers, about one per cent")


made_of(
    Compliances,
    answer=numbers,
    sections={"published": published, "modes": modes, "neglected": neglected},
    parts=(layers,),
)

compliances = ask(Compliances)

"""Compliances (deformation coefficients) of a layered body, and its hydrostatic figure."""

from __future__ import annotations

from earthspin.bodies import EARTH, Body
from earthspin.bodies.limits import refuse_break_up
from earthspin.engine.asking import public_call
from earthspin.engine.neglected import Neglected
from earthspin.engine.part import part
from earthspin.engine.question import Question, define_parts, key
from earthspin.engine.variables import Labels, Value, Variables, labels, number, words
from earthspin.interior.layers import LayeredBody
from earthspin.interior.love import elastic
from earthspin.interior.modes import free_modes, mode_period, numbers_of, parts_of
from earthspin.interior.published import PREM_PUBLISHED
from earthspin.mass.inertia import ellipticity_from_h
from earthspin.parts.layered import FROM_LAYERS, LayeredInterior, layers, not_prem, require_layers


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

    interior: LayeredInterior | None = key(None, doc="layers; those of the body if not given")
    body: Body = key(EARTH, doc="body with the spin and the dynamical flattening")

    def check(self) -> None:
        """Refuse a body without known layers, spin or H, or with arrays as properties."""
        require_layers(self, self.interior, self.body)
        self.body.require(("spin_period", "dynamical_flattening"))
        if self.body.labelled:
            raise self.error("body", self.body.name, "give single numbers here, no labelled arrays")
        refuse_break_up(self.body)


class Numbers(Variables, along=("number",), no_error=FROM_LAYERS):
    """Compliances, ellipticities and coupling numbers of a body, as values with names."""

    number_value: Value = number("1", "number of the body, in units of its moments", short="value")
    number: Labels = labels()


@part
def numbers(layers: LayeredBody, body: Body) -> Numbers:
    """Compute the compliances, ellipticities and coupling numbers of a layered body."""
    by_name = numbers_of(layers, abs(float(body.spin_rate)))
    return Numbers(number_value=list(by_name.values()), number=list(by_name)).with_attributes(
        number_value={"references": layers.reference}
    )


class Published(Variables, along=("published_number",), no_error="the source gives none"):
    """Published compliances and coupling numbers of PREM."""

    published_value: Value = number("1", "published number")
    published_source: Value = words("where it is published")
    published_number: Labels = labels()


@part(unless=not_prem)
def published() -> Published:
    """Published compliances and coupling numbers of PREM, each with its source."""
    return Published(
        published_value=[constant.value for constant in PREM_PUBLISHED.values()],
        published_source=[constant.source for constant in PREM_PUBLISHED.values()],
        published_number=list(PREM_PUBLISHED),
    )


class Modes(Variables, along=("free_mode",), no_error=FROM_LAYERS):
    """Periods of the free modes (wobbles and nutations) of a layered elastic body."""

    compliance_mode_period: Value = number(
        "d",
        "period of a free mode of the elastic body: of a nutation in space, negative if "
        "retrograde; else in the body",
        short="period",
    )
    free_mode: Labels = labels()


@part
def modes(layers: LayeredBody, body: Body) -> Modes:
    """Compute the periods of the free modes (wobbles and nutations) of the body without ocean.

    The dynamical flattening H is the observed one.
    """
    e = float(ellipticity_from_h(body.number("dynamical_flattening")))
    spin_rate = abs(float(body.spin_rate))
    frequencies = free_modes(parts_of(layers, spin_rate, elastic(layers).answers, e))
    return Modes(
        compliance_mode_period=[mode_period(n, s, spin_rate) for n, s in frequencies.items()],
        free_mode=list(frequencies),
    )


@part
def neglected() -> Neglected:
    """Effects that the computed compliances neglect because the model is a non-rotating sphere."""
    return Neglected(what="rotation and ellipticity in the answers, about one per cent")


define_parts(
    Compliances,
    answer=numbers,
    sections={"published": published, "modes": modes, "neglected": neglected},
    parts=(layers,),
)

compliances = public_call(Compliances)

"""Love numbers, compliances and free modes of any layered body."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from earthspin.bodies import EARTH, Body, checks, in_a_sentence
from earthspin.constants import DAY, JULIAN_YEAR
from earthspin.engine import Neglected, Question, Variables, key, labels, number, part, public_call
from earthspin.interior.layers import LayeredBody
from earthspin.interior.love import DegreeTwoLoveNumbers, elastic, solve_love_numbers
from earthspin.interior.modes import free_modes, mode_period, numbers_of, parts_of
from earthspin.interior.named import ANELASTIC_EXPONENT
from earthspin.interior.ocean_and_anelasticity import shear_modulus_change
from earthspin.mass.figure import ellipticity_from_h
from earthspin.numerics.arrays import ComplexArray
from earthspin.questions.interior_response import (
    FROM_LAYERS,
    LayeredInterior,
    layers,
    require_layers,
)
from earthspin.units import Number


class LoveNumbers(
    Question, word="love-numbers", call="love_numbers", positional=("interior", "period")
):
    """Love numbers and load Love numbers of degree two of a layered body.

    The label `love` is k2, h2, l2 of a tide, or k2_load, h2_load, l2_load. The section
    `compliances` is in the notation of Mathews et al. (1991): kappa to nu, e, e_f and e_s of
    hydrostatic equilibrium, the coupling numbers a1 to a3, and A_f/A and A_s/A as `fluid` and
    `inner`, without those of regions that the body does not have.

    Raises
    ------
    SceneError
        If the layers of the body are not known, or its surface is liquid.

    Examples
    --------
    >>> import earthspin
    >>> print(earthspin.love_numbers("prem").love_number.round(4).values)
    [ 0.2983  0.6038  0.084  -0.3055 -0.9922  0.0236]
    >>> month = earthspin.love_numbers("mars-layers", period="5.55 h", anelastic_exponent=0.15)
    >>> print(month.love_number.sel(love="k2").round(3).values)
    0.181
    >>> tree = earthspin.run_tree("love-numbers", ["compliances", "modes"])
    >>> print(f"{tree['compliances'].number_value.sel(number='kappa'):.4e}")
    1.0369e-03
    >>> print(tree["modes"].compliance_mode_period.round(1).values)
    [ 393.6 -455.6  475.5 2411. ]
    """

    page, headline = "wobble", "love_number"

    interior: LayeredInterior | None = key(None, doc="layers; those of the body if not given")
    body: Body = key(EARTH, doc="body with the layers, the spin and the dynamical flattening")
    period: Annotated[float, Number("s", "1 d", low=200.0, high=1e12)] | None = key(
        None, doc="period of the deformation; elastic at the seismic period of 1 s if not given"
    )
    anelastic_exponent: Annotated[float, Number("", "0.09", low=0.0, high=0.5)] = key(
        ANELASTIC_EXPONENT.value, doc="exponent of frequency in the quality factor"
    )

    def check(self) -> None:
        """Require a layered interior."""
        require_layers(self, self.interior, self.body)


#: Field of `DegreeTwoLoveNumbers` that holds each number.
_FIELDS = {f"{name}2{load}": f"{name}{load}" for load in ("", "_load") for name in "khl"}


def _numbers(response: DegreeTwoLoveNumbers) -> ComplexArray:
    """Array of the complex Love numbers of a body: its response to a tide and to a surface load."""
    return np.array([getattr(response, field) for field in _FIELDS.values()], dtype=complex)


class Love(Variables, along=("love",), no_error=FROM_LAYERS):
    """Love numbers at one period of the tide."""

    love_number = number("1", "Love number of degree two", short="real part")
    love_number_imaginary = number(
        "1",
        "imaginary part of the Love number, negative if the deformation lags",
        short="imaginary part",
    )
    love = labels(default=list(_FIELDS))


@part
def love(layers: LayeredBody, period: float | None, anelastic_exponent: float) -> Love:
    """Compute the Love numbers of tide and load, by integration from the centre to the surface."""
    mu_change = 0.0 if period is None else complex(shear_modulus_change(period, anelastic_exponent))
    values = _numbers(solve_love_numbers(layers, mu_change))
    sources = [layers.reference]
    if period is not None and anelastic_exponent == ANELASTIC_EXPONENT.value:
        sources.append(ANELASTIC_EXPONENT.source)
    return Love(love_number=values.real, love_number_imaginary=values.imag).with_attributes(
        love_number={"references": "; ".join(sources)}
    )


#: Periods from which the loss grows to thirty years, s.
PERIODS = np.geomspace(200.0, 30 * JULIAN_YEAR, 25)


class ByPeriod(Variables, along=("love", "love_period"), no_error=FROM_LAYERS):
    """Complex Love numbers for several tidal periods, and Love numbers of the elastic body."""

    elastic_love_number = number("1", "Love number of the elastic body", along=("love",))
    love_number_by_period = number("1", "Love number")
    love_number_by_period_imaginary = number("1", "imaginary part, negative for a lag")
    love = labels(default=list(_FIELDS))
    love_period = labels("period of the deformation", "d", default=PERIODS / DAY)


@part
def by_period(layers: LayeredBody, anelastic_exponent: float) -> ByPeriod:
    """Compute the complex Love numbers for periods from minutes to decades."""
    values = _numbers(solve_love_numbers(layers, shear_modulus_change(PERIODS, anelastic_exponent)))
    return ByPeriod(
        elastic_love_number=_numbers(elastic(layers)).real,
        love_number_by_period=values.real,
        love_number_by_period_imaginary=values.imag,
    )


def not_turning(body: Body) -> str | None:
    """Return the reason (text) to omit compliances if the body's rotation is unknown, else None."""
    if body.labelled:
        return "it is computed for one body at a time"
    missing = [n for n in ("spin_period", "dynamical_flattening") if getattr(body, n) is None]
    return f"{in_a_sentence(body.name)} has no {missing[0]}" if missing else None


class Compliances(Variables, along=("number",), no_error=FROM_LAYERS):
    """Compliances, ellipticities and coupling numbers of a body, as values with names."""

    number_value = number(
        "1",
        "dimensionless compliance, ellipticity or other parameter of the body",
        short="value",
        comment="compliances are products of inertia over the moment of a region (whole: kappa, "
        "xi, zeta; fluid core: gamma, beta, delta; inner core: theta, chi, nu), for a wobble of "
        "size 1 of mantle, fluid core and inner core",
    )
    number = labels()


@part(unless=not_turning)
def compliances(layers: LayeredBody, body: Body) -> Compliances:
    """Compute the compliances, ellipticities and coupling numbers of a layered body."""
    checks.refuse_break_up(body)
    by_name = numbers_of(layers, abs(float(body.spin_rate)))
    return Compliances(number_value=list(by_name.values()), number=list(by_name)).with_attributes(
        number_value={"references": layers.reference}
    )


class ElasticModes(Variables, along=("free_mode",), no_error=FROM_LAYERS):
    """Periods of the free modes (wobbles and nutations) of a layered elastic body."""

    compliance_mode_period = number(
        "d",
        "period of a free mode of the elastic body: of a nutation in space (negative if "
        "retrograde), of a wobble in the body",
        short="period",
    )
    free_mode = labels()


@part(unless=not_turning)
def modes(layers: LayeredBody, body: Body) -> ElasticModes:
    """Compute the periods of the free modes (wobbles and nutations) of the body without ocean.

    The dynamical flattening H is the observed one.
    """
    checks.refuse_break_up(body)
    e = float(ellipticity_from_h(body.number("dynamical_flattening")))
    spin_rate = abs(float(body.spin_rate))
    frequencies = free_modes(parts_of(layers, spin_rate, elastic(layers).response, e))
    return ElasticModes(
        compliance_mode_period=[mode_period(n, s, spin_rate) for n, s in frequencies.items()],
        free_mode=list(frequencies),
    )


@part
def neglected() -> Neglected:
    """Effects that the model, a non-rotating sphere, neglects."""
    return Neglected(what="rotation and ellipticity of the body, about one per cent")


love_numbers = public_call(
    LoveNumbers, answer=love, sections=(by_period, compliances, modes, neglected), parts=(layers,)
)

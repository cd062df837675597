"""docs/wobble.md."""

from __future__ import annotations

from functools import partial

import numpy as np

import earthspin
from earthspin.constants import DAY, Constant
from earthspin.interior.anelastic import ABSORPTION_BAND
from earthspin.interior.love import softening
from earthspin.interior.named import INTERIORS
from earthspin.interior.prem import PREM
from earthspin.mass.inertia import polar_moment_factor
from earthspin.wobble import ladder
from earthspin.wobble.record import NEAR
from tests import shipped
from tests.docs.numbers.answers import of_c04, value
from tests.docs.numbers.sentence import Column, Sentence, Told
from tests.wobble.test_neglected import from_bound_to_free

PAGE = "docs/wobble.md"


EARTH = earthspin.EARTH


SPIN = ladder.Spin(EARTH.gm, EARTH.radius, EARTH.spin_period)


FIGURE = {name: EARTH.needed(name) for name in ("dynamical_flattening", "j2", "triaxiality")}


RIGID = ("flattening", "rigid", "triaxial")


def rung(name: str) -> list[float]:
    """Turns, days, and from the elastic rung on the error in days; the factor but for the first."""
    at = shipped.answer("wobble").sel(rung=name)
    error = [] if name in RIGID else [float(at.period_solar_error)]
    factor = [] if name == "flattening" else [float(at.factor)]
    return [float(at.period_sidereal), float(at.period_solar), *error, *factor]


def anelastic() -> list[float]:
    at = shipped.answer("wobble").sel(rung="anelastic")
    names = ("period_sidereal", "period_solar", "period_solar_error", "quality_factor", "factor")
    return [float(at[name]) for name in names]


def love(*names: str) -> list[float]:
    return [value("wobble", "interior", "love_number", love=name) for name in names]


def interior(name: str) -> float:
    return value("wobble", "interior", name)


def core_nutation(shape: str) -> float:
    return value("wobble", "core_nutation", "free_core_nutation", core_shape=shape)


def with_exponent(alpha: float) -> list[float]:
    """Turns, days and quality factor of the last rung."""
    last = earthspin.wobble_ladder(anelastic_exponent=alpha).isel(rung=-1)
    return [float(last[v]) for v in ("period_sidereal", "period_solar", "quality_factor")]


def core_shortens() -> list[float]:
    """Days by which the core shortens the period of a rigid and of an elastic body."""
    rigid, elastic, fluid = (rung(name)[1] for name in ("rigid", "elastic", "fluid-core"))
    a_turn = rung("rigid")[1] / rung("rigid")[0]
    slipping = ladder.roots(
        ladder.inputs_of(INTERIORS["prem"], SPIN, FIGURE), 1.0, (0.0, 0.0, 0.0, 0.0)
    )
    return [rigid - float(slipping.turns) * a_turn, elastic - fluid]


def global_ocean() -> float:
    """Days that an ocean all over adds."""
    wet = earthspin.wobble_ladder(ocean="global").period_solar
    return float(wet.sel(rung="ocean") - wet.sel(rung="fluid-core"))


def with_any_exponent() -> list[float]:
    """Median and ends of 95 % of the periods, with the exponent anywhere in its range."""
    exponents = np.linspace(0.0, 0.2, 9)
    days = np.polynomial.Polynomial.fit(exponents, [with_exponent(a)[1] for a in exponents], 6)
    rng = np.random.default_rng(0)
    other = np.hypot.reduce([sensitivity(k)[1] for k in ("k2", "core_fraction", "ocean")]) / 1.96
    drawn = days(rng.uniform(0.04, 0.19, 400_000)) + other * rng.standard_normal(400_000)
    return [float(q) for q in np.quantile(drawn, [0.5, 0.025, 0.975])]


def sensitivity(name: str) -> list[float]:
    at = shipped.tree("wobble")["sensitivity"].sel(input=name)
    return [float(at.days_per_unit), float(at.days_from_input)]


def mars() -> list[float]:
    core = earthspin.wobble_ladder(body="mars").sel(rung="fluid-core")
    return [float(core.period_solar), float(core.period_solar_error)]


def observed_core() -> Constant:
    """Ellipticity of the Earth's core by its free nutation."""
    found = INTERIORS["prem"].observed_core_ellipticity
    assert found is not None
    return found


def of_input(name: str) -> list[float]:
    at = shipped.tree("wobble")["sensitivity"].sel(input=name)
    return [float(at.input_value), float(at.input_half_width)]


def left_out(what: str) -> float:
    return value("wobble", "neglected", "neglected_effect", effect=what)


def secular(radius: float) -> float:
    """3 G (C - A)/(Omega^2 R^5)."""
    earth = earthspin.EARTH
    return float(3 * earth.gm * earth.j2 * earth.radius**2 / (earth.spin_rate**2 * radius**5))


def two_days() -> list[float]:
    """A turn in days, a day in s, the wobble's period, d, and how far its two numbers part."""
    turn = float(EARTH.needed("spin_period")) / DAY
    return [turn, DAY, NEAR, NEAR / turn - NEAR]


def with_equatorial_radius() -> float:
    """Days by which the elastic rung is longer with the wrong radius in kappa."""
    turns, days, *_ = rung("elastic")
    h = EARTH.dynamical_flattening
    e = h / (1 - h)
    kappa = (e * turns - 1) / (1 + turns) * (float(EARTH.radius) / PREM.radius) ** 5
    return ((1 + kappa) / (e - kappa) - turns) * days / turns


def flatter_core() -> float:
    """By how much the core that the nutation asks for is flatter than the hydrostatic one, %."""
    return 100 * (observed_core().value / of_input("core_ellipticity")[0] - 1)


def from_one_second() -> float:
    """What the softening from 1 s to 200 s alone does to the period with an ocean, d."""
    interior = INTERIORS["prem"]
    assert interior.layers is not None
    inputs = ladder.inputs_of(interior, SPIN, FIGURE)
    moment = polar_moment_factor(inputs.j2, inputs.dynamical_flattening) - inputs.j2
    unit = SPIN.centrifugal(ladder.love_radius(interior, SPIN)) / moment
    stiff, water = (
        ladder._compliance(interior, inputs),
        ladder._water(interior, inputs, unit, "real"),
    )
    strain = -2 / np.pi * np.log(ABSORPTION_BAND)
    softer = tuple(
        value * ratio(strain)
        for value, ratio in zip(stiff, softening(interior.layers), strict=True)
    )
    before, after = (ladder.roots(inputs, unit, c, water).turns for c in (stiff, softer))
    return float(after - before) * two_days()[0]


def exponent_of_the_observed_quality() -> float:
    """That with which the last rung has the observed Q."""
    observed_q = of_c04("burg")[2]
    exponents = np.array([0.09, 0.1, 0.11, 0.12, 0.13, 0.15])
    q = [with_exponent(a)[2] for a in exponents]
    return float(np.interp(np.log(observed_q), np.log(q[::-1]), exponents[::-1]))


MATHEWS = "published: Mathews, Buffett, Herring & Shapiro 1991"


SMITH = "published: Smith & Dahlen 1981"


KONOPLIV = "published: Konopliv et al. 2020"


GIVEN = "given: the truth of a simulation, or what a table is made for"


ERROR = "what an error is, by definition"


EXPONENTS = "| $\\alpha$ | sidereal days | days | $Q$ |"


MEASURED = [
    *(
        Sentence(PAGE, text, partial(rung, name))
        for name, text in (
            ("flattening", "| `flattening` | $1/f$ | {} | {} | |"),
            ("rigid", "| `rigid` | $A/(C-A)$ | {} | {} | {} |"),
            ("triaxial", r"| `triaxial` | $\sqrt{AB/((C-A)(C-B))}$ | {} | {} | {} |"),
            ("elastic", r"| `elastic` | $(1+\kappa)/(e-\kappa)$ | {} | {} ± {} | {} |"),
            ("fluid-core", "| `fluid-core` | root of mantle and core | {} | {} ± {} | {} |"),
            ("ocean", "| `ocean` | the same, with an ocean | {} | {} ± {} | {} |"),
        )
    ),
    Sentence(
        PAGE,
        "| `anelastic` | the same, complex modulus | {} | {} ± {}, $Q$ = {} | {} |",
        anelastic,
    ),
    Sentence(PAGE, r"$k_s = 3G(C-A)/(\Omega^2R^5)$ = {}", partial(secular, PREM.radius)),
    Sentence(
        PAGE,
        "With the equatorial radius\n  $k_s$ is {} and the period",
        partial(secular, float(earthspin.EARTH.radius)),
    ),
    Sentence(PAGE, "by {} days with a rigid mantle and by {} with an elastic one", core_shortens),
    Sentence(PAGE, "and the period by {} days. The real ocean has coasts", global_ocean),
    Sentence(
        PAGE,
        "the median of the periods is {} days and 95 % of them lie\nbetween {} and {}.",
        with_any_exponent,
        0.15,
        slow=True,
    ),
    Sentence(PAGE, "| $I/MR^2$ | {} (0.330799", partial(interior, "moment_factor")),
    Sentence(PAGE, "| core's share of the moment | {} |", partial(interior, "core_fraction")),
    Sentence(PAGE, "| $k_2$, $h_2$, $l_2$ | {}, {}, {} |", partial(love, "k2", "h2", "l2")),
    Sentence(PAGE, "| $k_2'$, $h_2'$ of a load | {}, {} |", partial(love, "k2_load", "h2_load")),
    Sentence(PAGE, "| $k$ if liquid throughout | {} |", partial(interior, "fluid_love_number")),
    Sentence(PAGE, "by Clairaut's equation) gives {} d", partial(core_nutation, "hydrostatic")),
    Sentence(PAGE, "the result is\n{} d. Since", partial(core_nutation, "observed")),
    Sentence(PAGE, "(1+k'-h')} = {},$$", partial(interior, "global_ocean_love_number")),
    *(
        Sentence(PAGE, f"\n| {alpha} | {{}} | {{}} | {{}} |", partial(with_exponent, alpha))
        for alpha in (0, 0.04, 0.09, 0.12, 0.15, 0.19)
    ),
    *(
        Sentence(PAGE, f"{label} | {{}} | {{}} |", partial(sensitivity, name))
        for name, label in (
            ("anelastic_exponent", "| 0.09 (0.04 to 0.19)"),
            ("k2", "| 0.2983 ± 0.0018"),
            ("ocean", "| 0.0453 ± 0.0018"),
            ("core_fraction", "| 0.1137 ± 0.0004"),
            ("core_ellipticity", "| 0.00254 ± 0.00010"),
        )
    ),
    Sentence(
        PAGE, "| $H$ | 0.0032737949 | {} | {} |", partial(sensitivity, "dynamical_flattening")
    ),
    Sentence(PAGE, "Its computed period is\n{} ± {} days (input numbers only), against", mars),
    Sentence(
        PAGE,
        "| rotation and ellipticity in the Love number | {} |",
        partial(left_out, "rotation and ellipticity in the Love number"),
    ),
    Sentence(PAGE, "| a solid inner core | {} |", partial(left_out, "a solid inner core")),
    *(
        Sentence(PAGE, f"{label} | {{}} ± {{}} |", partial(of_input, name))
        for name, label in (
            ("k2", "| $k_2$"),
            ("ocean", r"| ocean $\Delta k$"),
            ("core_fraction", "| core fraction"),
            ("core_ellipticity", "| core ellipticity"),
        )
    ),
    Sentence(
        PAGE,
        "require a core that is 5 % flatter (${}$, Mathews",
        lambda: observed_core().value,
    ),
    Sentence(
        PAGE,
        "core in hydrostatic\nequilibrium ($e_f = {}$",
        lambda: of_input("core_ellipticity")[0],
    ),
    Sentence(
        PAGE,
        "# From {} to {} days: the free wobble",
        lambda: [rung("rigid")[1], of_c04("burg")[0]],
    ),
    Sentence(PAGE, "predicted a period of about {} days", lambda: rung("rigid")[1]),
    Sentence(
        PAGE,
        "One rotation lasts {} days of {} s. At {} days the\ntwo units differ by {} days",
        two_days,
    ),
    Sentence(PAGE, "| sidereal days | days of {} s | factor |", lambda: DAY),
    Sentence(PAGE, "flattening of the figure, $f$ = 1/{},", lambda: 1 / EARTH.needed("flattening")),
    Sentence(PAGE, "one gets $1/H$ = {}.", lambda: 1 / EARTH.dynamical_flattening),
    Sentence(PAGE, "that of the sphere ({} km)", lambda: PREM.radius / 1e3),
    Sentence(PAGE, "the period of this rung is {} days longer", with_equatorial_radius),
    Sentence(PAGE, "require a core that is {} % flatter", flatter_core),
    Sentence(
        PAGE,
        "from {} s to {} s and changes the period by {} days",
        lambda: [1, ABSORPTION_BAND, from_one_second()],
    ),
    Sentence(PAGE, "The observed {} ± {} days require", lambda: of_c04("burg")[:2]),
    Sentence(PAGE, "they indicate $\\alpha$ near {}.", exponent_of_the_observed_quality, slow=True),
    Sentence(PAGE, "elastic, for {} |", lambda: love("k2")[0]),
    Sentence(PAGE, "bound to the mantle it is {} d (section", from_bound_to_free),
]
TOLD = [
    Told(PAGE, "Errors are half-widths of {} % intervals", ERROR),
    Told(PAGE, "days from error of input ({} %)", ERROR),
    Told(PAGE, "Conventions (2010), eq. {} (Desai", "the number of an equation"),
    Told(PAGE, "Conventions (2010), table {}, elastic", "the number of a table"),
    Column(PAGE, EXPONENTS, "$\\alpha$", GIVEN),
    Told(PAGE, "the median of the periods is 433.0 days and {} % of them", "which quantiles"),
    Told(
        PAGE,
        "| $I/MR^2$ | 0.330935 ({} with the ocean) | {}, the paper",
        "published: Dziewonski & Anderson 1981",
    ),
    Told(PAGE, "| {}, {}, {} with a liquid inner core", "an independent integration of PREM"),
    Told(PAGE, "| {}, {} (Gross 2007, not verified)", "published: Gross 2007, not verified"),
    Told(PAGE, "for PREM ($\\gamma = {}$, $\\beta = {}$)", MATHEWS),
    Told(PAGE, "chose {}, within {} to {}, to fit", SMITH),
    Told(PAGE, "| $\\alpha$ | {} ({} to {}) |", SMITH),
    Told(PAGE, "values range from {} to {}, a difference", "published: several (not verified)"),
    Told(PAGE, "$(B-A)/Ma^2 = {}$", "published: the figure of earthspin.EARTH"),
    Told(PAGE, "$k_2$ = {} (Konopliv", KONOPLIV),
    Told(PAGE, "a core of {} km", "published: Le Maistre et al. 2023"),
    Told(PAGE, "The observed {} d\nrequire", "published: Mathews, Herring & Buffett 2002"),
    Told(PAGE, "| $H$ | {} |", "published: Mathews, Herring & Buffett 2002"),
    Told(PAGE, "$k_{21}$ = {}, IERS Conventions (2010)", "published, as copied in public code"),
    Told(PAGE, "against {} ± {} observed from orbit (Konopliv", "published: Konopliv et al. 2020"),
]

"""docs/wobble.md."""

from __future__ import annotations

import re
from functools import cache, partial
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import xarray as xr

import earthspin
from data_tools.free_wobble import DRAWS
from earthspin.constants import DAY, Constant
from earthspin.interior.love import softening
from earthspin.interior.named import INTERIORS
from earthspin.interior.prem import PREM
from earthspin.mass.inertia import polar_moment_factor
from earthspin.sky.eop import LONGEST_DAYS
from earthspin.wobble import ladder, likelihood, presence, simulation
from earthspin.wobble.record import BAND, LONGEST_STEP, NEAR
from tests import shipped
from tests.docs.numbers.answers import value
from tests.docs.numbers.sentence import ROOT, Column, Sentence, Told
from tests.wobble.test_neglected import beside_a_core_that_ends_there

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


@cache
def observed() -> xr.Dataset:
    return earthspin.polar_motion()


def fitted(of: xr.Dataset, method: str) -> list[float]:
    found = earthspin.fit_chandler(of, method=method)
    ends = [
        float(found[f"chandler_quality_factor{end}"])
        for end in ("", "_low", "_high")
        if f"chandler_quality_factor{end}" in found
    ]
    return [float(found.chandler_period), float(found.chandler_period_error), *ends]


def of_c04(method: str) -> list[float]:
    return fitted(observed(), method)


@cache
def of_c01(method: str) -> list[float]:
    """Simulated rows of C01 from 1890 to 2022, as `tests/sky/test_eop.py` writes them."""
    from tests.sky.test_eop import rows_of_c01

    time, p = simulation.simulate(132, 433.0, 96.0, step=365.242198781 / 20, seed=4)
    scatter = 20 * np.random.default_rng(1).standard_normal((time.size, 2)) @ [1, 1j]
    with TemporaryDirectory() as folder:
        file = Path(folder) / "eopc01.txt"
        file.write_text(rows_of_c01(11368.5 + time, (p + scatter) / 1e3))
        return fitted(earthspin.polar_motion(file=file), method)


def amplitudes() -> list[float]:
    """Amplitude of the years of the table, mas."""
    text = (ROOT / PAGE).read_text(encoding="utf-8")
    (years,) = re.findall(r"\| year \|([\d |]+)\|", text)
    wobble = earthspin.fit_chandler(observed()).chandler_amplitude
    return [
        float(wobble.sel(time=f"{year.strip()}-01-01", method="nearest")) * 1e3
        if wobble.attrs["units"] == "arcsec"
        else float(wobble.sel(time=f"{year.strip()}-01-01", method="nearest"))
        for year in years.split("|")
    ]


def rows(method: str) -> list[list[str]]:
    """Cells of a table of docs/measured/free-wobble.inc."""
    text = (ROOT / "docs/measured/free-wobble.inc").read_text(encoding="utf-8")
    burg, likelihood = text.split('**`"likelihood"`**')
    lines = (burg if method == "burg" else likelihood).splitlines()
    return [line.strip("| ").split(" | ") for line in lines if re.match(r"\| \d", line)]


def held_by_burg(column: int) -> list[float]:
    """Smallest and largest share of intervals that hold the truth: of T (5), of Q (7)."""
    found = [float(row[column]) for row in rows("burg")]
    return [min(found), max(found)]


def largest_bias(method: str, years: tuple[int, ...] = (25, 65, 130)) -> float:
    """Largest bias in a table, d."""
    return max(abs(float(row[3].split(" ± ")[0])) for row in rows(method) if int(row[1]) in years)


def held_by_likelihood() -> list[float]:
    """Smallest and largest share of intervals of T and Q that hold the truth."""
    found = [float(row[k]) for row in rows("likelihood") for k in (5, 7)]
    return [min(found), max(found)]


def observed_core() -> Constant:
    """Ellipticity of the Earth's core by its free nutation."""
    found = INTERIORS["prem"].observed_core_ellipticity
    assert found is not None
    return found


def of_input(name: str) -> list[float]:
    at = shipped.tree("wobble")["sensitivity"].sel(input=name)
    return [float(at.input_value), float(at.input_half_width)]


def last_amplitude() -> list[float]:
    found = earthspin.fit_chandler(observed())
    return [float(found[f"chandler_amplitude{end}"][-1]) for end in ("", "_error")]


def sinusoids() -> list[float]:
    """Bias, scatter and coverage in per cent of the best sinusoid, 200 records of 65 years."""
    from earthspin.wobble import observed as methods

    fits = [methods.fit(*simulation.simulate(65, seed=k), "least-squares") for k in range(200)]
    off = np.array([fit.period for fit in fits]) - 433
    error = np.array([fit.period_error for fit in fits])
    return [float(off.mean()), float(off.std()), float(100 * np.mean(abs(off) <= error))]


def left_out(what: str) -> float:
    return value("wobble", "neglected", "neglected_effect", effect=what)


def limit() -> float:
    """The least scatter of the period for Q = 100 and 65 years, d."""
    return float(433 * np.sqrt(433 / (4 * np.pi * 100 * 65 * 365.25)))


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
    strain = -2 / np.pi * np.log(ladder.ABSORPTION_BAND)
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


def cut_by_bridges() -> list[float]:
    """How much of the wobble straight lines over ten days and a tenth of a year cut, %."""
    return [100 * (np.pi * days / NEAR) ** 2 / 2 for days in (10, 36.525)]


def beats() -> list[float]:
    """One and two beats of wobble and year, yr."""
    beat = 1 / (1 / 365.25 - 1 / NEAR) / 365.25
    return [NEAR, 365, beat, 2 * beat]


def coverage_of_sixty() -> float:
    """Standard deviation of a share near 95 per cent of sixty, %."""
    return float(100 * np.sqrt(0.95 * 0.05 / DRAWS["likelihood"]))


def under_metres() -> float:
    """Largest radius of the wobble since the middle of 2016, m."""
    found = earthspin.fit_chandler(observed()).chandler_amplitude
    largest = float(found.sel(time=slice("2021-01-01", None)).max())
    return float(np.radians(largest / 3.6e6) * value("polar-motion", "/", "polar_radius"))


def round_trip() -> list[float]:
    """Years of C04, and how well excitation and polar motion give it back, mas."""
    pole = observed()
    back = earthspin.polar_motion_from(earthspin.excitation(pole))
    off = max(float(abs(back[c] - pole[c]).max()) for c in "xy")
    scale = 1e3 if pole.x.attrs["units"] == "arcsec" else 1.0
    years = float((pole.time[-1] - pole.time[0]) / np.timedelta64(1, "D")) / 365.25
    return [years, scale * off]


@cache
def with_excitation() -> list[float]:
    """Scatter of twelve periods with a known excitation and by Burg alone, and the error, d."""
    from earthspin.wobble.driven import fit_with_excitation
    from earthspin.wobble.observed import fit
    from tests.wobble.test_likelihood import driven_pole

    known, alone, claimed = [], [], []
    for seed in range(12):
        days, p, chi = driven_pole(431.0, 90.0, 4.0, seed)
        one = fit_with_excitation(days, p, chi)
        known.append(one.period)
        claimed.append(one.period_error)
        alone.append(fit(days, p).period)
    return [float(np.std(known)), float(np.std(alone)), float(np.mean(claimed))]


def tenfold_by_euler() -> float:
    """Years in which explicit Euler in steps of a day increases a wobble tenfold."""
    return float(2 * np.log(10) / np.log1p((2 * np.pi / NEAR) ** 2) / 365.25)


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
    Sentence(PAGE, "and {} days. The real ocean has coasts", global_ocean),
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
    Sentence(PAGE, "we give\n{} d. Since", partial(core_nutation, "observed")),
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
    Sentence(PAGE, "Its computed period is\n{} ± {} days, against", mars),
    Sentence(
        PAGE,
        '| {} ± {} d, $Q$ = {} ({} to {}) |\n| `"likelihood"`',
        partial(of_c04, "burg"),
        (0, 0, 0, 0, 50),
    ),
    Sentence(PAGE, "For $Q$ = 100 and {} years that is {} days", lambda: [65, limit()]),
    Sentence(
        PAGE,
        "Burg's intervals hold $T$ in {} to {} %",
        partial(held_by_burg, 5),
    ),
    Sentence(PAGE, "and $Q$ in {} to {} %. The likelihood's", partial(held_by_burg, 7)),
    Sentence(
        PAGE,
        "\n{} ± {} d by Burg's method, with $Q$ = {} ({} to {})",
        partial(of_c01, "burg"),
        (0, 0, 0, 0, 5),
    ),
    Sentence(
        PAGE,
        "and as {} ± {} d by the likelihood, with {} ({} to\n{})",
        partial(of_c01, "likelihood"),
        (0, 0, 0, 0, 5),
        slow=True,
    ),
    Sentence(
        PAGE,
        "restricted likelihood | {} ± {} d, $Q$ = {} ({} to {}) |",
        partial(of_c04, "likelihood"),
        (0, 0, 0, 0, 5),
        slow=True,
    ),
    Sentence(PAGE, "gives no $Q$ | {} ± {} d |", partial(of_c04, "least-squares"), slow=True),
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
        "The last window of the table to September 2026 has its middle in June 2023: {} ± {} mas",
        last_amplitude,
    ),
    Sentence(
        PAGE,
        "Burg's bias is at most {} d (in {} years), the likelihood's {} d",
        lambda: [largest_bias("burg"), 25, largest_bias("likelihood")],
    ),
    Sentence(
        PAGE,
        "over {} years and more both are within {} d, with\nred",
        lambda: [65, max(largest_bias(m, (65, 130)) for m in ("burg", "likelihood"))],
    ),
    Sentence(PAGE, "are on the safe side: {} to {} % in 60", held_by_likelihood),
    Sentence(
        PAGE,
        "asks for a core that is 5 % flatter (${}$, Mathews",
        lambda: observed_core().value,
    ),
    Sentence(
        PAGE,
        "core in hydrostatic\nequilibrium ($e_f = {}$",
        lambda: of_input("core_ellipticity")[0],
    ),
    Sentence(
        PAGE,
        "One milliarcsecond is {} cm on the ground",
        lambda: 100 * np.radians(1 / 3.6e6) * value("polar-motion", "/", "polar_radius"),
    ),
    Sentence(
        PAGE,
        "is off by {} d, scatters by {} d, and its error\nholds the truth in {} %",
        sinusoids,
        slow=True,
    ),
    Sentence(PAGE, "| amplitude, mas |" + " {} |" * 9, amplitudes),
]
MEASURED += [
    Sentence(
        PAGE,
        "# From {} to {} days: the free wobble",
        lambda: [rung("rigid")[1], of_c04("burg")[0]],
    ),
    Sentence(PAGE, "predicted a period of about {} days", lambda: rung("rigid")[1]),
    Sentence(
        PAGE,
        "One turn lasts {} days of {} s. At {} days the\ntwo units differ by {} days",
        two_days,
    ),
    Sentence(PAGE, "| sidereal days | days of {} s | factor |", lambda: DAY),
    Sentence(PAGE, "flattening of the figure, $f$ = 1/{},", lambda: 1 / EARTH.needed("flattening")),
    Sentence(PAGE, "one gets $1/H$ = {}.", lambda: 1 / EARTH.dynamical_flattening),
    Sentence(PAGE, "that of the sphere ({} km)", lambda: PREM.radius / 1e3),
    Sentence(PAGE, "the period of this rung is {} days longer", with_equatorial_radius),
    Sentence(PAGE, "asks for a core that is {} % flatter", flatter_core),
    Sentence(
        PAGE,
        "from {} s to {} s and changes the period by {} days",
        lambda: [1, ladder.ABSORPTION_BAND, from_one_second()],
    ),
    Sentence(PAGE, "The observed {} ± {} days require", lambda: of_c04("burg")[:2]),
    Sentence(PAGE, "they indicate $\\alpha$ near {}.", exponent_of_the_observed_quality, slow=True),
    Sentence(PAGE, "as recalled, for {} |", lambda: love("k2")[0]),
    Sentence(PAGE, "ends at the inner core's boundary it is {} d", beside_a_core_that_ends_there),
    Sentence(
        PAGE,
        "gaps up to ten steps and {} days. These",
        lambda: LONGEST_DAYS,
    ),
    Sentence(PAGE, "of itself: {} % over ten days, {} % over the tenth", cut_by_bridges),
    Sentence(PAGE, "All methods accept steps up to {} days", lambda: LONGEST_STEP),
    Sentence(PAGE, "of known truth: $T$ = {} d, with seasons", lambda: NEAR),
    Sentence(
        PAGE,
        "its memory is {} days\nthere, and {} in the model that is fitted",
        lambda: [simulation.RED_MEMORY, likelihood.MEMORY],
    ),
    Sentence(PAGE, "determines the percentage to {} %", coverage_of_sixty),
    Sentence(
        PAGE,
        "To separate {} from {} days takes\none beat, {} years; "
        "the methods require two beats, {} years",
        beats,
    ),
    Sentence(
        PAGE,
        "the power between {} and {} days is compared",
        lambda: BAND,
    ),
    Sentence(
        PAGE,
        "on either side ({} to {} and {} to {} days)",
        lambda: [*presence.SLOWER[::-1], *presence.FASTER[::-1]],
    ),
    Sentence(PAGE, "It is under {} m now", under_metres, bound=True),
    Sentence(
        PAGE,
        "Applied one after the other to {} years of daily\nvalues, they reproduce C04 within",
        lambda: round_trip()[0],
        1.0,
    ),
    Sentence(PAGE, "they reproduce C04 within ${}$ mas", lambda: round_trip()[1], bound=True),
    Sentence(
        PAGE,
        "scatter by {} d, against {} d of Burg's method on the pole alone; "
        "the errors claimed were {} d",
        with_excitation,
        slow=True,
    ),
    Sentence(PAGE, "increases an undamped wobble tenfold in {} years", tenfold_by_euler),
]
MATHEWS = "published: Mathews, Buffett, Herring & Shapiro 1991"
SMITH = "published: Smith & Dahlen 1981"
KONOPLIV = "published: Konopliv et al. 2020"
GIVEN = "given: the truth of a simulation, or what a table is made for"
ERROR = "what an error is, by definition"
EXPONENTS = "| $\\alpha$ | sidereal days | days | $Q$ |"
LAYOUT = "published: the layout of the tables of the IERS"
TOLD = [
    Told(PAGE, "Errors are half-widths of {} % intervals", ERROR),
    Told(PAGE, "days from error of input ({} %)", ERROR),
    Told(PAGE, "All errors are {} %", ERROR),
    Told(PAGE, "how many of the {} % intervals hold", ERROR),
    Told(PAGE, "Conventions (2010), eq. {} (Desai", "the number of an equation"),
    Told(PAGE, "Conventions (2010), table {}, as recalled", "the number of a table"),
    Column(PAGE, EXPONENTS, "$\\alpha$", GIVEN),
    Told(PAGE, "the median of the periods is 433.0 days and {} % of them", "which quantiles"),
    Told(PAGE, "| {} year from 1846, {} year from 1890 |", LAYOUT),
    Told(PAGE, '(`"least-squares"`, 200 records of {} years', GIVEN),
    Told(PAGE, "A span of {} years determines $Q$ only", GIVEN),
    Told(PAGE, "simulated wobbles pass, even in {}\nyears", GIVEN),
    Told(PAGE, "With white noise of {}\nmas in steps of two days", GIVEN),
    Told(PAGE, "unknown to the fit, {} years and $Q$ = 90", GIVEN),
    Told(
        PAGE,
        "| $I/MR^2$ | 0.330935 ({} with the ocean) | {}, the paper",
        "published: Dziewonski & Anderson 1981",
    ),
    Told(PAGE, "| {}, {}, {} with a liquid inner core", "an independent integration of PREM"),
    Told(PAGE, "| {}, {} (Gross 2007, as recalled)", "published: Gross 2007, as recalled"),
    Told(PAGE, "for PREM ($\\gamma = {}$, $\\beta = {}$)", MATHEWS),
    Told(PAGE, "chose {}, within {} to {}, to fit", SMITH),
    Told(PAGE, "| $\\alpha$ | {} ({} to {}) |", SMITH),
    Told(PAGE, "values range from {} to {}, a difference", "published: several, as recalled"),
    Told(PAGE, "$(B-A)/Ma^2 = {}$", "published: the figure of earthspin.EARTH"),
    Told(PAGE, "$k_2$ = {} (Konopliv", KONOPLIV),
    Told(PAGE, "a core of {} km", "published: Le Maistre et al. 2023"),
    Told(PAGE, "The observed {} d\nasks for", "published: Mathews, Herring & Buffett 2002"),
    Told(PAGE, "| $H$ | {} |", "published: Mathews, Herring & Buffett 2002"),
    Told(
        PAGE, "has a circle of {} m, a cone of {} arcsec and a period of {} days", "the source text"
    ),
    Told(PAGE, "A simulated pole of {} days and", GIVEN),
    Told(PAGE, "with errors of {} mas, is recovered", GIVEN),
    Told(PAGE, "$k_{21}$ = {}, IERS Conventions (2010)", "published, as recalled"),
    Told(PAGE, "against {} ± {} observed from orbit (Konopliv", "published: Konopliv et al. 2020"),
    Told(PAGE, "found {} ± {} d and $Q$ = {} ({} to {}), one", "published: Nastula & Gross 2015"),
]

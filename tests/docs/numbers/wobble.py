"""docs/wobble.md."""

from __future__ import annotations

import re
from functools import cache, partial
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import xarray as xr

import earthspin
from earthspin.constants import Constant
from earthspin.interior.named import INTERIORS
from earthspin.interior.prem import PREM
from earthspin.wobble import ladder, simulation
from tests import shipped
from tests.docs.numbers.answers import value
from tests.docs.numbers.sentence import ROOT, Sentence, Told

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
    Sentence(PAGE, "For $Q$ = 100 and 65 years that is {} days", limit),
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
        "Burg's bias is at most {} d (in 25 years), the likelihood's {} d",
        lambda: [largest_bias("burg"), largest_bias("likelihood")],
    ),
    Sentence(
        PAGE,
        "both are within {} d, with\nred",
        lambda: max(largest_bias(method, (65, 130)) for method in ("burg", "likelihood")),
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
MATHEWS = "published: Mathews, Buffett, Herring & Shapiro 1991"
SMITH = "published: Smith & Dahlen 1981"
KONOPLIV = "published: Konopliv et al. 2020"
GIVEN = "given: the truth of a simulation"
TOLD = [
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
    Told(PAGE, "One turn lasts {} days of 86,400 s", "published: the spin of earthspin.EARTH"),
    Told(PAGE, "$k_2$ = {} (Konopliv", KONOPLIV),
    Told(PAGE, "a core of {} km", "published: Le Maistre et al. 2023"),
    Told(PAGE, "The observed {} d\nasks for", "published: Mathews, Herring & Buffett 2002"),
    Told(PAGE, "| $H$ | {} |", "published: Mathews, Herring & Buffett 2002"),
    Told(
        PAGE, "has a circle of {} m, a cone of {} arcsec and a period of {} days", "the source text"
    ),
    Told(PAGE, "A simulated pole of {} days and", GIVEN),
    Told(PAGE, "with errors of {} mas, is recovered", GIVEN),
    Told(PAGE, "the power between 400 and {} days is compared", "given: a band"),
    Told(PAGE, "(12 mas with a memory of {} d)", GIVEN),
    Told(PAGE, "With white noise of {}\nmas in steps of two days", GIVEN),
    Told(PAGE, "on C04 since 1985 ($T$ = {} d", GIVEN),
    Told(PAGE, "$k_{21}$ = {}, IERS Conventions (2010)", "published, as recalled"),
    Told(PAGE, "against {} ± {} observed from orbit (Konopliv", "published: Konopliv et al. 2020"),
    Told(PAGE, "found {} ± {} d and $Q$ = {} ({} to {}), one", "published: Nastula & Gross 2015"),
]

"""docs/pole.md: the comparison with the IAU."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, partial

import numpy as np

import earthspin
from data_tools import core_resonance as resonance
from earthspin import EARTH
from earthspin.constants import DAY, JULIAN_YEAR
from earthspin.interior.diurnal_ocean import WAVES, wave_response
from earthspin.motion.effects import RIGID
from earthspin.nutation.additions import SOURCE as ADDITIONS_SOURCE
from earthspin.nutation.additions import added_to
from earthspin.nutation.ladder import quality
from earthspin.parts.path import HALF_SPAN
from tests.docs.numbers.answers import (
    MAS_A_CENTURY,
    iau,
)
from tests.docs.numbers.sentence import Sentence, Told

PAGE = "docs/pole.md"


def budget(effect: str, kernel: str = "de421", of: str = "psi_rate") -> float:
    """Share of an effect in the rate, mas a century."""
    return float(iau(kernel)[of].sel(effect=effect)) * MAS_A_CENTURY


def inferred(origin: str) -> list[float]:
    section = iau()["inferred_flattening"].sel(origin=origin)
    return [float(section[v]) for v in ("flattening", "flattening_error", "polar_moment")]


def residual(model: str) -> list[float]:
    sizes = iau()["residual_sizes"].sel(model=model)
    names = ("residual_rms", "residual_maximum", "residual_rms_unfitted")
    return [float(v) for name in names for v in sizes[name].values]


def angle(name: str, of: str, degrees: Sequence[int] = (0, 1, 2)) -> list[float]:
    section = iau()["angles"][of].sel(angle=name)
    return [float(section.values[k]) for k in degrees]


def core(name: str) -> float:
    return float(iau()["core"][name])


def blind() -> list[float]:
    """Period, d, and quality factor of the fit that knows nothing of additions."""
    return [resonance.blind().period / DAY, resonance.blind().quality]


def ladder_fitted() -> list[float]:
    """Quality factor of the last rung: of its mode, and as the fit finds it."""
    found = resonance.fitted(resonance.predicted("coupling"))
    return [quality(resonance.core_mode("coupling")), found.quality]


def found_added(multiple: tuple[int, ...]) -> list[float]:
    """Left by a response that is blind to additions, in phase and out of phase, uas."""
    left = resonance.left_by(resonance.held(resonance.BUILT_IN), multiple)
    return [left.real, left.imag]


def more_at_the_prograde_year() -> float:
    """Found there less what is published, uas."""
    of = iau()["core"].to_dataset().sel(added_to="+0 +1 +0 +0 +0")
    parts = (
        of[f"added_{phase}"] - of[f"added_published_{phase}"]
        for phase in ("in_phase", "out_of_phase")
    )
    return float(np.hypot(*parts))


def phases_beside_the_resonance() -> list[float]:
    """Of two additions, retrograde, and of the sea in K1, degrees."""
    multiples = np.array([resonance.ADDED_TO["retrograde year"], resonance.HALF_YEAR])
    added = 1j * added_to(multiples)
    return [*np.degrees(np.angle(added)), float(np.degrees(np.angle(wave_response(WAVES["K1"]))))]


def total(name: str) -> float:
    return float(iau()[name])


def closure_in_deviations() -> list[float]:
    return [abs(total(f"closure_over_{of}")) for of in ("flattening", "uncertainty")]


@cache
def geodesic_by_the_sun() -> float:
    """Geodesic precession, mas a century, with the Sun alone."""
    alone = earthspin.compare_iau(perturbers=["sun"])
    return float(alone.psi_rate.sel(effect="geodesic")) * MAS_A_CENTURY


def of_j2_rate() -> float:
    """Quadratic term of the longitude by the rate of J2, mas a century squared."""
    on, off = (
        earthspin.pole("1935-01-01", "2050-01-01", "30 d", effects=effects).sel(axis="figure")
        for effects in (RIGID, tuple(e for e in RIGID if e != "j2-rate"))
    )
    centuries = (on.time.values - np.datetime64("2000-01-01T12:00")) / np.timedelta64(36525, "D")
    apart = 1e3 * (on.psi - off.psi).values
    return float(np.polynomial.Polynomial.fit(centuries, apart, 2).convert().coef[2])


def analysis(kernel: str) -> float:
    """By how much the rate of the IAU's own pole comes out too large, mas a century."""
    return float(iau(kernel).psi_rate_analysis_error) * MAS_A_CENTURY


def closure_in_ppm() -> float:
    """Of the rate, by DE440."""
    closure = iau("de440").closure
    return 1e6 * abs(float(closure / iau("de440").psi_rate_iau))


def by_figure() -> list[float]:
    """Uncertainty of H in parts in a million, one standard deviation, and of the rate."""
    relative = EARTH.relative_uncertainty["dynamical_flattening"]
    return [1e6 * relative, relative * float(iau().psi_rate_iau) * MAS_A_CENTURY]


ANGLES = {
    "psi_A": r"$\psi_A$",
    "omega_A": r"$\omega_A$",
    "eps_A": r"$\epsilon_A$",
    "p_A": "$p_A$",
}


OURS, P03 = "angle_coefficient", "angle_coefficient_iau"


#: Effect, and its row of the budget up to the numbers by DE421 and published.
BUDGET = {
    "first-order": ("| first order | {} | {} | ", "5,040,435.3 | {} |"),
    "planets": ("| planets | {} | {} | ", "+31.367 | {} (-1.40) |"),
    "j3": ("| J3 | {} | {} | ", "| {} |"),
    "j4": ("| J4 | {} | {} | ", "+2.60 | 0 |"),
    "geodesic": ("| geodesic | {} | {} | ", "-1919.883 | 0 |"),
    "second-order": ("| second order | {} | {} | ", "-46.78 | {} |"),
}


def budget_row(effect: str) -> list[float]:
    """By DE440 and DE421, and that of omega_A by DE440, if it is not 0."""
    omega = budget(effect, "de440", "omega_rate")
    both = [budget(effect, kernel) for kernel in ("de440", "de421")]
    return [*both, *([omega] if abs(omega) > 5e-3 else [])]


def prem_off() -> float:
    """Per cent by which the polar moment of PREM is off."""
    return 100 * (inferred("PREM")[2] / inferred("published")[2] - 1)


#: Terms of the table of rigid ones, in its order, and what REN-2000 has.
LEADING = {
    "+0 +0 +0 +0 +1": "8050.867",
    "+0 +0 +0 +0 -1": "1177.043",
    "+0 +0 +2 -2 +2": "530.743",
    "+0 +0 +2 +0 +2": "91.517",
}


def leading(term: str) -> list[float]:
    """Period, d, and amplitude of a rigid term by DE440, less its neighbour's share, mas."""
    of = iau("de440")["nutation"].to_dataset().sel(term=term)
    amplitude = complex(of.rigid_in_phase, of.rigid_out_of_phase)
    neighbour = complex(of.neighbour_in_phase, of.neighbour_out_of_phase)
    response = complex(of.transfer_in_phase, of.transfer_out_of_phase)
    return [float(of.period), abs(amplitude - neighbour / response) / resonance.OVER_REN_2000]


def closures() -> list[float]:
    both = [float(iau(kernel).closure) for kernel in ("de440", "de421")]
    return [MAS_A_CENTURY * v for v in (*both, float(iau("de440").omega_closure))]


P03_TABLE = "published: Capitaine, Wallace & Chapront 2003, table 3"


REN = "published: Souchay et al. 1999"


MEASURED = [
    Sentence(
        PAGE,
        "the uncertainty of $H$ makes {} mas of that column",
        lambda: float(iau()["residual_sizes"].residual_rms_unfitted_error),
    ),
    Sentence(PAGE, "| planets | +31.326 | {} | +31.367", partial(budget, "planets")),
    Sentence(PAGE, "| J4 | +2.521 | {} | +2.60", partial(budget, "j4")),
    Sentence(PAGE, "| geodesic | -1919.841 | {} | -1919.883", partial(budget, "geodesic")),
    Sentence(PAGE, "| second order | -45.954 | {} | -46.78", partial(budget, "second-order")),
    Sentence(
        PAGE, "| first order | 5,040,431.1 | {} | 5,040,435.3", partial(budget, "first-order")
    ),
    Sentence(
        PAGE,
        "| **closure** | **-3.39** | **{}** | | **",
        lambda: float(iau().closure) * MAS_A_CENTURY,
    ),
    *(
        Sentence(PAGE, "".join(row), partial(budget_row, effect), slow=True, de440=True)
        for effect, row in BUDGET.items()
    ),
    Sentence(PAGE, "| **closure** | **{}** | **{}** | | **{}** |", closures, slow=True, de440=True),
    Sentence(
        PAGE,
        "| from the IAU's rate, by our theory | {} ± {} | {} |",
        partial(inferred, "from the IAU's rate"),
        (2e-10, 0, 0),
    ),
    Sentence(
        PAGE, "| Mathews, Herring & Buffett 2002 | {} ± {} | {} |", partial(inferred, "published")
    ),
    Sentence(PAGE, r"| PREM, $I = 0.330799\,M R^2$ | {} | {} |", lambda: inferred("PREM")[::2]),
    *(
        Sentence(
            PAGE,
            f"| {words} | {{}} / {{}} | {{}} / {{}} | {{}} / {{}} |",
            partial(residual, model),
        )
        for model, words in (
            ("first-order", "Sun and Moon, mean pole, angular momentum"),
            ("rigid", "all effects, figure axis"),
            ("nonrigid", "the same, with the non-rigid response fitted to IAU 2000A"),
            (
                "predicted",
                "the same, with the response [predicted from the layers](nutation.md)",
            ),
        )
    ),
    *(
        Sentence(PAGE, f"| {symbol} | ours | {{}} | {{}} | {{}} |", partial(angle, name, OURS))
        for name, symbol in ANGLES.items()
    ),
    Sentence(PAGE, r"| $\chi_A$ | ours | 0 | {} | {} |", partial(angle, "chi_A", OURS, (1, 2))),
    Sentence(PAGE, "| | P03 | 0 | {} | {} |\n| $\\omega_A$", partial(angle, "psi_A", P03, (1, 2))),
    Sentence(PAGE, "| | P03 | {} | {} | {} |\n| $\\epsilon_A$", partial(angle, "omega_A", P03)),
    Sentence(PAGE, "| | P03 | {} | {} | {} |\n| $\\chi_A$", partial(angle, "eps_A", P03)),
    Sentence(PAGE, "| | P03 | 0 | {} | {} |\n| $p_A$", partial(angle, "chi_A", P03, (1, 2))),
    Sentence(PAGE, "| | P03 | 0 | {} | {} |\n\nOur", partial(angle, "p_A", P03, (1, 2))),
    Sentence(
        PAGE,
        "The fit then recovers a **free core nutation of {} d**, Q of {} (built in",
        lambda: [core("core_nutation_period"), core("core_nutation_quality")],
        (0.0, 5.0),
    ),
    Sentence(PAGE, "20,000), with a residual of {} uas rms.", partial(core, "apart_rms")),
    Sentence(
        PAGE,
        "differ\nby {}, {} and {} uas from REN-2000, neighbours included",
        lambda: [resonance.beside_ren_2000(multiple) for multiple in resonance.REN_2000],
    ),
    *(
        Sentence(PAGE, f"| {words} | {{}} | {{}} | {rest}", partial(found_added, multiple))
        for words, rest, multiple in (
            ("year, retrograde", "−86.6", resonance.ADDED_TO["retrograde year"]),
            ("year, prograde", "−9.8", resonance.ADDED_TO["prograde year"]),
            ("period of the node, prograde", "−34.3", resonance.ADDED_TO["prograde 18.6 years"]),
            ("half year, retrograde", "−6.4", resonance.HALF_YEAR),
        )
    ),
    Sentence(
        PAGE,
        "IAU 2000A differs there by {} uas from the published value",
        more_at_the_prograde_year,
    ),
    Sentence(
        PAGE,
        "- The {} uas by which the prograde year of IAU 2000A differs",
        more_at_the_prograde_year,
    ),
    Sentence(
        PAGE,
        "({} degrees in the year and {} in the half year, retrograde; {} for the ocean in K1)",
        phases_beside_the_resonance,
    ),
    Sentence(PAGE, "the\nperiod remains at {} d, but Q comes out at {}:", blind, (0.0, 5.0)),
    Sentence(
        PAGE,
        "has Q of {} and\nwhose ocean response depends on the frequency, it gives {} (",
        ladder_fitted,
        0.0,
    ),
    Sentence(
        PAGE,
        "and geodesic nutation, too, the period is **{} d**",
        partial(core, "core_nutation_period_absorbing"),
    ),
    Sentence(
        PAGE,
        "its residual is {} uas rms over all terms, and {} uas at most",
        lambda: [core("response_rms"), core("response_maximum")],
    ),
    Sentence(
        PAGE, "It is {} standard deviations of $H$ alone, and {} of $H$", closure_in_deviations
    ),
    Sentence(
        PAGE,
        "with them our rate is {} mas/cy larger",
        lambda: total("omega_closure_with_tides") * MAS_A_CENTURY,
        0.06,
    ),
    Sentence(PAGE, "observed moment); its $C$ differs by {} %", prem_off),
    Sentence(
        PAGE,
        "- The second order is {} mas/cy smaller than published",
        lambda: budget("second-order") + 46.78,
    ),
    Sentence(
        PAGE,
        "With the fitted response, the residual is {} mas rms, and {} mas at most",
        lambda: [residual("nonrigid")[0], residual("nonrigid")[3]],
    ),
    *(
        Sentence(PAGE, f"\n| {{}} | {{}} | {ren} |", partial(leading, term), slow=True, de440=True)
        for term, ren in LEADING.items()
    ),
    Sentence(
        PAGE,
        "one least-squares analysis of {} years about J2000.0",
        lambda: 2 * HALF_SPAN * DAY / JULIAN_YEAR,
        1.5,
    ),
    Sentence(
        PAGE,
        "The shorter span of DE421 changes the closure by {} mas/cy",
        lambda: closures()[0] - closures()[1],
        slow=True,
        de440=True,
    ),
    Sentence(PAGE, "appears in $t^2$: {}\nmas/cy²", of_j2_rate, slow=True),
    Sentence(
        PAGE,
        "The Moon contributes {} mas/cy to the geodesic precession. With the Sun alone it is {}.",
        lambda: [geodesic_by_the_sun() - budget("geodesic"), geodesic_by_the_sun()],
        slow=True,
    ),
    Sentence(PAGE, "$H$ is fixed at {} and", lambda: EARTH.dynamical_flattening),
    Sentence(PAGE, "those of the IAU to {} ppm", closure_in_ppm, slow=True, de440=True),
    Sentence(
        PAGE,
        "constants of {} and {} mas are not errors",
        lambda: [
            abs(1e3 * angle("psi_A", OURS)[0]),
            1e3 * (angle("eps_A", OURS)[0] - angle("eps_A", P03)[0]),
        ],
    ),
    Sentence(
        PAGE,
        "published rate by {} (DE440) to {} (DE421) mas/cy",
        lambda: [analysis("de440"), analysis("de421")],
        slow=True,
        de440=True,
    ),
    Sentence(
        PAGE,
        "The closure, {} mas/cy ({} ppm of the rate): 2.3 standard",
        lambda: [closures()[0], closure_in_ppm()],
        slow=True,
        de440=True,
    ),
    Sentence(
        PAGE,
        "of the rate): {} standard deviations of $H$ alone ({} ppm, {} mas/cy), {}\n  with",
        lambda: [closure_in_deviations()[0], *by_figure(), closure_in_deviations()[1]],
    ),
    Sentence(
        PAGE,
        "with the {} mas/cy of the analysis",
        lambda: analysis("de440"),
        slow=True,
        de440=True,
    ),
    Sentence(PAGE, "- $\\omega_A$: {} mas/cy", lambda: closures()[2], slow=True, de440=True),
    Sentence(
        PAGE,
        "than published, the planets' share in obliquity {}.",
        lambda: budget("planets", "de440", "omega_rate") + 1.40,
        slow=True,
        de440=True,
    ),
]
TOLD = [
    Told(PAGE, "has {} mas/cy of tides in obliquity, which", P03_TABLE),
    *(
        Told(PAGE, f"| {ours} | {{}} |", REN)
        for ours in ("8050.861", "1177.045", "530.749", "91.514")
    ),
    Told(PAGE, "the first order is ${}''\\cos\\epsilon_0$", "published: Capitaine et al. 2004"),
    Told(PAGE, "minus the {} mas\nof $J_2$ and planetary tilt", P03_TABLE),
    Told(PAGE, "(published as a rate, {}, that is {})", P03_TABLE),
    Told(PAGE, "Our $\\psi_A$ excludes the non-linear term, {} arcsec a century", P03_TABLE),
    Told(PAGE, "from which {} years cannot separate", "as long as the analysis; see the budget"),
    Told(PAGE, "| PREM, $I = {}\\,M R^2$ |", "published: Dziewonski & Anderson 1981"),
    Told(PAGE, "Half-widths are {} %", "what an error is, by definition"),
    Told(PAGE, "after division by\n{}, the ratio", "published: the H of Souchay et al. 1999"),
    Told(PAGE, "IERS Conventions (2010), table {}, fixed", "the name of a table"),
    Told(PAGE, "(built in: {} d, {})", "published: Mathews, Herring & Buffett 2002"),
    *(
        Told(PAGE, f"| {words} | {found} | {{}} | {{}} |", ADDITIONS_SOURCE)
        for words, found in (
            ("year, retrograde", "−85 | +100"),
            ("year, prograde", "+5 | +116"),
            ("period of the node, prograde", "−33 | +2.1"),
            ("half year, retrograde", "−0.7 | +8.6"),
        )
    ),
    Told(PAGE, "plus the published non-linear term minus {} arcsec/cy", P03_TABLE),
    Told(PAGE, "that of $\\omega_A$ is our sum minus\n{} arcsec/cy", P03_TABLE),
    Told(PAGE, "| 5,040,431.0 | {} |", P03_TABLE),
    Told(PAGE, "| +31.349 | {} | -1.34 ({}) |", P03_TABLE),
    Told(PAGE, "| +2.521 | +2.521 | {} |", P03_TABLE),
    Told(PAGE, "| -1919.841 | -1919.841 | {} |", P03_TABLE),
    Told(PAGE, "| -45.954 | -45.954 | {} |", P03_TABLE),
    Told(PAGE, "| | | {} | |\n| **closure**", P03_TABLE),
]

"""docs/nutation.md."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial

import numpy as np
import xarray as xr

import earthspin
from data_tools.core_resonance import (
    ComplexArray,
    core_mode,
    coupled_to_mantle_alone,
    in_time,
    predicted,
    quality_without_the_sea,
    strength,
    terms,
)
from earthspin import EARTH
from earthspin.interior.diurnal_ocean import WAVES, wave_response
from earthspin.interior.equilibrium import Figure, figure
from earthspin.interior.modes import mode_period, system, transfer
from earthspin.interior.prem import PREM
from earthspin.interior.published import CORE_NUTATION_QUALITY
from earthspin.nutation import ladder
from earthspin.nutation.ladder import quality as quality_of
from tests import shipped
from tests.docs.numbers.sentence import Sentence, Told

PAGE = "docs/nutation.md"


@cache
def coupled() -> xr.DataTree:
    scene = earthspin.load_scene("nutation", {"nutation.coupling": "inferred"})
    return earthspin.run_tree(scene, ["terms", "modes"])


def left(rung: str) -> list[float]:
    of = coupled().to_dataset().sel(rung=rung)
    return [float(of.rms_dpsi_sineps), float(of.rms_deps)]


def beside(model: str) -> list[float]:
    of = shipped.tree("nutation")["beside"].to_dataset().sel(model=model)
    return [float(of.model_rms_dpsi_sineps), float(of.model_rms_deps)]


def term(name: str) -> list[float]:
    of = coupled()["terms"].to_dataset().sel(rung="core-ellipticity", term=name)
    phases = ("in_phase", "out_of_phase")
    return [float(of[f"{whose}_{phase}"]) for phase in phases for whose in ("predicted", "iau")]


def left_in_time(ours: Callable[[], ComplexArray], additions: bool) -> tuple[float, float]:
    """Terms of ours less those of IAU 2000A, with what is added to it or without, rms, mas."""
    theirs = terms().iau - (0.0 if additions else terms().added)
    return in_time(ours() - theirs)


def mode(name: str, rung: str = "core-ellipticity") -> float:
    return float(coupled()["modes"].mode_period.sel(mode=f"{rung} {name}"))


def quality(name: str) -> float:
    return float(coupled()["modes"].mode_quality.sel(mode=f"core-ellipticity {name}"))


def modes(name: str) -> list[float]:
    return [mode(name, rung) for rung in ("inner-core", "core-ellipticity")]


def compliances(*names: str) -> list[float]:
    """In the power of ten of the page."""
    of = shipped.tree("nutation")["compliances"].compliance
    return [float(of.sel(compliance_name=name)) / POWERS[name] for name in names]


POWERS = {
    **dict.fromkeys(("kappa", "gamma", "beta"), 1e-3),
    **{"xi": 1e-4, "theta": 1e-6, "chi": 1e-5, "nu": 1e-5, "zeta": 1e-9, "delta": 1e-7},
}


@cache
def prem() -> Figure:
    return figure(PREM, float(EARTH.spin_rate))


@cache
def rungs() -> dict[str, ladder.Rung]:
    h = EARTH.dynamical_flattening
    setting = ladder.Setting(PREM, h / (1 - h), float(EARTH.spin_rate), 0.0453, 0.09)
    return ladder.climb(setting, coupling=True)


def flattening_of_core(rung: str) -> float:
    return 1e3 * rungs()[rung].core_ellipticity


def h_too_small() -> float:
    return 100 * (1 - prem().e / (1 + prem().e) / EARTH.dynamical_flattening)


def hydrostatic(name: str, model: str = "hydrostatic") -> float:
    s = rungs()[model].modes()[name]
    return mode_period(name, s, float(EARTH.spin_rate)) / 86400


def retrograde_year() -> float:
    predicted, observed = term("+0 -1 +0 +0 +0")[2:]
    return observed - predicted


def retrograde_node() -> tuple[np.ndarray, float, float]:
    """The term of 18.6 years: frequency in the body, (C - A)/A, and its rigid amplitude, mas."""
    h = EARTH.dynamical_flattening
    rigid = coupled()["terms"].predicted_in_phase.sel(rung="rigid", term="+0 +0 +0 +0 +1")
    return np.array([-1 - 0.99726966 / 6798.38]), h / (1 - h), float(rigid)


def one_per_cent_of_gamma() -> float:
    """Change of the retrograde term of 18.6 years, mas."""
    sigma, e, rigid = retrograde_node()
    parts = rungs()["core-ellipticity"].parts(sigma)
    answers = parts.answers.copy()
    answers[..., 1, 0] *= 1.01
    change = transfer(replace(parts, answers=answers), sigma, e) - transfer(parts, sigma, e)
    return float(abs(change[0] * rigid))


def deformation_pulled_as_a_tilt() -> list[float]:
    """Period of the inner core nutation if it were, and as it is, d."""
    parts = rungs()["inner-core"].parts(np.array(-1.0))
    p, q, _, _ = system(parts)
    pulled = q.copy()
    pulled[2, :3] += (1 - parts.a2) * parts.answers[2] / parts.inner
    found = []
    for matrix in (pulled, q):
        roots = np.linalg.eigvals(-np.linalg.solve(p, matrix)).real
        found.append(0.99726966 / (1 + roots[(roots > -1) & (roots < -0.5)][0]))
    return found


TERMS = {
    "+0 +0 +0 +0 +1": "−6798.38",
    "+0 +0 +0 +0 -1": "6798.38",
    "+0 +0 +2 -2 +2": "182.62",
    "+0 +0 +2 +0 +2": "13.66",
    "+0 -1 +0 +0 +0": "−365.26",
}

MEASURED = [
    *(Sentence(PAGE, f"| `{rung}` | {{}} / {{}} |", partial(left, rung)) for rung in ladder.RUNGS),
    Sentence(PAGE, "| `core-in-rigid-mantle` | {} / {} |", partial(beside, "core-in-rigid-mantle")),
    Sentence(PAGE, "| `hydrostatic` | {} / {} |", partial(beside, "hydrostatic")),
    *(
        Sentence(PAGE, f"\n| {period} | {{}} | {{}} | {{}} | {{}} |", partial(term, name))
        for name, period in TERMS.items()
    ),
    Sentence(PAGE, "changes the term of\n18.6 years by {} mas", one_per_cent_of_gamma),
    Sentence(PAGE, "the inner core nutation {} d instead of {} d", deformation_pulled_as_a_tilt),
    Sentence(PAGE, "figure: $H$ is {} % too small", h_too_small),
    Sentence(
        PAGE,
        "its free core nutation has a period of {} d |",
        partial(hydrostatic, "free_core_nutation", "core-in-rigid-mantle"),
    ),
    Sentence(
        PAGE,
        "in a rigid mantle it would be at {} d",
        partial(hydrostatic, "free_core_nutation", "core-in-rigid-mantle"),
    ),
    Sentence(
        PAGE,
        "a free nutation with a period\nnear {} d",
        lambda: mode("free_core_nutation", "fluid-core"),
    ),
    Sentence(
        PAGE,
        "a nutation of {} d and a wobble of {} d",
        lambda: [mode(n, "inner-core") for n in ("inner_core_nutation", "inner_core_wobble")],
    ),
    Sentence(PAGE, "A hydrostatic $H$ makes it {} d", partial(hydrostatic, "chandler_wobble")),
    Sentence(
        PAGE,
        r"give $\Delta k = {} + {}\,i$: the sign is opposite",
        lambda: [wave_response(WAVES["K1"]).real, wave_response(WAVES["K1"]).imag],
    ),
    Sentence(
        PAGE,
        r"$e_f = {}\cdot10^{-3}$, a twentieth flatter",
        partial(flattening_of_core, "core-ellipticity"),
    ),
    Sentence(
        PAGE,
        r"flattening of the core is ${}\cdot10^{-3}$; the published",
        partial(flattening_of_core, "coupling"),
    ),
    Sentence(PAGE, "retrograde year, {} mas, due to the loss", retrograde_year),
    Sentence(
        PAGE,
        "| Chandler wobble | {} | {} | {} |",
        lambda: [*modes("chandler_wobble"), quality("chandler_wobble")],
    ),
    Sentence(
        PAGE,
        "| free core nutation | {} | {} | {} |",
        lambda: [*modes("free_core_nutation"), quality("free_core_nutation")],
        (0, 0, 100),
    ),
    Sentence(
        PAGE,
        "| free inner core nutation | {} | {} | {} |",
        lambda: [*modes("inner_core_nutation"), quality("inner_core_nutation")],
        (0, 0, 1000),
    ),
    Sentence(PAGE, "| inner core wobble | {} | {} | |", partial(modes, "inner_core_wobble")),
    Sentence(
        PAGE,
        "| $e$, $e_f$, $e_s$ ($10^{-3}$) | {}, {}, {} |",
        lambda: [1e3 * v for v in (prem().e, prem().e_f, prem().e_s)],
    ),
    Sentence(
        PAGE,
        r"| $\kappa$, $\gamma$, $\beta$ ($10^{-3}$) | {}, {}, {} |",
        partial(compliances, "kappa", "gamma", "beta"),
    ),
    Sentence(PAGE, r"| $\xi$ ($10^{-4}$) | {} |", partial(compliances, "xi")),
    Sentence(
        PAGE,
        r"| $\theta$ ($10^{-6}$), $\chi$, $\nu$ ($10^{-5}$) | {}, {}, {} |",
        partial(compliances, "theta", "chi", "nu"),
    ),
    Sentence(
        PAGE,
        r"| $\zeta$ ($10^{-9}$), $\delta$ ($10^{-7}$) | {}, {} |",
        partial(compliances, "zeta", "delta"),
    ),
    Sentence(
        PAGE,
        r"| $\alpha_1$, $\alpha_2$, $\alpha_3$ | {}, {}, {} |",
        lambda: [prem().a1, prem().a2, prem().a3],
    ),
    Sentence(
        PAGE,
        "with coupling to the mantle alone, the residual is {} / {}\nmas",
        partial(left_in_time, ours=coupled_to_mantle_alone, additions=True),
    ),
    *(
        Sentence(PAGE, text, partial(left_in_time, ours=ours, additions=False))
        for text, ours in (
            ("the residual of this rung is {} / {} mas", partial(predicted, "coupling")),
            ("with coupling\nto the mantle alone {} / {}", coupled_to_mantle_alone),
            ("and of the previous rung {} / {}.", partial(predicted, "core-ellipticity")),
        )
    ),
    Sentence(
        PAGE,
        "If it were {} % larger, and shifted\nby {} % out of phase",
        lambda: [100 * strength().change.real, -100 * strength().change.imag],
    ),
    Sentence(
        PAGE,
        "of the terms would be {} mas in each angle instead of {}.",
        lambda: [strength().after, strength().before],
    ),
    Sentence(
        PAGE,
        "The free core nutation\nhas $Q$ of {}, compared with {} in that paper",
        lambda: [quality_of(core_mode("coupling")), CORE_NUTATION_QUALITY.value],
        50.0,
    ),
    Sentence(PAGE, "`ocean`, it would be {}.", quality_without_the_sea, 50.0),
]

TESTED_LAYERED = "tests/questions/test_layered.py"
PUBLISHED = "published: Mathews, Buffett, Herring & Shapiro 1991, in tests/reference/nutation.json"
MHB = "published: Mathews, Herring & Buffett 2002"
TESTED = "tests/interior/test_love.py and test_rotation.py"
TOLD = [
    Told(PAGE, "changes the term of\n{} years", "the Moon's node"),
    *(
        Told(PAGE, row, "the unit of a row")
        for row in (
            "$e_f$, $e_s$ (${}$)",
            "$\\beta$ (${}$)",
            "$\\xi$ (${}$)",
            "$\\theta$ (${}$), $\\chi$, $\\nu$ (${}$)",
            "$\\zeta$ (${}$), $\\delta$ (${}$)",
        )
    ),
    *(
        Told(PAGE, f"\n| {{}} | {rest}", "periods of the adopted arguments")
        for rest in ("−8024.895", "−1180.348", "−548.627", "−94.094", "−33.360")
    ),
    Told(PAGE, "Solid Earth {}, {})", "volume and page"),
    Told(PAGE, "lies at {} d (Mathews, Herring & Buffett 2002)", MHB),
    Told(PAGE, r"the published value is ${}\cdot10^{-3}$", MHB),
    Told(PAGE, "| {}, {}, {} | not verified |\n| $\\kappa$", PUBLISHED),
    Told(PAGE, "| {}, {}, {} | read in public code |", PUBLISHED),
    Told(PAGE, "| {} | read in public code |\n| $\\theta$", PUBLISHED),
    Told(PAGE, "| {}, {}, {} | not verified |\n| $\\zeta$", PUBLISHED),
    Told(PAGE, "| {}, {} | not verified |\n| $\\alpha_1$", PUBLISHED),
    Told(PAGE, "0.05367 | {}, {}, {} | not verified |", PUBLISHED),
    Told(PAGE, r"as required by Betti's theorem, to ${}$;", TESTED),
    Told(PAGE, r"agrees to ${}$. In the notation", TESTED),
    Told(PAGE, r"give the forced wobble to ${}$;", TESTED),
    Told(PAGE, r"system reproduce $T$ to ${}$.", TESTED),
    Told(PAGE, "between them changes no\nrung by more than {} mas", TESTED_LAYERED),
    Told(PAGE, "in equilibrium and adds {} to $k_2$", "docs/wobble.md"),
]

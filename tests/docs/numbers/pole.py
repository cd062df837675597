"""docs/pole.md."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, partial

import numpy as np

import earthspin
from earthspin.motion.effects import RIGID
from tests.docs.numbers.answers import MAS_A_CENTURY, apart, axes, iau
from tests.docs.numbers.sentence import Sentence, Told

PAGE = "docs/pole.md"


def stand(axis: str) -> list[float]:
    """Mean distance of an axis from the angular momentum, and its swing in X and Y, mas."""
    off = apart(axis, "angular_momentum")
    return [float(np.linalg.norm(off.mean(axis=0))), *off.std(axis=0)[:2]]


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


def nutation(term: str, name: str) -> float:
    return float(iau()["nutation"][name].sel(term=term))


@cache
def figure(effects: tuple[str, ...]) -> np.ndarray:
    path = earthspin.pole("1980-01-01", "2020-01-01", "0.37 d", effects=effects).sel(axis="figure")
    return np.stack([path.X.values, path.Y.values], axis=-1) / np.pi * 180 * 3.6e6


def periodic(effect: str) -> list[float]:
    """Rms in X and Y of what an effect does, less a quadratic polynomial, mas."""
    off = figure(RIGID) - figure(tuple(e for e in RIGID if e != effect))
    t = np.linspace(-1, 1, len(off))
    rest = off - np.polynomial.polynomial.polyval(t, np.polynomial.polynomial.polyfit(t, off, 2)).T
    return [float(v) for v in rest.std(axis=0)]


def input_error() -> float:
    path = earthspin.pole(times=["2020-01-01T12:00"], effects=["second-order"])
    return float(path.direction_error_input.max()) / 1e3


def kernels_apart() -> float:
    """DE421 less DE440, periodic part of the figure axis, largest of X and Y, mas."""
    one, other = axes()["figure"], axes(ephemeris="de440")["figure"]
    return float(np.abs(one - other).max())


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


LEADING = {
    "+0 +0 +0 +0 +1": "-6798.38",
    "+0 +0 +0 +0 -1": "+6798.38",
    "+0 +0 +2 -2 +2": "182.62",
    "+0 +0 +2 +0 +2": "13.66",
}
#: H of ours over that of REN-2000.
FLATTENINGS = 1.00001225


def leading(term: str) -> float:
    """Amplitude of a rigid term by DE440, less its neighbour's share, mas."""
    of = iau("de440")["nutation"].to_dataset().sel(term=term)
    amplitude = complex(of.rigid_in_phase, of.rigid_out_of_phase)
    neighbour = complex(of.neighbour_in_phase, of.neighbour_out_of_phase)
    response = complex(of.transfer_in_phase, of.transfer_out_of_phase)
    return abs(amplitude - neighbour / response) / FLATTENINGS


def closures() -> list[float]:
    both = [float(iau(kernel).closure) for kernel in ("de440", "de421")]
    return [MAS_A_CENTURY * v for v in (*both, float(iau("de440").omega_closure))]


MEASURED = [
    Sentence(
        PAGE,
        "It stands {} mas from the angular momentum on average and swings about that by {} and {}"
        " mas rms",
        partial(stand, "figure"),
    ),
    Sentence(
        PAGE,
        "{} mas from the angular momentum on average and swings by {} and {} mas rms.",
        partial(stand, "rotation"),
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
            ("nonrigid", "the same, with the non-rigid response"),
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
        "The fit recovers a **free core nutation of {} d**",
        lambda: float(iau()["core"].core_nutation_period),
    ),
    Sentence(
        PAGE,
        "Q\nof {} (built in",
        lambda: float(iau()["core"].core_nutation_quality),
        50.0,
    ),
    Sentence(
        PAGE,
        "its residual of {} uas is the Sun-synchronous",
        lambda: float(iau()["core"].response_maximum),
    ),
    Sentence(
        PAGE,
        "The next largest residual is {} uas, out of phase, in the",
        lambda: -nutation("+0 +0 +0 +0 -1", "left_in_phase"),
    ),
    Sentence(
        PAGE,
        "`direction_error_input` is what the uncertainty of $H$ adds, {} mas after",
        input_error,
    ),
    Sentence(PAGE, "observed moment among its data); it is {} % off", prem_off),
    Sentence(
        PAGE,
        "- The second order is {} mas/cy smaller than published",
        lambda: budget("second-order") + 46.78,
    ),
    Sentence(
        PAGE,
        "free core nutation is {} d too short, and {} uas of the prograde",
        lambda: [
            float(iau()["core"].core_nutation_period) + 430.21,
            -nutation("+0 +0 +0 +0 -1", "left_in_phase"),
        ],
    ),
    Sentence(PAGE, "With the response, {} mas rms remain", lambda: residual("nonrigid")[0]),
    *(
        Sentence(PAGE, f"\n| {period} | {{}} | ", partial(leading, term), slow=True, de440=True)
        for term, period in LEADING.items()
    ),
    *(
        Sentence(PAGE, text, partial(periodic, effect), slow=True)
        for effect, text in (
            ("planets", "planets {} / {},\nJ3"),
            ("j3", "J3 {} / {}, J4"),
            ("j4", "J4 {} / {}, geodesic"),
            ("geodesic", "geodesic {} / {}, triaxiality"),
            ("triaxiality", "triaxiality {} / {} (amplitude"),
            ("j2-rate", "J2 rate {} / {}. DE421 differs"),
        )
    ),
    Sentence(
        PAGE, "DE421 differs from DE440 by {} mas at most", kernels_apart, slow=True, de440=True
    ),
]

BENCH = "run times: python tests/benchmarks/pole.py"
P03_TABLE = "published: Capitaine, Wallace & Chapront 2003, table 3"
REN = "published: Souchay et al. 1999"
TOLD = [
    *(
        Told(PAGE, f"| {ours} | {{}} |", REN)
        for ours in ("8050.861", "1177.045", "530.749", "91.514")
    ),
    Told(PAGE, "the first order is ${}''\\cos\\epsilon_0$", "published: Capitaine et al. 2004"),
    Told(PAGE, "minus the {} mas\nof $J_2$ and planetary tilt", P03_TABLE),
    Told(PAGE, "(published as a rate, {}, that is {})", P03_TABLE),
    Told(PAGE, "Our $\\psi_A$ lacks the non-linear term, {} arcsec a century", P03_TABLE),
    Told(
        PAGE,
        "the run time grows linearly: {}, {} and {} ms a year\nover 10, 20 and 40 years",
        BENCH,
    ),
    Told(PAGE, "| default, 12 nodes | {} | {} ms |", BENCH),
    Told(PAGE, "| default, 14 nodes | {} | {} ms |", BENCH),
    Told(PAGE, "| scipy DOP853 on the same equations, rtol 1e-9 | {} | {} s |", BENCH),
    Told(PAGE, "| the same, rtol 5e-10 | {} | {} s |", BENCH),
    Told(PAGE, "a compiled DOP853 would still need {} s for the thirty years.", BENCH),
    Told(PAGE, "planets and all effects, take {} s", BENCH),
    Told(PAGE, "(built in: {} d, {})", "published: Mathews, Herring & Buffett 2002"),
    Told(PAGE, "plus the published non-linear term minus {} arcsec/cy", P03_TABLE),
    Told(PAGE, "that of $\\omega_A$ is our sum minus\n{} arcsec/cy", P03_TABLE),
    Told(PAGE, "| 5,040,431.0 | {} |", P03_TABLE),
    Told(PAGE, "| +31.349 | {} | -1.34 ({}) |", P03_TABLE),
    Told(PAGE, "| +2.521 | +2.521 | {} |", P03_TABLE),
    Told(PAGE, "| -1919.841 | -1919.841 | {} |", P03_TABLE),
    Told(PAGE, "| -45.954 | -45.954 | {} |", P03_TABLE),
    Told(PAGE, "| | | {} | |\n| **closure**", P03_TABLE),
]

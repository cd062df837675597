"""docs/pole.md."""

from __future__ import annotations

import re
from functools import cache, partial

import numpy as np
import pytest

import earthspin
from earthspin import EARTH
from earthspin.constants import ARCSEC, DAY, JULIAN_YEAR, PUBLISHED_EFFECTS
from earthspin.motion.axes import ORDER, WINDOW
from earthspin.motion.effects import EFFECTS, RIGID
from earthspin.motion.segment import LARGEST_MANIFOLD_ERROR
from earthspin.parts.path import SHORTEST_SPAN
from earthspin.sky.ephemeris import open_ephemeris
from tests.benchmarks.pole import Thirty
from tests.docs.numbers.answers import (
    apart,
    at_j2000_with_response,
    axes,
    from_the_iau,
    input_error_of_the_pole,
    kernel_of_the_pole,
)
from tests.docs.numbers.sentence import Column, Sentence, Told
from tests.motion.solvers import Solvers

PAGE = "docs/pole.md"


def stand(axis: str) -> list[float]:
    """Mean distance of an axis from the angular momentum, and its swing in X and Y, mas."""
    off = apart(axis, "angular_momentum")
    return [float(np.linalg.norm(off.mean(axis=0))), *off.std(axis=0)[:2]]


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


def triaxial_at_most() -> float:
    """Largest motion of the figure axis by B - A, mas."""
    off = figure(RIGID) - figure(tuple(e for e in RIGID if e != "triaxiality"))
    return float(np.hypot(*off.T).max())


def displaced() -> list[float]:
    """Response of the interior at J2000.0 in X and Y, mas: rigid start at the true pole."""
    times = ["2000-01-01T12:00"]
    true, mean = (
        earthspin.pole(times=times, effects=effects).sel(axis="angular_momentum")
        for effects in (RIGID, tuple(EFFECTS))
    )
    return [float((true[name] - mean[name]).item()) / ARCSEC * 1e3 for name in "XY"]


@cache
def solvers(years: int) -> Solvers:
    return Solvers(open_ephemeris("de421"), years * JULIAN_YEAR)


@cache
def thirty() -> Thirty:
    return Thirty()


def windows_of(order: int) -> float:
    """Error over thirty years on windows of 8 days, uas."""
    return thirty().error(thirty().picard(WINDOW / DAY, order))


@cache
def by_dop853(rtol: float) -> tuple[float, int]:
    """Error over thirty years, uas, and how often the sky was asked."""
    found, calls = thirty().dop853(rtol)
    return thirty().error(found), calls


def method_error() -> float:
    """Of thirty years of the figure axis, uas."""
    path = earthspin.pole("1985-01-01", "2015-01-01", "30 d", effects=["second-order"])
    return float(path.direction_error_method.max()) * 1e6


def slow_spin(days: float) -> float:
    """Last term of the slow manifold of the Earth with a longer day, mas, as the refusal has it."""
    slow = EARTH.replace(spin_period=f"{days} d")
    with pytest.raises(earthspin.UndefinedError, match="slow manifold") as refused:
        earthspin.pole("2000-01-01", "2010-01-01", "30 d", body=slow, effects=["second-order"])
    (last,) = re.findall(r"off by ([\d.e-]+) mas", str(refused.value))
    return float(last)


def kernels_apart() -> float:
    """DE421 less DE440, periodic part of the figure axis, largest of X and Y, mas."""
    one, other = axes()["figure"], axes(ephemeris="de440")["figure"]
    return float(np.abs(one - other).max())


BENCH = "run times: python tests/benchmarks/pole.py"


GIVEN = "given: a setting of what is compared"


MEASURED = [
    Sentence(PAGE, "from that of a rigid one by {} and {} mas (X and Y)", displaced),
    Sentence(
        PAGE,
        "departs from the pole of the\n  IAU by up to {} mas between",
        lambda: float(from_the_iau(*RIGID)[0].max()),
    ),
    Sentence(
        PAGE,
        "rate of precession, {} mas a century in longitude",
        lambda: PUBLISHED_EFFECTS["nonrigid"].value * 1e5,
    ),
    Sentence(
        PAGE,
        "agrees with `erfa.pnm06a` to {} mas at J2000.0 and to {} mas",
        lambda: [at_j2000_with_response(), float(from_the_iau(*EFFECTS)[0].max())],
    ),
    Sentence(
        PAGE,
        "contains the difference from\n  IAU 2006/2000A at {} % of dates or more",
        lambda: 95.0,
    ),
    Sentence(
        PAGE, "An ephemeris of at least {} years near", lambda: SHORTEST_SPAN * DAY / JULIAN_YEAR
    ),
    Sentence(
        PAGE,
        "This figure axis is {} mas from the angular momentum on average and\nvaries by {} and {}"
        " mas rms",
        partial(stand, "figure"),
    ),
    Sentence(
        PAGE,
        "the rotation axis is {} mas from the angular momentum on average and varies by {} and\n"
        "{} mas rms.",
        partial(stand, "rotation"),
    ),
    Sentence(
        PAGE,
        "`direction_error_input` is due to the uncertainty of $H$, {} mas after",
        input_error_of_the_pole,
    ),
    *(
        Sentence(PAGE, text, partial(periodic, effect), slow=True)
        for effect, text in (
            ("planets", "planets {} / {},\nJ3"),
            ("j3", "J3 {} / {}, J4"),
            ("j4", "J4 {} / {}, geodesic"),
            ("geodesic", "geodesic {} / {}, triaxiality"),
            ("triaxiality", "triaxiality {} / {} (0.041"),
            ("j2-rate", "J2 rate {} / {}. DE421 differs"),
        )
    ),
    Sentence(
        PAGE, "DE421 differs from DE440 by {} mas at most", kernels_apart, slow=True, de440=True
    ),
    Sentence(PAGE, "0.014 / 0.014 ({}\nat most)", triaxial_at_most, slow=True),
    Sentence(
        PAGE, "windows of {} days with {} Gauss-Legendre nodes", lambda: [WINDOW / DAY, ORDER]
    ),
    Sentence(
        PAGE,
        "| default and $(L, F)$, figure axis, 14 years | {} |",
        lambda: solvers(14).windows_and_momentum()[0],
        factor=2.0,
        slow=True,
    ),
    Sentence(
        PAGE,
        "| $(L, F)$ and attitude, one year | {} |",
        lambda: solvers(1).momentum_and_attitude(),
        factor=2.0,
        slow=True,
    ),
    Sentence(
        PAGE,
        "| default and attitude of the triaxial Earth, one year | {} |",
        lambda: solvers(1).windows_and_attitude(),
        factor=2.0,
        slow=True,
    ),
    Sentence(
        PAGE,
        "over 30 years, the error of 14 nodes is {} uas, that of 12 nodes {}.",
        lambda: [windows_of(order) for order in (14, 12)],
        slow=True,
    ),
    *(
        Sentence(PAGE, f"| default, {order} nodes | {{}} |", partial(windows_of, order), slow=True)
        for order in (12, 14)
    ),
    Sentence(PAGE, "tail of the Legendre series ({} uas)", method_error),
    Sentence(PAGE, "possible error of the kernel, {} to {} uas", kernel_of_the_pole),
    *(
        Sentence(PAGE, text, lambda rtol=rtol: by_dop853(rtol)[0], factor=1.2, slow=True)
        for rtol, text in (
            (1e-9, "on the same equations, rtol 1e-9 | {} |"),
            (5e-10, "| the same, rtol 5e-10 | {} |"),
        )
    ),
    Sentence(PAGE, "after another, {} times;", lambda: by_dop853(5e-10)[1], 500.0, slow=True),
    Sentence(
        PAGE,
        "{} uas for the Earth with a spin period of two days, {} mas\n"
        "  with three, {} mas with five",
        lambda: [1e3 * slow_spin(2), slow_spin(3), slow_spin(5)],
    ),
    Sentence(
        PAGE,
        "for which it exceeds {} uas is refused",
        lambda: LARGEST_MANIFOLD_ERROR / ARCSEC * 1e6,
    ),
]
TOLD = [
    Told(
        PAGE,
        "the run time grows linearly: {}, {} and {} ms a year\nover 10, 20 and {} years",
        BENCH,
    ),
    Column(PAGE, "| method | error, uas | time |", "time", BENCH),
    Told(PAGE, "on the same equations, rtol {} |", GIVEN),
    Told(PAGE, "| the same, rtol {} |", GIVEN),
    Told(PAGE, "Against windows of {} days with 16 nodes over {} years", GIVEN),
    Told(PAGE, "figure axis, {} years |", GIVEN),
    Told(PAGE, "All {} years of\nDE440", "what the kernel covers, 1550 to 2650"),
    Told(PAGE, "**H = {}**, the thin disc", "by definition: C = 2 A"),
    Told(PAGE, "a compiled DOP853 would still need {} s for the thirty years.", BENCH),
    Told(
        PAGE,
        "planets and all effects, take {} s of processor time, and {} s under Sun and Moon alone",
        BENCH,
    ),
    Told(PAGE, "DE440 at steps of {} d, planets", GIVEN),
]

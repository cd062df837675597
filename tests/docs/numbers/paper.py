"""docs/paper/paper.md."""

from __future__ import annotations

import earthspin
from tests import shipped
from tests.docs.numbers.sentence import Sentence, Told

PAGE = "docs/paper/paper.md"


def periods() -> list[float]:
    """Period by Sun and Moon with its half-width, years."""
    total = shipped.answer("precession").sel(perturber="total")
    return [float(total.precession_period), float(total.precession_period_error)]


def by_sun() -> float:
    """Period by the Sun alone, years."""
    return float(shipped.answer("precession").precession_period.sel(perturber="sun"))


def forecasts(name: str) -> list[float]:
    """Mean absolute error of x and y 90 days ahead, mas."""
    skill = earthspin.run_tree("forecast", sections=["skill"])["skill"].to_dataset()
    return skill[name].sel(case="C04 2014-2025, 90 d").values.tolist()


MEASURED = [
    Sentence(PAGE, "a period of precession of {} ± {} years", periods),
    Sentence(PAGE, "the Sun alone would take {} years", by_sun),
    Sentence(PAGE, "{} mas in $x$ and {} mas in $y$", lambda: forecasts("mean_absolute_error")),
    Sentence(
        PAGE, "against {} and {} mas of least", lambda: forecasts("other_mean_absolute_error")
    ),
]
TOLD = [
    Told(PAGE, "half-width of its {} % interval", "given: the claim"),
    Told(PAGE, "polar motion {} days ahead", "given: the horizon of the comparison"),
]

"""The tutorial from a brick to Saturn: it runs, and each number is found twice or published."""

import pytest

from tests.docs.lessons import DOCS, NUMBER, hold, results_of

NAME = "brick_to_saturn"

#: What is printed twice, and how near: moments alone leave out the square of size over distance;
#: published rates are held in tests/test_worlds.py.
PRINTED = [
    (rf"by hand {NUMBER}, library {NUMBER} kg m2", 1e-12),
    (rf"by hand {NUMBER}°, library {NUMBER}°", 1e-12),
    (rf"growth by hand {NUMBER}, library {NUMBER} 1/s", 3e-5),
    (rf"of the grid {NUMBER}, of the mesh {NUMBER}", 1e-11),
    (rf"summed {NUMBER} N m, by the moments {NUMBER} N m", 2e-3),
    (rf"flattening 1/{NUMBER}, of the Earth 1/{NUMBER}", 6e-3),
    (rf"J2 {NUMBER}, of the Earth {NUMBER}", 1.2e-2),
    (rf"exact {NUMBER} N m, by the moments {NUMBER} N m", 1e-4),
    (rf"by hand {NUMBER}, library {NUMBER} arcsec a year", 1e-9),
    (rf"rate {NUMBER} ± [\d.]+, published {NUMBER} ", 4.5e-2),
]
#: What is printed once, and what it is to be.
ONCE = [
    # upside down after half a turn about the long axis
    (rf"later the spin is reversed: {NUMBER}", -1.0, 1e-5),
    # Iess et al. 2019, Science 364, eaat2965, as `earthspin.bodies.giants` cites it
    (rf"J2 of the planet alone {NUMBER}", 16290.57e-6, 5e-5),
    # q of Titan from its published GM, distance and Saturn's: 8978.14, 1221865, 37940585, 60330
    (rf"Titan +adds {NUMBER} of it", 2.979, 2e-4),
]


@pytest.fixture(scope="module")
def result() -> dict[str, str]:
    return results_of([DOCS / "tutorials" / f"{NAME}.md"])[NAME]


def test_it_runs_and_draws(result: dict[str, str]) -> None:
    assert result["faults"] == []


@pytest.mark.parametrize(("words", "nearness"), PRINTED)
def test_what_it_prints_twice_agrees(result: dict[str, str], words: str, nearness: float) -> None:
    hold(result["printed"], words, nearness)


@pytest.mark.parametrize(("words", "value", "nearness"), ONCE)
def test_what_it_prints_once(
    result: dict[str, str], words: str, value: float, nearness: float
) -> None:
    hold(result["printed"] + f"\n{value!r}", rf"{words}(?s:.*)\n{NUMBER}$", nearness)

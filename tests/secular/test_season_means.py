"""Averages of insolation: values of a quadrature of 30 digits, and days counted one by one."""

from typing import Any

import numpy as np
import pytest

from earthspin.secular.caloric import (
    caloric_half_years,
    crossings,
    integral_above,
    share_above,
)
from earthspin.secular.insolation import Band, Season, daily, true_longitude
from earthspin.secular.insolation_errors import of_abrupt
from earthspin.secular.insolation_extremes import extremes, yearly_range
from earthspin.secular.season_means import over_interval, over_window, over_year, pace

DEGREE = np.pi / 180


def season(obliquity: float, e: float, perihelion: float) -> Season:
    return Season(np.array([obliquity * DEGREE]), np.array([e]), np.array([perihelion * DEGREE]))


def at(*degrees: float) -> Any:
    angles = [np.array([angle * DEGREE]) for angle in degrees]
    return angles[0] if len(angles) == 1 else angles


TODAY, EDGE = season(23.4393, 0.0167, 102.95), season(24.5, 0.05, 300)
WILD, TILTED, MARS = season(60, 0.4, 45), season(120, 0.2, 200), season(25.19, 0.0934, 251)
NIGHT = 30 / 365.2422
LEVEL = np.array([275 / 1361])
ABOVE = crossings(TODAY, at(65), LEVEL, extremes(TODAY, at(65)))

#: Fractions of the solar constant: computed by mpmath from the definition, with 30 digits, where a
#: closed form or a quadrature between the edges of the night allows it, by other code otherwise.
HELD = {
    "day": (daily(TODAY, at(65), at(90)), 0.351169057014934),
    "spring": (over_interval(TODAY, at(65), *at(0, 90)), 0.267535534924769),
    "half a year at the pole": (over_interval(TODAY, at(90), *at(0, 180)), 0.248126649959574),
    "month at the pole": (over_window(TODAY, at(90), at(0), NIGHT), 0.0257067714296328),
    "year at the pole": (over_year(TODAY, at(90)), 0.126634106263268),
    "year at the polar circle": (over_year(TODAY, at(66.5607)), 0.152442480242591),
    "year at the equator": (over_year(TODAY, at(0)), 0.305360633807509),
    "caloric summer": (caloric_half_years(TODAY, at(65)).summer, 0.268926590196700),
    "caloric winter": (caloric_half_years(TODAY, at(65)).winter, 0.0450807820687463),
    "caloric level": (caloric_half_years(TODAY, at(65)).level, 0.140346195927116),
    "two maxima": (caloric_half_years(TODAY, at(0)).summer, 0.315058571916441),
    "long polar night": (caloric_half_years(TODAY, at(-90)).summer, 0.253268212526536),
    "share above": (share_above(TODAY, ABOVE), 0.392730243875761),
    "integral above": (integral_above(TODAY, at(65), ABOVE), 0.116119011158651),
    "largest": (yearly_range(TODAY, at(0)).largest, 0.321889389639240),
    "smallest": (yearly_range(TODAY, at(0)).smallest, 0.282735453463375),
    "band": (daily(TODAY, Band(*at(60, 90)), at(90)), 0.362129078702424),
    "band and half a year": (
        over_interval(TODAY, Band(*at(0, 90)), *at(0, 180)),
        0.306990608130535,
    ),
    "length of spring": (pace(TODAY, *at(0, 90)) / 4, 0.253959873797673),
    "over the equinox": (over_interval(EDGE, at(-80), *at(350, 370)), 0.0542625852002431),
    "caloric at 10 N": (caloric_half_years(EDGE, at(10)).summer, 0.341603885210378),
    "over perihelion": (over_interval(WILD, at(40), *at(200, 300)), 0.0603805245006093),
    "caloric of a tilted planet": (caloric_half_years(WILD, at(20)).summer, 0.353966063117724),
    "year of a retrograde planet": (over_year(TILTED, at(-50)), 0.261449699538319),
    "its largest": (yearly_range(TILTED, at(5)).largest, 0.498092150154144),
    "its smallest": (yearly_range(TILTED, at(5)).smallest, 0.113221339615067),
    "caloric winter of Mars": (caloric_half_years(MARS, at(-80)).winter, 0.0141685315151687),
}  # fmt: skip


@pytest.mark.parametrize("name", HELD)
def test_values_of_thirty_digits(name: str) -> None:
    found, value = HELD[name]
    close = 1e-14 if "band" in name else 2e-15
    assert found.item() == pytest.approx(value, rel=0, abs=close)


def test_longitudes_of_extremes() -> None:
    ends = yearly_range(TODAY, at(0))
    found = [ends.longitude_of_largest.item(), ends.longitude_of_smallest.item()]
    assert np.degrees(found) == pytest.approx([348.82069177, 91.97291221], rel=0, abs=6e-9)
    assert ends.count == 4


@pytest.mark.parametrize("of", [TODAY, EDGE, WILD, TILTED, MARS], ids=str)
@pytest.mark.parametrize("latitude", [-90.0, -70.0, -35.2, -5.0, 0.0, 12.0, 65.0, 88.0])
def test_half_years_and_thresholds_by_days(of: Season, latitude: float) -> None:
    """Values at 200,000 instants, sorted, are the caloric half-years by definition.

    The year is also their mean, and the time above a level the number of those above it.
    """
    mean = 2 * np.pi * (np.arange(200_000) + 0.5) / 200_000
    every = daily(of, at(latitude), true_longitude(of, mean))
    ranked = np.sort(every)
    halves = caloric_half_years(of, at(latitude))
    assert halves.summer.item() == pytest.approx(ranked[100_000:].mean(), rel=0, abs=2e-10)
    assert halves.winter.item() == pytest.approx(ranked[:100_000].mean(), rel=0, abs=2e-10)
    assert halves.level.item() == pytest.approx(ranked[99_999:100_001].mean(), rel=0, abs=1e-5)
    level = np.array([0.2])
    turning = extremes(of, at(latitude))
    found = crossings(of, at(latitude), level, turning)
    assert share_above(of, found).item() == pytest.approx((every > 0.2).mean(), rel=0, abs=2e-5)
    summer = np.where(every > 0.2, every, 0).mean()
    assert integral_above(of, at(latitude), found).item() == pytest.approx(summer, rel=0, abs=1e-5)
    ends = yearly_range(of, at(latitude))
    assert ends.largest.item() == pytest.approx(ranked[-1], rel=0, abs=1e-8)
    assert ends.smallest.item() == pytest.approx(ranked[0], rel=0, abs=1e-8)


def test_no_extreme_is_missed() -> None:
    """As many as changes of sign between 7,200 points, edges of the polar night apart."""
    random = np.random.default_rng(4)
    of = Season(*random.uniform([0.2, 0, 0], [2.9, 0.4, 6.3], (300, 3)).T)
    latitude = random.uniform(-1.5, 1.5, 300)
    column = Season(*(element[:, np.newaxis] for element in of))
    points = np.linspace(0, 2 * np.pi, 7201)
    values = daily(column, latitude[:, np.newaxis], points)
    steps = np.diff(values, axis=1)
    signs = [np.sign(row[np.abs(row) > 1e-15]) for row in steps]  # 0 in the polar night
    count = [np.count_nonzero(row != np.roll(row, 1)) for row in signs]
    assert np.array_equal(yearly_range(of, latitude).count, count)


def test_a_pair_of_extremes_within_three_minutes_of_arc() -> None:
    of = season(101.7863, 0.334842, 210.7939)
    found = extremes(of, at(-35.2144)) / DEGREE
    assert np.abs(found[..., np.newaxis] - [303.3857, 303.4262]).min(axis=1).max() < 1e-3


@pytest.mark.parametrize("e", [0.0, 0.4])
def test_where_nothing_varies(e: float) -> None:
    of = season(0.0, e, 0.0)
    halves, ends = caloric_half_years(of, at(30)), yearly_range(of, at(30))
    year = np.cos(30 * DEGREE) / np.pi / np.sqrt(1 - e * e)
    assert (halves.summer + halves.winter).item() / 2 == pytest.approx(year, rel=1e-15, abs=0)
    if e == 0:
        assert halves.summer.item() == pytest.approx(year, rel=1e-15, abs=0)
        assert ends.count == 0
        assert np.isnan(ends.longitude_of_largest)


def test_the_globe_gets_a_quarter() -> None:
    for of in (TODAY, EDGE, WILD, TILTED, MARS):
        globe, e = Band(*at(-90, 90)), of.eccentricity.item()
        quarter = 0.25 / np.sqrt(1 - e * e)
        assert over_year(of, globe).item() == pytest.approx(quarter, rel=1e-15, abs=0)
        first, last = at(40, 161)
        share = pace(of, first, last) * (last - first) / (2 * np.pi)
        between = (last - first) / (2 * np.pi) * quarter / share  # (a/r)^2 dt goes with dL
        assert over_interval(of, globe, first, last) == pytest.approx(between, rel=1e-14, abs=0)


def test_seasons_of_2000() -> None:
    """92.757, 93.648, 89.843 and 88.994 d for e = 0.0167 and perihelion at 102.94 degrees."""
    of, starts = season(23.4393, 0.0167, 102.94), np.arange(4) * np.pi / 2
    days = 365.2422 * pace(of, starts, starts + np.pi / 2) / 4
    assert days == pytest.approx([92.757, 93.648, 89.843, 88.994], rel=0, abs=6e-4)


@pytest.mark.parametrize(
    ("latitude", "perihelion", "level"),
    [
        (0.0, 90.0, None),
        (0.0, 92.0, None),
        (40.0, 100.0, None),
        (65.0, 100.0, 0.2),
        (65.0, 100.0, 1),
    ],
)
def test_half_widths_hold_draws_where_maxima_swap_or_touch_a_level(
    latitude: float, perihelion: float, level: float | None
) -> None:
    """93 to 97 % of 20,000 draws; linear propagation holds 43 % where two maxima swap.

    A level of 1 stands for that of the largest value, which half of the draws do not reach.
    """
    of, place = season(23.4, 0.02, perihelion), at(latitude)
    if level == 1:
        level = yearly_range(of, place).largest.item() - 1e-6

    def quantity(inputs: Any) -> dict[str, Any]:
        orbit = Season(*(inputs[name] for name in Season._fields))
        place = inputs["latitude"]
        if level is None:
            return {"value": yearly_range(orbit, place).largest}
        threshold = np.full(place.size, level)
        return {
            "value": share_above(orbit, crossings(orbit, place, threshold, extremes(orbit, place)))
        }

    half_widths = {
        "obliquity": np.array([0.02 * DEGREE]),
        "eccentricity": np.array([0.001]),
        "perihelion": np.array([0.1]),
        "latitude": np.zeros(1),
    }
    inputs = {**of._asdict(), "latitude": place}
    value, error = of_abrupt(quantity, inputs, half_widths)["value"]
    random = np.random.default_rng(8).standard_normal((4, 20_000)) / 1.959964
    drawn = {name: inputs[name] + half_widths[name] * random[n] for n, name in enumerate(inputs)}
    inside = np.abs(quantity(drawn)["value"] - value) <= error
    assert 0.93 <= inside.mean() <= 0.97

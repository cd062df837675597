"""What effects that are left out would move: the table, against the paths with and without."""

from functools import lru_cache

import numpy as np
import pytest

import earthspin
from earthspin.constants import MAS
from earthspin.motion.effects import EFFECTS, MEASURED, RIGID

SPAN = ("1901-01-01", "2050-01-01", "17.3 d")


@lru_cache
def figure_axis(effects: tuple[str, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Days from J2000.0, and the figure axis."""
    path = earthspin.pole(*SPAN, effects=effects).sel(axis="figure")
    days = (path.time.values - np.datetime64("2000-01-01T12:00")) / np.timedelta64(1, "D")
    return days, np.stack([path.X, path.Y, path.Z], axis=-1)


def moved(effect: str) -> tuple[np.ndarray, np.ndarray]:
    """Days from J2000.0, and how far an effect moves the figure axis, rad."""
    days, whole = figure_axis(RIGID)
    others = tuple(e for e in RIGID if e != effect)
    if effect == "nonrigid":
        others = (*RIGID, effect)
    return days, np.linalg.norm(whole - figure_axis(others)[1], axis=1)


@pytest.mark.parametrize("effect", EFFECTS)
def test_no_effect_is_larger_than_the_table_says(effect: str) -> None:
    days, off = moved(effect)
    if effect == "nonrigid":  # the response is known for our time
        near = days > -18263
        days, off = days[near], off[near]
    bound = np.array([EFFECTS[effect].size_at(abs(day)) for day in days])
    assert np.all(off <= bound)


@pytest.mark.parametrize("effect", EFFECTS)
def test_no_effect_is_much_smaller_than_the_table_says(effect: str) -> None:
    days, off = moved(effect)
    largest = EFFECTS[effect].size_at(float(np.abs(days).max()))
    assert off.max() >= largest / 1.3
    assert largest >= 1e-3 * MAS


def test_the_table_reaches_as_far_as_it_was_measured() -> None:
    days, _ = figure_axis(RIGID)
    assert np.abs(days).max() == pytest.approx(MEASURED, abs=20)


def test_sizes_grow_with_the_time() -> None:
    for effect in EFFECTS:
        near, far, farther = (EFFECTS[effect].size_at(day) for day in (0.0, 18262.5, 36525.0))
        assert 0 < near <= far <= farther
        if effect == "j2-rate":
            assert farther - near == pytest.approx(4 * (far - near), rel=1e-12, abs=0)
        else:
            assert farther - near == pytest.approx(2 * (far - near), rel=1e-12, abs=0)


def test_a_path_says_what_it_leaves_out() -> None:
    scene = earthspin.Scene(
        compute="pole",
        span=("1990-01-01T12:00", "2000-01-01T12:00"),
        step="400 d",
        effects=("planets", "second-order"),
    )
    tree = earthspin.run_tree(scene)
    told = tree["neglected"].neglected_effect
    assert set(told.effect.values) == set(EFFECTS) - {"planets", "second-order"}
    for effect in told.effect.values:
        size = EFFECTS[str(effect)].size_at(3652.0) / MAS
        assert float(told.sel(effect=effect)) == pytest.approx(size, rel=1e-12, abs=0)
    assert tree.attrs["neglected"].startswith("nonrigid: 85.6 mas")

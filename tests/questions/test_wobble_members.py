"""Numbers of the interior as inputs of an ensemble of free wobbles."""

import pytest

import earthspin
from earthspin import EARTH

DRY = {"ocean": "none", "ocean_love_number": 0.05}


def test_the_spread_of_drawn_earths_is_the_claimed_half_width() -> None:
    """The claim comes from parabolas in each input; here each Earth is computed in full."""
    last = earthspin.wobble_ladder().sel(rung="anelastic")
    periods = earthspin.ensemble("wobble", 4000).period_solar.sel(rung="anelastic")
    inside = abs(periods - last.period_solar) < last.period_solar_error
    # half of the central 95 % would hold 84 %: the exponent is not in the middle of its range
    assert float(inside.mean()) == pytest.approx(0.95, rel=0, abs=0.01)


def test_a_member_is_the_answer_with_its_number() -> None:
    values = {"k2": 0.3, "core_fraction": 0.12, "core_ellipticity": 0.0027,
              "ocean_love_number": 0.05, "anelastic_exponent": 0.15}  # fmt: skip
    for name, value in values.items():
        members = earthspin.ensemble("wobble", {name: {"grid": [value / 2, value]}})
        alone = earthspin.wobble_ladder(**{name: value})
        for rung in ("elastic", "fluid-core", "anelastic"):
            difference = members.period_solar.sel(rung=rung)[1] - alone.period_solar.sel(rung=rung)
            assert abs(float(difference)) < 1e-9, (name, rung)


def test_the_half_width_of_each_input_is_its_share_of_the_error() -> None:
    """The section `sensitivity` has the published half-widths; each is drawn alone here."""
    tree = earthspin.run_tree("wobble", sections="sensitivity")
    shares = tree["sensitivity"].days_from_input
    drawn = earthspin.load_scene("wobble").published_inputs()
    for name, field in (
        ("k2", "k2"),
        ("core_fraction", "core_fraction"),
        ("ocean_love_number", "ocean"),
    ):
        shape, numbers = drawn[name]
        members = earthspin.ensemble("wobble", {"n": 2000, name: {shape: list(numbers)}})
        spread = 1.96 * float(members.period_solar.sel(rung="anelastic").std())
        assert spread == pytest.approx(float(shares.sel(input=field)), rel=0.06, abs=0), name


@pytest.mark.parametrize(
    ("changes", "word"),
    [
        (DRY, "no ocean"),
        ({"body": EARTH.replace(interior="none"), "k2": 0.3}, "rigid"),
        ({"k2": -0.1}, "k2"),
        ({"k2": float("nan")}, "k2"),
    ],
)
def test_numbers_that_no_model_uses_are_refused(changes: dict[str, object], word: str) -> None:
    with pytest.raises(earthspin.EarthspinError, match=word) as refusal:
        earthspin.wobble_ladder(**changes)
    assert "\n" not in str(refusal.value)

"""How far causes move what is read off."""

import numpy as np
import pytest

from earthspin.secular.derived_angles import AnglesWithErrors, DerivedAngles

TURN, NOTHING = 2 * np.pi, np.zeros((3, 1))


def read(perihelion: float, general: float) -> DerivedAngles:
    values = {"longitude_of_perihelion": perihelion, "general_precession": general}
    return DerivedAngles({name: np.array([of]) for name, of in values.items()}, NOTHING, NOTHING)


def test_whole_turns_of_a_perihelion_are_no_error_and_those_of_the_axis_are() -> None:
    """An orbit that is all but round may pass a circle on the other side."""
    of = AnglesWithErrors(
        read(1.0, 5.0),
        (
            ("orbit", read(1.01 - TURN, 5.0)),
            ("axis", read(1.0 + TURN, 5.0 + TURN)),
            ("both", read(1.3 + TURN, 5.2)),
        ),
    )
    apart = of.changes("longitude_of_perihelion")
    found = {cause: float(share[0]) for cause, share in apart.items()}
    assert found == pytest.approx({"orbit": 0.01, "axis": TURN, "both": 0.3}, rel=1e-9, abs=0)
    assert float(of.changes("general_precession")["both"][0]) == pytest.approx(0.2, rel=1e-9, abs=0)


def test_directions_of_one_cause_count_as_the_root_of_their_squares() -> None:
    of = AnglesWithErrors(read(1.0, 5.0), (("orbit", read(1.0, 5.3)), ("orbit", read(1.0, 4.6))))
    apart = of.changes("general_precession")
    assert list(apart) == ["orbit"]
    assert apart["orbit"] == pytest.approx([0.5], rel=1e-12, abs=0)

"""Many axes side by side."""

from dataclasses import replace

import numpy as np
import pytest

from earthspin.errors import UndefinedError
from earthspin.secular.lanes import solve_many
from earthspin.secular.strength import Tides
from earthspin.secular.trajectory import solve
from tests.secular.setting import EARTHS, KYR, POLE, arcsec, earths, inclined_axis

TIMES = np.linspace(-200, 0, 41) * KYR


def same(members: int) -> np.ndarray:
    return np.repeat(POLE[:, np.newaxis], members, axis=1)


def test_equal_members_do_not_hang_on_how_many_there_are() -> None:
    alone = solve_many(earths(), EARTHS, same(1), TIMES)
    for width in (63, 64, 65, 130):
        found = solve_many(earths(), EARTHS, same(width), TIMES)
        assert all(np.array_equal(found[:, :, k], alone[:, :, 0]) for k in range(width))


def test_others_beside_it_change_a_member_by_less_than_its_error() -> None:
    """The frame turns with the mean of all members, and the error of a step with the frame."""
    tides = Tides.of_the_earth(np.linspace(0, 1.2, 130), 7.29e-5, 2.66e-6)
    strength = replace(earths(), tides=tides)
    many = solve_many(strength, EARTHS, same(130), TIMES)
    for width in (1, 63, 64, 65):
        fewer = replace(strength, tides=Tides(tides.moon[:width], tides.spin[:width]))
        found = solve_many(fewer, EARTHS, same(width), TIMES)
        assert arcsec(found[:, :, 0], many[:, :, 0]) < 0.01


def test_members_of_their_own_numbers_are_those_alone() -> None:
    """Starts, tides, figures and constants: each against the solver of one axis."""
    rng = np.random.default_rng(3)
    members = 5
    normal = EARTHS.at(np.zeros(1))[0][:, 0]
    starts = np.stack([inclined_axis(0.41 + 0.01 * k, normal) for k in range(members)], axis=1)
    strength = replace(
        earths(),
        moon=earths().moon * (1 + 1e-3 * rng.normal(size=members)),
        ellipticity=1 + 1e-3 * rng.normal(size=members),
        j2_rate=earths().j2_rate * rng.uniform(0, 2, members),
        tides=Tides.of_the_earth(rng.uniform(0, 1.2, members), 7.29e-5, 2.66e-6),
    )
    many = solve_many(strength, EARTHS, starts, TIMES, 2 * KYR)
    for k in range(members):
        own = replace(
            strength,
            moon=strength.moon[k],
            ellipticity=strength.ellipticity[k],
            j2_rate=strength.j2_rate[k],
            tides=Tides(strength.tides.moon[k], strength.tides.spin[k]),
        )
        path = solve(own, EARTHS, starts[:, k], (TIMES[0], TIMES[-1]), pieces=2)
        # what the Moon lags behind is that of the mean member: 1e-3 of 1.4 arcsec a turn
        assert arcsec(many[:, :, k], path.at(TIMES)) < 0.05


def test_axes_are_unit_vectors_and_start_where_they_are_put() -> None:
    found = solve_many(earths(), EARTHS, same(3), TIMES)
    assert np.max(np.abs(np.sum(found**2, axis=0) - 1)) < 1e-14
    assert arcsec(found[:, -1], same(3)) < 1e-9


def test_both_ways_at_once() -> None:
    times = np.array([-50.0, -10.0, 0.0, 20.0, 50.0]) * KYR
    both = solve_many(earths(), EARTHS, same(1), times)
    ahead = solve_many(earths(), EARTHS, same(1), times[2:])
    # the frame turns about the mean normal of the span, which is another
    assert arcsec(both[:, 2:], ahead) < 0.02


def test_times_between_steps_lie_on_the_same_path() -> None:
    fine = np.linspace(-40, 0, 101) * KYR
    found = solve_many(earths(), EARTHS, same(1), fine, 2 * KYR)
    path = solve(earths(), EARTHS, POLE, (fine[0], 0.0), pieces=2)
    assert arcsec(found[:, :, 0], path.at(fine)) < 2e-3


def test_members_that_precess_at_other_rates_are_refused() -> None:
    normal = EARTHS.at(np.zeros(1))[0][:, 0]
    starts = np.stack([inclined_axis(0.4, normal), inclined_axis(1.4, normal)], axis=1)
    with pytest.raises(UndefinedError, match="similar obliquity"):
        solve_many(earths(), EARTHS, starts, TIMES)

"""Stiff and extreme cases of many: members side by side, how they are drawn, what they tell."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from earthspin.checks.case import Distances, FloatArray, holds, refused
from earthspin.checks.sky import BODY, J2, H
from earthspin.engine.ensemble import Ensemble
from earthspin.engine.member_values import MEMBER
from earthspin.engine.question import Question
from earthspin.engine.spread import quantiles, sensitivity
from earthspin.many import ensemble
from earthspin.numerics import sampling
from earthspin.questions.free_rotor import free_rotor
from earthspin.questions.precession import precession
from earthspin.questions.spheroid import spheroid_field
from earthspin.questions.top import heavy_top
from earthspin.scenes import QUESTIONS

H_OF_BODY, J2_OF_BODY = "body.dynamical_flattening", "body.j2"
#: A moment about each axis, and angular velocities.
ROTOR = tuple(f"{key}.{axis}" for key in ("moments", "omega") for axis in range(3))
TIMES = (0.0, 7.0, 90.0)


def _beside(
    question: Question, names: Sequence[str], rows: ArrayLike, alone: Callable[..., xr.Dataset]
) -> Iterator[ArrayLike]:
    """Yield where numbers of members side by side differ from those of each member alone."""
    values = np.array(rows, dtype=float).reshape(-1, len(names))
    members = xr.Dataset({n: (MEMBER, column) for n, column in zip(names, values.T, strict=True)})
    yield Ensemble(question.replace(members=members)).width == 1  # not one by one
    many = ensemble(question, members)
    for place, row in enumerate(values.tolist()):
        for name, expected in alone(*row).data_vars.items():
            result = many[name]
            result = result.isel({MEMBER: place}) if MEMBER in result.dims else result
            yield result.values != expected.values


def _rotors(rows: ArrayLike) -> Iterator[ArrayLike]:
    question = QUESTIONS["free-rotor"](moments=(1, 2, 2.8), omega=(0, 1, 0), times=TIMES)
    return _beside(question, ROTOR, rows, lambda *row: free_rotor(row[:3], row[3:], TIMES))


@holds(bound=0.0)
def _scales() -> Distances:
    """rotors twenty orders of magnitude apart, side by side

    Hard because: what scales one to the numbers of another leaves it no digit
    Held against: each rotor alone, bit for bit
    """
    yield from _rotors(
        [[s, 2 * s, 2.8 * s, w, 0.3 * w, w] for s, w in ((1e-10, 1e-3), (1.0, 1.0), (1e10, 1e-9))]
    )


@holds(bound=0.0)
def _degenerate_rotors() -> Distances:
    """a sphere and a separatrix beside other rotors

    Hard because: the one has no polhode, the other's has no period: arrays know no exceptions
    Held against: each rotor alone, bit for bit
    """
    yield from _rotors(
        [
            [1.0, 2.0, 2.8, 0.01, 1.0, 0.0],
            [2.0, 2.0, 2.0, 0.3, 0.4, 0.5],
            [3.0, 4.0, 6.0, 2.0, 0.0, 1.0],
            [1.0, 2.0, 2.5, 0.0, 1.0, 0.0],
            [1.0, 1.0, 2.0, 0.0, 1e-9, 1.0],
        ]
    )


@holds(bound=0.0)
def _tops() -> Distances:
    """tops that stand, hang and sleep beside one that loops

    Hard because: upright and upside down there is no azimuth, and a sleeping top has no nutation
    Held against: each top alone, bit for bit
    """
    top = {"transverse_moment": 1.0, "axial_moment": 1.2, "weight_moment": 1.5}
    question = QUESTIONS["top"](times=TIMES, theta=0.7, spin=3.0, **top)
    rows = [[0.7, 3.0], [0.0, 50.0], [0.0, 1.0], [np.pi, 3.0], [1e-9, 2.041], [1.0, 0.0]]
    yield from _beside(
        question, ("theta", "spin"), rows, lambda t, s: heavy_top(TIMES, **top, theta=t, spin=s)
    )


@holds(bound=0.0)
def _spheroids() -> Distances:
    """a ball, a disc and a needle, side by side

    Hard because: each has a closed form of its own, and a series where that loses its digits
    Held against: the field of each alone, bit for bit
    """
    place = [[7e6, 1e5, 2e6], [1e9, 1e9, 1e3]]
    question = QUESTIONS["spheroid"](position=place)

    def alone(flattening: float) -> xr.Dataset:
        return spheroid_field(place, body=BODY.replace(flattening=flattening))

    rows = [0.0, 1e-15, 1e-7, float(BODY.flattening or 0.0), 0.999999, -0.05]
    yield from _beside(question, ("body.flattening",), rows, alone)


@holds(bound=0.0)
def _discs() -> Distances:
    """a thin disc and almost a ball, precessing side by side

    Hard because: their rates are eleven orders of magnitude apart, in one product
    Held against: the precession of each alone, bit for bit
    """
    rows = [[5e-12, 1e-12], [H, J2], [0.5, 0.2]]
    yield from _beside(
        QUESTIONS["precession"](),
        (H_OF_BODY, J2_OF_BODY),
        rows,
        lambda h, j2: precession(body=BODY.replace(dynamical_flattening=h, j2=j2)),
    )


# --- drawn ---------------------------------------------------------------------------------------


def _drawn(n: int, **settings: Any) -> dict[str, FloatArray]:
    """Two standard normal numbers of each member."""
    normal = {"normal": [0.0, 1.0]}
    question = QUESTIONS["free-rotor"](moments=(1, 2, 2.8), omega=(0, 1, 0), times=TIMES)
    members = {"n": n, "omega.0": normal, "omega.1": normal, **settings}
    return Ensemble(question.replace(members=members)).values


@holds(bound=0.0)
def _last() -> Distances:
    """the last of ten million members, alone

    Hard because: each has a generator of its own: those before it must not be needed
    Held against: numbers of a generator of its own, Philox by seed and member
    """
    number = 10**7 - 1
    sequence = np.random.SeedSequence(5, spawn_key=(number,))
    own = np.random.Generator(np.random.Philox(sequence)).standard_normal(2)
    result = _drawn(10**7, seed=5, only=[number])
    yield [result[f"omega.{axis}"][0] - own[axis] for axis in range(2)]


@holds(bound=2e-13)
def _correlated() -> Distances:
    """inputs correlated by 0.999999

    Hard because: 1 - r2 loses six digits, and the second input is nearly the first
    Held against: r x + sqrt((1 - r) (1 + r)) y of two independent numbers
    """
    r = 0.999999
    first, second = "omega.0", "omega.1"
    x, y = _drawn(200).values()
    result = _drawn(200, correlations=[[first, second, r]])
    yield result[first] - x
    yield result[second] - (r * x + np.sqrt((1 - r) * (1 + r)) * y)


@refused("write them to a store")
def _too_many() -> None:
    """thirty thousand decades of torques held at once

    Hard because: each alone fits, and so do all numbers that are drawn
    """
    decade = QUESTIONS["torque"](span=("2000-01-01", "2010-01-01"), step="1 d")
    ensemble(decade, {"n": 30_000, J2_OF_BODY: {"uniform": [1.082e-3, 1.083e-3]}})


# --- read ----------------------------------------------------------------------------------------


@holds(bound=0.0)
def _one() -> Distances:
    """an ensemble of one member

    Hard because: it has no spread, no neighbour, and no row of its own length
    Held against: the answer to its own numbers, and that as each quantile, bit for bit
    """
    h = 1.5 * H
    alone = precession(body=BODY.replace(dynamical_flattening=h)).precession_period
    ends = quantiles(ensemble("precession", {H_OF_BODY: {"grid": [h]}}), (0.0, 0.3, 1.0))
    yield ends.precession_period.values != alone.values


@refused("take at least 3 members")
def _one_slope() -> None:
    """slopes from one member

    Hard because: any line goes through one point
    """
    sensitivity(ensemble("precession", {H_OF_BODY: {"grid": [H]}}))


@holds(bound=0.0)
def _no_spread() -> Distances:
    """inputs whose spread is below their last bit

    Hard because: shares of no variance are zero over zero
    Held against: no slope, no share and nothing unexplained
    """
    normal = {"normal": [H, 1e-30]}
    shares = sensitivity(ensemble("precession", {"n": 9, H_OF_BODY: normal}))
    yield from (share.values for share in shares.data_vars.values())


@holds(bound=2e-14)
def _additive() -> Distances:
    """a sum of inputs twenty-four orders of magnitude apart

    Hard because: a fit in their own units would leave the small ones out
    Held against: the coefficient of each, relative, and shares that add up to 1
    """
    spread = np.array([1e-12, 1e-3, 1.0, 1e12])
    inputs = spread * (3 + np.random.default_rng(1).standard_normal((300, 4)))
    weights = np.array([1.0, -2.0, 0.5, 3.0]) / spread
    shares = sampling.shares_of_variance(inputs, inputs @ weights)
    yield shares.slope / weights - 1
    yield shares.share.sum() - 1
    yield shares.unexplained

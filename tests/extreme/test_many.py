"""Ensembles: joint computation, random draws and statistics."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from earthspin.engine.ensemble import Ensemble
from earthspin.engine.members import MEMBER
from earthspin.engine.question import Question
from earthspin.engine.spread import quantiles, sensitivity
from earthspin.many import ensemble
from earthspin.numerics import sampling
from earthspin.numerics.arrays import FloatArray
from earthspin.questions.free_rotor import free_rotor
from earthspin.questions.precession import precession
from earthspin.questions.spheroid import spheroid_field
from earthspin.questions.top import heavy_top
from earthspin.scenes import QUESTIONS
from tests.extreme import Distances, holds, refused
from tests.reference.sky import BODY, J2, H

H_OF_BODY, J2_OF_BODY = "body.dynamical_flattening", "body.j2"
#: Names of the inputs: the moment and the angular velocity for each axis.
ROTOR = tuple(f"{key}.{axis}" for key in ("moments", "omega") for axis in range(3))
TIMES = (0.0, 7.0, 90.0)


def _compared_with_members_alone(
    question: Question, names: Sequence[str], rows: ArrayLike, alone: Callable[..., xr.Dataset]
) -> Iterator[ArrayLike]:
    """Yield True where ensemble members computed together differ from members computed alone."""
    values = np.array(rows, dtype=float).reshape(-1, len(names))
    members = xr.Dataset({n: (MEMBER, column) for n, column in zip(names, values.T, strict=True)})
    yield Ensemble(question.replace(members=members)).width == 1  # computed separately: fails
    many = ensemble(question, members)
    for index, row in enumerate(values.tolist()):
        for name, expected in alone(*row).data_vars.items():
            result = many[name]
            result = result.isel({MEMBER: index}) if MEMBER in result.dims else result
            yield result.values != expected.values


def _rotors(rows: ArrayLike) -> Iterator[ArrayLike]:
    question = QUESTIONS["free-rotor"](moments=(1, 2, 2.8), omega=(0, 1, 0), times=TIMES)
    return _compared_with_members_alone(
        question, ROTOR, rows, lambda *row: free_rotor(row[:3], row[3:], TIMES)
    )


@holds(bound=0.0)
def test_scales() -> Distances:
    """free rotors with moments that differ by twenty orders of magnitude, computed together

    Hard because: scaling one rotor to the numbers of another would lose all digits
    Compared with: each rotor alone, bit for bit
    """
    yield from _rotors(
        [[s, 2 * s, 2.8 * s, w, 0.3 * w, w] for s, w in ((1e-10, 1e-3), (1.0, 1.0), (1e10, 1e-9))]
    )


@holds(bound=0.0)
def test_degenerate_rotors() -> Distances:
    """free rotation of a sphere and on the separatrix, computed together with other rotors

    Hard because: a sphere has no polhode and a separatrix no period, but arrays have no exceptions
    Compared with: each rotor alone, bit for bit
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
def test_tops() -> Distances:
    """upright, hanging and sleeping tops computed together with a top that traces loops

    Hard because: the azimuth of vertical tops is undefined, and a sleeping top has no nutation
    Compared with: each top alone, bit for bit
    """
    top = {"transverse_moment": 1.0, "axial_moment": 1.2, "weight_moment": 1.5}
    question = QUESTIONS["top"](times=TIMES, theta=0.7, spin=3.0, **top)
    rows = [[0.7, 3.0], [0.0, 50.0], [0.0, 1.0], [np.pi, 3.0], [1e-9, 2.041], [1.0, 0.0]]
    yield from _compared_with_members_alone(
        question, ("theta", "spin"), rows, lambda t, s: heavy_top(TIMES, **top, theta=t, spin=s)
    )


@holds(bound=0.0)
def test_spheroids() -> Distances:
    """gravity fields of a sphere, a disc and a needle, computed together

    Hard because: each has its own closed form, and a series where that form loses digits
    Compared with: field of each body alone, bit for bit
    """
    place = [[7e6, 1e5, 2e6], [1e9, 1e9, 1e3]]
    question = QUESTIONS["spheroid"](position=place)

    def alone(flattening: float) -> xr.Dataset:
        return spheroid_field(place, body=BODY.replace(flattening=flattening))

    rows = [0.0, 1e-15, 1e-7, float(BODY.flattening or 0.0), 0.999999, -0.05]
    yield from _compared_with_members_alone(question, ("body.flattening",), rows, alone)


@holds(bound=0.0)
def test_discs() -> Distances:
    """precession of a thin disc and a near-sphere computed together

    Hard because: their rates differ by eleven orders of magnitude in one product
    Compared with: precession of each body alone, bit for bit
    """
    rows = [[5e-12, 1e-12], [H, J2], [0.5, 0.2]]
    yield from _compared_with_members_alone(
        QUESTIONS["precession"](),
        (H_OF_BODY, J2_OF_BODY),
        rows,
        lambda h, j2: precession(body=BODY.replace(dynamical_flattening=h, j2=j2)),
    )


# --- drawing -------------------------------------------------------------------------------------


def _drawn(n: int, **settings: Any) -> dict[str, FloatArray]:
    """Draw two standard normal numbers for each ensemble member, by name of the input."""
    normal = {"normal": [0.0, 1.0]}
    question = QUESTIONS["free-rotor"](moments=(1, 2, 2.8), omega=(0, 1, 0), times=TIMES)
    members = {"n": n, "omega.0": normal, "omega.1": normal, **settings}
    return Ensemble(question.replace(members=members)).values


@holds(bound=0.0)
def test_last() -> Distances:
    """random inputs of the last of ten million ensemble members, drawn alone

    Hard because: each member has its own generator, so the members before it must not be drawn
    Compared with: numbers of a separate generator, Philox with seed and member
    """
    number = 10**7 - 1
    sequence = np.random.SeedSequence(5, spawn_key=(number,))
    own = np.random.Generator(np.random.Philox(sequence)).standard_normal(2)
    result = _drawn(10**7, seed=5, only=[number])
    yield [result[f"omega.{axis}"][0] - own[axis] for axis in range(2)]


@holds(bound=2e-13)
def test_correlated() -> Distances:
    """random inputs of an ensemble with a correlation of 0.999999

    Hard because: 1 - r2 loses six digits, and the second input is nearly the first
    Compared with: r x + sqrt((1 - r) (1 + r)) y of two independent numbers
    """
    r = 0.999999
    first, second = "omega.0", "omega.1"
    x, y = _drawn(200).values()
    result = _drawn(200, correlations=[[first, second, r]])
    yield result[first] - x
    yield result[second] - (r * x + np.sqrt((1 - r) * (1 + r)) * y)


@refused("write them to a store")
def test_too_many() -> None:
    """refusal of an ensemble of thirty thousand torque series that exceeds the memory

    Hard because: each series alone fits into memory, and so do all drawn numbers
    """
    decade = QUESTIONS["torque"](span=("2000-01-01", "2010-01-01"), step="1 d")
    ensemble(decade, {"n": 30_000, J2_OF_BODY: {"uniform": [1.082e-3, 1.083e-3]}})


# --- statistics ----------------------------------------------------------------------------------


@holds(bound=0.0)
def test_one() -> Distances:
    """quantiles of an ensemble of one member

    Hard because: there is no spread, and the row of members is not full
    Compared with: single answer with the same numbers, and each quantile, bit for bit
    """
    h = 1.5 * H
    alone = precession(body=BODY.replace(dynamical_flattening=h)).precession_period
    ends = quantiles(ensemble("precession", {H_OF_BODY: {"grid": [h]}}), (0.0, 0.3, 1.0))
    yield ends.precession_period.values != alone.values


@refused("need at least 3 members")
def test_one_slope() -> None:
    """refusal of a sensitivity to an input from an ensemble of one member

    Hard because: any line passes through one point
    """
    sensitivity(ensemble("precession", {H_OF_BODY: {"grid": [H]}}))


@holds(bound=0.0)
def test_no_spread() -> Distances:
    """sensitivity to an ensemble input whose spread is smaller than its last bit

    Hard because: shares of zero variance are 0/0
    Compared with: zero slope, zero share and nothing unexplained
    """
    normal = {"normal": [H, 1e-30]}
    shares = sensitivity(ensemble("precession", {"n": 9, H_OF_BODY: normal}))
    yield from (share.values for share in shares.data_vars.values())


@holds(bound=2e-14)
def test_additive() -> Distances:
    """sensitivity of a sum of inputs that differ by twenty-four orders of magnitude

    Hard because: a fit in the original units would ignore the small inputs
    Compared with: coefficient of each input, relative, and shares with a sum of 1
    """
    spread = np.array([1e-12, 1e-3, 1.0, 1e12])
    inputs = spread * (3 + np.random.default_rng(1).standard_normal((300, 4)))
    weights = np.array([1.0, -2.0, 0.5, 3.0]) / spread
    shares = sampling.shares_of_variance(inputs, inputs @ weights)
    yield shares.slope / weights - 1
    yield shares.share.sum() - 1
    yield shares.unexplained

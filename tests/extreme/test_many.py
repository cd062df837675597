"""Ensembles: joint computation, random draws and statistics."""

from collections.abc import Callable, Iterator, Sequence

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from earthspin.engine.ensemble import Ensemble
from earthspin.engine.members import MEMBER
from earthspin.engine.question import Question
from earthspin.questions.free_rotor import free_rotor
from earthspin.questions.precession import precession
from earthspin.questions.spheroid import spheroid_field
from earthspin.questions.top import heavy_top
from earthspin.scenes import QUESTIONS, ensemble
from tests.extreme import Distances, holds, refused
from tests.reference.sky import BODY, H

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


# --- drawing -------------------------------------------------------------------------------------


@refused("write them to a store")
def test_too_many() -> None:
    """refusal of thirty thousand torque series of ten years, each day, that exceed the memory

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
    ends = ensemble("precession", {H_OF_BODY: {"grid": [h]}}).earthspin.quantiles((0.0, 0.3, 1.0))
    yield ends.precession_period.values != alone.values


@holds(bound=0.0)
def test_no_spread() -> Distances:
    """sensitivity to an ensemble input whose spread is smaller than its last bit

    Hard because: shares of zero variance are 0/0
    Compared with: zero slope, zero share and nothing unexplained
    """
    normal = {"normal": [H, 1e-30]}
    shares = ensemble("precession", {"n": 9, H_OF_BODY: normal}).earthspin.sensitivity()
    yield from (share.values for share in shares.data_vars.values())

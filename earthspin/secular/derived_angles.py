"""Angles and rates derived from a trajectory of the spin axis, and their errors by error source.

Longitudes are unwrapped, although epochs may be far apart: between two epochs precession is
followed along the nodes of the solution, and the perihelion, which moves fast for a nearly circular
orbit, along samples of the orbit.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from earthspin.constants import JULIAN_YEAR
from earthspin.errors import ApartError, UndefinedError
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.varied_inputs import Quantiles, draws
from earthspin.nutation.analysis import followed, general_precession
from earthspin.secular.averaged_torque import (
    ChangingOrbit,
    broadcast_over_members,
    moon_rate_factor,
    reference_axes,
)
from earthspin.secular.error_budget import AxisFamily, AxisInputs, changed
from earthspin.secular.trajectory import AxisTrajectory, solve
from earthspin.torque.gravity import dot

# --- obliquity and precession angles from a spin axis and an orbit --------------------------------
# The spin axis is s; the orbit has the normal n and the eccentricity vector e.
#
# The equinox of date lies along s x n, where the Sun crosses the equator northward. The obliquity
# is the angle from n to s; the longitude of perihelion is measured along the orbit from the equinox
# of date. Climatic precession and coprecession,
#
#     e sin(longitude) = (e.s)/sin(obliquity),     e cos(longitude) = e.(s x n)/sin(obliquity),
#
# thus need no trigonometric function. Perihelion is where the *body* is closest to the Sun; seen
# from the body, the Sun is then in the opposite direction.

Numeric = float | FloatArray


class SeasonalElements(NamedTuple):
    """Obliquity, eccentricity e, climatic precession e sin(w), and coprecession e cos(w).

    The angle w is the longitude of perihelion. Each array has the shape (n,).

    Attributes
    ----------
    obliquity : ndarray
        rad.
    eccentricity : ndarray
    climatic_precession, coprecession : ndarray
        Eccentricity times sine and cosine of the longitude of perihelion.
    """

    obliquity: FloatArray
    eccentricity: FloatArray
    climatic_precession: FloatArray
    coprecession: FloatArray


def seasons(axis: FloatArray, normal: FloatArray, eccentricity: FloatArray) -> SeasonalElements:
    """Compute obliquity, e, e sin(w), e cos(w) from spin axis, orbit normal, eccentricity vector.

    Parameters
    ----------
    axis, normal, eccentricity : ndarray, shape (3, n)
        Spin axis, orbit normal, eccentricity vector.
    """
    equinox = np.cross(axis, normal, axis=0)
    sine = np.sqrt(np.sum(equinox**2, axis=0))
    upright = np.where(sine > 0, sine, np.nan)
    return SeasonalElements(
        np.arctan2(sine, np.sum(axis * normal, axis=0)),
        np.sqrt(np.sum(eccentricity**2, axis=0)),
        np.sum(eccentricity * axis, axis=0) / upright,
        np.sum(eccentricity * equinox, axis=0) / upright,
    )


def equator_and_equinox(axis: FloatArray, normal: FloatArray) -> FloatArray:
    """Rotation matrices from GCRS to mean equator and equinox of date, shape (..., n, 3, 3).

    Parameters
    ----------
    axis : ndarray, shape (3, ..., n)
    normal : ndarray, shape (3, n)
    """
    equinox = np.cross(axis, broadcast_over_members(axis, normal), axis=0)
    equinox = equinox / np.sqrt(np.sum(equinox**2, axis=0))
    rows = np.stack([equinox, np.cross(axis, equinox, axis=0), axis])
    return np.moveaxis(rows, (0, 1), (-2, -1))


def equinox_error(pole: FloatArray, normal: Numeric, sine: FloatArray) -> FloatArray:
    """Combined 95 % half-width of the directions of equinox and pole, rad.

    A displacement d of the pole can turn the equinox by d/tan(obliquity) along the equator; a
    displacement d of the orbit's normal can turn it by d/sin(obliquity).

    Parameters
    ----------
    pole, normal : ndarray
        95 % half-widths of the directions of the pole and of the orbit's normal, rad.
    sine : ndarray
        Sine of the obliquity.
    """
    return np.asarray(np.hypot(pole, normal) / sine)


def inclined_axis(axis: FloatArray, normal: FloatArray, tilt: Numeric, turn: Numeric) -> FloatArray:
    """Return a spin axis with its obliquity and longitude increased by given angles.

    Parameters
    ----------
    axis, normal : ndarray, shape (3,)
        Unit vectors.
    tilt : float or ndarray, shape (...)
        Increment of the obliquity, rad; if the obliquity becomes negative, the axis is on the other
        side of the normal.
    turn : float or ndarray, shape (...)
        Increment of the longitude, in the sense of the orbital motion, rad.

    Returns
    -------
    ndarray, shape (3, ...)
    """
    tilt, turn = np.broadcast_arrays(tilt, turn)
    first, _, n = reference_axes(normal)
    equinox = np.cross(n, axis)
    sine = float(np.linalg.norm(equinox))
    node_normal = np.cross(equinox, n) / sine if sine > 0 else first
    obliquity = np.arctan2(sine, axis @ n) + tilt
    sin_obliquity = np.sin(obliquity)
    outer = np.multiply.outer
    return np.asarray(
        outer(n, np.cos(obliquity))
        + outer(node_normal, sin_obliquity * np.cos(turn))
        + outer(np.cross(n, node_normal), sin_obliquity * np.sin(turn))
    )


# --- readings of a trajectory ---------------------------------------------------------------------

#: Sampling interval of the perihelion, s: it moves fast for a nearly circular orbit, by 1.2 rad in
#: 200 years at the Earth's eccentricity of 1.6e-4.
LOOK = 200 * JULIAN_YEAR
#: Sine of the obliquity below which there is no equinox.
NO_EQUINOX = 1e-9
#: Phase errors, rad: up to the first, causes are changed one at a time; from the second,
#: half-widths are quantiles of a sample; in between, weighted means of both. The Earth stays below
#: the first for a million years.
LINEAR_TO, SAMPLED_FROM = 0.09, 0.1
#: Largest number of epochs of a block. Angles are derived block by block, so that memory does not
#: grow with the number of changed solutions.
AT_ONCE = 1 << 11
#: Directions, whose deviations are angles.
DIRECTIONS = ("pole", "normal")
#: Quantities that depend only on the orbit, whose changes are always small.
OF_THE_ORBIT = ("eccentricity",)
_TURN = 2 * np.pi


@dataclass(frozen=True)
class DerivedAngles:
    """Angles, pole and precession rates derived from a trajectory of one or many spin axes.

    Axes of members precede the time axis.

    Attributes
    ----------
    values : dict of str to ndarray, shape (..., n)
        Angles (rad), eccentricity and its products, and the rates of precession in longitude by
        `sun`, `moon` and in `total` (rad/s).
    pole : ndarray, shape (3, ..., n)
        Unit vector of the spin axis, GCRS.
    normal : ndarray, shape (3, n)
        Normal of the orbit, common to all members.
    """

    values: dict[str, FloatArray]
    pole: FloatArray
    normal: FloatArray

    def blocks(self) -> Iterator[DerivedAngles]:
        """Yield the angles of successive blocks of epochs."""
        for block in _blocks(self.normal.shape[-1]):
            values = {name: array[..., block] for name, array in self.values.items()}
            yield DerivedAngles(values, self.pole[..., block], self.normal[..., block])


#: A cause of error, and a function that derives the solution it changes, block by block.
Varied = tuple[str, Callable[[], Iterable[DerivedAngles]]]


@dataclass(frozen=True)
class AnglesWithErrors:
    """Angles and rates of the nominal trajectory, and of trajectories with a varied error source.

    Attributes
    ----------
    nominal : DerivedAngles
    varied : tuple of (str, callable)
        Changed solutions by cause, derived anew at each use; a cause with independent directions
        occurs more than once.
    weight : ndarray, shape (..., n)
        Weight of the sampled half-widths, from 0 to 1.
    sampled : dict of str to ndarray, shape (..., n)
        Half-widths by name, and that of the `pole` (rad), as quantiles of a sample; empty if all
        weights are 0.
    """

    nominal: DerivedAngles
    varied: tuple[Varied, ...]
    weight: FloatArray | float = 0.0
    sampled: Mapping[str, FloatArray] = field(default_factory=dict)

    def half_width(self, name: str) -> FloatArray:
        """95 % half-width from all error sources of a quantity, or of one of `DIRECTIONS` (rad)."""
        linear = self._linear[name]
        if name not in self.sampled:
            return linear
        return linear + self.weight * (self.sampled[name] - linear)

    def changes(self, name: str) -> dict[str, FloatArray]:
        """Size of the change of a quantity or direction due to each error source, by its name."""
        return _joined(_by_cause(name, *block) for block in self._blocks())

    @cached_property
    def _linear(self) -> dict[str, FloatArray]:
        """Root sum square of the changes of all quantities and directions."""
        names = (*self.nominal.values, *DIRECTIONS)
        return _joined(
            {name: root_sum_square(_by_cause(name, *block)) for name in names}
            for block in self._blocks()
        )

    def _blocks(self) -> Iterator[tuple[DerivedAngles, list[tuple[str, DerivedAngles]]]]:
        """Yield the nominal and all changed solutions in successive blocks of epochs."""
        causes, solutions = zip(*self.varied, strict=True)
        changed_blocks = (solution() for solution in solutions)
        for nominal, *blocks in zip(self.nominal.blocks(), *changed_blocks, strict=True):
            yield nominal, [*zip(causes, blocks, strict=True)]


def _blocks(count: int) -> list[slice]:
    """Successive blocks of at most `AT_ONCE` of a number of epochs."""
    return [slice(*ends) for ends in pairwise([*range(0, count, AT_ONCE), count])]


def _joined(blocks: Iterable[Mapping[str, FloatArray]]) -> dict[str, FloatArray]:
    """Join the arrays of successive blocks of epochs, by name."""
    rows = [*blocks]
    return {name: np.concatenate([row[name] for row in rows], axis=-1) for name in rows[0]}


def deviation(varied: DerivedAngles, nominal: DerivedAngles, name: str) -> FloatArray:
    """Size of the change of a quantity, or of one of `DIRECTIONS` (rad), from the nominal one."""
    if name in DIRECTIONS:
        return angle(getattr(varied, name), getattr(nominal, name))
    return np.abs(change(varied, nominal, name))


def change(varied: DerivedAngles, nominal: DerivedAngles, name: str) -> FloatArray:
    """Difference of a derived quantity between a varied and the nominal solution."""
    total = varied.values[name] - nominal.values[name]
    if name != "longitude_of_perihelion":
        return total
    # the perihelion of a nearly circular orbit may differ by whole turns between solutions, which
    # is no physical change
    precession = varied.values["general_precession"] - nominal.values["general_precession"]
    orbital = total - precession
    return np.asarray(precession + orbital - _TURN * np.rint(orbital / _TURN))


def angle(varied: FloatArray, nominal: FloatArray) -> FloatArray:
    """Angle between unit vectors of two arrays, rad; the first axis holds x, y, z."""
    half_chord = np.linalg.norm(varied - nominal, axis=0) / 2
    return np.asarray(2 * np.arcsin(np.minimum(half_chord, 1.0)))


def _by_cause(
    name: str, nominal: DerivedAngles, varied: Iterable[tuple[str, DerivedAngles]]
) -> dict[str, FloatArray]:
    """Changes of a quantity by cause; those in two directions are combined by root sum square."""
    totals: dict[str, FloatArray] = {}
    for cause, angles in varied:
        totals[cause] = np.hypot(totals.get(cause, 0.0), deviation(angles, nominal, name))
    return totals


def root_sum_square(shares: dict[str, FloatArray]) -> FloatArray:
    """Root sum square of the changes due to all error sources."""
    return np.sqrt(sum(share**2 for share in shares.values()))


def derive_all(
    solved: AxisFamily,
    times: FloatArray,
    fixed: FloatArray,
    advance: Callable[[int], object] = int,
) -> AnglesWithErrors:
    """Derive angles and rates, with errors, from the nominal and all varied solutions.

    Parameters
    ----------
    solved : AxisFamily
    times : ndarray, shape (n,)
        s from J2000.0 TDB.
    fixed : ndarray, shape (3, 3)
        Orbit and equinox of J2000.0 in the GCRS.
    advance : callable
        Called with 1 after each solution of the sample.

    Raises
    ------
    UndefinedError
        If the axis is normal to the orbit at one of the times; an ApartError if that of a member
        is.
    """
    setting = solved.setting
    perihelion = followed_perihelion(setting.orbit, np.append(times, 0.0), fixed)
    nominal = derive(solved.path, setting, times, fixed, perihelion)
    _refuse_upright(nominal.values["obliquity"], times)
    linear = AnglesWithErrors(
        nominal,
        tuple(
            (cause, partial(derived_blocks, path, changed_setting, times, fixed, perihelion))
            for cause, path, changed_setting in solved.varied
        ),
    )
    phase = phase_error(solved, times)
    weight = np.clip((phase - LINEAR_TO) / (SAMPLED_FROM - LINEAR_TO), 0.0, 1.0)
    if not np.any(weight > 0):
        return linear
    sampled = _sampled(solved, nominal, times, fixed, perihelion, advance)
    return replace(linear, weight=weight, sampled=sampled)


def phase_error(solved: AxisFamily, times: FloatArray) -> FloatArray:
    """Largest error of the precession angle between J2000.0 and each time, rad, (..., n).

    It is the half-width of the axis divided by the sine of its obliquity. The largest value up to
    each time is used, because after a large phase error changes are no longer proportional to their
    causes, even if the phase error decreases, as for Mars.
    """
    edges = solved.path.windows.edges
    axis = solved.path.at(edges)
    normal = broadcast_over_members(axis, solved.setting.orbit.at(edges)[0])
    sine = np.maximum(np.linalg.norm(np.cross(axis, normal, axis=0), axis=0), NO_EQUINOX)
    squares = sum(angle(path.at(edges), axis) ** 2 for _, path, _ in solved.varied)
    error = np.sqrt(squares) / sine
    past, future = edges <= 0, edges >= 0
    error[..., future] = np.maximum.accumulate(error[..., future], axis=-1)
    backward = np.maximum.accumulate(error[..., past][..., ::-1], axis=-1)
    error[..., past] = backward[..., ::-1]
    after = np.clip(np.searchsorted(edges, times), 1, len(edges) - 1)
    fraction = (times - edges[after - 1]) / (edges[after] - edges[after - 1])
    return np.asarray(error[..., after - 1] * (1 - fraction) + error[..., after] * fraction)


def _sampled(
    solved: AxisFamily,
    nominal: DerivedAngles,
    times: FloatArray,
    fixed: FloatArray,
    perihelion: FloatArray,
    advance: Callable[[int], object],
) -> dict[str, FloatArray]:
    """95 % half-widths of all quantities from solutions with randomly varied inputs."""
    names = [*(name for name in nominal.values if name not in OF_THE_ORBIT), "pole"]
    span, quantiles = (
        (float(times.min()), float(times.max())),
        [Quantiles() for _ in _blocks(times.size)],
    )
    for amounts in draws(len(solved.uncertainty.causes)):
        member = changed(solved.setting, solved.uncertainty, amounts)
        path = solve(member.precession, member.orbit, member.start, span)
        blocks = derived_blocks(path, member, times, fixed, perihelion)
        for store, block, middle in zip(quantiles, blocks, nominal.blocks(), strict=True):
            store.add({name: deviation(block, middle, name) for name in names})
        advance(1)
    return _joined(store.at_probability() for store in quantiles)


def derive(
    path: AxisTrajectory,
    setting: AxisInputs,
    times: FloatArray,
    fixed: FloatArray,
    orbits: FloatArray,
) -> DerivedAngles:
    """Compute angles, pole and precession rates from one trajectory at given times.

    They are the joined `derived_blocks`.

    Parameters
    ----------
    path : AxisTrajectory
    setting : AxisInputs
        Setting of the trajectory.
    times : ndarray, shape (n,)
        s.
    fixed : ndarray, shape (3, 3)
        Orbit and equinox of J2000.0 in the GCRS.
    orbits : ndarray, shape (n + 1,)
        Unwrapped longitude of perihelion in these axes at the times and at J2000.0, rad, of the
        nominal orbit.
    """
    blocks = [*derived_blocks(path, setting, times, fixed, orbits)]
    values = _joined(block.values for block in blocks)
    pole, normal = (
        np.concatenate([getattr(block, name) for block in blocks], axis=-1) for name in DIRECTIONS
    )
    return DerivedAngles(values, pole, normal)


def derived_blocks(
    path: AxisTrajectory,
    setting: AxisInputs,
    times: FloatArray,
    fixed: FloatArray,
    orbits: FloatArray,
) -> Iterator[DerivedAngles]:
    """Yield angles, pole and precession rates in successive blocks of epochs.

    The arguments are those of `derive`.
    """
    guide = _unwrapped_turns(path, setting, fixed)
    for block in _blocks(times.size):
        perihelion = np.append(orbits[:-1][block], orbits[-1])
        yield _derived(path, setting, times[block], fixed, perihelion, guide)


def _derived(
    path: AxisTrajectory,
    setting: AxisInputs,
    times: FloatArray,
    fixed: FloatArray,
    orbits: FloatArray,
    guide: tuple[FloatArray, FloatArray],
) -> DerivedAngles:
    """Angles, pole and precession rates at a few times; `guide` is from `_unwrapped_turns`."""
    all_times = np.append(times, 0.0)
    axis = path.at(all_times)
    shape = setting.orbit.at(all_times)
    normal, eccentricity, _ = shape
    n, e, normal_rate = (broadcast_over_members(axis, vector) for vector in shape)
    season = seasons(axis, n, e)
    nodes, unwrapped = guide
    nearest = np.searchsorted((nodes[1:] + nodes[:-1]) / 2, all_times)
    general, psi = followed(_turns(axis, n, fixed), unwrapped[..., nearest])
    # perihelion from the moving equinox is orbital perihelion plus precession, apart from the tilt
    perihelion = np.arctan2(season.climatic_precession, season.coprecession)
    perihelion = followed(perihelion, orbits + general)
    perihelion -= _TURN * np.floor(perihelion[..., -1:] / _TURN)
    e2 = np.sum(eccentricity**2, axis=0)
    precession = setting.precession
    sun_constant = replace(precession, moon=0.0).constant(all_times, e2)
    moon_constant = precession.constant(all_times, e2) - sun_constant
    sun = sun_constant * dot(n, axis)
    moon = moon_constant * moon_rate_factor((n, e, normal_rate), axis, precession.node_rate)
    values = {
        "obliquity": season.obliquity,
        "longitude_of_perihelion": perihelion,
        "general_precession": general,
        "psi_A": psi,
        "omega_A": np.arccos(np.clip(dot(fixed[2], axis), -1.0, 1.0)),
        "eccentricity": np.sqrt(e2),
        "climatic_precession": season.climatic_precession,
        "coprecession": season.coprecession,
        "sun": sun,
        "moon": moon,
        "total": sun + moon - precession.geodesic_rate(e2),
    }
    at_times = {name: value[..., :-1] for name, value in values.items()}
    return DerivedAngles(at_times, axis[..., :-1], normal[:, :-1])


def _unwrapped_turns(
    path: AxisTrajectory, setting: AxisInputs, fixed: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Times of the nodes of a trajectory, and p_A and psi_A there with whole turns counted, rad.

    The nodes are close enough to unwrap precession.
    """
    nodes = np.sort(np.append(path.windows.times.ravel(), 0.0))
    turns = []
    for block in _blocks(nodes.size):
        axis, (normal, _, _) = path.at(nodes[block]), setting.orbit.at(nodes[block])
        turns.append(_turns(axis, broadcast_over_members(axis, normal), fixed))
    unwrapped = np.unwrap(np.concatenate(turns, axis=-1))
    now_index = int(np.searchsorted(nodes, 0.0))
    unwrapped -= _TURN * np.rint(unwrapped[..., now_index : now_index + 1] / _TURN)
    return nodes, unwrapped


def _turns(axis: FloatArray, normal: FloatArray, fixed: FloatArray) -> FloatArray:
    """Precession angles p_A and psi_A at given times, without whole turns, rad.

    The shape is (2, ..., n).
    """
    pole, ecliptic = (np.stack([dot(row, v) for row in fixed], axis=-1) for v in (axis, normal))
    psi = np.arctan2(pole[..., 0], pole[..., 1])
    return np.stack([general_precession(pole, ecliptic), psi])


def followed_perihelion(orbit: ChangingOrbit, times: FloatArray, fixed: FloatArray) -> FloatArray:
    """Longitude of perihelion of the orbit in fixed axes, continuous over many turns, rad."""
    first, last = np.floor(min(times.min(), 0.0) / LOOK), np.ceil(max(times.max(), 0.0) / LOOK)
    samples = np.clip(LOOK * np.arange(first, last + 1), *orbit.coverage)
    angle, sampled = (
        np.concatenate(
            [np.arctan2(*(fixed[:2] @ orbit.at(t[block])[1])[::-1]) for block in _blocks(t.size)]
        )
        for t in (times, samples)
    )
    nearest = np.rint(times / LOOK - first).astype(int)
    return followed(angle, np.unwrap(sampled)[nearest])


def _refuse_upright(obliquity: FloatArray, times: FloatArray) -> None:
    """Raise an error if a spin axis is normal to its orbit, so that no equinox exists."""
    sines = np.sin(obliquity)
    if sines.ndim > 1 and not np.all(sines > NO_EQUINOX):
        raise ApartError("the axis of a member stands upright on the orbit")
    worst = int(np.argmin(sines))
    if not sines.flat[worst] > NO_EQUINOX:
        raise UndefinedError(
            f"the axis stands upright on the orbit {times[worst] / JULIAN_YEAR:.0f} yr from "
            "J2000.0: there is no equinox to count from"
        )

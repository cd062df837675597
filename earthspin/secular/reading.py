"""What is read off a solution: angles, precession and rates, and how far causes move them.

Longitudes are to go on without jumps, and epochs may lie ages apart: between two of them precession
is followed along the nodes of the solution, and the perihelion, which turns fast where an orbit is
all but round, along looks at the orbit alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import JULIAN_YEAR
from earthspin.errors import ApartError, UndefinedError
from earthspin.nutation.angles import followed, general_precession
from earthspin.secular.angles import beside, seasons
from earthspin.secular.budget import Setting, Solved, changed
from earthspin.secular.orbit import Orbit, moons_height
from earthspin.secular.sample import Quantiles, draws
from earthspin.secular.trajectory import Trajectory, solve
from earthspin.torque.quadrupole import dot

FloatArray = NDArray[np.float64]

#: Time between two looks at a perihelion, s: it turns fast where an orbit is all but round, by 1.2
#: rad in 200 years where the Earth's eccentricity is 1.6e-4.
LOOK = 200 * JULIAN_YEAR
#: Sine of the obliquity below which there is no equinox.
NO_EQUINOX = 1e-9
#: Phase error, rad, up to which causes are changed one at a time, and from which on half-widths are
#: quantiles over a sample; in between, weighted means of the two. A million years of the Earth stay
#: below.
LINEAR_TO, SAMPLED_FROM = 0.09, 0.1
#: What depends on the orbit alone, whose changes are small throughout.
OF_THE_ORBIT = ("eccentricity",)
_TURN = 2 * np.pi


@dataclass(frozen=True)
class Read:
    """What is read off one trajectory, or off those of members, which stand before the times.

    Attributes
    ----------
    values : dict of str to ndarray, shape (..., n)
        Angles (rad), eccentricity and its products, and the rates of precession in longitude by
        `sun`, `moon` and in `total` (rad/s).
    pole : ndarray, shape (3, ..., n)
        Unit vector of the spin axis, GCRS.
    normal : ndarray, shape (3, n)
        That of the orbit, which all members share.
    """

    values: dict[str, FloatArray]
    pole: FloatArray
    normal: FloatArray


@dataclass(frozen=True)
class Readings:
    """What is read off the answer, and off it with each cause of an error changed.

    Attributes
    ----------
    mine : Read
    moved : tuple of (str, Read)
        By cause; a cause may stand there more than once, in independent directions.
    weight : ndarray, shape (..., n)
        Weight of the sampled half-widths, from 0 to 1.
    sampled : dict of str to ndarray, shape (..., n)
        Half-widths by name, and that of the `pole` (rad), as quantiles over a sample; empty where
        the weight is 0 throughout.
    """

    mine: Read
    moved: tuple[tuple[str, Read], ...]
    weight: FloatArray | float = 0.0
    sampled: Mapping[str, FloatArray] = field(default_factory=dict)

    def half_width(self, name: str) -> FloatArray:
        """95 % half-width of a value."""
        return self._with_sampled(name, together(self.apart(name)))

    def direction_half_width(self, which: Literal["pole", "normal"]) -> FloatArray:
        """95 % half-width of the direction of the pole, or of the normal of the orbit, rad."""
        return self._with_sampled(which, together(self.poles_apart(which)))

    def _with_sampled(self, name: str, linear: FloatArray) -> FloatArray:
        if name not in self.sampled:
            return linear
        return linear + self.weight * (self.sampled[name] - linear)

    def apart(self, name: str) -> dict[str, FloatArray]:
        """By cause, how far a value of the answer is moved."""
        return _by_cause((cause, moved_by(of, self.mine, name)) for cause, of in self.moved)

    def poles_apart(self, which: Literal["pole", "normal"]) -> dict[str, FloatArray]:
        """By cause, how far the pole, or the normal of the orbit, is moved, rad."""
        mine = getattr(self.mine, which)
        return _by_cause((cause, angle(getattr(of, which), mine)) for cause, of in self.moved)


def moved_by(of: Read, mine: Read, name: str) -> FloatArray:
    """How far a value lies from that of the answer."""
    moved = of.values[name] - mine.values[name]
    if name != "longitude_of_perihelion":
        return moved
    # an orbit that is all but round may pass on the other side of a circle: of how far its
    # perihelion itself is moved, whole turns say nothing
    by_axis = of.values["general_precession"] - mine.values["general_precession"]
    by_orbit = moved - by_axis
    return np.asarray(by_axis + by_orbit - _TURN * np.rint(by_orbit / _TURN))


def angle(of: FloatArray, mine: FloatArray) -> FloatArray:
    """Angle between unit vectors, rad, shape (...) from (3, ...)."""
    half = np.linalg.norm(of - mine, axis=0) / 2
    return np.asarray(2 * np.arcsin(np.minimum(half, 1.0)))


def _by_cause(shares: Iterable[tuple[str, FloatArray]]) -> dict[str, FloatArray]:
    """Shares of like cause as the root of their sum of squares."""
    found: dict[str, FloatArray] = {}
    for cause, share in shares:
        found[cause] = np.hypot(found.get(cause, 0.0), share)
    return found


def together(shares: dict[str, FloatArray]) -> FloatArray:
    """Root of the sum of squares of all causes."""
    return np.sqrt(sum(share**2 for share in shares.values()))


def readings(solved: Solved, times: FloatArray, fixed: FloatArray) -> Readings:
    """Read the answer and each of its changed solutions.

    Parameters
    ----------
    solved : Solved
    times : ndarray, shape (n,)
        s from J2000.0 TDB.
    fixed : ndarray, shape (3, 3)
        Orbit and equinox of J2000.0 in the GCRS.

    Raises
    ------
    UndefinedError
        If the axis stands upright on the orbit at one of the times; an ApartError if that of a
        member does.
    """
    setting = solved.setting
    perihelion = followed_perihelion(setting.orbit, np.append(times, 0.0), fixed)
    mine = read(solved.path, setting, times, fixed, perihelion)
    _refuse_upright(mine.values["obliquity"], times)
    linear = Readings(
        mine,
        tuple(
            (cause, read(path, of, times, fixed, perihelion)) for cause, path, of in solved.others
        ),
    )
    phase = phase_error(solved, times)
    weight = np.clip((phase - LINEAR_TO) / (SAMPLED_FROM - LINEAR_TO), 0.0, 1.0)
    if not np.any(weight > 0):
        return linear
    return replace(linear, weight=weight, sampled=_sampled(solved, mine, times, fixed, perihelion))


def phase_error(solved: Solved, times: FloatArray) -> FloatArray:
    """Largest phase error between J2000.0 and some times, rad, shape (..., n).

    It is the half-width of the axis over the sine of its obliquity. It may shrink again, as that of
    Mars does, but changes are no longer proportional to their causes after it was large.
    """
    edges = solved.path.windows.edges
    axis = solved.path.at(edges)
    normal = beside(axis, solved.setting.orbit.at(edges)[0])
    sine = np.maximum(np.linalg.norm(np.cross(axis, normal, axis=0), axis=0), NO_EQUINOX)
    squares = sum(angle(path.at(edges), axis) ** 2 for _, path, _ in solved.others)
    error = np.sqrt(squares) / sine
    past, future = edges <= 0, edges >= 0
    error[..., future] = np.maximum.accumulate(error[..., future], axis=-1)
    backward = np.maximum.accumulate(error[..., past][..., ::-1], axis=-1)
    error[..., past] = backward[..., ::-1]
    after = np.clip(np.searchsorted(edges, times), 1, len(edges) - 1)
    share = (times - edges[after - 1]) / (edges[after] - edges[after - 1])
    return np.asarray(error[..., after - 1] * (1 - share) + error[..., after] * share)


def _sampled(
    solved: Solved, mine: Read, times: FloatArray, fixed: FloatArray, perihelion: FloatArray
) -> dict[str, FloatArray]:
    """95 % quantiles of the distances of a sample from the answer, by name, and of the pole's."""
    names = [name for name in mine.values if name not in OF_THE_ORBIT]
    span, quantiles = (float(times.min()), float(times.max())), Quantiles()
    for amounts in draws(len(solved.uncertainty.causes)):
        of = changed(solved.setting, solved.uncertainty, amounts)
        path = solve(of.strength, of.orbit, of.start, span)
        member = read(path, of, times, fixed, perihelion)
        distances = {name: moved_by(member, mine, name) for name in names}
        quantiles.add(distances | {"pole": angle(member.pole, mine.pole)})
    return quantiles.at_probability()


def read(
    path: Trajectory, setting: Setting, times: FloatArray, fixed: FloatArray, orbits: FloatArray
) -> Read:
    """Angles, precession and rates at some times.

    Parameters
    ----------
    path : Trajectory
    setting : Setting
        That it was solved with.
    times : ndarray, shape (n,)
        s.
    fixed : ndarray, shape (3, 3)
        Orbit and equinox of J2000.0 in the GCRS.
    orbits : ndarray, shape (n + 1,)
        Longitude of perihelion in those axes at the times and at J2000.0, rad, without jumps: that
        of the orbit, or of the one that it was moved from.
    """
    with_now = np.append(times, 0.0)
    axis = path.at(with_now)
    shape = setting.orbit.at(with_now)
    normal, eccentricity, _ = shape
    n, e, turning = (beside(axis, of) for of in shape)
    of = seasons(axis, n, e)
    general, psi = _followed_precession(path, setting, with_now, fixed, _turns(axis, n, fixed))
    # perihelion from the moving equinox is that of the orbit and precession, but for its tilt
    perihelion = np.arctan2(of.climatic_precession, of.coprecession)
    perihelion = followed(perihelion, orbits + general)
    perihelion -= _TURN * np.floor(perihelion[..., -1:] / _TURN)
    e2 = np.sum(eccentricity**2, axis=0)
    strength = setting.strength
    by_sun = replace(strength, moon=0.0).constant(with_now, e2)
    by_moon = strength.constant(with_now, e2) - by_sun
    sun = by_sun * dot(n, axis)
    moon = by_moon * moons_height((n, e, turning), axis, strength.node_rate)
    values = {
        "obliquity": of.obliquity,
        "longitude_of_perihelion": perihelion,
        "general_precession": general,
        "psi_A": psi,
        "omega_A": np.arccos(np.clip(dot(fixed[2], axis), -1.0, 1.0)),
        "eccentricity": np.sqrt(e2),
        "climatic_precession": of.climatic_precession,
        "coprecession": of.coprecession,
        "sun": sun,
        "moon": moon,
        "total": sun + moon - strength.geodesic_rate(e2),
    }
    told = {name: of[..., :-1] for name, of in values.items()}
    return Read(told, axis[..., :-1], normal[:, :-1])


def _followed_precession(
    path: Trajectory, setting: Setting, times: FloatArray, fixed: FloatArray, angles: FloatArray
) -> FloatArray:
    """p_A and psi_A at times without jumps, rad, from J2000.0 on."""
    # along the nodes, which are close enough to follow precession from one to the next
    nodes = np.sort(np.append(path.windows.times.ravel(), 0.0))
    axis = path.at(nodes)
    coarse = np.unwrap(_turns(axis, beside(axis, setting.orbit.at(nodes)[0]), fixed))
    origin = int(np.searchsorted(nodes, 0.0))
    coarse -= _TURN * np.rint(coarse[..., origin : origin + 1] / _TURN)
    nearest = np.searchsorted((nodes[1:] + nodes[:-1]) / 2, times)
    return followed(angles, coarse[..., nearest])


def _turns(axis: FloatArray, normal: FloatArray, fixed: FloatArray) -> FloatArray:
    """p_A and psi_A in any turn, rad, shape (2, ..., n)."""
    pole, ecliptic = (np.stack([dot(row, of) for row in fixed], axis=-1) for of in (axis, normal))
    psi = np.arctan2(pole[..., 0], pole[..., 1])
    return np.stack([general_precession(pole, ecliptic), psi])


def followed_perihelion(orbit: Orbit, times: FloatArray, fixed: FloatArray) -> FloatArray:
    """Longitude of perihelion in fixed axes without jumps, rad, of the orbit alone."""
    first, last = np.floor(min(times.min(), 0.0) / LOOK), np.ceil(max(times.max(), 0.0) / LOOK)
    looks = np.clip(LOOK * np.arange(first, last + 1), *orbit.coverage)
    angle, coarse = (np.arctan2(*(fixed[:2] @ orbit.at(at)[1])[::-1]) for at in (times, looks))
    nearest = np.rint(times / LOOK - first).astype(int)
    return followed(angle, np.unwrap(coarse)[nearest])


def _refuse_upright(obliquity: FloatArray, times: FloatArray) -> None:
    """Without an equinox there is no longitude."""
    sines = np.sin(obliquity)
    if sines.ndim > 1 and not np.all(sines > NO_EQUINOX):
        raise ApartError("the axis of a member stands upright on the orbit")
    worst = int(np.argmin(sines))
    if not sines.flat[worst] > NO_EQUINOX:
        raise UndefinedError(
            f"the axis stands upright on the orbit {times[worst] / JULIAN_YEAR:.0f} yr from "
            "J2000.0: there is no equinox to count from"
        )

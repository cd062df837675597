r"""Integrate many spin axes together over millions of years, in a rotating frame.

In a frame that rotates about the mean normal at the precession rate, the axis hardly moves, so
steps of four thousand years suffice. All members are in one array, and every stage of the method of
Dormand and Prince (order 8, scipy's `DOP853`) is a few operations on whole rows. All members have
the same orbit, but individual constants, tides, figures and starts.

Method and frame differ from those of `trajectory`, so each checks the other.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import DOP853

from earthspin.constants import JULIAN_YEAR
from earthspin.errors import UndefinedError
from earthspin.secular.orbit import Orbit, pull, reference_axes
from earthspin.secular.strength import Strength, Tides

FloatArray = NDArray[np.float64]

#: Step, s: the error is 0.03 arcsec over a million years (docs/long_term.md).
STEP = 4000 * JULIAN_YEAR
#: Members are padded to a multiple of this, so that rounding does not depend on their number.
PAD = 64
_STAGES = 12
#: Fraction of a step by which its ends are shifted inwards, because a series of the orbit may end
#: there.
INSIDE = 1e-9
#: Largest relative difference between the precession of a member and that of the frame.
SPREAD = 0.3


def solve_many(
    strength: Strength,
    orbit: Orbit,
    starts: FloatArray,
    times: FloatArray,
    step: float = STEP,
) -> FloatArray:
    """Integrate the spin axes of many ensemble members together, from J2000.0.

    Parameters
    ----------
    strength : Strength
        Numbers, or arrays with one value for each member.
    orbit : Orbit
    starts : ndarray, shape (3, m)
        Unit vectors of the axes at J2000.0, GCRS.
    times : ndarray, shape (n,)
        s, ascending.
    step : float
        Longest step, s.

    Returns
    -------
    ndarray, shape (3, n, m)
        Unit vectors, GCRS.
    """
    members = starts.shape[1]
    axes = np.empty((3, times.size, members))
    width = -(-members // PAD) * PAD
    padded = np.concatenate([starts, np.repeat(starts[:, -1:], width - members, axis=1)], axis=1)
    lanes = _Lanes(_padded(strength, width, members), orbit, padded, times)
    for wanted in (times[times < 0][::-1], times[times >= 0]):
        places = np.searchsorted(times, wanted)
        for place, axis in zip(places, lanes.run(wanted, step), strict=True):
            axes[:, place] = axis[:, :members]
    return axes


def _mean(values: FloatArray) -> float:
    """Mean of a quantity over ensemble members; exact if all members have the same value."""
    return float(values[0] + np.mean(values - values[0]))


def _padded(strength: Strength, width: int, members: int) -> Strength:
    """Precession constants with arrays lengthened to the batch size of the integration.

    The value of the last member is repeated.
    """

    def long(value: FloatArray | float) -> FloatArray:
        row = np.broadcast_to(np.asarray(value, dtype=float), (members,))
        return np.append(row, np.repeat(row[-1:], width - members))

    tides = replace(strength.tides, moon=long(strength.tides.moon), spin=long(strength.tides.spin))
    return replace(
        strength,
        sun=long(strength.sun),
        moon=long(strength.moon),
        ellipticity=long(strength.ellipticity),
        j2_rate=long(strength.j2_rate),
        tides=tides,
    )


class _Lanes:
    """Integrator of the spin axes of many members, in a frame with their mean precession rate."""

    def __init__(
        self, strength: Strength, orbit: Orbit, starts: FloatArray, times: FloatArray
    ) -> None:
        self.strength, self.orbit = strength, orbit
        sampled = np.linspace(min(times[0], 0.0), max(times[-1], 0.0), 101)
        # one lag of the Moon's plane is used for all members: it is an arcsecond, times the Moon's
        # share
        self.mean = replace(
            strength,
            sun=_mean(strength.sun),
            moon=_mean(strength.moon),
            tides=Tides(),
            ellipticity=1.0,
            j2_rate=0.0,
        )
        self.axes = reference_axes(np.mean(orbit.at(sampled)[0], axis=1))
        self.start = self.axes @ starts
        now = np.zeros(1)
        on = pull(strength, orbit.at(now), now)
        turning = -on.constant * (on.axis[:, 0] @ starts)
        self.turn = _mean(turning)
        if np.max(np.abs(turning - self.turn)) > SPREAD * np.max(np.abs(turning)):
            raise UndefinedError(
                "members precess at rates too different for one integration; group "
                "members of similar obliquity"
            )

    def run(self, times: FloatArray, longest: float) -> Iterator[FloatArray]:
        """Yield the unit vectors of all spin axes, in the GCRS, at each time, shape (3, members).

        Members are those of the padded batch. The times are sorted by distance from J2000.0.
        """
        if not times.size or times[-1] == 0.0:
            yield from (self.axes.T @ self.start for _ in times)
            return
        count = math.ceil(abs(times[-1]) / longest)
        step = times[-1] / count
        shares = np.concatenate([DOP853.C, [1.0], DOP853.C_EXTRA])
        inside = shares * (1 - 2 * INSIDE) + INSIDE
        state, due = self.start, 0
        stages = np.empty((shares.size, *state.shape))
        flat = stages.reshape(shares.size, -1)

        def sum_of(weights: FloatArray) -> FloatArray:
            return np.asarray(step * (weights @ flat[: weights.shape[-1]])).reshape(
                -1, *state.shape
            )

        for number in range(count):
            begin, end = number * step, (number + 1) * step
            slopes = self._slopes(begin + step * inside)
            for stage in range(_STAGES):
                stages[stage] = slopes(stage, state + sum_of(DOP853.A[stage, :stage])[0])
            change = sum_of(DOP853.B)[0]
            wanted = int(np.count_nonzero(np.abs(times[due:]) <= abs(end) * (1 + 1e-12)))
            if wanted:
                stages[_STAGES] = slopes(_STAGES, state + change)
                for stage, weights in enumerate(DOP853.A_EXTRA, _STAGES + 1):
                    stages[stage] = slopes(stage, state + sum_of(weights[:stage])[0])
                rise, fall = step * stages[0], step * stages[_STAGES]
                terms = [change, rise - change, 2 * change - rise - fall, *sum_of(DOP853.D)]
                for time in times[due : due + wanted]:
                    u = state + _between((time - begin) / step, terms)
                    yield self._still(u / np.sqrt(np.sum(u * u, axis=0)), time)
                due += wanted
            state = state + change

    def _still(self, u: FloatArray, time: float) -> FloatArray:
        """Transform spin axes from the rotating frame of the integration to the GCRS."""
        c, s = math.cos(self.turn * time), math.sin(self.turn * time)
        return np.asarray(self.axes.T @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ u)

    def _slopes(self, times: FloatArray) -> Callable[[int, FloatArray], FloatArray]:
        """Make the function for the rates of change of all spin axes in the rotating frame.

        There is one spin axis for each ensemble member. The arguments of the function are the
        index of a time and the axes.
        """
        normal, eccentricity, turning = self.orbit.at(times)
        e2 = np.sum(eccentricity**2, axis=0)
        constant = self.strength.constant(times[:, np.newaxis], e2[:, np.newaxis])
        on = pull(self.mean, (normal, eccentricity, turning), times)
        c, s = np.cos(self.turn * times), np.sin(self.turn * times)

        def turned(vector: FloatArray) -> FloatArray:
            x, y, z = self.axes @ vector
            return np.stack([c * x + s * y, c * y - s * x, z])

        axis, drift = turned(on.axis), turned(on.geodesic)
        drift[2] -= self.turn
        rows = np.concatenate([_crossing(drift), _crossing(axis), axis[np.newaxis]])

        def slope(which: int, u: FloatArray) -> FloatArray:
            out = np.ascontiguousarray(rows[:, :, which]) @ u
            return np.asarray(out[:3] - constant[which] * out[6] * out[3:6])

        return slope


def _crossing(vector: FloatArray) -> FloatArray:
    """Matrices that form the cross product with given vectors, shape (3, 3, n)."""
    x, y, z = vector
    nought = np.zeros_like(x)
    return np.stack([[nought, -z, y], [z, nought, -x], [-y, x, nought]])


def _between(x: float, terms: Sequence[FloatArray]) -> FloatArray:
    """Interpolate spin axes within one time step (Hairer, Norsett & Wanner 1993, II.6).

    The argument is the fraction of the step; the order is 7.
    """
    u = np.zeros_like(terms[0])
    for number, term in enumerate(reversed(terms)):
        u += term
        u *= x if number % 2 == 0 else 1 - x
    return u

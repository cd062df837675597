"""Full attitude of a rigid body in time, with its error, by numerical integration.

Each motion is integrated twice, with two window lengths. Halving a window of n nodes divides the
error by about 2^2n, so the difference of the two solutions bounds the error of the second one; in a
chaotic motion it grows like any error. The effect of an uncertain number is the difference from a
neighbour in which this number is changed.

Windows of a body that spins near a principal axis are solved together. Other windows are solved in
succession and in two forms: Euler's equations along the body's axes in the long windows, and the
angular momentum along the sky's axes in windows of half the length.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from earthspin.motion.equations import (
    FLATTENING,
    ROUNDING,
    START,
    TIDE,
    TRIAXIALITY,
    CustomTorque,
    Rigid,
)
from earthspin.motion.forces import BodyTorque, Forces, Torque, equatorial_basis
from earthspin.motion.march import CONVERGED, FINEST, ORDER, Masses, Piece, Solver, subdivided
from earthspin.motion.together import Together
from earthspin.numerics import polynomials, rotations
from earthspin.numerics.arrays import FloatArray
from earthspin.torque.gravity import apply

# --- bodies and their neighbours ------------------------------------------------------------------
# A neighbour is the same body with one uncertain number changed by its half-width. The difference
# of its motion is the effect of this uncertainty. All are integrated together with the same masses.


def rigid_bodies(
    forces: Forces,
    unit: float,
    errors: Mapping[str, float],
    epoch: float = 0.0,
    custom_torque: CustomTorque | None = None,
) -> tuple[Rigid, tuple[str, ...]]:
    """Make a rigid body, and copies of it that each have one uncertain input changed.

    Parameters
    ----------
    forces : Forces
        Forces with the figure of the body and the effects that are switched on.
    unit : float
        Unit of spin, rad/s.
    errors : mapping of str to float
        Relative half-widths by `FLATTENING`, `TRIAXIALITY`, `TIDE` (errors of positions),
        `ROUNDING` (rounding of positions) and `START`; an input with zero has no neighbour.
    epoch : float
        Start of the motion, s from J2000.0.
    custom_torque : callable or None
        Custom torque.

    Returns
    -------
    Rigid
        The body in the first column, and its neighbours.
    tuple of str
        Input that is changed in each further column.
    """
    figure = forces.figure
    names = (FLATTENING, TRIAXIALITY, TIDE, ROUNDING, START)
    changed = tuple(name for name in names if errors.get(name, 0.0) > 0.0)
    factor = {
        name: np.where([False, *(name == other for other in changed)], 1 + errors.get(name, 0), 1.0)
        for name in names
    }
    # J2 and (B - A)/(M a2) are divided by C/(M a2) = J2/H, so both differences scale with H.
    h = figure.h * factor[FLATTENING]
    triaxiality = figure.triaxiality * factor[FLATTENING] * factor[TRIAXIALITY]
    body = Rigid(
        c_minus_a=h + triaxiality / 2,
        c_minus_b=h - triaxiality / 2,
        tide=factor[TIDE] * factor[ROUNDING],
        unit=unit,
        zonal=[(n, j * figure.inverse_polar_moment) for n, j in figure.zonal.items()],
        radius=figure.radius,
        trend=figure.j2_trend,
        epoch=epoch,
        custom_torque=custom_torque,
        core=forces.core,
    )
    return body, changed


def masses(forces: Forces, epoch: float = 0.0) -> Masses:
    """Convert `Forces` to the `Masses` of the attitude solver, with times counted from `epoch`."""

    def laws_of(torques: Sequence[Torque | BodyTorque]) -> Any:
        def laws(window: polynomials.Windows, places: Mapping[str, FloatArray]) -> list[Any]:
            sky_windows = polynomials.Windows(window.edges + epoch, window.order)
            return [torque(forces, sky_windows, places) for torque in torques]

        return laws if torques else None

    near = {name: gm for name, gm in forces.gm.items() if name in forces.near}
    return Masses(
        gm=near | dict(forces.gm),
        positions=lambda times: forces.positions(times + epoch),
        near=len(near),
        laws=laws_of(forces.torques),
        body_torques=laws_of(forces.body_torques),
        inertia_changes=laws_of(forces.inertia_changes),
    )


def relative_tide_error(distance: float, distance_error: float, angle_error: float) -> float:
    """Bound on the relative error of a tide GM/r3 due to errors of the perturber's position.

    Parameters
    ----------
    distance, distance_error : float
        Distance and its error, m.
    angle_error : float
        Error of the direction, rad; the relative error of the tide is at most twice this.
    """
    return 3 * distance_error / distance + 2 * angle_error


def upright(axis: FloatArray, angle: float) -> FloatArray:
    """Attitude quaternion of a body from its third axis and the rotation angle about this axis.

    Parameters
    ----------
    axis : ndarray, shape (3,)
        Third axis of the body, a unit vector along the sky's axes.
    angle : float
        Angle from the sky's x axis, projected on the equator, to the body's first axis, rad.

    Returns
    -------
    ndarray, shape (4,)
    """
    from scipy.spatial.transform import Rotation

    towards_x, across_x = equatorial_basis(axis)
    x = math.cos(angle) * towards_x + math.sin(angle) * across_x
    frame = Rotation.from_matrix(np.stack([x, np.cross(axis, x), axis], axis=1))
    return np.asarray(frame.as_quat(scalar_first=True))


# --- solutions ------------------------------------------------------------------------------------

#: Shortest span that is integrated, s.
SHORTEST = 1e-6
#: Span in which tides at the start are taken from the first node, with the speed of the mass, s.
_INSTANT = 60.0
#: Convergence of the half windows, as a fraction of the tolerance. Their iteration starts from the
#: other solution and must become independent of it: with 1e-2, errors were up to three times the
#: claimed ones.
_FINE = 1e-4 * CONVERGED
_EPS = float(np.finfo(float).eps)
#: Safety factor: the claimed error is twice the difference of the two solutions, since the rounding
#: errors of both may be similar.
TWICE = 2.0
#: Largest tolerance, for which windows are shorter than a rotation.
COARSEST = 1e-6
#: Quantities with errors: attitude, rad; angular velocity, rad/s; angular momentum, C u.
KINDS = ("attitude", "omega", "angular_momentum")
#: Number of times in each full window at which errors are evaluated.
_SAMPLES = 4
#: Largest number of batches of successive windows before windows are tried together again.
_LONGEST_WAIT = 63


@dataclass(frozen=True)
class State:
    """Angular momentum, attitude and spin of several bodies at one time, one column per body.

    Attributes
    ----------
    momentum : ndarray, shape (3, bodies)
        Angular momentum along the body's axes, in units of C u.
    attitude : ndarray, shape (4, bodies)
        Unit quaternion (w, x, y, z) from the axes of the body to those of the sky.
    spin : ndarray, shape (3, bodies)
        Angular velocity along the body's axes, rad/s.
    core : ndarray, shape (0, bodies) or (3, bodies)
        Angular momentum of a fluid core along the sky's axes, in units of C u.
    """

    momentum: FloatArray
    attitude: FloatArray
    spin: FloatArray
    core: FloatArray

    def turned_last(self, rotation: FloatArray, spin: float) -> State:
        """Return the state with another attitude and spin in the last column, the first state.

        Parameters
        ----------
        rotation : ndarray, shape (3,)
            Rotation vector along the axes of the body, rad.
        spin : float
            Relative change of the angular velocity.
        """
        turned = replace(
            self, **{name: getattr(self, name).copy() for name in ("momentum", "attitude", "spin")}
        )
        ahead = rotations.rotation_about(rotation[:, np.newaxis], np.ones(1))
        turned.attitude[:, -1:] = rotations.times(self.attitude[:, -1:], ahead)
        turned.spin[:, -1] *= 1 + spin
        turned.momentum[:, -1] *= 1 + spin
        return turned


@dataclass(frozen=True)
class RotationSeries:
    """Angular momentum, attitude and angular velocity of a body at given times, with errors.

    Attributes
    ----------
    momentum : ndarray, shape (t, 3)
        Angular momentum along the sky's axes, in units of C u.
    attitude : ndarray, shape (t, 4)
        Unit quaternion from the axes of the body to those of the sky.
    omega : ndarray, shape (t, 3)
        Angular velocity along the body's axes, rad/s.
    core : ndarray, shape (t, 0) or (t, 3)
        Angular momentum of a fluid core along the sky's axes, in units of C u.
    error : ndarray, shape (causes, 3, t)
        Largest errors up to each time, by `KINDS`: first of the method, then the differences from
        the neighbour in each further column.
    """

    momentum: FloatArray
    attitude: FloatArray
    omega: FloatArray
    core: FloatArray
    error: FloatArray


def start_of(
    body: Rigid, attitude: FloatArray, omega: FloatArray, masses: Masses | None = None
) -> State:
    """Make the initial state of all bodies, with the same attitude and angular velocity.

    Parameters
    ----------
    body : Rigid
    masses : Masses, optional
        Masses with the changes of the products of inertia, which are part of the angular momentum.
    attitude : ndarray, shape (4,)
        Quaternion from the body's axes to the sky's; it is normalized.
    omega : ndarray, shape (3,)
        Angular velocity along the body's axes, rad/s.
    """
    spin = np.repeat(omega[:, np.newaxis], body.count, axis=1)
    q = np.repeat((attitude / np.linalg.norm(attitude))[:, np.newaxis], body.count, axis=1)
    momentum = body.mantle_moments * spin / body.unit
    if masses is not None and masses.inertia_changes is not None:
        momentum = momentum + apply(_first_inertia_change(masses, q, spin), spin) / body.unit
    if body.core is None:
        return State(momentum, q, spin, np.zeros((0, body.count)))
    core_spin = spin
    if body.core.spin is not None:
        along_sky = np.repeat(body.core.spin[:, np.newaxis], body.count, axis=1)
        core_spin = rotations.rotated(rotations.conjugate(q), along_sky)
    core = body.core.moments * core_spin / body.unit
    return State(momentum + core, q, spin, rotations.rotated(q, core))


def _first_inertia_change(masses: Masses, q: FloatArray, spin: FloatArray) -> FloatArray:
    """Changes of the products of inertia at the start, divided by C, shape (6, bodies)."""
    window = polynomials.Windows(np.array([0.0, _INSTANT]), 4)
    (at_start,) = masses.over(window)
    matrix = np.repeat(rotations.matrices(q)[..., np.newaxis], window.order, axis=-1)
    spins = np.repeat(spin[..., np.newaxis], window.order, axis=-1)
    total = sum(law(matrix, spins) for law in at_start.inertia_changes)
    return np.asarray(total)[..., 0]


class AttitudeIntegrator:
    """Rotation of a body, integrated window by window; past time windows are discarded.

    Parameters
    ----------
    body : Rigid
        The body, and in further columns its neighbours with one uncertain number changed.
    masses : Masses
    start : State
    end : float
        Last time, s from the start.
    tolerance : float
        Largest relative size of the last terms in the long windows.

    Raises
    ------
    UndefinedError
        If the motion changes too fast, so that windows become too short.
    """

    def __init__(
        self,
        body: Rigid,
        masses: Masses,
        start: State,
        end: float,
        *,
        tolerance: float = FINEST,
    ) -> None:
        self._body, self._masses, self._start = body, masses, start
        self._end = max(end, SHORTEST)
        self._tolerance = tolerance
        self._restart()

    def _restart(self) -> None:
        start, body, masses, tolerance = self._start, self._body, self._masses, self._tolerance
        self._fine = Solver(body, masses, True, tolerance, converged=_FINE)
        self._coarse = Solver(body.first(), masses, False, tolerance)
        self._together = Together(body, masses, tolerance, self._end)
        self._coarse.begin_with(start.spin)
        speed = float(np.max(np.sqrt(np.sum(start.spin**2, axis=0))))
        self._rounding = _EPS * speed * self._end
        momentum = rotations.rotated(start.attitude, start.momentum)
        self._solutions = self._march(np.concatenate([momentum, start.attitude, start.core]))
        self._solution: tuple[Piece, Piece] | None = None
        self._last_time = 0.0
        self._largest_errors = np.zeros((body.count, len(KINDS), 1))

    @property
    def evaluations(self) -> int:
        """Number of evaluations of the rates at nodes so far, in both solutions together."""
        in_succession = ORDER * (self._fine.evaluations + self._coarse.evaluations)
        return in_succession + self._together.evaluations

    def _march(self, halves: FloatArray) -> Iterator[tuple[Piece, Piece]]:
        """Yield two solutions of each batch of windows: with full and with half windows."""
        full, time, wait, batches = halves[:, :1], 0.0, 0, 0
        while time < self._end:
            if batches == 0:
                pair = self._together.solve(time, full, halves)
                batches = wait = 0 if pair else min(2 * wait + 1, _LONGEST_WAIT)
            else:
                pair = self._in_succession(time, full, halves)
                batches -= 1
            if pair is not None:
                yield pair
                full, halves, time = pair[0].end, pair[1].end, float(pair[0].edges[-1])
                if not pair[0].in_space:
                    momentum = rotations.rotated(full[3:7], full[:3])
                    full = np.concatenate([momentum, full[3:]])

    def _in_succession(
        self, time: float, full: FloatArray, halves: FloatArray
    ) -> tuple[Piece, Piece] | None:
        """Solve windows in succession; return None if they must be shorter."""
        momentum = rotations.rotated(rotations.conjugate(full[3:7]), full[:3])
        start = np.concatenate([momentum, full[3:]])
        solution = self._coarse.integrate(self._coarse.next_edges(time, self._end), start)
        if len(solution.edges) < 2:
            return None
        halved = self._fine.integrate(subdivided(solution.edges, 2), halves, solution)
        if halved.edges[-1] < solution.edges[-1]:
            self._coarse.window /= 2
            return None
        return solution, halved

    def at(self, times: FloatArray, hook: Callable[[float], None] | None = None) -> RotationSeries:
        """Angular momentum, attitude and angular velocity at given times, with errors.

        Parameters
        ----------
        times : ndarray, shape (t,)
            Ascending times from the start, s. If the first one is before the last time of an
            earlier call, the integration is restarted.
        hook : callable, optional
            Function that is called with the time reached, s, after each batch of windows.

        Returns
        -------
        RotationSeries
        """
        if times[0] < self._last_time:
            self._restart()
        self._last_time = float(times[-1])
        states, spins, errors, computed = [], [], [], 0
        while computed < times.size:
            if self._solution is None or times[computed] > self._solution[1].edges[-1]:
                self._solution = next(self._solutions)
                self._sample_errors()
                if hook is not None:
                    hook(float(self._solution[1].edges[-1]))
            next_index = int(np.searchsorted(times, self._solution[1].edges[-1], side="right"))
            part_times = times[computed:next_index]
            last = np.clip(np.searchsorted(self._sample_times, part_times) - 1, 0, None)
            state, error = self._state_and_errors(part_times)
            states.append(state)
            spins.append(self._spin(part_times, state))
            errors.append(np.maximum(self._largest_errors[..., last], error))
            computed = next_index
        state = np.concatenate(states, axis=1)
        return RotationSeries(
            momentum=state[:3].T,
            attitude=state[3:7].T,
            omega=np.concatenate(spins, axis=1).T,
            core=state[7:].T,
            error=np.concatenate(errors, axis=2),
        )

    def _spin(self, times: FloatArray, state: FloatArray) -> FloatArray:
        """Angular velocity of the body at given times, rad/s, shape (3, t)."""
        if self._masses.inertia_changes is None:
            return self._body.first().spin(state)
        assert self._solution is not None
        return self._solution[1].spin(times)

    def _sample_errors(self) -> None:
        """Set the largest errors until each of several times in each window of the solution."""
        assert self._solution is not None
        self._sample_times = subdivided(self._solution[0].edges, _SAMPLES)
        errors = np.maximum.accumulate(self._state_and_errors(self._sample_times)[1], axis=2)
        self._largest_errors = np.maximum(errors, self._largest_errors[..., -1:])

    def _state_and_errors(self, times: FloatArray) -> tuple[FloatArray, FloatArray]:
        """State of the body at given times, and errors of attitude, spin and angular momentum.

        The errors have the shape (causes, kinds, t): the first row has the error of the method,
        each other row that of one uncertain input.
        """
        assert self._solution is not None
        coarse, fine = self._solution
        states = fine.at(times)
        coarse_states = coarse.along_sky(times)
        method = TWICE * differences(self._body.first(), states[:, 0], coarse_states)
        method += np.array([self._rounding + _EPS] + [0.0] * 2)[:, np.newaxis]
        input_errors = [
            differences(self._body, states[:, 0], states[:, column])
            for column in range(1, states.shape[1])
        ]
        return states[:, 0].copy(), np.stack([method, *input_errors])


def shares_of(
    series: RotationSeries,
    changed: Sequence[str],
    tide_error: float,
    first_errors: Sequence[float] = (0.0, 0.0, 0.0),
    direction_errors: FloatArray | float = 0.0,
) -> dict[str, FloatArray]:
    """Errors of a rotation due to method, inputs and kernel, and in total, shape (3, t).

    Parameters
    ----------
    series : RotationSeries
    changed : sequence of str
        Input that is changed in each further column.
    tide_error : float
        Relative error of the tides; NaN if it was not measured.
    first_errors : sequence of float
        Errors of the first state that stay so in time, by `KINDS`: rad, rad/s, C u.
    direction_errors : ndarray, shape (3, t)
        Errors due to the directions of the masses.

    Returns
    -------
    dict of str to ndarray
        Errors ``method``, ``input`` and ``kernel``, and the total under an empty name; an angle is
        at most pi.
    """
    zero = np.zeros_like(series.error[0])
    by_name = dict(zip(changed, series.error[1:], strict=True))
    kernel = np.full_like(zero, np.nan) if np.isnan(tide_error) else by_name.get(TIDE, zero)
    kernel = np.hypot(kernel, direction_errors)
    inputs = np.hypot(by_name.get(FLATTENING, zero), by_name.get(TRIAXIALITY, zero))
    inputs = np.hypot(inputs, by_name.get(START, zero))
    inputs = np.hypot(inputs, np.reshape(first_errors, (3, 1)))
    method = series.error[0] + by_name.get(ROUNDING, zero)
    shares = {"method": method, "input": inputs, "kernel": kernel}
    shares[""] = np.sqrt(shares["method"] ** 2 + inputs**2 + kernel**2)
    for share in shares.values():
        share[0] = np.minimum(share[0], np.pi)
    return shares


def differences(body: Rigid, state: FloatArray, other: FloatArray) -> FloatArray:
    """Differences of two rotations in attitude (angle), spin and angular momentum (norms).

    Parameters
    ----------
    body : Rigid
        Only the first body is used.
    state, other : ndarray, shape (7, t)
        Angular momentum along the sky's axes, in units of C u, and attitude.

    Returns
    -------
    ndarray, shape (3, t)
        Differences by `KINDS`: rad, rad/s, C u.
    """
    spin = body.first().spin(state) - body.first().spin(other)
    momentum = state[:3] - other[:3]
    angle = rotations.angle_between(state[3:7], other[3:7])
    return np.stack([angle, np.linalg.norm(spin, axis=0), np.linalg.norm(momentum, axis=0)])

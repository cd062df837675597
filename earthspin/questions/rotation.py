"""Attitude of a rigid body in time, at any spin and under any torque."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

from earthspin.bodies import BODIES, Body, checks, planets
from earthspin.constants import DAY, NORMAL_95
from earthspin.dates import Epochs, Span, Step, TimeList, datetime64
from earthspin.engine import Block, Neglected, key, part, public_call
from earthspin.engine.variables import Variable, labels, number, words
from earthspin.errors import SceneError
from earthspin.mass.figure import polar_moment
from earthspin.motion import effect_sizes, march, solution
from earthspin.motion.attitude_effects import (
    ALL_EFFECTS,
    ATTITUDE_EFFECTS,
    FLATTENED_PERTURBER,
    FLUID_CORE,
    TIDES,
)
from earthspin.motion.effects import NONRIGID, SECOND_ORDER
from earthspin.motion.equations import FLATTENING, ROUNDING, START, TIDE, TRIAXIALITY, Rigid
from earthspin.motion.forces import Forces
from earthspin.motion.solution import COARSEST, KINDS, AttitudeIntegrator, RotationSeries, State
from earthspin.numerics.arrays import FloatArray
from earthspin.progress import up_to
from earthspin.questions import effects_and_torques, first_attitude
from earthspin.questions.effects_and_torques import (
    Attractors,
    AxisMotion,
    CustomTorque,
    EffectNames,
    forces_of,
)
from earthspin.questions.first_attitude import FirstState, first_state
from earthspin.questions.moon_start import with_core
from earthspin.questions.satellites import (
    largest_displacements,
    no_satellites,
    node_nutations,
    obliquity_of,
)
from earthspin.questions.sky import Sky
from earthspin.questions.time_axes import SPAN_DOC, Dated, days_of
from earthspin.sky.elements import ByElements, Elements
from earthspin.sky.sources import SourceName
from earthspin.units import Number, Numbers, Word

if TYPE_CHECKING:
    from earthspin.motion.divergence import Divergence

#: Largest difference from 1 of the length of a unit quaternion.
_LENGTH = 1e-6
#: Largest relative difference of the periods of spin and orbit in synchronous rotation.
_SYNCHRONOUS = 1e-3
#: Time to follow a body through one turn, s (measured: 2.6e-3 to 5e-3 if it tumbles, 3e-4 if it
#: spins near a principal axis), and most turns that are followed at once: at most about an hour.
SECONDS_PER_TURN, MOST_TURNS = 4e-3, 1e6


class Rotation(AxisMotion, word="rotation", call="rotation", positional=("start", "stop", "step")):
    """Attitude and spin of a rigid body, without averaging (source text, I.2, I.4, I.9.34).

    The body may have any three moments and any spin, and may be locked or tumble. The motion begins
    at the first date, with the pole, prime meridian and spin of the body, or with `start_attitude`
    and `start_omega`; the angle of the Earth about its axis follows from UT1 at that date. The x
    axis of the body is that of least moment; without triaxiality it is the prime meridian. The
    uncertainty of the start is part of all errors. The effects
    `second-order` and `triaxiality` are always included; `nonrigid` is not available.

    Errors are the largest up to that time.

    Examples
    --------
    >>> import earthspin
    >>> slow = earthspin.EARTH.replace(spin_period="10 d")
    >>> turned = earthspin.rotation("2000-01-01", "2000-01-11", "5 d", body=slow)
    >>> print(turned.omega.sel(component="z").round(10).values)
    [7.2722e-06 7.2722e-06 7.2722e-06]
    """

    page, headline = "rotation", "attitude"

    span: Span = key(("2000-01-01T12:00:00", "2000-02-01T12:00:00"), doc=SPAN_DOC)
    step: Step = key("6 h", doc="interval between dates")
    effects: Annotated[tuple[str, ...], EffectNames(Word(ALL_EFFECTS))] = key(
        "known", doc=effects_and_torques.EFFECTS_DOC
    )
    start_attitude: Annotated[FloatArray, Numbers("", "1", (4,))] | None = key(
        None, doc="quaternion (w, x, y, z), principal axes (C last) to ICRF, at the first date"
    )
    start_omega: Annotated[FloatArray, Numbers("rad/s", "1e-4 rad/s", (3,))] | None = key(
        None, doc="angular velocity along the principal axes, C last, at the first date"
    )
    torque: CustomTorque | None = key(
        None, doc="custom torque: a Python function, along the principal axes, in N m"
    )
    tolerance: Annotated[float, Number("", "1e-10", low=march.FINEST, high=COARSEST)] = key(
        march.FINEST, doc="relative tolerance of the integrator in each of its time windows"
    )

    needs = ("radius", "j2", "dynamical_flattening")
    may_be_alone = True

    def needed(self) -> tuple[str, ...]:
        """Names of the properties that the body must have for the computation.

        Pole and spin are not required if the initial attitude or angular velocity is given.
        """
        pole = () if self.start_attitude is not None else ("pole",)
        spin = () if self.start_omega is not None else ("spin_period",)
        return (*self.needs, *pole, *spin)

    def rigid_effects(self) -> tuple[str, ...]:
        """Names of the effects on a rigid body, with those on its full attitude that are known."""
        not_rigid = TIDES.name, FLUID_CORE.name
        return tuple(name for name in self.known_effects() if name not in not_rigid)

    def known_effects(self) -> tuple[str, ...]:
        """Names of the effects that can be computed, with those of tides and of a fluid core."""
        in_body = known_attitude_effects(self.body, self.perturbers)
        return (*super().rigid_effects(), *in_body)

    def check_spin(self) -> None:
        """Refuse a spin so fast that the body would break up."""
        if self.start_omega is None:
            super().check_spin()
        elif self.start_omega.any():
            checks.refuse_break_up(_spinning(self.body.replace(spin_period=None), self.start_omega))

    @property
    def unused(self) -> str:
        """Text that names neglected satellites; empty if `neglected` estimates their effects."""
        known = self.perturbers and obliquity_of(self.body) is not None
        return "" if known else super().unused

    def check(self) -> None:
        """Refuse the non-rigid effect, H = 0, and an attitude that is not a unit quaternion."""
        super().check()
        if NONRIGID.name in self.effects:
            raise self.error("effects", NONRIGID.name, "the body is rigid here; leave it out")
        if self.body.number("dynamical_flattening") == 0:
            problem = "C does not follow from H = 0; give it some flattening"
            raise self.error("body", self.body.name, problem)
        start = self.start_attitude
        if start is not None and abs(_length(start) - 1) > _LENGTH:
            raise self.error("start_attitude", start.tolist(), "a unit quaternion has length 1")


@dataclass(frozen=True)
class PerturberTorques:
    """Torques of all perturbers, and relative torque error due to errors of perturber positions.

    Attributes
    ----------
    forces : Forces
    relative_error : float
        Relative half-width of the pull from the errors of the positions; NaN if not measured.
    direction_error : float
        Half-width of the direction of the perturber with the largest tide, rad.
    rounding : float
        The same from the rounding of positions that follow from elements, without a kernel.
    no_error : str
        Why some errors are not given; empty if all are.
    """

    forces: Forces
    relative_error: float = 0.0
    direction_error: float = 0.0
    rounding: float = 0.0
    no_error: str = ""


def known_attitude_effects(body: Body, perturbers: tuple[Body, ...]) -> tuple[str, ...]:
    """Names of the effects on the full attitude that are known for a body and its perturbers.

    The flattening of a perturber acts on built-in bodies that are lighter than the perturber.
    """
    idle = {name for name, effect in ATTITUDE_EFFECTS.items() if effect.is_idle(body)}
    if body.known_as not in BODIES or not any(p.j2 and p.gm > body.gm for p in perturbers):
        idle.add(FLATTENED_PERTURBER.name)
    return tuple(name for name in ATTITUDE_EFFECTS if perturbers and name not in idle)


def no_perturbers(perturbers: tuple[Body, ...]) -> str | None:
    """Return the reason (text) to omit torques if there are no perturbers, else None."""
    return None if perturbers else "nothing pulls on the body"


def _length(vector: FloatArray) -> float:
    """Length of a vector; infinite if its square is too large for a float."""
    with np.errstate(over="ignore"):
        return float(np.linalg.norm(vector))


def _spinning(body: Body, start_omega: FloatArray | None) -> Body:
    """Set the spin rate from the initial angular velocity if the body has no spin period."""
    if body.spin_period is not None or start_omega is None:
        return body
    speed = _length(start_omega)
    return body.replace(spin_period=2 * np.pi / speed if speed else 2 * np.pi)


def _acting(effects: tuple[str, ...]) -> tuple[str, ...]:
    """Add triaxiality and the second-order effect to a list of effects, as both always act."""
    return (*effects, TRIAXIALITY, SECOND_ORDER.name)


@part(unless=no_perturbers)
def torques(
    attractors: Attractors,
    epochs: Epochs,
    body: Body,
    effects: tuple[str, ...],
    start_omega: FloatArray | None,
) -> PerturberTorques:
    """Build the torques of all perturbers on the body, and estimate the torque error."""
    days = epochs.span()
    attractors.sky.check_times(days, attractors.targets)
    forces = forces_of(replace(attractors, body=_spinning(body, start_omega)), _acting(effects))
    rounding = 0.0
    if isinstance(attractors.sky.source, Elements):
        places = [p for p in attractors.sky.targets.values() if isinstance(p, ByElements)]
        rounding = max(place.rounding(day) for place in places for day in days)
        if not any(place.is_mean for place in places):
            return PerturberTorques(forces, rounding=rounding)
    positions = attractors.sky.positions(np.array(days[:1]))
    relative_errors, directions = [], []
    for name, place in attractors.sky.targets.items():
        angle, distance_error = attractors.sky.error(place, days)
        distance = float(np.linalg.norm(positions[name]))
        relative_errors.append(solution.relative_tide_error(distance, distance_error, angle))
        directions.append((attractors.gm[name] / distance**3, angle))
    return PerturberTorques(
        forces,
        relative_error=float(np.max(relative_errors)),  # NaN if one is
        direction_error=max(directions)[1],
        rounding=rounding,
        no_error=attractors.sky.no_error,
    )


@dataclass(frozen=True)
class Rotor:
    """Rotating body with its initial state and the torques on it, ready for integration.

    Attributes
    ----------
    body : Rigid
        The body; further lanes are copies of it with one changed input each.
    changed : tuple of str
        Changed input of each copy.
    masses : Masses
    start : State
    first : FirstState
        Attitude and angular velocity at the first date, and their errors.
    begin, end : float
        Days from J2000.0 TDB.
    polar_moment : float
        C, kg m2.
    torques : PerturberTorques
    """

    body: Rigid
    changed: tuple[str, ...]
    masses: march.Masses
    start: State
    first: FirstState
    begin: float
    end: float
    polar_moment: float
    torques: PerturberTorques

    @property
    def duration(self) -> float:
        """Time from the start to the end, s."""
        return float(self.since(self.end))

    def turns(self, seconds: float) -> float:
        """Number of rotations of the body in a given time (s), at its initial spin rate."""
        return float(np.linalg.norm(self.start.spin[:, 0])) * seconds / (2 * np.pi)

    def refuse_many_turns(self, begin: float, end: float) -> None:
        """Refuse a time span (s from the initial date) whose integration would take hours.

        Raises
        ------
        SceneError
            With the time that it would take.
        """
        turns, days = self.turns(end - begin), (end - begin) / DAY
        if turns > MOST_TURNS:
            hours, most = turns * SECONDS_PER_TURN / 3600, days * MOST_TURNS / turns
            problem = f"the body turns {turns:.3g} times, which takes up to {hours:.2g} h to follow"
            raise SceneError("span", f"{days:.6g} d", f"{problem}; give at most {most:.3g} d")

    def since(self, days: float | FloatArray) -> FloatArray:
        """Convert days from J2000.0 to s after the initial date, rounded to the microsecond."""
        return np.asarray(np.round((days - self.begin) * DAY, 6))


@part(loads=("scipy.spatial.transform", "scipy.special"))
def rotor(
    body: Body,
    epochs: Epochs,
    effects: tuple[str, ...],
    start_attitude: FloatArray | None,
    start_omega: FloatArray | None,
    torque: CustomTorque | None,
    ephemeris: str,
    source: SourceName,
    torques: PerturberTorques | None = None,
) -> Rotor:
    """Build the rotating body with its initial state and torques, ready for integration.

    It includes copies of the body in which one uncertain input is changed.
    """
    begin, end = epochs.span()
    epoch = begin * DAY
    body = _spinning(body, start_omega)
    spin_rate = float(body.spin_rate)
    figure = effects_and_torques.figure_of(body, spin_rate)
    if torques is None:
        free = Forces(figure=figure, gm={}, positions=lambda times: {})
        torques = PerturberTorques(effects_and_torques.with_effects(free, body, _acting(effects)))
    moment = polar_moment(body.number("j2"), figure.h, float(body.mass), body.number("radius"))
    u = body.relative_uncertainty
    relative_errors = {
        FLATTENING: NORMAL_95 * u.get("dynamical_flattening", 0.0),
        TRIAXIALITY: NORMAL_95 * u.get("triaxiality", 0.0),
        TIDE: torques.relative_error,
        ROUNDING: torques.rounding,
    }
    first = first_state(body, begin, start_attitude, start_omega, ephemeris, source)
    if first.libration is not None:  # its half-width contains those of the moments
        relative_errors |= {FLATTENING: 0.0, TRIAXIALITY: 0.0}
    relative_errors[START] = float(np.linalg.norm(first.rotation_error)) + first.spin_error
    forces = with_core(torques.forces, first.libration)
    own_torque = None if torque is None else torque.over(moment)
    rigid, changed = solution.rigid_bodies(forces, spin_rate, relative_errors, epoch, own_torque)
    masses = solution.masses(forces, epoch)
    start = solution.start_of(rigid, first.attitude, first.omega, masses)
    if START in changed:
        start = start.turned_last(first.rotation_error, first.spin_error)
    return Rotor(rigid, changed, masses, start, first, begin, end, moment, torques)


@part
def motion(rotor: Rotor, tolerance: float) -> AttitudeIntegrator:
    """Prepare the integration of the rotation with the requested tolerance."""
    return AttitudeIntegrator(
        rotor.body, rotor.masses, rotor.start, rotor.duration, tolerance=tolerance
    )


#: Shares of the errors.
_CAUSES = {
    "method": "the integration (difference of two solutions)",
    "input": "the uncertainties of the inputs",
    "kernel": "the positions of the bodies",
}


def _errors(units: str, name: str, quantity: str) -> Any:
    """Declare the variables ``<name>_error`` (total) and ``<name>_error_<cause>`` of a result.

    Each value is the largest error up to its time.
    """
    endings = {f"_{cause}": f"share of {name}_error from {w}" for cause, w in _CAUSES.items()}
    endings = {"": f"95 % half-width of {quantity}, largest so far", **endings}
    return Variable(units, endings=endings, along=("time",))


def _direction_errors(rotor: Rotor, body: Body, seconds: FloatArray) -> FloatArray | float:
    """Half-widths due to the direction of the perturber, by `KINDS`, shape (3, t).

    A body in synchronous rotation librates about the direction of its planet, with the free period
    of its longitude. If that direction is off by an angle, the attitude departs from the true one
    by up to twice this angle.
    """
    period, spin = body.orbital_period, abs(rotor.body.unit)
    if period is None or abs(spin * period / math.tau - 1) > _SYNCHRONOUS:
        return 0.0
    frequency = spin * math.sqrt(3 * max(0.0, float(rotor.body.moment_differences[2, 0])))
    phase = frequency * seconds
    angle = rotor.torques.direction_error
    away = angle * (1 - np.cos(np.minimum(phase, np.pi)))
    speed = angle * frequency * np.sin(np.minimum(phase, np.pi / 2))
    return np.stack([away, speed, speed / spin])


class Attitudes(Dated, along=("time", "component")):
    """Attitude, spin and angular momentum in time, with errors: total and by error source."""

    attitude = number(
        "1",
        "unit quaternion, body to ICRF",
        along=("time", "quaternion"),
        error="attitude_error",
        short="quaternion, body to ICRF",
    )
    attitude_error = _errors("deg", "attitude", "the angle of the attitude")
    omega = number(
        "rad/s",
        "angular velocity along the principal axes",
        frame="principal axes of the body, C last",
        short="spin in the body",
    )
    omega_error = _errors("rad/s", "omega", "the angular velocity")
    angular_momentum = number("kg m2 / s", "angular momentum along the ICRF", frame="ICRF")
    angular_momentum_error = _errors(
        "kg m2 / s", "angular_momentum", "the angular momentum, C as given"
    )
    component = labels(default=["x", "y", "z"])
    quaternion = labels(default=["w", "x", "y", "z"])


def _followed(
    motion: AttitudeIntegrator, rotor: Rotor, seconds: FloatArray, begin: float
) -> RotationSeries:
    """Integrate the rotation up to the given times (s), while a progress bar is shown."""
    total = rotor.turns(float(seconds[-1]) - begin)
    with up_to("turns of the body", total) as report:
        return motion.at(seconds, lambda reached: report(rotor.turns(reached - begin)))


@part
def attitudes(
    motion: AttitudeIntegrator,
    rotor: Rotor,
    epochs: Epochs,
    body: Body,
    start_attitude: FloatArray | None,
    effects: tuple[str, ...],
    neglected: Neglected,
    block: Block | None = None,
) -> Attitudes:
    """Compute attitude, spin and angular momentum with errors at every requested time."""
    now = days_of(epochs, block, "series.zarr")
    order = np.argsort(now, kind="stable")
    seconds = rotor.since(now[order])
    begin = 0.0 if block is None or block.first == 0 else float(seconds[0])
    rotor.refuse_many_turns(begin, float(seconds[-1]))
    series = _followed(motion, rotor, seconds, begin)
    back = np.argsort(order, kind="stable")
    size = rotor.polar_moment * abs(rotor.body.unit)
    turn, spin, momentum = rotor.first.turn_errors
    first_errors = turn, spin, momentum / abs(rotor.body.unit)
    tide_error = rotor.torques.relative_error
    direction_errors = _direction_errors(rotor, body, seconds)
    shares = solution.shares_of(series, rotor.changed, tide_error, first_errors, direction_errors)
    errors = {
        f"{name}_error": [factor * shares[cause][kind][back] for cause in ("", *_CAUSES)]
        for kind, (name, factor) in enumerate(zip(KINDS, (1.0, 1.0, size), strict=True))
    }
    comment = {"comment": f"error of the rigid model; not included: {neglected.largest}"}
    return Attitudes(
        time=datetime64(now),
        attitude=series.attitude[back],
        omega=series.omega[back],
        angular_momentum=(size if rotor.body.unit > 0 else -size) * series.momentum[back],
        **errors,
    ).with_attributes(
        attitude={"x_axis": first_attitude.x_axis_note(body, start_attitude)},
        no_error=rotor.torques.no_error,
        attitude_error={
            **comment,
            "method": "Gauss windows of two lengths",
            # the number that a whole series takes is not known from one block of it
            **({"evaluations": motion.evaluations} if block is None else {}),
            **({} if start_attitude is not None else first_attitude.start_note(body, rotor.first)),
            **effects_and_torques.inactive_effects_note(body, effects, ALL_EFFECTS),
        },
        omega_error=comment,
        angular_momentum_error=comment,
    )


class DistanceGrowth(Dated):
    """Growth in time of the distance between two rotations that start almost equal."""

    growth = number(
        "1",
        "natural logarithm of the growth of the distance between two neighbouring rotations",
        no_error="its scatter is growth_rate_error",
    )
    growth_rate = number("1/s", "mean growth rate; Lyapunov exponent if chaotic", along=())
    growth_rate_error = number(
        "1/s",
        "95 % half-width of the rate, from its scatter between stretches of the span",
        along=(),
    )
    course = words("chaotic if growth is faster than a power of time, else regular", along=())
    #: Only where the motion is chaotic.
    lyapunov_time = number(
        "d", "time in which the distance grows by the factor e", along=(), default=None
    )
    lyapunov_time_error = number("d", "95 % half-width of that time", along=(), default=None)


def one_date(span: Span, times: TimeList | None) -> str | None:
    """Return the reason (text) to omit divergence if only one date is requested, else None."""
    first, last = span.days if times is None else times.span()
    return None if last > first else "the divergence needs more than one date"


@part(unless=one_date, loads=("earthspin.motion.divergence",))
def separation(rotor: Rotor) -> Divergence:
    """Integrate the distance between two rotations that start almost equal.

    The distance is scaled back repeatedly.
    """
    from earthspin.motion.divergence import divergence

    rotor.refuse_many_turns(0.0, rotor.duration)
    return divergence(rotor.body, rotor.masses, rotor.start, rotor.duration)


@part(unless=one_date)
def divergence(separation: Divergence, rotor: Rotor, epochs: Epochs) -> DistanceGrowth:
    """Rate at which rotations with almost equal starts diverge, and Lyapunov time if chaotic."""
    now = days_of(epochs)
    rate, spread = separation.rate
    chaotic = separation.is_chaotic
    return DistanceGrowth(
        time=datetime64(now),
        growth=separation.at(rotor.since(now)),
        growth_rate=rate,
        growth_rate_error=spread,
        course="chaotic" if chaotic else "regular",
        lyapunov_time=1 / rate if chaotic else None,
        lyapunov_time_error=spread / rate**2 if chaotic else None,
    )


#: Effects that no rigid body of three moments has.
_BEYOND = (
    "deformation and flow of the interior, harmonics of the figure beyond the moments, J3 and J4"
)


@part(unless=no_perturbers)
def effect_changes(
    rotor: Rotor, sky: Sky, body: Body, perturbers: tuple[Body, ...], effects: tuple[str, ...]
) -> dict[str, float]:
    """Largest changes of the attitude by each effect that is switched off, rad."""
    on = _acting(effects)
    off = effects_and_torques.switched_off(body, perturbers, on)
    if not off:
        return {}
    spinning = body.replace(spin_period=2 * np.pi / rotor.body.unit)
    forces, further = effects_and_torques.with_each_effect(sky, spinning, perturbers, on, off)
    unplaced = (
        effects_and_torques.drift_by_planets(spinning, rotor.duration)
        if {*off} - {*further}
        else {}
    )
    return unplaced | effect_sizes.attitude_displacements(
        rotor.body, rotor.start, rotor.duration, forces, further
    )


@part(unless=(no_perturbers, no_satellites))
def node_drifts(body: Body, attractors: Attractors, epochs: Epochs) -> dict[str, float]:
    """Largest displacements (rad) of the pole due to satellite nodes, from first to last date."""
    obliquity = obliquity_of(body)
    if obliquity is None:
        return {}
    begin, end = epochs.span()
    nutations = node_nutations(body, attractors.mean_gm_over_r3(), obliquity)
    return largest_displacements(nutations, (end - begin) * DAY)


@part
def neglected(
    body: Body,
    perturbers: tuple[Body, ...],
    effects: tuple[str, ...],
    epochs: Epochs,
    effect_changes: dict[str, float] | None = None,
    node_drifts: dict[str, float] | None = None,
) -> Neglected:
    """Sizes of neglected effects on the attitude, and names of effects of unknown size.

    The sizes are for the last date.
    """
    changes = effect_changes or {}
    sizes = {name: change for name, change in changes.items() if change}
    off = effects_and_torques.switched_off(body, perturbers, _acting(effects))
    unknown = [name for name in off if name not in changes]
    in_body = known_attitude_effects(body, perturbers)
    off_in_body = [name for name in in_body if name not in effects]
    sources = ["effects that are off: to first order, about a steady rotation"] if sizes else []
    if node_drifts:
        sizes |= node_drifts
        sources.append("nodes: circles of the pole by the torques of the satellites on the bulge")
    known = planets.BEYOND_RIGID.get(body.known_as) if body.is_as_named else None
    defaults = {perturber.name for perturber in planets.default_perturbers(body)}
    if known is None or not defaults <= {perturber.known_as for perturber in perturbers}:
        unknown = [_BEYOND, *unknown, *off_in_body]
    else:
        begin, end = epochs.span()
        beyond = known.after(end - begin)
        acting = ATTITUDE_EFFECTS.keys() - {*off_in_body}
        sizes |= {name: size for name, size in beyond.items() if name not in acting}
        sources.append(known.source)
        unknown += [known.unknown] if known.unknown else []
    what = "largest change of the attitude that the model leaves out"
    return Neglected(sizes, "arcsec", what, "; ".join(sources), unknown=", ".join(unknown))


rotation = public_call(
    Rotation,
    answer=attitudes,
    sections=(divergence, neglected),
    parts=(
        *effects_and_torques.ATTRACTORS,
        torques,
        rotor,
        motion,
        separation,
        effect_changes,
        node_drifts,
    ),
)

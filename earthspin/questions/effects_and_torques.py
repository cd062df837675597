"""Perturbers, effects and custom torques that move a body's axes, prepared for the integrators."""

from __future__ import annotations

import math
import re
from collections import ChainMap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain
from typing import Annotated, Any

import numpy as np
from numpy.typing import ArrayLike

from earthspin import bodies
from earthspin.bodies import BODIES, SUN, Body, label_of
from earthspin.bodies.earth_moon_sun import EARTH_ANGLE
from earthspin.constants import ARCSEC, DAY
from earthspin.engine import key, part
from earthspin.errors import EarthspinError, KernelError, UndefinedError, Where, one_line
from earthspin.mass.figure import inverse_polar_moment
from earthspin.motion.attitude_effects import ALL_EFFECTS, ATTITUDE_EFFECTS
from earthspin.motion.effects import EFFECTS, GEODESIC, NONRIGID, PLANETS, RIGID, Effect
from earthspin.motion.forces import DynamicalFigure, Forces, Places, RateLaw, Torque
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.polynomials import Windows
from earthspin.questions.ellipse_chains import all_by_elements
from earthspin.questions.satellites import common_precession, obliquity_of, satellite_factors
from earthspin.questions.sky import KernelName, Sky, places, sky, start_error
from earthspin.questions.time_axes import DateSeries, epochs
from earthspin.sky.ephemeris import Ephemeris, open_ephemeris
from earthspin.sky.poles import node_angle
from earthspin.sky.protocol import Place
from earthspin.torque.gravity import cross
from earthspin.units import Plain, Several, Word, vectors

#: Samples of an orbit for its mean pull; the mean over an ellipse converges exponentially.
ORBIT_SAMPLES = 400
#: Words for effects that depend on the body; the question replaces them by names.
KNOWN, WITHOUT_INTERIOR = "known", "rigid"


@dataclass(frozen=True)
class EffectNames(Several):
    """Kind of input: names of effects, and words for several: "known", "rigid" or "all"."""

    of: Word

    @property
    def hint(self) -> str:
        """Type hint for code editors: "known", "rigid" or "all", or one or several effect names."""
        return f"Literal['known', 'rigid', 'all'] | {super().hint}"

    @property
    def words(self) -> str:
        """Text for error messages that describes the allowed values."""
        return f'{super().words}; or "known", "rigid" or "all"'

    def read(self, value: object, where: Where) -> tuple[str, ...]:
        """Check a word or a list of effect names, and return a tuple; "all" gives all names."""
        several: dict[str, Any] = dict.fromkeys((KNOWN, WITHOUT_INTERIOR, "all"))
        effects: Any = self.of.allowed
        words = Several(Word(ChainMap(several, effects))).read(value, where)
        names = (tuple(effects) if word == "all" else (word,) for word in words)
        return tuple(dict.fromkeys(chain.from_iterable(names)))


#: Names of effects, as an input.
Effects = Annotated[tuple[str, ...], EffectNames(Word(EFFECTS))]
EFFECTS_DOC = (
    "effects besides the torque of the perturbers on the bulge: names, and words for several: "
    "known (all that are known for the body), rigid (without the response of the interior), all"
)


class AxisMotion(DateSeries):
    """Base class of computations that follow the motion of a body's axes under torques."""

    by_body = ("effects",)

    effects: Effects = key("known", doc=EFFECTS_DOC)

    def check(self) -> None:
        """Replace "known" or "rigid" by names of effects; refuse `planets` without a kernel."""
        super().check()
        words = {KNOWN: self.known_effects, WITHOUT_INTERIOR: self.rigid_effects}
        names = (words[name]() if name in words else (name,) for name in self.effects)
        effects = tuple(dict.fromkeys(chain.from_iterable(names)))
        object.__setattr__(self, "effects", effects)
        for name in effects:
            if missing := ALL_EFFECTS[name].missing(self.body):
                owner, fields = bodies.in_a_sentence(self.body.name), " and ".join(missing)
                problem = f"{fields} of {owner} is not known; give it, or leave the effect out"
                raise self.error("effects", name, problem)
        if PLANETS.name in effects and all_by_elements(self.body, self.perturbers):
            problem = "all orbits are given by elements, and this effect needs a kernel"
            remedy = "remove it, or list the planets as perturbers"
            raise self.error("effects", PLANETS.name, f"{problem}: {remedy}")

    def known_effects(self) -> tuple[str, ...]:
        """Names of the effects that can be computed for this body, its perturbers and kernel."""
        return self.rigid_effects()

    def rigid_effects(self) -> tuple[str, ...]:
        """Names of the effects on a rigid body; `planets` only if a kernel contains the planets."""
        kernel = kernel_file(self.ephemeris)
        no_planets = all_by_elements(self.body, self.perturbers) or (
            kernel is not None and not kernel.holds(BODIES[name].naif for name in bodies.PLANETS)
        )
        known = (name for name in RIGID if not EFFECTS[name].missing(self.body))
        return tuple(name for name in known if not (no_planets and name == PLANETS.name))


def kernel_file(ephemeris: str) -> Ephemeris | None:
    """Open the kernel file at a given path; None if `ephemeris` is a kernel name or a faulty file.

    Named kernels hold all planets for a century and more; a faulty file is refused by the run.
    """
    if not KernelName().is_path(ephemeris):
        return None
    try:
        return open_ephemeris(ephemeris)
    except KernelError:
        return None


@dataclass(frozen=True)
class Attractors:
    """Rotating body, GM and positions of its perturbers, and the time limits of the positions.

    Attributes
    ----------
    body : Body
    sky : Sky
    gm : dict of str to float
        GM, m3 s-2, of the question's perturbers, followed by the planets.
    targets : dict of str to Place
        Place of each perturber in the source.
    limits : tuple of float
        First and last time for which all positions are available, s from J2000.0 TDB.
    sun : str
        Name of the Sun, if it is among the perturbers.
    bodies : tuple of Body
        Perturbers of the question.
    """

    body: Body
    sky: Sky
    gm: dict[str, float]
    targets: dict[str, Place]
    limits: tuple[float, float]
    sun: str = SUN.name
    bodies: tuple[Body, ...] = ()
    _stored: dict[tuple[float, float, int], dict[str, FloatArray]] = field(
        default_factory=dict, repr=False
    )

    @property
    def epoch(self) -> float:
        """Start of the integration, s from J2000.0: 0, or the nearest time with known positions."""
        return min(max(0.0, self.limits[0]), self.limits[1])

    @property
    def start(self) -> FloatArray:
        """Figure axis at the start of the integration, shape (3,)."""
        return self.body.needed("pole").true(self.epoch / DAY)

    def positions(
        self, names: Sequence[str], times: FloatArray, keep: bool
    ) -> dict[str, FloatArray]:
        """Positions of perturbers relative to the body, m, at times in s; cached if `keep`."""
        at = (float(times[0]), float(times[-1]), times.size)
        known = self._stored.setdefault(at, {}) if keep else {}
        missing = {name: self.targets[name] for name in names if name not in known}
        if missing:
            known |= self.sky.positions(times / DAY, missing)
        return known

    def primary(self) -> Body:
        """Return the perturber with the largest tide at the start of the integration."""
        positions = self.positions(list(self.sky.targets), np.array([self.epoch]), keep=False)
        return max(
            self.bodies, key=lambda b: self.gm[b.name] / np.linalg.norm(positions[b.name]) ** 3
        )

    def mean_gm_over_r3(self) -> float:
        """Sum over perturbers of GM times the mean 1/r3 over an orbit about J2000.0, s-2.

        Without an orbital period it is that at J2000.0. The period is cut to the times that are
        covered.
        """
        half = (self.body.orbital_period or 0.0) / 2
        first, last = (min(max(end, self.limits[0]), self.limits[1]) for end in (-half, half))
        times = np.linspace(first, last, ORBIT_SAMPLES, endpoint=False)
        positions = self.sky.positions(times / DAY)
        return sum(
            self.gm[name] * float(np.mean(np.linalg.norm(position, axis=1) ** -3))
            for name, position in positions.items()
        )


@part
def attractors(
    sky: Sky, body: Body, perturbers: tuple[Body, ...], effects: tuple[str, ...]
) -> Attractors:
    """Collect GM and position sources of the perturbers, and of the planets if `planets` is on."""
    masses = {p.name: float(p.gm_on(body)) for p in perturbers}
    targets = dict(sky.targets)
    if PLANETS.name in effects:
        named = {code for member in (body, *perturbers) for code in member.naif}
        for name in bodies.PLANETS:
            if name not in masses and name != body.known_as and named.isdisjoint(BODIES[name].naif):
                masses[name] = float(BODIES[name].gm_on(body))
                targets[name] = sky.place(BODIES[name])
    start, end = sky.coverage(targets)
    limits = start * DAY, end * DAY
    name = label_of(SUN.name, perturbers) or SUN.name
    return Attractors(body, sky, masses, targets, limits, name, perturbers)


def forces_of(attractors: Attractors, effects: Sequence[str], keep: bool = False) -> Forces:
    """Build the forces that move the axes of a body, including only the given effects."""
    body, near = attractors.body, tuple(attractors.sky.targets)
    forces = Forces(
        figure=figure_of(body, 2 * math.pi / body.number("spin_period")),
        gm={name: attractors.gm[name] for name in near},
        far={name: gm for name, gm in attractors.gm.items() if name not in near},
        positions=lambda times: {},
        near=near,
        sun=attractors.sun,
        mean_pole=lambda times: body.needed("pole").mean(times / DAY),
    )
    if not ATTITUDE_EFFECTS.keys().isdisjoint(effects):
        primary = attractors.primary()
        bulge = 0.0, np.zeros(3)
        if primary.j2 is not None and primary.pole is not None:
            j2_a2 = primary.number("j2") * primary.number("radius") ** 2
            bulge = j2_a2, primary.pole.mean(np.zeros(1))[0]
        forces = replace(forces, primary=primary.name, primary_bulge=bulge)
    forces = with_effects(forces, body, effects)
    turn = common_precession(body, attractors.mean_gm_over_r3()) if body.satellites else None
    if turn is not None:
        forces = replace(forces, torques=(*forces.torques, precessing_torque(turn[0])))
    names = tuple(forces.gm)
    return replace(forces, positions=lambda times: attractors.positions(names, times, keep))


def precessing_torque(rate: FloatArray) -> Torque:
    """Make the torque that turns the angular momentum at a constant angular velocity.

    Parameters
    ----------
    rate : ndarray, shape (3,)
        rad/s.
    """
    column = rate.reshape(3, 1, 1)

    def over(forces: Forces, windows: Windows, place: Places) -> RateLaw:
        return lambda axis, momentum: cross(column, momentum)

    return over


def figure_of(body: Body, spin_rate: float) -> DynamicalFigure:
    """Make a `DynamicalFigure`: flattening, spin rate, inverse polar moment, radius of a body."""
    h, radius = body.number("dynamical_flattening"), body.number("radius")
    return DynamicalFigure(
        h=h,
        spin_rate=spin_rate,
        inverse_polar_moment=inverse_polar_moment(body.number("j2"), h),
        radius=radius,
        meridian=0.0 if body.pole is None else x_axis_angle(body, 0.0, spin_rate),
    )


def x_axis_angle(body: Body, day: float, spin_rate: float) -> float:
    """Angle on a day from the x axis of the ICRF, projected on the equator, to the body's x axis.

    The x axis is that of least moment; without triaxiality it is the prime meridian. If the prime
    meridian is not known, it is taken to be on the projected x axis at J2000.0.

    Parameters
    ----------
    body : Body
    day : float
        Days from J2000.0 TDB.
    spin_rate : float
        rad/s.

    Returns
    -------
    float
        rad.
    """
    pole, angle = body.needed("pole"), 0.0
    if pole.of_the_iau:
        angle = EARTH_ANGLE.value
    elif body.prime_meridian is not None:
        angle = body.prime_meridian + node_angle(pole.true(day))
    return angle + x_axis_longitude(body) + spin_rate * (day * DAY)


def x_axis_longitude(body: Body) -> float:
    """East longitude of a body's x axis, rad: that of the axis of least moment, if triaxial."""
    return body.number("long_axis") if body.number("triaxiality") else 0.0


def with_effects(forces: Forces, body: Body, effects: Sequence[str]) -> Forces:
    """Add the effects with the given names to the forces, and return the new forces."""
    chosen = [ALL_EFFECTS[name] for name in effects]
    for effect in ALL_EFFECTS.values():
        if effect in chosen and not effect.missing(body):
            forces = effect.switch_on(forces, body)
    return forces


def start_note(body: Body) -> dict[str, str]:
    """Attribute of a result which states that the errors exclude the error of the initial pole.

    Empty if the pole follows the models of the IAU.
    """
    if body.needed("pole").of_the_iau:
        return {}
    half = start_error(body)
    size = "is not known" if half is None else f"is {half / ARCSEC:.2g} arcsec (95 % half-width)"
    name = bodies.in_a_sentence(body.name)
    return {"start": f"taken as exact; the uncertainty of the pole of {name} at J2000.0 {size}"}


def inactive_effects_note(
    body: Body, effects: Sequence[str], of: Mapping[str, Effect] = EFFECTS
) -> dict[str, str]:
    """Attributes of a result: effects whose coefficient is 0, and effects `of` one not known."""
    owner = bodies.in_a_sentence(body.name)
    acting = {name: ALL_EFFECTS[name] for name in effects}
    idle = [
        f"{name} ({effect.coefficient} of {owner} is 0)"
        for name, effect in acting.items()
        if effect.is_idle(body)
    ]
    unknown = [
        f"{name} ({', '.join(missing)} of {owner} is not known)"
        for name, effect in of.items()
        if (missing := effect.missing(body))
    ]
    notes = {"effects_that_do_nothing": idle, "effects_left_out": unknown}
    return {note: ", ".join(words) for note, words in notes.items() if words}


#: Parts that compute `attractors` and `epochs`, for questions that use them.
ATTRACTORS = (places, sky, attractors, epochs)


# --- effects that are switched off ---------------------------------------------------------------


def switched_off(
    body: Body, perturbers: tuple[Body, ...], effects: Sequence[str]
) -> tuple[str, ...]:
    """Names of effects on a rigid body that are switched off, without effects that would be zero.

    An effect does not act if its coefficient is zero or its perturbers are not there.
    """
    idle = {name for name, effect in EFFECTS.items() if effect.is_idle(body)}
    if body.known_as not in BODIES and all_by_elements(body, perturbers):
        idle.add(PLANETS.name)  # the body is not in the solar system
    if label_of(SUN.name, perturbers) is None:
        idle.add(GEODESIC.name)
    off = (name for name in EFFECTS if name not in {*effects, *idle, NONRIGID.name})
    return tuple(off) if perturbers else ()


def with_each_effect(
    sky: Sky, body: Body, perturbers: tuple[Body, ...], effects: Sequence[str], off: Sequence[str]
) -> tuple[Forces, dict[str, Forces]]:
    """Build the forces with `effects` on, and, by name, those with one effect of `off` also on.

    The planets are omitted if their positions are not known (`drift_by_planets`).
    """
    on = tuple(effects)
    try:
        acting = attractors(sky, body, perturbers, (*on, *off))
    except EarthspinError:
        off = [name for name in off if name != PLANETS.name]
        acting = attractors(sky, body, perturbers, on)
    added = {name: forces_of(acting, (*on, name), keep=True) for name in off}
    return forces_of(acting, on, keep=True), added


#: Samples of half a synodic orbit; the mean over it converges exponentially.
_SAMPLES = 1000


def drift_by_planets(body: Body, seconds: float) -> dict[str, float]:
    """Displacement (rad) of a planet's axis by the other planets in a given time (s), as a dict.

    It follows from their mean torque on circular orbits in one plane, without their positions:
    within 10 % for the Earth and Mars over ten years. Empty for a body that is not a planet of the
    Sun, or whose obliquity is not known.
    """
    obliquity = obliquity_of(body)
    if body.known_as not in bodies.PLANETS or body.orbital_period is None or obliquity is None:
        return {}
    phases = math.pi * (np.arange(_SAMPLES) + 0.5) / _SAMPLES
    own, gm_over_r3 = _orbit_radius(body), 0.0
    for planet in (BODIES[name] for name in bodies.PLANETS if name != body.known_as):
        other = _orbit_radius(planet)
        square = own**2 + other**2 - 2 * own * other * np.cos(phases)
        gm_over_r3 += planet.number("gm") * float(np.mean(square**-1.5))
    speed = 0.75 * body.number("dynamical_flattening") / float(body.spin_rate) * gm_over_r3
    factor = float(satellite_factors(body, gm_over_r3, obliquity).rate)
    return {PLANETS.name: abs(speed * math.sin(2 * obliquity) * factor * seconds)}


def _orbit_radius(planet: Body) -> float:
    """Mean radius of a planet's orbit about the Sun, m, from the orbital period."""
    return math.cbrt(SUN.number("gm") * (planet.number("orbital_period") / (2 * math.pi)) ** 2)


# --- torques given by the user -------------------------------------------------------------------


#: Key in a scene for a function, which a scene cannot hold.
_FUNCTION = "live"


@dataclass(frozen=True)
class CustomTorque:
    """Custom torque on a body, defined by a Python function of the user.

    Attributes
    ----------
    law : callable
        ``torque(t, q, omega)`` that takes times from the start (s), shape (n,), attitudes, shape
        (n, 4), and angular velocities along the body's axes (rad/s), shape (n, 3), and returns the
        torque along the body's axes (N m), shape (n, 3).
    """

    law: Callable[[FloatArray, FloatArray, FloatArray], ArrayLike]

    words = "a function torque(t, q, omega) -> N m, in Python"
    hint = "Callable[[np.ndarray, np.ndarray, np.ndarray], ArrayLike]"

    @classmethod
    def read(cls, value: object, where: Where) -> CustomTorque:
        """Accept a Python function as the torque; its results are checked whenever it is called."""
        if isinstance(value, CustomTorque):
            return value
        if isinstance(value, Mapping) and _FUNCTION in value:
            problem = "it was a function, which no scene can hold; give it again in Python"
            raise where.error(value[_FUNCTION], problem)
        if not callable(value):
            raise where.error(value, f"give {cls.words}")
        return cls(value)

    def write(self) -> Plain:
        """Name of the function, as stored in scene (input) files; its code is not stored."""
        name = getattr(self.law, "__qualname__", None) or repr(self.law)
        return {_FUNCTION: re.sub(r" at 0x[0-9a-fA-F]+", "", str(name))}

    def over(
        self, polar_moment: float
    ) -> Callable[[FloatArray, FloatArray, FloatArray], FloatArray]:
        """Wrap the user's function: divide its torque by the polar moment, and check every result.

        Parameters
        ----------
        polar_moment : float
            C, kg m2.

        Raises
        ------
        UndefinedError
            If the function fails, or does not return a finite torque for each time.
        """

        def torque(times: FloatArray, q: FloatArray, omega: FloatArray) -> FloatArray:
            try:
                returned = vectors(self.law(times, q, omega), "N m", Where("torque"), "1 N m")
                values = np.broadcast_to(returned, omega.shape)
            except EarthspinError:
                raise
            except Exception as error:  # any error of the user's function
                reason = one_line(error) or type(error).__name__
                raise UndefinedError(
                    f"the custom torque failed for {times.size} times: {reason}; it must take "
                    f"arrays of shapes ({times.size},), ({times.size}, 4) and ({times.size}, 3) "
                    "and return N m with the last shape"
                ) from None
            finite = np.isfinite(values).all(axis=1)
            if not finite.all():
                first = f"{float(times[~finite][0]):.6g} s from the start"
                problem = f"the custom torque is not finite {first}"
                raise UndefinedError(f"{problem}; return a finite torque for each time")
            return np.asarray(values / polar_moment)

        return torque

"""Cassini states: orientations of a spin axis that precesses at the same rate as its orbit."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from earthspin.bodies import BODIES, MOON, SUN, Body, Orbit, checks, in_a_sentence, planets
from earthspin.constants import NORMAL_95
from earthspin.engine import Neglected, Question, key, part, public_call
from earthspin.engine.variables import Variables, labels, measured, number
from earthspin.errors import SceneError, nearest
from earthspin.numerics.arrays import FloatArray
from earthspin.questions.ellipse_chains import refuse_overlap, size_and_motion
from earthspin.torque import cassini


class CassiniStates(
    Question, word="cassini-states", call="cassini_states", positional=("body", "orbit")
):
    """Cassini states of a body: spin axis, orbit normal and mean orbit normal in one plane.

    The node of the orbit moves at a constant rate. The spin may be free, or locked to the orbit, as
    that of the Moon (one rotation per orbit) and of Mercury (three in two orbits).

    The label `state` is 1 to 4, or 2 and 3, after Peale (1969).

    Raises
    ------
    EarthspinError
        If the figure of the body is not known, or the node of the orbit does not move.

    Examples
    --------
    >>> import earthspin
    >>> print(earthspin.cassini_states("moon").obliquity.round(2).values, "deg")
    [  6.73 175.68] deg
    """

    page, headline = "frames", "obliquity"

    body: Body = key(MOON, doc="body with the spin axis")
    orbit: Annotated[Orbit | None, Orbit] = key(
        None,
        doc="orbit with the period of its node; if not given, that of the body, or the mean "
        "orbit of a moon or of Mercury",
    )

    def check(self) -> None:
        """Refuse a body without known J2, H, spin or orbit, or with arrays as properties."""
        self.body.require(("j2", "dynamical_flattening", "spin_period"))
        if self.body.labelled:
            raise self.error("body", self.body.name, "give single numbers here, no labelled arrays")
        checks.refuse_break_up(self.body)
        if orbit_of(self.body, self.orbit) is None:
            example = "{period = '27.32 d', i = '5.1 deg', node_period = '-6793 d'}"
            raise self.error("orbit", None, f"give the elements of its orbit, like {example}")


@dataclass(frozen=True)
class Locking:
    """Mean motion of a body on its orbit, and number of rotations of the body per orbit.

    Attributes
    ----------
    motion : float
        Mean motion, rad/s, of an orbit outside both bodies.
    turns : float
        Turns in each orbit.
    locked : bool
        Whether that is a multiple of a half.
    """

    motion: float
    turns: float
    locked: bool


def orbit_of(body: Body, orbit: Orbit | None) -> Orbit | None:
    """Return the orbit given by the user, or else the body's known orbit; None if there is none."""
    return orbit or body.orbit or planets.PRECESSING_ORBITS.get(body.known_as)


@part
def orbit_in_use(body: Body, orbit: Orbit | None) -> Orbit:
    """Return the orbit given by the user, or else the body's known orbit, which must exist."""
    known = orbit_of(body, orbit)
    assert known is not None  # `check` has seen to it
    return known


@part
def locking(body: Body, orbit_in_use: Orbit) -> Locking:
    """Compute the mean motion of a body on its orbit, and the number of rotations per orbit."""
    about = orbit_in_use.about or SUN.name
    if about not in BODIES or about == body.known_as:
        others = [name for name in BODIES if name != body.known_as]
        raise SceneError("orbit.about", about, nearest(about, others))
    placed = body.replace(orbit=orbit_in_use)
    a, motion = size_and_motion(placed, BODIES[about])
    known = planets.PRECESSING_ORBITS.get(body.known_as)
    like = f", like about = '{known.about}'" if known is not None and known.about else ""
    advice = "" if orbit_in_use.about else f"; name what it orbits{like}"
    refuse_overlap(placed, BODIES[about], a, advice)
    locked = cassini.is_locked(body.spin_rate, motion)
    return Locking(motion, body.spin_rate / motion, locked)


def precessing(body: Body, orbit: Orbit, locking: Locking) -> cassini.Precessing:
    """Compute the torque strengths and orbital precession that determine the Cassini states."""
    axial, locked = cassini.strengths(
        locking.motion,
        body.spin_rate,
        body.number("j2"),
        body.number("triaxiality") / 4,
        body.number("j2") / body.number("dynamical_flattening"),
        orbit.e,
    )
    node = 0.0 if orbit.node_period is None else -2 * math.pi / orbit.node_period
    return cassini.Precessing(axial, locked if locking.locked else 0.0, orbit.i, node)


class CassiniObliquities(Variables, along=("state",), no_error="true or false"):
    """Obliquity, tilt to the mean orbit normal, and stability of each Cassini state of a body."""

    obliquity = measured(
        "deg",
        "angle from the orbit normal to the spin axis",
        comment="half-widths from the uncertainty of the body's numbers",
    )
    tilt = measured("deg", "angle from the mean orbit normal to the spin axis")
    towards_pole = number("1", "whether the axis is tilted towards the mean orbit normal")
    stable = number("1", "whether a slightly displaced axis stays near it")
    state = labels("number of the state after Peale (1969)", "1")


@part
def states(body: Body, orbit_in_use: Orbit, locking: Locking) -> CassiniObliquities:
    """Compute obliquity, tilt to the mean orbit normal, and stability of every Cassini state."""
    axis = precessing(body, orbit_in_use, locking)
    # a locked body turns with its orbit: there the torque of each orbit is the same at any rate
    torque_rate = 0.0 if locking.locked else 1.5 * abs(axis.axial)
    rate = max(torque_rate, abs(axis.node_rate))
    checks.refuse_fast_axis(rate / locking.motion, rate / abs(body.spin_rate))
    solution = cassini.cassini_states(axis)
    error = _error(body, orbit_in_use, locking, solution.obliquity)
    tilt = np.abs(solution.obliquity - orbit_in_use.i)
    reference = {"references": orbit_in_use.reference} if orbit_in_use.reference else {}
    locked = "locked" if locking.locked else "free"
    return CassiniObliquities(
        obliquity=(np.abs(solution.obliquity), error),
        tilt=(np.minimum(tilt, 2 * np.pi - tilt), error),
        towards_pole=solution.obliquity > 0,
        stable=solution.stable,
        state=solution.number,
    ).with_attributes(
        tilt={"inclination": math.degrees(orbit_in_use.i), **reference},
        obliquity={"spin": f"{locked}, {locking.turns:.6g} turns in each orbit"},
    )


def _error(body: Body, orbit: Orbit, locking: Locking, obliquity: FloatArray) -> FloatArray:
    """95 % half-width of the obliquity due to the errors of J2, H and the triaxiality, rad."""
    squares = np.zeros_like(obliquity)
    for name in ("j2", "dynamical_flattening", "triaxiality"):
        share = body.relative_uncertainty.get(name, 0.0)
        # `Body.replace` moves H with J2 unless H is given, too
        changed = {"dynamical_flattening": body.number("dynamical_flattening")}
        changed[name] = body.number(name) * (1 + NORMAL_95 * share)
        neighbour = cassini.cassini_states(precessing(body.replace(**changed), orbit, locking))
        if neighbour.number.size == obliquity.size:
            squares += (neighbour.obliquity - obliquity) ** 2
    return np.radians(np.degrees(np.sqrt(squares)))  # the rounding that earlier results have


@part
def neglected(body: Body, orbit_in_use: Orbit) -> Neglected:
    """Published sizes of effects on the obliquity that the theory of Cassini states neglects."""
    sizes = planets.LEFT_OUT_OF_STATES.get(body.known_as, {})
    if sizes and body.is_as_named and orbit_in_use == planets.PRECESSING_ORBITS.get(body.known_as):
        return Neglected.cited(sizes, "change of the obliquity in the upright state")
    return Neglected(
        what="libration, torques of other bodies, a decoupled core, and terms in the longitude of "
        f"the pericentre: not measured for {in_a_sentence(body.name)}"
    )


cassini_states = public_call(
    CassiniStates, answer=states, sections=(neglected,), parts=(orbit_in_use, locking)
)
